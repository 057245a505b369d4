//! The exponential function and its relatives.
//!
//! eˣ = 2ⁿ·eʳ with n = round(x/ln 2) and r = x − n·ln 2, |r| ≤ ½ ln 2; eʳ = 1 + r + r²·P(r).

use super::bits::Bits;
use super::polynomial::polynomial;
use crate::real::Real;

/// The integer nearest to x, for |x| < 2^(digits−2); ties to even.
#[inline(always)]
pub(super) fn round<T: Real>(x: T) -> T {
    let magic = T::lit(T::ROUND);
    (x + magic) - magic
}

/// x confined to where e^x does not overflow, 0 where e^x is 0, and whether it is; NaN stays NaN.
///
/// A result that vanishes is selected at the end: as a product it would take a microcode assist.
#[inline(always)]
fn within_range<X: Real, T: Real>(x: X) -> (X, bool) {
    let (top, bottom) = (X::lit(X::EXP_RANGE.0), X::lit(T::EXP_RANGE.1));
    let vanishes = x < bottom;
    let x = if x > top { top } else { x };
    (if vanishes { X::ZERO } else { x }, vanishes)
}

/// y·2ⁿ for integers n of twice the range of exponents, rounded once.
#[inline(always)]
fn scale<T: Real>(y: T, n: T) -> T {
    let n1 = round(n * T::HALF);
    y * n1.exp2_of_integer() * (n - n1).exp2_of_integer()
}

/// eˣ where it is a normal number: for a caller who knows, or who selects another value elsewhere.
///
/// Leaves out what `exp` spends on the ends of its range, and with it subnormal results, of which
/// each costs a processor a microcode assist of a hundred cycles and more.
#[inline(always)]
pub(crate) fn exp_normal<T: Real>(x: T) -> T {
    let n = round(x * T::lit(core::f64::consts::LOG2_E));
    let low = -(n * T::lit(T::LN_2.1));
    let high = x - n * T::lit(T::LN_2.0);
    let r = high + low;
    (T::ONE + (high + (low + r * r * polynomial(r, T::EXP)))) * n.exp2_of_integer()
}

/// eˣ of an argument in f64, where it is a normal number of `T`; see [`exp_normal`].
#[inline(always)]
pub(crate) fn exp_normal_wide<T: Real>(x: T::Wide) -> T {
    let (y, n) = reduced_wide::<T>(x);
    T::narrow(y * n.exp2_of_integer())
}

/// y and n with eˣ = y·2ⁿ; P(r) in the digits of `T`.
#[inline(always)]
fn reduced_wide<T: Real>(x: T::Wide) -> (T::Wide, T::Wide) {
    let n = round(x * T::Wide::lit(core::f64::consts::LOG2_E));
    let r = (x - n * T::Wide::lit(T::Wide::LN_2.0)) - n * T::Wide::lit(T::Wide::LN_2.1);
    let s = T::narrow(r);
    (T::Wide::ONE + (r + (s * s * polynomial(s, T::EXP)).widen()), n)
}

/// e^(x + tail), |tail| below 1.
#[inline(always)]
pub(super) fn exp_of_sum<T: Real>(x: T, tail: T) -> T {
    let (x, vanishes) = within_range::<T, T>(x);
    let n = round((x + tail) * T::lit(core::f64::consts::LOG2_E));
    let low = tail - n * T::lit(T::LN_2.1);
    let high = x - n * T::lit(T::LN_2.0);
    let r = high + low;
    let y = T::ONE + (high + (low + r * r * polynomial(r, T::EXP)));
    if vanishes { T::ZERO } else { scale(y, n) }
}

