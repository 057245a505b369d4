//! Roughness matrices: symmetric, positive definite, in units of α².

use crate::Real;
use crate::alpha::checked;
use crate::elementary::exact::difference_of_products;
use crate::error::Error;
use crate::map::gram::Gram;
use crate::real::construction::{atan2, cos, sin};

/// A symmetric positive definite 2×2 matrix A in units of α² (slope²): the roughness of a surface
/// that need not be aligned with the axes.
///
/// D = 1/(π √det A (wmᵀA⁻¹wm + wm.z²)²) for GGX; A is twice the covariance of the slopes of a
/// Beckmann surface.
///
/// # Numerics
/// The matrix is held as a triangular factor R, A = RᵀR, in units of α. Entries of A lose the
/// smaller principal α where the ratio of both is κ: its relative error is κ² ε/2, all digits
/// beyond κ = 2900 in f32. The factor holds every ratio, with the direction of the axes to a
/// rounding. So [`rotated`](Self::rotated) and
/// [`Microsurface::roughness_matrix`](crate::Microsurface::roughness_matrix) never form α², and
/// [`entries`](Self::entries) is the only way that does.
///
/// # Example
/// ```
/// use microsurface::{Beckmann, Ndf, RoughnessMatrix, glam::Vec3};
/// let matrix = RoughnessMatrix::rotated(0.1_f32, 0.4, 0.5)?;
/// let [alpha_max, alpha_min, angle] = matrix.principal();
/// assert!((alpha_max - 0.4).abs() < 1e-6 && (alpha_min - 0.1).abs() < 1e-6);
/// assert!((angle - (0.5 - core::f32::consts::FRAC_PI_2)).abs() < 1e-6);
/// let surface = Beckmann::from_roughness_matrix(matrix);
/// assert!((surface.d(Vec3::Z) * core::f32::consts::PI * 0.04 - 1.0).abs() < 1e-6);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Heitz 2014, §5.4; Kaplanyan, Hill, Patney and Lefohn 2016; Tokuyoshi and Kaplanyan 2019,
/// supplement.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("anisotropy", "rotation"))]
pub struct RoughnessMatrix<T> {
    /// R = [[r11, r12], [0, r22]], r11 and r22 above 0.
    r11: T,
    r12: T,
    r22: T,
}

impl<T: Real> RoughnessMatrix<T> {
    /// The matrix [[xx, xy], [xy, yy]].
    ///
    /// # Errors
    /// [`Error::RoughnessMatrix`] unless it is finite, positive definite (its determinant is
    /// computed without cancellation) and both principal α are within
    /// [`alpha_range`](crate::roughness::alpha_range).
    ///
    /// # Accuracy
    /// The entries are taken as exact. Where they are roundings of a rotated pair of widths of the
    /// ratio κ, the smaller width that they hold is off by κ² ε/2: take [`rotated`](Self::rotated)
    /// for those.
    #[inline]
    pub fn new(xx: T, xy: T, yy: T) -> Result<Self, Error> {
        let gram = Self::gram_of_entries([xx, xy, yy]);
        let positive = xx > T::ZERO && yy > T::ZERO && gram.root > 0.0;
        if positive && gram.in_range::<T>() {
            return Ok(Self::of_gram(gram));
        }
        let [xx, xy, yy] = [xx, xy, yy].map(T::to_f64);
        Err(Error::RoughnessMatrix { xx, xy, yy, determinant: difference_of_products(xx, yy, xy, xy) })
    }

    /// The matrix of entries that [`new`](Self::new) has accepted.
    #[inline(always)]
    pub(crate) fn of_checked(entries: [T; 3]) -> Self {
        Self::of_gram(Self::gram_of_entries(entries))
    }

    /// The matrix RᵀR of the upper triangular R = [[r11, r12], [0, r22]] with a positive diagonal.
    #[inline(always)]
    pub(crate) const fn of_factor([r11, r12, r22]: [T; 3]) -> Self {
        Self { r11, r12, r22 }
    }

    /// The matrix RᵀR of any upper triangular R, with every bit of R kept but the signs of its
    /// rows.
    ///
    /// # Errors
    /// [`Error::RoughnessMatrix`] unless R is finite and both principal α are within
    /// [`alpha_range`](crate::roughness::alpha_range).
    #[cfg(feature = "serde")]
    pub(crate) fn checked_factor([r11, r12, r22]: [T; 3]) -> Result<Self, Error> {
        let r12 = if r11 < T::ZERO { -r12 } else { r12 };
        let matrix = Self::of_factor([r11.abs(), r12, r22.abs()]);
        let gram = matrix.gram();
        if gram.in_range::<T>() {
            return Ok(matrix);
        }
        let Gram { xx, xy, yy, root } = gram;
        Err(Error::RoughnessMatrix { xx, xy, yy, determinant: root * root })
    }

