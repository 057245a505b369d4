//! Any function of each element.

use crate::batch::blocks::{Body, Sink, Source, check, each};
use crate::batch::dispatch::{Kernel, run};

/// `f` of every element, compiled for each level of the instruction set like every batch: for what has no entry point of its
/// own, such as mixtures of BSDFs, filters, and the [`elementary`](crate::elementary) functions.
///
/// Where `f` is straight-line code, as most of the crate is, the loop becomes vector code.
///
/// # Panics
/// Where slices differ in length; nothing has been written then. Where `f` panics.
///
/// # Example
/// The roughness that a deferred renderer stores for a pixel, and a BRDF averaged over its footprint.
/// ```
/// use microsurface::batch::{self, Directions, Footprints};
/// use microsurface::filter::{Footprint, deferred::{self, Bound, Kernel}};
/// use microsurface::{Ggx, bsdf::RoughConductor, fresnel::Schlick};
/// let footprints = Footprints { du_x: &[0.1_f32, 0.0], du_y: &[0.0, 0.1], dv_x: &[0.0, 0.1], dv_y: &[0.1, 0.0] };
/// let footprint = |[ux, uy, vx, vy]: [f32; 4]| Footprint::<f32>::new([ux, uy].into(), [vx, vy].into());
/// let kernel = Kernel::tokuyoshi2021();
/// let mut alpha = [0.0; 2];
/// batch::map((&[0.01, 0.2][..], footprints), &mut alpha[..], |(alpha, steps)| {
///     deferred::isotropic(alpha, footprint(steps), &kernel, Bound::Upper)
/// });
/// assert!(alpha[0] > 0.01 && alpha[1] > 0.2);
///
/// let chrome = RoughConductor::new(Ggx::isotropic(0.01_f32)?, Schlick::new(0.6_f32));
/// let wi = Directions { x: &[-0.6; 2], y: &[0.0; 2], z: &[0.8; 2] };
/// let wo = Directions { x: &[0.6; 2], y: &[0.0; 2], z: &[0.8; 2] };
/// let mut f = [0.0; 2];
/// batch::map((wi, wo, footprints), &mut f[..], |(wi, wo, steps)| {
///     chrome.eval_over(wi.into(), wo.into(), &footprint(steps))
/// });
/// assert!(f[0] > 0.0 && f[0] < chrome.eval([-0.6, 0.0, 0.8].into(), [0.6, 0.0, 0.8].into()));
/// # Ok::<(), microsurface::Error>(())
/// ```
#[inline]
pub fn map<I: Source, O: Sink>(input: I, output: O, f: impl Fn(I::Item) -> O::Item) {
    check((), input, &output);
    run(Map { f, input, output });
}

struct Map<F, I, O> {
    f: F,
    input: I,
    output: O,
}

/// The body of a function alone.
struct Of<F>(F);

impl<F: Fn(I) -> O, I, O> Body<(), I> for Of<F> {
    type Out = O;
    #[inline(always)]
    fn of(&self, (): &(), input: I) -> O {
        (self.0)(input)
    }
}

impl<F: Fn(I::Item) -> O::Item, I: Source, O: Sink> Kernel for Map<F, I, O> {
    #[inline(always)]
    fn run(self) {
        each((), |()| (), &Of(self.f), self.input, self.output);
    }
}
