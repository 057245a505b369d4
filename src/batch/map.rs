//! Any function of each element.

use crate::batch::blocks::{Sink, Source};
use crate::batch::material::{Shared, each_built};
use crate::batch::stages::{Body, without_normals};

/// `f` of every element, compiled for each level of the instruction set like every batch: for what
/// has no entry point of its own, such as mixtures of BSDFs, filters, and the
/// [`elementary`](crate::elementary) functions.
///
/// Where `f` is straight-line code, as most of the crate is, the loop becomes vector code; of a
/// large closure take [`map_inlined`]. Means over footprints choose between several forms and
/// remain scalar.
///
/// # Panics
/// Where slices differ in length; nothing has been written then. Where `f` panics.
///
/// # Example
/// The roughness that a deferred renderer stores for a pixel, and a BRDF averaged over its
/// footprint.
/// ```
/// use microsurface::batch::{self, Directions, Footprints};
/// use microsurface::filter::{Footprint, deferred::{self, Bound, Kernel}};
/// use microsurface::{Ggx, bsdf::RoughConductor, fresnel::Schlick};
/// let footprints = Footprints {
///     du_x: &[0.1_f32, 0.0],
///     du_y: &[0.0, 0.1],
///     dv_x: &[0.0, 0.1],
///     dv_y: &[0.1, 0.0],
/// };
/// let footprint = |[ux, uy, vx, vy]: [f32; 4]| Footprint::new([ux, uy], [vx, vy]);
/// let kernel = Kernel::tokuyoshi2021();
/// let mut alpha = [0.0; 2];
/// batch::map((&[0.01, 0.2][..], footprints), &mut alpha[..], |(alpha, steps)| {
///     deferred::isotropic(alpha, footprint(steps), &kernel, Bound::Upper)
/// });
/// assert!(alpha[0] > 0.01 && alpha[1] > 0.2);
///
/// let chrome = RoughConductor::new(Ggx::isotropic(0.01_f32)?, Schlick::new(0.6_f32)?);
/// let wi = Directions { x: &[-0.6; 2], y: &[0.0; 2], z: &[0.8; 2] };
/// let wo = Directions { x: &[0.6; 2], y: &[0.0; 2], z: &[0.8; 2] };
/// let mut f = [0.0; 2];
/// batch::map((wi, wo, footprints), &mut f[..], |(wi, wo, steps)| {
///     chrome.eval_over(wi.into(), wo.into(), footprint(steps))
/// });
/// assert!(f[0] > 0.0 && f[0] < chrome.eval([-0.6, 0.0, 0.8].into(), [0.6, 0.0, 0.8].into()));
/// # Ok::<(), microsurface::Error>(())
/// ```
#[inline]
pub fn map<I: Source, O: Sink>(input: I, output: O, f: impl Fn(I::Item) -> O::Item) {
    struct Closure<F>(F);
    impl<F: Fn(I) -> Out, I, Out> Function<I> for Closure<F> {
        type Out = Out;
        #[inline(always)]
        fn of(&self, input: I) -> Out {
            self.0(input)
        }
    }
    map_inlined(input, output, Closure(f));
}

/// A function of an element, for [`map_inlined`].
pub trait Function<I> {
    /// The type of its value.
    type Out;
    /// Its value; to be marked `#[inline(always)]`.
    fn of(&self, input: I) -> Self::Out;
}

/// [`map()`] of a function that is no closure: of a large closure nothing makes sure that it
/// becomes part of the loop, and where it stays a call the loop is scalar.
///
/// # Panics
/// As [`map()`].
///
/// # Example
/// ```
/// use microsurface::batch::{self, Function};
/// use microsurface::elementary::{erfc, exp};
/// struct Scaled(f32);
/// impl Function<f32> for Scaled {
///     type Out = f32;
///     #[inline(always)]
///     fn of(&self, x: f32) -> f32 {
///         exp(self.0 * x) * erfc(x)
///     }
/// }
/// let mut y = [0.0; 3];
/// batch::map_inlined(&[0.0, 1.0, 2.0][..], &mut y[..], Scaled(0.5));
/// assert_eq!(y[1], exp(0.5_f32) * erfc(1.0_f32));
/// ```
#[inline]
pub fn map_inlined<I: Source, O: Sink>(input: I, output: O, f: impl Function<I::Item, Out = O::Item>) {
    each_built((), Shared(&()), Alone(f), input, output);
}

/// A function that needs no material.
struct Alone<F>(F);

impl<F: Function<I>, I> Body<(), I> for Alone<F> {
    type Out = F::Out;
    without_normals!((), I, f32);
    #[inline(always)]
    fn result(&self, (): &(), input: I, _: [f32; 3]) -> F::Out {
        self.0.of(input)
    }
}
