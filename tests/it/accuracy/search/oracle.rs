//! The functions of distributions in 160 bits, by routes of their own.

use super::exact::Exact;

/// A distribution whose functions are searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Ggx,
    Beckmann,
    /// GTR of a real γ, for its density.
    Gtr(f64),
    /// GTR of an integer γ, for its mask.
    Closed(u8),
}

/// A direction and two widths, as the scalar holds them.
pub(super) struct Given {
    alphas: [Exact; 2],
    at: [Exact; 3],
}

impl Given {
    pub(super) fn new(alphas: [f64; 2], at: [f64; 3]) -> Self {
        Self { alphas: alphas.map(Exact::new), at: at.map(Exact::new) }
    }

    fn z(&self) -> Exact {
        self.at[2].clone()
    }

    /// (x/αx)² + (y/αy)².
    fn normal_term(&self) -> Exact {
        let [x, y] = [0, 1].map(|i| (&self.at[i] / &self.alphas[i]).square());
        &x + &y
    }

    /// (αx x)² + (αy y)².
    fn direction_term(&self) -> Exact {
        let [x, y] = [0, 1].map(|i| (&self.at[i] * &self.alphas[i]).square());
        &x + &y
    }

    /// The exponent of Beckmann's D.
    pub(super) fn exponent_of_normal(&self) -> Exact {
        &self.normal_term() / &self.z().square()
    }

    /// The exponent a² of Beckmann's σ and Λ.
    pub(super) fn exponent_of_direction(&self) -> Exact {
        &self.z().square() / &self.direction_term()
    }

    /// D, of degree −4 in the direction.
    pub(super) fn d(&self, kind: Kind) -> Exact {
        let (q, z2) = (self.normal_term(), self.z().square());
        let area = &(&self.alphas[0] * &self.alphas[1]) * &Exact::pi();
        match kind {
            Kind::Ggx => &Exact::new(1.0) / &(&area * &(&q + &z2).square()),
            Kind::Beckmann => &(-&(&q / &z2)).exp() / &(&area * &z2.square()),
            Kind::Gtr(gamma) => self.d_of_gtr(gamma),
            Kind::Closed(gamma) => self.d_of_gtr(f64::from(gamma)),
        }
    }

    /// c (x² + y² + z²)^{γ−2}/(x² + y² + α²z²)^γ.
    fn d_of_gtr(&self, gamma: f64) -> Exact {
        let alpha2 = self.alphas[0].square();
        let plane = &self.at[0].square() + &self.at[1].square();
        let (all, within) = (&plane + &self.z().square(), &plane + &(&alpha2 * &self.z().square()));
        let log = alpha2.ln();
        let (one, excess) = (Exact::new(1.0), &Exact::new(gamma) - 1.0);
        // (γ − 1)/(1 − α^{2−2γ}), and its limit −1/ln α².
        let share = if log.zero() {
            // (α² − 1)(γ − 1)/(1 − α^{2−2γ}) is 1 there.
            one.clone()
        } else if excess.zero() {
            &one / &-&log
        } else {
            &excess / &(&(-&(&excess * &log)).exp() - 1.0)
        };
        let range = if log.zero() { one.clone() } else { &one - &alpha2 };
        let c = &(&share * &range) / &Exact::pi();
        let power = (&(&(&Exact::new(gamma) - 2.0) * &all.ln()) - &(&Exact::new(gamma) * &within.ln())).exp();
        &c * &power
    }

    /// z Λ = σ(−w) of a direction above the horizon, the area of the facets that look away.
    fn backfacing(&self, kind: Kind) -> Exact {
        let (s2, z) = (self.direction_term(), self.z().abs());
        match kind {
            Kind::Ggx => of_ggx(&s2, &z),
            Kind::Beckmann => {
                let s = s2.sqrt();
                // ½ s (e^{−ν²}/√π − ν erfc ν).
                &(&s * &gaussian_tail(&(&z / &s))) * 0.5
            }
            Kind::Closed(gamma) => self.of_integer(gamma),
            Kind::Gtr(gamma) => unreachable!("no closed mask for {gamma}"),
        }
    }

    fn of_integer(&self, gamma: u8) -> Exact {
        let alpha2 = self.alphas[0].square();
        // The direction itself: α belongs to the profile.
        let (s2, z) = (&self.at[0].square() + &self.at[1].square(), self.z().abs());
        match gamma {
            0 => of_ggx(&s2, &z),
            1 => {
                let log = alpha2.ln();
                if log.zero() {
                    return of_ggx(&s2, &z);
                }
                // ∫ of GGX of the squared width t over dt/t from α² to 1, over −ln α²: with r =
                // √(z² + t s²) and dt/t = 2r dr/(r² − z²), ½ (r − z) becomes ∫ r/(r + z) dr = r − z
                // ln(r + z).
                let at = |t: &Exact| {
                    let r = (&z.square() + &(t * &s2)).sqrt();
                    &r - &(&z * &(&r + &z).ln())
                };
                &(&at(&Exact::new(1.0)) - &at(&alpha2)) / &-&log
            }
            _ => {
                // The mixture of Student's t: the share C(n,k)/(k+1) (1−t)ᵏ t^{n−k} has the area ½
                // r Σ_{i>k} aᵢ ρⁱ.
                let n = u32::from(gamma) - 2;
                let r2 = &z.square() + &(&alpha2 * &s2);
                let rho = &(&alpha2 * &s2) / &r2;
                let (mut total, mut seen) = (Exact::new(0.0), Exact::new(0.0));
                let mut choices = Exact::new(1.0);
                let beyond = remainders(&rho, n);
                for k in 0..=n {
                    let mut weight = &choices / f64::from(k + 1);
                    for _ in 0..k {
                        weight = &weight * &(&Exact::new(1.0) - &alpha2);
                    }
                    for _ in k..n {
                        weight = &weight * &alpha2;
                    }
                    total = &total + &weight;
                    seen = &seen + &(&weight * &beyond[k as usize]);
                    choices = &(&choices * f64::from(n - k)) / f64::from(k + 1);
                }
                &(&(&seen / &total) * &r2.sqrt()) * 0.5
            }
        }
    }

