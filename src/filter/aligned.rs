//! A + 2Σ where both are along the axes: the map keeps its type, and its cost.

use crate::Real;
use crate::error::Error;
use crate::filter::projected::checked_variance;
use crate::map::{AxisAligned, Isotropic};
use crate::microsurface::Microsurface;
use crate::profile::ShapeInvariant;

impl<P: ShapeInvariant, T: Real> Microsurface<P, Isotropic<T>> {
    /// [`filtered`](Self::filtered) by slopes of the same variance v in every direction: α'² = α² + 2v.
    ///
    /// # Special cases
    /// v = 0 gives the same α, exactly.
    ///
    /// # Errors
    /// [`Error::Covariance`] unless v is finite and not negative, [`Error::Alpha`] where α' is above
    /// [`alpha_range`](crate::roughness::alpha_range).
    ///
    /// # Example
    /// ```
    /// use microsurface::Ggx;
    /// let filtered = Ggx::isotropic(0.3_f32)?.filtered_isotropic(0.08)?;
    /// assert!((filtered.map().alpha() - 0.5).abs() < 1e-6);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    #[inline]
    pub fn filtered_isotropic(&self, variance: T) -> Result<Self, Error> {
        let [v, _] = checked_variance([variance, variance])?;
        Ok(Self::new(*self.profile(), Isotropic::new(widened(self.map().alpha(), v))?))
    }
}

impl<P: ShapeInvariant, T: Real> Microsurface<P, AxisAligned<T>> {
    /// [`filtered`](Self::filtered) by slopes of these variances along x and y, uncorrelated: αx'² = αx² + 2v_x,
    /// αy'² = αy² + 2v_y.
    ///
    /// # Errors
    /// [`Error::Covariance`] unless both are finite and not negative, [`Error::Alpha`] where an α' is above
    /// [`alpha_range`](crate::roughness::alpha_range).
    ///
    /// # Example
    /// ```
    /// use microsurface::Beckmann;
    /// let filtered = Beckmann::anisotropic(0.3_f32, 0.1)?.filtered_axis_aligned([0.08, 0.0])?;
    /// let [alpha_x, alpha_y] = filtered.map().alphas();
    /// assert!((alpha_x - 0.5).abs() < 1e-6 && alpha_y == 0.1);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    #[inline]
    pub fn filtered_axis_aligned(&self, variances: [T; 2]) -> Result<Self, Error> {
        let [x, y] = self.map().alphas();
        let [v_x, v_y] = checked_variance(variances)?;
        Ok(Self::new(*self.profile(), AxisAligned::new(widened(x, v_x), widened(y, v_y))?))
    }
}

/// √(α² + 2v).
#[inline]
fn widened<T: Real>(alpha: T, variance: f64) -> T {
    let alpha = alpha.to_f64();
    T::lit(Real::sqrt(alpha * alpha + 2.0 * variance))
}
