//! Positive definite matrices without cancellation, for constructors.

use crate::Real;
use crate::error::Error;

/// A symmetric positive definite matrix RᵀR with |det R|, the root of its determinant, known more precisely
/// than from its entries.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gram {
    pub(crate) xx: f64,
    pub(crate) xy: f64,
    pub(crate) yy: f64,
    pub(crate) root: f64,
}

impl Gram {
    /// RᵀR of the upper triangular R = [[r11, r12], [0, r22]].
    #[inline(always)]
    pub(crate) fn of_factor([r11, r12, r22]: [f64; 3]) -> Self {
        Self { xx: r11 * r11, xy: r11 * r12, yy: r12 * r12 + r22 * r22, root: (r11 * r22).abs() }
    }

    /// Cholesky's factor [r11, r12, r22].
    #[inline(always)]
    pub(crate) fn factor(&self) -> [f64; 3] {
        let r11 = Real::sqrt(self.xx);
        [r11, self.xy / r11, self.root / r11]
    }

    /// The larger and the smaller principal α: the roots of the eigenvalues.
    pub(crate) fn principal(&self) -> [f64; 2] {
        let half_difference = 0.5 * (self.xx - self.yy);
        let radius = Real::sqrt(half_difference * half_difference + self.xy * self.xy);
        let largest = Real::sqrt(0.5 * (self.xx + self.yy) + radius);
        [largest, self.root / largest]
    }

    /// Both principal α are finite and within the range of the scalar. False for NaN.
    #[inline]
    pub(crate) fn in_range<T: Real>(&self) -> bool {
        let (smallest, largest) = crate::roughness::alpha_range::<T>();
        // The trace is between the larger α² and twice that: nearly always it tells without a root.
        let (small, large) = (smallest.to_f64(), largest.to_f64());
        let (trace, least) = (self.xx + self.yy, small * small);
        // The root is the product of both α: nothing below underflows where it is above the least.
        if trace <= large * large && self.root >= least && self.root * self.root >= least * trace {
            return true;
        }
        let [alpha_max, alpha_min] = self.principal();
        // A relative slack of a few ε: an α at the very end of the range stays accepted after a rotation.
        let slack = 1.0 + 8.0 * T::EPSILON.to_f64();
        alpha_max <= largest.to_f64() * slack && alpha_min * slack >= smallest.to_f64()
    }
}

/// The determinant of the matrix of these columns.
///
/// # Errors
/// [`Error::Map`] unless its singular values are within the range of α; for NaN and ∞ too.
pub(crate) fn invertible<T: Real>([[a, b], [c, d]]: [[f64; 2]; 2]) -> Result<f64, Error> {
    let determinant = difference_of_products(a, d, b, c);
    let root = determinant.abs();
    let gram = Gram { xx: a * a + b * b, xy: a * c + b * d, yy: c * c + d * d, root };
    if gram.in_range::<T>() { Ok(determinant) } else { Err(Error::Map { determinant }) }
}

/// a·b − c·d to about an ulp of the result, by exact products (Dekker 1971; Kahan's algorithm).
#[inline(always)]
pub(crate) fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let (p, p_error) = two_product(a, b);
    let (q, q_error) = two_product(c, d);
    let (difference, error) = two_sum(p, -q);
    difference + (error + (p_error - q_error))
}

/// a + b as a rounded sum and its exact error (Knuth).
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// a·b as a rounded product and its exact error.
#[inline(always)]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let halves = |x: f64| {
        let t = 134217729.0 * x; // 2²⁷ + 1
        let high = t - (t - x);
        (high, x - high)
    };
    let product = a * b;
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    (product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
}
