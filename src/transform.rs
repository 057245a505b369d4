//! Linear transforms of the microsurface, of any distribution, and where they come from.
//!
//! A microsurface is geometry: stretching an object stretches its facets, and what is left is again
//! a microsurface. A 2×2 matrix M moves the points of the tangent plane, heights stay; normals go
//! by M⁻ᵀ. With M extended by 1 for the height (Atanasov, Koylazov, Dimov and Wilkie 2022, Eqs. 9,
//! 12, 22, 24, 26, 28),
//!
//! D_M(m) = |det M|/|Mᵀm|⁴ D(Mᵀm/|Mᵀm|), σ_M(w) = |M⁻¹w| σ(M⁻¹w/|M⁻¹w|), Λ_M(w) = Λ(M⁻¹w/|M⁻¹w|),
//! P22_M(t) = |det M| P22(Mᵀt), and normals, visible or all, are those of the surface at rest,
//! moved by M⁻ᵀ.
//!
//! | what is moved | by | cost |
//! |---|---|---|
//! | a profile under a map | [`Microsurface::transformed`](crate::Microsurface::transformed), [`stretched`](crate::Microsurface::stretched) | nothing beyond the map it becomes |
//! | any other [`Ndf`](crate::Ndf) | [`Transformed`] | two products with 2×2 matrices, a square root |
//!
//! M may mirror (det M < 0); it may not be singular. Where does it come from? From a deformed mesh
//! ([`tension`]), from a map of the texture coordinates ([`jacobian_of_uv_map`]), or by hand.

mod black_box;
mod jacobian;
pub mod tension;

pub use black_box::Transformed;
pub use jacobian::{jacobian_of_normals, jacobian_of_uv_map};
