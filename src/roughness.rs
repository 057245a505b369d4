//! Maps from artists' parameters to slope widths α, each named after its source.
//!
//! `alpha` is always the slope width α of the mathematics; `roughness`, `sharpness` and
//! `anisotropy` are artists' parameters that the functions here turn into α.

use crate::Real;
pub use crate::alpha::{alpha_range, checked, clamped, mirror_alpha};
use crate::error::Error;

fn parameter<T: Real>(name: &'static str, value: T, smallest: f64, largest: f64) -> Result<T, Error> {
    let v = value.to_f64();
    if v >= smallest && v <= largest {
        Ok(value)
    } else {
        Err(Error::Parameter { name, value: v, smallest, largest })
    }
}

/// x limited to [`smallest`, `largest`]; NaN becomes `smallest`.
#[inline(always)]
fn within<T: Real>(x: T, smallest: f64, largest: f64) -> T {
    x.max(T::lit(smallest)).min(T::lit(largest))
}

/// α = r²: perceptually even steps of the artist's roughness r ∈ (0, 1].
///
/// # Errors
/// [`Error::Parameter`] unless 0 ≤ r ≤ 1, [`Error::Alpha`] where r² is below [`alpha_range`]. For
/// textures take [`alpha_burley2012_clamped`].
///
/// # References
/// Burley 2012, "Physically-based shading at Disney", §5.4; also Unreal, Filament, Bevy, OpenPBR.
#[inline]
#[doc(alias("disney", "perceptual roughness"))]
pub fn alpha_burley2012<T: Real>(roughness: T) -> Result<T, Error> {
    let r = parameter("roughness", roughness, 0.0, 1.0)?;
    checked(r * r)
}

/// α = r² of a texel: [`alpha_burley2012`] of r limited to [0, 1], and [`clamped`].
///
/// # Special cases
/// r ≤ 0, or NaN → [`mirror_alpha`].
///
/// # Example
/// ```
/// use microsurface::roughness::{alpha_burley2012_clamped, mirror_alpha};
/// assert_eq!([0.0_f32, 0.5, 1.2].map(alpha_burley2012_clamped), [mirror_alpha(), 0.25, 1.0]);
/// ```
#[inline(always)]
#[must_use]
pub fn alpha_burley2012_clamped<T: Real>(roughness: T) -> T {
    let r = within(roughness, 0.0, 1.0);
    clamped(r * r)
}

/// α = √r: pbrt-v4's roughness.
///
/// # Errors
/// [`Error::Parameter`] unless r ≥ 0, [`Error::Alpha`] where √r is outside [`alpha_range`]. For
/// textures take [`alpha_pbrt4_clamped`].
///
/// # References
/// Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", §9.6.
#[inline]
pub fn alpha_pbrt4<T: Real>(roughness: T) -> Result<T, Error> {
    let r = parameter("roughness", roughness, 0.0, f64::INFINITY)?;
    checked(r.sqrt())
}

/// α = √r of a texel: [`alpha_pbrt4`], and [`clamped`].
///
/// # Special cases
/// r ≤ 0, or NaN → [`mirror_alpha`].
#[inline(always)]
#[must_use]
pub fn alpha_pbrt4_clamped<T: Real>(roughness: T) -> T {
    clamped(within(roughness, 0.0, f64::INFINITY).sqrt())
}

/// α = (1 − s)²: V-Ray's sharpness (glossiness) s ∈ [0, 1).
///
/// # Errors
/// [`Error::Parameter`] unless 0 ≤ s ≤ 1, [`Error::Alpha`] where (1 − s)² is below [`alpha_range`],
/// as at s = 1, a mirror. For textures take [`alpha_dimov2015_clamped`].
///
/// # References
/// Dimov 2015, §7.
#[inline]
pub fn alpha_dimov2015<T: Real>(sharpness: T) -> Result<T, Error> {
    let s = parameter("sharpness", sharpness, 0.0, 1.0)?;
    checked((T::ONE - s) * (T::ONE - s))
}

/// α = (1 − s)² of a texel: [`alpha_dimov2015`] of s limited to [0, 1], and [`clamped`].
///
/// # Special cases
/// s ≥ 1 → [`mirror_alpha`]; NaN counts as 0.
#[inline(always)]
#[must_use]
pub fn alpha_dimov2015_clamped<T: Real>(sharpness: T) -> T {
    let rest = T::ONE - within(sharpness, 0.0, 1.0);
    clamped(rest * rest)
}

/// α = √(2/(n + 2)): the Beckmann width that resembles a Blinn–Phong exponent n ≥ 0.
///
/// # Errors
/// [`Error::Parameter`] unless n is finite and at least 0, [`Error::Alpha`] where α is below
/// [`alpha_range`]: from n = 9.2e18 on for f32, 6.7e153 for f64.
///
/// # References
/// Walter, Marschner, Li and Torrance 2007, §5.2.
#[inline]
pub fn alpha_walter2007<T: Real>(exponent: T) -> Result<T, Error> {
    let n = parameter("exponent", exponent, 0.0, T::MAX.to_f64())?;
    checked((T::TWO / (n + T::TWO)).sqrt())
}

