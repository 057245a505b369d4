//! A material in a path tracer: frames, multiple importance sampling, textures, two sides.
//!
//! # One bounce
//! ```
//! use microsurface::bsdf::RoughConductor;
//! use microsurface::{Ggx, frame::Frame, fresnel::Schlick, glam::{Vec2, Vec3}};
//! let f0 = Schlick::new(Vec3::new(1.0, 0.78, 0.34))?;
//! let material = RoughConductor::new(Ggx::isotropic(0.2_f32)?, f0);
//! let (to_viewer, to_lamp) = (Vec3::new(0.6, 0.8, 0.0), Vec3::new(0.0, 0.6, 0.8));
//! let frame = Frame::from_normal(Vec3::Y);
//! let wo = frame.to_local(to_viewer);
//! // The lamp's own sample: f times the cosine, weighed against the density of the other way.
//! let (wi, pdf_of_lamp) = (frame.to_local(to_lamp), 0.5);
//! let weight = pdf_of_lamp / (pdf_of_lamp + material.pdf(wi, wo)); // the balance heuristic
//! let direct = material.eval(wi, wo) * wi.z.max(0.0) * weight / pdf_of_lamp;
//! // The material's sample: take its own weight and pdf, and do not evaluate them again.
//! let mut throughput = Vec3::ONE;
//! if let Some(sample) = material.sample(wo, Vec2::new(0.3, 0.7)) {
//!     throughput *= sample.weight;
//!     let next = frame.to_world(sample.wi);
//!     # let _ = next;
//! } // else the path ends here
//! # let _ = (direct, throughput);
//! # Ok::<(), microsurface::Error>(())
//! ```
//! Why the sample's own pdf: see [`Sample`](crate::bsdf::Sample), "Accuracy".
//!
//! # Textures
//! A texture that holds 0, or NaN, must not end a render: the `*_clamped` functions of
//! [`roughness`](crate::roughness) make a mirror of it and never fail. In a loop over pixels they
//! are straight-line code, where `?` and `unwrap` would be early exits that keep the loop scalar:
//! ```
//! use microsurface::{Ggx, Ndf, glam::Vec3, roughness::alpha_burley2012_clamped};
//! let texels = [0.0_f32, 0.3, 1.0];
//! for roughness in texels {
//!     let surface = Ggx::isotropic(alpha_burley2012_clamped(roughness))?;
//!     assert!(surface.d(Vec3::Z) > 0.0);
//! }
//! # Ok::<(), microsurface::Error>(())
//! ```
//! [`batch::Varied`](crate::batch::Varied) takes slices of texels and is faster still.
//!
//! # Two-sided surfaces
//! A BRDF is 0 where either direction is at or below the horizon. To show both sides, negate `wo.z`
//! and `wi.z` together where the viewer is behind, and `wi.z` of a sample back. x and y stay, so an
//! anisotropic surface keeps its direction.
//!
//! # Filtered materials under multiple importance sampling
//! [`eval_over`](crate::bsdf::RoughConductor::eval_over) has no density of its own. Sample a
//! surface widened by the same footprint, [`filtered`](crate::Microsurface::filtered), use its
//! `pdf`, and divide: the estimate is unbiased, and its lobe covers the mean's.
//!
//! # What the crate is not
//! It has no transmission, no layers, no energy compensation, no textures and no scenes. It gives
//! their authors the mathematics of one rough interface.
