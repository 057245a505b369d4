//! GTR: mixtures with their components kept and made for each sample, and closed forms.
//!
//! The map jumps from component to component, and beside a jump rounding chooses the neighbour,
//! whose normals are as good but elsewhere: the worst error is that of a jump and tells nothing,
//! the root of the mean square tells how seldom they are. Random numbers are uniform here: at their
//! ends a few ulps of u.x hold whole components.

use std::io::{self, Write};

use microsurface::gtr::Gtr;
use microsurface::profile::SampleVisibleProfile;
use microsurface::{Isotropic, Microsurface, Ndf, Real, SampleVndf};

use super::{Input, Samplers, VISIBLE, alphas, usual};
use crate::Effort;
use crate::blocks::call;

#[inline(always)]
fn sample<T: Real, P: SampleVisibleProfile<T>>(
    surface: &Microsurface<P, Isotropic<T>>,
    [x, y, z, u1, u2]: Input<T>,
) -> [T; 3] {
    surface.sample_vndf([x, y, z].into(), [u1, u2].into()).into()
}

call!(Sample<T: Real, P: SampleVisibleProfile<T>>: (Microsurface<P, Isotropic<T>>), 5 => 3, sample);

/// The reference, once: it is long.
#[inline(never)]
fn exact<P: SampleVisibleProfile<f64>>(
    surface: &Microsurface<P, Isotropic<f64>>,
    input: Input<f64>,
) -> ([f64; 3], f64) {
    let normal = sample(surface, input);
    (normal, surface.vndf([input[0], input[1], input[2]].into(), normal.into()))
}

/// Adds a kind of surface.
fn gtr<P: SampleVisibleProfile<f32> + 'static, Q: SampleVisibleProfile<f64> + 'static>(
    samplers: &mut Samplers,
    name: &str,
    single: impl Fn(f32) -> Option<Microsurface<P, Isotropic<f32>>>,
    double: impl Fn(f64) -> Option<Microsurface<Q, Isotropic<f64>>>,
) {
    let singles = alphas().map(|alpha| single(alpha).expect("a width"));
    let widened = alphas::<f32>().map(|alpha| (f64::from(alpha), double(alpha.into()).expect("a width")));
    samplers.single(name, VISIBLE, &singles, Sample, |alpha, input| {
        let nearest = widened.iter().min_by(|a, b| (a.0 - alpha).abs().total_cmp(&(b.0 - alpha).abs()));
        exact(&nearest.expect("one of them").1, input)
    });
    samplers.double(name, &widened.map(|(_, surface)| surface), Sample);
}

pub(super) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let mut samplers = Samplers::new(effort, usual);
    for gamma in [0.7_f32, 1.5, 2.5, 3.4] {
        gtr(
            &mut samplers,
            &format!("mixture, γ = {gamma}"),
            |alpha| Gtr::isotropic(alpha, gamma).ok(),
            |alpha| Gtr::isotropic(alpha, gamma.into()).ok(),
        );
    }
    gtr(
        &mut samplers,
        "made each time, γ = 1.5",
        |alpha| Gtr::heavy_tailed::<8>(alpha, 1.5).ok(),
        |alpha| Gtr::heavy_tailed::<8>(alpha, 1.5).ok(),
    );
    gtr(
        &mut samplers,
        "closed, γ = 3",
        |alpha| Gtr::closed::<3>(alpha).ok(),
        |alpha| Gtr::closed::<3>(alpha).ok(),
    );
    samplers.report(out, "vndf_gtr", "GTR: visible normals")
}