/// [αx, αy] = [r²/k, r² k] with aspect k = √(1 − 0.9 a), a ∈ [0, 1].
///
/// # Errors
/// [`Error::Parameter`] for r or a outside [0, 1], [`Error::Alpha`] where an α is below
/// [`alpha_range`]. For textures take [`alphas_burley2012_clamped`].
///
/// # References
/// Burley 2012, §5.4.
#[inline]
pub fn alphas_burley2012<T: Real>(roughness: T, anisotropic: T) -> Result<[T; 2], Error> {
    let r = parameter("roughness", roughness, 0.0, 1.0)?;
    both_checked(burley2012(r, parameter("anisotropic", anisotropic, 0.0, 1.0)?))
}

/// [αx, αy] of a texel: [`alphas_burley2012`] of r and a limited to [0, 1], each α [`clamped`].
#[inline(always)]
#[must_use]
pub fn alphas_burley2012_clamped<T: Real>(roughness: T, anisotropic: T) -> [T; 2] {
    burley2012(within(roughness, 0.0, 1.0), within(anisotropic, 0.0, 1.0)).map(clamped)
}

#[inline(always)]
fn burley2012<T: Real>(r: T, a: T) -> [T; 2] {
    let (alpha, aspect) = (r * r, (T::ONE - T::lit(0.9) * a).sqrt());
    [alpha / aspect, alpha * aspect]
}

/// [αx, αy] = [r² (1 + a), r² (1 − a)], a ∈ (−1, 1): negative values turn the highlight by 90°.
///
/// # Errors
/// [`Error::Parameter`] for r outside [0, 1] or a outside [−1, 1], [`Error::Alpha`] where an α
/// vanishes. For textures take [`alphas_kulla2017_clamped`].
///
/// # References
/// Kulla and Conty 2017, "Revisiting physically based shading at Imageworks"; also Filament.
#[inline]
pub fn alphas_kulla2017<T: Real>(roughness: T, anisotropy: T) -> Result<[T; 2], Error> {
    let r = parameter("roughness", roughness, 0.0, 1.0)?;
    both_checked(kulla2017(r, parameter("anisotropy", anisotropy, -1.0, 1.0)?))
}

/// [αx, αy] of a texel: [`alphas_kulla2017`] of r limited to [0, 1] and a to [−1, 1], each α
/// [`clamped`].
///
/// Where one α vanishes, at a = ±1, the other is kept.
///
/// # Special cases
/// NaN counts as r = 0 or a = −1.
///
/// # Example
/// ```
/// use microsurface::roughness::{alphas_kulla2017, alphas_kulla2017_clamped, mirror_alpha};
/// assert!(alphas_kulla2017(0.5_f32, 1.0).is_err());
/// assert_eq!(alphas_kulla2017_clamped(0.5_f32, 1.0), [0.5, mirror_alpha()]);
/// ```
#[inline(always)]
#[must_use]
pub fn alphas_kulla2017_clamped<T: Real>(roughness: T, anisotropy: T) -> [T; 2] {
    kulla2017(within(roughness, 0.0, 1.0), within(anisotropy, -1.0, 1.0)).map(clamped)
}

#[inline(always)]
fn kulla2017<T: Real>(r: T, a: T) -> [T; 2] {
    let alpha = r * r;
    [alpha * (T::ONE + a), alpha * (T::ONE - a)]
}

/// [αx, αy] = [r² √(2/(1 + b²)), r² b √(2/(1 + b²))] with b = 1 − a: αx² + αy² stays 2 r⁴.
///
/// # Errors
/// [`Error::Parameter`] for r or a outside [0, 1], [`Error::Alpha`] where an α vanishes. For
/// textures take [`alphas_openpbr_clamped`].
///
/// # References
/// OpenPBR Surface 1.1 specification, "Microfacet model".
#[inline]
pub fn alphas_openpbr<T: Real>(roughness: T, anisotropy: T) -> Result<[T; 2], Error> {
    let r = parameter("roughness", roughness, 0.0, 1.0)?;
    both_checked(openpbr(r, parameter("anisotropy", anisotropy, 0.0, 1.0)?))
}

/// [αx, αy] of a texel: [`alphas_openpbr`] of r and a limited to [0, 1], each α [`clamped`].
///
/// Where αy vanishes, at a = 1, αx is kept.
#[inline(always)]
#[must_use]
pub fn alphas_openpbr_clamped<T: Real>(roughness: T, anisotropy: T) -> [T; 2] {
    openpbr(within(roughness, 0.0, 1.0), within(anisotropy, 0.0, 1.0)).map(clamped)
}

#[inline(always)]
fn openpbr<T: Real>(r: T, a: T) -> [T; 2] {
    let b = T::ONE - a;
    let alpha_x = (r * r) * (T::TWO / (T::ONE + b * b)).sqrt();
    [alpha_x, b * alpha_x]
}

fn both_checked<T: Real>([x, y]: [T; 2]) -> Result<[T; 2], Error> {
    Ok([checked(x)?, checked(y)?])
}
