//! Visible normals of Student-t slopes, from two random numbers and without rejection.
//!
//! Let y be the slope along the view, measured towards the viewer, and ν = cot θ. Normals seen from
//! above have the density (ν + y) f(y) on y ≥ −ν. Its odd part cancels within [−ν, ν]: f(y) (ν + y)
//! and f(−y) (ν − y) add up to 2ν f. So there are three positive parts,
//!
//! 1. |y| ≤ ν: |y| is distributed as f, and y is above 0 with probability (ν + |y|)/(2ν), of mass
//!    ν (1 − 2U(ν));
//! 2. ν f beyond ν, of mass ν U(ν);
//! 3. y f beyond ν, whose integral is a power, of mass B(ν) + ν U(ν);
//!
//! of which the first two are quantiles of f and the third is closed. The slope across the view is
//! √(1 + y²) τ, and τ has the density of exponent γ instead of γ − ½: another quantile.
//!
//! From below the density is (y − ν) f beyond ν = |cot θ|, and B(y) + (y − ν) U(y) = (1 − u) B(ν) is
//! solved by Newton's method on its logarithm, which is concave in ln(1 + y²).

use super::marginal::Marginal;
use super::quantile::{LONGEST, Quantile};
use crate::Real;
use crate::elementary::{exp_m1, ln, ln_1p};
use crate::real::select;
use crate::vector::inside;

/// The quantiles that visible normals are drawn by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Visible<T> {
    along: Quantile<T>,
    across: Quantile<T>,
}

impl<T: Real> Visible<T> {
    /// For the exponents p = γ − ½ along and γ across.
    pub(super) fn new(gamma_less_3_2: f64) -> Self {
        let [along, across] =
            [gamma_less_3_2, gamma_less_3_2 + 0.5].map(|excess| Quantile::new(&Marginal::new(excess)));
        Self { along, across }
    }

    /// Slopes of unit width (y, τ), y towards the viewer, seen at the height ν, which may be
    /// negative.
    pub(super) fn slopes(&self, marginal: &Marginal<T>, nu: T::Wide, [u1, u2]: [T; 2]) -> [T::Wide; 2] {
        let one = T::Wide::ONE;
        let [u1, mut u2] = [u1, u2].map(|u| inside(u).widen());
        let along = if nu < T::Wide::ZERO {
            seen_from_below(marginal, -nu, u1)
        } else {
            let [mass, area, _] = marginal.beyond(nu, false);
            let inner = nu * (one - T::Wide::TWO * mass);
            let (middle, total) = (inner + nu * mass, nu + area);
            let target = u1 * total;
            if target < inner {
                let y = self.along.at(one - target / nu).min(nu);
                let share = T::Wide::HALF * (nu + y) / nu;
                if u2 < share {
                    u2 /= share;
                    y
                } else {
                    u2 = (u2 - share) / (one - share);
                    -y
                }
            } else if target < middle {
                self.along.at(T::Wide::TWO * (middle - target) / nu).max(nu)
            } else {
                // The power of (1 + y²)/(1 + ν²) falls from 1 to 0.
                let left = ((total - target) / (total - middle)).min(one);
                rise(nu, -ln(left) / marginal.excess().widen())
            }
        };
        let beyond = T::Wide::TWO * select(u2 < T::Wide::HALF, u2, one - u2);
        let across = self.across.at(beyond);
        [along, select(u2 < T::Wide::HALF, -across, across)]
    }
}

/// The slope seen from below, at the height −ν.
fn seen_from_below<T: Real>(marginal: &Marginal<T>, nu: T::Wide, u: T::Wide) -> T::Wide {
    let [_, area, _] = marginal.beyond(nu, true);
    let [excess, constant] = [marginal.excess(), marginal.constant].map(Real::widen);
    let (half, scale) = (T::Wide::HALF, T::Wide::ONE + nu * nu);
    let target = ln_1p(-u);
    // At first the logarithm falls as a square, with this second derivative, and at last along
    // a line: what both need together is above the solution.
    let bend = constant * scale / (T::Wide::lit(4.0) * (nu * nu) * area);
    let mut v = -target / excess + (-T::Wide::TWO * target / bend).sqrt();
    let first = ln(area);
    for _ in 0..64 {
        let y = rise(nu, v);
        let gap = scale * exp_m1(v.min(T::Wide::lit(LONGEST))) / (y + nu);
        let [mass, area, _] = marginal.beyond(y, true);
        let beyond = area + gap * mass;
        let value = ln(beyond) - excess * v - first - target;
        // The derivative is −(y − ν) f dy/dv over what is beyond.
        let next = v + value * (T::Wide::TWO * y * beyond) / (constant * gap);
        let next = select(next > T::Wide::ZERO, next, half * v);
        let done = (next - v).abs() <= T::EPSILON.widen() * v;
        v = next;
        if done {
            break;
        }
    }
    rise(nu, v)
}

/// The y with 1 + y² = (1 + ν²) eᵛ.
#[inline(always)]
fn rise<W: Real>(nu: W, v: W) -> W {
    let nu2 = nu * nu;
    (nu2 + (W::ONE + nu2) * exp_m1(v.min(W::lit(LONGEST)))).sqrt()
}
