//! The mean of the unit Beckmann distribution over boxes and parallelograms.

use core::f64::consts::FRAC_2_SQRT_PI;

use crate::Real;
use crate::beckmann::{Beckmann, BeckmannTo1e6};
use crate::elementary::{erf, erfc, exp_neg_square};
use crate::filter::MeanOverParallelogram;
use crate::filter::means::ggx::GAUSS;

/// Gauss–Legendre nodes on [−1, 1], the positive ones, and weights that add up to ½: eight points,
/// …
const FEW: [[f64; 2]; 4] = [
    [0.18343464249564980494, 0.18134189168918099148],
    [0.52553240991632898582, 0.15685332293894364367],
    [0.79666647741362673959, 0.11119051722668723527],
    [0.96028985649753623168, 0.050614268145188127075],
];
/// … and of twenty-four.
const MANY: [[f64; 2]; 12] = [
    [0.064056892862605626085, 0.063969097673376078485],
    [0.19111886747361630916, 0.06291872817341414806],
    [0.31504267969616337439, 0.0608352364639016956],
    [0.43379350762604513849, 0.057752834026862800675],
    [0.54542147138883953566, 0.05372213505798281739],
    [0.64809365193697556925, 0.048809326052056944135],
    [0.74012419157855436424, 0.0430950807659766379585],
    [0.82000198597390292195, 0.036673240705540152867],
    [0.88641552700440103421, 0.029649292457718390373],
    [0.93827455200273275852, 0.022138719408709903182],
    [0.9747285559713094982, 0.0142656943144668315905],
    [0.99518721999702136018, 0.0061706148999935997735],
];
/// The longest piece for eight points, in units of the distance on which the density varies.
const SHORT: f64 = 2.0;
/// The longest piece for twenty-four points.
const LONG: f64 = 10.0;
/// Points whose squared distance exceeds the least of all by more than this contribute below 2e-10
/// of it.
const NEGLIGIBLE: f64 = 22.5;
/// e^{−x²} of numbers whose square is beyond this is 0.
const VANISHES: f64 = 746.0;
/// erfc 4.5 = 2e-10: an interval around a point, to this distance, counts as the whole line.
const INSIDE: f64 = 4.5;

impl<T: Real> MeanOverParallelogram<T> for Beckmann {
    fn mean_over_parallelogram(&self, centre: [f64; 2], u: [f64; 2], v: [f64; 2]) -> f64 {
        mean(centre, u, v)
    }

    fn mean_over_box(&self, centre: [f64; 2], half: [f64; 2]) -> f64 {
        mean_within(centre[0], half[0]) * mean_within(centre[1], half[1])
    }
}

impl<T: Real> MeanOverParallelogram<T> for BeckmannTo1e6 {
    fn mean_over_parallelogram(&self, centre: [f64; 2], u: [f64; 2], v: [f64; 2]) -> f64 {
        MeanOverParallelogram::<T>::mean_over_parallelogram(&Beckmann, centre, u, v)
    }

    fn mean_over_box(&self, centre: [f64; 2], half: [f64; 2]) -> f64 {
        MeanOverParallelogram::<T>::mean_over_box(&Beckmann, centre, half)
    }
}

