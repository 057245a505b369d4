//! Sine and cosine of angles given in turns.

use super::kernel::polynomial;
use crate::real::Real;

/// (sin 2πu, cos 2πu), the angle in turns.
///
/// The reduction to an eighth of a turn is exact, so that no argument is too large, and multiples of a quarter turn
/// give exactly 0 and ±1.
///
/// # Domain
/// Any finite number; from 2²³ (f32) or 2⁵² (f64) on, all numbers are whole turns.
///
/// # Returns
/// Two numbers within [−1, 1].
///
/// # Special cases
/// ±0 → (±0, 1); ±∞, NaN → NaN.
///
/// # Accuracy
/// Relative, also beside the zeros: sine f32 ≤ 1.75 ulp (worst at u = −7.917), f64 ≤ 1.7 ulp (worst at u = −0.4167); cosine f32 ≤ 1.75 ulp (worst at u = −1.833), f64 ≤ 1.7 ulp (worst at u = 0.3402). An ulp is at most ½·ε here.
///
/// # Example
/// ```
/// use microsurface::elementary::sin_cos_turns;
/// assert_eq!(sin_cos_turns(0.25_f32), (1.0, 0.0));
/// assert_eq!(sin_cos_turns(1e6_f32 + 0.5), (0.0, -1.0));
/// let (s, c) = sin_cos_turns(1.0_f64 / 12.0);
/// assert!((s - 0.5).abs() < 2e-16 && (c - 0.75_f64.sqrt()).abs() < 2e-16);
/// ```
#[must_use]
#[inline(always)]
pub fn sin_cos_turns<T: Real>(u: T) -> (T, T) {
    let a = u.abs();
    let magic = T::lit(T::ROUND_POSITIVE);
    // larger numbers are integers
    let turns = if a < magic { (a + magic) - magic } else { a };
    // exact, |a| ≤ ½
    let (s, c) = sin_cos_within_turns(a - turns);
    (s * T::ONE.copysign(u), c)
}

/// (sin 2πu, cos 2πu) for few turns, such as a random number: |u| ≤ 1024.
#[inline(always)]
pub(crate) fn sin_cos_within_turns<T: Real>(u: T) -> (T, T) {
    let magic = T::lit(T::ROUND);
    let sum = u * T::lit(4.0) + magic;
    let r = u - (sum - magic) * T::lit(0.25); // exact, |r| ≤ 1/8
    let z = r * r;
    let sin = r * T::lit(T::TAU.0) + r * (T::lit(T::TAU.1) + z * polynomial(z, T::SIN));
    let cos = T::ONE + z * polynomial(z, T::COS);
    T::turned(sin, cos, sum)
}
