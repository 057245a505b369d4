//! Masks by quadrature in f64, independent of the crate.
//!
//! Both integrands have one sign, so that the trapezoid rule keeps all digits, and are analytic in a strip about the
//! real axis, so that it converges as e^{−2π·width/step}.

use std::io::{self, Write};

use microsurface::Gtr;
use microsurface::Ndf;
use microsurface::glam::DVec3;

/// Beckmann's Λ at ν = cot θ/α.
///
/// (1/(ν√π)) ∫₀^∞ x e^{−(x+ν)²} dx with x = eˢ: a strip of width π/4.
pub(crate) fn lambda_beckmann(nu: f64) -> f64 {
    const STEP: f64 = 0.1;
    // Below e^{−20}, x² is nothing beside the integral; above, x + ν exceeds 27 and the integrand is 0.
    let scale = 1.0 / nu.max(1.0);
    let sum: f64 = (-220..=36)
        .map(|i| {
            let x = scale * (STEP * f64::from(i)).exp();
            x * x * (-(x + nu) * (x + nu)).exp()
        })
        .sum();
    STEP * sum / (nu * core::f64::consts::PI.sqrt())
}

/// A GTR as a mixture of Student-t profiles, whose masks are elementary.
///
/// For n ≥ 0 with p = n + 2 − γ ≥ 0,
/// (x + 1)^{γ−2} (x + A)^{−γ} ∝ Σₖ C(n, k) ∫ (t − A)^{p−1} (1 − t)^{γ−1+k} (x + t)^{−(k+2)} dt over [A, 1], A = α².
/// With t = A + (1 − A)/(1 + e^{−s}) the strip is π wide. Its poles are of order γ + p + n: step ½
/// leaves 1e-13, step ¼ rounding alone.
pub(crate) struct Mixture {
    components: Vec<Component>,
}

struct Component {
    /// α² of the Student-t profile, its exponent less 2, and its share.
    t: f64,
    k: u8,
    weight: f64,
}

impl Mixture {
    /// The mixture of GTR(α, γ), 0 ≤ γ ≤ 4.
    pub(crate) fn new(alpha: f64, gamma: f64) -> Self {
        let a = alpha * alpha;
        // The smallest n that leaves p positive; at γ = 4 the measure has collapsed on t = A, and at γ = 0 on t = 1.
        let n: u8 = if gamma < 2.0 {
            0
        } else if gamma < 3.0 {
            1
        } else {
            2
        };
        let p = f64::from(n) + 2.0 - gamma;
        let mut mixture = Self { components: Vec::new() };
        if gamma == 0.0 {
            mixture.push(n, 1.0, 0.0, 1.0);
        } else if p == 0.0 {
            mixture.push(n, a, 1.0 - a, 1.0);
        } else {
            const STEP: f64 = 0.25;
            // Where A is small, most of the mass is at t of the order of A: the tail is cut 40 beyond.
            let mut s = -((40.0 - a.ln()) / p / STEP).ceil() * STEP;
            while s < 40.0 / gamma {
                let (rise, fall) = (1.0 / (1.0 + (-s).exp()), 1.0 / (1.0 + s.exp()));
                let measure = rise.powf(p) * fall.powf(gamma);
                mixture.push(n, a + (1.0 - a) * rise, (1.0 - a) * fall, measure);
                s += STEP;
            }
        }
        let total: f64 = mixture.components.iter().map(|component| component.weight).sum();
        for component in &mut mixture.components {
            component.weight /= total;
        }
        mixture
    }

    /// The profiles of one t, `rest` = 1 − t: a profile of exponent b has mass π/((b − 1) t^{b−1}).
    fn push(&mut self, n: u8, t: f64, rest: f64, measure: f64) {
        let mut binomial = 1.0;
        for k in 0..=n {
            let weight =
                measure * binomial * rest.powi(i32::from(k)) / (f64::from(k + 1) * t.powi(i32::from(k + 1)));
            if weight > 0.0 {
                self.components.push(Component { t, k, weight });
            }
            binomial *= f64::from(n - k) / f64::from(k + 1);
        }
    }

    /// Λ at squared sine `s2` and cosine `z`, of a vector of any length.
    pub(crate) fn lambda(&self, s2: f64, z: f64) -> f64 {
        let terms = self.components.iter().map(|&Component { t, k, weight }| {
            let r = (z * z + t * s2).sqrt();
            let e = t * s2 / (r + z);
            weight
                * match k {
                    0 => e / 2.0,
                    1 => e * e / (4.0 * r),
                    _ => e * e * e * (3.0 * r + z) / (16.0 * r * r * r),
                }
        });
        terms.sum::<f64>() / z
    }
}

/// Λ(80°) at α = 0.05, 0.2 and 0.5 for half-integer γ, by quadrature with 30 digits.
const HALF_INTEGERS: [(f64, f64, f64); 8] = [
    (0.05, 0.5, 1.475_555_487_799_26),
    (0.05, 1.5, 0.128_452_250_742_034),
    (0.05, 2.5, 2.900_891_900_964_84e-3),
    (0.05, 3.5, 8.569_249_610_038_3e-5),
    (0.2, 1.5, 0.533_092_800_009_559),
    (0.2, 3.5, 0.031_591_093_175_324_8),
    (0.5, 0.5, 1.978_377_875_780_64),
    (0.5, 2.5, 0.778_531_355_261_668),
];

/// Compares the quadratures with what is known otherwise, and prints the largest relative differences of Λ.
pub(crate) fn validate(out: &mut impl Write) -> io::Result<()> {
    let mut worst = 0.0_f64;
    let mut table = 0.0_f64;
    for alpha in crate::ALPHAS {
        for i in 1..90_u32 {
            let (s, z) = f64::from(i).to_radians().sin_cos();
            let w = DVec3::new(s, 0.0, z);
            let closed: [Option<f64>; 3] = [
                Gtr::closed::<1>(alpha).ok().map(|surface| surface.lambda(w)),
                Gtr::closed::<2>(alpha).ok().map(|surface| surface.lambda(w)),
                Gtr::closed::<3>(alpha).ok().map(|surface| surface.lambda(w)),
            ];
            for (gamma, exact) in [1.0, 2.0, 3.0].into_iter().zip(closed.into_iter().flatten()) {
                worst = worst.max((Mixture::new(alpha, gamma).lambda(s * s, z) / exact - 1.0).abs());
            }
        }
    }
    let (s, z) = 80_f64.to_radians().sin_cos();
    for (alpha, gamma, exact) in HALF_INTEGERS {
        table = table.max((Mixture::new(alpha, gamma).lambda(s * s, z) / exact - 1.0).abs());
    }
    let beckmann = (lambda_beckmann(z / s / 0.5) / 0.397_389_541_775_568 - 1.0).abs();
    writeln!(out, "Reference quadratures, largest relative difference of Λ: GTR from the closed forms of")?;
    writeln!(
        out,
        "γ = 1, 2, 3: {worst:.1e}; from 15-digit values at half-integer γ: {table:.1e}; Beckmann from"
    )?;
    writeln!(out, "a 15-digit value: {beckmann:.1e}.\n")
}
