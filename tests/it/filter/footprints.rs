//! Footprints: Jacobians, half vectors, rays and quads, each against differences of what it is the
//! derivative of.

mod ends;
mod half_vector;
mod jacobians;
mod pixels;

use microsurface::frame::Frame;
use microsurface::glam::{DQuat, DVec2, DVec3};
use rand_pcg::Pcg64Mcg;

use crate::random::uniform;

/// Uniform in a cube about 0.
fn vector(random: &mut Pcg64Mcg, size: f64) -> DVec3 {
    DVec3::from_array(core::array::from_fn(|_| uniform(random, -size, size)))
}

/// A unit vector with z of at least `lowest`.
fn direction(random: &mut Pcg64Mcg, lowest: f64) -> DVec3 {
    let (z, phi) = (uniform(random, lowest, 1.0), uniform(random, 0.0, core::f64::consts::TAU));
    let s = (1.0 - z * z).sqrt();
    DVec3::new(s * phi.cos(), s * phi.sin(), z)
}

fn rotation(random: &mut Pcg64Mcg) -> DQuat {
    DQuat::from_axis_angle(direction(random, -1.0), uniform(random, 0.0, 6.0))
}

/// The derivative at 0, by differences of the fourth order.
fn derivative<V>(f: impl Fn(f64) -> V) -> V
where
    V: core::ops::Sub<Output = V> + core::ops::Mul<f64, Output = V>,
{
    let h = 5e-4;
    (f(h) - f(-h)) * (2.0 / (3.0 * h)) - (f(2.0 * h) - f(-2.0 * h)) * (1.0 / (12.0 * h))
}

/// The half vector of unit directions in a frame as slope and as m.xy, by the definitions.
fn half(frame: &Frame<f64>, wi: DVec3, wo: DVec3) -> [DVec2; 2] {
    let [x, y, z] = frame.axes();
    let h = DVec3::new(x.dot(wi + wo), y.dot(wi + wo), z.dot(wi + wo));
    [-h.truncate() / h.z, h.truncate() / h.length()]
}

#[track_caller]
fn near(a: DVec2, b: DVec2, tolerance: f64) {
    assert!((a - b).length() <= tolerance * a.length().max(b.length()), "{a} {b}");
}
