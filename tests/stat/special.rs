//! The special functions of the statistics, each checked against closed forms or tables below.
//!
//! They are written here, in the plainest form that converges, so that nothing under test judges
//! itself.

use core::f64::consts::PI;

/// ln Γ(x) for x > 0: Stirling's series after shifting x above 12, where five terms leave less than
/// 1e-15.
fn ln_gamma(mut x: f64) -> f64 {
    let mut shift = 1.0;
    while x < 12.0 {
        shift *= x;
        x += 1.0;
    }
    let y = 1.0 / (x * x);
    let series = (1.0 / 12.0 - y * (1.0 / 360.0 - y * (1.0 / 1260.0 - y * (1.0 / 1680.0 - y / 1188.0)))) / x;
    (x - 0.5) * x.ln() - x + 0.5 * (2.0 * PI).ln() + series - shift.ln()
}

/// Γ(a, x) eˣ x^{−a}, by Lentz's continued fraction, for x ≥ a + 1.
fn upper_fraction(a: f64, x: f64) -> f64 {
    let mut b = x + 1.0 - a;
    let mut c = f64::INFINITY;
    let mut d = 1.0 / b;
    let mut h = d;
    for i in 1..10_000 {
        let i = f64::from(i);
        let an = -i * (i - a);
        b += 2.0;
        d = 1.0 / (an * d + b);
        c = b + an / c;
        h *= c * d;
        if (c * d - 1.0).abs() < 4e-16 {
            break;
        }
    }
    h
}

/// The regularised upper incomplete gamma function Q(a, x), a > 0.
pub(crate) fn gamma_q(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    let scale = (a * x.ln() - x - ln_gamma(a)).exp();
    if x >= a + 1.0 {
        return scale * upper_fraction(a, x);
    }
    let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
    while term > sum * 1e-17 {
        n += 1.0;
        term *= x / n;
        sum += term;
    }
    1.0 - scale * sum
}

/// The probability that χ² with `dof` degrees of freedom exceeds `x`.
pub(crate) fn chi_square_survival(dof: usize, x: f64) -> f64 {
    gamma_q(0.5 * count(dof), 0.5 * x)
}

/// erfc x.
pub(crate) fn erfc(x: f64) -> f64 {
    let q = gamma_q(0.5, x * x);
    if x < 0.0 { 2.0 - q } else { q }
}

/// e^{x²} erfc x for x ≥ 0.
pub(crate) fn erfcx(x: f64) -> f64 {
    if x * x >= 1.5 { x / PI.sqrt() * upper_fraction(0.5, x * x) } else { (x * x).exp() * erfc(x) }
}

/// Kolmogorov's Q(λ) = 2 Σ (−1)^{k−1} e^{−2k²λ²}: the probability that √n sup|Fₙ − F| exceeds λ, n
/// → ∞.
///
/// Below λ = 1.18 the same theta function is summed in its dual form, of which five terms are exact
/// to 1e-16.
pub(crate) fn kolmogorov_q(lambda: f64) -> f64 {
    if lambda < 0.04 {
        return 1.0;
    }
    if lambda < 1.18 {
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

/// The nodes and weights of the n-point Gauss–Legendre rule on [0, 1], by Newton's iteration.
pub(crate) fn gauss_legendre(n: u32) -> Vec<[f64; 2]> {
    let rule = (0..n).map(|i| {
        let mut x = (PI * (f64::from(i) + 0.75) / (f64::from(n) + 0.5)).cos();
        let mut derivative = 1.0;
        for _ in 0..8 {
            let (mut p0, mut p1) = (1.0, x);
            for k in 2..=n {
                let k = f64::from(k);
                (p0, p1) = (p1, ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k);
            }
            derivative = f64::from(n) * (x * p1 - p0) / (x * x - 1.0);
            x -= p1 / derivative;
        }
        [0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * derivative * derivative)]
    });
    rule.collect()
}

/// A count as a real number; counts here stay below 2⁵³.
#[expect(clippy::cast_precision_loss, reason = "counts are far below 2⁵³")]
pub(crate) fn count(n: usize) -> f64 {
    n as f64
}

fn close(value: f64, expected: f64) {
    assert!((value / expected - 1.0).abs() < 2e-12, "{value:e} is not {expected:e}");
}

#[test]
fn chi_square_survival_has_its_closed_forms_and_table_values() {
    // Two degrees of freedom: e^{−x/2}. Four: (1 + x/2) e^{−x/2}. Abramowitz and Stegun, table
    // 26.7.
    for x in [0.1, 1.0, 3.9, 4.1, 20.0, 300.0] {
        close(chi_square_survival(2, x), (-0.5 * x).exp());
        close(chi_square_survival(4, x), (1.0 + 0.5 * x) * (-0.5 * x).exp());
    }
    for (dof, x, p) in [(1, 3.841_458_820_694_124, 0.05), (10, 23.209_251_158_954_356, 0.01)] {
        close(chi_square_survival(dof, x), p);
    }
    // The median of many degrees of freedom, to the order of Wilson and Hilferty.
    let median = 200.0 * (1.0_f64 - 2.0 / 1800.0).powi(3);
    assert!((chi_square_survival(200, median) - 0.5).abs() < 1e-4);
}

#[test]
fn error_functions_have_table_values() {
    for (x, value) in
        [(0.5, 0.479_500_122_186_953_5), (1.0, 0.157_299_207_050_285_13), (3.0, 2.209_049_699_858_544e-5)]
    {
        close(erfc(x), value);
        close(erfcx(x), value * (x * x).exp());
        close(erfc(-x), 2.0 - value);
    }
    // The asymptotic series 1/(√π x)(1 − 1/(2x²) + 3/(4x⁴) − …).
    let y = 1.0 / (2.0 * 40.0 * 40.0);
    close(erfcx(40.0), (1.0 - y * (1.0 - 3.0 * y * (1.0 - 5.0 * y * (1.0 - 7.0 * y)))) / (40.0 * PI.sqrt()));
}

#[test]
fn kolmogorov_distribution_has_table_values_and_one_value_on_both_branches() {
    // Smirnov 1948: the quantiles of 5 % and 1 %.
    assert!((kolmogorov_q(1.358_098_634) - 0.05).abs() < 1e-6);
    assert!((kolmogorov_q(1.627_623_62) - 0.01).abs() < 1e-6);
    assert!((kolmogorov_q(1.18 - 1e-13) - kolmogorov_q(1.18 + 1e-13)).abs() < 1e-12);
    assert!(kolmogorov_q(0.2) > 1.0 - 1e-10);
}

#[test]
fn gauss_legendre_is_exact_for_polynomials() {
    for n in [4, 6] {
        let rule = gauss_legendre(n);
        for power in 0..2 * n {
            let sum: f64 = rule.iter().map(|[x, w]| w * x.powf(f64::from(power))).sum();
            close(sum, 1.0 / f64::from(power + 1));
        }
    }
}
