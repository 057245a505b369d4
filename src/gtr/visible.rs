//! Visible normals of the Student-t slopes of integer exponent, exactly.
//!
//! # The densities
//!
//! The profile is P22(r²) = (k + 1)/(π(1 + r²)^(k+2)), D(m) = (k + 1)/π·m.z^(2k); k = 0 is GGX.
//! Normals seen from v have the density max(0, v·m)·m.z^(2k). In the plane of v and the vertical
//! let e be the angle of v from straight *down*, and write a normal as an angle η out of that plane
//! and an angle d in it, from the edge of visibility:
//!
//! v·m = cos η·sin d,  m.z = cos η·sin y,  y = e − d,  dm = cos η·dη·dd.
//!
//! So the density is a product: cos^(2k+2) η, which does not depend on v, times sin d·sin^(2k) y on
//! 0 < d < e. Both integrals are elementary; [`aside`] inverts that of η.
//!
//! # The integrals of d
//!
//! Let G be the integral from y = 0 up to y, C that from d = 0 up to d, C + G = G(e). With ξ =
//! tan(y/2), for y ≤ ½π,
//!
//! G = sin^(2k) y·K(y, e), K = sin y·(sin e/(2k + 1) − cos e·ξ·Σᵢ βᵢ ξ²ⁱ), βᵢ = k!²/((k + 1 +
//! i)!·(k − i)!), i ≤ k,
//!
//! a sum of positive terms for v above the horizon. Below it two terms nearly cancel, and with sin
//! e = sin(y + d)
//!
//! K = tan y·(sin d/(2k + 1) + ½ cos e·sin y·Σᵢ κᵢ ξ²ⁱ), κ₀ = 1/((k + 1)(2k + 1)), κᵢ = βᵢ₋₁ − βᵢ,
//! β_{k+1} = 0,
//!
//! has none that are negative. Beyond y = ½π, seen from the other side, y stands for π − y and sin
//! e for −sin e, and the difference of two such values is C. Below the horizon everything is
//! divided by sin^(2k) e, so that nothing underflows.
//!
//! # The step
//!
//! V = 1 − cos d as a function of λ = ln(C/G) is as V ∝ C^κ, 1/(k + 1) ≤ κ ≤ 1, at the edge of
//! visibility, and approaches its end like G^κ. So its Taylor series serves everywhere. With φ =
//! C/(C + G), γ = 1 − φ,
//!
//! τ = d′ = CG/(G(e)·sin d·sin^(2k) y), X = τ·cot y, ρ = τ·cot d, r = γ − φ + 2kX: V′ = τ·sin d,
//! V″ = rV′, τ′ = τ(r − ρ), X′ = X(r − ρ) + X² + τ², ρ′ = ρ(r − ρ) − ρ² − τ², φ′ = φγ,
//!
//! all algebraic. Four terms are used; the difference of λ is 2 artanh of (C − uG(e))/(C(1 − u) +
//! G·u). Two steps are enough: the guess is off by at most 2.5 in λ, at p = 1 − u = 10⁻¹³, and by
//! 1.6 where p is above 10⁻⁷; the fifth power of what is left counts.
//!
//! # The guess
//!
//! - Below the horizon ϑ² = 1 − p^(1/(2k+1)) and V/V(e) = q², q = ϑ(c + (1 − c)ϑ), where c makes
//!   the edge of visibility right. This is exact for a horizontal v; as v sinks, G → sin^(2k+1)
//!   y·(1 − y/e·(2k + 1)/(2k + 2)) in proportion.
//! - Above it, G(½π) = sin e/(2k + 1) + |cos e|·Q is the sum of two terms that grow about as the
//!   powers 2k + 1 and 2k + 2 of Y, where Y² ∝ h(1 − νh), h = sin² ½y, has the right values at both
//!   ends of y ≤ ½π. An intermediate power inverts it.
//! - Beyond that y, C ∝ Y^(2k+2) for a vertical v, and otherwise V becomes smaller by the factor
//!   F^(−2k), where F, a hyperbola, goes from its tangent at 1 to the asymptote t that gives the
//!   edge of visibility: C = V·sin^(2k) e.

mod aside;
mod coefficients;

use crate::elementary::polynomial::polynomial;
use crate::elementary::{exp_m1, ln};
use crate::gtr::integer::number;
use crate::real::{Real, select};
use crate::vector::inside;
use coefficients::{BETA, GUESS, HALF_TOTAL, KAPPA, MAX};

