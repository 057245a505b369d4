//! Logarithms and powers.
//!
//! x = m·2ᵏ with √½ ≤ m < √2, f = m − 1, s = f/(2 + f): ln m = ln((1+s)/(1−s)) = f − s·(f −
//! s²·P(s²)), and the first f is split off half its square so that little is lost to rounding
//! (fdlibm's arrangement).

use super::bits::Bits;
use super::exp::{exp_of_normal_range, exp_of_sum, round};
use super::exp_wide;
use super::polynomial::polynomial;
use crate::real::Real;

/// ⅔ as a sum whose first term has half the digits of an f64.
const TWO_THIRDS: (f64, f64) = (0.6666666716337204, -4.967053731282552e-09);

/// m − 1 and k of x = m·2ᵏ, for positive finite x.
#[inline(always)]
fn split<T: Real>(x: T) -> (T, T) {
    let (factor, digits) = T::DENORMAL_SCALE;
    let small = x < T::MIN_POSITIVE;
    let normal = if small { x * T::lit(factor) } else { x };
    let (m, k) = normal.split_exponent();
    (m - T::ONE, if small { k - T::lit(digits) } else { k })
}

/// ln(1 + f) + k·ln 2 for √½ ≤ 1 + f < √2.
#[inline(always)]
fn ln_of_parts<T: Real>(f: T, k: T, c: &'static [f64]) -> T {
    let s = f / (T::TWO + f);
    let z = s * s;
    let half_square = T::HALF * f * f;
    let tail = s * (half_square + z * polynomial(z, c)) + k * T::lit(T::LN_2.1);
    k * T::lit(T::LN_2.0) + (f - (half_square - tail))
}

/// The logarithm where x is 0, negative, infinite or NaN; `y` elsewhere.
#[inline(always)]
fn ln_special<T: Real>(x: T, y: T) -> T {
    let y = if x < T::INFINITY { y } else { x };
    let y = if x == T::ZERO { -T::INFINITY } else { y };
    if x < T::ZERO { T::lit(f64::NAN) } else { y }
}

/// The natural logarithm.
///
/// # Domain
/// x ≥ 0, denormals included.
///
/// # Returns
/// −∞ to ∞.
///
/// # Special cases
/// ±0 → −∞, ∞ → ∞, negative → NaN, NaN → NaN, 1 → 0.
///
/// # Accuracy
/// f32 ≤ 0.9 ulp (worst at x = 1.405), f64 ≤ 0.9 ulp (worst at x = √2); relative also near 1.
///
/// # Example
/// ```
/// use microsurface::elementary::ln;
/// assert_eq!(ln(1.0_f32), 0.0);
/// assert!((ln(2.0_f64) - core::f64::consts::LN_2).abs() < 2e-16);
/// ```
///
/// # References
/// The arrangement of the terms is that of fdlibm's `e_log.c` (Sun Microsystems 1993).
#[must_use]
#[inline(always)]
pub fn ln<T: Real>(x: T) -> T {
    let (f, k) = split(x);
    ln_special(x, ln_of_parts(f, k, T::LN))
}

/// The logarithm to base 2.
///
/// The natural one of the fraction is left a sum of two, and log₂ e is one, so that only the last
/// sum is rounded.
///
/// # Domain
/// x ≥ 0, denormals included.
///
/// # Returns
/// −∞ to ∞; exact at powers of two.
///
/// # Special cases
/// ±0 → −∞, ∞ → ∞, negative → NaN, NaN → NaN, 1 → 0.
///
/// # Accuracy
/// f32 ≤ 0.9 ulp (worst at x = 1.4129), f64 ≤ 0.7 ulp (worst at x = √2); relative also near 1.
///
/// # Example
/// ```
/// use microsurface::elementary::log2;
/// assert_eq!(log2(0.125_f32), -3.0);
/// assert!((log2(10.0_f64) - core::f64::consts::LOG2_10).abs() < 5e-16);
/// ```
///
/// # References
/// The sum is formed as in FreeBSD's `e_log2.c` (D. Schultz).
#[must_use]
#[inline(always)]
pub fn log2<T: Real>(x: T) -> T {
    let (f, k) = split(x);
    let s = f / (T::TWO + f);
    let z = s * s;
    let half_square = T::HALF * f * f;
    let high = (f - half_square).upper_half();
    let low = ((f - high) - half_square) + s * (half_square + z * polynomial(z, T::LN));
    let (log2_e, rest) = (T::lit(T::LOG2_E.0), T::lit(T::LOG2_E.1));
    let whole = high * log2_e;
    let sum = k + whole;
    ln_special(x, sum + (((k - sum) + whole) + (low * log2_e + (low + high) * rest)))
}

/// [`ln`] of a positive normal number, without what only others need.
#[inline(always)]
pub(crate) fn ln_normal<T: Real>(x: T) -> T {
    let (m, k) = x.split_exponent();
    ln_of_parts(m - T::ONE, k, T::LN)
}