/// eˣ, over the whole range.
///
/// The argument is reduced as x = n·ln 2 + r with ln 2 as a sum of two, and eʳ = 1 + r + r²·P(r).
///
/// # Domain
/// Any number.
///
/// # Returns
/// 0 to ∞. Denormal results are rounded once, like others.
///
/// # Special cases
/// −∞ → 0, ∞ → ∞, ±0 → 1, NaN → NaN.
///
/// # Accuracy
/// f32 ≤ 1 ulp (worst at x = 48.9), f64 ≤ 1.1 ulp (worst at x = −710.45, denormal).
///
/// # Example
/// ```
/// use microsurface::elementary::exp;
/// assert_eq!(exp(0.0_f32), 1.0);
/// assert!((exp(1.0_f64) - core::f64::consts::E).abs() < 5e-16);
/// assert_eq!(exp(-1e4_f64), 0.0);
/// ```
#[must_use]
#[inline(always)]
pub fn exp<T: Real>(x: T) -> T {
    exp_of_sum(x, T::ZERO)
}

/// 2ˣ, over the whole range.
///
/// x = n + r with |r| ≤ ½, without rounding, and 2ʳ = e^(r ln 2).
///
/// # Domain
/// Any number.
///
/// # Returns
/// 0 to ∞; exact at integers. Denormal results are rounded once, like others.
///
/// # Special cases
/// −∞ → 0, ∞ → ∞, ±0 → 1, NaN → NaN.
///
/// # Accuracy
/// f32 ≤ 1.1 ulp (worst at x = 0.55349), f64 ≤ 1 ulp (worst at x = −132.45).
///
/// # Example
/// ```
/// use microsurface::elementary::exp2;
/// assert_eq!(exp2(-3.0_f32), 0.125);
/// assert!((exp2(0.5_f64) - core::f64::consts::SQRT_2).abs() < 3e-16);
/// assert_eq!(exp2(-1e4_f64), 0.0);
/// ```
#[must_use]
#[inline(always)]
pub fn exp2<T: Real>(x: T) -> T {
    let (top, bottom) = (T::lit(T::EXP2_RANGE.0), T::lit(T::EXP2_RANGE.1));
    let vanishes = x < bottom;
    let x = if x > top { top } else { x };
    let x = if vanishes { T::ZERO } else { x };
    let n = round(x);
    let r = (x - n) * T::lit(core::f64::consts::LN_2);
    let y = T::ONE + (r + r * r * polynomial(r, T::EXP));
    if vanishes { T::ZERO } else { scale(y, n) }
}

/// eˣ of an argument given in f64, so that a large one has no rounding of its own.
///
/// At x = −80 half an ulp of an f32 argument is 3.8·10⁻⁶ of the result. The range is reduced in
/// f64, P(r) evaluated in `T`, and the result rounded once. For f64 this is [`exp`].
///
/// # Domain
/// Any number.
///
/// # Returns
/// 0 to ∞; what exceeds `T` is ∞ or 0, denormals are rounded once.
///
/// # Special cases
/// As [`exp`].
///
/// # Accuracy
/// f32 ≤ 0.75 ulp of the exact power of the f64 argument (worst at x = −25.247), f64 as [`exp`].
///
/// # Example
/// ```
/// use microsurface::elementary::exp_wide;
/// let y: f32 = exp_wide(-80.1_f64);
/// assert!((f64::from(y) / 1.6330970697166730e-35 - 1.0).abs() < 1e-7);
/// ```
#[must_use]
#[inline(always)]
pub fn exp_wide<T: Real>(x: T::Wide) -> T {
    let (x, vanishes) = within_range::<T::Wide, T>(x);
    let (y, n) = reduced_wide::<T>(x);
    // What is subnormal in f32 is not in f64.
    let y = T::narrow(if T::WIDENS { y * n.exp2_of_integer() } else { scale(y, n) });
    if vanishes { T::ZERO } else { y }
}

