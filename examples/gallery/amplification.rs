//! A plot: how much larger errors of derivatives become in slopes than in the projected space.

use microsurface::filter::jacobian::Amplification;
use microsurface::glam::DVec3;

use crate::plot::{Axis, Curve, svg};

pub(crate) const LOOK_FOR: &str = "\
  How many times an error of the half vector's derivatives is larger in the space of a filter than it was as an angle,
  against the angle between half vector and normal; the largest and the smallest factor over the directions of the
  error. In slopes it grows without bound, to 33 at 80 degrees; in the projected space it is never above 1.";

/// In degrees; beyond it slopes leave the plot.
const LARGEST_ANGLE: u8 = 89;
const DECADES: [i32; 2] = [-2, 4];

fn curve(name: &'static str, colour: &'static str, dashes: &'static str, gain: fn(DVec3) -> f64) -> Curve {
    let points = (0..=2 * LARGEST_ANGLE)
        .map(|half_degrees| {
            let angle = 0.5 * f64::from(half_degrees);
            let (sin, cos) = angle.to_radians().sin_cos();
            [angle, gain(DVec3::new(sin, 0.0, cos)).log10()]
        })
        .collect();
    Curve { name, colour, dashes, points }
}

/// The plot as SVG.
pub(crate) fn plot() -> String {
    let curves = [
        curve("slopes, along the angle: 1/cos²", "#d62728", "none", |m| {
            Amplification::<f64>::in_slopes(m).largest
        }),
        curve("slopes, across it: 1/cos", "#d62728", "8 6", |m| Amplification::<f64>::in_slopes(m).smallest),
        curve("projected, across it: 1", "#1f77b4", "8 6", |m| Amplification::<f64>::on_disk(m).largest),
        curve("projected, along the angle: cos", "#1f77b4", "none", |m| {
            Amplification::<f64>::on_disk(m).smallest
        }),
    ];
    let angle = Axis::linear(90, 10, "°", "angle of the half vector from the normal");
    svg(&angle, &Axis::decades(DECADES, "amplification of an error"), &curves, 0.06)
}
