//! Filtering in a pass that writes a G-buffer: α' before any light is known.
//!
//! Without a light there is no half vector; the normal itself stands for it, as in the worst case
//! of a distant eye and a distant lamp in the mirror direction. What is stored is one α' or two, so
//! the kernel 2Σ becomes a number:
//!
//! | function | kernel | stored |
//! |---|---|---|
//! | [`rectangle`] | 2σ²b² of the bounding rectangle b, along each axis | αx', αy' |
//! | [`rectangle_maximum`] | the larger of the two | α' |
//! | [`max_eigenvalue`] | the larger eigenvalue of 2Σ: the least that covers the footprint | α' |
//! | [`isotropic`], [`isotropic_from_normals`] | from the trace of Σ, by a [`Bound`]: needs no tangents | α' |
//!
//! All add to α² and limit what they add by κ, the `limit` of a [`Kernel`].
//!
//! **A footprint of normals** comes from curvature, `Footprint::new(dx_du, dx_dv)`
//! [`transformed`](Footprint::transformed) by the shape operator S (dn = S dx in the tangent
//! plane), or from a 2×2 quad of pixels ([`quad_in_slopes`], [`quad_projected`]).
//!
//! # Special cases
//! α' is never below α, and never NaN for a finite α. Derivatives that are not finite give the
//! largest kernel, κ. A shader's `saturate` is left to the caller: α may be above 1.
//!
//! # Accuracy
//! Computed in f64 and rounded once. The derivatives are the error: differences of unit normals in
//! f32 are uncertain by 1e-7 each.
//!
//! # References
//! Kaplanyan, Hill, Patney and Lefohn 2016, §§5.3 and 5.4; Tokuyoshi 2017, §4; Tokuyoshi and
//! Kaplanyan 2021, Eq. 14.

use crate::Real;
use crate::error::Error;
use crate::filter::Footprint;
use crate::filter::covariance::{largest_kernel, variance_kaplanyan2016, variance_tokuyoshi2021};
use crate::frame::{Frame, normal_to_slope};
use crate::vector::normalized;

/// How wide a kernel is and may be: the variance σ² of the pixel filter in pixels², and the limit κ
/// of what is added to α².
///
/// # Example
/// ```
/// use microsurface::filter::deferred::{Bound, Kernel, isotropic_from_normals};
/// use microsurface::glam::Vec3;
/// let (du, dv) = (Vec3::new(0.2, 0.0, 0.0), Vec3::ZERO);
/// let alpha = isotropic_from_normals(0.1_f32, du, dv, &Kernel::tokuyoshi2019(), Bound::Upper);
/// assert!((alpha - (0.01_f32 + 2.0 * 0.25 * 0.04).sqrt()).abs() < 1e-6);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kernel<T> {
    variance: T,
    limit: T,
}

impl<T: Real> Kernel<T> {
    /// The kernel of these σ² and κ.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless both are finite and not negative.
    #[inline]
    pub fn new(variance: T, limit: T) -> Result<Self, Error> {
        for (name, value) in [("variance", variance), ("limit", limit)] {
            if !(value >= T::ZERO && value.is_finite()) {
                return Err(Error::Parameter {
                    name,
                    value: value.to_f64(),
                    smallest: 0.0,
                    largest: f64::MAX,
                });
            }
        }
        Ok(Self { variance, limit })
    }

    /// σ² = ¼ and κ = ½: the rectangle whose extents are limited to λ = 1, since κ = 2σ²λ².
    ///
    /// # References
    /// Kaplanyan, Hill, Patney and Lefohn 2016, §5.2.
    #[inline]
    #[must_use]
    pub fn kaplanyan2016() -> Self {
        Self { variance: variance_kaplanyan2016(), limit: T::HALF }
    }

    /// σ² = ¼ and κ = 0.18; the papers use it with [`Bound::Upper`].
    ///
    /// # References
    /// Tokuyoshi 2017, Eqs. 10 and 13; Tokuyoshi and Kaplanyan 2019.
    #[inline]
    #[must_use]
    pub fn tokuyoshi2019() -> Self {
        Self { variance: variance_kaplanyan2016(), limit: largest_kernel() }
    }

