//! Three-component arithmetic on arrays, for bodies that are generic over the scalar.

use crate::Real;

/// a·b.
#[inline(always)]
pub(crate) fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// v/|v|. Meaningless where |v|² under- or overflows.
#[inline(always)]
pub(crate) fn normalized<T: Real>(v: [T; 3]) -> [T; 3] {
    let inv = T::ONE / dot(v, v).sqrt();
    v.map(|c| c * inv)
}

/// The Heaviside step: 1 above 0, 0 at and below it; NaN stays NaN.
#[inline(always)]
pub(crate) fn step<T: Real>(x: T) -> T {
    if x > T::ZERO { T::ONE } else { x.abs() * T::ZERO }
}

/// max(0, x); NaN stays NaN.
#[inline(always)]
pub(crate) fn positive_part<T: Real>(x: T) -> T {
    if x <= T::ZERO { T::ZERO } else { x }
}

/// u, or the largest number below 1 where a generator rounded to 1; NaN stays NaN.
#[inline(always)]
pub(crate) fn below_one<T: Real>(u: T) -> T {
    let last = T::ONE - T::HALF * T::EPSILON;
    if u > last { last } else { u }
}

/// σ of the direction w, or w.z where rounding left it below: the facets seen are no fewer than a plane's.
#[inline(always)]
pub(crate) fn at_least_cosine<T: Real>([_, _, z]: [T; 3], sigma: T) -> T {
    if sigma < z { z } else { sigma }
}
