//! The error function and its complement.

use super::erfcx::erfcx_of_positive;
use super::exp_neg_square;
use super::polynomial::polynomial;
use crate::real::Real;

/// The error function erf x = (2/√π)·∫₀ˣ e^(−t²)dt.
///
/// x·P(x²)/Q(x²), one rational function for all x, without an exponential.
///
/// # Domain
/// Any number.
///
/// # Returns
/// −1 to 1, odd; exactly ±1 from |x| > 3.93 (f32) or 5.93 (f64) on. Where ulps of the result are
/// small beside its error, just below 1, it is not monotonic.
///
/// # Special cases
/// ±0 → ±0, ±∞ → ±1, NaN → NaN.
///
/// # Accuracy
/// f32 ≤ 6 ulp (worst at x = 3.333), f64 ≤ 5.5 ulp (worst at x = 3.93); an ulp just below 1 is ½·ε.
///
/// # Example
/// ```
/// use microsurface::elementary::erf;
/// assert!((erf(1.0_f64) - 0.8427007929497149).abs() < 5e-16);
/// assert_eq!(erf(f32::INFINITY), 1.0);
/// ```
///
/// # References
/// NIST Digital Library of Mathematical Functions, §7.2.
#[must_use]
#[inline(always)]
pub fn erf<T: Real>(x: T) -> T {
    let end = T::lit(T::ERF_ONE);
    let a = x.abs();
    let b = if a > end { end } else { a };
    let z = b * b;
    let y = b * polynomial(z, T::ERF[0]) / polynomial(z, T::ERF[1]);
    let y = if y > T::ONE { T::ONE } else { y };
    let y = if a > end { T::ONE } else { y };
    y.copysign(x)
}

/// The complementary error function erfc x = 1 − erf x, without cancellation for positive x.
///
/// e^(−x²)·erfcx|x|, and 2 less that for negative x. [`exp_neg_square`] keeps the digits of the
/// square.
///
/// # Domain
/// Any number.
///
/// # Returns
/// 0 to 2; 0 from x ≈ 10.06 (f32), 27.23 (f64) on, after gradual underflow.
///
/// # Special cases
/// −∞ → 2, 0 → 1, ∞ → 0, NaN → NaN.
///
/// # Accuracy
/// f32 ≤ 6 ulp (worst at x = 3.656), f64 ≤ 5.5 ulp (worst at x = 5.57).
///
/// # Example
/// ```
/// use microsurface::elementary::erfc;
/// assert_eq!(erfc(0.0_f32), 1.0);
/// assert!((erfc(5.0_f64) / 1.5374597944280349e-12 - 1.0).abs() < 1e-15);
/// ```
///
/// # References
/// NIST Digital Library of Mathematical Functions, §7.2.
#[must_use]
#[inline(always)]
pub fn erfc<T: Real>(x: T) -> T {
    let y = exp_neg_square(x) * erfcx_of_positive(x.abs());
    if x < T::ZERO { T::TWO - y } else { y }
}
