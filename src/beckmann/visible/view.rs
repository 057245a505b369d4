//! What depends on the view direction alone, the distribution F, and the steps towards its inverse.

use super::fit::Fit;
use super::guess::{HIGHEST, LEAST, Outset};
use crate::elementary::exp_normal;
use crate::elementary::polynomial::polynomial;
use crate::real::{Real, converted, select};

/// Farther below the horizon than this, slope and view direction agree to rounding: the slope is
/// the horizon's.
#[inline(always)]
fn deepest<W: Real>() -> W {
    W::lit(if W::WIDENS { 1048576.0 } else { 8589934592.0 }) // 2²⁰, 2³³
}

/// Beyond this e^(−ν²) adds nothing to F and to the guess, where it is as at this ν: what it
/// multiplies stays a normal number.
#[inline(always)]
fn steep<W: Real>() -> W {
    W::lit(if W::WIDENS { 6.0 } else { 12.0 })
}

/// The step shrinks v by no smaller a factor, nor below an eighth of its value at this u.
#[inline(always)]
fn closer<W: Real>() -> W {
    W::lit(if W::WIDENS { 9.5367431640625e-7 } else { 9.094947017729282e-13 }) // 2⁻²⁰, 2⁻⁴⁰
}

/// Parameters of the steps that depend on the view direction; the names are those of the module's
/// text.
pub(super) struct View<W> {
    /// max(−ν, 0).
    pub(super) n: W,
    /// max(ν, 1), finite.
    pub(super) unit: W,
    /// 1/max(ν, 1).
    pub(super) b: W,
    /// b·max(ν, 0).
    pub(super) bv: W,
    /// F(ν)·b, by e^(−ν²) larger for ν < 0. So are all F.
    pub(super) total: W,
}

impl<W: Real> View<W> {
    #[inline(always)]
    pub(super) fn new<G: Real>(nu: W, fit: Fit) -> (Self, Outset<G>) {
        Self::of_parts(nu.max(W::ZERO), (-nu).max(W::ZERO).min(deepest()), fit)
    }

    /// The view and the outset of ν ≥ 0.
    #[inline(always)]
    pub(super) fn from_above<G: Real>(nu: W, fit: Fit) -> (Self, Outset<G>) {
        Self::of_parts(nu.max(W::ZERO), W::ZERO, fit)
    }

    /// The view of ν ≥ 0, from what [`from_above`](Self::from_above) made of it.
    #[inline(always)]
    pub(super) fn again(nu: W, b: W, total: W) -> Self {
        let (unit, bv) = (nu.max(W::ONE).min(W::MAX), nu.max(W::ZERO).min(W::ONE));
        Self { n: W::ZERO, unit, b, bv, total }
    }

    /// The view and the outset of max(ν, 0) and max(−ν, 0).
    #[inline(always)]
    fn of_parts<G: Real>(above: W, n: W, fit: Fit) -> (Self, Outset<G>) {
        let unit = above.max(W::ONE).min(W::MAX);
        let bv = above.min(W::ONE);
        let far = above.min(steep());
        let t = far.max(n);
        let (p, q) = (polynomial(t, fit.0), polynomial(t, fit.1));
        let divisor = t * q + p;
        // where it overflows, b and e^(−ν²) are nothing beside 1
        let both = W::ONE / (unit * divisor);
        let (b, inverse) = (divisor * both, unit * both);
        let e = exp_normal(-(far * far));
        let k = p * inverse;
        let erfc = e * q * inverse * W::FRAC_1_SQRT_PI;
        let total = bv + W::HALF * W::FRAC_1_SQRT_PI * b * e * k;
        let least = W::lit(LEAST);
        let outset = Outset {
            below: n > W::ZERO,
            n: converted(n),
            unit: converted(unit.min(W::lit(HIGHEST))),
            b: converted(b.max(W::lit(1.0 / HIGHEST))),
            bv: converted(bv),
            e: converted(e.max(least)),
            k: converted(k),
            erfc: converted(erfc.max(least)),
            total: converted(total),
        };
        (Self { n, unit, b, bv, total }, outset)
    }

    /// (ξ, f) of a ξ.
    #[inline(always)]
    pub(super) fn at<G: Real>(&self, xi: G) -> (W, W) {
        let xi = converted(xi);
        (xi, self.bv + self.b * xi)
    }

    /// F and its derivative at ξ, the latter by b larger: f·e^(−x²)/√π.
    #[inline(always)]
    pub(super) fn distribution(&self, (xi, f): (W, W), fit: Fit) -> (W, W) {
        let minus_x = xi + self.n;
        let t = minus_x.abs();
        let (p, q) = (polynomial(t, fit.0), polynomial(t, fit.1));
        let e = W::FRAC_1_SQRT_PI * exp_normal(-(xi * (xi + self.n + self.n)));
        let left = minus_x > W::ZERO;
        let fq = f * q;
        // the exponential, which takes longer, joins last
        let part = W::HALF * e * ((self.b * p + select(left, fq, -fq)) / (t * q + p));
        (select(left, W::ZERO, self.bv) + part, f * e)
    }

    /// A better (ξ, f) by the distribution there: the Taylor series of v to δ⁴.
    #[inline(always)]
    pub(super) fn step(&self, (xi, f): (W, W), u: W, (sum, density): (W, W)) -> (W, W) {
        let l = W::lit;
        let mass = u * self.total;
        let (plus, square) = (sum + mass, density * f);
        let both = W::ONE / (plus * square);
        let y = (sum - mass) * square * both;
        let z = y * y;
        let inverse = plus * both;
        let tau = sum * f * inverse;
        let inverse_f = density * inverse;
        let rho = tau * self.b * inverse_f;
        // q − 1; then q′, q″
        let r = -W::TWO * (xi + self.n) * tau;
        let q = W::ONE + r;
        let delta = W::TWO * y * (W::ONE + z * (l(1.0 / 3.0) + z * (l(0.2) + z * l(1.0 / 7.0))));
        let qr = q + rho;
        let q1 = -W::TWO * tau * tau - r * qr;
        let q2 = l(4.0) * tau * tau * qr - q1 * qr - r * (q1 - rho * (q + W::TWO * rho));
        let third = (q * q - q1) * l(1.0 / 6.0);
        let fourth = (q * (l(3.0) * q1 - q * q) - q2) * l(1.0 / 24.0);
        let series = W::ONE - delta * (W::HALF * q - delta * (third + delta * fourth));
        // v grows by the factor 1 + change; where that is limited, so is the step
        let step = W::TWO * tau * delta * series;
        let change = self.b * step * inverse_f;
        let lowest = (l(0.25) * rho * (W::ONE - u)).max(closer::<W>()) - W::ONE;
        let step = select(change < lowest, lowest * f * self.unit, step);
        let root = (W::ONE + change.max(lowest)).sqrt();
        (xi + step / (W::ONE + root), f * root)
    }
}