/// sin e is taken no smaller: the products of a step, of the order of sin⁴e, and 2⁻⁵⁴ some times,
/// stay normal.
const LOWEST: f64 = 7.888609052210118e-31; // 2⁻¹⁰⁰
/// C and G are taken as no smaller a part of the whole than the u that are told from 0, by an
/// eighth.
const FLOOR: f64 = 6.938893903907228e-18; // 2⁻⁵⁷
/// Below this u, ln(1 − u) is −u(1 + ½u) to more digits than a guess needs, and 1 − u is not.
const SMALL: f64 = 0.0001220703125; // 2⁻¹³
/// A step is at most this long in λ, 2, and ends at most this much, 16 times, nearer to either end.
const LONGEST: (f64, f64) = (2.0, 0.0625);

/// xⁿ.
#[inline(always)]
fn power<W: Real>(x: W, n: usize) -> W {
    let (mut result, mut square, mut rest) = (W::ONE, x, n);
    while rest > 0 {
        if rest % 2 == 1 {
            result *= square;
        }
        square = square * square;
        rest /= 2;
    }
    result
}

/// A place on the way from the edge of visibility, d = 0, to the horizon of the normals, y = 0.
struct Place<W> {
    sin_d: W,
    cos_d: W,
    sin_y: W,
    cos_y: W,
}

/// Numbers that depend on k and the view direction alone.
struct View<W> {
    k: usize,
    /// Whether v is below the horizon.
    below: bool,
    /// sin e > 0 and cos e.
    sin: W,
    cos: W,
    /// 1/sin²e below the horizon: sin^(2k) is everywhere divided by that of e. Above it 1.
    scale: W,
    /// G(e), and K of e itself for v above the horizon; scaled.
    total: W,
    end: W,
    /// 1/G(e).
    inverse: W,
    /// 1 − cos e.
    farthest: W,
}

impl<W: Real> View<W> {
    #[inline(always)]
    fn new(k: usize, sin: W, cos: W) -> Self {
        let below = cos > W::ZERO;
        let scale = select(below, W::ONE / (sin * sin), W::ONE);
        let farthest = select(below, sin * sin / (W::ONE + cos), W::ONE - cos);
        let view =
            Self { k, below, sin, cos, scale, total: W::ZERO, end: W::ZERO, inverse: W::ZERO, farthest };
        let edge = Place { sin_d: W::ZERO, cos_d: W::ONE, sin_y: sin, cos_y: cos };
        let end = power(sin * sin * scale, k) * view.bracket(&edge);
        let total = select(below, end, W::TWO * W::lit(HALF_TOTAL[k - 1]) * -cos - end);
        Self { total, end, inverse: W::ONE / total, ..view }
    }

    /// ±K(y, e), with its sign for y ≤ ½π.
    #[inline(always)]
    fn bracket(&self, place: &Place<W>) -> W {
        let &Place { sin_d, sin_y, cos_y, .. } = place;
        let xi = sin_y / (W::ONE + cos_y.abs());
        let xi2 = xi * xi;
        let part = W::lit(1.0 / number(2 * self.k + 1));
        let bracket = if self.below {
            let sum = W::HALF * sin_y * polynomial(xi2, &KAPPA[self.k - 1][..=self.k + 1]);
            (sin_d * part + self.cos * sum) / cos_y
        } else {
            let sum = xi * polynomial(xi2, &BETA[self.k - 1][..=self.k]);
            self.sin * select(cos_y > W::ZERO, part, -part) - self.cos * sum
        };
        sin_y * bracket
    }

    /// Where 1 − cos d = `v`.
    #[inline(always)]
    fn place(&self, v: W) -> Place<W> {
        let sin_d = (v * (W::TWO - v)).sqrt();
        let cos_d = W::ONE - v;
        let sin_y = self.sin * cos_d - self.cos * sin_d;
        let cos_y = self.cos * cos_d + self.sin * sin_d;
        Place { sin_d, cos_d, sin_y, cos_y }
    }

    /// C/G(e), G/G(e) and sin^(2k) y, scaled.
    #[inline(always)]
    fn distribution(&self, place: &Place<W>) -> (W, W, W) {
        let floor = W::lit(FLOOR) * self.total;
        let falloff = power(place.sin_y * place.sin_y * self.scale, self.k);
        let value = falloff * self.bracket(place);
        let near = place.cos_y > W::ZERO;
        let c = select(near, self.total - value, value - self.end).max(floor);
        let g = select(near, value, self.total - c).max(floor);
        (c, g, falloff)
    }

