//! The mask of GTR for any exponent, as a mixture of few exact masks.
//!
//! The measure over t of `measure.rs` is replaced by a Gauss rule in ln t, made once per material:
//! [`GgxNodes`] for γ ≤ 2, whose components are GGX, and [`Nodes`] for every γ. Either is again the
//! mask of a microsurface, whose density is near that of GTR.
//!
//! # Accuracy
//! max |ΔG1| over all directions and γ ∈ [0, 10], attained at γ ≈ 1.2 and just above the integers
//! from 2 on, near the horizon, at the smallest α (`tests/it/accuracy/nodes.rs`):
//!
//! | nodes | α ≥ 0.001 | α ≥ 0.01 | α ≥ 0.1 | α ≥ 0.5 |
//! |---|---|---|---|---|
//! | 4 | 1.1e-3 | 3.0e-4 | 2.4e-5 | 3.3e-7 |
//! | 6 | 7e-5 | 9e-6 | 2e-7 | 1e-9 |
//! | 8 | 8e-6 | 3.6e-7 | 4e-9 | 4e-12 |
//! | 12 | 1.3e-7 | 1.2e-9 | 1.6e-12 | |
//!
//! Below the horizon σ is the area z Λ alone, a share of the tail that few nodes do not see when it
//! is light. The largest relative errors found of σ and Λ there, and so of ∫D_w, with 8 nodes:
//!
//! | γ | α ≥ 0.001 | α ≥ 0.01 | α ≥ 0.1 |
//! |---|---|---|---|
//! | 0 … 2 | 3e-4 | 6e-6 | 2e-8 |
//! | 2 … 3 | 0.03 | 5e-4 | 1e-7 |
//! | 3 … 4 | 0.7 | 0.015 | 8e-6 |
//! | 4 … 10 | 1 | 1 | 0.15 |
//!
//! The area itself is small where they are large: 3e-18 for 45° below the horizon, γ = 4.5, α =
//! 0.003. [`Gtr::closed`] has every digit at the integers.
//! [`Components`](super::components::Components) have 6 of them for every γ. Samples have the
//! density of D all the same.
//!
//! The Gauss rule is in ln t because widths spread over decades: in t itself 8 nodes are off by 0.2
//! at α = 0.001.

use crate::Real;
use crate::elementary::inverse_root;
use crate::error::Error;
use crate::gtr::gauss::{MOST_POINTS, gauss};
use crate::gtr::integer::{LARGEST_DEGREE, ROOT_SERIES, Seen, flushed, series};
use crate::gtr::measure::{Measure, Resolution, covered};
use crate::gtr::{Gtr, Masking, VisibleMasking};
use crate::map::Isotropic;
use crate::microsurface::Microsurface;
use crate::ndf::staged::Forms;
use crate::real::construction::{exp, ln};

/// The trapezoid rule the Gauss rule is made from: better than 1e-13 for α ≥ 1e-3, where the points
/// suffice for the step.
const RESOLUTION: Resolution = Resolution { end: 1e-12, step: 0.5, points: MOST_POINTS };

/// The mask of GTR for γ ≤ 2 as a mixture of `N` masks of GGX: one square root a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GgxNodes<T, const N: usize> {
    /// Squared widths t, ascending.
    widths2: [T; N],
    /// ½ w, which sum to ½.
    half_weights: [T; N],
}

/// The mask of GTR for 0 ≤ γ ≤ 10 as a mixture of `N` masks of integer exponents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nodes<T, const N: usize> {
    /// Widths and weights; with n = 0 they are all.
    ggx: GgxNodes<T, N>,
    /// n of the components' exponent n + 2.
    degree: usize,
    /// aᵢ Vᵢ, i = 1 … n: see `integer.rs`.
    series: [[T; N]; LARGEST_DEGREE],
}

/// n, the squared widths and the weights of the Gauss rule of `N` nodes.
pub(super) fn rule<const N: usize>(alpha: f64, gamma: f64) -> (usize, [f64; N], [f64; N]) {
    const { assert!(N >= 1 && N <= 16, "a mask of GTR has 1 to 16 nodes") };
    let measure = Measure::new(alpha, gamma, &RESOLUTION);
    let (mut logs, mut weights) = ([0.0; MOST_POINTS], [0.0; MOST_POINTS]);
    let mut count = 0;
    measure.for_each(|t, weight| {
        (logs[count], weights[count]) = (ln(t), weight);
        count += 1;
    });
    let (logs, weights) = gauss::<N>(&logs[..count], &weights[..count]);
    (measure.degree, logs.map(exp), weights)
}

impl<T: Real, const N: usize> GgxNodes<T, N> {
    /// The weights are made to sum to ½ to a rounding, whatever theirs left.
    #[inline(always)]
    pub(super) fn of_rule(t: [T; N], weights: [T; N]) -> Self {
        let factor = T::HALF / sum::<T, N>(|j| weights[j]);
        Self { widths2: t, half_weights: weights.map(|w| flushed(factor * w)) }
    }

    #[inline(always)]
    fn above(&self, s2: T, z: T) -> T {
        let z2 = z * z;
        let sigma = T::HALF * z + sum::<T, N>(|j| self.half_weights[j] * (z2 + self.widths2[j] * s2).sqrt());
        // Rounding of the weights' sum.
        if sigma < z { z } else { sigma }
    }

    #[inline(always)]
    fn backfacing(&self, s2: T, z: T) -> T {
        let z2 = z * z;
        sum::<T, N>(|j| {
            let scaled = self.widths2[j] * s2;
            self.half_weights[j] * (scaled / ((z2 + scaled).sqrt() + z))
        })
    }
}