/// [`ln_wide`] of a positive normal number.
#[inline(always)]
pub(crate) fn ln_normal_wide<T: Real>(x: T::Wide) -> T::Wide {
    let (m, k) = x.split_exponent();
    ln_of_parts(m - T::Wide::ONE, k, T::LN_WIDE)
}

/// The natural logarithm in f64, to as many digits as a power in `T` needs.
///
/// `exp_wide(g * ln_wide(x))` is xᵍ to an ulp in f32 for |g·ln x| ≤ 90. For f32 the polynomial is
/// three terms shorter than that of [`ln`] in f64; for f64 it is [`ln`].
///
/// # Domain
/// x ≥ 0, denormals included.
///
/// # Returns
/// −∞ to ∞.
///
/// # Special cases
/// As [`ln`].
///
/// # Accuracy
/// For f32 ≤ 2⁻³⁷ relative, for f64 as [`ln`].
///
/// # Example
/// ```
/// use microsurface::elementary::ln_wide;
/// assert!((ln_wide::<f32>(2.0) - core::f64::consts::LN_2).abs() < 1e-11);
/// ```
#[must_use]
#[inline(always)]
pub fn ln_wide<T: Real>(x: T::Wide) -> T::Wide {
    let (f, k) = split(x);
    ln_special(x, ln_of_parts(f, k, T::LN_WIDE))
}

/// ln(1 + x), accurate relative to itself also near 0.
///
/// 1 + x is rounded only to find its exponent k; its fraction is (x·2⁻ᵏ) + (2⁻ᵏ − 1).
///
/// # Domain
/// x ≥ −1.
///
/// # Returns
/// −∞ to ∞.
///
/// # Special cases
/// ±0 → ±0, −1 → −∞, below −1 → NaN, ∞ → ∞, NaN → NaN; denormals are returned as they are.
///
/// # Accuracy
/// f32 ≤ 1.6 ulp (worst at x = 0.420), f64 ≤ 1.5 ulp (worst at x = √2 − 1).
///
/// # Example
/// ```
/// use microsurface::elementary::ln_1p;
/// assert_eq!(ln_1p(1e-20_f64), 1e-20);
/// assert!((ln_1p(1.0_f64) - core::f64::consts::LN_2).abs() < 2e-16);
/// ```
#[must_use]
#[inline(always)]
pub fn ln_1p<T: Real>(x: T) -> T {
    let u = T::ONE + x;
    let (_, k) = u.split_exponent();
    // 2^-k·(1 + x) - 1 without the rounding of 1 + x; 2^-k itself may be denormal
    let (quarter, inverse) = (T::lit(0.25), (T::TWO - k).exp2_of_integer());
    let f = (quarter * x) * inverse + (quarter * inverse - T::ONE);
    let y = ln_special(u, ln_of_parts(f, k, T::LN));
    // keeps the sign of zero
    if x.abs() < T::EPSILON * T::HALF { x } else { y }
}

/// xᵍ of a basis given in f64.
///
/// For f32 the logarithm and its product with g are f64. For f64 they are carried as sums of two
/// numbers, to about 65 bits, since a power multiplies the relative error of the logarithm by g·ln
/// x.
///
/// # Domain
/// x ≥ 0, any finite g.
///
/// # Returns
/// 0 to ∞.
///
/// # Special cases
/// x⁰ = 1 for every x ≥ 0 and ∞; 0ᵍ is 0 for g > 0 and ∞ for g < 0; negative x → NaN even for
/// integer g; 1^±∞ → NaN; NaN → NaN, also where g = 0.
///
/// # Accuracy
/// For f64 ≤ 0.9 ulp with |g·ln x| ≤ 700 (worst at 0.231^9.70); f32 ≤ 0.8 ulp with |g·ln x| ≤ 90.
///
/// # Example
/// ```
/// use microsurface::elementary::pow_wide;
/// assert_eq!(pow_wide(2.0, 10.0_f32), 1024.0);
/// assert!((pow_wide(0.5, 0.5_f64) - core::f64::consts::FRAC_1_SQRT_2).abs() < 2e-16);
/// assert_eq!(pow_wide(0.0, 0.0_f32), 1.0);
/// ```
///
/// # References
/// The sums follow the outline of fdlibm's `e_pow.c` (Sun Microsystems 1993); products are split as
/// in T. J. Dekker, "A floating-point technique for extending the available precision", Numer.
/// Math. 18 (1971).
#[must_use]
#[inline(always)]
pub fn pow_wide<T: Real>(x: T::Wide, g: T) -> T {
    let y = if T::WIDENS { exp_wide(g.widen() * ln_wide::<T>(x)) } else { T::narrow(pow(x, g.widen())) };
    // 0⁰ = ∞⁰ = 1
    let one = if x >= T::Wide::ZERO { T::ONE } else { T::lit(f64::NAN) };
    if g == T::ZERO { one } else { y }
}

