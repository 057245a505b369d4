//! What a pixel covers on a surface, by ray differentials.
//!
//! The derivative of a ray by the pixel's coordinates, moved along it to the surface, is the step
//! of the point that is seen. With it a [`HalfVector`](crate::filter::jacobian::HalfVector) has its
//! footprint.
//!
//! # References
//! Igehy 1999, "Tracing ray differentials"; Kaplanyan, Hill, Patney and Lefohn 2016, §4.2.

use crate::real::{Real, Vector};
use crate::vector::dot;
use crate::vector::{minus, plus_scaled, unit_and_length, unit_step};

/// The derivatives of a ray, of its origin and of its unit direction, by two parameters u and v.
///
/// Per pixel in most uses. Sampled s times per pixel, a ray stands for 1/√s of it in each
/// direction: [`Footprint::scaled`](crate::filter::Footprint::scaled).
///
/// # Example
/// ```
/// use microsurface::{filter::ray::RayDifferential, glam::DVec3};
/// // Pixels of a hundredth at distance 1; the wall is 3 away and leans by 45° about y.
/// let pixel = RayDifferential::pinhole(-DVec3::Z, DVec3::X / 100.0, DVec3::Y / 100.0);
/// let wall = DVec3::new(1.0, 0.0, 1.0).normalize();
/// let [du, dv] = pixel.onto_plane(-DVec3::Z, 3.0, wall);
/// assert!(du.abs_diff_eq(DVec3::new(0.03, 0.0, -0.03), 1e-15));
/// assert!(dv.abs_diff_eq(DVec3::Y * 0.03, 1e-15));
/// ```
///
/// # References
/// Igehy 1999, §3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayDifferential<T: Real> {
    /// Derivative of the origin by u.
    pub origin_du: T::Vec3,
    /// Derivative of the origin by v.
    pub origin_dv: T::Vec3,
    /// Derivative of the unit direction by u.
    pub direction_du: T::Vec3,
    /// Derivative of the unit direction by v.
    pub direction_dv: T::Vec3,
}

impl<T: Real> RayDifferential<T> {
    /// Differentials of rays from one point, through a picture plane: the direction, of any length,
    /// and its derivatives before it is normalised.
    ///
    /// For d = forward + u·right + v·up they are `right` and `up`, scaled to a pixel.
    ///
    /// # Special cases
    /// A direction of 0 gives NaN.
    ///
    /// # References
    /// Igehy 1999, Eq. 8.
    #[inline]
    #[must_use]
    pub fn pinhole(
        direction: impl Vector<3, Scalar = T>,
        direction_du: impl Vector<3, Scalar = T>,
        direction_dv: impl Vector<3, Scalar = T>,
    ) -> Self {
        let direction = T::Vec3::from(direction.components());
        let direction_du = T::Vec3::from(direction_du.components());
        let direction_dv = T::Vec3::from(direction_dv.components());
        let zero = [T::ZERO; 3].into();
        Self::of_unnormalised([zero, zero], direction.into(), [direction_du, direction_dv])
    }

    /// Differentials of the rays of a thin lens, by the pixel, the point on the lens fixed: its
    /// `lens` is from the centre of the lens, all else is as for [`pinhole`](Self::pinhole).
    ///
    /// # Special cases
    /// As for a direction of 0 where the point on the lens is in focus: NaN.
    #[inline]
    #[must_use]
    pub fn thin_lens(
        focus: FocusPlane<T>,
        lens: impl Vector<3, Scalar = T>,
        direction: impl Vector<3, Scalar = T>,
        direction_du: impl Vector<3, Scalar = T>,
        direction_dv: impl Vector<3, Scalar = T>,
    ) -> Self {
        let lens = T::Vec3::from(lens.components());
        let direction = T::Vec3::from(direction.components());
        let direction_du = T::Vec3::from(direction_du.components());
        let direction_dv = T::Vec3::from(direction_dv.components());
        let zero = [T::ZERO; 3].into();
        let steps = [direction_du, direction_dv].map(|step| focus.point_step(direction, step));
        Self::of_unnormalised([zero, zero], focus.seen_from(lens, direction), steps)
    }

    /// Differentials of the rays of a thin lens, by the point on the lens, the pixel fixed: `lens`
    /// from the centre of the lens, and its derivatives along two axes.
    ///
    /// Moved onto a surface these are the circle of confusion, nothing at the plane in focus. The
    /// eye of a half vector moves with it: [`Motion::eye`](crate::filter::jacobian::Motion::eye) =
    /// `lens_du`.
    #[inline]
    #[must_use]
    pub fn across_lens(
        focus: FocusPlane<T>,
        lens: T::Vec3,
        lens_du: T::Vec3,
        lens_dv: T::Vec3,
        direction: T::Vec3,
    ) -> Self {
        let steps = [lens_du, lens_dv].map(|step| {
            let step: [T; 3] = step.into();
            step.map(|c| -c).into()
        });
        Self::of_unnormalised([lens_du, lens_dv], focus.seen_from(lens, direction), steps)
    }

