//! The slope at which a visible Beckmann micronormal is found: the exact inverse of its distribution.
//!
//! # The equation
//!
//! For the unit profile seen along w = (s, 0, z), ν = z/s = cot θ, the slope x of the visible normals towards the
//! viewer has the density (ν − x)·e^(−x²) on x ≤ ν, up to a factor (Heitz and d'Eon 2014). Given u we need the x with
//! F(x) = u·F(ν), where
//!
//! F(x) = ∫₋∞ˣ (ν − t)·e^(−t²)/√π dt = ½[ν·erfc(−x) + e^(−x²)/√π],
//!
//! which has no closed inverse. Earlier inversions were tabulated (Heitz and d'Eon) or iterated to a tolerance
//! (Jakob 2014). Here one guess and one step (two for f64) of high order reach rounding, without branches.
//!
//! # F without cancellation
//!
//! Below the horizon (ν < 0) the two terms nearly cancel. Write ierfc t = e^(−t²)/√π − t·erfc t and
//! h(t) = ierfc t/erfc t, a function that falls slowly from 1/√π at 0 to 1/(2t). One rational fit h = P/Q with
//! positive coefficients gives both functions,
//!
//! erfc t = e^(−t²)/√π · Q/(tQ + P),  ierfc t = e^(−t²)/√π · P/(tQ + P),
//!
//! and with the distance to the end w = ν − x ≥ 0 and t = |x| every F is
//!
//! - x ≤ 0: F = e^(−t²)/(2√π) · (P + wQ)/(tQ + P), a sum of positive terms,
//! - x > 0: F = ν + e^(−t²)/(2√π) · (P − wQ)/(tQ + P), where ν ≤ 2F is the larger term.
//!
//! Two rescalings keep all numbers finite. For ν < 0 everything is divided by e^(−ν²): the exponent becomes
//! −ξ(ξ + 2n) with n = −ν and ξ = w. For ν ≥ 0, n = 0 and ξ = −x. Above ν = 1 everything is divided by ν, that is
//! multiplied by b = 1/max(ν, 1): bν and f = bw = bν + bξ stay finite up to normal incidence, ν = ∞, where b = 0.
//!
//! # The step
//!
//! The density vanishes at x = ν, so x has a square root singularity at u = 1, and F decays like e^(−x²) at the other
//! end. As a relation between v = w² and G = −ln(F(x)/F(ν)) both are gone: dv/dG = 2√π·e^(x²)·F is smooth and
//! positive, and for ν = 0 simply v = G. With the derivatives by G, where H = F′/F,
//!
//! τ = 1/H, ρ = τ/w, q = 1 + 2xτ:  x′ = −τ, τ′ = −τ(q + ρ), ρ′ = −ρ(q + 2ρ), v′ = 2wτ, v″ = −q·v′,
//!
//! all algebraic, the Taylor series of v to δ⁴ costs one erfc and one e^(−x²). Its δ = ln(F/(u·F(ν))) is
//! 2 artanh y of y = (F − uF(ν))/(F + uF(ν)). It is exact, whatever the guess, for ν = 0.
//!
//! # The guess
//!
//! Three formulas meet exactly: where u is above F(0)/F(ν) (then x > 0), below it, and for ν < 0.
//! - ν ≥ 0, x ≤ 0, X = −x: a = −ln(F(x)/F(0)) = hX + X²/γ with h = F′(0)/F(0) and a γ that drifts from
//!   1/(1 − s + 2s²/π), s = ½ν/F(0), towards 1. So X = √((hγ/2)² + γa) − hγ/2.
//! - x > 0: where ν is large, erfc x is the fraction β of the mass beyond 0 that is still to come, and a = −ln erfc x gives x
//!   by the same formula with s = 1. Where ν is small, e = (erfc x − erfc ν)/(1 − erfc ν) is √β. Between, e is the root of
//!   e² = β(η + (1 − η)e), with η such that e is right to first order at x = ν. What remains, at most 0.2, is removed
//!   by a rational function of x and w.
//! - ν < 0: a = G = w² + 2nw − ln A, where ln A = √a·B grows from 0 and B = 2n·√(√π·ierfcx n)/(1 + …√a), whence w.
//!
//! # References
//!
//! - E. Heitz and E. d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals",
//!   2014, doi 10.1111/cgfm.12417.
//! - W. Jakob, "An Improved Visible Normal Sampling Routine for the Beckmann Distribution", 2014.

