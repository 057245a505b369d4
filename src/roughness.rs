//! Slope widths: checked α, roughness matrices, and the maps from artists' parameters, each named after its
//! source.
//!
//! `alpha` is always the slope width α of the mathematics; `roughness`, `sharpness` and `anisotropy` are
//! artists' parameters that the functions here turn into α.

use crate::Real;
use crate::error::Error;
use crate::map::{Gram, Map, difference_of_products};
use crate::microsurface::Microsurface;

/// The smallest and the largest α that constructors accept: 2⁻³¹ … 2³¹ for f32, 2⁻²⁵⁵ … 2²⁵⁵ for f64.
///
/// Within it, α⁴ and 1/α⁴ neither over- nor underflow, so that no intermediate result of an evaluation does.
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
    if alpha >= smallest && alpha <= largest { Ok(alpha) } else { Err(Error::alpha(alpha)) }
}

/// The α that [`clamped`] puts in the place of 0: 2⁻²⁰ ≈ 9.5e-7 for f32, 2⁻¹⁶⁸ for f64.
///
/// A surface of it is a mirror on any display, and a density whose *square* is finite, which the power
/// heuristic of multiple importance sampling needs. The density of reflection by visible normals is at
/// most D(z)/(4 σ) at the horizon: 0.16/α³ for GGX, 0.29/α³ for Beckmann, 3.3/α³ for GTR of γ = 10.
#[inline]
#[must_use]
pub fn mirror_alpha<T: Real>() -> T {
    T::lit(if T::WIDENS { 9.5367431640625e-7 } else { 2.6727647100921956e-51 })
}

/// α limited to [[`mirror_alpha`], the largest of [`alpha_range`]]; NaN becomes the smallest of these.
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

/// A symmetric positive definite 2×2 matrix A in units of α² (slope²): the roughness of a surface that need not
/// be aligned with the axes.
///
/// D = 1/(π √det A (wmᵀA⁻¹wm + wm.z²)²) for GGX; A is twice the covariance of the slopes of a Beckmann surface.
///
/// # Numerics
/// The matrix is held as a triangular factor R, A = RᵀR, in units of α. Entries of A lose the smaller
/// principal α where the ratio of both is κ: its relative error is κ² ε/2, all digits beyond κ = 2900
/// in f32. The factor holds every ratio, with the direction of the axes to a rounding. So
/// [`rotated`](Self::rotated) and [`Microsurface::roughness_matrix`] never form α², and
/// [`entries`](Self::entries) is the only way that does.
///
/// # Example
/// ```
/// use microsurface::{Beckmann, Ndf, glam::Vec3, roughness::RoughnessMatrix};
/// let matrix = RoughnessMatrix::rotated(0.1_f32, 0.4, 0.5)?;
/// let [alpha_max, alpha_min, angle] = matrix.principal();
/// assert!((alpha_max - 0.4).abs() < 1e-6 && (alpha_min - 0.1).abs() < 1e-6);
/// assert!((angle - (0.5 - core::f32::consts::FRAC_PI_2)).abs() < 1e-6);
/// let surface = Beckmann::from_roughness_matrix(matrix);
/// assert!((surface.d(Vec3::Z) * core::f32::consts::PI * 0.04 - 1.0).abs() < 1e-6);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Heitz 2014, §5.4; Kaplanyan, Hill, Patney and Lefohn 2016; Tokuyoshi and Kaplanyan 2019, supplement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughnessMatrix<T> {
    /// R = [[r11, r12], [0, r22]], r11 and r22 above 0.
    r11: T,
    r12: T,
    r22: T,
}

impl<T: Real> RoughnessMatrix<T> {
    /// The matrix [[xx, xy], [xy, yy]].
    ///
    /// # Errors
    /// [`Error::RoughnessMatrix`] unless it is finite, positive definite (its determinant is computed without
    /// cancellation) and both principal α are within [`alpha_range`].
    ///
    /// # Accuracy
    /// The entries are taken as exact. Where they are roundings of a rotated pair of widths of the ratio
    /// κ, the smaller width that they hold is off by κ² ε/2: take [`rotated`](Self::rotated) for those.
    #[inline]
    pub fn new(xx: T, xy: T, yy: T) -> Result<Self, Error> {
        let gram = Self::gram_of_entries([xx, xy, yy]);
        let positive = xx > T::ZERO && yy > T::ZERO && gram.root > 0.0;
        if positive && gram.in_range::<T>() {
            return Ok(Self::of_gram(gram));
        }
        let [xx, xy, yy] = [xx, xy, yy].map(T::to_f64);
        Err(Error::RoughnessMatrix { xx, xy, yy, determinant: difference_of_products(xx, yy, xy, xy) })
    }