    /// The guess of V = 1 − cos d, in the arithmetic of `T`.
    #[inline(always)]
    fn guess<T: Real<Wide = W>>(&self, u: T) -> W {
        let (k, l) = (self.k, T::lit);
        let p = T::ONE - u;
        let v = if self.below {
            let log = select(u < l(SMALL), -u * (T::ONE + T::HALF * u), ln(p));
            let less = -exp_m1(log * l(1.0 / number(2 * k + 1)));
            let c = T::narrow(W::lit(number(2 * k + 1)) * self.total / self.farthest).sqrt();
            let theta = less.sqrt();
            let q = theta * (c + (T::ONE - c) * theta);
            self.farthest * (q * q).widen()
        } else {
            let [sin, rise, total] = [self.sin, -self.cos, self.total].map(T::narrow);
            let (first, second) = (sin * l(1.0 / number(2 * k + 1)), rise * l(HALF_TOTAL[k - 1]));
            let middle = first + second;
            let v = if p * total < middle {
                self.guess_near(p * total, first, second)
            } else {
                self.guess_beyond(u * total, total - middle)
            };
            v.widen()
        };
        // the density is below sin d: C ≤ V
        v.max(u.widen() * self.total)
    }

    /// The guess where y < ½π, v above the horizon, of G and the two terms of G(½π).
    #[inline(always)]
    fn guess_near<T: Real<Wide = W>>(&self, value: T, first: T, second: T) -> T {
        let l = T::lit;
        let [sin, rise] = [self.sin, -self.cos].map(T::narrow);
        let odd = l(number(2 * self.k + 1));
        let inverse = T::ONE / (first + second);
        let log = ln(value * inverse);
        // the mean of the power of Y at ½π and, roughly, at y
        let weight = second * inverse;
        let x = log * l(0.25) / (odd + weight);
        let y = T::ONE / (T::ONE - x * (T::ONE - x * T::HALF));
        let y = (y * y) * (y * y);
        let weight = T::HALF * (weight + second * y / (first + second * y));
        let less = -exp_m1(log / (odd + weight));
        // 1 − Y², which is 0 where v is horizontal to rounding
        let less = (less * (T::TWO - less)).max(T::MIN_POSITIVE);
        let rest = l(1.0 - GUESS[self.k - 1][0]) * rise * rise;
        let nu = T::ONE - rest;
        // cos y = 1 − 2h where h(1 − νh) = ¼(2 − ν)Y²; d is the sum of what y and v keep from ½π
        let full = (T::ONE + rest) * less;
        let cos_y = (full / ((rest * rest + nu * full).sqrt() + rest)).min(T::ONE);
        let sin_y = (T::ONE - cos_y * cos_y).sqrt();
        let (sin_d, cos_d) = (sin * cos_y + rise * sin_y, sin * sin_y - rise * cos_y);
        if cos_d > T::ZERO { sin_d * sin_d / (T::ONE + cos_d) } else { T::ONE - cos_d }
    }

    /// The guess where y > ½π, v above the horizon, of C and about C at ½π.
    #[inline(always)]
    fn guess_beyond<T: Real<Wide = W>>(&self, value: T, middle: T) -> T {
        let (k, l) = (self.k, T::lit);
        let [nu, mean, slope] = GUESS[k - 1].map(T::lit);
        let [sin, rise] = [self.sin, -self.cos].map(T::narrow);
        // V at ½π; the mean of sin^(2k) is between Q and 1
        let farthest = rise * rise / (T::ONE + sin);
        let middle = middle.max(farthest * l(HALF_TOTAL[k - 1])).min(farthest);
        let part = (value / middle).min(T::ONE);
        let less = -exp_m1(ln(part) * l(0.5 / number(k + 1)));
        let root = T::ONE - less;
        let start = sin / (mean + (T::ONE - mean) * sin);
        let t = start / root;
        let tangent = T::ONE + slope * (t - start);
        let gap = tangent - t;
        // rounded where the lines are near each other
        let round = t.min(T::ONE) * less * l(1.0 / number(k));
        let f = T::HALF * (tangent + t + (gap * gap + round).sqrt());
        let square = (T::TWO - nu) * root * root;
        farthest * square / ((T::ONE + (T::ONE - nu * square).sqrt()) * power(f * f, k))
    }

