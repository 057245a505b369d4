//! GTR of any exponent as a mixture, over the squared width t ∈ [α², 1], of GTR of an integer
//! exponent.
//!
//! With n = max(0, ⌈γ⌉ − 2), p = n + 2 − γ and q = γ,
//!
//! (x + 1)^{γ−2}/(x + α²)^γ ∝ ∫ (t − α²)^{p−1} (1 − t)^{q−1} (x + 1)ⁿ/(x + t)^{n+2} dt over t ∈
//! [α², 1],
//!
//! a Beta integral: a positive mixture of GTR of exponent n + 2 and width √t. For γ ≤ 2 that is
//! GGX. As projected areas are linear in the density of slopes, the mask is the same mixture of
//! masks.
//!
//! With t = (α² + y)/(1 + y), y = eˢ, the weight of a normalised component over s is y^p (1 +
//! y)^{−n−2} Kₙ(t), Kₙ = Σᵢ t^{−i−1}, i = 0 … n, which is (n + 1) ∫ (x + 1)ⁿ/(x + t)^{n+2} dx over
//! x ≥ 0. It is analytic for |Im s| < π and falls off exponentially at both ends, so that the
//! trapezoid rule of step h has an error of about e^{−2π²/h}. Where all t equal an end to a
//! relative δ, the remaining sum is geometric and is taken whole.

use crate::Real;
use crate::error::Error;
use crate::gtr::integer::{LARGEST_DEGREE, number};
use crate::gtr::{LIMIT_EXCESS, range_and_log};
use crate::real::construction::{exp, exp_m1, ln};

/// γ as f64.
///
/// # Errors
/// [`Error::Gamma`] unless 0 ≤ γ ≤ 10.
pub(super) fn covered<T: Real>(gamma: T) -> Result<f64, Error> {
    let (value, largest) = (gamma.to_f64(), number(LARGEST_DEGREE + 2));
    if (0.0..=largest).contains(&value) { Ok(value) } else { Err(Error::Gamma { value, largest }) }
}

/// The measure over t, as the points of a trapezoid rule.
pub(super) struct Measure {
    /// n: the components are GTR of exponent n + 2.
    pub(super) degree: usize,
    points: Points,
}

enum Points {
    /// All of it at one t: the exponent is an integer.
    One(f64),
    Trapezoid(Trapezoid),
}

/// y runs through `count` values from `y`, `growth` apart in ratio.
struct Trapezoid {
    alpha2: f64,
    count: usize,
    y: f64,
    growth: f64,
    power: f64,
    power_growth: f64,
    lower_end: f64,
    upper_end: f64,
}

/// Tolerances of a trapezoid rule.
pub(super) struct Resolution {
    /// δ: what is nearer than this to an end of the range, relative to it, is taken to be at it.
    pub(super) end: f64,
    /// The step of s if the points suffice for it.
    pub(super) step: f64,
    /// The largest number of points.
    pub(super) points: usize,
}

impl Measure {
    /// The measure of a width and of an exponent that is [`covered`].
    pub(super) fn new(alpha: f64, gamma: f64, resolution: &Resolution) -> Self {
        let degree = (0..LARGEST_DEGREE).take_while(|&n| gamma > number(n + 2)).count();
        let p = number(degree + 2) - gamma;
        let alpha2 = alpha * alpha;
        // 1/γ is the weight of the end beside the rest, which then is below the rounding.
        let points = if gamma < LIMIT_EXCESS {
            Points::One(1.0)
        } else if p == 0.0 {
            Points::One(alpha2)
        } else {
            Points::Trapezoid(Trapezoid::new(alpha, p, gamma, resolution))
        };
        Self { degree, points }
    }

    /// Calls `f` with every t, ascending, and its weight, which are not normalised.
    pub(super) fn for_each(&self, mut f: impl FnMut(f64, f64)) {
        match &self.points {
            Points::One(t) => f(*t, 1.0),
            Points::Trapezoid(rule) => rule.for_each(self.degree, f),
        }
    }
}

impl Trapezoid {
    fn new(alpha: f64, p: f64, q: f64, resolution: &Resolution) -> Self {
        let (range, log) = range_and_log(alpha);
        let log_range = ln(range);
        let log_end = ln(resolution.end);
        // (t − α²)/α² ≤ δ, or nothing left of the integrand; the same at t = 1.
        let from = (log_end + log - log_range).max((log - log_range).min(0.0) + log_end / p);
        let to = (log_range - log_end).min(-log_end / q).max(from);
        let step = resolution.step.max((to - from) / number(resolution.points - 1));
        let mut count = 1;
        while count < resolution.points && from + number(count) * step <= to {
            count += 1;
        }
        Self {
            alpha2: alpha * alpha,
            count,
            y: exp(from),
            growth: exp(step),
            // Scaled, so that the largest weights are neither denormal nor infinite.
            power: exp(p * (from - to)),
            power_growth: exp(p * step),
            lower_end: -1.0 / exp_m1(-p * step),
            upper_end: -1.0 / exp_m1(-q * step),
        }
    }

    fn for_each(&self, degree: usize, mut f: impl FnMut(f64, f64)) {
        let (mut y, mut power) = (self.y, self.power);
        for i in 0..self.count {
            let inverse = 1.0 / (1.0 + y);
            let t = (self.alpha2 + y) * inverse;
            let weight = power * density(degree, self.alpha2, t, inverse);
            let ends = if i == 0 { self.lower_end } else { 1.0 };
            let ends = if i + 1 == self.count { ends * self.upper_end } else { ends };
            f(t, weight * ends);
            y *= self.growth;
            power *= self.power_growth;
        }
    }
}

/// (1 + y)^{−n−2} Kₙ(t) α^{2n+2}.
fn density(degree: usize, alpha2: f64, t: f64, inverse: f64) -> f64 {
    let ratio = alpha2 / t;
    let mut power = ratio;
    let mut sum = ratio;
    let mut factor = inverse * inverse;
    for _ in 0..degree {
        power *= ratio;
        sum = sum * alpha2 + power;
        factor *= inverse;
    }
    sum * factor
}
