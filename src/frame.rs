//! Shading frames, angles, and normals as slopes.
//!
//! Everywhere else in the crate directions are in the local frame: x and y along the tangents, z
//! along the normal.

use crate::real::{Real, Vector};
use crate::vector::{dot, normalized};

/// An orthonormal shading frame: x and y tangents, z the normal.
///
/// # Example
/// ```
/// use microsurface::{frame::Frame, glam::Vec3};
/// let frame = Frame::from_normal(Vec3::new(0.0, 0.6, 0.8));
/// let world = Vec3::new(0.2, -0.3, 0.9);
/// let local = frame.to_local(world);
/// assert!((frame.to_world(local) - world).length() < 1e-6);
/// assert!((local.z - world.dot(Vec3::new(0.0, 0.6, 0.8))).abs() < 1e-6);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame<T: Real> {
    x: T::Vec3,
    y: T::Vec3,
    z: T::Vec3,
}

impl<T: Real> Frame<T> {
    /// A frame about a unit normal, its tangents arbitrary but smooth in the normal except across
    /// z = 0.
    ///
    /// # Accuracy
    /// Orthonormal to 3ε for every normal, those next to −z included: s = copysign(1, n.z) keeps
    /// 1 + |n.z| away from 0, where the branching form of Frisvad 2012 loses all digits.
    ///
    /// # References
    /// Duff, Burgess, Christensen, Hery, Kensler, Liani and Villemin 2017, "Building an orthonormal
    /// basis, revisited", JCGT 6(1).
    #[inline]
    #[must_use]
    pub fn from_normal(normal: impl Vector<3, Scalar = T>) -> Self {
        let normal = T::Vec3::from(normal.components());
        let [nx, ny, nz]: [T; 3] = normal.into();
        let sign = T::ONE.copysign(nz);
        let a = -T::ONE / (sign + nz);
        let b = nx * ny * a;
        Self {
            x: [T::ONE + sign * (nx * nx * a), sign * b, -(sign * nx)].into(),
            y: [b, sign + ny * ny * a, -ny].into(),
            z: normal,
        }
    }

    /// The frame of a unit normal whose x axis is the part of `tangent` across the normal.
    ///
    /// The tangent may have any length.
    ///
    /// # Special cases
    /// A tangent that is zero, not finite, or within 8ε of the direction of the normal has no such
    /// part: the frame of [`from_normal`](Self::from_normal) comes back.
    #[inline]
    #[must_use]
    pub fn from_normal_and_tangent(
        normal: impl Vector<3, Scalar = T>,
        tangent: impl Vector<3, Scalar = T>,
    ) -> Self {
        let normal = T::Vec3::from(normal.components());
        let tangent = T::Vec3::from(tangent.components());
        let (n, t): ([T; 3], [T; 3]) = (normal.into(), tangent.into());
        // Over its largest component, whose inverse may overflow: the square of its length is a
        // number.
        let largest = t[0].abs().max(t[1].abs()).max(t[2].abs());
        let t = t.map(|c| c / largest);
        let along = dot(n, t);
        let across = [t[0] - along * n[0], t[1] - along * n[1], t[2] - along * n[2]];
        let length2 = dot(across, across);
        // The subtraction leaves an error of about ε|t|: what is no longer than a few of it has no
        // direction.
        let margin = T::lit(64.0) * T::EPSILON * T::EPSILON * dot(t, t);
        if !(length2 > margin && length2.is_finite()) {
            return Self::from_normal(normal);
        }
        // Once more, so that the rounding of the first subtraction does not tilt a short remainder.
        let x = normalized(across);
        let tilt = dot(n, x);
        let x = normalized([x[0] - tilt * n[0], x[1] - tilt * n[1], x[2] - tilt * n[2]]);
        let y = [n[1] * x[2] - n[2] * x[1], n[2] * x[0] - n[0] * x[2], n[0] * x[1] - n[1] * x[0]];
        Self { x: x.into(), y: y.into(), z: normal }
    }

    /// The axes x, y, z in world space.
    #[inline]
    #[must_use]
    pub fn axes(&self) -> [T::Vec3; 3] {
        [self.x, self.y, self.z]
    }

    /// A world direction in this frame.
    #[inline]
    #[must_use]
    pub fn to_local(&self, world: T::Vec3) -> T::Vec3 {
        let v = world.into();
        [dot(self.x.into(), v), dot(self.y.into(), v), dot(self.z.into(), v)].into()
    }

    /// A local direction in world space.
    #[inline]
    #[must_use]
    pub fn to_world(&self, local: T::Vec3) -> T::Vec3 {
        let ([lx, ly, lz], x, y, z): ([T; 3], [T; 3], [T; 3], [T; 3]) =
            (local.into(), self.x.into(), self.y.into(), self.z.into());
        [
            lx * x[0] + ly * y[0] + lz * z[0],
            lx * x[1] + ly * y[1] + lz * z[1],
            lx * x[2] + ly * y[2] + lz * z[2],
        ]
        .into()
    }
}

/// The slope (−m.x/m.z, −m.y/m.z) of the facet whose normal has the direction of m.
///
/// # Special cases
/// m.z = 0 → infinite or NaN: a vertical facet has no slope.
#[inline]
#[must_use]
pub fn normal_to_slope<T: Real>(m: impl Vector<3, Scalar = T>) -> T::Vec2 {
    let m = T::Vec3::from(m.components());
    let [x, y, z]: [T; 3] = m.into();
    [-x / z, -y / z].into()
}

/// The unit normal of a facet of this slope.
///
/// # Domain
/// Any finite slope. Where its square overflows the normal lies in the plane to every digit.
///
/// # Example
/// ```
/// use microsurface::{frame::{normal_to_slope, slope_to_normal}, glam::Vec2};
/// let slope = Vec2::new(0.75, 0.0);
/// let normal = slope_to_normal(slope);
/// assert!((normal.x + 0.6).abs() < 1e-6 && (normal.z - 0.8).abs() < 1e-6);
/// assert!((normal_to_slope(normal) - slope).length() < 1e-6);
/// ```
#[inline]
#[must_use]
pub fn slope_to_normal<T: Real>(slope: impl Vector<2, Scalar = T>) -> T::Vec3 {
    let slope = T::Vec2::from(slope.components());
    let [x, y]: [T; 2] = slope.into();
    let largest = x.abs().max(y.abs()).max(T::ONE);
    normalized([-x / largest, -y / largest, T::ONE / largest]).into()
}

/// The mirror image of `w` about the unit normal `m`: 2 (w·m) m − w.
#[inline]
#[must_use]
pub fn reflected<T: Real>(w: impl Vector<3, Scalar = T>, m: impl Vector<3, Scalar = T>) -> T::Vec3 {
    let w = T::Vec3::from(w.components());
    let m = T::Vec3::from(m.components());
    let (v, n): ([T; 3], [T; 3]) = (w.into(), m.into());
    let twice = T::TWO * dot(v, n);
    [twice * n[0] - v[0], twice * n[1] - v[1], twice * n[2] - v[2]].into()
}
