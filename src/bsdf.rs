//! Scattering functions built on a microsurface.
//!
//! All return f without the cosine: reflected radiance is ∫ f L(wi) wi.z dwi. Directions are unit
//! vectors of the local frame that point away from the surface.

mod conductor;
mod mixture;
mod sampling;

pub use conductor::RoughConductor;
pub use mixture::UniformMixture;
pub(crate) use sampling::StagedSampling;
pub use sampling::{AllNormals, NormalSampling, VisibleNormals};

use crate::Real;

/// A sampled direction.
///
/// # Accuracy
/// `pdf` is the density at the direction before `wi` was rounded to its scalar. `pdf(wi, wo)` is
/// that at the rounded one, which the lobe of a smooth surface tells apart. Largest deviations of
/// their ratio from 1 found for GGX, views uniform over the hemisphere:
///
/// | α | f32: median | 99 of 100 | largest | f64: median | largest |
/// |---|---|---|---|---|---|
/// | 0.3 | 1.1e-7 | 5e-7 | 5e-6 | 2.2e-16 | 2e-14 |
/// | 0.1 | 1.9e-7 | 2e-6 | 3e-5 | 3.3e-16 | 8e-14 |
/// | 0.01 | 1.4e-6 | 6e-5 | 2e-3 | 2.7e-15 | 5e-12 |
/// | 1e-3 | 1.4e-5 | 1e-3 | 0.1 | 2.6e-14 | 3e-10 |
/// | 1e-4 | 1.4e-4 | 1e-2 | 5 | 2.6e-13 | 1e-8 |
///
/// So the sampled side of multiple importance sampling takes `pdf` and `weight` of the sample, and
/// does not evaluate them again. The light's side has a direction of its own and calls `pdf(wi,
/// wo)`. Below α = 1e-3 in f32 the two are so different that a mirror, or f64, is the better model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<T: Real, S> {
    /// The direction to the light, a unit vector above the horizon.
    pub wi: T::Vec3,
    /// f(wi, wo) wi.z / pdf: what the path's throughput is multiplied by.
    pub weight: S,
    /// The density of `wi`, 1/sr; the BSDF's `pdf(wi, wo)` but for the rounding of `wi`.
    pub pdf: T,
}