    /// The matrix of entries that [`new`](Self::new) has accepted.
    #[inline(always)]
    pub(crate) fn of_checked(entries: [T; 3]) -> Self {
        Self::of_gram(Self::gram_of_entries(entries))
    }

    /// The matrix RᵀR of the upper triangular R = [[r11, r12], [0, r22]] with a positive diagonal.
    #[inline(always)]
    pub(crate) const fn of_factor([r11, r12, r22]: [T; 3]) -> Self {
        Self { r11, r12, r22 }
    }

    /// The matrix RᵀR of any upper triangular R, with every bit of R kept but the signs of its rows.
    ///
    /// # Errors
    /// [`Error::RoughnessMatrix`] unless R is finite and both principal α are within [`alpha_range`].
    #[cfg(feature = "serde")]
    pub(crate) fn checked_factor([r11, r12, r22]: [T; 3]) -> Result<Self, Error> {
        let r12 = if r11 < T::ZERO { -r12 } else { r12 };
        let matrix = Self::of_factor([r11.abs(), r12, r22.abs()]);
        let gram = matrix.gram();
        if gram.in_range::<T>() {
            return Ok(matrix);
        }
        let Gram { xx, xy, yy, root } = gram;
        Err(Error::RoughnessMatrix { xx, xy, yy, determinant: root * root })
    }

    /// R as [r11, r12, r22].
    #[inline(always)]
    pub(crate) const fn factor(&self) -> [T; 3] {
        [self.r11, self.r12, self.r22]
    }

    /// Cholesky's factor, rounded once.
    #[inline(always)]
    fn of_gram(gram: Gram) -> Self {
        Self::of_factor(gram.factor().map(T::lit))
    }

    /// The matrix with α = `alpha_x` along the direction at `angle` radians from x, and `alpha_y` across it.
    ///
    /// Any ratio of the two is held; see the [type](Self).
    ///
    /// # Errors
    /// [`Error::Alpha`] for either α, [`Error::Parameter`] if the angle is not finite.
    ///
    /// # Accuracy
    /// `principal` gives both α back to 2 ε. The axes are turned by at most ε from the given angle,
    /// which moves the density of a surface of the ratio κ by about κ ε beside the highlight.
    ///
    /// # Example
    /// A scratch 1000 times as long as it is wide.
    /// ```
    /// use microsurface::{Ggx, Ndf, RoughnessMatrix, glam::Vec3};
    /// let scratched = Ggx::from_roughness_matrix(RoughnessMatrix::rotated(1.0, 0.001_f32, 1.0225885)?);
    /// let peak = 1.0 / (core::f32::consts::PI * 1.0 * 0.001);
    /// assert!((scratched.d(Vec3::Z) / peak - 1.0).abs() < 3e-7);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    pub fn rotated(alpha_x: T, alpha_y: T, angle: T) -> Result<Self, Error> {
        let [x, y] = [checked(alpha_x)?, checked(alpha_y)?].map(T::to_f64);
        let angle = angle.to_f64();
        if !angle.is_finite() {
            return Err(Error::Parameter { name: "angle", value: angle });
        }
        let (s, c) = (crate::real::construction::sin(angle), crate::real::construction::cos(angle));
        let ((xc, xs), (yc, ys)) = ((x * c, x * s), (y * c, y * s));
        Ok(Self::of_gram(Gram {
            xx: xc * xc + ys * ys,
            xy: (x - y) * (x + y) * (s * c),
            yy: xs * xs + yc * yc,
            root: x * y,
        }))
    }

    /// The entries [xx, xy, yy] of A.
    ///
    /// # Accuracy
    /// Each is rounded once. As a matrix they hold the smaller principal α to κ² ε/2, κ the ratio of
    /// the larger to it: no digit from κ = 2900 on in f32, 7e7 in f64.
    #[inline]
    #[must_use]
    pub fn entries(&self) -> [T; 3] {
        let Gram { xx, xy, yy, .. } = self.gram();
        [xx, xy, yy].map(T::lit)
    }

    /// The larger and the smaller principal α, and the angle in (−π/2, π/2] of the direction of the larger.
    ///
    /// The angle is 0 for a multiple of the identity.
    #[must_use]
    pub fn principal(&self) -> [T; 3] {
        let gram = self.gram();
        let [largest, smallest] = gram.principal();
        let angle = 0.5 * crate::real::construction::atan2(2.0 * gram.xy, gram.xx - gram.yy);
        [largest, smallest, angle].map(T::lit)
    }

    fn gram(&self) -> Gram {
        Gram::of_factor(self.factor().map(T::to_f64))
    }

    fn gram_of_entries(entries: [T; 3]) -> Gram {
        let [xx, xy, yy] = entries.map(T::to_f64);
        Gram { xx, xy, yy, root: Real::sqrt(difference_of_products(xx, yy, xy, xy)) }
    }
}

