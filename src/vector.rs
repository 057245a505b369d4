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

/// u where it is told from 0 and 1: 0 is taken as ε/4, the middle of the first cell of random
/// numbers.
#[inline(always)]
pub(crate) fn inside<T: Real>(u: T) -> T {
    u.max(T::lit(0.25) * T::EPSILON).min(T::ONE - T::HALF * T::EPSILON)
}

/// σ of the direction w, or w.z where rounding left it below: the facets seen are no fewer than a
/// plane's.
#[inline(always)]
pub(crate) fn at_least_cosine<T: Real>([_, _, z]: [T; 3], sigma: T) -> T {
    if sigma < z { z } else { sigma }
}

/// a × b.
#[inline]
pub(crate) fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a − b.
#[inline]
pub(crate) fn minus<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + factor·b.
#[inline]
pub(crate) fn plus_scaled<T: Real>(a: [T; 3], factor: T, b: [T; 3]) -> [T; 3] {
    [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]]
}

/// v/|v| and |v|, also where |v|² under- or overflows; NaN for 0.
#[inline]
pub(crate) fn unit_and_length<T: Real>(v: [T; 3]) -> ([T; 3], T) {
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    let scaled = v.map(|c| c / largest);
    let length = dot(scaled, scaled).sqrt();
    (scaled.map(|c| c / length), largest * length)
}

/// The derivative of v/|v| where v has the derivative `step`: its part across the unit vector,
/// over |v|.
#[inline]
pub(crate) fn unit_step<T: Real>(unit: [T; 3], length: T, step: [T; 3]) -> [T; 3] {
    plus_scaled(step, -dot(unit, step), unit).map(|c| c / length)
}
