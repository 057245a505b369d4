//! How normals and texture coordinates change from place to place under a map.

use crate::Real;
use crate::vector::dot;

/// The Jacobian ∂(u.x, u.y)/∂(m.x, m.y) of u = Mᵀm/|Mᵀm| over the disc of the first two components
/// of unit normals.
///
/// Its determinant is det M/|Mᵀm|⁴, the factor of D_M.
///
/// # Domain
/// A unit vector with m.z > 0; `matrix` invertible.
///
/// # References
/// Atanasov, Koylazov, Dimov and Wilkie 2022, Eqs. 17–21.
#[must_use]
pub fn jacobian_of_normals<T: Real>(matrix: T::Mat2, m: T::Vec3) -> T::Mat2 {
    let [[a, b], [c, d]] = T::columns(matrix);
    let [x, y, z]: [T; 3] = m.into();
    let (u, v) = (a * x + b * y, c * x + d * y);
    let length2 = dot([u, v, z], [u, v, z]);
    let inverse = T::ONE / (length2 * length2.sqrt());
    // d(u/L) = (du L² − u (u·du))/L³, with du.z = −(m.x dm.x + m.y dm.y)/m.z.
    let column = |du: T, dv: T, dz_z: T| {
        let along = u * du + v * dv + dz_z;
        [(du * length2 - u * along) * inverse, (dv * length2 - v * along) * inverse]
    };
    T::matrix([column(a, c, -x), column(b, d, -y)])
}

/// The Jacobian of a map of texture coordinates at a point, by central differences: the M that it
/// moves a microsurface by.
///
/// `uv` are the coordinates at rest: on a surface that was moved already, those the map takes to
/// the point.
///
/// `step` is half the distance between the points; the error is `step`²/6 times the third
/// derivatives, plus the rounding of the map over `step`: ε^{1/3} times the size of the coordinates
/// balances them.
///
/// # Example
/// ```
/// use microsurface::{Ggx, glam::DVec2, transform::jacobian_of_uv_map};
/// let curved = |uv: DVec2| DVec2::new(uv.x, uv.y + 2.0 * uv.x.powi(5));
/// let m = jacobian_of_uv_map(curved, DVec2::new(0.5, 0.2), 1e-5_f64);
/// assert!((m.x_axis - DVec2::new(1.0, 0.625)).length() < 1e-8);
/// let sheared = Ggx::isotropic(0.1)?.transformed(m)?;
/// # let _ = sheared;
/// # Ok::<(), microsurface::Error>(())
/// ```
#[must_use]
pub fn jacobian_of_uv_map<T: Real>(map: impl Fn(T::Vec2) -> T::Vec2, uv: T::Vec2, step: T) -> T::Mat2 {
    let [u, v]: [T; 2] = uv.into();
    let difference = |after: [T; 2], before: [T; 2]| {
        let [after, before]: [[T; 2]; 2] = [map(after.into()).into(), map(before.into()).into()];
        let inverse = T::HALF / step;
        [(after[0] - before[0]) * inverse, (after[1] - before[1]) * inverse]
    };
    T::matrix([difference([u + step, v], [u - step, v]), difference([u, v + step], [u, v - step])])
}
