//! Requirements of the elementary functions on a scalar: operations on its bits, and the names of its
//! coefficient tables.
//!
//! The tables stand in `coefficients/`: minimax fits computed by
//! `tests/reference/elementary_coefficients.py`, which prints them with the error attained after
//! rounding to the scalar. That error, of the approximant alone, stands beside each as a power of
//! two. They are written as f64 and narrowed when compiled.

/// Sealed: implemented for f32 and f64 only.
#[doc(hidden)]
pub trait Bits: Copy {
    /// Whether `Real::Wide` has more digits than the scalar itself.
    const WIDENS: bool;
    /// 1.5·2^(digits−1): adding and subtracting it rounds to an integer, to even at ties.
    const ROUND: f64;
    /// 2^(digits−1): the same for numbers that are not negative, up to itself.
    const ROUND_POSITIVE: f64;
    /// `ROUND` + the bias of the exponent.
    const EXPONENT: f64;
    /// A power of two that brings the smallest positive number above `MIN_POSITIVE`, and its
    /// exponent.
    const DENORMAL_SCALE: (f64, f64);
    /// `exp` overflows above the first and is 0 below the second.
    const EXP_RANGE: (f64, f64);
    /// ln 2 as a sum: the first has enough trailing zeros for exact products with every exponent.
    const LN_2: (f64, f64);
    /// `exp2` overflows at the first and is 0 below the second.
    const EXP2_RANGE: (f64, f64);
    /// log₂ e as a sum, the first with half of its digits.
    const LOG2_E: (f64, f64);
    /// 2π as a sum.
    const TAU: (f64, f64);
    /// Above this `erfcx` and `ierfcx` equal their asymptote to rounding.
    const FAR: f64;
    /// Above this `erf` is 1.
    const ERF_ONE: f64;
    /// The table of each function; see the bodies for the form.
    const EXP: &'static [f64];
    /// See [`super::ln`].
    const LN: &'static [f64];
    /// See [`super::ln_wide`].
    const LN_WIDE: &'static [f64];
    /// See [`super::pow_wide`].
    const LN_POW: &'static [f64];
    /// See [`super::sin_cos_turns`].
    const SIN: &'static [f64];
    /// See [`super::sin_cos_turns`].
    const COS: &'static [f64];
    /// sin(2πt)/t in t², |t| ≤ ¼; see `sin_cos_of_turn`.
    const SIN_OF_TURN: &'static [f64];
    /// cos(2πt)/(1 − 16t²) in t².
    const COS_OF_TURN: &'static [f64];
    /// See [`super::atan2`].
    const ATAN: &'static [f64];
    /// π/4 as a sum.
    const FRAC_PI_4: (f64, f64);
    /// See [`super::erf`].
    const ERF: [&'static [f64]; 2];
    /// See [`super::erfcx`].
    const ERFCX: [&'static [f64]; 2];
    /// See [`super::ierfcx`].
    const IERFCX: [&'static [f64]; 2];
    /// See [`super::erf_inv`]: up to which value of the variable, its shift, numerator and
    /// denominator.
    const ERF_INV: [ErfInv; 3];

    /// 2ⁿ for an integer n within the exponents of normal numbers.
    #[must_use]
    fn exp2_of_integer(self) -> Self;
    /// (m, k) with m·2ᵏ the number, √½ ≤ m < √2; normal positive numbers only.
    #[must_use]
    fn split_exponent(self) -> (Self, Self);
    /// 2^−⌊log₂ x⌋ of a positive normal number below half the largest: the number times it is
    /// within [1, 2).
    #[must_use]
    fn inverse_binade(self) -> Self;
    /// The number with the lower half of its digits zeroed, so that products of two such are exact.
    #[must_use]
    fn upper_half(self) -> Self;
    /// The sine and cosine of an angle, turned on by n quarters of a turn, for the sum n + `ROUND`.
    #[must_use]
    fn turned(sin: Self, cos: Self, sum: Self) -> (Self, Self);
}

/// One interval of the inverse error function.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct ErfInv {
    /// The end of the interval in √w.
    pub end: f64,
    /// The shift of √w: it is subtracted.
    pub shift: f64,
    /// Numerator, constant term first.
    pub num: &'static [f64],
    /// Denominator, constant term first.
    pub den: &'static [f64],
}

/// The operations on bits, the same for both but for the widths.
macro_rules! bits {
    ($t:ident, $digits:literal, $half_mask:literal) => {
        #[allow(clippy::cast_possible_truncation, reason = "the constants are numbers of either scalar")]
        #[inline(always)]
        fn exp2_of_integer(self) -> Self {
            // the sum's low bits are n + bias; the shift drops all others
            $t::from_bits((self + (Self::EXPONENT as $t)).to_bits() << $digits)
        }
        #[allow(clippy::cast_possible_truncation, reason = "the constants are numbers of either scalar")]
        #[inline(always)]
        fn split_exponent(self) -> (Self, Self) {
            let bits = self.to_bits();
            let one = (1.0 as $t).to_bits();
            // the biased exponent of x/√½
            let shifted = bits.wrapping_add(one - core::$t::consts::FRAC_1_SQRT_2.to_bits());
            let exponent = shifted >> $digits;
            let k = $t::from_bits(exponent | (Self::ROUND_POSITIVE as $t).to_bits())
                - ((Self::ROUND_POSITIVE as $t) + (Self::EXPONENT - Self::ROUND) as $t);
            let m = $t::from_bits(bits.wrapping_sub(exponent << $digits).wrapping_add(one));
            (m, k)
        }
        #[inline(always)]
        fn inverse_binade(self) -> Self {
            let one = (1.0 as $t).to_bits();
            $t::from_bits((2 * one).wrapping_sub(self.to_bits() & $t::INFINITY.to_bits()))
        }
        #[inline(always)]
        fn upper_half(self) -> Self {
            $t::from_bits(self.to_bits() & $half_mask)
        }
        // Selects between two results by the quarter would become unpredictable branches in scalar
        // code, and bit operations on the results denormal rubbish in unused lanes; products with 0
        // and ±1 are exact.
        #[inline(always)]
        fn turned(sin: Self, cos: Self, sum: Self) -> (Self, Self) {
            // the sum's low bits are those of the integer
            let quarters = sum.to_bits();
            let odd = (quarters & 1).wrapping_neg();
            let one = |quarters| (1.0 as $t).to_bits() | (quarters & 2) << (size_of::<Self>() * 8 - 2);
            let (of_sin, of_cos) = (one(quarters), one(quarters.wrapping_add(1)));
            let [same, other] = [of_sin & !odd, of_sin & odd].map($t::from_bits);
            let [cos_same, cos_other] = [of_cos & !odd, of_cos & odd].map($t::from_bits);
            (sin * same + cos * other, cos * cos_same + sin * cos_other)
        }
    };
}
pub(super) use bits;

#[cfg(test)]
mod tests {
    use crate::Real;

    /// Checks every stated exponent, at both ends of the binade and within.
    fn scaled_to_one<T: Real>(exponents: core::ops::RangeInclusive<i32>) {
        for exponent in exponents {
            let power = T::lit(2f64.powi(exponent));
            for mantissa in [T::ONE, T::ONE + T::EPSILON, T::lit(1.5), T::TWO - T::EPSILON] {
                let inverse = (mantissa * power).inverse_binade();
                assert!(inverse * (mantissa * power) == mantissa, "{mantissa} 2^{exponent}: {inverse}");
            }
        }
    }

    #[test]
    fn the_inverse_of_a_binade_brings_it_to_one() {
        scaled_to_one::<f32>(-126..=126);
        scaled_to_one::<f64>(-1022..=1022);
    }
}