/// The sum over the nodes, by halves: nodes may be lanes.
#[inline(always)]
fn sum<T: Real, const N: usize>(mut term: impl FnMut(usize) -> T) -> T {
    let mut terms = [T::ZERO; N];
    for (j, slot) in terms.iter_mut().enumerate() {
        *slot = term(j);
    }
    let mut width = N;
    while width > 1 {
        let half = width.div_ceil(2);
        for j in 0..width / 2 {
            terms[j] += terms[half + j];
        }
        width = half;
    }
    terms[0]
}

impl<T: Real, const N: usize> Nodes<T, N> {
    #[inline(always)]
    pub(super) fn of_rule(degree: usize, t: [T; N], weights: [T; N]) -> Self {
        let mut series = series(degree, &t);
        for row in &mut series[..degree] {
            *row = row.map(flushed);
        }
        Self { ggx: GgxNodes::of_rule(t, weights), degree, series }
    }

    /// σ of exponents above 2: with Tₙ + c = 1 − Σ aᵢ ρⁱ it takes one root and one quotient a node.
    #[inline(always)]
    fn above(&self, degree: usize, s2: T, z: T) -> T {
        let z2 = z * z;
        let sum = sum::<T, N>(|j| {
            let scaled = self.ggx.widths2[j] * s2;
            let square = z2 + scaled;
            let rho = scaled / square;
            let mut sum = T::ZERO;
            for i in (0..degree).rev() {
                sum = (sum + (self.series[i][j] - T::lit(ROOT_SERIES[i + 1]))) * rho;
            }
            self.ggx.half_weights[j] * (square.sqrt() * (T::ONE + sum))
        });
        let sigma = T::HALF * z + sum;
        if sigma < z { z } else { sigma }
    }

    /// z Λ of exponents above 2.
    #[inline(always)]
    fn backfacing(&self, degree: usize, s2: T, z: T) -> T {
        sum::<T, N>(|j| {
            let seen = Seen::new(self.ggx.widths2[j], s2, z);
            self.ggx.half_weights[j] * seen.twice_backfacing_of_many(degree, |i| self.series[i][j])
        })
    }
}

impl<T: Real, const N: usize> Masking<T> for GgxNodes<T, N> {
    fn new(alpha: T, gamma: T) -> Result<Self, Error> {
        let value = covered(gamma)?;
        if value > LARGEST_HEAVY {
            return Err(Error::Gamma { value, largest: LARGEST_HEAVY });
        }
        let (_, t, weights) = rule(alpha.to_f64(), value);
        Ok(Self::of_rule(t.map(T::lit), weights.map(T::lit)))
    }

    /// For γ ≤ 2 the rounding of the ratio is at most doubled.
    #[inline(always)]
    fn root_of_power(n: T::Wide, d: T::Wide, gamma: T) -> T {
        inverse_root(T::narrow(n / d), T::HALF * gamma)
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        self.above(s2, z)
    }

    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        self.backfacing(s2, z)
    }
}

/// The largest γ whose components are GGX.
pub(super) const LARGEST_HEAVY: f64 = 2.0;

impl<T: Real, const N: usize> Masking<T> for Nodes<T, N> {
    fn new(alpha: T, gamma: T) -> Result<Self, Error> {
        let (degree, t, weights) = rule(alpha.to_f64(), covered(gamma)?);
        Ok(Self::of_rule(degree, t.map(T::lit), weights.map(T::lit)))
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        match self.degree {
            0 => self.ggx.above(s2, z),
            // Loops of known length for γ up to 4.
            1 => self.above(1, s2, z),
            2 => self.above(2, s2, z),
            // The series of higher degrees cancels.
            n => z + self.backfacing(n, s2, z),
        }
    }

    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        match self.degree {
            0 => self.ggx.backfacing(s2, z),
            1 => self.backfacing(1, s2, z),
            2 => self.backfacing(2, s2, z),
            n => self.backfacing(n, s2, z),
        }
    }
}

impl<T: Real, const N: usize> Forms for GgxNodes<T, N> {}

impl<T: Real, const N: usize> Forms for Nodes<T, N> {
    #[inline(always)]
    fn form(&self) -> usize {
        self.degree
    }

    #[inline(always)]
    fn with_form(self, form: usize) -> Self {
        Self { degree: form, ..self }
    }
}

impl<T: Real, const N: usize> VisibleMasking<T> for GgxNodes<T, N> {}
impl<T: Real, const N: usize> VisibleMasking<T> for Nodes<T, N> {}

impl<T: Real> Gtr<T, ()> {
    /// GTR of γ ≤ 2 with a mask of `N` nodes and nothing else: the least memory, and the fastest
    /// loops.
    ///
    /// # Errors
    /// [`Error::Alpha`] or [`Error::AlphaAboveOne`] unless 0 < α ≤ 1, [`Error::Gamma`] unless 0 ≤ γ
    /// ≤ 2.
    ///
    /// # Example
    /// ```
    /// use microsurface::{Gtr, Ndf, glam::Vec3};
    /// let w = Vec3::new(0.8, 0.0, 0.6);
    /// let few = Gtr::heavy_tailed::<4>(0.2_f32, 1.5)?;
    /// let many = Gtr::heavy_tailed::<12>(0.2_f32, 1.5)?;
    /// assert!((few.g1(w, w) - many.g1(w, w)).abs() < 1e-6);
    /// assert!(Gtr::heavy_tailed::<8>(0.2_f32, 2.5).is_err());
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    #[expect(clippy::type_complexity, reason = "the type names the distribution, its masking and its map")]
    pub fn heavy_tailed<const N: usize>(
        alpha: T,
        gamma: T,
    ) -> Result<Microsurface<Gtr<T, GgxNodes<T, N>>, Isotropic<T>>, Error> {
        Gtr::surface(alpha, gamma)
    }
}
