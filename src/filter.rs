//! Filtering of distributions: the highlight of a pixel instead of that of a point.
//!
//! Across a pixel the half vector moves over the slopes of the microsurface, by the curvature of
//! the surface and by the directions to the eye and the light. Where that is more than the slopes'
//! own width α, one sample misses the highlight or finds all of it: it shimmers. A filter averages
//! the distribution over what the half vector covers.
//!
//! **1. What does the half vector cover?** A [`Footprint`], the steps of the half vector per pixel,
//! in slopes or in the projected space of m.xy: from derivatives ([`jacobian::HalfVector`]), of
//! rays ([`ray::RayDifferential`]) or of pixels ([`quad::Quad`]).
//!
//! **2. Which filter?**
//!
//! | filter | exact for | what it costs |
//! |---|---|---|
//! | [`Microsurface::filtered`](crate::Microsurface::filtered): A + 2Σ | Beckmann ⊛ Gaussian; **GGX: may be worse than no filter**, see below | a map; evaluation as of any surface |
//! | [`projected::filtered`] | – ; has no artefacts at grazing angles | the same |
//! | [`gaussian::filtered`] | GGX ⊛ Gaussian to 2 %, its tail kept | a GGX and six Beckmann surfaces, or [one](gaussian::filtered_by_two) |
//! | [`polygon::mean_p22`] | a box filter of the pixel, every profile; no artefacts at grazing angles | four arcus tangents |
//! | [`RoughConductor::eval_over`](crate::bsdf::RoughConductor::eval_over) | the same in a BRDF | |
//! | [`rectangle::mean_p22`] | the same over a box, and Beckmann | the same; Beckmann: error functions |
//! | [`deferred`] | – ; one number per pixel, before any light is known | a few products |
//! | [`normal_map`] | what lies below the pixel in a texture, as one more Σ | lookups |
//!
//! A + 2Σ of GGX widens the tail with the peak, and the tail is everywhere: 3 times too bright
//! where the kernel is as wide as α, 9 times where it is twice as wide. On a ball of α = 0.02, lit
//! by one light, the root mean square error of r/(1 + r) is 35 times that of no filter; by
//! [`gaussian::filtered`] it is a sixth of it, by [`polygon::mean_p22`] a thirtieth
//! (`tests/it/filter/ball.rs`). Take one of these two for GGX where highlights are smaller than
//! pixels.
//!
//! **3. Is it needed?** [`Microsurface::change_by_filter`](crate::Microsurface::change_by_filter)
//! and [`change_by_filter_at`](crate::Microsurface::change_by_filter_at) bound what is lost
//! without.
//!
//! Many pixels at once, as structures of arrays: [`batch::Varied`](crate::batch::Varied) by
//! [`Filtered`](crate::batch::Filtered) or [`FilteredProjected`](crate::batch::FilteredProjected),
//! and [`batch::map`](crate::batch::map()) for all others.
//!
//! # Example
//! One pixel, from the camera's ray to radiance: a ball of polished metal, lit by a point.
//! ```
//! use microsurface::bsdf::RoughConductor;
//! use microsurface::filter::jacobian::{Curvature, HalfVector, Motion};
//! use microsurface::filter::ray::RayDifferential;
//! use microsurface::{Ggx, frame::Frame, fresnel::Schlick, glam::Vec3};
//! let metal = RoughConductor::new(Ggx::isotropic(0.01_f32)?, Schlick::new(0.9_f32)?);
//! let (eye, light) = (Vec3::new(0.0, 0.0, 5.0), Vec3::new(0.3, 0.0, 6.0));
//! // The ray hits the pole of the unit ball about the origin.
//! let (point, normal, distance) = (Vec3::Z, Vec3::Z, 4.0);
//! let frame = Frame::from_normal(normal);
//! // How far the point moves per pixel, and how the normal turns with it.
//! let ray = RayDifferential::pinhole(-Vec3::Z, Vec3::X / 100.0, Vec3::Y / 100.0);
//! let [du, dv] = ray.onto_plane(-Vec3::Z, distance, normal).map(|point| {
//!     let normal = Curvature::sphere(1.0).normal_step(&frame, point);
//!     Motion { point, normal, ..Motion::default() }
//! });
//! let half = HalfVector::new(&frame, point, eye, light);
//! let footprint = half.slope_footprint(&du, &dv).clamped(1.0);
//! // What eval finds at the centre of the pixel, and what there is in the pixel.
//! let [wi, wo] = [light, eye].map(|end| frame.to_local((end - point).normalize()));
//! let (at_centre, in_pixel) = (metal.eval(wi, wo), metal.eval_over(wi, wo, footprint));
//! assert!(at_centre < in_pixel && in_pixel < 0.9 / (4.0 * core::f32::consts::PI * 0.01 * 0.01));
//! # Ok::<(), microsurface::Error>(())
//! ```
//!
//! # Units
//! Slopes are tangents of angles, dimensionless; a footprint is in slopes per pixel, a
//! [`Covariance`] Σ in slopes², and a roughness matrix A, in units of α², is twice the covariance
//! of a Gaussian surface: hence A + 2Σ.
//!
//! # References
//! Kaplanyan, Hill, Patney and Lefohn 2016, "Filtering distributions of normals for shading
//! antialiasing"; Tokuyoshi 2017, "Error reduction and simplification for shading anti-aliasing";
//! Tokuyoshi and Kaplanyan 2019, "Improved geometric specular antialiasing", and 2021, "Stable
//! geometric specular antialiasing with projected-space NDF filtering", JCGT 10(2).

pub mod deferred;
mod footprint;
pub mod gaussian;
mod means;
pub mod normal_map;
pub mod projected;
mod widened;

pub use footprint::{Covariance, Footprint, covariance, jacobian, quad, ray};
pub use means::{MeanOverParallelogram, polygon, rectangle};
pub use widened::determinant_tokuyoshi2019;