    /// σ² = 1/(2π) and κ = 0.18; the paper uses it with [`Bound::Mean`].
    ///
    /// # References
    /// Tokuyoshi and Kaplanyan 2021, Eq. 14.
    #[inline]
    #[must_use]
    pub fn tokuyoshi2021() -> Self {
        Self { variance: variance_tokuyoshi2021(), limit: largest_kernel() }
    }

    /// σ² in pixels².
    #[inline]
    #[must_use]
    pub fn variance(&self) -> T {
        self.variance
    }

    /// κ in slopes².
    #[inline]
    #[must_use]
    pub fn limit(&self) -> T {
        self.limit
    }

    /// min(σ² · `squares`, κ); κ for NaN.
    #[inline]
    fn limited(&self, squares: f64) -> f64 {
        let kernel = self.variance.to_f64() * squares;
        let limit = self.limit.to_f64();
        // σ² = 0 times ∞ is NaN, and counts as unknown too.
        if kernel < limit { kernel } else { limit }
    }

    /// min(2σ²b², κ) along the axes, b the extents of the bounding rectangle.
    #[inline]
    pub(super) fn of_bounds(&self, footprint: Footprint<T>) -> [f64; 2] {
        let [[a, b], [c, d]] = wide(footprint);
        let known = footprint.is_finite();
        [[a, c], [b, d]].map(|[u, v]| {
            let extent = u.abs() + v.abs();
            self.limited(if known { 2.0 * (extent * extent) } else { f64::NAN })
        })
    }
}

/// The number that stands for the two eigenvalues of 2Σ in an isotropic kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// Their sum, 2σ²(|∂ᵤn|² + |∂ᵥn|²): at least the larger one, so nothing shimmers; up to twice
    /// what is needed.
    ///
    /// # References
    /// Tokuyoshi 2017, Eqs. 11 and 13; Tokuyoshi and Kaplanyan 2019.
    Upper,
    /// Their mean, σ²(|∂ᵤn|² + |∂ᵥn|²): the right α' where both are equal, half the larger one on a
    /// cylinder.
    ///
    /// # References
    /// Tokuyoshi and Kaplanyan 2021, Eq. 14.
    Mean,
}

/// α' from the derivatives of the normal, in world or any other coordinates: no tangents are
/// needed.
///
/// α'² = α² + min(f σ²(|∂ᵤn|² + |∂ᵥn|²), κ) with f = 2 for [`Bound::Upper`] and 1 for
/// [`Bound::Mean`].
///
/// # Domain
/// `dn_du`, `dn_dv`: the change of the unit normal from one pixel to the next (`ddx`, `ddy`).
/// Differences of unit normals n and n' across θ have length 2 sin(θ/2), which is that of the steps
/// of m.xy about their average.
///
/// # Special cases
/// As of the [module](self). NaN for α = NaN.
///
/// # Example
/// ```
/// use microsurface::filter::deferred::{Bound, Kernel, isotropic_from_normals};
/// use microsurface::glam::Vec3;
/// let (du, dv) = (Vec3::new(0.1, 0.2, 0.0), Vec3::new(0.0, 0.0, -0.2));
/// // σ²(0.05 + 0.04) = 0.09/(2π)
/// let alpha = isotropic_from_normals(0.2_f32, du, dv, &Kernel::tokuyoshi2021(), Bound::Mean);
/// assert!((alpha * alpha - 0.04 - 0.014324).abs() < 1e-6);
/// ```
///
/// # References
/// Tokuyoshi 2017, Eq. 13 and Listing 2; Tokuyoshi and Kaplanyan 2021, Eq. 14 and Listing 5.
#[inline]
#[must_use]
pub fn isotropic_from_normals<T: Real>(
    alpha: T,
    dn_du: T::Vec3,
    dn_dv: T::Vec3,
    kernel: &Kernel<T>,
    bound: Bound,
) -> T {
    let square = |v: T::Vec3| {
        let [x, y, z] = Into::<[T; 3]>::into(v).map(T::to_f64);
        x * x + y * y + z * z
    };
    of_trace(alpha, square(dn_du) + square(dn_dv), kernel, bound)
}

