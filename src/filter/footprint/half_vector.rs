//! The half vector and its derivatives.

use crate::Real;
use crate::filter::Footprint;
use crate::filter::jacobian::{Curvature, Motion};
use crate::frame::Frame;
use crate::vector::{cross, minus, plus_scaled, unit_and_length, unit_step};

/// The half vector of a point, an eye and a light, in a shading frame, and its first derivatives.
///
/// H = T(i + o), with T the frame, i and o the unit directions to light and eye. Not normalised, it
/// has the derivative dH = T d(i + o) − ω × H, where ω = (−dn·t, dn·s, twist) is the turn of the
/// frame and di = −(d − i (i·d))/|l − x|, d = dx − dl, that of the direction to the light. Then
///
/// - in slopes, h = −H.xy/H.z, and dh = −(dH.xy + h dH.z)/H.z with the sign of h here;
/// - in the projected space, m = H/|H|, and dm.xy is that of (dH − m (m·dH))/|H|.
///
/// Derivatives are by direction: a [`Motion`] says what moves, and a filter needs two of them
/// ([`slope_footprint`](Self::slope_footprint),
/// [`projected_footprint`](Self::projected_footprint)): per pixel, or the axes of a lens or of an
/// area light.
///
/// # Special cases
/// - **On the horizon**, H.z = 0, the projected half vector and its steps are finite; the slope is
///   infinite or NaN and so are its steps. [`Footprint::clamped`] replaces such a footprint,
///   filters refuse it ([`Error::Covariance`](crate::Error::Covariance)).
/// - **Below it** everything is finite: slopes are those of −H, and their steps are exact. No
///   microfacet looks there, D is 0, so there is nothing to filter:
///   [`is_above_horizon`](Self::is_above_horizon).
/// - **wi = −wo**: H = 0 has no direction. wm, projected, slope and all steps are NaN, and it is
///   not above the horizon. Near it, H is rounding: a direction, but any.
/// - **The point at the eye or at the light**: NaN, as for H = 0.
///
/// Nothing panics.
///
/// # Accuracy
/// Let S be the size of what dH is the sum of: the steps of point and light over the distance to
/// the light, those of point and eye over that to the eye, and |ω||H|. Then slope steps are exact
/// to 7ε S (1 + |h|)/H.z², and projected ones to 3ε S (1 + 1/|H|)/|H|: the largest errors found by
/// a search over all directions, short half vectors too.
///
/// # Example
/// ```
/// use microsurface::filter::{jacobian::{Curvature, HalfVector, Motion}, ray::RayDifferential};
/// use microsurface::{Beckmann, frame::Frame, glam::Vec3};
/// // A ball of radius 1 about the origin, seen from z = 5 by pixels of a hundredth and lit from
/// // the side.
/// let (eye, point, light) = (Vec3::new(0.0, 0.0, 5.0), Vec3::Z, Vec3::new(3.0, 0.0, 4.0));
/// let pixel = RayDifferential::pinhole(-Vec3::Z, Vec3::X / 100.0, Vec3::Y / 100.0);
/// let [du, dv] = pixel.onto_plane(-Vec3::Z, 4.0, Vec3::Z);
/// let frame = Frame::from_normal(Vec3::Z);
/// let motion = |point| {
///     let normal = Curvature::sphere(1.0).normal_step(&frame, point);
///     Motion { point, normal, ..Motion::default() }
/// };
/// let half = HalfVector::new(&frame, point, eye, light);
/// let footprint = half.slope_footprint(&motion(du), &motion(dv));
/// let surface = Beckmann::isotropic(0.01_f32)?.filtered(footprint.covariance(0.25))?;
/// # let _ = surface;
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, Eqs. 3–6; Jakob and Marschner 2012, "Manifold
/// exploration".
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfVector<T: Real> {
    frame: Frame<T>,
    /// Unit directions in world space.
    wi: T::Vec3,
    wo: T::Vec3,
    light_distance: T,
    eye_distance: T,
    /// H in the frame.
    h: T::Vec3,
    /// H/|H|, and |H|.
    m: T::Vec3,
    length: T,
}

impl<T: Real> HalfVector<T> {
    /// The half vector of a point that is seen from a near eye and lit from a near light, all in
    /// world space.
    #[inline]
    #[must_use]
    pub fn new(frame: &Frame<T>, point: T::Vec3, eye: T::Vec3, light: T::Vec3) -> Self {
        let (wi, light_distance) = unit_and_length(minus(light.into(), point.into()));
        let (wo, eye_distance) = unit_and_length(minus(eye.into(), point.into()));
        Self::at_distances(frame, wi.into(), light_distance, wo.into(), eye_distance)
    }

    /// The half vector of unit directions in world space, light and eye infinitely far: only the
    /// frame moves the half vector, and what a motion says of the directions themselves.
    ///
    /// It differs from the near field by terms of the order of one over the distances.
    #[inline]
    #[must_use]
    pub fn far(frame: &Frame<T>, wi: T::Vec3, wo: T::Vec3) -> Self {
        Self::at_distances(frame, wi, T::INFINITY, wo, T::INFINITY)
    }

