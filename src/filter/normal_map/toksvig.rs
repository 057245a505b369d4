//! The spread of normals by the length of their average.

use crate::alpha::checked;
use crate::error::Error;
use crate::real::{Real, Vector};

/// The variance of slopes in each direction by the length of an average N of unit normals: (1
/// − |N|)/|N|.
///
/// For normals spread by σ in each direction, |N| is 1/(1 + σ²) to second order in σ. It knows of
/// no direction, and in slopes it is that about the average normal, without the factor of a tilt;
/// [`Moments`](super::Moments) know both. The two agree to σ² for isotropic spread about z.
///
/// # Domain
/// `average_normal`: not normalised; of an image, after decoding and before anything else.
///
/// # Special cases
/// |N| ≥ 1 → 0: rounding alone makes an average longer than its terms. N = 0 → ∞, NaN → NaN.
///
/// # Accuracy
/// The difference is that of the numbers given: |N| stored with an error δ leaves σ² uncertain by
/// δ. In 8 bits, δ = 1/255, no α below 0.09 is told from a mirror.
///
/// # Example
/// ```
/// use microsurface::{Ggx, filter::{Covariance, normal_map::variance_toksvig2005}, glam::Vec3};
/// let bumps = Vec3::new(0.2_f32, 0.0, 1.0).normalize() + Vec3::new(-0.2, 0.0, 1.0).normalize();
/// let variance: f32 = variance_toksvig2005(0.5 * bumps);
/// // Half of 0.2²: all of it is along x.
/// assert!((variance - (1.04_f32.sqrt() - 1.0)).abs() < 1e-6);
/// let surface = Ggx::isotropic(0.1_f32)?.filtered_isotropic(variance)?;
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Toksvig 2005, "Mipmapping normal maps".
#[inline]
#[must_use]
pub fn variance_toksvig2005<T: Real>(average_normal: impl Vector<3, Scalar = T>) -> T {
    let average_normal = T::Vec3::from(average_normal.components());
    let (length, missing) = length_and_missing::<T>(average_normal);
    T::lit(missing / length)
}

/// Toksvig's exponent s' = |N|s/(|N| + s(1 − |N|)) of a Blinn–Phong lobe of exponent s under an
/// average normal N.
///
/// 1/s' = 1/s + σ² of [`variance_toksvig2005`]: the same filter where α² = 2/s, and the one of
/// α'² = α² + 2σ². With [`alpha_walter2007`](crate::roughness::alpha_walter2007), α² = 2/(s + 2),
/// it is so for s ≫ 2 only.
///
/// # Special cases
/// N = 0 → 0, a lobe without direction; s = ∞ → 1/σ². |N| ≥ 1 → s.
///
/// # Example
/// ```
/// use microsurface::{filter::normal_map::exponent_toksvig2005, glam::Vec3};
/// assert!((exponent_toksvig2005(100.0_f32, Vec3::new(0.0, 0.0, 0.9)) - 90.0 / 10.9).abs() < 1e-5);
/// ```
///
/// # References
/// Toksvig 2005.
#[inline]
#[must_use]
pub fn exponent_toksvig2005<T: Real>(exponent: T, average_normal: impl Vector<3, Scalar = T>) -> T {
    let average_normal = T::Vec3::from(average_normal.components());
    let (length, missing) = length_and_missing::<T>(average_normal);
    // Divided by s: finite for s = ∞ and 0 for s = 0.
    T::lit(length / (length / exponent.to_f64() + missing))
}

/// α' = √(α² + 2σ²) by the length of an average normal.
///
/// # Errors
/// [`Error::Alpha`] where α or α' is outside [`alpha_range`](crate::roughness::alpha_range), as for
/// N = 0.
///
/// # Example
/// ```
/// use microsurface::{filter::normal_map::alpha_toksvig2005, glam::Vec3};
/// let alpha = alpha_toksvig2005(0.3_f32, Vec3::new(0.0, 0.0, 1.0 / 1.08))?;
/// assert!((alpha - 0.5).abs() < 1e-6);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Toksvig 2005, in slopes: its exponent is 2/α².
#[inline]
pub fn alpha_toksvig2005<T: Real>(alpha: T, average_normal: impl Vector<3, Scalar = T>) -> Result<T, Error> {
    let average_normal = T::Vec3::from(average_normal.components());
    let alpha = checked(alpha)?.to_f64();
    let (length, missing) = length_and_missing::<T>(average_normal);
    checked(T::lit(Real::sqrt(alpha * alpha + 2.0 * missing / length)))
}

/// |N| and max(0, 1 − |N|).
#[inline]
fn length_and_missing<T: Real>(average_normal: T::Vec3) -> (f64, f64) {
    let [x, y, z] = Into::<[T; 3]>::into(average_normal).map(T::to_f64);
    let square = x * x + y * y + z * z;
    let length = Real::sqrt(square);
    // 1 − |N| = (1 − |N|²)/(1 + |N|). NaN stays.
    let missing = (1.0 - square) / (1.0 + length);
    (length, if missing < 0.0 { 0.0 } else { missing })
}
