//! Filtering of distributions: the highlight of a pixel instead of that of a point.
//!
//! Across a pixel the half vector moves over the slopes of the microsurface, by the curvature of the surface and by the
//! directions to the eye and the light. Where that is more than the slopes' own width α, one sample misses the
//! highlight or finds all of it: it shimmers. A filter averages the distribution over what the half vector covers.
//!
//! **1. What does the half vector cover?** A [`Footprint`], the steps of the half vector per pixel, in slopes or in the
//! projected space of m.xy: from derivatives ([`jacobian::HalfVector`]), of rays ([`ray::RayDifferential`]) or of pixels
//! ([`quad::Quad`]).
//!
//! **2. Which filter?**
//!
//! | filter | exact for | what it costs |
//! |---|---|---|
//! | [`Microsurface::filtered`](crate::Microsurface::filtered): A + 2Σ | Beckmann ⊛ Gaussian | a map; evaluation as of any surface |
//! | [`projected::filtered`] | – ; has no artefacts at grazing angles | the same |
//! | [`gaussian::filtered`] | GGX ⊛ Gaussian to a few per cent, its tail kept | a GGX and a Beckmann |
//! | [`polygon::mean_p22`] | every profile with closed forms, over the parallelogram of the footprint | four arcus tangents |
//! | [`rectangle::mean_p22`] | the same over a box, and Beckmann | the same; Beckmann: error functions |
//! | [`deferred`] | – ; one number per pixel, before any light is known | a few products |
//! | [`normal_map`] | what lies below the pixel in a texture, as one more Σ | lookups |
//!
//! **3. Is it needed?** [`Microsurface::change_by_filter`](crate::Microsurface::change_by_filter) and
//! [`change_by_filter_at`](crate::Microsurface::change_by_filter_at) bound what is lost without.
//!
//! # Units
//! Slopes are tangents of angles, dimensionless; a footprint is in slopes per pixel, a [`Covariance`] Σ in slopes², and a
//! roughness matrix A, in units of α², is twice the covariance of a Gaussian surface: hence A + 2Σ.
//!
//! # References
//! Kaplanyan, Hill, Patney and Lefohn 2016, "Filtering distributions of normals for shading antialiasing"; Tokuyoshi
//! 2017, "Error reduction and simplification for shading anti-aliasing"; Tokuyoshi and Kaplanyan 2019, "Improved geometric
//! specular antialiasing", and 2021, "Stable geometric specular antialiasing with projected-space NDF filtering",
//! JCGT 10(2).

mod aligned;
pub mod covariance;
pub mod deferred;
mod footprint;
pub mod jacobian;
pub mod normal_map;
pub mod polygon;
pub mod projected;
pub mod quad;
pub mod ray;
pub mod rectangle;

pub use covariance::Covariance;
pub use footprint::Footprint;
