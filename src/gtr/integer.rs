//! GTR of an integer exponent γ = n + 2 as a mixture of Student-t profiles.
//!
//! (r² + 1)ⁿ/(r² + t)^{n+2} = Σₖ C(n,k) (1−t)ᵏ/(r² + t)^{k+2}: the component k is the Student-t
//! profile (b−1) t^{b−1}/(π (r² + t)^b) of exponent b = k + 2, with a weight proportional to
//! C(n,k)/(k+1) (1−t)ᵏ t^{n−k}.
//!
//! With r = √(z² + t s²), c = z/r, ρ = t s²/r² = 1 − c² and aᵢ = |C(½, i)|, the facets of a
//! component that look away have the area
//!
//! z Λₖ = ½ r Tₖ,  Tₖ = Σ_{i>k} aᵢ ρⁱ = 1 − Σ_{1≤i≤k} aᵢ ρⁱ − c,
//!
//! because Σₖ z Λₖ yᵏ is t s²/(2 (z + √(z² + t (1−y) s²))), GGX of a width that varies with y. Tₖ
//! is (1−c)^{k+1} times a polynomial in c of positive coefficients, and the whole mixture is
//!
//! z Λ = ½ r (Tₙ + Σ_{1≤i≤n} aᵢ Vᵢ ρⁱ),  Vᵢ = Σ_{k<i} wₖ,
//!
//! of positive terms only.

use crate::Real;

/// A small integer as it is.
#[expect(clippy::cast_precision_loss, reason = "no integer here is above a few hundred")]
pub(super) const fn number(n: usize) -> f64 {
    n as f64
}

/// The largest n: γ up to 10.
pub(super) const LARGEST_DEGREE: usize = 8;

/// aᵢ = |C(½, i)|, i = 0 … 8.
pub(super) const ROOT_SERIES: [f64; LARGEST_DEGREE + 1] = root_series();

/// Row n: the coefficients of Tₙ/(1−c)^{n+1}, from c⁰. Exact.
const REMAINDERS: [[f64; LARGEST_DEGREE]; LARGEST_DEGREE + 1] = remainders();

/// d whose (n + 1)th power is 1e-37, about the smallest normal f32.
const LEAST: [f64; LARGEST_DEGREE + 1] =
    [1e-37, 3.2e-19, 4.7e-13, 5.7e-10, 4.0e-8, 6.9e-7, 5.2e-6, 2.4e-5, 7.8e-5];

const fn root_series() -> [f64; LARGEST_DEGREE + 1] {
    let mut a = [1.0; LARGEST_DEGREE + 1];
    a[1] = 0.5;
    let mut i = 2;
    while i <= LARGEST_DEGREE {
        a[i] = a[i - 1] * number(2 * i - 3) / number(2 * i);
        i += 1;
    }
    a
}

/// (1−c) Pₙ = Pₙ₋₁ − aₙ (1+c)ⁿ, P₀ = 1: a division of power series, which ends.
const fn remainders() -> [[f64; LARGEST_DEGREE]; LARGEST_DEGREE + 1] {
    let mut rows = [[0.0; LARGEST_DEGREE]; LARGEST_DEGREE + 1];
    rows[0][0] = 1.0;
    let mut n = 1;
    while n <= LARGEST_DEGREE {
        let mut binomial = 1.0;
        let mut sum = 0.0;
        let mut k = 0;
        while k < n {
            sum += rows[n - 1][k] - ROOT_SERIES[n] * binomial;
            rows[n][k] = sum;
            binomial = binomial * number(n - k) / number(k + 1);
            k += 1;
        }
        n += 1;
    }
    rows
}

/// `x`, or 0 where it is negative, as interpolation may leave a weight, or so small that it only
/// makes products denormal, which take a microcode assist each.
#[inline(always)]
pub(super) fn flushed<T: Real>(x: T) -> T {
    if x < T::MIN_POSITIVE / (T::EPSILON * T::EPSILON) { T::ZERO } else { x }
}

/// C(n, k)/(k + 1).
#[inline(always)]
fn student_factor(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0 / number(k + 1), |product, i| product * number(n - i) / number(i + 1))
}