/// α widened by a footprint, in slopes or projected: α'² = α² + min(f σ²(|du|² + |dv|²), κ).
///
/// # Special cases
/// As of the [module](self). NaN for α = NaN.
///
/// # Example
/// On a sphere of radius 5, seen from where a pixel is 0.5 wide, S = I/5:
/// ```
/// use microsurface::filter::{Footprint, deferred::{Bound, Kernel, isotropic}};
/// use microsurface::glam::{Mat2, Vec2};
/// let pixel = Footprint::new(Vec2::new(0.5, 0.0), Vec2::new(0.0, 0.5));
/// let normals = pixel.transformed(Mat2::IDENTITY * 0.2);
/// let alpha = isotropic(0.1, normals, &Kernel::tokuyoshi2019(), Bound::Mean);
/// assert!((alpha * alpha - (0.01 + 2.0 * 0.25 * 0.1 * 0.1)).abs() < 1e-6);
/// ```
///
/// # References
/// Tokuyoshi 2017, Eq. 11.
#[inline]
#[must_use]
pub fn isotropic<T: Real>(alpha: T, footprint: Footprint<T>, kernel: &Kernel<T>, bound: Bound) -> T {
    let [[a, b], [c, d]] = wide(footprint);
    of_trace(alpha, a * a + b * b + (c * c + d * d), kernel, bound)
}

/// α' by the larger eigenvalue λ of Σ, α'² = α² + min(2λ, κ): the narrowest isotropic kernel that
/// covers the footprint.
///
/// # Special cases
/// As of the [module](self). NaN for α = NaN.
///
/// # Example
/// ```
/// use microsurface::filter::{Footprint, deferred::{Kernel, max_eigenvalue}};
/// use microsurface::glam::Vec2;
/// // Across each other.
/// let footprint = Footprint::new(Vec2::new(0.3, 0.4), Vec2::new(-0.04, 0.03));
/// let alpha = max_eigenvalue(0.1, footprint, &Kernel::tokuyoshi2019());
/// assert!((alpha * alpha - (0.01 + 2.0 * 0.25 * 0.25)).abs() < 1e-6);
/// ```
///
/// # References
/// Tokuyoshi 2017, Eq. 10.
#[inline]
#[must_use]
pub fn max_eigenvalue<T: Real>(alpha: T, footprint: Footprint<T>, kernel: &Kernel<T>) -> T {
    let [[a, b], [c, d]] = wide(footprint);
    let (xx, xy, yy) = (a * a + c * c, a * b + c * d, b * b + d * d);
    let (difference, twice_xy) = (xx - yy, 2.0 * xy);
    // Twice the eigenvalue of ΔᵀΔ.
    widened(alpha, kernel.limited(xx + yy + Real::sqrt(difference * difference + twice_xy * twice_xy)))
}

/// [αx', αy'] by the bounding rectangle b of the footprint: αᵢ'² = αᵢ² + min(2σ²bᵢ², κ).
///
/// Not an upper bound, though the papers take it for one: along a diagonal, 2Σ has the eigenvalue
/// 4σ²b², twice this kernel.
///
/// # Special cases
/// As of the [module](self): a footprint that is not finite has the kernel κ along both axes. NaN
/// for α = NaN.
///
/// # Example
/// ```
/// use microsurface::filter::{Footprint, deferred::{Kernel, rectangle}};
/// use microsurface::glam::Vec2;
/// let footprint = Footprint::new(Vec2::new(0.1, -0.2), Vec2::new(-0.1, 0.0));
/// let [alpha_x, alpha_y] = rectangle([0.1, 0.3], footprint, &Kernel::tokuyoshi2019());
/// assert!((alpha_x * alpha_x - (0.01 + 0.5 * 0.04)).abs() < 1e-6);
/// assert!((alpha_y * alpha_y - (0.09 + 0.5 * 0.04)).abs() < 1e-6);
/// ```
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, §5.3 and Eq. 20; Tokuyoshi and Kaplanyan 2021,
/// Listing 3.
#[inline]
#[must_use]
pub fn rectangle<T: Real>(alphas: [T; 2], footprint: Footprint<T>, kernel: &Kernel<T>) -> [T; 2] {
    let [x, y] = kernel.of_bounds(footprint);
    [widened(alphas[0], x), widened(alphas[1], y)]
}

/// One α' for both axes by the longer side of the bounding rectangle: α'² = α² + min(2σ² max(b)²,
/// κ).
///
/// Its kernel is at least half and at most twice that of [`max_eigenvalue`]; see [`rectangle`].
///
/// # Special cases
/// As of [`rectangle`].
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, §5.4; Tokuyoshi 2017, Listing 3.
#[inline]
#[must_use]
pub fn rectangle_maximum<T: Real>(alpha: T, footprint: Footprint<T>, kernel: &Kernel<T>) -> T {
    let [x, y] = kernel.of_bounds(footprint);
    widened(alpha, x.max(y))
}

