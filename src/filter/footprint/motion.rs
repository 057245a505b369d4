//! What moves a half vector: the point, the eye, the light, and the normal with its frame.

use crate::frame::Frame;
use crate::real::{Real, Vector};
use crate::vector::dot;
use crate::vector::{cross, minus, plus_scaled, unit_and_length, unit_step};

/// A first-order change of what a half vector depends on: derivatives by any one parameter, in
/// world space.
///
/// The parameter may be a pixel's coordinate, a lens's or a light's, time, or a length along the
/// surface. What is not named stays: `Motion { point, normal, ..Motion::default() }`.
///
/// Where does the derivative of the normal come from? From [`Curvature`], from
/// [`InterpolatedNormals`], from a normal map ([`perturbed`](Self::perturbed)), or by the
/// differences of a [`Quad`](crate::filter::quad::Quad).
///
/// **The twist** is how fast the tangents turn about the normal, in radians, positive from x to y.
/// It turns slopes and their steps alike, so it does not matter to an isotropic surface: leave it
/// 0, which is parallel transport. An anisotropic surface whose tangents follow a texture has the
/// twist of [`with_tangent`](Self::with_tangent).
///
/// # Example
/// ```
/// use microsurface::filter::jacobian::{Curvature, HalfVector, Motion};
/// use microsurface::{frame::Frame, glam::DVec3};
/// // On a mirror ball of radius 2, lit and seen from afar along the normal.
/// let frame = Frame::from_normal(DVec3::Z);
/// let half = HalfVector::far(&frame, DVec3::Z, DVec3::Z);
/// let point = DVec3::new(0.1, 0.0, 0.0);
/// let normal = Curvature::sphere(2.0).normal_step(&frame, point);
/// let step = half.slope_step(&Motion { point, normal, ..Motion::default() });
/// assert!((step.x - 0.05).abs() < 1e-15 && step.y == 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion<T: Real> {
    /// Motion of the shaded point.
    pub point: T::Vec3,
    /// Motion of the eye. Without effect where it is infinitely far.
    pub eye: T::Vec3,
    /// Motion of the point on the light. Without effect where it is infinitely far.
    pub light: T::Vec3,
    /// Motion of the direction to the light, in addition to what point and light do to it: of a
    /// light at infinity.
    pub wi: T::Vec3,
    /// Motion of the direction to the eye, in addition to what point and eye do to it: of an eye at
    /// infinity, or minus the derivative of the direction of a ray that came by mirrors.
    pub wo: T::Vec3,
    /// Motion of the unit shading normal.
    pub normal: T::Vec3,
    /// Turn of the tangents about the normal, in radians.
    pub twist: T,
}

impl<T: Real> Default for Motion<T> {
    /// Nothing moves.
    #[inline]
    fn default() -> Self {
        let zero: T::Vec3 = [T::ZERO; 3].into();
        Self { point: zero, eye: zero, light: zero, wi: zero, wo: zero, normal: zero, twist: T::ZERO }
    }
}

impl<T: Real> Motion<T> {
    /// How the frame turns: ω in its own coordinates, so that the derivative of a fixed vector v in
    /// them is −ω × v.
    #[inline]
    pub(super) fn turn(&self, frame: &Frame<T>) -> [T; 3] {
        let [s, t, _]: [T; 3] = frame.to_local(self.normal).into();
        [-t, s, self.twist]
    }

    /// With the twist of the frame whose x axis is the part of `tangent` across the normal
    /// ([`Frame::from_normal_and_tangent`]), where the tangent changes by `step` and the normal as
    /// set here.
    ///
    /// `tangent` is the derivative of the point by a texture coordinate, for a texture's frame. Set
    /// the normal first.
    ///
    /// # Special cases
    /// A tangent along the normal has no direction across it: the twist is infinite or NaN.
    #[inline]
    #[must_use]
    pub fn with_tangent(self, frame: &Frame<T>, tangent: T::Vec3, step: T::Vec3) -> Self {
        let [[x, _, z], [_, y_step, _], [_, y_normal, _]]: [[T; 3]; 3] =
            [tangent, step, self.normal].map(|v| frame.to_local(v).into());
        // x̂ = v⊥/|v⊥| with v⊥ = v − n (n·v), |v⊥| = x: along y its derivative is (dv − dn
        // (n·v))·ŷ/|v⊥|.
        Self { twist: (y_step - y_normal * z) / x, ..self }
    }

    /// The motion of a normal-mapped frame on this one.
    ///
    /// The map's normal in the frame `base`, of any length, is `m` and changes by `step`, by the
    /// chain rule: for a map over texture coordinates, ∂m/∂u du + ∂m/∂v dv. This motion is that of
    /// `base`; in the new one the normal is that of the map, and the twist that of the frame whose
    /// x axis is the part of `base`'s across it ([`Frame::from_normal_and_tangent`]).
    ///
    /// # Special cases
    /// m = 0 gives NaN; m along `base`'s x axis a twist that is infinite or NaN.
    ///
    /// # Example
    /// ```
    /// use microsurface::{filter::jacobian::Motion, frame::Frame, glam::DVec3};
    /// // A wave of height sin(x)/2 along x, on a plane: at x = 0 its normal is (−½, 0, 1), and
    /// // turns over no further.
    /// let plane = Frame::from_normal(DVec3::Z);
    /// let motion = Motion { point: DVec3::X, ..Motion::default() };
    /// let (m, step) = (DVec3::new(-0.5, 0.0, 1.0), DVec3::ZERO);
    /// assert_eq!(motion.perturbed(&plane, m, step).normal, DVec3::ZERO);
    /// ```
    #[inline]
    #[must_use]
    pub fn perturbed(&self, base: &Frame<T>, m: T::Vec3, step: T::Vec3) -> Self {
        let (unit, length) = unit_and_length(m.into());
        let turn = self.turn(base);
        let of_map = unit_step(unit, length, step.into());
        // In base's coordinates: the normal of the map turns by itself and with the base.
        let normal = base.to_world(plus_scaled(of_map, T::ONE, cross(turn, unit)).into());
        let [tangent, _, _] = base.axes();
        let tangent_step = base.to_world(cross(turn, [T::ONE, T::ZERO, T::ZERO]).into());
        let frame = Frame::from_normal_and_tangent(base.to_world(unit.into()), tangent);
        Self { normal, ..*self }.with_tangent(&frame, tangent, tangent_step)
    }
}

