//! The special functions of the charts, each checked against closed forms or tables below. No code
//! of the crate takes part, so that nothing under test judges itself.

use core::f64::consts::PI;

pub(crate) use libm::erfc;

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

/// e^{x²} erfc x for x ≥ 0.
pub(crate) fn erfcx(x: f64) -> f64 {
    if x * x >= 1.5 { x / PI.sqrt() * upper_fraction(0.5, x * x) } else { (x * x).exp() * erfc(x) }
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
fn gauss_legendre_is_exact_for_polynomials() {
    for n in [4, 6] {
        let rule = gauss_legendre(n);
        for power in 0..2 * n {
            let sum: f64 = rule.iter().map(|[x, w]| w * x.powf(f64::from(power))).sum();
            close(sum, 1.0 / f64::from(power + 1));
        }
    }
}
