//! Vectors of either scalar.

use microsurface::Real;
pub(crate) use microsurface::verify::Float as Scalar;

/// A vector of a scalar from f64 components, each rounded once.
pub(crate) fn vec3<T: Real>(v: [f64; 3]) -> T::Vec3 {
    v.map(T::lit).into()
}

/// a·b.
pub(crate) fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// v as f64, exactly.
pub(crate) fn wide<T: Real>(v: [T; 3]) -> [f64; 3] {
    v.map(T::to_f64)
}

/// v/|v| in f64.
pub(crate) fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v[0].hypot(v[1]).hypot(v[2]);
    v.map(|c| c / length)
}
