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
    let a = a - turns; // exact, |a| ≤ ½
    let magic = T::lit(T::ROUND);
    let sum = a * T::lit(4.0) + magic;
    let r = a - (sum - magic) * T::lit(0.25); // exact, |r| ≤ 1/8
    let z = r * r;
    let sin = r * T::lit(T::TAU.0) + r * (T::lit(T::TAU.1) + z * polynomial(z, T::SIN));
    let cos = T::ONE + z * polynomial(z, T::COS);
    let (s, c) = T::turned(sin, cos, sum);
    (s * T::ONE.copysign(u), c)
}

/// (sin 2πu, cos 2πu) for a random number: half the work of [`sin_cos_turns`].
///
/// With t = |u − ½| − ¼, cos 2πu = sin 2πt and |sin 2πu| = cos 2πt: no quadrants, and one polynomial each, with the
/// zeros of the cosine factored out.
///
/// # Domain
/// 0 ≤ u ≤ 1.
///
/// # Accuracy
/// Both within 2.2 ε, absolutely; the sine is 0 at 0, ½ and 1, the cosine at ¼ and ¾.
#[inline(always)]
pub(crate) fn sin_cos_of_turn<T: Real>(u: T) -> (T, T) {
    let from_half = T::HALF - u;
    let t = from_half.abs() - T::lit(0.25);
    let z = t * t;
    let sin = (T::ONE - T::lit(16.0) * z) * polynomial(z, T::COS_OF_TURN);
    (sin.copysign(from_half), t * polynomial(z, T::SIN_OF_TURN))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn within<T: Real>(bound: f64) {
        let mut worst = 0.0_f64;
        for i in 0..=1_000_000 {
            let u = T::lit(f64::from(i) * 1e-6);
            let (sin, cos) = sin_cos_of_turn(u);
            let (s, c) = sin_cos_turns(u.to_f64());
            worst = worst.max((sin.to_f64() - s).abs()).max((cos.to_f64() - c).abs());
            assert!(sin.abs() <= T::ONE + T::EPSILON && cos.abs() <= T::ONE + T::EPSILON);
        }
        let worst = worst / T::EPSILON.to_f64();
        assert!(worst <= bound && worst >= 0.5 * bound, "{worst} ε");
    }

    #[test]
    fn one_turn_is_that_of_any_angle() {
        within::<f32>(2.2);
        within::<f64>(2.2);
        for u in [0.0_f32, 0.5, 1.0] {
            assert!(sin_cos_of_turn(u).0 == 0.0 && sin_cos_of_turn(u).1.abs() > 0.9999999, "{u}");
        }
        for u in [0.25_f32, 0.75] {
            assert!(sin_cos_of_turn(u).1 == 0.0 && sin_cos_of_turn(u).0.abs() > 0.9999999, "{u}");
        }
        let (sin, cos) = sin_cos_of_turn(f32::NAN);
        assert!(sin.is_nan() && cos.is_nan());
    }
}