    #[inline]
    fn of_unnormalised([origin_du, origin_dv]: [T::Vec3; 2], direction: [T; 3], steps: [T::Vec3; 2]) -> Self {
        let (unit, length) = unit_and_length(direction);
        let [direction_du, direction_dv] = steps.map(|step| unit_step(unit, length, step.into()).into());
        Self { origin_du, origin_dv, direction_du, direction_dv }
    }

    /// Differentials of the ray that starts further along, after a fixed `distance`: the origins
    /// move with the directions.
    ///
    /// # References
    /// Igehy 1999, Eq. 10 without the change of the distance.
    #[inline]
    #[must_use]
    pub fn transferred(&self, distance: T) -> Self {
        let moved = |origin: T::Vec3, direction: T::Vec3| {
            plus_scaled(origin.into(), distance, direction.into()).into()
        };
        Self {
            origin_du: moved(self.origin_du, self.direction_du),
            origin_dv: moved(self.origin_dv, self.direction_dv),
            ..*self
        }
    }

    /// The steps of the point where the ray of this unit direction meets a surface, after
    /// `distance`: vectors in its tangent plane, whose `normal` is the geometric one, of any length
    /// and either side.
    ///
    /// # Special cases
    /// A ray that grazes, direction·normal = 0, gives steps that are infinite or NaN: the pixel
    /// covers the whole plane. A footprint of them is clamped or refused as others that are not
    /// finite.
    ///
    /// # References
    /// Igehy 1999, Eqs. 10–12.
    #[inline]
    #[must_use]
    pub fn onto_plane(&self, direction: T::Vec3, distance: T, normal: T::Vec3) -> [T::Vec3; 2] {
        let (direction, normal): ([T; 3], [T; 3]) = (direction.into(), normal.into());
        let cosine = dot(direction, normal);
        let there = self.transferred(distance);
        [there.origin_du, there.origin_dv].map(|step| {
            let step = step.into();
            plus_scaled(step, -(dot(step, normal) / cosine), direction).into()
        })
    }
}

/// The plane that a thin lens shows sharp: across the axis of the lens, at a distance from its
/// centre.
///
/// Directions of pixels are those through the centre of the lens.
///
/// # Example
/// ```
/// use microsurface::{filter::ray::{FocusPlane, RayDifferential}, glam::DVec3};
/// let focus = FocusPlane::new(-DVec3::Z, 4.0);
/// let lens = DVec3::new(0.1, 0.0, 0.0);
/// let ray = focus.direction(lens, -DVec3::Z);
/// let across = RayDifferential::across_lens(focus, lens, DVec3::X, DVec3::Y, -DVec3::Z);
/// let distance = 4.0 / -ray.z;
/// let [du, dv] = across.onto_plane(ray, distance, DVec3::Z);
/// assert!(du.length() < 1e-15 && dv.length() < 1e-15); // sharp
/// let [du, _] = across.onto_plane(ray, 1.5 * distance, DVec3::Z);
/// assert!((du.x + 0.5).abs() < 1e-15); // and half as wide as the lens behind it, upside down
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FocusPlane<T: Real> {
    /// The unit direction of the lens's axis, away from the picture.
    pub axis: T::Vec3,
    /// From the centre of the lens, along the axis.
    pub distance: T,
}

impl<T: Real> FocusPlane<T> {
    /// The plane across the unit vector `axis`, at this distance from the centre of the lens.
    #[inline]
    #[must_use]
    pub fn new(axis: impl Vector<3, Scalar = T>, distance: T) -> Self {
        Self { axis: axis.components().into(), distance }
    }

    /// The unit direction from a point on the lens to what it shows sharp for a pixel's direction:
    /// that of the ray.
    #[inline]
    #[must_use]
    pub fn direction(&self, lens: T::Vec3, direction: T::Vec3) -> T::Vec3 {
        unit_and_length(self.seen_from(lens, direction)).0.into()
    }

    /// From a point on the lens to the point in focus.
    #[inline]
    fn seen_from(&self, lens: T::Vec3, direction: T::Vec3) -> [T; 3] {
        let d = direction.into();
        let scale = self.distance / dot(self.axis.into(), d);
        minus(d.map(|c| scale * c), lens.into())
    }

    /// The derivative of the point in focus, f d/(a·d): f (dd − d (a·dd)/(a·d))/(a·d).
    #[inline]
    fn point_step(&self, direction: T::Vec3, step: T::Vec3) -> T::Vec3 {
        let (axis, d, step) = (self.axis.into(), direction.into(), step.into());
        let along = dot(axis, d);
        let scale = self.distance / along;
        plus_scaled(step, -(dot(axis, step) / along), d).map(|c| scale * c).into()
    }
}
