//! Positive definite matrices without cancellation, for constructors.

use crate::Real;
use crate::alpha::alpha_range;
use crate::elementary::exact::difference_of_products;
use crate::error::Error;

/// A symmetric positive definite matrix RᵀR with |det R|, the root of its determinant, known more
/// precisely than from its entries.
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
        let (smallest, largest) = alpha_range::<T>();
        // The trace is between the larger α² and twice that: nearly always it tells without a root.
        let (small, large) = (smallest.to_f64(), largest.to_f64());
        let (trace, least) = (self.xx + self.yy, small * small);
        // The root is the product of both α: nothing below underflows where it is above the least.
        if trace <= large * large && self.root >= least && self.root * self.root >= least * trace {
            return true;
        }
        let [alpha_max, alpha_min] = self.principal();
        // A relative slack of a few ε: an α at the very end of the range stays accepted after a
        // rotation.
        let slack = 1.0 + 8.0 * T::EPSILON.to_f64();
        alpha_max <= largest.to_f64() * slack && alpha_min * slack >= smallest.to_f64()
    }
}

/// Sums a RᵀR + b CᵀC of two Gram matrices of triangular factors.
///
/// With adj(R) the adjugate, det = a² (det R)² + a b (|adj(R)ᵀc₁|² + |adj(R)ᵀc₂|²) + b² (det C)²,
/// c₁ and c₂ the rows of C: every term is positive.
#[derive(Clone, Copy)]
pub(crate) struct Sums {
    /// xx, xy, yy.
    of_r: [f64; 3],
    of_c: [f64; 3],
    /// Coefficients of a², a b, b².
    determinant: [f64; 3],
}

impl Sums {
    #[inline(always)]
    pub(crate) fn new([r11, r12, r22]: [f64; 3], [c11, c12, c22]: [f64; 3]) -> Self {
        let (a, b, c) = (r22 * c11, r11 * c12 - r12 * c11, r11 * c22);
        let (det_r, det_c) = (r11 * r22, c11 * c22);
        Self {
            of_r: [r11 * r11, r11 * r12, r12 * r12 + r22 * r22],
            of_c: [c11 * c11, c11 * c12, c12 * c12 + c22 * c22],
            determinant: [det_r * det_r, a * a + b * b + c * c, det_c * det_c],
        }
    }

    /// Trace and determinant of b (RᵀR)⁻¹CᵀC: the sum and the product of its eigenvalues.
    #[inline(always)]
    pub(crate) fn trace_and_determinant(&self, b: f64) -> [f64; 2] {
        let [det_r, mixed, det_c] = self.determinant;
        [b * (mixed / det_r), b * (b * (det_c / det_r))]
    }

    /// a RᵀR + b CᵀC.
    #[inline(always)]
    pub(crate) fn of(&self, a: f64, b: f64) -> Gram {
        let [xx, xy, yy] = core::array::from_fn(|i| a * self.of_r[i] + b * self.of_c[i]);
        let [det_r, mixed, det_c] = self.determinant;
        Gram { xx, xy, yy, root: Real::sqrt(a * a * det_r + a * b * mixed + b * b * det_c) }
    }
}

/// RᵀR + scale·CᵀC, of triangular factors.
#[inline(always)]
pub(crate) fn sum(r: [f64; 3], c: [f64; 3], scale: f64) -> Gram {
    Sums::new(r, c).of(1.0, scale)
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