/// The weights of the exponents b = 2 … n + 2, which sum to 1; 0 above.
pub(super) fn student_weights<T: Real>(n: usize, t: T) -> [T; LARGEST_DEGREE + 1] {
    shares(n, &[t]).map(|[weight]| weight)
}

/// The coefficients of many t at once, in loops that vectorise.
#[inline(always)]
fn shares<T: Real, const M: usize>(n: usize, t: &[T; M]) -> [[T; M]; LARGEST_DEGREE + 1] {
    let mut shares = [[T::ZERO; M]; LARGEST_DEGREE + 1];
    let mut power = [T::ONE; M];
    for (k, share) in shares[..=n].iter_mut().enumerate() {
        let factor = T::lit(student_factor(n, k));
        for j in 0..M {
            share[j] = factor * power[j];
            power[j] *= T::ONE - t[j];
        }
    }
    let (mut power, mut sum) = ([T::ONE; M], [T::ZERO; M]);
    for share in shares[..=n].iter_mut().rev() {
        for j in 0..M {
            share[j] *= power[j];
            sum[j] += share[j];
            power[j] *= t[j];
        }
    }
    for sum in &mut sum {
        *sum = T::ONE / *sum;
    }
    for share in &mut shares[..=n] {
        for j in 0..M {
            share[j] *= sum[j];
        }
    }
    shares
}

/// aᵢ Vᵢ for i = 1 … n, each for many t; 0 above.
#[inline(always)]
pub(super) fn series<T: Real, const M: usize>(n: usize, t: &[T; M]) -> [[T; M]; LARGEST_DEGREE] {
    let mut rows = [[T::ZERO; M]; LARGEST_DEGREE];
    if n == 0 {
        return rows;
    }
    let shares = shares(n, t);
    let mut below = [T::ZERO; M];
    for i in 0..n {
        let a = T::lit(ROOT_SERIES[i + 1]);
        for j in 0..M {
            below[j] += shares[i][j];
            rows[i][j] = a * below[j];
        }
    }
    rows
}

/// A direction as a component of squared width t sees it.
#[derive(Clone, Copy)]
pub(super) struct Seen<T> {
    /// r = √(z² + t s²).
    pub(super) r: T,
    /// c = z/r.
    pub(super) c: T,
    /// 1 − c, without cancellation.
    pub(super) d: T,
    /// 1 − c².
    pub(super) rho: T,
}

impl<T: Real> Seen<T> {
    /// For z ≥ 0.
    #[inline(always)]
    pub(super) fn new(t: T, s2: T, z: T) -> Self {
        let scaled = t * s2;
        let r = (z * z + scaled).sqrt();
        let d = scaled / (r * (r + z));
        // c only multiplies what does not vanish with it: its absolute error is what counts.
        let c = T::ONE - d;
        Self { r, c, d, rho: d + c * d }
    }

    /// Tₙ.
    #[inline(always)]
    pub(super) fn remainder(&self, n: usize) -> T {
        let mut power = self.d;
        for _ in 0..n {
            power *= self.d;
        }
        power * REMAINDERS[n][..n.max(1)].iter().rev().fold(T::ZERO, |sum, &a| sum * self.c + T::lit(a))
    }

    /// 2 z Λ of a component whose aᵢ Vᵢ are `series`(i − 1).
    #[inline(always)]
    pub(super) fn twice_backfacing(&self, n: usize, series: impl Fn(usize) -> T) -> T {
        let mut sum = T::ZERO;
        for i in (0..n).rev() {
            sum = (sum + series(i)) * self.rho;
        }
        self.r * (self.remainder(n) + sum)
    }

    /// `twice_backfacing` of one component of many, without what adds nothing beside the others and
    /// would only make products denormal, each of which takes a microcode assist.
    #[inline(always)]
    pub(super) fn twice_backfacing_of_many(&self, n: usize, series: impl Fn(usize) -> T) -> T {
        let mut sum = T::ZERO;
        for i in (0..n).rev() {
            sum = if sum < T::MIN_POSITIVE / T::EPSILON { T::ZERO } else { sum };
            sum = (sum + series(i)) * self.rho;
        }
        let d = if T::WIDENS && self.d < T::lit(LEAST[n]) { T::ZERO } else { self.d };
        self.r * (Self { d, ..*self }.remainder(n) + sum)
    }
}