    /// The half vector of unit directions in world space and distances, either of which may be
    /// infinite: `T::INFINITY` and a number for the sun and a near eye.
    #[inline]
    #[must_use]
    pub fn at_distances(
        frame: &Frame<T>,
        wi: T::Vec3,
        light_distance: T,
        wo: T::Vec3,
        eye_distance: T,
    ) -> Self {
        let h = frame.to_local(plus_scaled(wi.into(), T::ONE, wo.into()).into());
        let (m, length) = unit_and_length(h.into());
        Self { frame: *frame, wi, wo, light_distance, eye_distance, h, m: m.into(), length }
    }

    /// The unit half vector in the frame.
    #[inline]
    #[must_use]
    pub fn wm(&self) -> T::Vec3 {
        self.m
    }

    /// Its slope, (−m.x/m.z, −m.y/m.z).
    #[inline]
    #[must_use]
    pub fn slope(&self) -> T::Vec2 {
        crate::frame::normal_to_slope::<T>(self.h)
    }

    /// Its projection m.xy.
    #[inline]
    #[must_use]
    pub fn projected(&self) -> T::Vec2 {
        let [x, y, _]: [T; 3] = self.m.into();
        [x, y].into()
    }

    /// Whether m.z > 0: elsewhere D is 0, and there is nothing to filter.
    #[inline]
    #[must_use]
    pub fn is_above_horizon(&self) -> bool {
        let [_, _, z]: [T; 3] = self.m.into();
        z > T::ZERO
    }

    /// dH.
    #[inline]
    fn step(&self, motion: &Motion<T>) -> [T; 3] {
        let point = motion.point.into();
        let (wi, wo) = (self.wi.into(), self.wo.into());
        let of_wi = unit_step(wi, self.light_distance, minus(motion.light.into(), point));
        let of_wo = unit_step(wo, self.eye_distance, minus(motion.eye.into(), point));
        let own = plus_scaled(motion.wi.into(), T::ONE, motion.wo.into());
        let world = plus_scaled(plus_scaled(own, T::ONE, of_wi), T::ONE, of_wo);
        let local = self.frame.to_local(world.into()).into();
        minus(local, cross(motion.turn(&self.frame), self.h.into()))
    }

    /// The derivative of the slope.
    #[inline]
    #[must_use]
    pub fn slope_step(&self, motion: &Motion<T>) -> T::Vec2 {
        let ([x, y, z], [dx, dy, dz]) = (self.h.into(), self.step(motion));
        [-(dx - x / z * dz) / z, -(dy - y / z * dz) / z].into()
    }

    /// The derivative of the projection m.xy.
    #[inline]
    #[must_use]
    pub fn projected_step(&self, motion: &Motion<T>) -> T::Vec2 {
        let [x, y, _] = unit_step(self.m.into(), self.length, self.step(motion));
        [x, y].into()
    }

    /// The slopes that two motions cover, as those of a step along the pixel's u and along its v.
    #[inline]
    #[must_use]
    pub fn slope_footprint(&self, du: &Motion<T>, dv: &Motion<T>) -> Footprint<T> {
        Footprint::new(self.slope_step(du), self.slope_step(dv))
    }

    /// The points m.xy that two motions cover.
    #[inline]
    #[must_use]
    pub fn projected_footprint(&self, du: &Motion<T>, dv: &Motion<T>) -> Footprint<T> {
        Footprint::new(self.projected_step(du), self.projected_step(dv))
    }

    /// The papers' matrix M: the derivative of the slope by the point, on a surface whose normals
    /// are the frame's. The columns are the steps for a point moving along the frame's x and y, the
    /// twist 0.
    ///
    /// # Example
    /// ```
    /// use microsurface::filter::jacobian::{Curvature, HalfVector};
    /// use microsurface::{frame::Frame, glam::{DMat2, DVec3}};
    /// let frame = Frame::from_normal(DVec3::Z);
    /// let head_on = HalfVector::far(&frame, DVec3::Z, DVec3::Z);
    /// // The facet that mirrors must lean by as much as the surface leans the other way.
    /// let half = DMat2::from_diagonal([0.5, 0.5].into());
    /// assert_eq!(head_on.slope_per_point(Curvature::sphere(2.0)), half);
    /// ```
    ///
    /// # References
    /// Kaplanyan, Hill, Patney and Lefohn 2016, Eqs. 4 and 6.
    #[inline]
    #[must_use]
    pub fn slope_per_point(&self, curvature: Curvature<T>) -> T::Mat2 {
        let [x, y, _] = self.frame.axes();
        T::matrix([x, y].map(|point| {
            let normal = curvature.normal_step(&self.frame, point);
            self.slope_step(&Motion { point, normal, ..Motion::default() }).into()
        }))
    }
}
