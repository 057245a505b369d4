//! Means of P22 over the slopes that a pixel covers: what a box filter sees.

mod beckmann;
mod ggx;
mod gtr;
pub mod polygon;
pub mod rectangle;

use crate::Real;
use crate::map::{Map, factor, seen_by_profile};
use crate::microsurface::Microsurface;
use crate::profile::Profile;

/// Edges and slopes beyond this, in units of α, count as infinite: fourth powers of them are still
/// numbers. No f32 reaches it.
const LARGEST: f64 = 1e70;

/// A profile whose slopes can be averaged over parallelograms.
pub trait MeanOverParallelogram<T: Real>: Profile<T> {
    /// The mean of the profile's own P22 (map I) over the parallelogram `centre` ± ½ `u` ± ½ `v`.
    fn mean_over_parallelogram(&self, centre: [f64; 2], u: [f64; 2], v: [f64; 2]) -> f64;

    /// The mean of the profile's own P22 over the box `centre` ± `half`.
    #[inline]
    fn mean_over_box(&self, centre: [f64; 2], half: [f64; 2]) -> f64 {
        self.mean_over_parallelogram(centre, [2.0 * half[0], 0.0], [0.0, 2.0 * half[1]])
    }
}

/// A mean of the profile at what it sees of slope and edges, as a mean of the surface.
pub(super) fn mean_of<P, M: Map>(
    surface: &Microsurface<P, M>,
    slope: <M::Scalar as Real>::Vec2,
    dh_du: <M::Scalar as Real>::Vec2,
    dh_dv: <M::Scalar as Real>::Vec2,
    mean: impl FnOnce([f64; 2], [f64; 2], [f64; 2]) -> f64,
) -> M::Scalar {
    let [centre, u, v] = [slope, dh_du, dh_dv].map(|vector| seen_by_profile(surface.map(), vector));
    if ![centre, u, v].as_flattened().iter().all(|x| x.abs() <= LARGEST) {
        // Before the map, which makes NaN of two infinities.
        let given: [[M::Scalar; 2]; 3] = [slope.into(), dh_du.into(), dh_dv.into()];
        let sum = given.as_flattened().iter().fold(M::Scalar::ZERO, |sum, x| sum + x.abs());
        return if sum <= M::Scalar::INFINITY { M::Scalar::ZERO } else { sum };
    }
    let [r11, _, r22] = factor(surface.map());
    M::Scalar::lit(mean(centre, u, v) / (r11 * r22))
}
