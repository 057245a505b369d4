//! Scattering functions built on a microsurface.
//!
//! All return f without the cosine: reflected radiance is ∫ f L(wi) wi.z dwi. Directions are unit vectors of the
//! local frame that point away from the surface.

mod conductor;
mod mixture;
mod sampling;

pub use conductor::RoughConductor;
pub use mixture::UniformMixture;
pub use sampling::{AllNormals, NormalSampling, VisibleNormals};

use crate::Real;

/// A sampled direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<T: Real, S> {
    /// The direction to the light, a unit vector above the horizon.
    pub wi: T::Vec3,
    /// f(wi, wo) wi.z / pdf: what the path's throughput is multiplied by.
    pub weight: S,
    /// The density of `wi`, 1/sr; the same number as the BSDF's `pdf(wi, wo)` to rounding.
    pub pdf: T,
}