    pub(super) fn sigma(&self, kind: Kind) -> Exact {
        let away = self.backfacing(kind);
        if self.z().negative() { away } else { &self.z() + &away }
    }

    pub(super) fn lambda(&self, kind: Kind) -> Exact {
        let away = &self.backfacing(kind) / &self.z().abs();
        if self.z().negative() { -&(&away + 1.0) } else { away }
    }

    pub(super) fn g1(&self, kind: Kind) -> Exact {
        &Exact::new(1.0) / &(&self.lambda(kind) + 1.0)
    }
}

/// ½ (√(z² + s²) − z).
fn of_ggx(s2: &Exact, z: &Exact) -> Exact {
    &(s2 / &(&(&z.square() + s2).sqrt() + z)) * 0.5
}

/// Σ_{i>k} |C(½, i)| ρⁱ for k = 0 … n, of which the sum over all i > 0 is 1 − √(1 − ρ).
fn remainders(rho: &Exact, n: u32) -> Vec<Exact> {
    let mut terms = Vec::new();
    let (mut i, mut term) = (1_u32, rho * 0.5);
    // By the series itself where it converges well; there nothing cancels.
    let terms_wanted = if rho.to_f64() < 0.25 { n + 100 } else { n };
    while i <= terms_wanted + 1 {
        terms.push(term.clone());
        term = &(&(&term * rho) * f64::from(2 * i - 1)) / f64::from(2 * i + 2);
        i += 1;
    }
    let sum = |from: u32| terms[from as usize..].iter().fold(Exact::new(0.0), |sum, term| &sum + term);
    if rho.to_f64() < 0.25 {
        return (0..=n).map(sum).collect();
    }
    let all = &Exact::new(1.0) - &(&Exact::new(1.0) - rho).sqrt();
    (0..=n).map(|k| terms[..k as usize].iter().fold(all.clone(), |left, term| &left - term)).collect()
}

/// e^{−ν²}/√π − ν erfc ν = 2 ∫_ν^∞ (t − ν) e^{−t²}/√π dt, ν ≥ 0.
fn gaussian_tail(nu: &Exact) -> Exact {
    let square = nu.square();
    let density = &(-&square).exp() / &Exact::pi().sqrt();
    let erfc = if square.to_f64() < 30.0 {
        // erf ν = 2 e^{−ν²}/√π Σ 2ⁿ ν^{2n+1}/(2n+1)!!, of positive terms.
        let (mut sum, mut term, mut n) = (nu.clone(), nu.clone(), 1.0);
        while term.to_f64() > 1e-60 * sum.to_f64() {
            term = &(&(&term * &square) * 2.0) / (2.0 * n + 1.0);
            sum = &sum + &term;
            n += 1.0;
        }
        &Exact::new(1.0) - &(&(&sum * &density) * 2.0)
    } else {
        // erfc ν = e^{−ν²}/√π /(ν + ½/(ν + 1/(ν + 3/2/(ν + …)))).
        let mut below = nu.clone();
        for n in (1..120_u32).rev() {
            below = nu + &(&Exact::new(0.5 * f64::from(n)) / &below);
        }
        &density / &below
    };
    &density - &(nu * &erfc)
}

/// The oracle of the searches against the tables, which another program has made.
#[test]
fn the_oracle_is_right() {
    use crate::accuracy::{CLOSED, MASKING, MASKING_GTR, NDF, number, rows};
    let kind = |columns: &[&str]| match columns[0] {
        "ggx" => Kind::Ggx,
        "beckmann" => Kind::Beckmann,
        _ => Kind::Gtr(number(columns[3])),
    };
    let given = |columns: &[&str]| {
        let n = |i: usize| number(columns[i]);
        Given::new([n(1), n(2)], [n(4), n(5), n(6)])
    };
    let near = |value: Exact, column: &str, columns: &[&str]| {
        let exact = number(column);
        let error = (value.to_f64() - exact).abs();
        assert!(
            error <= 1e-15 * exact.abs() || exact == 0.0 || error < f64::MIN_POSITIVE,
            "{error:e} {columns:?}"
        );
    };
    for columns in rows(NDF) {
        let given = given(&columns);
        let horizon = number(columns[6]) == 0.0;
        if columns[0] != "beckmann" || !horizon && given.exponent_of_normal().to_f64() < 700.0 {
            near(given.d(kind(&columns)), columns[8], &columns);
        }
    }
    for columns in rows(MASKING).chain(rows(MASKING_GTR)) {
        let closed = columns[0] == "gtr";
        if closed && !CLOSED.contains(&columns[3]) {
            continue;
        }
        let kind = if closed { Kind::Closed(columns[3].parse().unwrap()) } else { kind(&columns) };
        let given = given(&columns);
        if number(columns[6]) == 0.0
            || number(columns[4]) == 0.0 && number(columns[5]) == 0.0
            || kind == Kind::Beckmann && given.exponent_of_direction().to_f64() > 700.0
        {
            continue;
        }
        near(given.sigma(kind), columns[7], &columns);
        near(given.lambda(kind), columns[8], &columns);
    }
}
