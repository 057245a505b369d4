//! The slope beyond which a given mass lies: the inverse of U of [`marginal`](super::marginal).
//!
//! Gaussian slopes of the same mass, g = erfc⁻¹(2U), carry the orders of magnitude: ln(1 + y²) is g²
//! times a smooth function of g², within a factor of 2 or so, which is interpolated once per
//! material.

use super::marginal::Marginal;
use crate::Real;
use crate::elementary::chebyshev::Interpolant;
use crate::elementary::{erfc, erfc_inv_inside_wide, exp_m1};
use crate::real::construction::ln;

/// The most coefficients, of f64.
const MOST: usize = 48;

/// The coefficients of the scalar, and the largest g: erfc⁻¹ of ε/8 and a little more.
const fn resolution<T: Real>() -> (usize, f64) {
    if T::WIDENS { (20, 3.95) } else { (MOST, 6.0) }
}

/// The quantiles of one p.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Quantile<T> {
    ratio: Interpolant<T, MOST>,
}

impl<T: Real> Quantile<T> {
    pub(super) fn new(marginal: &Marginal<f64>) -> Self {
        let (count, largest) = resolution::<T>();
        let [ratio] = Interpolant::of_parts(count, |x| {
            let g2 = largest * largest * 0.5 * (x + 1.0);
            let g = Real::sqrt(g2);
            [log_of_square(marginal, g) / g2]
        });
        Self { ratio }
    }

    /// The y ≥ 0 with U(y) = q/2, for 0 ≤ q ≤ 1; less than ε/2 counts as ε/2.
    #[inline(always)]
    pub(super) fn at(&self, q: T::Wide) -> T::Wide {
        let (count, largest) = resolution::<T>();
        let g = erfc_inv_inside_wide::<T>(q.max((T::HALF * T::EPSILON).widen()));
        let g2 = (g * g).min(T::Wide::lit(largest * largest));
        let x = g2 * T::Wide::lit(2.0 / (largest * largest)) - T::Wide::ONE;
        let log = (g2 * self.ratio.at(count, x)).max(T::Wide::ZERO).min(T::Wide::lit(LONGEST));
        exp_m1(log).sqrt()
    }
}

/// ln(1 + y²) is at most this: beyond, normals are horizontal to every digit.
pub(super) const LONGEST: f64 = 80.0;

/// ln(1 + y²) of the y with U(y) = ½ erfc g, by Newton's method on the logarithm of U.
fn log_of_square(marginal: &Marginal<f64>, g: f64) -> f64 {
    let target = ln(0.5 * erfc(g));
    let excess = marginal.excess();
    // From above: U is at most ½ W^{p−½}, and the logarithm of U is concave in what is solved for.
    let mut log = -(target + core::f64::consts::LN_2) / (excess + 0.5);
    for _ in 0..60 {
        let y = Real::sqrt(exp_m1(log));
        let [mass, _, exponent] = marginal.beyond(y, true);
        let slope = 0.5 * marginal.constant / (y * mass);
        let step = (ln(mass) - exponent - target) / slope;
        let next = if log + step > 0.0 { log + step } else { 0.25 * log };
        // The rounding of the logarithm of U, over its slope.
        let done = (next - log).abs() <= 4.0 * f64::EPSILON * log;
        log = next;
        if done {
            break;
        }
    }
    log
}
