//! Covariances of slopes.

use core::ops::Add;

use crate::Real;
use crate::elementary::exact::difference_of_products;
use crate::error::Error;
use crate::map::{Gram, sum};

/// The screen-space variance σ² of a pixel filter whose standard deviation is half a pixel, in
/// pixels².
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, §4.3; Tokuyoshi 2017, below Eq. 2.
#[inline]
#[must_use]
pub fn variance_kaplanyan2016<T: Real>() -> T {
    T::lit(0.25)
}

/// The screen-space variance σ² = 1/(2π) of the Gaussian whose peak is that of a box of one pixel,
/// in pixels².
///
/// # References
/// Tokuyoshi and Kaplanyan 2021.
#[inline]
#[must_use]
pub fn variance_tokuyoshi2021<T: Real>() -> T {
    T::lit(0.5 * core::f64::consts::FRAC_1_PI)
}

/// The screen-space variance of a box of one pixel, 1/12, in pixels²: that of the mean over a
/// footprint.
#[inline]
#[must_use]
pub fn variance_of_box<T: Real>() -> T {
    T::lit(1.0 / 12.0)
}

/// The usual limit κ of 2Σ, in slopes².
///
/// # References
/// Kaplanyan 2016, "Stable specular highlights"; Tokuyoshi 2017, Eq. 10.
#[inline]
#[must_use]
pub fn largest_kernel<T: Real>() -> T {
    T::lit(0.18)
}

/// A covariance Σ of slopes: a symmetric positive semidefinite 2×2 matrix, in slopes².
///
/// It is kept as a triangular factor, so that a degenerate Σ, of a line or of a point, stays
/// positive semidefinite, and determinants of sums are sums of positive terms.
///
/// # Special cases
/// Made of numbers that are not finite it is not finite itself; what is built from it then refuses
/// it ([`Error::Covariance`]).
///
/// # Example
/// ```
/// use microsurface::filter::Covariance;
/// let pixel = Covariance::new(0.04_f32, 0.01, 0.02)?;
/// let texture = Covariance::isotropic(0.01);
/// let both = pixel + texture; // of independent causes
/// assert!((both.entries()[0] - 0.05).abs() < 1e-7 && (both.entries()[1] - 0.01).abs() < 1e-7);
/// assert!((both.determinant() - (0.05 * 0.03 - 0.01 * 0.01)).abs() < 1e-8);
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Covariance<T> {
    /// Σ = CᵀC with C = [[c11, c12], [0, c22]].
    c11: T,
    c12: T,
    c22: T,
}

impl<T: Real> Covariance<T> {
    /// The matrix [[xx, xy], [xy, yy]].
    ///
    /// # Errors
    /// [`Error::Covariance`] unless it is finite and positive semidefinite; see
    /// [`nearest`](Self::nearest) for measured ones.
    #[inline]
    pub fn new(xx: T, xy: T, yy: T) -> Result<Self, Error> {
        let [x, o, y] = [xx, xy, yy].map(T::to_f64);
        let (determinant, unit) = determinant([x, o, y]);
        if !(x >= 0.0 && y >= 0.0 && determinant >= 0.0 && (x + y).is_finite()) {
            return Err(Error::Covariance { xx: x, xy: o, yy: y });
        }
        Ok(Self::of(Gram { xx: x, xy: o, yy: y, root: Real::sqrt(determinant) * unit }))
    }

    /// The positive semidefinite matrix of these entries, each limited to what its neighbours
    /// allow: negative variances count as 0, and |xy| is at most √(xx yy).
    ///
    /// For moments of textures, whose difference E\[ttᵀ\] − E\[t\]E\[t\]ᵀ rounding can make
    /// negative.
    #[inline]
    #[must_use]
    pub fn nearest(xx: T, xy: T, yy: T) -> Self {
        let positive = |x: f64| if x < 0.0 { 0.0 } else { x };
        let [x, o, y] = [positive(xx.to_f64()), xy.to_f64(), positive(yy.to_f64())];
        let (determinant, unit) = determinant([x, o, y]);
        if determinant < 0.0 {
            let limit = Real::sqrt(x) * Real::sqrt(y);
            return Self::of(Gram { xx: x, xy: limit.copysign(o), yy: y, root: 0.0 });
        }
        Self::of(Gram { xx: x, xy: o, yy: y, root: Real::sqrt(determinant) * unit })
    }

    /// The covariance of one variance in every direction.
    #[inline]
    #[must_use]
    pub fn isotropic(variance: T) -> Self {
        Self::axis_aligned(variance, variance)
    }

    /// Variances along the axes. Negative ones give NaN.
    #[inline]
    #[must_use]
    pub fn axis_aligned(xx: T, yy: T) -> Self {
        Self { c11: xx.sqrt(), c12: T::ZERO, c22: yy.sqrt() }
    }

    /// The covariance of a point, 0: filtering with it changes nothing.
    #[inline]
    #[must_use]
    pub fn zero() -> Self {
        Self { c11: T::ZERO, c12: T::ZERO, c22: T::ZERO }
    }

    /// variance · (uᵀu + vᵀv).
    #[inline(always)]
    pub(crate) fn of_rows(u: [T; 2], v: [T; 2], variance: T) -> Self {
        let ([a, b], [c, d]) = (u.map(T::to_f64), v.map(T::to_f64));
        let s = variance.to_f64();
        // Exact products: for a narrow footprint the determinant is a small difference.
        let root = s * difference_of_products(a, d, b, c).abs();
        Self::of(Gram { xx: s * (a * a + c * c), xy: s * (a * b + c * d), yy: s * (b * b + d * d), root })
    }

