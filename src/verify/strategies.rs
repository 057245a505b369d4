//! Strategies of proptest that are biased to where microfacet code breaks (feature `proptest`).
//!
//! # Example
//! ```
//! use microsurface::verify::strategies::{alpha, pairs};
//! use microsurface::{Ggx, Ndf, glam::Vec3};
//! use proptest::prelude::*;
//! proptest!(|(alpha in alpha(), (wi, wo) in pairs::<f32>())| {
//!     if let Ok(surface) = Ggx::isotropic(alpha as f32) {
//!         let g2 = surface.g2(wi.into(), wo.into(), Vec3::Z);
//!         prop_assert!((0.0..=1.0).contains(&g2));
//!     }
//! });
//! ```

use core::f64::consts::TAU;

use proptest::prelude::*;

use super::float::Float;
use crate::filter::Footprint;

/// A number between 2^`low` and 2^`high`, log-uniform.
pub fn log_uniform(low: f64, high: f64) -> impl Strategy<Value = f64> + Clone {
    (low..high).prop_map(f64::exp2)
}

/// The unit vector of height z and azimuth φ, rounded once.
#[must_use]
pub fn at_height<T: Float>(z: f64, phi: f64) -> [T; 3] {
    let radius = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    [radius * phi.cos(), radius * phi.sin(), z].map(T::lit)
}

/// The unit vector of sine r and azimuth φ.
#[must_use]
pub fn at_radius<T: Float>(r: f64, phi: f64) -> [T; 3] {
    [r * phi.cos(), r * phi.sin(), ((1.0 - r) * (1.0 + r)).sqrt()].map(T::lit)
}

/// The smallest numbers of the scalar, by the index of a power of two above them; for f64 1e-308 is
/// not a radius whose square anything resolves, but it is a component.
fn smallest_exponent<T: Float>() -> f64 {
    T::TINIEST.to_f64().max(f64::MIN_POSITIVE).log2() + 0.5
}

/// An azimuth: anything, or along and next to the axes.
pub fn azimuth() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![3 => 0.0..TAU, 1 => (0..8_u8).prop_map(|k| f64::from(k) * TAU / 8.0)]
}

/// Directions on and above the horizon: to the last ulp of either end, along the axes, subnormal.
pub fn above<T: Float>() -> impl Strategy<Value = [T; 3]> + Clone {
    let tiny = smallest_exponent::<T>();
    let axes = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [-0.6, 0.8, 0.0]];
    prop_oneof![
        4 => (0.0..1.0, azimuth()).prop_map(|(z, phi)| at_height(z, phi)),
        2 => (log_uniform(tiny, 0.0), azimuth()).prop_map(|(z, phi)| at_height(z, phi)),
        1 => (1..64_i32, azimuth()).prop_map(|(ulps, phi)| {
            let [x, y, _] = at_height::<T>(0.0, phi);
            [x, y, T::ZERO.stepped(ulps)]
        }),
        2 => (log_uniform(tiny, 0.0), azimuth()).prop_map(|(r, phi)| at_radius(r, phi)),
        1 => (-4..=1_i32, azimuth()).prop_map(|(ulps, phi)| {
            let z = T::ONE.stepped(ulps);
            let r = (1.0 - z.to_f64() * z.to_f64()).max(0.0).sqrt();
            [T::lit(r * phi.cos()), T::lit(r * phi.sin()), z]
        }),
        1 => prop::sample::select(axes.to_vec()).prop_map(|w| w.map(T::lit)),
    ]
}

/// Directions strictly above the horizon.
pub fn strictly_above<T: Float>() -> impl Strategy<Value = [T; 3]> + Clone {
    above::<T>().prop_map(|[x, y, z]| if z > T::ZERO { [x, y, z] } else { [x, y, T::MIN_POSITIVE] })
}

/// Directions of the whole sphere, the nadir among them.
pub fn anywhere<T: Float>() -> impl Strategy<Value = [T; 3]> + Clone {
    (above::<T>(), any::<bool>()).prop_map(|([x, y, z], up)| [x, y, if up { z } else { -z }])
}

