//! GTR of any exponent as many components, so many that their density is that of GTR to rounding.
//!
//! The points of the trapezoid rule of `measure.rs` as weighted distributions of width √t. Unlike
//! the few [`nodes`](super::nodes) of a mask they stand for the density itself, at every angle:
//! visible normals are drawn from them, and whatever is linear in the density of slopes (a filter,
//! a lookup) can be had of them.

use crate::Real;
use crate::error::Error;
use crate::ggx::Ggx;
use crate::gtr::integer::{LARGEST_DEGREE, ROOT_SERIES, Seen, flushed, number, series, student_weights};
use crate::gtr::measure::{Measure, Resolution, covered};
use crate::gtr::{visible, width};
use crate::profile::SampleVisibleProfile;
use crate::vector::below_one;

/// The largest number of components.
pub const MOST_COMPONENTS: usize = 48;

/// δ of the ends, and no step finer than is of use: e^{−2π²/½} is 7e-18.
const RESOLUTION: Resolution = Resolution { end: 1e-8, step: 0.5, points: MOST_COMPONENTS };

/// GTR of exponent γ ∈ [0, 10] and width α as a mixture of GTR of one integer exponent and of
/// widths between α and 1.
///
/// For γ ≤ 2 the components are GGX. Weights are positive and sum to 1.
///
/// # Accuracy
/// The density of the mixture is that of GTR to a relative error, the worst over all angles and γ,
/// of 8.3e-7 for α ≥ 0.001 (γ = 1), 1.5e-7 for α ≥ 0.01, 9e-8 for α ≥ 0.1 (γ → 10), growing to 3e-5
/// at α = 1e-6 (`tests/it/accuracy/nodes.rs`): below the rounding of f32 but for the narrowest.
///
/// # Example
/// ```
/// use microsurface::{Ggx, Ndf, glam::DVec3, gtr::{Density, components::Components}};
/// let wm = DVec3::new(0.6, 0.0, 0.8);
/// let mixture: f64 = Components::new(0.1_f64, 1.4)?
///     .iter()
///     .map(|component| component.weight * Ggx::isotropic(component.alpha).unwrap().d(wm))
///     .sum();
/// assert!((mixture / Density::new(0.1, 1.4)?.d(wm) - 1.0).abs() < 1e-6);
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Components<T> {
    /// n of the components' exponent n + 2.
    degree: usize,
    count: usize,
    /// Squared widths t, ascending; what follows the last component has no weight.
    widths2: [T; MOST_COMPONENTS],
    weights: [T; MOST_COMPONENTS],
}

/// One distribution of a mixture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Component<T> {
    /// Its share of the slopes.
    pub weight: T,
    /// Its width.
    pub alpha: T,
    /// Its exponent, an integer: 2 is GGX.
    pub gamma: T,
}

impl<T: Real> Components<T> {
    /// The components of GTR.
    ///
    /// # Errors
    /// [`Error::Alpha`] or [`Error::AlphaAboveOne`] unless 0 < α ≤ 1, [`Error::Gamma`] unless 0 ≤ γ
    /// ≤ 10.
    pub fn new(alpha: T, gamma: T) -> Result<Self, Error> {
        Ok(Self::of(width(alpha)?.to_f64(), covered(gamma)?))
    }

    /// The components of numbers that have been checked.
    pub(super) fn of(alpha: f64, gamma: f64) -> Self {
        let measure = Measure::new(alpha, gamma, &RESOLUTION);
        let mut widths2 = [1.0; MOST_COMPONENTS];
        let mut weights = [0.0; MOST_COMPONENTS];
        let (mut count, mut sum) = (0, 0.0);
        measure.for_each(|t, weight| {
            (widths2[count], weights[count]) = (t, weight);
            count += 1;
            sum += weight;
        });
        let scale = 1.0 / sum;
        Self {
            degree: measure.degree,
            count,
            widths2: widths2.map(T::lit),
            weights: weights.map(|weight| flushed(T::lit(weight * scale))),
        }
    }

