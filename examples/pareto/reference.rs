//! Masks by quadrature in f64, independent of the crate.
//!
//! Both integrands have one sign, so that the trapezoid rule keeps all digits, and are analytic in
//! a strip about the real axis, so that it converges as e^{−2π·width/step}.

use std::io::{self, Write};

use microsurface::glam::DVec3;
use microsurface::{Gtr, Ndf};

/// Beckmann's Λ at ν = cot θ/α.
///
/// (1/(ν√π)) ∫₀^∞ x e^{−(x+ν)²} dx with x = eˢ: a strip of width π/4.
pub(crate) fn lambda_beckmann(nu: f64) -> f64 {
    const STEP: f64 = 0.1;
    // Below e^{−20}, x² is nothing beside the integral; above, x + ν exceeds 27 and the integrand
    // is 0.
    let scale = 1.0 / nu.max(1.0);
    let sum: f64 = (-220..=36)
        .map(|i| {
            let x = scale * (STEP * f64::from(i)).exp();
            x * x * (-(x + nu) * (x + nu)).exp()
        })
        .sum();
    STEP * sum / (nu * core::f64::consts::PI.sqrt())
}

/// The largest γ of a mixture, and n of it.
pub(crate) const LARGEST_GAMMA: u8 = 10;
const MOST: usize = 9;

/// A GTR as a mixture of Student-t profiles, whose masks are elementary.
///
/// For n ≥ 0 with p = n + 2 − γ > 0, (x + 1)^{γ−2} (x + A)^{−γ} ∝ Σₖ C(n, k) ∫ (t − A)^{p−1} (1 −
/// t)^{γ−1+k} (x + t)^{−(k+2)} dt over [A, 1], A = α². With t = A + (1 − A)/(1 + e^{−s}) the strip
/// is π wide. Its poles are of order γ + p + n: step ½ leaves 1e-13, step ¼ rounding alone.
pub(crate) struct Mixture {
    n: usize,
    components: Vec<Component>,
}

/// The profiles of one t = α².
struct Component {
    t: f64,
    /// The shares of the exponents 2 … n + 2.
    weights: [f64; MOST + 1],
}

impl Mixture {
    /// The mixture of GTR(α, γ), 0 ≤ γ ≤ 10.
    pub(crate) fn new(alpha: f64, gamma: f64) -> Self {
        let a = alpha * alpha;
        // The smallest n that leaves p positive.
        let n = (2..=LARGEST_GAMMA).filter(|&g| f64::from(g) <= gamma).count();
        let p = number(n + 2) - gamma;
        let mut mixture = Self { n, components: Vec::new() };
        if gamma == 0.0 {
            // The measure has collapsed on t = 1.
            mixture.push(1.0, 0.0, 1.0);
        } else {
            const STEP: f64 = 0.25;
            // Where A is small, most of the mass is at t of the order of A: the tail is cut 40
            // beyond.
            let mut s = -((40.0 - a.ln()) / p / STEP).ceil() * STEP;
            while s < 40.0 / gamma {
                let (rise, fall) = (1.0 / (1.0 + (-s).exp()), 1.0 / (1.0 + s.exp()));
                mixture.push(a + (1.0 - a) * rise, (1.0 - a) * fall, rise.powf(p) * fall.powf(gamma));
                s += STEP;
            }
        }
        let total: f64 = mixture.components.iter().flat_map(|component| component.weights).sum();
        for component in &mut mixture.components {
            component.weights = component.weights.map(|weight| weight / total);
        }
        mixture
    }

    /// The profiles of one t, `rest` = 1 − t: a profile of exponent b has mass π/((b − 1) t^{b−1}).
    fn push(&mut self, t: f64, rest: f64, measure: f64) {
        let mut weights = [0.0; MOST + 1];
        // C(n, k) restᵏ/t^{k+1}.
        let mut factor = measure / t;
        for (k, weight) in weights[..=self.n].iter_mut().enumerate() {
            *weight = factor / number(k + 1);
            factor *= number(self.n - k) / number(k + 1) * rest / t;
        }
        if weights[0] > 0.0 {
            self.components.push(Component { t, weights });
        }
    }

    /// Λ at squared sine `s2` and cosine `z`, of a vector of any length.
    ///
    /// With r = √(z² + t s²), c = z/r and ρ = 1 − c², the profile of exponent k + 2 has z Λₖ = ½ r
    /// Tₖ, Tₖ = Σ aᵢ ρⁱ over i > k: Tₙ in closed form, the others by adding what it lacks.
    pub(crate) fn lambda(&self, s2: f64, z: f64) -> f64 {
        let (denominator, numerators) = REMAINDERS[self.n];
        let terms = self.components.iter().map(|&Component { t, weights }| {
            let r = (z * z + t * s2).sqrt();
            let (c, d) = (z / r, t * s2 / (r * (r + z)));
            let rho = d * (1.0 + c);
            let (mut powers, mut power_of_d) = ([1.0; MOST + 1], d);
            for k in 1..=self.n {
                powers[k] = powers[k - 1] * rho;
                power_of_d *= d;
            }
            let polynomial = numerators.iter().rev().fold(0.0, |sum, a| sum * c + a);
            let (mut remainder, mut sum) = (power_of_d * polynomial / denominator, 0.0);
            for k in (0..=self.n).rev() {
                sum += weights[k] * remainder;
                remainder += ROOT_SERIES[k] * powers[k];
            }
            0.5 * r * sum
        });
        terms.sum::<f64>() / z
    }
}