/// The footprint in slopes of the average normal of a 2×2 quad of pixels, as their frames turn
/// under it.
///
/// The derivative of a normal in its own frame is 0; the papers take the average normal of the
/// quad, the same for all its pixels, and differentiate what each frame sees of it. The frames are
/// those of the pixels (0, 0), (1, 0), (0, 1) and (1, 1), their tangents continuous.
///
/// # Special cases
/// An average on the horizon of a frame, or none (opposite normals), gives a footprint that is not
/// finite: the largest kernel.
///
/// # Accuracy
/// Differences of components of about ε: in f32 what is below 2e-7 is rounding, far below the
/// smallest α in use.
///
/// # Example
/// ```
/// use microsurface::{filter::deferred::quad_in_slopes, frame::Frame, glam::Vec3};
/// // A cylinder along y: from one column to the next the normal turns by 0.1.
/// let left = Frame::from_normal(Vec3::Z);
/// let right = Frame::from_normal(Vec3::new(0.1_f32.sin(), 0.0, 0.1_f32.cos()));
/// let [du, dv] = quad_in_slopes(&[left, right, left, right]).steps();
/// assert!((du.x.abs() - 2.0 * 0.05_f32.tan()).abs() < 1e-6 && dv.length() < 1e-6);
/// ```
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, §5.4 and Eq. 17; Tokuyoshi 2017, Listing 3.
#[inline]
#[must_use]
pub fn quad_in_slopes<T: Real>(frames: &[Frame<T>; 4]) -> Footprint<T> {
    steps(seen_average(frames).map(|n| normal_to_slope(n).into()))
}

/// The footprint of a quad in projected space: the steps of m.xy of the average normal.
///
/// # Special cases
/// As of [`quad_in_slopes`], but finite on the horizon.
///
/// # References
/// Tokuyoshi 2017, §4 and Fig. 6 (a).
#[inline]
#[must_use]
pub fn quad_projected<T: Real>(frames: &[Frame<T>; 4]) -> Footprint<T> {
    steps(seen_average(frames).map(|[x, y, _]| [x, y]))
}

/// The average normal in each frame.
#[inline]
fn seen_average<T: Real>(frames: &[Frame<T>; 4]) -> [[T; 3]; 4] {
    let normals: [[T; 3]; 4] = frames.map(|frame| frame.axes()[2].into());
    let sum = [0, 1, 2].map(|i| (normals[0][i] + normals[1][i]) + (normals[2][i] + normals[3][i]));
    let average = normalized(sum);
    frames.map(|frame| frame.to_local(average.into()).into())
}

/// Both rows and both columns have a difference; the mean of two is that of the quad.
#[inline]
fn steps<T: Real>([p00, p10, p01, p11]: [[T; 2]; 4]) -> Footprint<T> {
    let mean_of_differences = |a: [T; 2], b: [T; 2], c: [T; 2], d: [T; 2]| {
        [T::HALF * ((b[0] - a[0]) + (d[0] - c[0])), T::HALF * ((b[1] - a[1]) + (d[1] - c[1]))]
    };
    Footprint::new(mean_of_differences(p00, p10, p01, p11), mean_of_differences(p00, p01, p10, p11))
}

#[inline]
fn of_trace<T: Real>(alpha: T, trace: f64, kernel: &Kernel<T>, bound: Bound) -> T {
    let factor = match bound {
        Bound::Upper => 2.0,
        Bound::Mean => 1.0,
    };
    widened(alpha, kernel.limited(factor * trace))
}

/// √(α² + kernel), never below α: rounding is monotone, and √(α²) is α.
#[inline]
fn widened<T: Real>(alpha: T, kernel: f64) -> T {
    let alpha = alpha.to_f64();
    T::lit(Real::sqrt(alpha * alpha + kernel))
}

#[inline]
fn wide<T: Real>(footprint: Footprint<T>) -> [[f64; 2]; 2] {
    footprint.steps().map(|step| Into::<[T; 2]>::into(step).map(T::to_f64))
}
