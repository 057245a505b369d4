//! Filters of distributions.

mod ball;
mod convolution;
mod covariance;
mod deferred;
mod footprints;
mod largest;
mod means;
mod normal_map;
mod projected;

use microsurface::Real;
use microsurface::filter::Footprint;
use microsurface::glam::DVec2;
use microsurface::map::Map;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use crate::random::uniform;

/// The entries of the roughness matrix of a map, and its determinant, without rounding to the
/// scalar.
fn matrix<M: Map>(map: &M) -> ([f64; 3], f64) {
    let [[a, b], [_, d]] = map.inverse().map(|row| row.map(Real::to_f64));
    ([a * a, a * b, b * b + d * d], (a * d) * (a * d))
}

/// A footprint as it comes: any shape and size, in slopes.
fn footprint(rng: &mut Pcg64Mcg) -> Footprint<f64> {
    let [u, v] = [(); 2].map(|()| {
        let length = uniform(rng, -6.0, 1.0).exp2();
        DVec2::from_angle(uniform(rng, 0.0, 6.3)) * length
    });
    Footprint::new(u, if rng.random_bool(0.3) { 1e-3 * v + 0.4 * u } else { v })
}