/// The curvature of a surface at a point, the symmetric matrix of its shape operator in a frame's x
/// and y.
///
/// It takes a step along the surface to the step of its unit normal. Positive where the surface
/// bends away from the normal: 1/R on the outside of a sphere. In units of 1/length.
///
/// # References
/// do Carmo 1976, "Differential Geometry of Curves and Surfaces", §3.2, with the other sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curvature<T> {
    xx: T,
    xy: T,
    yy: T,
}

impl<T: Real> Curvature<T> {
    /// The matrix [[xx, xy], [xy, yy]]: the normal's step along x is (xx, xy).
    #[inline]
    #[must_use]
    pub fn new(xx: T, xy: T, yy: T) -> Self {
        Self { xx, xy, yy }
    }

    /// Principal curvatures: `first` along `direction`, a unit vector of the tangent plane in the
    /// frame's x and y, and `second` across it.
    #[inline]
    #[must_use]
    pub fn principal(first: T, second: T, direction: T::Vec2) -> Self {
        let [c, s]: [T; 2] = direction.into();
        let xy = (first - second) * (c * s);
        Self::new(first * (c * c) + second * (s * s), xy, first * (s * s) + second * (c * c))
    }

    /// The curvature of a sphere seen from outside; a negative radius for its inside.
    #[inline]
    #[must_use]
    pub fn sphere(radius: T) -> Self {
        let curvature = T::ONE / radius;
        Self::new(curvature, T::ZERO, curvature)
    }

    /// The curvature of a plane.
    #[inline]
    #[must_use]
    pub fn flat() -> Self {
        Self::new(T::ZERO, T::ZERO, T::ZERO)
    }

    /// The derivative of the normal, in world space, where the point moves by `point_step`.
    ///
    /// Only the part of the step within the frame's tangent plane counts.
    #[inline]
    #[must_use]
    pub fn normal_step(&self, frame: &Frame<T>, point_step: T::Vec3) -> T::Vec3 {
        let [x, y, _]: [T; 3] = frame.to_local(point_step).into();
        frame.to_world([self.xx * x + self.xy * y, self.xy * x + self.yy * y, T::ZERO].into())
    }
}

/// Normals interpolated over a triangle, as of a mesh with a normal per vertex.
///
/// # Special cases
/// A triangle without area, or normals whose mean vanishes, give NaN.
///
/// # Example
/// ```
/// use microsurface::{filter::jacobian::InterpolatedNormals, glam::DVec3};
/// let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
/// let mesh = InterpolatedNormals::new(corners, [DVec3::Z, DVec3::new(0.6, 0.0, 0.8), DVec3::Z]);
/// assert_eq!(mesh.normal([1.0, 0.0, 0.0]), DVec3::Z);
/// let step = mesh.normal_step([1.0, 0.0, 0.0], DVec3::X);
/// assert!(step.abs_diff_eq(DVec3::new(0.6, 0.0, 0.0), 1e-15));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterpolatedNormals<T: Real> {
    /// The corners.
    pub positions: [T::Vec3; 3],
    /// The normals at the corners; they need not be of unit length.
    pub normals: [T::Vec3; 3],
}

impl<T: Real> InterpolatedNormals<T> {
    /// The triangle of these corners and normals.
    #[inline]
    #[must_use]
    pub fn new<V: Vector<3, Scalar = T>>(positions: [V; 3], normals: [V; 3]) -> Self {
        let of = |v: V| v.components().into();
        Self { positions: positions.map(of), normals: normals.map(of) }
    }

    fn sum(&self, barycentric: [T; 3]) -> [T; 3] {
        let [a, b, c]: [[T; 3]; 3] = self.normals.map(Into::into);
        let [u, v, w] = barycentric;
        plus_scaled(plus_scaled(a.map(|x| u * x), v, b), w, c)
    }

    /// The unit normal at these barycentric coordinates.
    #[inline]
    #[must_use]
    pub fn normal(&self, barycentric: [T; 3]) -> T::Vec3 {
        unit_and_length(self.sum(barycentric)).0.into()
    }

    /// The derivative of the barycentric coordinates where the point moves by `point_step`, of
    /// which only the part in the plane of the triangle counts.
    #[inline]
    #[must_use]
    pub fn barycentric_step(&self, point_step: T::Vec3) -> [T; 3] {
        let [p, q, r]: [[T; 3]; 3] = self.positions.map(Into::into);
        let (pq, pr) = (minus(q, p), minus(r, p));
        let area = cross(pq, pr);
        let area2 = dot(area, area);
        let step = point_step.into();
        let (v, w) = (dot(cross(step, pr), area) / area2, dot(cross(pq, step), area) / area2);
        [-(v + w), v, w]
    }

    /// The derivative of the unit normal where the point moves by `point_step`.
    #[inline]
    #[must_use]
    pub fn normal_step(&self, barycentric: [T; 3], point_step: T::Vec3) -> T::Vec3 {
        let (unit, length) = unit_and_length(self.sum(barycentric));
        unit_step(unit, length, self.sum(self.barycentric_step(point_step))).into()
    }
}