/// (numerator/denominator)^−g, for positive normal numbers in f64 and g ≥ 0, which spares a
/// division and what only zeros, denormals and NaN need; |g·ln| of the ratio is at most 700.
///
/// With the quotient q of the fractions within [√½, √2], ln q = 2 artanh s, s = (q−1)/(q+1).
#[inline(always)]
pub(crate) fn inverse_power_of_ratio<T: Real>(numerator: T::Wide, denominator: T::Wide, g: T) -> T {
    if !T::WIDENS {
        return pow_wide(numerator / denominator, -g);
    }
    let (n, k_n) = numerator.split_exponent();
    let (d, k_d) = denominator.split_exponent();
    let (half, root) = (T::Wide::HALF, T::Wide::lit(core::f64::consts::SQRT_2));
    // Of fractions within [√½, √2) the quotient is within (½, 2).
    let (above, below) = (n > root * d, d > root * n);
    let n = if above { half * n } else { n };
    let d = if below { half * d } else { d };
    let one = T::Wide::ONE;
    let k = (k_n - k_d) + if above { one } else { T::Wide::ZERO } - if below { one } else { T::Wide::ZERO };
    let s = (n - d) / (n + d);
    let z = s * s;
    let two = T::Wide::TWO;
    let ln = k * T::Wide::lit(core::f64::consts::LN_2) + s * (two + z * polynomial(z, T::LN_WIDE));
    exp_of_normal_range::<T>(-g.widen() * ln)
}

/// x^−g of a normal x ≥ 1 and 0 ≤ g ≤ 1 in the scalar itself, where its rounding of x may be borne.
///
/// log₂ x = k + l with |l| ≤ ½. The products of k with both halves of g are exact, and so is their
/// difference from the integer part of the exponent: only what is below 1 is rounded, to 6e-8 in
/// f32.
#[inline(always)]
pub(crate) fn inverse_root<T: Real>(x: T, g: T) -> T {
    if !T::WIDENS {
        return pow_wide(x.widen(), -g);
    }
    let (m, k) = x.split_exponent();
    let f = m - T::ONE;
    let s = f / (T::TWO + f);
    let z = s * s;
    let l = s * (T::TWO + z * polynomial(z, T::LN)) * T::lit(core::f64::consts::LOG2_E);
    let high = g.upper_half();
    let (a, b) = (high * k, (g - high) * k);
    let rest = b + g * l;
    let n = round(-(a + rest));
    let r = ((-a - n) - rest) * T::lit(core::f64::consts::LN_2);
    (T::ONE + (r + r * r * polynomial(r, T::EXP))) * n.exp2_of_integer()
}

/// x^g where no wider scalar is at hand: the logarithm and its product are carried as sums of two.
#[inline(always)]
fn pow<T: Real>(x: T, g: T) -> T {
    let (h, l) = ln_as_sum(x);
    let product = g * h;
    let (g_h, h_h) = (g.upper_half(), h.upper_half());
    let (g_l, h_l) = (g - g_h, h - h_h);
    let rest = (((g_h * h_h - product) + g_h * h_l) + g_l * h_h) + g_l * h_l;
    let tail = rest + g * l;
    // beyond, the power is 0 or infinite and the rest may be NaN
    exp_of_sum(product, if product.abs() < T::lit(1000.0) { tail } else { T::ZERO })
}

/// ln x as a sum, to about twelve more bits than the scalar has.
///
/// ln m = ⅔·s·(3 + s² + 3s⁴·P(s²)): s, s² and the bracket are sums of a half-length number and a
/// rest.
#[inline(always)]
fn ln_as_sum<T: Real>(x: T) -> (T, T) {
    let (f, k) = split(x);
    let three = T::lit(3.0);
    let d = T::TWO + f;
    let inverse = T::ONE / d;
    let s = f * inverse;
    let (s_h, d_h) = (s.upper_half(), d.upper_half());
    let d_l = (d - d_h) + (f - (d - T::TWO));
    let s_l = ((f - s_h * d_h) - s_h * d_l) * inverse;
    let z = s * s;
    let z_h = s_h * s_h;
    let r = s_l * (s + s_h) + three * (z * z) * polynomial(z, T::LN_POW);
    let t_h = (three + (z_h + r)).upper_half();
    let t_l = r - ((t_h - three) - z_h);
    let u = s_h * t_h;
    let v = s_l * t_h + t_l * s;
    let p_h = (u + v).upper_half();
    let p_l = v - (p_h - u);
    let two_thirds = T::TWO / three;
    let (c_h, c_l) = (T::lit(TWO_THIRDS.0), T::lit(TWO_THIRDS.1));
    let y_h = c_h * p_h;
    let y_l = c_l * p_h + p_l * two_thirds;
    let whole = k * T::lit(T::LN_2.0);
    let high = whole + y_h;
    let low = (y_h - (high - whole)) + (y_l + k * T::lit(T::LN_2.1));
    let sum = high + low;
    let rest = low - (sum - high);
    let special = ln_special(x, sum);
    (special, if special.is_finite() { rest } else { T::ZERO })
}
