//! Beckmann: the slope along the view by one step of high order, and by Newton's method as
//! renderers have it.
//!
//! All invert the same distribution, so that one f64 inversion is the reference of all; what a
//! tolerance leaves is an error as rounding is.

use std::io::{self, Write};

use microsurface::beckmann::BeckmannTo1e6;
use microsurface::elementary::{erf, erf_inv};
use microsurface::profile::SampleVisibleProfile;
use microsurface::{Beckmann, Isotropic, Microsurface, Ndf, Real, SampleNdf, SampleVndf};

use super::{ALL, Input, Samplers, VISIBLE, alphas, extreme};
use crate::Effort;
use crate::blocks::call;
use crate::elementary::fits::{erf_hastings, erf_inv_giles};
use crate::textbook::{Elementary, Width, beckmann};

fn quick<T: Real>(alpha: T) -> Microsurface<BeckmannTo1e6, Isotropic<T>> {
    BeckmannTo1e6::isotropic(alpha).expect("a width")
}

fn surface<T: Real>(alpha: T) -> Microsurface<Beckmann, Isotropic<T>> {
    Beckmann::isotropic(alpha).expect("a width")
}

#[inline(always)]
fn ours<T: Real, P: SampleVisibleProfile<T>>(
    surface: &Microsurface<P, Isotropic<T>>,
    [x, y, z, u1, u2]: Input<T>,
) -> [T; 3] {
    surface.sample_vndf([x, y, z].into(), [u1, u2].into()).into()
}

#[inline(always)]
fn all<T: Real>(surface: &Microsurface<Beckmann, Isotropic<T>>, [.., u1, u2]: Input<T>) -> [T; 3] {
    surface.sample_d([u1, u2].into()).into()
}

#[inline(always)]
fn jakob<T: Elementary>(&width: &Width<T>, [x, y, z, u1, u2]: Input<T>) -> [T; 3] {
    beckmann::visible_normal_jakob2014(width, [x, y, z], [u1, u2], erf, erf_inv)
}

/// With the error functions of pbrt-v3.
#[inline(always)]
fn jakob_of_fits<T: Elementary>(&width: &Width<T>, [x, y, z, u1, u2]: Input<T>) -> [T; 3] {
    beckmann::visible_normal_jakob2014(width, [x, y, z], [u1, u2], erf_hastings, erf_inv_giles)
}

#[inline(always)]
fn mitsuba<T: Elementary>(&width: &Width<T>, [x, y, z, u1, u2]: Input<T>) -> [T; 3] {
    beckmann::visible_normal_mitsuba(width, [x, y, z], [u1, u2])
}

call!(Ours<T: Real>: (Microsurface<Beckmann, Isotropic<T>>), 5 => 3, ours);
call!(Quick<T: Real>: (Microsurface<BeckmannTo1e6, Isotropic<T>>), 5 => 3, ours);
call!(All<T: Real>: (Microsurface<Beckmann, Isotropic<T>>), 5 => 3, all);
call!(Jakob<T: Elementary>: (Width<T>), 5 => 3, jakob);
call!(JakobOfFits<T: Elementary>: (Width<T>), 5 => 3, jakob_of_fits);
call!(Mitsuba<T: Elementary>: (Width<T>), 5 => 3, mitsuba);

/// The reference, once: it is long.
#[inline(never)]
fn exact(alpha: f64, input: Input<f64>) -> ([f64; 3], f64) {
    let normal = ours(&surface(alpha), input);
    (normal, surface(alpha).vndf([input[0], input[1], input[2]].into(), normal.into()))
}

pub(super) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let mut samplers = Samplers::new(effort, extreme);
    let surfaces = alphas().map(surface::<f32>);
    let widths = alphas().map(Width::<f32>::new);
    samplers.single("sample_vndf", VISIBLE, &surfaces, Ours, exact);
    samplers.single("to 1e-6", VISIBLE, &alphas().map(quick::<f32>), Quick, exact);
    samplers.single("Jakob 2014", VISIBLE, &widths, Jakob, exact);
    samplers.single("Jakob 2014, pbrt-v3's erf", VISIBLE, &widths, JakobOfFits, exact);
    samplers.single("Mitsuba", VISIBLE, &widths, Mitsuba, exact);
    samplers.single("all normals", ALL, &surfaces, All, |alpha, input| {
        let normal = all(&surface(alpha), input);
        (normal, surface(alpha).pdf_d(normal.into()))
    });
    let surfaces = alphas().map(surface::<f64>);
    let widths = alphas().map(Width::<f64>::new);
    samplers.double("sample_vndf", &surfaces, Ours);
    samplers.double("Jakob 2014", &widths, Jakob);
    samplers.double("Mitsuba", &widths, Mitsuba);
    samplers.double("all normals", &surfaces, All);
    samplers.report(out, "vndf_beckmann", "Beckmann: visible normals")
}
