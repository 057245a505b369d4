//! What a half vector covers within one pixel, to first order.

pub mod covariance;
mod half_vector;
pub mod jacobian;
mod motion;
pub mod quad;
pub mod ray;

pub use covariance::Covariance;

use crate::real::{Real, Vector};

/// The steps of the half vector from one pixel to the next, along u and along v: the rows of Δ.
///
/// In slopes, or in the projected space of m.xy; which of the two is for the caller to know. To
/// first order the half vectors of a pixel are the parallelogram of slopes h ± ½ du ± ½ dv. The
/// signs of the steps do not matter.
///
/// # Special cases
/// Steps that are not finite give a Σ that is not, and filters refuse it;
/// [`clamped`](Self::clamped) replaces them.
///
/// # Example
/// ```
/// use microsurface::{Ggx, Ndf, filter::{Footprint, polygon}, glam::Vec2};
/// let surface = Ggx::isotropic(0.01_f32)?;
/// let footprint = Footprint::new(Vec2::new(0.03, 0.01), Vec2::new(-0.01, 0.05)).clamped(1.0);
/// let slope = Vec2::new(0.012, 0.02); // beside the highlight, which is within the pixel
/// let [du, dv] = footprint.steps();
/// assert!(polygon::mean_p22(&surface, slope, du, dv) > 2.0 * surface.p22(slope));
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, §4.2; Igehy 1999.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Footprint<T: Real> {
    du: T::Vec2,
    dv: T::Vec2,
}

impl<T: Real> Footprint<T> {
    /// The footprint of these steps per pixel.
    #[inline(always)]
    #[must_use]
    pub fn new(dh_du: impl Vector<2, Scalar = T>, dh_dv: impl Vector<2, Scalar = T>) -> Self {
        let dh_du = T::Vec2::from(dh_du.components());
        let dh_dv = T::Vec2::from(dh_dv.components());
        Self { du: dh_du, dv: dh_dv }
    }

    /// The steps along u and along v.
    #[inline]
    #[must_use]
    pub fn steps(&self) -> [T::Vec2; 2] {
        [self.du, self.dv]
    }

    #[inline(always)]
    fn rows(&self) -> [[T; 2]; 2] {
        [self.du.into(), self.dv.into()]
    }

    pub(crate) fn of_rows([du, dv]: [[T; 2]; 2]) -> Self {
        Self { du: du.into(), dv: dv.into() }
    }

    /// Whether both steps are finite.
    #[inline]
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let [[a, b], [c, d]] = self.rows();
        a.is_finite() && b.is_finite() && c.is_finite() && d.is_finite()
    }

    /// Both steps seen in other coordinates: J du and J dv.
    #[inline]
    #[must_use]
    pub fn transformed(&self, jacobian: T::Mat2) -> Self {
        let [[j11, j21], [j12, j22]] = T::columns(jacobian);
        Self::of_rows(self.rows().map(|[x, y]| [j11 * x + j12 * y, j21 * x + j22 * y]))
    }

    /// Both steps scaled: by ½ for the footprint of one of four samples of a pixel.
    #[inline]
    #[must_use]
    pub fn scaled(&self, factor: T) -> Self {
        Self::of_rows(self.rows().map(|row| row.map(|x| factor * x)))
    }

    /// Σ = σ²ΔᵀΔ of a pixel filter of this variance σ² in pixels².
    ///
    /// [`covariance`](crate::filter::covariance) names the usual ones: 0.25, 1/(2π), 1/12.
    ///
    /// # References
    /// Kaplanyan et al. 2016, Eq. 13, whose outer product is misprinted; Tokuyoshi 2017, Eqs. 2
    /// and 7.
    #[inline(always)]
    #[must_use]
    pub fn covariance(&self, variance: T) -> Covariance<T> {
        let [u, v] = self.rows();
        Covariance::of_rows(u, v, variance)
    }

    /// The extents |du| + |dv| of the bounding rectangle along the axes (a shader's `fwidth`).
    ///
    /// # References
    /// Kaplanyan et al. 2016, §4.3 and §5.3.
    #[inline]
    #[must_use]
    pub fn extents(&self) -> T::Vec2 {
        let [[a, b], [c, d]] = self.rows();
        [a.abs() + c.abs(), b.abs() + d.abs()].into()
    }

    /// The covariance σ² diag(extents²) of the bounding rectangle: a biased kernel that depends
    /// less on the quality of the derivatives.
    ///
    /// Its variances along the axes are never smaller than those of
    /// [`covariance`](Self::covariance), so highlights are blurred more; along the diagonals they
    /// can be smaller, down to a half, because it has no correlation.
    ///
    /// # References
    /// Kaplanyan et al. 2016, §5.3; Tokuyoshi 2017, Listing 3.
    #[inline]
    #[must_use]
    pub fn covariance_of_bounds(&self, variance: T) -> Covariance<T> {
        let [x, y]: [T; 2] = self.extents().into();
        Covariance::axis_aligned(variance * (x * x), variance * (y * y))
    }

    /// The footprint shrunk so that no extent exceeds `largest` (the papers' λ, 1 in slopes), its
    /// shape kept.
    ///
    /// # Special cases
    /// A footprint that is not finite, as at half vectors on the horizon, becomes the square of
    /// `largest` by `largest`: the largest kernel, where nothing is known.
    ///
    /// # References
    /// Kaplanyan et al. 2016, §5.2.
    #[inline]
    #[must_use]
    pub fn clamped(&self, largest: T) -> Self {
        if !self.is_finite() {
            return Self::of_rows([[largest, T::ZERO], [T::ZERO, largest]]);
        }
        // Halves: the sum of two finite numbers need not be finite.
        let [[a, b], [c, d]] = self.rows().map(|row| row.map(|x| (T::HALF * x).abs()));
        let half_extent = (a + c).max(b + d);
        let half = T::HALF * largest;
        if half_extent > half { self.scaled(half / half_extent) } else { *self }
    }

    /// The extents of the bounding rectangle, each limited to `largest`.
    ///
    /// # Special cases
    /// A footprint that is not finite has `largest` by `largest`.
    ///
    /// # References
    /// Kaplanyan et al. 2016, §5.2.
    #[inline]
    #[must_use]
    pub fn clamped_extents(&self, largest: T) -> T::Vec2 {
        if !self.is_finite() {
            return [largest, largest].into();
        }
        let extents: [T; 2] = self.extents().into();
        extents.map(|x| x.min(largest)).into()
    }
}
