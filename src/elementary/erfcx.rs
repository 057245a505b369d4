//! Scaled complementary error functions.

use super::exp::{exp_of_sum, square};
use super::polynomial::polynomial;
use crate::real::Real;

/// erfcx x for x ≥ 0.
#[inline(always)]
pub(super) fn erfcx_of_positive<T: Real>(x: T) -> T {
    let far = x > T::lit(T::FAR);
    let num = if far { T::FRAC_1_SQRT_PI } else { polynomial(x, T::ERFCX[0]) };
    let den = if far { x } else { polynomial(x, T::ERFCX[1]) };
    num / den
}

/// The scaled complementary error function e^(x²)·erfc x.
///
/// For x ≥ 0 one rational function with positive coefficients, or the asymptote 1/(√π x) where it
/// is that to rounding; for x < 0 reflected: 2e^(x²) − erfcx(−x).
///
/// # Domain
/// Any number.
///
/// # Returns
/// ∞ to 0, decreasing.
///
/// # Special cases
/// −∞ → ∞, overflow below x ≈ −9.38 (f32), −26.62 (f64) → ∞; 0 → 1; ∞ → 0; NaN → NaN.
///
/// # Accuracy
/// f32 ≤ 7 ulp (worst at x = 1189), f64 ≤ 5.5 ulp (worst at x = 16384).
///
/// # Example
/// ```
/// use microsurface::elementary::erfcx;
/// assert_eq!(erfcx(0.0_f64), 1.0);
/// assert!((erfcx(1.0_f64) - 0.4275835761558070).abs() < 4e-16);
/// ```
///
/// # References
/// NIST Digital Library of Mathematical Functions, §7.2 and §7.12.
#[must_use]
#[inline(always)]
pub fn erfcx<T: Real>(x: T) -> T {
    let y = erfcx_of_positive(x.abs());
    let (high, low) = square(x);
    if x < T::ZERO { T::TWO * exp_of_sum(high, low) - y } else { y }
}

/// [`ierfcx`] where neither its asymptote nor its sign is asked for, 0 ≤ x ≤ `T::FAR`.
#[inline(always)]
pub(crate) fn ierfcx_near<T: Real>(x: T) -> T {
    polynomial(x, T::IERFCX[0]) / polynomial(x, T::IERFCX[1])
}

/// The scaled integral of the complementary error function, e^(x²)·∫ₓ^∞ erfc(t)dt = 1/√π − x·erfcx
/// x.
///
/// Beckmann's masking is made of it: Λ(a) = e^(−a²)·ierfcx(a)/(2a). The difference on the right
/// cancels (at x = 100 its terms agree to four digits); this is a fit of the function itself by one
/// rational function with positive coefficients, or the asymptote 1/(2√π x²) where it is that to
/// rounding.
///
/// # Domain
/// x ≥ 0.
///
/// # Returns
/// 1/√π down to 0.
///
/// # Special cases
/// ±0 → 1/√π, ∞ → 0, negative → NaN, NaN → NaN. Where x² overflows the result underflows gradually.
///
/// # Accuracy
/// f32 ≤ 8.5 ulp (worst at x = 192.5), f64 ≤ 6 ulp (worst at x = 1.05·10⁷); f32 ≤ 6.5 ulp up to
/// x = 10.
///
/// # Example
/// ```
/// use microsurface::elementary::ierfcx;
/// assert_eq!(ierfcx(0.0_f64), 0.5641895835477563);
/// assert!((ierfcx(1.0_f64) - 0.13660600739194928).abs() < 2e-16);
/// assert!((ierfcx(1e10_f64) / 2.820947917738781e-21 - 1.0).abs() < 1e-15);
/// ```
///
/// # References
/// NIST Digital Library of Mathematical Functions, §7.18 (iⁿerfc, n = 1).
#[must_use]
#[inline(always)]
pub fn ierfcx<T: Real>(x: T) -> T {
    let far = x > T::lit(T::FAR);
    // scaled so that the square overflows no earlier than the result vanishes
    let unit = T::EPSILON;
    let num = if far { unit } else { polynomial(x, T::IERFCX[0]) };
    let den = if far { x * (x * (T::TWO * T::SQRT_PI * unit)) } else { polynomial(x, T::IERFCX[1]) };
    if x < T::ZERO { T::lit(f64::NAN) } else { num / den }
}
