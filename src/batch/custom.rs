//! Distributions of a user's own in batches.

use crate::ndf::forwarded::forwarded;
use crate::ndf::staged::{Forms, StagedVndf};
use crate::ndf::{Ndf, SampleNdf, SampleVndf, Vec2, Vec3};

/// A distribution of your own, as a material of batches: any [`Ndf`] that is `Copy`, or a reference
/// to one that is not.
///
/// # Example
/// ```
/// use microsurface::batch::{Custom, Directions, NdfBatch};
/// use microsurface::{Ggx, Ndf, glam::Vec3};
/// /// Facets of equal area in all directions of the hemisphere.
/// #[derive(Clone, Copy)]
/// struct Uniform;
/// impl Ndf for Uniform {
///     type Scalar = f32;
///     fn d(&self, wm: Vec3) -> f32 {
///         if wm.z < 0.0 { 0.0 } else { core::f32::consts::FRAC_1_PI }
///     }
///     fn sigma(&self, w: Vec3) -> f32 {
///         0.5 * (w.z + w.length())
///     }
/// }
/// let mut sigma = [0.0; 2];
/// let w = Directions { x: &[0.0, 0.6], y: &[0.0, 0.0], z: &[1.0, 0.8] };
/// Custom(Uniform).sigma_batch(w, &mut sigma);
/// assert_eq!(sigma[1], Uniform.sigma(Vec3::new(0.6, 0.0, 0.8)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Custom<N>(pub N);

forwarded!([N] Custom<N>, |this| this.0);

impl<N: Ndf + Copy> Forms for Custom<N> {}

impl<N: SampleVndf + Copy> StagedVndf for Custom<N> {
    const STRAIGHT: bool = true;
    type Solver = ();

    #[inline(always)]
    fn ask(&self, _: Vec3<Self>, _: Vec2<Self>) {}

    #[inline(always)]
    fn normal(&self, w: Vec3<Self>, u: Vec2<Self>, (): ()) -> (Vec3<Self>, bool) {
        (self.0.sample_vndf(w, u), true)
    }

    #[inline(always)]
    fn sample_of_along(&self, along: Vec3<Self>) -> Vec3<Self> {
        along
    }
}