use crate::elementary::kernel::polynomial;
use crate::elementary::{exp, ln};
use crate::real::Real;

/// Numerator and denominator of h(t) = ierfc t/erfc t, t ≥ 0, constant term first.
type Fit = (&'static [f64], &'static [f64]);
// These, and the coefficients of the guess, come from tests/reference/beckmann_visible_guess.py.

/// Relative error of h ≤ 6.4e-11.
const SINGLE: Fit = (
    &[
        0.5641895835833777,
        0.7995329836722413,
        0.5700196506095361,
        0.25171664041192116,
        0.07195483157377616,
        0.01271080032572084,
        0.0011229164746703261,
    ],
    &[
        1.0,
        2.061210007289916,
        2.06466701609396,
        1.2805614813690156,
        0.5288555711526084,
        0.146155483512899,
        0.025421600729155606,
        0.0022458329493406522,
    ],
);
/// Relative error of h ≤ 3.0e-17.
const DOUBLE: Fit = (
    &[
        0.5641895835477563,
        1.1493360677779079,
        1.1818611655927913,
        0.7918524654995586,
        0.37884060208756626,
        0.13449797773488384,
        0.0358173200730591,
        0.007073097087655919,
        0.0009957624409813427,
        9.106769527442819e-05,
        4.182267866985617e-06,
    ],
    &[
        1.0,
        2.681219823127567,
        3.548460639261151,
        3.024188911392881,
        1.8324379074568926,
        0.8263724664322416,
        0.282868946692472,
        0.07361361822180802,
        0.01432832956589263,
        0.001999889417696465,
        0.00018213539054885678,
        8.364535733971233e-06,
    ],
);

/// B of the guess for ν < 0: its coefficient of √a by powers of √(√π·ierfcx n). Error of w ≤ 0.031/(1 + n).
const BELOW: [f64; 3] = [0.212842, 0.41683, 0.770999];
/// γ − 1 of the guess for ν ≥ 0: s·(c₀ + c₁s + c₂s²)/(1 + (c₃ + c₄s)·√a). Error of x ≤ 0.0035 where x ≤ 0.
const GAMMA: [f64; 5] = [1.636621, 0.009239, -0.815615, 1.682954, -0.887447];
/// The excess of the guess for x > 0: xw²/(c₀ + c₁w³ + c₂xw²). Error of x ≤ 0.027, growing as
/// (1 − u)^−0.12 below 1 − u = 0.01.
const EXCESS: [f64; 3] = [2.563261, 2.713977, 3.47698];

/// Farther below the horizon than this, slope and view direction agree to rounding: the slope is the horizon's.
const DEEPEST: f64 = 8589934592.0; // 2³³
/// The guess treats 1 − u as no smaller: the rounding of F, about 2⁻⁵², must stay small beside 1 − F at the guess.
const LAST: f64 = 8.881784197001252e-16; // 2⁻⁵⁰
/// The step shrinks v by no smaller a factor, nor below an eighth of its value at this u.
const CLOSER: f64 = 9.094947017729282e-13; // 2⁻⁴⁰
/// The guess keeps this part of the way to ν, where its own error could pass it.
const MARGIN: f64 = 0.00390625; // 2⁻⁸

/// `a` if `condition`, else `b`; both are at hand.
#[inline(always)]
fn select<W>(condition: bool, a: W, b: W) -> W {
    if condition { a } else { b }
}

/// What depends on the view direction alone; the names are those of the module's text.
struct View<W> {
    /// max(−ν, 0).
    n: W,
    /// max(ν, 1), finite.
    unit: W,
    /// 1/max(ν, 1).
    b: W,
    /// b·max(ν, 0).
    bv: W,
    /// e^(−ν²), or 1 for ν < 0.
    e: W,
    /// √π·ierfcx |ν|.
    k: W,
    /// erfc ν for ν ≥ 0.
    erfc: W,
    /// F(ν)·b, by e^(−ν²) larger for ν < 0. So are all F.
    total: W,
}

