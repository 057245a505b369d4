//! Inverses of the error function and its complement.
//!
//! In the middle x = p·R(−ln(1 − p²)); in the tails, with q = erfc x the smaller side, x = R(√(−ln
//! q)). The arithmetic of the intervals is the same, so that only coefficients are selected, not
//! results.

use super::ln;
use super::log::{ln_normal, ln_normal_wide};
use super::polynomial::polynomial_of;
use crate::real::Real;

/// The x ≥ 0 with erf x = `p` and erfc x = `q`, both given, 0 ≤ p and q ≤ 1; the coefficients are
/// those of `T`, the arithmetic that of `W`.
#[inline(always)]
fn inverse<T: Real, W: Real>(p: W, q: W, ln: impl Fn(W) -> W) -> W {
    let [a, b, c] = T::ERF_INV;
    let central = p < W::lit(0.9);
    let w = -ln(if central { (W::ONE - p) * (W::ONE + p) } else { q });
    let r = w.sqrt();
    let near = r < W::lit(b.end);
    let v = if near { r - W::lit(b.shift) } else { r - W::lit(c.shift) };
    let v = if central { w } else { v };
    let num = selected(v, near, central, [a.num, b.num, c.num]) * if central { p } else { W::ONE };
    num / selected(v, near, central, [a.den, b.den, c.den])
}

/// The polynomial of one of three intervals.
#[inline(always)]
fn selected<W: Real>(v: W, near: bool, central: bool, [a, b, c]: [&'static [f64]; 3]) -> W {
    polynomial_of(v, a.len(), |i| {
        // All three at hand before one is chosen: a chosen address would be a load from who knows
        // where.
        let [a, b, c] = [a[i], b[i], c[i]].map(W::lit);
        let tail = if near { b } else { c };
        if central { a } else { tail }
    })
}

/// The inverse from both sides: erfc⁻¹ q for 0 < q < 2.
#[inline(always)]
fn inverse_of_complement<T: Real, W: Real>(q: W, ln: impl Fn(W) -> W) -> W {
    let p = W::ONE - q;
    let other = W::TWO - q;
    let smaller = if other < q { other } else { q };
    let x = inverse::<T, W>(p.abs(), smaller, ln);
    if q > W::ONE { -x } else { x }
}

/// [`erfc_inv`] of ε/2 ≤ q ≤ 2 − ε.
#[inline(always)]
pub(crate) fn erfc_inv_inside<T: Real>(q: T) -> T {
    inverse_of_complement::<T, T>(q, ln_normal)
}

/// erfc⁻¹ to the digits of `T`, computed in the wide scalar: the error is that of the fit, which
/// is smooth, and so the result, rounded to `T`, is monotone ulp by ulp. Samplers want that.
#[inline(always)]
pub(crate) fn erfc_inv_inside_wide<T: Real>(q: T::Wide) -> T::Wide {
    inverse_of_complement::<T, T::Wide>(q, ln_normal_wide::<T>)
}

/// The inverse of the error function: the x with erf x = p.
///
/// Up to |p| = 0.9, x = p·R(−ln(1 − p²)); beyond, x = R(√(−ln(1 − |p|))), R a rational function:
/// one for the tail in f32, two in f64. Only coefficients are selected.
///
/// # Domain
/// −1 to 1.
///
/// # Returns
/// −∞ to ∞, odd. The numbers nearest to ±1 give ±3.8 (f32), ±5.9 (f64).
///
/// # Special cases
/// ±0 → ±0, ±1 → ±∞, beyond → NaN, NaN → NaN.
///
/// # Accuracy
/// f32 ≤ 5.5 ulp (worst at p = 0.9953), f64 ≤ 4.5 ulp (worst at p = 0.984); relative also near 0.
///
/// # Example
/// ```
/// use microsurface::elementary::erf_inv;
/// assert!((erf_inv(0.5_f64) - 0.4769362762044699).abs() < 2e-16);
/// assert_eq!(erf_inv(1.0_f32), f32::INFINITY);
/// ```
///
/// # References
/// The intervals and their variables are those of M. J. Wichura, "Algorithm AS 241", Appl. Statist.
/// 37 (1988); the logarithm in the middle that of M. Giles, "Approximating the erfinv function",
/// GPU Computing Gems (2011).
#[must_use]
#[inline(always)]
pub fn erf_inv<T: Real>(p: T) -> T {
    let a = p.abs();
    let x = inverse::<T, T>(a, T::ONE - a, ln);
    let x = if a == T::ONE { T::INFINITY } else { x };
    x.copysign(p)
}

/// The inverse of the complementary error function: the x with erfc x = q.
///
/// As [`erf_inv`], the tail entered with q itself, so that tiny q keep their digits.
///
/// # Domain
/// 0 to 2.
///
/// # Returns
/// ∞ to −∞.
///
/// # Special cases
/// 0 → ∞, 1 → 0, 2 → −∞, outside → NaN, NaN → NaN.
///
/// # Accuracy
/// f32 ≤ 8 ulp (worst at q = 1.5·10⁻²⁹), f64 ≤ 6 ulp (worst at q = 1.97·10⁻¹⁹).
///
/// # Example
/// ```
/// use microsurface::elementary::erfc_inv;
/// assert_eq!(erfc_inv(1.0_f32), 0.0);
/// assert!((erfc_inv(1e-100_f64) - 15.065574702592646).abs() < 1e-13);
/// ```
///
/// # References
/// As [`erf_inv`].
#[must_use]
#[inline(always)]
pub fn erfc_inv<T: Real>(q: T) -> T {
    let x = inverse_of_complement::<T, T>(q, ln);
    if q == T::ZERO || q == T::TWO { T::INFINITY.copysign(T::ONE - q) } else { x }
}
