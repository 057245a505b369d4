//! Microfacet BSDF mathematics on the CPU, for f32 and f64: normal distributions with exact
//! masking, seen through any linear map of the tangent plane, their sampling, and the reflection
//! built on them.
//!
//! ```
//! use microsurface::bsdf::RoughConductor;
//! use microsurface::fresnel::Conductor;
//! use microsurface::glam::{Vec2, Vec3};
//! use microsurface::Ggx;
//!
//! // Gold, brushed at 30° to the tangent: α = 0.05 along the brushing, 0.3 across it.
//! let surface = Ggx::rotated(0.05, 0.3, 30_f32.to_radians())?;
//! let gold = Conductor::new(Vec3::new(0.14, 0.43, 1.38), Vec3::new(3.697, 2.455, 1.914))?;
//! let material = RoughConductor::new(surface, gold);
//!
//! // Directions are unit vectors of the shading frame, z along the normal, away from the surface.
//! let wo = Vec3::new(0.6, 0.0, 0.8);
//! if let Some(sample) = material.sample(wo, Vec2::new(0.3, 0.7)) {
//!     let f = material.eval(sample.wi, wo);
//!     assert!((sample.weight - f * sample.wi.z / sample.pdf).length() < 1e-5);
//! }
//! # Ok::<(), microsurface::Error>(())
//! ```
//!
//! # One idea
//! A microsurface is an isotropic slope profile `P` seen through a linear map `M` of the tangent
//! plane, [`Microsurface<P, M>`](Microsurface). Anisotropy, roughness matrices and transforms are
//! all "another map", and the type of the map is its cost: what a scene does not need is not
//! computed, because the type is not there. The projected area σ is the primitive from which
//! masking, visible normals and the BRDF follow, so that nothing is divided by a cosine; and
//! nothing that a material fixes is computed again for a direction.
//!
//! # Where to read on
//! The [`guide`]: [conventions](guide::conventions) and what pbrt, Mitsuba and the papers call
//! them, [choosing](guide::choosing) a distribution, [a path tracer](guide::path_tracer),
//! [shimmer](guide::shimmer), [deforming](guide::deforming) surfaces, [batches](guide::batches), a
//! distribution of [your own](guide::your_own), [accuracy](guide::accuracy), [costs](guide::costs).
//!
//! # Conventions
//! Unit directions in the local frame, z up, all pointing away from the surface. Angles in radians.
//! Random numbers in [0, 1), 0 included. BSDFs come without the cosine. α is a slope width, never
//! an artist's roughness.
//!
//! # Numbers
//! Constructors check and return [`Error`], which names parameter, value and range. Evaluation
//! never panics, allocates or fails; a [`batch`] panics where its slices differ in length. NaN
//! gives NaN. Each accuracy statement is the largest error that a search found, tested from both
//! sides.
//!
//! # Features
//! - `std` (default): square roots and constructor-time functions from the standard library.
//! - `libm`: the same from the `libm` crate. Needed without `std`; results are then the same bits
//!   on every platform.
//! - `alloc` (implied by `std`): distributions and Fresnel terms in `Box` and `Arc`.
//! - `serde`: materials written and read as named tables, checked as by the constructors: module
//!   `stored`.
//! - `verify`: a test kit for distributions and BSDFs of anybody; `proptest` adds its strategies.

#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

/// The README's example, as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod alpha;
pub mod batch;
pub mod beckmann;
mod blend;
pub mod bsdf;
pub mod elementary;
mod error;
pub mod filter;
pub mod frame;
pub mod fresnel;
mod ggx;
pub mod gtr;
pub mod guide;
pub mod map;
mod microsurface;
pub mod ndf;
pub mod profile;
pub mod real;
pub mod roughness;
#[cfg(feature = "serde")]
pub mod stored;
pub mod student_t;
pub mod transform;
mod vector;
#[cfg(feature = "verify")]
pub mod verify;

pub use glam;

pub use beckmann::Beckmann;
pub use blend::Blend;
pub use error::Error;
pub use ggx::Ggx;
pub use gtr::Gtr;
pub use map::{AxisAligned, Isotropic, Linear, RoughnessMatrix};
pub use microsurface::Microsurface;
pub use ndf::{Ndf, SampleNdf, SampleVndf};
pub use real::Real;
pub use student_t::StudentT;