    /// Cholesky's factor; without variance along x, what is left is along y.
    #[inline(always)]
    fn of(Gram { xx, xy, yy, root }: Gram) -> Self {
        let c11 = Real::sqrt(xx);
        let (along, across) = ([xy / c11, root / c11], Real::sqrt(yy));
        // NaN stays NaN.
        let [c12, c22] = if c11 > 0.0 { along } else { [c11, across + c11] };
        Self { c11: T::lit(c11), c12: T::lit(c12), c22: T::lit(c22) }
    }

    /// C, Σ = CᵀC.
    #[inline(always)]
    pub(crate) fn factor(&self) -> [f64; 3] {
        [self.c11, self.c12, self.c22].map(T::to_f64)
    }

    /// The error of a Σ that cannot be used.
    pub(crate) fn refused(&self) -> Error {
        let [xx, xy, yy] = self.entries().map(T::to_f64);
        Error::Covariance { xx, xy, yy }
    }

    /// The entries [xx, xy, yy].
    #[inline]
    #[must_use]
    pub fn entries(&self) -> [T; 3] {
        let [a, b, d] = self.factor();
        [a * a, a * b, b * b + d * d].map(T::lit)
    }

    /// xx + yy, the mean squared length of a slope.
    #[inline]
    #[must_use]
    pub fn trace(&self) -> T {
        let [a, b, d] = self.factor();
        T::lit(a * a + b * b + d * d)
    }

    /// The determinant, a square: never negative, and without cancellation.
    #[inline]
    #[must_use]
    pub fn determinant(&self) -> T {
        let root = self.c11 * self.c22;
        root * root
    }

    /// The larger and the smaller eigenvalue, and the angle in (−π/2, π/2] of the direction of the
    /// larger.
    #[must_use]
    pub fn principal(&self) -> [T; 3] {
        let [a, b, d] = self.factor();
        let (difference, twice_xy) = (a * a - b * b - d * d, 2.0 * a * b);
        let trace = a * a + b * b + d * d;
        // Shares of the trace, whose squares are numbers.
        let (x, y) = (difference / trace, twice_xy / trace);
        let largest = if trace > 0.0 { 0.5 * trace * (1.0 + Real::sqrt(x * x + y * y)) } else { trace };
        let smallest = if largest > 0.0 { (a * d) * (a * d / largest) } else { largest };
        [largest, smallest, 0.5 * crate::real::construction::atan2(twice_xy, difference)].map(T::lit)
    }

    /// Whether all entries are finite.
    #[inline]
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.trace().is_finite()
    }

    /// factor · Σ. Negative factors give NaN.
    #[inline]
    #[must_use]
    pub fn scaled(&self, factor: T) -> Self {
        let root = factor.sqrt();
        Self { c11: root * self.c11, c12: root * self.c12, c22: root * self.c22 }
    }

    /// J Σ Jᵀ: the covariance of J t, for slopes seen in other coordinates.
    #[inline]
    #[must_use]
    pub fn transformed(&self, jacobian: T::Mat2) -> Self {
        let [[j11, j21], [j12, j22]] = T::columns(jacobian);
        let (u, v) = (
            [j11 * self.c11 + j12 * self.c12, j21 * self.c11 + j22 * self.c12],
            [j12 * self.c22, j22 * self.c22],
        );
        Self::of_rows(u, v, T::ONE)
    }

    /// Σ with both eigenvalues limited, the directions kept.
    ///
    /// The usual limit κ of 2Σ ([`largest_kernel`]) is a limit of κ/2. A Σ that is not finite
    /// becomes `limit` in every direction: the largest kernel, where nothing is known.
    #[must_use]
    pub fn clamped(&self, limit: T) -> Self {
        if !self.is_finite() {
            return Self::isotropic(limit);
        }
        let [largest, smallest, _] = self.principal();
        if largest <= limit {
            return *self;
        }
        if smallest >= limit {
            return Self::isotropic(limit);
        }
        // limit·I for the larger eigenvalue, what is missing to the smaller one taken from the
        // direction across: Σ' = f Σ + g I has the eigenvectors of Σ.
        let (l, s, limit) = (largest.to_f64(), smallest.to_f64(), limit.to_f64());
        let f = (limit - s) / (l - s);
        let g = s * (l - limit) / (l - s);
        let [xx, xy, yy] = self.entries().map(T::to_f64);
        Self::of(Gram { xx: f * xx + g, xy: f * xy, yy: f * yy + g, root: Real::sqrt(limit * s) })
    }
}

/// xx yy − xy² in the square of a unit, and the unit: a power of two, so that no product leaves the
/// range of f64.
#[inline(always)]
fn determinant([xx, xy, yy]: [f64; 3]) -> (f64, f64) {
    let largest = xx.abs().max(yy.abs()).max(xy.abs());
    let unit = match largest {
        l if l > 1e150 => f64::from_bits(0x6FF0_0000_0000_0000), // 2⁷⁶⁸
        l if l < 1e-130 => f64::from_bits(0x0FF0_0000_0000_0000), // 2⁻⁷⁶⁸
        _ => 1.0,
    };
    let [x, o, y] = [xx, xy, yy].map(|entry| entry / unit);
    (difference_of_products(x, y, o, o), unit)
}

/// The covariance of the sum of two independent slopes: a nested convolution.
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, Eqs. 15 and 21.
impl<T: Real> Add for Covariance<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::of(sum(self.factor(), other.factor(), 1.0))
    }
}

/// Variances along the axes as f64, finite and not negative.
#[inline]
pub(crate) fn checked_variances<T: Real>(variances: [T; 2]) -> Result<[f64; 2], Error> {
    let [x, y] = variances.map(T::to_f64);
    if x >= 0.0 && y >= 0.0 && x.is_finite() && y.is_finite() {
        return Ok([x, y]);
    }
    Err(Error::Covariance { xx: x, xy: 0.0, yy: y })
}