    /// A better V: the Taylor series of the module's text.
    #[inline(always)]
    fn step(&self, v: W, u: W) -> W {
        let l = W::lit;
        let place = self.place(v);
        let (c, g, falloff) = self.distribution(&place);
        let p = W::ONE - u;
        // one division for three
        let (both, sum) = (place.sin_d * place.sin_y, c * p + g * u);
        let inverse = W::ONE / (falloff * both * sum);
        let y = (c - u * self.total) * (inverse * falloff * both);
        let z = y * y;
        let (phi, gamma) = (c * self.inverse, g * self.inverse);
        let over_both = phi * g * (inverse * sum);
        let w = over_both * both;
        let delta = -W::TWO * y * (W::ONE + z * (l(1.0 / 3.0) + z * (l(0.2) + z * l(1.0 / 7.0))));
        let delta = delta.min(l(LONGEST.0)).max(-l(LONGEST.0));

        let two_k = l(number(2 * self.k));
        let x = over_both * place.cos_y;
        let tau = over_both * place.sin_y;
        let rho = tau * place.cos_d * (inverse * sum * falloff * place.sin_y);
        let tau2 = tau * tau;
        let odds = gamma - phi;
        let variance = W::TWO * phi * gamma;
        let r = odds + two_k * x;
        let s = r - rho;
        let x1 = s * x + (x * x + tau2);
        let rho1 = s * rho - (rho * rho + tau2);
        let r1 = two_k * x1 - variance;
        let x2 = (r1 - rho1) * x + s * x1 + W::TWO * (x * x1 + tau2 * s);
        let r2 = two_k * x2 - variance * odds;
        let third = r1 + r * r;
        let fourth = r2 + r * (W::TWO * r1 + third);
        let series =
            W::ONE + delta * (W::HALF * r + delta * (l(1.0 / 6.0) * third + delta * l(1.0 / 24.0) * fourth));
        let nearest = l(LONGEST.1);
        (v + w * delta * series).max(nearest * v).min(self.farthest - nearest * (self.farthest - v))
    }

    /// The place with C = u·G(e).
    #[inline(always)]
    fn solve<T: Real<Wide = W>>(&self, u: T) -> Place<W> {
        let v = self.guess(u);
        let u = u.widen();
        self.place(self.step(self.step(v, u), u))
    }
}

/// A normal, of any length, visible from `v`, with density max(0, v·m)·m.z^(2k) on m.z ≥ 0.
///
/// `u[0]` turns the normal out of the plane of `v` and the vertical, increasing to the left of v's
/// horizontal direction; `u[1]` turns it, in its projection to that plane, from the edge of
/// visibility to the horizon of the normals.
///
/// # Domain
/// 1 ≤ k ≤ 8; `v` of any length whose square neither overflows nor underflows, v ≠ 0, on the whole
/// sphere; u in [0, 1), of which less than ε/4 is taken as ε/4, the middle of the first cell of
/// random numbers.
///
/// # Returns
/// Finite numbers, m.z ≥ 0, v·m ≥ 0 up to rounding. Straight down, where nothing is visible, m is
/// horizontal.
///
/// # Accuracy
/// As a difference of u: f64 5e-15 in the plane and 5e-16 out of it. f32 computes in f64: 2e-9, and
/// monotone ulp by ulp. At the edge of visibility C is right to 4e-15/u relatively, and d to half
/// of that; also below the horizon, where d is measured against e.
#[inline(always)]
pub(super) fn sample_visible<T: Real>(k: usize, v: [T; 3], u: [T; 2]) -> [T; 3] {
    let [x, y, z] = v.map(Real::widen);
    let s2 = x * x + y * y;
    let inverse = T::Wide::ONE / (s2 + z * z).sqrt();
    // where the square is not normal its root has lost digits, and the sine of v vanishes
    let normal = s2 >= T::Wide::MIN_POSITIVE;
    let s = s2.sqrt();
    let over = T::Wide::ONE / select(normal, s, T::Wide::ONE);
    let (cos_v, sin_v) = (select(normal, x * over, T::Wide::ONE), select(normal, y * over, T::Wide::ZERO));

    let view = View::new(k, (s * inverse).max(T::Wide::lit(LOWEST)), -z * inverse);
    let place = view.solve(inside(u[1]));
    let (sin, cos) = aside::angle(k, inside(u[0]));
    // Limits drop NaN: this is 0 or NaN.
    let nan = T::Wide::ZERO * (x + y + z + (u[0] + u[1]).widen());
    let along = cos * place.cos_y + nan;
    [along * cos_v - sin * sin_v, along * sin_v + sin * cos_v, cos * place.sin_y].map(T::narrow)
}

#[cfg(test)]
mod tests;
