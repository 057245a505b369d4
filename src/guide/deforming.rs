//! Stretched, sheared and skinned surfaces.
//!
//! A matrix M that moves the tangent plane moves the microsurface with it. The result is a surface
//! again, with exact masking and visible normals, and costs what its map costs.
//! ```
//! use microsurface::{Ggx, Gtr, glam::{Mat2, Vec2, Vec3}, transform::tension::Triangle};
//! let stretched = Ggx::isotropic(0.4_f32)?.stretched(0.5)?; // twice as long along x, half across
//! let shear = Mat2::from_cols(Vec2::X, Vec2::new(0.5, 1.0));
//! let sheared = Ggx::isotropic(0.4_f32)?.transformed(shear)?;
//! // A triangle of a mesh, drawn out to twice its length along u.
//! let rest = [Vec3::ZERO, Vec3::X, Vec3::Y];
//! let deformed = [Vec3::ZERO, Vec3::X * 2.0, Vec3::Y];
//! let tension = Triangle::new(rest, deformed, [Vec2::ZERO, Vec2::X, Vec2::Y]).tension()?;
//! let skin = Gtr::isotropic(0.25_f32, 2.2)?.transformed(tension)?;
//! # let _ = (stretched, sheared, skin);
//! # Ok::<(), microsurface::Error>(())
//! ```
//! - [`transform::tension`](crate::transform::tension) gives M of triangles and means of vertices.
//! - [`jacobian_of_uv_map`](crate::transform::jacobian_of_uv_map) gives M of a warp of the texture.
//! - [`Transformed`](crate::transform::Transformed) moves any other distribution.
//!
//! A transform is not another α: it moves the tail with the core. Slopes along the direction in
//! which a surface was drawn out, against those of the surface that has the α of the result:
#![doc = include_str!("../../docs/anisotropy.svg")]
//!
//! `cargo run --release --example gallery` renders the figures of Atanasov, Koylazov, Dimov and
//! Wilkie 2022, whose equations these are:
//!
//! | equation | code |
//! |---|---|
//! | 9 and 22, D under M | [`Microsurface::transformed`](crate::Microsurface::transformed), [`Transformed::d`](crate::Ndf::d) |
//! | 12, masking under M | [`Ndf::g1`](crate::Ndf::g1) of either: z over [`sigma`](crate::Ndf::sigma) |
//! | 26, normals under M | [`SampleNdf`](crate::SampleNdf) of either |
//! | 31, stretching | [`Microsurface::stretched`](crate::Microsurface::stretched) |
//! | 34–39, the spline mask of GTR | [`gtr::spline`](crate::gtr::spline) |
