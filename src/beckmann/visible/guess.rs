//! The guess of ξ. Its coefficients come from tests/reference/beckmann_visible_guess.py.

use crate::elementary::ln_normal;
use crate::elementary::polynomial::polynomial;
use crate::real::{Real, select};

/// B of the guess for ν < 0: its coefficient of √a by powers of √(√π·ierfcx n). Error of w ≤
/// 0.031/(1 + n).
const BELOW: [f64; 3] = [0.212842, 0.41683, 0.770999];
/// γ − 1 of the guess for ν ≥ 0: s·(c₀ + c₁s + c₂s²)/(1 + (c₃ + c₄s)·√a). Error of x ≤ 0.0035 where
/// x ≤ 0.
const GAMMA: [f64; 5] = [1.636621, 0.009239, -0.815615, 1.682954, -0.887447];
/// The excess of the guess for x > 0: xw²/(c₀ + c₁w³ + c₂xw²). Error of x ≤ 0.027, growing as
/// (1 − u)^−0.12 below 1 − u = 0.01.
const EXCESS: [f64; 3] = [2.563261, 2.713977, 3.47698];

/// ln(1 + f)/f for √½ ≤ 1 + f < √2, to 5.1e-5 relative.
const LN: [f64; 5] = [0.999966139, -0.499451076, 0.336391782, -0.270938792, 0.176551638];

/// Limits of the guess: a view is no higher, and e^(−ν²) no less than [`LEAST`], so no number of it
/// is subnormal in f32, and where ν is limited the farthest w is more.
pub(super) const HIGHEST: f64 = 1e9;
/// See [`HIGHEST`].
pub(super) const LEAST: f64 = 1e-30;
/// The guess keeps this part of the way to ν, where its own error could pass it.
const MARGIN: f64 = 0.00390625; // 2⁻⁸

/// The guess treats 1 − u as no smaller: the rounding of F must stay small beside 1 − F at the
/// guess.
#[inline(always)]
fn last<G: Real>() -> G {
    G::lit(if G::WIDENS { 5.960464477539063e-8 } else { 8.881784197001252e-16 }) // 2⁻²⁴, 2⁻⁵⁰
}

/// ln x of a normal x > 0, without a division. Relative error of ln m ≤ 5.1e-5, m the fraction of
/// x.
#[inline(always)]
fn rough_ln<G: Real>(x: G) -> G {
    let (m, k) = x.split_exponent();
    let f = m - G::ONE;
    k * G::lit(core::f64::consts::LN_2) + f * polynomial(f, &LN)
}

/// Parameters of the guess that depend on the view direction, in a scalar that may have fewer
/// digits.
pub(super) struct Outset<G> {
    /// ν < 0; known to the compiler to be false where views from below are excluded.
    pub(super) below: bool,
    /// max(−ν, 0).
    pub(super) n: G,
    /// max(ν, 1), at most [`HIGHEST`].
    pub(super) unit: G,
    /// Its inverse.
    pub(super) b: G,
    /// b·max(ν, 0).
    pub(super) bv: G,
    /// e^(−ν²), or 1 for ν < 0, at least [`LEAST`].
    pub(super) e: G,
    /// √π·ierfcx |ν|, for ν < 0.
    pub(super) k: G,
    /// erfc ν for ν ≥ 0.
    pub(super) erfc: G,
    /// F(ν)·b.
    pub(super) total: G,
}

impl<G: Real> Outset<G> {
    /// F(0), or F(ν) below.
    #[inline(always)]
    fn at_zero(&self) -> G {
        let at_zero = G::HALF * (self.bv + G::FRAC_1_SQRT_PI * self.b);
        select(self.below, self.total, at_zero)
    }

    /// The guess of erfc x − erfc ν where x > 0, and that of a; in f64 to its digits, which makes
    /// the guess exact for ν = 0.
    #[inline(always)]
    pub(super) fn mass(&self, u: G) -> (G, G) {
        let l = G::lit;
        let (mass, at_zero) = (u * self.total, self.at_zero());
        let beyond = mass > at_zero;

        // x > 0: erfc x = erfc ν + (1 − erfc ν)·e
        let span = G::ONE - self.erfc;
        let rest = self.total - at_zero;
        let tail = (G::ONE - u).max(last::<G>()) * self.total;
        let end = l(8.0) * G::FRAC_1_SQRT_PI * self.e * self.unit;
        let m =
            select(beyond, tail * (span * span - end * rest), mass) / select(beyond, span * rest, at_zero);
        let gap = G::HALF * (m + (m * m + l(4.0) * end * tail).sqrt());
        // F(0) is F(ν) below; not 0, also where the fraction was rounded to 1
        let fraction = select(beyond, self.erfc + gap, m);
        (
            gap,
            -(if G::WIDENS { rough_ln(fraction) } else { ln_normal(fraction) }).min(l(-0.0625) * G::EPSILON),
        )
    }

    /// |x|, or ξ where ν < 0, of a.
    #[inline(always)]
    pub(super) fn distance(&self, u: G, a: G) -> G {
        let l = G::lit;
        let (below, beyond) = (self.below, u * self.total > self.at_zero());
        let root = a.sqrt();

        // X = √(c² + r) − c with centre c and rise r over a common divisor, the centre of which is
        // s·γ/√π
        let s = select(beyond, G::ONE, G::SQRT_PI * self.bv);
        let t = select(beyond, G::ONE, self.b + G::SQRT_PI * self.bv);
        let divisor = t * t * (t + root * (l(GAMMA[3]) * t + l(GAMMA[4]) * s));
        let gamma = divisor + s * (t * (l(GAMMA[0]) * t + l(GAMMA[1]) * s) + l(GAMMA[2]) * (s * s));
        let k = self.k.sqrt();
        let divisor_below = G::ONE + root * polynomial(k, &BELOW);
        let divisor = select(below, divisor_below, t * divisor);
        let centre = select(below, self.n * divisor_below, G::FRAC_1_SQRT_PI * s * gamma);
        let rise = select(below, a * divisor_below + root * (G::TWO * self.n * k), gamma * a * t);
        rise / (centre + (centre * centre + rise * divisor).sqrt())
    }

    /// ξ, where x > 0 without the excess; b³ scales that.
    #[inline(always)]
    pub(super) fn without_excess(&self, u: G, gap: G, x: G) -> G {
        let l = G::lit;
        let (below, beyond) = (self.below, u * self.total > self.at_zero());
        let y = (x * self.b).min(self.bv);
        let w = self.bv - y;
        let ww = w * w;
        let divisor = l(EXCESS[0]) * self.b * self.b * self.b + (l(EXCESS[1]) * w + l(EXCESS[2]) * y) * ww;
        let inverse = G::ONE / (divisor * self.e);
        let excess = y * ww * (self.e * inverse);
        // w is not above, and near 0 equals, the gap over the slope of erfc at ν
        let nu = self.unit * self.bv;
        let farthest = G::HALF * G::SQRT_PI * gap * (divisor * inverse);
        let nearest = (G::HALF * farthest).min(l(MARGIN) * nu);
        let x_beyond = (x.min(nu) - excess).max(nu - farthest).min(nu - nearest);
        select(!below && beyond, -x_beyond, x)
    }

    /// The guess of ξ.
    #[inline(always)]
    pub(super) fn guess(&self, u: G) -> G {
        let (gap, a) = self.mass(u);
        self.without_excess(u, gap, self.distance(u, a))
    }
}
