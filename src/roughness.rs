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

/// The number nearest to `alpha` that [`checked`] accepts; NaN becomes the smallest.
///
/// For callers who would rather have a mirror than an error where a texture holds 0.
#[inline]
#[must_use]
pub fn clamped<T: Real>(alpha: T) -> T {
    let (smallest, largest) = alpha_range();
    alpha.max(smallest).min(largest)
}

/// A symmetric positive definite 2×2 matrix A in units of α² (slope²): the roughness of a surface that need not
/// be aligned with the axes.
///
/// D = 1/(π √det A (wmᵀA⁻¹wm + wm.z²)²) for GGX; A is twice the covariance of the slopes of a Beckmann surface.
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[T; 3]", into = "[T; 3]"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct RoughnessMatrix<T> {
    xx: T,
    xy: T,
    yy: T,
}

impl<T: Real> RoughnessMatrix<T> {
    /// The matrix [[xx, xy], [xy, yy]].
    ///
    /// # Errors
    /// [`Error::RoughnessMatrix`] unless it is finite, positive definite (its determinant is computed without
    /// cancellation) and both principal α are within [`alpha_range`].
    #[inline]
    pub fn new(xx: T, xy: T, yy: T) -> Result<Self, Error> {
        let matrix = Self { xx, xy, yy };
        let positive = xx > T::ZERO && yy > T::ZERO && matrix.determinant() > 0.0;
        if positive && matrix.gram().in_range::<T>() {
            return Ok(matrix);
        }
        Err(Error::RoughnessMatrix {
            xx: xx.to_f64(),
            xy: xy.to_f64(),
            yy: yy.to_f64(),
            determinant: matrix.determinant(),
        })
    }

    /// The matrix of entries that [`new`](Self::new) has accepted.
    #[inline(always)]
    pub(crate) const fn of_checked(xx: T, xy: T, yy: T) -> Self {
        Self { xx, xy, yy }
    }

    /// The matrix with α = `alpha_x` along the direction at `angle` radians from x, and `alpha_y` across it.
    ///
    /// # Errors
    /// [`Error::Alpha`] for either α, [`Error::RoughnessMatrix`] if the angle is not finite or if rounding the
    /// entries loses the smaller α (a ratio of about 1/√ε: 2900 for f32).
    pub fn rotated(alpha_x: T, alpha_y: T, angle: T) -> Result<Self, Error> {
        let [ax2, ay2] = [checked(alpha_x)?, checked(alpha_y)?].map(|a| a.to_f64() * a.to_f64());
        let (s, c) =
            (crate::real::construction::sin(angle.to_f64()), crate::real::construction::cos(angle.to_f64()));
        Self::new(
            T::lit(ax2 * c * c + ay2 * s * s),
            T::lit((ax2 - ay2) * s * c),
            T::lit(ax2 * s * s + ay2 * c * c),
        )
    }