/// Two directions above the horizon: unrelated, equal, a few ulps apart, mirrored, or almost
/// opposite at the horizon.
pub fn pairs<T: Float>() -> impl Strategy<Value = ([T; 3], [T; 3])> + Clone {
    prop_oneof![
        4 => (above::<T>(), above::<T>()),
        1 => above::<T>().prop_map(|w| (w, w)),
        1 => (above::<T>(), -9..9_i32, -9..9_i32)
            .prop_map(|(w, i, j)| (w, [w[0].stepped(i), w[1].stepped(j), w[2]])),
        1 => above::<T>().prop_map(|w| (w, [-w[0], -w[1], w[2]])),
        1 => (above::<T>(), -9..9_i32, log_uniform(smallest_exponent::<T>(), -8.0), log_uniform(-60.0, 0.0))
            .prop_map(|(w, ulps, z, ratio)| {
                let phi = w[1].to_f64().atan2(w[0].to_f64());
                let [x, y, z_other] = at_height::<T>(z * ratio, phi);
                (at_height(z, phi), [-x.stepped(ulps), -y, z_other])
            }),
    ]
}

/// A random number of [0, 1): anything, both ends, and next to them.
pub fn unit_interval<T: Float>() -> impl Strategy<Value = T> + Clone {
    prop_oneof![
        4 => (0.0..1.0).prop_map(|u| T::lit(u).min(T::BELOW_ONE)),
        1 => Just(T::ZERO),
        1 => Just(T::BELOW_ONE),
        1 => log_uniform(-70.0, -1.0).prop_map(T::lit),
        1 => (1..9_i32).prop_map(|ulps| T::ONE.stepped(-ulps)),
        1 => Just(T::HALF),
    ]
}

/// A slope width: log-uniform over 1e-6 … 1e3, the ends, and ordinary ones.
pub fn alpha() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![8 => log_uniform(-19.9, 9.9), 1 => Just(1e-6), 1 => Just(1e3), 2 => Just(1.0), 4 => 0.01..1.0]
}

/// α and a ratio of up to 1e4 between the axes, within the range of α.
pub fn two_alphas() -> impl Strategy<Value = (f64, f64)> + Clone {
    (alpha(), -13.2..13.2).prop_map(|(a, log)| (a, (a * f64::exp2(log)).clamp(1e-6, 1e3)))
}

/// The correlation of slopes, up to 1 − 1e-6 either way.
pub fn correlation() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![
        3 => -0.9..0.9,
        1 => (log_uniform(-19.9, -1.0), any::<bool>())
            .prop_map(|(rest, up)| if up { 1.0 - rest } else { rest - 1.0 }),
        1 => Just(0.0),
    ]
}

/// The exponent γ of a tail: 0 … 10, integers, and next to 0 and 2.
pub fn gamma() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![
        4 => 0.0..=4.0,
        1 => 4.0..=10.0,
        1 => (0..=10_u8).prop_map(f64::from),
        1 => Just(2.0 + 1e-9),
        1 => Just(1e-9),
    ]
}

/// The columns of an invertible matrix: rotation × diagonal × rotation, singular values 1/16 … 16,
/// either handed.
pub fn matrix() -> impl Strategy<Value = [[f64; 2]; 2]> + Clone {
    (0.0..TAU, -4.0..4.0, -4.0..4.0, 0.0..TAU, any::<bool>()).prop_map(|(a, p, q, b, flipped)| {
        let (x, y) = (f64::exp2(p), f64::exp2(q) * if flipped { -1.0 } else { 1.0 });
        let ((s, c), (t, d)) = (a.sin_cos(), b.sin_cos());
        [[c * x * d - s * y * t, s * x * d + c * y * t], [-c * x * t - s * y * d, -s * x * t + c * y * d]]
    })
}

/// The steps of a footprint: of any size, long and thin, lines and points among them.
pub fn footprint<T: Float>() -> impl Strategy<Value = Footprint<T>> + Clone {
    let size = || prop_oneof![6 => log_uniform(-26.0, 10.0), 1 => Just(0.0)];
    (size(), azimuth(), size(), azimuth()).prop_map(|(a, phi, b, psi)| {
        let step = |length: f64, phi: f64| [length * phi.cos(), length * phi.sin()].map(T::lit);
        Footprint::new(step(a, phi), step(b, psi))
    })
}