impl<T: Real> From<RoughnessMatrix<T>> for [T; 3] {
    #[inline]
    fn from(matrix: RoughnessMatrix<T>) -> Self {
        matrix.entries()
    }
}

impl<T: Real> TryFrom<[T; 3]> for RoughnessMatrix<T> {
    type Error = Error;
    #[inline]
    fn try_from([xx, xy, yy]: [T; 3]) -> Result<Self, Error> {
        Self::new(xx, xy, yy)
    }
}

impl<P, M: Map> Microsurface<P, M> {
    /// The roughness matrix A = RᵀR of the map, R = M⁻¹, to the last bit: the surface of it has the same map.
    ///
    /// It is the roughness of the whole surface for the shape-invariant profiles (GGX, Beckmann), whose own width
    /// is 1; for GTR it is what the map does to the profile.
    ///
    /// # Errors
    /// Never at present: every map is held.
    pub fn roughness_matrix(&self) -> Result<RoughnessMatrix<M::Scalar>, Error> {
        let [[r11, r12], [_, r22]] = self.map().inverse();
        Ok(RoughnessMatrix::of_factor([r11, r12, r22]))
    }
}

fn parameter<T: Real>(name: &'static str, value: T, smallest: f64, largest: f64) -> Result<T, Error> {
    let v = value.to_f64();
    if v >= smallest && v <= largest { Ok(value) } else { Err(Error::Parameter { name, value: v }) }
}

/// x limited to [`smallest`, `largest`]; NaN becomes `smallest`.
#[inline(always)]
fn within<T: Real>(x: T, smallest: f64, largest: f64) -> T {
    x.max(T::lit(smallest)).min(T::lit(largest))
}

/// α = r²: perceptually even steps of the artist's roughness r ∈ (0, 1].
///
/// # Errors
/// [`Error::Parameter`] unless 0 ≤ r ≤ 1, [`Error::Alpha`] where r² is below [`alpha_range`]. For textures
/// take [`alpha_burley2012_clamped`].
///
/// # References
/// Burley 2012, "Physically-based shading at Disney", §5.4; also Unreal, Filament, Bevy, OpenPBR.
#[inline]
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
/// assert_eq!([0.0, 0.5, 1.2].map(alpha_burley2012_clamped::<f32>), [mirror_alpha(), 0.25, 1.0]);
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
/// [`Error::Parameter`] unless r ≥ 0, [`Error::Alpha`] where √r is outside [`alpha_range`]. For textures take
/// [`alpha_pbrt4_clamped`].
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
/// [`Error::Parameter`] unless 0 ≤ s ≤ 1, [`Error::Alpha`] where (1 − s)² is below [`alpha_range`], as at
/// s = 1, a mirror. For textures take [`alpha_dimov2015_clamped`].
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
/// [`Error::Parameter`] unless n is finite and at least 0, [`Error::Alpha`] where α is below [`alpha_range`]:
/// from n = 9.2e18 on for f32, 6.7e153 for f64.
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
/// [`Error::Parameter`] for r or a outside [0, 1], [`Error::Alpha`] where an α is below [`alpha_range`]. For
/// textures take [`alphas_burley2012_clamped`].
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
/// [`Error::Parameter`] for r outside [0, 1] or a outside [−1, 1], [`Error::Alpha`] where an α vanishes. For
/// textures take [`alphas_kulla2017_clamped`].
///
/// # References
/// Kulla and Conty 2017, "Revisiting physically based shading at Imageworks"; also Filament.
#[inline]
pub fn alphas_kulla2017<T: Real>(roughness: T, anisotropy: T) -> Result<[T; 2], Error> {
    let r = parameter("roughness", roughness, 0.0, 1.0)?;
    both_checked(kulla2017(r, parameter("anisotropy", anisotropy, -1.0, 1.0)?))
}

/// [αx, αy] of a texel: [`alphas_kulla2017`] of r limited to [0, 1] and a to [−1, 1], each α [`clamped`].
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
/// [`Error::Parameter`] for r or a outside [0, 1], [`Error::Alpha`] where an α vanishes. For textures take
/// [`alphas_openpbr_clamped`].
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