    /// The entries [xx, xy, yy].
    #[inline]
    #[must_use]
    pub fn entries(&self) -> [T; 3] {
        [self.xx, self.xy, self.yy]
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

    fn determinant(&self) -> f64 {
        let [xx, xy, yy] = self.entries().map(T::to_f64);
        difference_of_products(xx, yy, xy, xy)
    }

    pub(crate) fn gram(&self) -> Gram {
        let [xx, xy, yy] = self.entries().map(T::to_f64);
        Gram { xx, xy, yy, root: Real::sqrt(self.determinant()) }
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
    /// The roughness matrix A = RᵀR of the map, R = M⁻¹.
    ///
    /// It is the roughness of the whole surface for the shape-invariant profiles (GGX, Beckmann), whose own width
    /// is 1; for GTR it is what the map does to the profile.
    ///
    /// # Errors
    /// [`Error::RoughnessMatrix`] where rounding the entries of A loses the smaller α; see
    /// [`RoughnessMatrix::rotated`].
    pub fn roughness_matrix(&self) -> Result<RoughnessMatrix<M::Scalar>, Error> {
        let [[r11, r12], [_, r22]] = self.map().inverse().map(|row| row.map(Real::to_f64));
        let entries = [r11 * r11, r11 * r12, r12 * r12 + r22 * r22].map(M::Scalar::lit);
        RoughnessMatrix::try_from(entries)
    }
}

fn parameter<T: Real>(name: &'static str, value: T, smallest: f64, largest: f64) -> Result<T, Error> {
    let v = value.to_f64();
    if v >= smallest && v <= largest { Ok(value) } else { Err(Error::Parameter { name, value: v }) }
}

/// α = r²: perceptually even steps of the artist's roughness r ∈ (0, 1].
///
/// # Errors
/// [`Error::Parameter`] unless 0 ≤ r ≤ 1, [`Error::Alpha`] where r² is below [`alpha_range`].
///
/// # References
/// Burley 2012, "Physically-based shading at Disney", §5.4; also Unreal, Filament, Bevy, OpenPBR.
#[inline]
pub fn alpha_burley2012<T: Real>(roughness: T) -> Result<T, Error> {
    let r = parameter("roughness", roughness, 0.0, 1.0)?;
    checked(r * r)
}

/// α = √r: pbrt-v4's roughness.
///
/// # Errors
/// [`Error::Parameter`] unless r ≥ 0, [`Error::Alpha`] where √r is outside [`alpha_range`].
///
/// # References
/// Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", §9.6.
#[inline]
pub fn alpha_pbrt4<T: Real>(roughness: T) -> Result<T, Error> {
    let r = parameter("roughness", roughness, 0.0, f64::INFINITY)?;
    checked(r.sqrt())
}

/// α = (1 − s)²: V-Ray's sharpness (glossiness) s ∈ [0, 1).
///
/// # Errors
/// [`Error::Parameter`] unless 0 ≤ s ≤ 1, [`Error::Alpha`] at s = 1, a mirror.
///
/// # References
/// Dimov 2015, §7.
#[inline]
pub fn alpha_dimov2015<T: Real>(sharpness: T) -> Result<T, Error> {
    let s = parameter("sharpness", sharpness, 0.0, 1.0)?;
    checked((T::ONE - s) * (T::ONE - s))
}

/// α = √(2/(n + 2)): the Beckmann width that resembles a Blinn–Phong exponent n ≥ 0.
///
/// # Errors
/// [`Error::Parameter`] unless n is finite and at least 0.
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
/// [`Error::Parameter`] for r or a outside [0, 1], [`Error::Alpha`] where r² is below [`alpha_range`].
///
/// # References
/// Burley 2012, §5.4.
#[inline]
pub fn alphas_burley2012<T: Real>(roughness: T, anisotropic: T) -> Result<[T; 2], Error> {
    let alpha = alpha_burley2012(roughness)?;
    let a = parameter("anisotropic", anisotropic, 0.0, 1.0)?;
    let aspect = (T::ONE - T::lit(0.9) * a).sqrt();
    Ok([checked(alpha / aspect)?, checked(alpha * aspect)?])
}

/// [αx, αy] = [r² (1 + a), r² (1 − a)], a ∈ (−1, 1): negative values turn the highlight by 90°.
///
/// # Errors
/// [`Error::Parameter`] for r outside [0, 1] or a outside [−1, 1], [`Error::Alpha`] where an α vanishes.
///
/// # References
/// Kulla and Conty 2017, "Revisiting physically based shading at Imageworks"; also Filament.
#[inline]
pub fn alphas_kulla2017<T: Real>(roughness: T, anisotropy: T) -> Result<[T; 2], Error> {
    let alpha = alpha_burley2012(roughness)?;
    let a = parameter("anisotropy", anisotropy, -1.0, 1.0)?;
    Ok([checked(alpha * (T::ONE + a))?, checked(alpha * (T::ONE - a))?])
}

/// [αx, αy] = [r² √(2/(1 + b²)), r² b √(2/(1 + b²))] with b = 1 − a: αx² + αy² stays 2 r⁴.
///
/// # Errors
/// [`Error::Parameter`] for r or a outside [0, 1], [`Error::Alpha`] where an α vanishes.
///
/// # References
/// OpenPBR Surface 1.1 specification, "Microfacet model".
#[inline]
pub fn alphas_openpbr<T: Real>(roughness: T, anisotropy: T) -> Result<[T; 2], Error> {
    let alpha = alpha_burley2012(roughness)?;
    let b = T::ONE - parameter("anisotropy", anisotropy, 0.0, 1.0)?;
    let alpha_x = alpha * (T::TWO / (T::ONE + b * b)).sqrt();
    Ok([checked(alpha_x)?, checked(b * alpha_x)?])
}
