//! The mean of the unit GGX over a parallelogram.

use core::f64::consts::{FRAC_1_PI, TAU};

use crate::Real;
use crate::elementary::atan2;
use crate::elementary::bits::Bits;
use crate::elementary::polynomial::polynomial;
use crate::filter::MeanOverParallelogram;
use crate::ggx::Ggx;

/// The longest side, in units of ℓ, of a parallelogram for 5 × 5 points.
const SMALL: f64 = 0.2;
/// The shorter side, in units of ℓ, of a parallelogram for three lines along the longer one.
const SLIM: f64 = 0.03;
/// The width, in units of ℓ, of a parallelogram that counts as a line.
const THIN: f64 = 1e-5;
/// Gauss's rule of three points, as [`GAUSS`].
const THREE: [[f64; 2]; 3] = [
    [-0.38729833462074168852, 0.27777777777777777778],
    [0.0, 0.44444444444444444444],
    [0.38729833462074168852, 0.27777777777777777778],
];

/// Gauss–Legendre nodes on [−½, ½] and weights of sum 1.
pub(super) const GAUSS: [[f64; 2]; 5] = [
    [-0.45308992296933199640, 0.11846344252809454376],
    [-0.26923465505284154552, 0.23931433524968323402],
    [0.0, 0.28444444444444444444],
    [0.26923465505284154552, 0.23931433524968323402],
    [0.45308992296933199640, 0.11846344252809454376],
];

type Point = [f64; 2];

impl<T: Real> MeanOverParallelogram<T> for Ggx {
    fn mean_over_parallelogram(&self, centre: [f64; 2], u: [f64; 2], v: [f64; 2]) -> f64 {
        mean(centre, u, v)
    }
}

#[inline(always)]
fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// a + k b.
#[inline(always)]
fn plus(a: Point, k: f64, b: Point) -> Point {
    [a[0] + k * b[0], a[1] + k * b[1]]
}

/// P22 of the unit GGX.
#[inline(always)]
fn p22(t: Point) -> f64 {
    let r2 = 1.0 + dot(t, t);
    FRAC_1_PI / (r2 * r2)
}

/// The mean of P22 over `centre` ± ½u ± ½v.
#[inline]
pub(super) fn mean(centre: Point, u: Point, v: Point) -> f64 {
    let (u, v) = if dot(u, u) < dot(v, v) { (v, u) } else { (u, v) };
    let length = Real::sqrt(dot(u, u));
    let distance2 = squared_distance(centre, u, v);
    let scale2 = 1.0 + distance2;
    if length * length <= SMALL * SMALL * scale2 {
        return over_points(centre, u, v);
    }
    if dot(v, v) <= SLIM * SLIM * scale2 {
        return THREE.iter().fold(0.0, |sum, &[b, weight]| {
            let middle = plus(centre, b, v);
            sum + weight * Line::new(plus(middle, -0.5, u), plus(middle, 0.5, u)).constant_mean()
        });
    }
    let area = cross(u, v);
    if area * area <= THIN * THIN * scale2 * (length * length) {
        return over_lines(centre, u, v, length);
    }
    // Counter-clockwise. Opposite edges are as far apart as they are, to the last digit, though
    // their distances from the origin may be much larger: for a thin parallelogram the sum depends
    // on it.
    let (v, area) = if area < 0.0 { ([-v[0], -v[1]], -area) } else { (v, area) };
    let a = plus(plus(centre, -0.5, u), -0.5, v);
    let (b, d) = (plus(a, 1.0, u), plus(a, 1.0, v));
    let c = plus(b, 1.0, v);
    let across_u = cross(centre, u);
    // centre × v with v as its parts along and across u: edges that nearly coincide then do so in
    // distance too.
    let across_v = (dot(u, v) * across_u + area * dot(centre, u)) / (length * length);
    let around = |flux: fn(Edge) -> f64| {
        let along_u = flux(Edge { p: a, q: b, step: u, moment: 0.5 * area + across_u })
            + flux(Edge { p: c, q: d, step: [-u[0], -u[1]], moment: 0.5 * area - across_u });
        let along_v = flux(Edge { p: b, q: c, step: v, moment: 0.5 * area + across_v })
            + flux(Edge { p: d, q: a, step: [-v[0], -v[1]], moment: 0.5 * area - across_v });
        along_u + along_v
    };
    let mean =
        if distance2 > 1.0 { -around(Edge::flux_from_infinity) / area } else { around(Edge::flux) / area };
    // Footprints whose position is rounding may have lost all digits, and their sign.
    if mean < 0.0 { 0.0 } else { mean }
}