/// The mean of e^{−x²}/√π within `half` of x.
#[inline]
pub(super) fn mean_within(x: f64, half: f64) -> f64 {
    let (x, half) = (x.abs(), half.abs());
    if half * (1.0 + x) <= 0.12 {
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
/// Along the longer edge it is a difference of error functions. Across it is Gauss's rule, on the
/// part where the density is not negligible. A long edge that is not across the other makes that
/// part flat in the middle and steep at both ends: then it is cut into three.
pub(super) fn mean(centre: [f64; 2], u: [f64; 2], v: [f64; 2]) -> f64 {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let (u, v) = if dot(u, u) < dot(v, v) { (v, u) } else { (u, v) };
    let long = Real::sqrt(dot(u, u));
    let unit = if long > 0.0 { [u[0] / long, u[1] / long] } else { [1.0, 0.0] };
    // Along and across the longer edge.
    let turned = |t: [f64; 2]| [dot(unit, t), unit[0] * t[1] - unit[1] * t[0]];
    let across = Across { at: turned(centre), step: turned(v), half: 0.5 * long };
    let Some(Seen { first, last, least }) = across.seen() else { return 0.0 };
    let [dx, dy] = across.step;
    let length = Real::sqrt(dx * dx + dy * dy);
    // Where the lines begin and cease to be inside by far.
    let inside = across.half - INSIDE;
    let ends = if inside > 0.0 && dx != 0.0 {
        let (a, b) = ((-inside - across.at[0]) / dx, (inside - across.at[0]) / dx);
        [a.min(b).clamp(first, last), a.max(b).clamp(first, last)]
    } else {
        [first; 2]
    };
    let mut sum = 0.0;
    for (from, to, speed) in [(first, ends[0], length), (ends[0], ends[1], dy.abs()), (ends[1], last, length)]
    {
        if from >= to {
            continue;
        }
        let distance = (to - from) * speed;
        // The density varies on a distance of 1 near the origin and of 1/r far from it.
        if distance * (1.0 + Real::sqrt(least)) <= SHORT {
            sum += across.integral(from, to, &FEW);
            continue;
        }
        // No part that is not negligible is longer than three.
        let mut pieces = 1.0;
        while pieces * LONG < distance && pieces < 3.0 {
            pieces += 1.0;
        }
        let width = (to - from) / pieces;
        let mut begin = from;
        while pieces > 0.0 {
            sum += across.integral(begin, begin + width, &MANY);
            begin += width;
            pieces -= 1.0;
        }
    }
    // mean_within has one of the two 1/√π.
    0.5 * FRAC_2_SQRT_PI * sum
}

/// A segment of lines parallel to the longer edge, as the shorter one is followed from −½ to ½.
struct Across {
    /// Its middle at 0, and how that moves: along it, and across.
    at: [f64; 2],
    step: [f64; 2],
    half: f64,
}

/// The part of the shorter edge on which the density is not negligible.
struct Seen {
    first: f64,
    last: f64,
    /// The least squared distance from the origin.
    least: f64,
}

impl Across {
    fn line(&self, b: f64) -> [f64; 2] {
        [self.at[0] + b * self.step[0], self.at[1] + b * self.step[1]]
    }

    /// The squared distance of the segment at b.
    fn distance2(&self, b: f64) -> f64 {
        let [x, y] = self.line(b);
        let along = (x.abs() - self.half).max(0.0);
        along * along + y * y
    }

    /// Nothing where the density is 0 on all of it.
    fn seen(&self) -> Option<Seen> {
        let ([x, y], [dx, dy], half) = (self.at, self.step, self.half);
        let squared = dx * dx + dy * dy;
        // The squared distance is a parabola in pieces. Its least is where the line crosses an axis
        // or an end of the edge, where the distance from an end is least, or at the ends of the
        // shorter edge.
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
            let distance2 = self.distance2(b);
            if distance2 < least { distance2 } else { least }
        });
        if least > VANISHES {
            return None;
        }
        if squared == 0.0 {
            return Some(Seen { first: -0.5, last: 0.5, least });
        }
        // The points nearer than this to the edge's image are a rectangle and two discs at its
        // ends. The line crosses each of them in an interval; together these are one.
        let reach2 = least + NEGLIGIBLE;
        let disc = |x: f64| {
            let distance = (x * dy - y * dx) / Real::sqrt(squared);
            let (middle, inside) = (-(x * dx + y * dy) / squared, (reach2 - distance * distance) / squared);
            (inside >= 0.0).then(|| (middle - Real::sqrt(inside), middle + Real::sqrt(inside)))
        };
        let strip = |at: f64, step: f64, half: f64| {
            if step == 0.0 {
                return if at.abs() <= half { (-0.5, 0.5) } else { (1.0, -1.0) };
            }
            let (a, b) = ((-half - at) / step, (half - at) / step);
            (a.min(b), a.max(b))
        };
        let (along, beside) = (strip(x, dx, half), strip(y, dy, Real::sqrt(reach2)));
        let between = (along.0.max(beside.0), along.1.min(beside.1));
        let between = (between.0 <= between.1).then_some(between);
        let (mut first, mut last) = (f64::INFINITY, f64::NEG_INFINITY);
        for (a, b) in [disc(x - half), disc(x + half), between].into_iter().flatten() {
            (first, last) = (first.min(a), last.max(b));
        }
        // Nearly parallel ones may be lost to rounding: all of it then.
        if first > last {
            (first, last) = (-0.5, 0.5);
        }
        Some(Seen { first: first.clamp(-0.5, 0.5), last: last.clamp(-0.5, 0.5), least })
    }

    /// ∫ e^{−y²} times the mean of e^{−x²}/√π on the segment, from b = `from` to `to`.
    fn integral(&self, from: f64, to: f64, rule: &[[f64; 2]]) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let at = |b: f64| {
            let [x, y] = self.line(b);
            exp_neg_square(y) * mean_within(x, self.half)
        };
        let sum = rule.iter().fold(0.0, |sum, &[node, weight]| {
            sum + weight * (at(middle - half * node) + at(middle + half * node))
        });
        (to - from) * sum
    }
}
