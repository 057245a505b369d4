//! The choice of distribution, map and function.
//!
//! | you want | take |
//! |---|---|
//! | the usual surface | [`Ggx`](crate::Ggx) |
//! | a Gaussian surface, exact under filtering and sums | [`Beckmann`](crate::Beckmann) |
//! | the same, with faster visible normals in batches | [`BeckmannTo1e6`](crate::beckmann::BeckmannTo1e6) |
//! | heavier or lighter tails | [`Gtr::isotropic`](crate::Gtr::isotropic), at integer γ [`Gtr::closed`](crate::Gtr::closed); see [`gtr`](crate::gtr) |
//! | a tail fitted to measured slopes, between GGX's and Beckmann's or heavier | [`StudentT`](crate::StudentT), which stays one when stretched |
//! | Phong's power of the cosine | [`student_t::Phong`](crate::student_t::Phong) |
//! | two lobes on one surface, haze | [`Blend`](crate::Blend) |
//! | the same roughness in every direction | `isotropic(alpha)` |
//! | two roughnesses along the axes | `anisotropic(alpha_x, alpha_y)` |
//! | roughness along any direction | `rotated(alpha_x, alpha_y, angle)`, or `from_roughness_matrix` |
//! | a surface that is stretched, sheared, deformed | [`deforming`](super::deforming) |
//! | α from an artist's roughness | [`roughness`](crate::roughness) |
//! | highlights that do not shimmer | [`shimmer`](super::shimmer) |
//! | reflection | [`RoughConductor`](crate::bsdf::RoughConductor) with a [`fresnel`](crate::fresnel) term |
//! | many directions at once | [`batches`](super::batches) |
//! | a distribution of your own | [`your_own`](super::your_own) |
//! | GTR sampled as in its papers | [`UniformMixture`](crate::bsdf::UniformMixture) |
//!
//! The tail makes the difference: how fast D falls, here from its peak, all of α = 0.1. `cargo run
//! --release --example tour` renders the same on spheres.
#![doc = include_str!("../../docs/lobes.svg")]
//!
//! # Different materials in one table
//! Under the most general map all surfaces of a distribution have one type.
//! ```
//! use microsurface::{Ggx, Linear, Microsurface};
//! let table: [Microsurface<Ggx, Linear<f32>>; 3] = [
//!     Ggx::isotropic(0.2)?.into(),
//!     Ggx::anisotropic(0.1, 0.4)?.into(),
//!     Ggx::rotated(0.1, 0.4, 0.5)?,
//! ];
//! # let _ = table;
//! # Ok::<(), microsurface::Error>(())
//! ```
//! For different distributions take an enum of yours, or `Box<dyn SampleVndf<Scalar = f32>>`, which
//! is a distribution itself (feature `alloc`):
//! ```
//! use microsurface::bsdf::RoughConductor;
//! use microsurface::{Beckmann, Ggx, Gtr, SampleVndf, fresnel::Schlick, glam::{Vec2, Vec3}};
//! type Surface = Box<dyn SampleVndf<Scalar = f32>>;
//! let surfaces: [Surface; 3] = [
//!     Box::new(Ggx::isotropic(0.2)?),
//!     Box::new(Beckmann::anisotropic(0.1, 0.4)?),
//!     Box::new(Gtr::isotropic(0.2, 1.5)?),
//! ];
//! let f0 = Schlick::new(0.9_f32)?;
//! let materials = surfaces.map(|surface| RoughConductor::new(surface, f0));
//! let wo = Vec3::new(0.6, 0.0, 0.8);
//! assert!(materials.iter().all(|material| material.sample(wo, Vec2::new(0.3, 0.7)).is_some()));
//! # Ok::<(), microsurface::Error>(())
//! ```