/// aᵢ = |C(½, i)|.
const ROOT_SERIES: [f64; MOST + 1] = [
    1.0,
    1.0 / 2.0,
    1.0 / 8.0,
    1.0 / 16.0,
    5.0 / 128.0,
    7.0 / 256.0,
    21.0 / 1024.0,
    33.0 / 2048.0,
    429.0 / 32768.0,
    715.0 / 65536.0,
];

/// Row n: Tₙ/(1 − c)^{n+1} as a polynomial in c, by exact division of polynomials: its denominator,
/// and its numerators from c⁰.
const REMAINDERS: [(f64, &[f64]); MOST + 1] = [
    (1.0, &[1.0]),
    (2.0, &[1.0]),
    (8.0, &[3.0, 1.0]),
    (16.0, &[5.0, 4.0, 1.0]),
    (128.0, &[35.0, 47.0, 25.0, 5.0]),
    (256.0, &[63.0, 122.0, 102.0, 42.0, 7.0]),
    (1024.0, &[231.0, 593.0, 686.0, 434.0, 147.0, 21.0]),
    (2048.0, &[429.0, 1384.0, 2063.0, 1776.0, 915.0, 264.0, 33.0]),
    (32768.0, &[6435.0, 25147.0, 46143.0, 50535.0, 35145.0, 15345.0, 3861.0, 429.0]),
    (65536.0, &[12155.0, 56014.0, 122560.0, 163570.0, 143770.0, 84370.0, 32032.0, 7150.0, 715.0]),
];

#[expect(clippy::cast_precision_loss, reason = "at most 12")]
fn number(n: usize) -> f64 {
    n as f64
}

/// 50-digit masks, by integrals over slopes and closed forms.
const TABLE: &str = include_str!("../../tests/reference/masking_gtr.tsv");

/// The largest relative difference of Λ from the table in the upper hemisphere, for α ≥ 0.001; and
/// of how many values.
///
/// Without γ just below an integer above 1, where the trapezoid rule is long: no question has them.
fn from_table() -> (f64, u32) {
    let (mut worst, mut count) = (0.0_f64, 0);
    for line in TABLE.lines().filter(|line| line.starts_with("gtr")) {
        let row: Vec<f64> = line.split('\t').map(|field| field.parse().unwrap_or(f64::NAN)).collect();
        let [_, alpha, _, gamma, x, y, z, _, lambda, _] = row[..] else { continue };
        let long = gamma > 1.0 && gamma.fract() > 0.96;
        if !long && alpha >= 0.001 && gamma <= f64::from(LARGEST_GAMMA) && z > 0.0 && lambda > 1e-300 {
            let difference = Mixture::new(alpha, gamma).lambda(x * x + y * y, z) / lambda - 1.0;
            worst = worst.max(difference.abs());
            count += 1;
        }
    }
    (worst, count)
}

/// The largest relative difference of Λ from the closed form of γ = `G`.
fn from_closed<const G: u8>() -> f64 {
    let mut worst = 0.0_f64;
    for alpha in crate::ALPHAS {
        let Ok(surface) = Gtr::closed::<G>(alpha) else { continue };
        let mixture = Mixture::new(alpha, f64::from(G));
        for i in 1..90_u32 {
            let (s, z) = f64::from(i).to_radians().sin_cos();
            let exact = surface.lambda(DVec3::new(s, 0.0, z));
            worst = worst.max((mixture.lambda(s * s, z) / exact - 1.0).abs());
        }
    }
    worst
}

/// Compares the quadratures with what is known otherwise, and prints the largest relative
/// differences of Λ.
pub(crate) fn validate(out: &mut impl Write) -> io::Result<()> {
    let closed = [from_closed::<1>(), from_closed::<2>(), from_closed::<3>(), from_closed::<4>()]
        .into_iter()
        .chain([from_closed::<6>(), from_closed::<10>()])
        .fold(0.0, f64::max);
    let (table, count) = from_table();
    let (s, z) = 80_f64.to_radians().sin_cos();
    let beckmann = (lambda_beckmann(z / s / 0.5) / 0.397_389_541_775_568 - 1.0).abs();
    writeln!(out, "Reference quadratures, largest relative difference of Λ: GTR from the closed forms of")?;
    writeln!(
        out,
        "γ = 1, 2, 3, 4, 6, 10: {closed:.1e}; from {count} values of 50 digits, 0 ≤ γ ≤ 10: {table:.1e};"
    )?;
    writeln!(out, "Beckmann from a 15-digit value: {beckmann:.1e}.\n")
}
