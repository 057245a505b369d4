//! The range of slope widths α, and what keeps a width within it.

use crate::Real;
use crate::error::Error;

/// The smallest and the largest α that constructors accept: 2⁻³¹ … 2³¹ for f32, 2⁻²⁵⁵ … 2²⁵⁵ for
/// f64.
///
/// Within it, α⁴ and 1/α⁴ neither over- nor underflow, so that no intermediate result of an
/// evaluation does.
#[inline]
#[must_use]
pub fn alpha_range<T: Real>() -> (T, T) {
    // The smallest normal number is 2⁻¹²⁶ or 2⁻¹⁰²²; a quarter of the exponent, rounded up.
    let smallest = (T::MIN_POSITIVE + T::MIN_POSITIVE) * T::TWO;
    let smallest = smallest.sqrt().sqrt();
    (smallest, T::ONE / smallest)
}

/// α itself if it is a finite number within [`alpha_range`].
///
/// # Errors
/// [`Error::Alpha`], for 0, −0, negative numbers, NaN and infinities too.
///
/// # Example
/// ```
/// use microsurface::roughness::checked;
/// assert_eq!(checked(0.2_f32), Ok(0.2));
/// assert!(checked(0.0_f32).unwrap_err().to_string().contains("alpha = 0"));
/// ```
#[inline]
pub fn checked<T: Real>(alpha: T) -> Result<T, Error> {
    let (smallest, largest) = alpha_range();
    if alpha >= smallest && alpha <= largest { Ok(alpha) } else { Err(refused(alpha)) }
}

/// The α that [`clamped`] puts in the place of 0: 2⁻²⁰ ≈ 9.5e-7 for f32, 2⁻¹⁶⁸ for f64.
///
/// A surface of it is a mirror on any display, and a density whose *square* is finite, which the
/// power heuristic of multiple importance sampling needs. The density of reflection by visible
/// normals is at most D(z)/(4 σ) at the horizon: 0.16/α³ for GGX, 0.29/α³ for Beckmann, 3.3/α³ for
/// GTR of γ = 10.
#[inline]
#[must_use]
pub fn mirror_alpha<T: Real>() -> T {
    T::lit(if T::WIDENS { 9.5367431640625e-7 } else { 2.6727647100921956e-51 })
}

/// α limited to [[`mirror_alpha`], the largest of [`alpha_range`]]; NaN becomes the smallest of
/// these.
///
/// For callers who would rather have a mirror than an error where a texture holds 0.
///
/// # Example
/// ```
/// use microsurface::roughness::{clamped, mirror_alpha};
/// assert_eq!([0.0, 0.3, f32::NAN].map(clamped), [mirror_alpha(), 0.3, mirror_alpha()]);
/// ```
#[inline]
#[must_use]
pub fn clamped<T: Real>(alpha: T) -> T {
    alpha.max(mirror_alpha()).min(alpha_range::<T>().1)
}

/// The error of an α out of range.
pub(crate) fn refused<T: Real>(alpha: T) -> Error {
    let (smallest, largest) = alpha_range::<T>();
    Error::Alpha { value: alpha.to_f64(), smallest: smallest.to_f64(), largest: largest.to_f64() }
}
