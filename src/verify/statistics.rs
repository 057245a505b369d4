//! p-values.

use alloc::vec::Vec;
use core::f64::consts::PI;

use statrs::function::erf::erfc;
use statrs::function::gamma::{gamma_lr, gamma_ur};

/// A count as a real number.
#[expect(clippy::cast_precision_loss, reason = "counts are far below 2⁵³")]
pub(super) fn count(n: usize) -> f64 {
    n as f64
}

/// The probability that χ² of `dof` degrees of freedom is above `x`.
pub(super) fn chi_square(dof: usize, x: f64) -> f64 {
    if x <= 0.0 { 1.0 } else { gamma_ur(0.5 * count(dof), 0.5 * x) }
}

/// The probability that a normal number is farther from its mean than `deviation` standard
/// deviations.
pub(super) fn two_sided(deviation: f64) -> f64 {
    if deviation.is_nan() { 0.0 } else { erfc(deviation.abs() / 2_f64.sqrt()) }
}

/// The p-value of Kolmogorov and Smirnov for a largest distance of two distribution functions, of
/// `n` samples; with the correction of Stephens 1970.
pub(super) fn kolmogorov(n: f64, distance: f64) -> f64 {
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

/// A cell of the table: what was seen, and what was expected.
#[derive(Debug, Clone, Copy)]
pub(super) struct Counted {
    pub(super) observed: f64,
    pub(super) expected: f64,
}

impl Counted {
    pub(super) fn contribution(&self) -> f64 {
        let difference = self.observed - self.expected;
        difference * difference / self.expected
    }
}

/// The smallest expectation for which counts are close enough to normal (Cochran 1954).
const SMALLEST_EXPECTATION: f64 = 5.0;

/// Pearson's χ² of cells whose counts sum to what was expected in all: statistic, degrees of
/// freedom and p-value. Cells of little expectation are put together; what is then still too little
/// is judged by Poisson's distribution.
pub(super) fn pearson(cells: &[Counted]) -> (f64, usize, f64) {
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
    (statistic, dof, if rest < 1.0 { (2.0 * p.min(rest)).min(1.0) } else { p })
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
        let (statistic, dof, _) = pearson(&[cell(3.0, 2.5), cell(2.0, 2.5), cell(90.0, 95.0)]);
        assert!(dof == 1 && (statistic - 25.0 / 95.0).abs() < 1e-12);
        assert!((pearson(&[cell(1.0, 0.7), cell(90.0, 90.0)]).2 - 1.0).abs() < 0.01);
        // Where nothing may be, nothing was seen.
        assert!(pearson(&[cell(1.0, 0.0)]).2 < 1e-300);
        assert!(pearson(&[cell(100.0, 100.0), cell(40.0, 1e-9)]).2 < 1e-100);
    }
}
