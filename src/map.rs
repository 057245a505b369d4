//! Linear maps of the tangent plane under which a profile is seen, one type for each cost.
//!
//! A map M moves the points of the microsurface; normals pull back by Mᵀ, directions by M⁻¹:
//! D(wm) = |det M| P(|Mᵀ wm_xy|², wm.z²) and σ(w) = σ_P(|M⁻¹ w_xy|², w.z). Every type stores the
//! inverse R = M⁻¹, in units of slope width: R = α for an isotropic surface, and A = RᵀR is the
//! roughness matrix. Since a profile is isotropic, only RᵀR matters and R can be kept upper
//! triangular: three numbers.
//!
//! To save multiplications and rounding, normals are pulled back by the *unimodular* part of M:
//! with ρ² = |det R|, [`Map::normal_terms`] returns q̂ = ρ²|Mᵀ m_xy|² and ẑ² = ρ² m.z², and D = ρ²
//! P(q̂, ẑ²). For an isotropic map q̂ is x² + y², whatever α. The 1/π that every P contains is kept
//! with ρ².

mod axis_aligned;
mod gram;
mod isotropic;
mod linear;
mod roughness_matrix;

pub use axis_aligned::AxisAligned;
pub(crate) use gram::{Gram, Sums, invertible, sum};
pub use isotropic::Isotropic;
pub use linear::Linear;
pub(crate) use linear::moved;
pub use roughness_matrix::RoughnessMatrix;

use crate::Real;
use crate::error::Error;

mod sealed {
    pub trait Sealed {}
    impl<T> Sealed for super::Isotropic<T> {}
    impl<T> Sealed for super::AxisAligned<T> {}
    impl<T> Sealed for super::Linear<T> {}
}

/// A linear map of the tangent plane. Sealed: [`Isotropic`], [`AxisAligned`], [`Linear`].
pub trait Map: sealed::Sealed + Copy {
    /// f32 or f64.
    type Scalar: Real;
    /// The smallest map that holds this one stretched along the axes.
    type Stretched: Map<Scalar = Self::Scalar>;

    /// ρ²/π = 1/(π |det M|), rounded once: ρ² is the geometric mean of the principal α².
    fn scale(&self) -> Self::Scalar;

    /// (q̂, ẑ²) = ρ²·(|Mᵀ m_xy|², m.z²).
    fn normal_terms(&self, m: [Self::Scalar; 3]) -> (Self::Scalar, Self::Scalar);

    /// (q̂, ẑ²) in the wide scalar, from the stored α and the components of m without any rounding
    /// to the narrow one. Where a density is steep in q̂/ẑ², the rounding of the ratio is the error
    /// of the density.
    fn normal_terms_wide(
        &self,
        m: [Self::Scalar; 3],
    ) -> (<Self::Scalar as Real>::Wide, <Self::Scalar as Real>::Wide);

    /// s² = |M⁻¹ w_xy|².
    fn direction_term(&self, w: [Self::Scalar; 3]) -> Self::Scalar;

    /// s² in the wide scalar.
    fn direction_term_wide(&self, w: [Self::Scalar; 3]) -> <Self::Scalar as Real>::Wide;

    /// M⁻¹ w: the direction as the profile sees it, not normalised.
    fn pull_direction(&self, w: [Self::Scalar; 3]) -> [Self::Scalar; 3];

    /// M⁻ᵀ m: a normal of the profile as a normal of the surface, not normalised.
    fn push_normal(&self, m: [Self::Scalar; 3]) -> [Self::Scalar; 3];

    /// M⁻¹ = R by rows, upper triangular: `[[r11, r12], [0, r22]]`.
    fn inverse(&self) -> [[Self::Scalar; 2]; 2];

    /// This map followed by diag(1/(1−s), 1−s), s ∈ (−1, 1) checked by the caller; see
    /// [`Microsurface::stretched`](crate::Microsurface::stretched).
    ///
    /// # Errors
    /// [`Error::Map`] where the result leaves the range of α.
    fn stretched(&self, scale_x: Self::Scalar, scale_y: Self::Scalar) -> Result<Self::Stretched, Error>;
}

/// |det R|/π of a triangular R of this diagonal.
#[inline(always)]
fn scale<T: Real>(r11: T, r22: T) -> T {
    T::lit(r11.to_f64() * r22.to_f64() * core::f64::consts::FRAC_1_PI)
}

/// The inverse map of a surface as a triangular factor.
#[inline(always)]
pub(crate) fn factor<M: Map>(map: &M) -> [f64; 3] {
    let [[r11, r12], [_, r22]] = map.inverse().map(|row| row.map(Real::to_f64));
    [r11, r12, r22]
}

/// Mᵀt: a slope of the surface as the profile sees it.
#[inline]
pub(crate) fn seen_by_profile<M: Map>(map: &M, slope: <M::Scalar as Real>::Vec2) -> [f64; 2] {
    let [r11, r12, r22] = factor(map);
    let [x, y]: [M::Scalar; 2] = slope.into();
    let x = x.to_f64() / r11;
    [x, (y.to_f64() - r12 * x) / r22]
}