/// The squared distance of the parallelogram from the origin, 0 where it holds the origin.
#[inline]
fn squared_distance(centre: Point, u: Point, v: Point) -> f64 {
    // Within if, in the coordinates of the edges, both are at most a half.
    let area = cross(u, v);
    let (a, b) = (cross(centre, v), cross(centre, u));
    if 2.0 * a.abs() <= area.abs() && 2.0 * b.abs() <= area.abs() && area != 0.0 {
        return 0.0;
    }
    // The origin's nearest point of centre + side ± ½ edge, for the two nearer sides of the four.
    let to_side = |side: Point, edge: Point| {
        let towards = if dot(centre, side) > 0.0 { -0.5 } else { 0.5 };
        let mut nearest = f64::INFINITY;
        for sign in [towards, -towards] {
            let middle = plus(centre, sign, side);
            let length2 = dot(edge, edge);
            let along = if length2 > 0.0 { -dot(middle, edge) / length2 } else { 0.0 };
            let point = plus(middle, along.clamp(-0.5, 0.5), edge);
            nearest = nearest.min(dot(point, point));
        }
        nearest
    };
    to_side(u, v).min(to_side(v, u))
}

/// Gauss's product rule: for footprints on which P22 hardly varies.
#[inline]
fn over_points(centre: Point, u: Point, v: Point) -> f64 {
    GAUSS.iter().fold(0.0, |sum, &[a, wa]| {
        let row = plus(centre, a, u);
        sum + wa * GAUSS.iter().fold(0.0, |sum, &[b, wb]| sum + wb * p22(plus(row, b, v)))
    })
}

/// The mean over a parallelogram so thin that it is a line, u its longer edge.
///
/// Seen along u it is as wide as its overlap with itself: growing over the length k of v along u,
/// constant, shrinking over k. In each part the middle of its width is a straight line, and what
/// P22 varies across it is of second order.
#[inline]
fn over_lines(centre: Point, u: Point, v: Point, length: f64) -> f64 {
    let along = dot(u, v) / length;
    let (v, along) = if along < 0.0 { ([-v[0], -v[1]], -along) } else { (v, along) };
    let share = along / length;
    let (start, end) = (plus(plus(centre, -0.5, u), -0.5, v), plus(plus(centre, 0.5, u), 0.5, v));
    // Middles of the widths where v has ended, and where it begins at the other end.
    let across = plus(v, share, u);
    let (first, last) = (plus(start, 0.5, across), plus(end, -0.5, across));
    let rising = |from: Point, to: Point| Line::new(from, to).rising_mean();
    (share * (rising(start, first) + rising(end, last)))
        + (1.0 - share) * Line::new(first, last).constant_mean()
}

/// A segment as seen from the origin.
struct Line {
    from: Point,
    step: Point,
    /// Its length, where it begins and ends along its direction, and 1 + (its distance)².
    length: f64,
    begin: f64,
    end: f64,
    p2: f64,
}

impl Line {
    #[inline]
    fn new(from: Point, to: Point) -> Self {
        let step = plus(to, -1.0, from);
        let length = Real::sqrt(dot(step, step));
        let unit = if length > 0.0 { [step[0] / length, step[1] / length] } else { [1.0, 0.0] };
        let distance = cross(from, unit);
        Self { from, step, length, begin: dot(from, unit), end: dot(to, unit), p2: 1.0 + distance * distance }
    }

    /// Whether P22 hardly varies on it.
    #[inline]
    fn is_short(&self) -> bool {
        let (a, b) = (self.begin * self.begin, self.end * self.end);
        // Where it comes to the nearest point of its line, that is nearer than both ends.
        let nearest = if self.begin * self.end < 0.0 { 0.0 } else { a.min(b) };
        self.length * self.length <= SMALL * SMALL * (self.p2 + nearest)
    }

    /// The mean of P22 on it.
    #[inline]
    fn constant_mean(&self) -> f64 {
        if self.is_short() {
            let middle = plus(self.from, 0.5, self.step);
            return GAUSS.iter().fold(0.0, |sum, &[x, w]| sum + w * p22(plus(middle, x, self.step)));
        }
        FRAC_1_PI * self.integral() / self.length
    }

