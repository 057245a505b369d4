//! p-values, and Pearson's test of counts.
//!
//! # Example
//! ```
//! use microsurface::verify::statistics::{Counted, pearson};
//! let cells = [(103.0, 100.0), (198.0, 200.0), (299.0, 300.0)];
//! let outcome = pearson(&cells.map(|(observed, expected)| Counted { observed, expected }));
//! assert_eq!(outcome.freedom, 2);
//! assert!((outcome.p_value - 0.945).abs() < 1e-3);
//! ```

use alloc::vec::Vec;
use core::f64::consts::PI;

use statrs::function::gamma::{gamma_lr, gamma_ur};

use crate::elementary::erfc;

/// A count as a real number.
#[expect(clippy::cast_precision_loss, reason = "counts are far below 2⁵³")]
pub(super) fn count(n: usize) -> f64 {
    n as f64
}

/// The probability that χ² of `dof` degrees of freedom is above `x`.
#[must_use]
pub fn chi_square(dof: usize, x: f64) -> f64 {
    if x <= 0.0 { 1.0 } else { gamma_ur(0.5 * count(dof), 0.5 * x) }
}

/// The probability that a normal number is farther from its mean than `deviation` standard
/// deviations.
#[must_use]
pub fn two_sided(deviation: f64) -> f64 {
    if deviation.is_nan() { 0.0 } else { erfc(deviation.abs() * core::f64::consts::FRAC_1_SQRT_2) }
}

/// The p-value of Kolmogorov and Smirnov for a largest distance of two distribution functions, of
/// `n` samples; with the correction of Stephens 1970.
#[must_use]
pub fn kolmogorov(n: f64, distance: f64) -> f64 {
    let lambda = (n.sqrt() + 0.12 + 0.11 / n.sqrt()) * distance;
    if lambda < 0.2 {
        return 1.0;
    }
    if lambda < 1.18 {
        // The same theta function in its dual form.
        let terms = (1..=5).map(|k| {
            let odd = f64::from(2 * k - 1);
            (-(odd * odd) * PI * PI / (8.0 * lambda * lambda)).exp()
        });
        return 1.0 - (2.0 * PI).sqrt() / lambda * terms.sum::<f64>();
    }
    let terms = (1..=5).map(|k| {
        let sign = if k % 2 == 1 { 2.0 } else { -2.0 };
        sign * (-2.0 * f64::from(k * k) * lambda * lambda).exp()
    });
    terms.sum()
}

/// A cell of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Counted {
    /// How many were seen.
    pub observed: f64,
    /// How many were expected.
    pub expected: f64,
}

/// The outcome of Pearson's test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pearson {
    /// χ².
    pub statistic: f64,
    /// The degrees of freedom.
    pub freedom: usize,
    /// The probability of as large a χ².
    pub p_value: f64,
}

impl Counted {
    /// The part of χ² that is this cell's.
    #[must_use]
    pub fn contribution(&self) -> f64 {
        let difference = self.observed - self.expected;
        difference * difference / self.expected
    }
}

/// The smallest expectation for which counts are close enough to normal (Cochran 1954).
const SMALLEST_EXPECTATION: f64 = 5.0;

/// The probability below which what is left of the small cells rejects.
const IMPOSSIBLE: f64 = 1e-9;

/// Pearson's χ² of cells whose counts sum to what was expected in all.
///
/// Cells of little expectation are put together; the rest that is still too little is judged by
/// Poisson's distribution.
#[must_use]
pub fn pearson(cells: &[Counted]) -> Pearson {
    let mut sorted: Vec<Counted> = cells.to_vec();
    sorted.sort_by(|a, b| a.expected.total_cmp(&b.expected));
    let none = Counted { observed: 0.0, expected: 0.0 };
    let (mut pool, mut statistic, mut used) = (none, 0.0, 0);
    for cell in sorted {
        if cell.expected >= SMALLEST_EXPECTATION {
            statistic += cell.contribution();
            used += 1;
            continue;
        }
        pool.observed += cell.observed;
        pool.expected += cell.expected;
        if pool.expected >= SMALLEST_EXPECTATION {
            statistic += pool.contribution();
            used += 1;
            pool = none;
        }
    }
    let rest = poisson(pool);
    let dof = if used > 1 { used - 1 } else { 1 };
    let p = if statistic.is_finite() { chi_square(dof, statistic) } else { 0.0 };
    // The rest counts only where it could not be: p stays uniform.
    let p_value = if rest < IMPOSSIBLE { p.min(rest) } else { p };
    Pearson { statistic, freedom: dof, p_value }
}

/// The probability of at least as many as were observed.
fn poisson(Counted { observed, expected }: Counted) -> f64 {
    if observed <= 0.0 {
        1.0
    } else if expected <= 0.0 {
        0.0
    } else {
        gamma_lr(observed, expected)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn p_values_of_tables() {
        // Abramowitz and Stegun, table 26.7, and the closed form of two degrees of freedom.
        assert!((chi_square(1, 3.841_458_820_694_124) / 0.05 - 1.0).abs() < 1e-9);
        assert!((chi_square(10, 23.209_251_158_954_356) / 0.01 - 1.0).abs() < 1e-9);
        assert!((chi_square(2, 60.0) / (-30_f64).exp() - 1.0).abs() < 1e-9);
        assert!((two_sided(1.959_963_984_540_054) / 0.05 - 1.0).abs() < 1e-9);
        // Smirnov 1948, n → ∞.
        assert!((kolmogorov(1e14, 1.358_098_634e-7) - 0.05).abs() < 1e-5);
        assert!((kolmogorov(1e14, 0.828e-7) - 0.4998).abs() < 1e-3);
    }

    #[test]
    fn small_cells_are_put_together() {
        let cell = |observed, expected| Counted { observed, expected };
        let outcome = pearson(&[cell(3.0, 2.5), cell(2.0, 2.5), cell(90.0, 95.0)]);
        assert!(outcome.freedom == 1 && (outcome.statistic - 25.0 / 95.0).abs() < 1e-12);
        assert!((pearson(&[cell(1.0, 0.7), cell(90.0, 90.0)]).p_value - 1.0).abs() < 0.01);
        // Where nothing may be, nothing was seen.
        assert!(pearson(&[cell(1.0, 0.0)]).p_value < 1e-300);
        assert!(pearson(&[cell(100.0, 100.0), cell(40.0, 1e-9)]).p_value < 1e-100);
    }
}