    /// The components, by ascending width.
    pub fn iter(&self) -> impl Iterator<Item = Component<T>> + '_ {
        let gamma = T::lit(number(self.degree + 2));
        let pairs = self.widths2.iter().zip(&self.weights).take(self.count);
        pairs.map(move |(&t, &weight)| Component { weight, alpha: t.sqrt(), gamma })
    }

    /// A normal visible from `v`, of the mixture itself (map I), of any length.
    ///
    /// u.y chooses a component by its share of what is seen, from narrow to wide, and is stretched
    /// to [0, 1) for the choice within it: two numbers suffice, and neighbours stay neighbours but
    /// for the borders between components.
    #[inline]
    pub(super) fn sample_visible(&self, v: [T; 3], [u1, u2]: [T; 2]) -> [T; 3] {
        let s2 = v[0] * v[0] + v[1] * v[1];
        let (j, u2) = self.choose(s2, v[2], below_one(u2));
        let t = self.widths2[j];
        let root = t.sqrt();
        let stretched = [root * v[0], root * v[1], v[2]];
        let [x, y, z] = if self.degree == 0 {
            Ggx.sample_visible(stretched, t * s2, [u1, u2])
        } else {
            let (k, u2) = choose_exponent(self.degree, t, s2, v[2], u2);
            if k == 0 {
                Ggx.sample_visible(stretched, t * s2, [u1, u2])
            } else {
                visible::sample_visible(k, stretched, [u1, u2])
            }
        };
        [root * x, root * y, z]
    }

    /// The component that u falls on, and how far it falls into it.
    #[inline(always)]
    fn choose(&self, s2: T, z: T, u: T) -> (usize, T) {
        const BLOCK: usize = 8;
        let areas = match self.degree {
            0 => self.areas_of_ggx(s2, z),
            // Loops of known length for γ up to 4.
            1 => self.areas(1, s2, z),
            2 => self.areas(2, s2, z),
            n => self.areas(n, s2, z),
        };
        let mut totals = [T::ZERO; MOST_COMPONENTS / BLOCK];
        for (sum, areas) in totals.iter_mut().zip(areas.chunks_exact(BLOCK)) {
            *sum = total(areas);
        }
        let (block, u) = pick(&totals, total(&totals), u);
        let (j, u) = pick(&areas[BLOCK * block..BLOCK * (block + 1)], totals[block], u);
        (BLOCK * block + j, u)
    }

    /// 2 w σ of the components.
    #[inline(always)]
    fn areas_of_ggx(&self, s2: T, z: T) -> [T; MOST_COMPONENTS] {
        let z2 = z * z;
        let height = z.abs();
        let from_below = z < T::ZERO;
        core::array::from_fn(|j| {
            let scaled = self.widths2[j] * s2;
            let sum = (z2 + scaled).sqrt() + height;
            self.weights[j] * if from_below { scaled / sum } else { sum }
        })
    }

    /// 2 w σ of the components, of any exponent.
    #[inline(always)]
    fn areas(&self, degree: usize, s2: T, z: T) -> [T; MOST_COMPONENTS] {
        let series = series(degree, &self.widths2);
        let twice_front = if z < T::ZERO { T::ZERO } else { T::TWO * z };
        let mut areas = [T::ZERO; MOST_COMPONENTS];
        for j in 0..MOST_COMPONENTS {
            let seen = Seen::new(self.widths2[j], s2, z.abs());
            areas[j] =
                self.weights[j] * (twice_front + seen.twice_backfacing_of_many(degree, |i| series[i][j]));
        }
        areas
    }
}

/// k of the exponent k + 2 that u falls on, and how far it falls into it.
#[inline]
fn choose_exponent<T: Real>(n: usize, t: T, s2: T, z: T, u: T) -> (usize, T) {
    let seen = Seen::new(t, s2, z.abs());
    let front = if z < T::ZERO { T::ZERO } else { z };
    let weights = student_weights(n, t);
    let mut powers = [T::ONE; LARGEST_DEGREE + 1];
    for k in 1..=n {
        powers[k] = powers[k - 1] * seen.rho;
    }
    let mut areas = [T::ZERO; LARGEST_DEGREE + 1];
    let mut remainder = seen.remainder(n);
    for k in (0..=n).rev() {
        areas[k] = weights[k] * (front + T::HALF * seen.r * remainder);
        remainder += T::lit(ROOT_SERIES[k]) * powers[k];
    }
    pick(&areas[..=n], total(&areas[..=n]), u)
}

/// The sum of terms from the first to the last: [`pick`] relies on the order.
#[inline(always)]
fn total<T: Real>(terms: &[T]) -> T {
    terms.iter().fold(T::ZERO, |sum, &term| sum + term)
}

/// The term that u falls on, as a share of their [`total`], and how far it falls into it, in [0,
/// 1).
///
/// Terms that are lost in the rounding of the sum are not chosen, and u below ε/4 counts as ε/4: a
/// component of negligible share would give normals without density.
#[inline(always)]
fn pick<T: Real>(terms: &[T], total: T, u: T) -> (usize, T) {
    let least = T::lit(0.25) * T::EPSILON;
    let target = if u < least { least } else { u } * total;
    let (mut index, mut start, mut sum) = (0, T::ZERO, T::ZERO);
    for (j, &term) in terms.iter().enumerate() {
        let next = sum + term;
        if target >= sum && next > sum {
            (index, start) = (j, sum);
        }
        sum = next;
    }
    // Straight from below nothing is seen, and all terms are 0.
    let share = (target - start) / (terms[index] + T::MIN_POSITIVE);
    let largest = T::ONE - T::HALF * T::EPSILON;
    (index, if share > largest { largest } else { share })
}