impl<W: Real> View<W> {
    #[inline(always)]
    fn new(nu: W, fit: Fit) -> Self {
        let (above, n) = (nu.max(W::ZERO), (-nu).max(W::ZERO).min(W::lit(DEEPEST)));
        let unit = nu.max(W::ONE).min(W::MAX);
        let b = W::ONE / nu.max(W::ONE);
        let bv = above.min(W::ONE);
        let t = above.max(n).min(W::lit(DEEPEST));
        let (p, q) = (polynomial(t, fit.0), polynomial(t, fit.1));
        let inverse = W::ONE / (t * q + p);
        let e = exp(-(above * above));
        let k = p * inverse;
        let erfc = e * q * inverse * W::FRAC_1_SQRT_PI;
        let total = bv + W::HALF * W::FRAC_1_SQRT_PI * b * e * k;
        Self { n, unit, b, bv, e, k, erfc, total }
    }

    /// The guess of ξ.
    #[inline(always)]
    fn guess(&self, u: W) -> W {
        let l = W::lit;
        let below = self.n > W::ZERO;
        let mass = u * self.total;
        let at_zero = W::HALF * (self.bv + W::FRAC_1_SQRT_PI * self.b);
        let at_zero = select(below, self.total, at_zero);
        let beyond = mass > at_zero;

        // x > 0: erfc x = erfc ν + (1 − erfc ν)·e
        let span = W::ONE - self.erfc;
        let rest = self.total - at_zero;
        let tail = (W::ONE - u).max(l(LAST)) * self.total;
        let end = l(8.0) * W::FRAC_1_SQRT_PI * self.e * self.unit;
        let m = tail * (span * span - end * rest) / (span * rest);
        let gap = W::HALF * (m + (m * m + l(4.0) * end * tail).sqrt());
        let erfc = self.erfc + gap;

        let inverse = W::ONE / at_zero;
        let fraction = select(beyond, erfc, select(below, u, mass * inverse));
        // not 0, also where the fraction was rounded to 1
        let a = (-ln(fraction)).max(l(0.0625) * W::EPSILON);
        let root = a.sqrt();
        let s = select(beyond, W::ONE, W::HALF * self.bv * inverse);
        let k = self.k.sqrt();
        let numerator = select(below, W::TWO * self.n * k, s * polynomial(s, &GAMMA[..3]));
        let slope = select(below, polynomial(k, &BELOW), polynomial(s, &GAMMA[3..]));
        let ratio = numerator / (W::ONE + root * slope);
        let gamma = W::ONE + ratio;
        let centre = select(below, self.n, s * W::FRAC_1_SQRT_PI * gamma);
        let rise = select(below, a + root * ratio, gamma * a);
        let radius = (centre * centre + rise).sqrt();
        let x = radius - centre;

        // x > 0: the excess; b³ scales it
        let y = (x * self.b).min(self.bv);
        let w = self.bv - y;
        let ww = w * w;
        let excess = y * ww;
        let divisor = l(EXCESS[0]) * self.b * self.b * self.b + (l(EXCESS[1]) * w + l(EXCESS[2]) * y) * ww;
        let quotient = select(below, rise, excess) / select(below, centre + radius, divisor);
        // w is not above, and near 0 equals, the gap over the slope of erfc at ν
        let nu = self.unit * self.bv;
        let farthest = W::HALF * W::SQRT_PI * gap / self.e;
        let nearest = (W::HALF * farthest).min(l(MARGIN) * nu);
        let x_beyond = (x.min(nu) - quotient).max(nu - farthest).min(nu - nearest);
        select(below, quotient, select(beyond, -x_beyond, x))
    }

