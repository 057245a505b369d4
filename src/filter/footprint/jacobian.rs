//! Derivatives of the half vector, and of one description of it by another.
//!
//! A half vector m is a point of the sphere. Filters work in slopes t = (−m.x/m.z, −m.y/m.z), or on
//! the disk of m.xy, the projected space. [`HalfVector`] has the derivatives of both by everything
//! that moves the half vector; the Jacobians here take steps from one space to another
//! ([`Footprint::transformed`](crate::filter::Footprint::transformed)).
//!
//! Steps on the sphere are angles, along the great circle from the normal through m (radial, first
//! column), and across it, towards n × m (tangential, second column).
//!
//! | from | to | matrix | determinant | singular values |
//! |---|---|---|---|---|
//! | sphere | disk | [`sphere_to_disk`] | z | 1, z |
//! | disk | slopes | [`disk_to_slope`] | 1/z⁴ | 1/z³, 1/z |
//! | sphere | slopes | [`sphere_to_slope`] | 1/z³ | 1/z², 1/z |
//!
//! # References
//! Tokuyoshi 2017, "Error reduction and simplification for shading anti-aliasing", §3 and Appendix
//! B.

pub use super::half_vector::HalfVector;
pub use super::motion::{Curvature, InterpolatedNormals, Motion};

use crate::real::{Real, Vector};

/// How much larger an error of the half vector's derivatives becomes in a space than it was on the
/// sphere.
///
/// Derivatives by finite differences, as of a quad of pixels, are wrong by some angle per pixel.
/// The Jacobian from the sphere makes of it an error in the space the filter works in: at most
/// `largest` times the angle, at least `smallest` times. With the angle θ of the half vector from
/// the normal, z = cos θ:
///
/// | space | largest | smallest |
/// |---|---|---|
/// | slopes | 1/z² | 1/z |
/// | disk | 1 | z |
///
/// So at θ = 80° errors of slopes are up to 33 times those on the sphere, while the disk never adds
/// to them. `cargo run --release --example gallery` plots both.
///
/// # Example
/// ```
/// use microsurface::{filter::jacobian::Amplification, glam::Vec3};
/// let shallow = Vec3::new(0.96, 0.0, 0.28);
/// assert!((Amplification::in_slopes(shallow).largest - 12.755).abs() < 1e-3);
/// assert_eq!(Amplification::on_disk(shallow).largest, 1.0);
/// ```
///
/// # References
/// Tokuyoshi 2017, §3.1 and §3.2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplification<T> {
    /// The larger singular value.
    pub largest: T,
    /// The smaller singular value.
    pub smallest: T,
}

impl<T: Real> Amplification<T> {
    /// The singular values of [`sphere_to_slope`]: [1/z², 1/|z|].
    ///
    /// # Special cases
    /// wm.z = 0 → ∞.
    #[inline]
    #[must_use]
    pub fn in_slopes(wm: impl Vector<3, Scalar = T>) -> Self {
        let wm = T::Vec3::from(wm.components());
        let [_, _, z]: [T; 3] = wm.into();
        let smallest = T::ONE / z.abs();
        Self { largest: smallest * smallest, smallest }
    }

    /// The singular values of [`sphere_to_disk`]: [1, |z|].
    #[inline]
    #[must_use]
    pub fn on_disk(wm: impl Vector<3, Scalar = T>) -> Self {
        let wm = T::Vec3::from(wm.components());
        let [_, _, z]: [T; 3] = wm.into();
        Self { largest: T::ONE, smallest: z.abs() }
    }
}

/// The direction of m.xy on the disk, (cos φ, sin φ); along x at the pole.
///
/// From the ratio of both: their squares may underflow.
#[inline]
fn azimuth<T: Real>(x: T, y: T) -> [T; 2] {
    if x == T::ZERO && y == T::ZERO {
        return [T::ONE, T::ZERO];
    }
    let largest = x.abs().max(y.abs());
    let (x, y) = (x / largest, y / largest);
    let length = (x * x + y * y).sqrt();
    [x / length, y / length]
}