    /// R as [r11, r12, r22].
    #[inline(always)]
    pub(crate) const fn factor(&self) -> [T; 3] {
        [self.r11, self.r12, self.r22]
    }

    /// Cholesky's factor, rounded once.
    #[inline(always)]
    fn of_gram(gram: Gram) -> Self {
        Self::of_factor(gram.factor().map(T::lit))
    }

    /// The matrix with α = `alpha_x` along the direction at `angle` radians from x, and `alpha_y`
    /// across it.
    ///
    /// Any ratio of the two is held; see the [type](Self).
    ///
    /// # Errors
    /// [`Error::Alpha`] for either α, [`Error::Parameter`] if the angle is not finite.
    ///
    /// # Accuracy
    /// `principal` gives both α back to 2 ε. The axes are turned by at most ε from the given angle,
    /// which moves the density of a surface of the ratio κ by about κ ε beside the highlight.
    ///
    /// # Example
    /// A scratch 1000 times as long as it is wide.
    /// ```
    /// use microsurface::{Ggx, Ndf, RoughnessMatrix, glam::Vec3};
    /// let matrix = RoughnessMatrix::rotated(1.0, 0.001_f32, 1.0225885)?;
    /// let scratched = Ggx::from_roughness_matrix(matrix);
    /// let peak = 1.0 / (core::f32::consts::PI * 1.0 * 0.001);
    /// assert!((scratched.d(Vec3::Z) / peak - 1.0).abs() < 3e-7);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    pub fn rotated(alpha_x: T, alpha_y: T, angle: T) -> Result<Self, Error> {
        let [x, y] = [checked(alpha_x)?, checked(alpha_y)?].map(T::to_f64);
        let angle = angle.to_f64();
        if !angle.is_finite() {
            return Err(Error::Parameter {
                name: "angle",
                value: angle,
                smallest: f64::MIN,
                largest: f64::MAX,
            });
        }
        let (s, c) = (sin(angle), cos(angle));
        let ((xc, xs), (yc, ys)) = ((x * c, x * s), (y * c, y * s));
        Ok(Self::of_gram(Gram {
            xx: xc * xc + ys * ys,
            xy: (x - y) * (x + y) * (s * c),
            yy: xs * xs + yc * yc,
            root: x * y,
        }))
    }

    /// The entries [xx, xy, yy] of A.
    ///
    /// # Accuracy
    /// Each is rounded once. As a matrix they hold the smaller principal α to κ² ε/2, κ the ratio
    /// of the larger to it: no digit from κ = 2900 on in f32, 7e7 in f64.
    #[inline]
    #[must_use]
    pub fn entries(&self) -> [T; 3] {
        let Gram { xx, xy, yy, .. } = self.gram();
        [xx, xy, yy].map(T::lit)
    }

    /// The larger and the smaller principal α, and the angle in (−π/2, π/2] of the direction of the
    /// larger.
    ///
    /// The angle is 0 for a multiple of the identity.
    #[must_use]
    pub fn principal(&self) -> [T; 3] {
        let gram = self.gram();
        let [largest, smallest] = gram.principal();
        let angle = 0.5 * atan2(2.0 * gram.xy, gram.xx - gram.yy);
        [largest, smallest, angle].map(T::lit)
    }

    fn gram(&self) -> Gram {
        Gram::of_factor(self.factor().map(T::to_f64))
    }

    fn gram_of_entries(entries: [T; 3]) -> Gram {
        let [xx, xy, yy] = entries.map(T::to_f64);
        Gram { xx, xy, yy, root: Real::sqrt(difference_of_products(xx, yy, xy, xy)) }
    }
}

impl<T: Real> From<RoughnessMatrix<T>> for [T; 3] {
    #[inline]
    fn from(matrix: RoughnessMatrix<T>) -> Self {
        matrix.entries()
    }
}

impl<T: Real> TryFrom<[T; 3]> for RoughnessMatrix<T> {
    type Error = Error;
    #[inline]
    fn try_from([xx, xy, yy]: [T; 3]) -> Result<Self, Error> {
        Self::new(xx, xy, yy)
    }
}
