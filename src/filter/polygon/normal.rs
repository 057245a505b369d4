//! The mean of the unit Beckmann distribution over boxes and parallelograms.

use core::f64::consts::FRAC_2_SQRT_PI;

use crate::Real;
use crate::elementary::{erf, erfc, exp_neg_square};
use crate::filter::polygon::lambert::GAUSS;

/// The longest panel of the rule across, of eight points.
const PANEL: f64 = 2.0;
const NODES: [f64; 4] =
    [0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959, 0.96028985649753623168];
/// Of mean ¼ over both signs.
const WEIGHTS: [f64; 4] =
    [0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054, 0.10122853629037625915];
/// What lies this much farther from the origin, in squares, than the nearest of all is below 4e-11 of it.
const NEGLIGIBLE: f64 = 24.0;

/// More are asked for only where the position of the edges is known to less than the width of the distribution.
const MOST_PANELS: u16 = 4096;

/// The mean of e^{−x²}/√π within `half` of x.
#[inline]
pub(super) fn mean_within(x: f64, half: f64) -> f64 {
    let (x, half) = (x.abs(), half.abs());
    if half * (1.0 + x) <= 0.25 {
        let near = |&[node, weight]: &[f64; 2]| weight * exp_neg_square(x + 2.0 * half * node);
        return 0.5 * FRAC_2_SQRT_PI * GAUSS.iter().fold(0.0, |sum, point| sum + near(point));
    }
    let (begin, end) = (x - half, x + half);
    // Whichever of both does not cancel.
    let twice = if begin > 0.0 { erfc(begin) - erfc(end) } else { erf(end) - erf(begin) };
    twice / (4.0 * half)
}

/// The mean of e^{−|t|²}/π over `centre` ± ½u ± ½v.
///
/// Along the longer edge an error function, across it Gauss's rule in as many panels as are needed where the density is not
/// negligible.
pub(super) fn mean(centre: [f64; 2], u: [f64; 2], v: [f64; 2]) -> f64 {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let (u, v) = if dot(u, u) < dot(v, v) { (v, u) } else { (u, v) };
    let (long, short) = (Real::sqrt(dot(u, u)), Real::sqrt(dot(v, v)));
    let unit = if long > 0.0 { [u[0] / long, u[1] / long] } else { [1.0, 0.0] };
    // Along and across the longer edge.
    let turned = |t: [f64; 2]| [dot(unit, t), unit[0] * t[1] - unit[1] * t[0]];
    let ([x, y], [dx, dy]) = (turned(centre), turned(v));
    let half = 0.5 * long;
    // The line at b of the shorter edge, and its squared distance from the origin.
    let line = |b: f64| (x + b * dx, y + b * dy);
    let distance2 = |b: f64| {
        let (x, y) = line(b);
        let along = (x.abs() - half).max(0.0);
        along * along + y * y
    };
    // Its least is where the line crosses an axis or an end of the edge, where the distance from an end is least, or at the
    // ends of the shorter edge: a piecewise parabola has no other minima.
    let squared = dx * dx + dy * dy;
    let candidates = [
        -y / dy,
        (half - x) / dx,
        (-half - x) / dx,
        -(dx * (x - half) + dy * y) / squared,
        -(dx * (x + half) + dy * y) / squared,
        -0.5,
        0.5,
    ];
    let least = candidates.iter().fold(f64::INFINITY, |least, &b| {
        // NaN, of a quotient by 0, is no candidate.
        let b = if b > -0.5 { b.min(0.5) } else { -0.5 };
        let distance2 = distance2(b);
        if distance2 < least { distance2 } else { least }
    });
    // Beyond this distance along either axis all is negligible.
    let reach = Real::sqrt(least + NEGLIGIBLE);
    let (mut first, mut last) = (-0.5_f64, 0.5_f64);
    for (at, step, reach) in [(y, dy, reach), (x, dx, half + reach)] {
        if step != 0.0 {
            let (a, b) = ((-reach - at) / step, (reach - at) / step);
            first = first.max(a.min(b)).min(0.5);
            last = last.min(a.max(b)).max(-0.5);
        }
    }
    // The density varies on a distance of 1 near the origin and of 1/r far from it.
    let panels = (last - first) * short * (1.0 + Real::sqrt(least)) / PANEL;
    let (mut count, mut width) = (1_u16, last - first);
    while f64::from(count) < panels && count < MOST_PANELS {
        count *= 2;
        width *= 0.5;
    }
    let mut sum = 0.0;
    for panel in 0..count {
        let middle = first + width * (f64::from(panel) + 0.5);
        for (node, weight) in NODES.iter().zip(WEIGHTS) {
            for offset in [-0.5 * node, 0.5 * node] {
                let (x, y) = line(middle + width * offset);
                sum += 0.5 * weight * exp_neg_square(y) * mean_within(x, half);
            }
        }
    }
    // mean_within has one of the two 1/√π.
    0.5 * FRAC_2_SQRT_PI * sum * width
}