/// The Jacobian from angles on the sphere, radial and tangential, to m.xy.
///
/// [[cos φ · z, −sin φ], [sin φ · z, cos φ]], with φ the azimuth of `wm`. The paper divides by √(1
/// − z²), which loses all digits near the pole; here cos φ and sin φ come from m.xy.
///
/// # Domain
/// A unit vector.
///
/// # Special cases
/// - At the poles, m.xy = 0, no direction is radial: x is taken for it.
/// - wm.z = 0: a matrix of rank one, since radial steps leave m.xy where it is to first order.
///
/// # Accuracy
/// Each entry to 2.5ε, at the pole as elsewhere.
///
/// # Example
/// ```
/// use microsurface::{filter::jacobian::sphere_to_disk, glam::{Mat2, Vec3}};
/// assert_eq!(sphere_to_disk(Vec3::Z), Mat2::IDENTITY);
/// assert!((sphere_to_disk(Vec3::new(0.48, 0.64, 0.6)).determinant() - 0.6).abs() < 1e-6);
/// ```
///
/// # References
/// Tokuyoshi 2017, Eqs. 8 and 9.
#[inline]
#[must_use]
pub fn sphere_to_disk<T: Real>(wm: impl Vector<3, Scalar = T>) -> T::Mat2 {
    let wm = T::Vec3::from(wm.components());
    let [x, y, z]: [T; 3] = wm.into();
    let [cos, sin] = azimuth(x, y);
    T::matrix([[cos * z, sin * z], [-sin, cos]])
}

/// The Jacobian from m.xy to slopes, ∂(−m.x/m.z, −m.y/m.z)/∂(m.x, m.y).
///
/// −[[1 − y², xy], [xy, 1 − x²]]/z³, where 1 − y² is evaluated as z² + x². The determinant is 1/z⁴:
/// for all half vectors off the normal the slope moves further than the point of the disk.
///
/// # Domain
/// A unit vector.
///
/// # Special cases
/// - wm.z = 0: infinite, or NaN where xy = 0, since a vertical facet has no slope.
/// - wm.z < 0: the slope is that of −wm, a facet seen from below; the matrix is its derivative too.
///
/// # Accuracy
/// Each entry to 2.5ε while z³ is a normal number.
///
/// # References
/// Tokuyoshi 2017, Eq. 25.
#[inline]
#[must_use]
pub fn disk_to_slope<T: Real>(wm: impl Vector<3, Scalar = T>) -> T::Mat2 {
    let wm = T::Vec3::from(wm.components());
    let [x, y, z]: [T; 3] = wm.into();
    let scale = -T::ONE / (z * z * z);
    let mixed = scale * (x * y);
    T::matrix([[scale * (z * z + x * x), mixed], [mixed, scale * (z * z + y * y)]])
}

/// The Jacobian from angles on the sphere, radial and tangential, to slopes.
///
/// −[[cos φ, −sin φ · z], [sin φ, cos φ · z]]/z², with φ the azimuth of `wm`: [`disk_to_slope`] ·
/// [`sphere_to_disk`]. The determinant is 1/z³.
///
/// # Domain
/// A unit vector.
///
/// # Special cases
/// - At the poles x is taken for the radial direction, as by [`sphere_to_disk`].
/// - wm.z = 0: infinite, or NaN for a direction along an axis.
///
/// # Accuracy
/// Each entry to 3ε while z² is a normal number, at the pole as elsewhere.
///
/// # Example
/// ```
/// use microsurface::filter::jacobian::{disk_to_slope, sphere_to_disk, sphere_to_slope};
/// use microsurface::glam::DVec3;
/// let m = DVec3::new(0.48, 0.64, 0.6);
/// let chain = disk_to_slope(m) * sphere_to_disk(m);
/// assert!(sphere_to_slope(m).abs_diff_eq(chain, 1e-14));
/// ```
///
/// # References
/// Tokuyoshi 2017, Eqs. 5, 6 and 26.
#[inline]
#[must_use]
pub fn sphere_to_slope<T: Real>(wm: impl Vector<3, Scalar = T>) -> T::Mat2 {
    let wm = T::Vec3::from(wm.components());
    let [x, y, z]: [T; 3] = wm.into();
    let [cos, sin] = azimuth(x, y);
    let (radial, tangential) = (-T::ONE / (z * z), T::ONE / z);
    T::matrix([[radial * cos, radial * sin], [tangential * sin, -(tangential * cos)]])
}