/// eˣ in `T` of an |x| ≤ 700 in f64.
#[inline(always)]
pub(super) fn exp_of_normal_range<T: Real>(x: T::Wide) -> T {
    let n = round(x * T::Wide::lit(core::f64::consts::LOG2_E));
    let r = x - n * T::Wide::lit(core::f64::consts::LN_2);
    let s = T::narrow(r);
    let y = T::Wide::ONE + (r + (s * s * polynomial(s, T::EXP)).widen());
    T::narrow(y * n.exp2_of_integer())
}

/// eˣ − 1, accurate relative to itself also near 0.
///
/// # Domain
/// Any number.
///
/// # Returns
/// −1 to ∞.
///
/// # Special cases
/// ±0 → ±0, −∞ → −1, ∞ → ∞, NaN → NaN; denormals are returned as they are.
///
/// # Accuracy
/// f32 ≤ 2 ulp (worst at x = 0.34835), f64 ≤ 1.5 ulp (worst at x = ½ ln 2).
///
/// # Example
/// ```
/// use microsurface::elementary::exp_m1;
/// assert_eq!(exp_m1(1e-20_f64), 1e-20);
/// assert!((exp_m1(1.0_f64) - (core::f64::consts::E - 1.0)).abs() < 5e-16);
/// ```
#[must_use]
#[inline(always)]
pub fn exp_m1<T: Real>(x: T) -> T {
    // below, the result is -1 to rounding
    let bottom = T::lit(-64.0);
    let top = T::lit(T::EXP_RANGE.0);
    let y = if x > top { top } else { x };
    let y = if y < bottom { bottom } else { y };
    let n = round(y * T::lit(core::f64::consts::LOG2_E));
    let low = -(n * T::lit(T::LN_2.1));
    let high = y - n * T::lit(T::LN_2.0);
    let r = high + low;
    let p = high + (low + r * r * polynomial(r, T::EXP));
    // 2ⁿ(p + 1) - 1 = 2^n₂·(2^n₁·p + (2^n₁ - 2^-n₂)): the bracket of powers is exact, or 1 is
    // negligible
    let n1 = round(n * T::HALF);
    let n2 = n - n1;
    let s1 = n1.exp2_of_integer();
    let result = (s1 * p + (s1 - (-n2).exp2_of_integer())) * n2.exp2_of_integer();
    // keeps the sign of zero and denormals
    if x.abs() < T::EPSILON * T::HALF { x } else { result }
}

/// e^(−x²), the square formed without rounding.
///
/// x² = h² + (x − h)(x + h), where h is x with the lower half of its digits zeroed: h² is exact,
/// and the second term joins after the range reduction. Squaring first would lose x² ulp.
///
/// # Domain
/// Any number.
///
/// # Returns
/// 0 to 1.
///
/// # Special cases
/// ±∞ → 0, ±0 → 1, NaN → NaN.
///
/// # Accuracy
/// f32 ≤ 1 ulp (worst at x = 0.586), f64 ≤ 1 ulp (worst at x = 9.6).
///
/// # Example
/// ```
/// use microsurface::elementary::exp_neg_square;
/// assert_eq!(exp_neg_square(0.0_f32), 1.0);
/// assert!((exp_neg_square(5.3_f64) / 6.3192858851753786e-13 - 1.0).abs() < 3e-16);
/// ```
///
/// # References
/// W. J. Cody, "Rational Chebyshev approximations for the error function", Math. Comp. 23 (1969),
/// for the split.
#[must_use]
#[inline(always)]
pub fn exp_neg_square<T: Real>(x: T) -> T {
    let (square, tail) = square(x);
    exp_of_sum(-square, -tail)
}

/// x² as a sum, the first exact where it is finite.
#[inline(always)]
pub(super) fn square<T: Real>(x: T) -> (T, T) {
    // far enough that e^(x²) overflows and e^(-x²) vanishes
    let far = T::lit(30.0);
    let x = x.abs();
    let x = if x > far { far } else { x };
    let upper = x.upper_half();
    // The upper half of a NaN may be ∞, but not with its product added.
    (upper * upper + T::ZERO * x, (x - upper) * (x + upper))
}
