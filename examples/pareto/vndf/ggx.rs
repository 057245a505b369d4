//! GGX: spherical caps as the crate and as the paper have them, and the hemisphere of Heitz 2018.

use std::io::{self, Write};

use microsurface::{Ggx, Isotropic, Microsurface, Ndf, Real, SampleNdf, SampleVndf};

use super::{ALL, Input, Samplers, VISIBLE, alphas, extreme};
use crate::Effort;
use crate::blocks::call;
use crate::textbook::{Anisotropic, Elementary, ggx};

fn surface<T: Real>(alpha: T) -> Microsurface<Ggx, Isotropic<T>> {
    Ggx::isotropic(alpha).expect("a width")
}

#[inline(always)]
fn ours<T: Real>(surface: &Microsurface<Ggx, Isotropic<T>>, [x, y, z, u1, u2]: Input<T>) -> [T; 3] {
    surface.sample_vndf([x, y, z].into(), [u1, u2].into()).into()
}

#[inline(always)]
fn all<T: Real>(surface: &Microsurface<Ggx, Isotropic<T>>, [.., u1, u2]: Input<T>) -> [T; 3] {
    surface.sample_d([u1, u2].into()).into()
}

#[inline(always)]
fn heitz<T: Elementary>(&widths: &Anisotropic<T>, [x, y, z, u1, u2]: Input<T>) -> [T; 3] {
    ggx::visible_normal_heitz2018(widths, [x, y, z], [u1, u2])
}

#[inline(always)]
fn dupuy<T: Elementary>(&widths: &Anisotropic<T>, [x, y, z, u1, u2]: Input<T>) -> [T; 3] {
    ggx::visible_normal_dupuy2023(widths, [x, y, z], [u1, u2])
}

call!(Ours<T: Real>: (Microsurface<Ggx, Isotropic<T>>), 5 => 3, ours);
call!(All<T: Real>: (Microsurface<Ggx, Isotropic<T>>), 5 => 3, all);
call!(Heitz<T: Elementary>: (Anisotropic<T>), 5 => 3, heitz);
call!(Dupuy<T: Elementary>: (Anisotropic<T>), 5 => 3, dupuy);

fn widths<T: Copy>(alpha: T) -> Anisotropic<T> {
    Anisotropic { alpha_x: alpha, alpha_y: alpha }
}

/// A normal and its density among the visible.
fn visible(alpha: f64, input: Input<f64>, normal: [f64; 3]) -> ([f64; 3], f64) {
    (normal, surface(alpha).vndf([input[0], input[1], input[2]].into(), normal.into()))
}

pub(super) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let mut samplers = Samplers::new(effort, extreme);
    let surfaces = alphas().map(surface::<f32>);
    let pairs = alphas().map(widths::<f32>);
    let caps = |alpha, input| visible(alpha, input, ours(&surface(alpha), input));
    samplers.single("sample_vndf", VISIBLE, &surfaces, Ours, caps);
    samplers.single("caps as printed", VISIBLE, &pairs, Dupuy, caps);
    samplers.single("Heitz 2018", VISIBLE, &pairs, Heitz, |alpha, input| {
        visible(alpha, input, heitz(&widths(alpha), input))
    });
    samplers.single("all normals", ALL, &surfaces, All, |alpha, input| {
        let normal = all(&surface(alpha), input);
        (normal, surface(alpha).pdf_d(normal.into()))
    });
    samplers.double("sample_vndf", &alphas().map(surface::<f64>), Ours);
    samplers.double("caps as printed", &alphas().map(widths::<f64>), Dupuy);
    samplers.double("Heitz 2018", &alphas().map(widths::<f64>), Heitz);
    samplers.double("all normals", &alphas().map(surface::<f64>), All);
    samplers.report(out, "vndf_ggx", "GGX: visible normals")
}
