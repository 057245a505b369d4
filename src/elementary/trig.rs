//! Sine and cosine of angles given in turns, and the angle of a point in radians.

use super::polynomial::polynomial;
use crate::real::Real;

/// (sin 2πu, cos 2πu), the angle in turns.
///
/// The reduction to an eighth of a turn is exact, so that no argument is too large, and multiples
/// of a quarter turn give exactly 0 and ±1.
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
/// Relative, also beside the zeros: sine f32 ≤ 1.75 ulp (worst at u = −7.917), f64 ≤ 1.7 ulp (worst
/// at u = −0.4167); cosine f32 ≤ 1.75 ulp (worst at u = −1.833), f64 ≤ 1.7 ulp (worst at u =
/// 0.3402). An ulp is at most ½·ε here.
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
/// With t = |u − ½| − ¼, cos 2πu = sin 2πt and |sin 2πu| = cos 2πt: no quadrants, and one
/// polynomial each, with the zeros of the cosine factored out.
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

/// The angle of the point (x, y) from the x axis, in radians: the arcus tangent of y/x in the
/// quadrant of the point.
///
/// With r the quotient of the smaller by the larger of |x| and |y|, reduced to |r| ≤ tan(π/8) by
/// atan r = π/4 + atan((r − 1)/(r + 1)): one division.
///
/// # Domain
/// All numbers.
///
/// # Returns
/// Radians in [−π, π], of the sign of y.
///
/// # Special cases
/// (0, 0) → ±0 or ±π by the signs of y and x; infinities as in IEEE 754; NaN → NaN.
///
/// # Accuracy
/// Relative: f32 ≤ 1.85 ulp (worst known at y = 0.3906, x = 0.8915), f64 ≤ 1.8 ulp (worst at y = √2
/// − 1, x = 1).
///
/// # Example
/// ```
/// use microsurface::elementary::atan2;
/// assert!((atan2(1.0_f64, 1.0) - core::f64::consts::FRAC_PI_4).abs() < 2e-16);
/// assert!((atan2(-1.0_f32, -3.0_f32.sqrt()) + 5.0 / 6.0 * core::f32::consts::PI).abs() < 5e-7);
/// ```
#[must_use]
#[inline(always)]
pub fn atan2<T: Real>(y: T, x: T) -> T {
    let (a, b) = (x.abs(), y.abs());
    let swapped = b > a;
    let (larger, smaller) = if swapped { (b, a) } else { (a, b) };
    // Ends of the range: the sum below must not overflow, 0/0 is 0 here, and ∞/∞ is 1.
    let scale = if larger > T::lit(0.25) * T::MAX { T::lit(0.25) } else { T::ONE };
    let (larger, smaller) = (scale * larger, scale * smaller);
    let infinite = larger == T::INFINITY;
    let finite_share = if smaller == T::INFINITY { T::ONE } else { T::ZERO * smaller };
    let smaller = if infinite { finite_share } else { smaller };
    let larger = if infinite || larger == T::ZERO { T::ONE } else { larger };
    let beyond = smaller > T::lit(core::f64::consts::SQRT_2 - 1.0) * larger;
    let (num, den) = if beyond { (smaller - larger, smaller + larger) } else { (smaller, larger) };
    let r = num / den;
    let z = r * r;
    let small = r * (z * polynomial(z, T::ATAN));
    // The angle is base ± (r + small); multiples of π/4 are sums of two numbers.
    let (quarter, quarter_low) = T::FRAC_PI_4;
    let eighths = if beyond { T::ONE } else { T::ZERO };
    // π/2 − angle where the axes were swapped, π − angle left of the y axis.
    let (sign, eighths) = if swapped { (-T::ONE, T::TWO - eighths) } else { (T::ONE, eighths) };
    let left = T::ONE.copysign(x) < T::ZERO;
    let (sign, eighths) = if left { (-sign, T::lit(4.0) - eighths) } else { (sign, eighths) };
    let angle = eighths * T::lit(quarter) + (sign * r + (sign * small + eighths * T::lit(quarter_low)));
    // The comparisons above may have dropped a NaN.
    let numbers = a <= T::INFINITY && b <= T::INFINITY;
    let angle = if numbers { angle } else { (x + y) * T::ZERO };
    angle.copysign(y)
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