    /// ∫ (p² + s²)⁻² ds = ½ [s/(p² (p² + s²)) + atan(s/p)/p³].
    ///
    /// Far along the line both terms nearly cancel. With x the tangent of the angle under which the
    /// line is seen, what the first and x/p³ have in common is taken out: left are a quotient of
    /// positive terms and x − atan x.
    #[inline]
    fn integral(&self) -> f64 {
        let p = Real::sqrt(self.p2);
        let ends = (self.p2 + self.begin * self.begin) * (self.p2 + self.end * self.end);
        let product = self.begin * self.end;
        let (opposite, adjacent) = (self.length * p, self.p2 + product);
        if opposite < 0.41 * adjacent {
            let x = opposite / adjacent;
            let x2 = x * x;
            let beyond = -(x * x2) * polynomial(x2, f64::ATAN);
            // The product of both divisors may be beyond the largest number.
            let common = self.length / ends * ((2.0 * adjacent + self.length * self.length) / adjacent);
            return 0.5 * (common - beyond / (p * self.p2));
        }
        let angle = atan2(opposite, adjacent);
        (self.length * (self.p2 - product) / ends + angle / p) / (2.0 * self.p2)
    }

    /// The mean of P22 weighted by x, which rises from 0 to 1 along it.
    #[inline]
    fn rising_mean(&self) -> f64 {
        if self.is_short() {
            let middle = plus(self.from, 0.5, self.step);
            return GAUSS
                .iter()
                .fold(0.0, |sum, &[x, w]| sum + w * (0.5 + x) * p22(plus(middle, x, self.step)));
        }
        // ∫ s (p² + s²)⁻² ds, as a product.
        let (begin2, end2) = (self.p2 + self.begin * self.begin, self.p2 + self.end * self.end);
        let moment = 0.5 * self.length * (self.end + self.begin) / (begin2 * end2);
        FRAC_1_PI * (moment - self.begin * self.integral()) / (self.length * self.length)
    }
}

/// An edge p → q of a polygon, and p × step: its length times its signed distance from the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    p: Point,
    q: Point,
    step: Point,
    moment: f64,
}

impl Edge {
    #[inline]
    pub(super) fn new(p: Point, q: Point) -> Self {
        let step = plus(q, -1.0, p);
        Self { p, q, step, moment: cross(p, step) }
    }

    /// The flux of t/(2π(1 + |t|²)), whose divergence is P22, out to the right of the edge.
    #[inline]
    pub(super) fn flux(self) -> f64 {
        let length = Real::sqrt(dot(self.step, self.step));
        if length == 0.0 {
            return 0.0;
        }
        let distance = self.moment / length;
        let w = Real::sqrt(1.0 + distance * distance);
        distance / w * atan2(length * w, 1.0 + dot(self.p, self.q)) / TAU
    }

    /// The flux of t/(2π|t|²(1 + |t|²)), whose divergence is −P22 but for the origin, out through
    /// the same edge.
    ///
    /// It is d/(2π) ∫ ds/(r²(1 + r²)), r² = d² + s²: a difference of two angles, atan(s/d) and
    /// atan(s/p)·d/p, p² = 1 + d², which nearly agree far from the origin. Across the line of
    /// sight, what they differ by is the angle of tangent s/((p + d)(d p + s²)), and 1/(p (p + d))
    /// of the second; along it, their tangents have a quotient of products in common and what is
    /// left is x − atan x of both.
    #[inline]
    fn flux_from_infinity(self) -> f64 {
        let length = Real::sqrt(dot(self.step, self.step));
        let signed = self.moment / length;
        let d = signed.abs();
        let p2 = 1.0 + d * d;
        let p = Real::sqrt(p2);
        let (begin, end) = (dot(self.p, self.step) / length, dot(self.q, self.step) / length);
        let product = begin * end;
        let flux = if length * p < 0.41 * (d * d + product) && d * d * length < product {
            let (near, far) = (d * d + product, p2 + product);
            let beyond = |opposite: f64, adjacent: f64| {
                let x = opposite / adjacent;
                let x2 = x * x;
                -(x * x2) * polynomial(x2, f64::ATAN)
            };
            length * d / (near * far) - (beyond(length * d, near) - d / p * beyond(length * p, far))
        } else {
            let tangent = |s: f64| (s, (p + d) * (d * p + s * s));
            let ((y0, x0), (y1, x1)) = (tangent(begin), tangent(end));
            let difference = atan2(y1 * x0 - y0 * x1, x0 * x1 + y0 * y1);
            difference + atan2(length * p, p2 + product) / (p * (p + d))
        };
        if signed < 0.0 { -flux / TAU } else { flux / TAU }
    }
}
