//! A distribution of your own: two functions, and the rest follows.
//!
//! Implement [`Ndf`](crate::Ndf): D(wm), and the projected area σ(w) = ∫ D(wm) max(0, w·wm) dwm on
//! the whole sphere. G1, G2, Λ and the density of visible normals follow from them, and so does
//! [`RoughConductor::eval`](crate::bsdf::RoughConductor::eval).
//! ```
//! use microsurface::bsdf::{AllNormals, RoughConductor};
//! use microsurface::glam::{Mat2, Vec2, Vec3};
//! use microsurface::{Ndf, SampleNdf, fresnel::Schlick, transform::Transformed};
//! /// Facets of equal area in all directions of the hemisphere.
//! #[derive(Clone, Copy)]
//! struct Uniform;
//! impl Ndf for Uniform {
//!     type Scalar = f32;
//!     fn d(&self, wm: Vec3) -> f32 {
//!         if wm.z < 0.0 { 0.0 } else { core::f32::consts::FRAC_1_PI }
//!     }
//!     fn sigma(&self, w: Vec3) -> f32 {
//!         0.5 * (w.z + w.length())
//!     }
//! }
//! impl SampleNdf for Uniform {
//!     /// Density D cos θ: a point of the unit disk, raised onto the sphere.
//!     fn sample_d(&self, u: Vec2) -> Vec3 {
//!         (Vec2::from_angle(core::f32::consts::TAU * u.y) * u.x.sqrt()).extend((1.0 - u.x).sqrt())
//!     }
//! }
//! let metal = RoughConductor::new(Uniform, Schlick::new(0.9_f32)?).sampled_by(AllNormals);
//! let wo = Vec3::new(0.6, 0.0, 0.8);
//! if let Some(sample) = metal.sample(wo, Vec2::new(0.3, 0.7)) {
//!     let f = metal.eval(sample.wi, wo);
//!     assert!((f * sample.wi.z / sample.pdf - sample.weight).abs() < 1e-5);
//! }
//! // Drawn out to twice its length along x.
//! let drawn = Transformed::new(Uniform, Mat2::from_diagonal(Vec2::new(2.0, 1.0)))?;
//! assert!(drawn.d(Vec3::Z) > 0.0);
//! # Ok::<(), microsurface::Error>(())
//! ```
//! | you add | you get |
//! |---|---|
//! | [`Ndf`](crate::Ndf) | evaluation; [`Transformed`](crate::transform::Transformed); batches by [`Custom`](crate::batch::Custom) |
//! | [`SampleNdf`](crate::SampleNdf) | `sample` with [`AllNormals`](crate::bsdf::AllNormals) |
//! | [`SampleVndf`](crate::SampleVndf) | `sample` with visible normals |
//! | [`Profile`](crate::profile::Profile) instead, for an isotropic slope profile | all three maps and transforms; batches by [`Custom`](crate::batch::Custom) |
//!
//! Override [`lambda`](crate::Ndf::lambda) only for speed: its default does not cancel if σ below
//! the horizon does not.
