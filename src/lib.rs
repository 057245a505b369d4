//! Microfacet BSDF mathematics on the CPU, for f32 and f64: normal distributions with exact masking, seen through
//! any linear map of the tangent plane, their sampling, and the reflection built on them.
//!
//! ```
//! use microsurface::bsdf::RoughConductor;
//! use microsurface::fresnel::Conductor;
//! use microsurface::glam::{Vec2, Vec3};
//! use microsurface::{Ggx, RoughnessMatrix};
//!
//! // Gold, brushed at 30° to the tangent: α = 0.05 along the brushing, 0.3 across it.
//! let roughness = RoughnessMatrix::rotated(0.05, 0.3, 30_f32.to_radians())?;
//! let gold = Conductor::new(Vec3::new(0.14, 0.43, 1.38), Vec3::new(3.697, 2.455, 1.914))?;
//! let material = RoughConductor::new(Ggx::from_roughness_matrix(roughness), gold);
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
//! A microsurface is an isotropic slope profile `P` seen through a linear map `M` of the tangent plane,
//! [`Microsurface<P, M>`](Microsurface). Anisotropy, roughness matrices and transforms are all "another map", and the
//! type of the map is its cost: what a scene does not need is not computed, because the type is not there. The
//! projected area σ is the primitive from which masking, visible normals and the BRDF follow, so that nothing is
//! divided by a cosine; and nothing that a material fixes is computed again for a direction.
//!
//! # Choosing
//! | you want | take |
//! |---|---|
//! | the usual surface | [`Ggx`] |
//! | a Gaussian surface, exact under filtering and sums | [`Beckmann`] |
//! | the same, its visible normals in batches in half the time | [`BeckmannTo1e6`](beckmann::BeckmannTo1e6) |
//! | heavier or lighter tails | [`Gtr::isotropic`], at integer γ [`Gtr::closed`]; see [`gtr`] |
//! | the same roughness in every direction | `isotropic(alpha)` |
//! | two roughnesses along the axes | `anisotropic(alpha_x, alpha_y)` |
//! | roughness along any direction | `from_roughness_matrix` with a [`RoughnessMatrix`] |
//! | a surface that is stretched, sheared, deformed | [`Microsurface::transformed`], [`Microsurface::stretched`] |
//! | a deforming mesh, a map of the texture | [`transform::tension`], [`transform::jacobian_of_uv_map`] |
//! | a distribution of your own | implement [`Ndf`]; moved by [`transform::Transformed`] |
//! | α from an artist's roughness | [`roughness`] |
//! | highlights that do not shimmer | [`filter`] |
//! | reflection | [`bsdf::RoughConductor`] with a [`fresnel`] term |
//! | many directions at once | [`batch`] |
//! | GTR sampled as in its papers | [`bsdf::UniformMixture`] |
//!
//! # Conventions
//! Unit directions in the local frame, z up, all pointing away from the surface. Angles in radians. Random numbers in
//! [0, 1), 0 included. BSDFs come without the cosine. α is a slope width (never an artist's roughness), a roughness
//! matrix A is in units of α².
//!
//! | here | pbrt | Mitsuba | Heitz 2014 | Walter 2007 | Atanasov 2022 |
//! |---|---|---|---|---|---|
//! | `wo`, to the viewer | wo | wi | ωo | o (v in G1) | o |
//! | `wi`, to the light | wi | wo | ωi | i | i |
//! | `wm`, micronormal | wm | m | ωm | m | m |
//! | D, `d` | D | `eval` | D | D | D |
//! | Λ, `lambda` | Lambda | – | Λ | – | – |
//! | σ, `sigma` | – | – | cos θo/G1, §3 | – | – |
//! | G1, `g1` | G1 | `smith_g1`, of GGX | G1 | G1 | G1 |
//! | D_w, `vndf` | D(w, wm) | `pdf` with visible normals | D_ωo | – | D_v |
//! | α, `alpha` | alpha | alpha | α | α_b, α_g | α |
//! | A, [`RoughnessMatrix`] | – | – | – | – | – |
//! | M | – | – | – | – | M |
//!
//! Who ports from one of these meets four more differences:
//!
//! | here | there |
//! |---|---|
//! | `g1` of Beckmann is exact | Mitsuba's `smith_g1` of Beckmann is [`Microsurface::g1_walter2007`], off by up to 0.003 |
//! | `g2` is height-correlated, as in pbrt-v4 and MaterialX | `G` of Mitsuba and of adobe/openpbr-bsdf is [`Ndf::g2_separable`] |
//! | BSDFs come without the cosine, as in pbrt | `eval` of Mitsuba and of Falcor includes it |
//! | Λ(w) below the horizon is −1 − Λ(−w), so that G1 = 1/(1 + Λ) keeps its sign | Falcor's has the other sign |
//!
//! # Numbers
//! Constructors check and return [`Error`], which names the value; there is no silent clamp ([`roughness::clamped`] is
//! the explicit one). Evaluation never panics, allocates or fails (a [`batch`] panics where its slices differ in length): NaN gives NaN, and every function says what it
//! returns at the ends of its domain. Each function's accuracy is stated in units of ε, measured against 50-digit
//! values, and tested from both sides: tests fail when a stated bound is exceeded and when it is twice too wide.
//!
//! # Features
//! - `std` (default): square roots and constructor-time functions from the standard library.
//! - `libm`: the same from the `libm` crate. Needed without `std`; results are then the same bits on every platform.
//! - `serde`: materials written and read as named tables, checked as by the constructors: module `stored`.

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
pub mod bsdf;
pub mod elementary;
mod error;
pub mod filter;
pub mod frame;
pub mod fresnel;
mod ggx;
pub mod gtr;
pub mod map;
mod microsurface;
pub mod ndf;
pub mod profile;
pub mod real;
pub mod roughness;
#[cfg(feature = "serde")]
pub mod stored;
pub mod transform;
mod vector;

pub use glam;

pub use beckmann::Beckmann;
pub use error::Error;
pub use ggx::Ggx;
pub use gtr::Gtr;
pub use map::{AxisAligned, Isotropic, Linear, RoughnessMatrix};
pub use microsurface::Microsurface;
pub use ndf::{Ndf, SampleNdf, SampleVndf};
pub use real::Real;