    /// F and its derivative at ξ, the latter by b larger: f·e^(−x²)/√π.
    #[inline(always)]
    fn distribution(&self, xi: W, f: W, fit: Fit) -> (W, W) {
        let minus_x = xi + self.n;
        let t = minus_x.abs();
        let (p, q) = (polynomial(t, fit.0), polynomial(t, fit.1));
        let e = W::FRAC_1_SQRT_PI * exp(-(xi * (xi + self.n + self.n)));
        let left = minus_x > W::ZERO;
        let fq = f * q;
        let part = W::HALF * e * (self.b * p + select(left, fq, -fq)) / (t * q + p);
        (select(left, W::ZERO, self.bv) + part, f * e)
    }

    /// A better (ξ, f): the Taylor series of v to δ⁴.
    #[inline(always)]
    fn step(&self, (xi, f): (W, W), u: W, fit: Fit) -> (W, W) {
        let l = W::lit;
        let (sum, density) = self.distribution(xi, f, fit);
        let mass = u * self.total;
        let y = (sum - mass) / (sum + mass);
        let z = y * y;
        let inverse = W::ONE / (density * f);
        let tau = sum * f * inverse;
        let inverse_f = density * inverse;
        let rho = tau * self.b * inverse_f;
        // q − 1; then q′, q″
        let r = -W::TWO * (xi + self.n) * tau;
        let q = W::ONE + r;
        // beyond this rounding, not the guess, made the difference
        let limit = W::ONE / (rho * l(0.125) + r.max(W::ZERO));
        let delta = W::TWO * y * (W::ONE + z * (l(1.0 / 3.0) + z * (l(0.2) + z * l(1.0 / 7.0))));
        let delta = delta.min(limit).max(-limit);
        let qr = q + rho;
        let q1 = -W::TWO * tau * tau - r * qr;
        let q2 = l(4.0) * tau * tau * qr - q1 * qr - r * (q1 - rho * (q + W::TWO * rho));
        let third = (q * q - q1) * l(1.0 / 6.0);
        let fourth = (q * (l(3.0) * q1 - q * q) - q2) * l(1.0 / 24.0);
        let series = W::ONE - delta * (W::HALF * q - delta * (third + delta * fourth));
        // v grows by the factor 1 + change; where that is limited, so is the step
        let step = W::TWO * tau * delta * series;
        let change = self.b * step * inverse_f;
        let lowest = (l(0.25) * rho * (W::ONE - u)).max(l(CLOSER)) - W::ONE;
        let step = select(change < lowest, lowest * f * self.unit, step);
        let root = (W::ONE + change.max(lowest)).sqrt();
        (xi + step / (W::ONE + root), f * root)
    }
}

/// The slope x towards the viewer with F(x) = u·F(ν), in the notation of the module.
///
/// # Domain
///
/// Any ν, also negative and +∞; u in [0, 1). Where u is below ε/4 of its scalar, the middle of the first cell of
/// random numbers, it is taken as ε/4, so that the slope stays finite.
///
/// # Returns
///
/// A finite x ≤ ν, x < ν unless they differ by less than rounding (ν below about −10³).
///
/// # Accuracy
///
/// See the tests: as a difference of u, f64 2e-15 and f32 3e-8, half the step of u below 1; monotone in u for every f32, and for
/// f64 at steps of 2⁻⁴⁴.
#[inline(always)]
pub(crate) fn visible_slope<T: Real>(nu: T::Wide, u: T) -> T::Wide {
    let view = View::new(nu, fit::<T>());
    let (xi, _) = solve(&view, u);
    (-(xi + view.n)).min(nu)
}

/// The fit of h for a scalar.
#[inline(always)]
fn fit<T: Real>() -> Fit {
    if T::WIDENS { SINGLE } else { DOUBLE }
}

/// (ξ, f) of u.
#[inline(always)]
fn solve<T: Real>(view: &View<T::Wide>, u: T) -> (T::Wide, T::Wide) {
    let u = u.max(T::lit(0.25) * T::EPSILON).min(T::ONE - T::HALF * T::EPSILON).widen();
    let xi = view.guess(u);
    let first = view.step((xi, view.bv + view.b * xi), u, fit::<T>());
    // f32 is content with one step
    if T::WIDENS { first } else { view.step(first, u, fit::<T>()) }
}

#[cfg(test)]
mod tests;
