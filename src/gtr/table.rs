//! GTR of a width that differs at every point of a surface.
//!
//! A Gauss rule takes microseconds, as long as hundreds of evaluations, and a textured α would pay
//! for it at every hit. For one γ the nodes and weights are smooth functions of ln α: [`GtrTable`]
//! holds them at 80 equidistant knots and interpolates by cubics.
//!
//! # Accuracy
//! The largest |ΔG1| of 8 nodes found, tables from α = 0.001 to 1: 8e-6 for γ ≤ 2, 1.2e-5 for γ ≤ 4
//! (γ = 3.1, α = 0.965), 1.6e-4 for γ ≤ 10 (γ just above 9, α = 0.965), near both ends of the
//! table. D is as exact as that of [`Gtr::isotropic`](crate::Gtr::isotropic), and of its formula.

use crate::Real;
use crate::error::Error;
use crate::gtr::integer::number;
use crate::gtr::measure::covered;
use crate::gtr::nodes::{GgxNodes, LARGEST_HEAVY, Nodes, rule};
use crate::gtr::{Density, Gtr, range_and_log, width};
use crate::map::Isotropic;
use crate::microsurface::Microsurface;
use crate::real::construction;

/// The knots of a table.
const KNOTS: usize = 80;

/// GTR under the identity.
type Surface<T, K> = Microsurface<Gtr<T, K>, Isotropic<T>>;

/// GTR of one γ for many α, with masks of `N` nodes.
///
/// A table of 8 nodes takes 5 kB (f32) or 10 kB (f64) and half a millisecond to make; a surface
/// from it about as long as a logarithm and an exponential. Visible normals are those of the exact
/// density, drawn from components that are made for each sample.
///
/// # Example
/// ```
/// use microsurface::{Gtr, Ndf, glam::Vec3, gtr::table::GtrTable};
/// let table = GtrTable::<f32, 8>::new(1.5, 1e-3)?; // once per material
/// let at_a_hit = table.isotropic(0.237)?;
/// let w = Vec3::new(0.8, 0.0, 0.6);
/// assert!((at_a_hit.g1(w, w) - Gtr::isotropic(0.237_f32, 1.5)?.g1(w, w)).abs() < 1e-5);
/// assert_eq!(at_a_hit.d(w), Gtr::isotropic(0.237_f32, 1.5)?.d(w));
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GtrTable<T, const N: usize> {
    gamma: T,
    degree: usize,
    smallest_alpha: T,
    /// ln α² of the first knot, and knots per unit of it.
    first: f64,
    density: f64,
    knots: [Knot<T, N>; KNOTS],
}

/// The rule at one α.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Knot<T, const N: usize> {
    widths2: [T; N],
    weights: [T; N],
}

impl<T: Real, const N: usize> GtrTable<T, N> {
    /// The table of γ for α from `smallest_alpha` to 1.
    ///
    /// # Errors
    /// [`Error::Gamma`] unless 0 ≤ γ ≤ 10; [`Error::Alpha`] or [`Error::AlphaAboveOne`] unless
    /// 1e-4 ≤ `smallest_alpha` ≤ 1: the knots of a longer table would be too far apart.
    pub fn new(gamma: T, smallest_alpha: T) -> Result<Self, Error> {
        let (exponent, smallest_alpha) = (covered(gamma)?, width(smallest_alpha)?);
        if smallest_alpha < T::lit(SMALLEST_ALPHA) {
            return Err(Error::Alpha {
                value: smallest_alpha.to_f64(),
                smallest: SMALLEST_ALPHA,
                largest: 1.0,
            });
        }
        // A table of no extent would have no knots apart.
        let first = (2.0 * construction::ln(smallest_alpha.to_f64())).min(-SHORTEST);
        let density = number(KNOTS - 1) / -first;
        let mut degree = 0;
        let knots = core::array::from_fn(|i| {
            // At α = 1 all nodes coincide; their weights are those of the limit.
            let log = (first * number(KNOTS - 1 - i) / number(KNOTS - 1)).min(-1e-3 * SHORTEST);
            let (n, t, weights) = rule::<N>(construction::exp(0.5 * log), exponent);
            degree = n;
            Knot { widths2: t.map(T::lit), weights: weights.map(T::lit) }
        });
        Ok(Self { gamma, degree, smallest_alpha, first, density, knots })
    }

    /// γ.
    #[inline]
    #[must_use]
    pub fn gamma(&self) -> T {
        self.gamma
    }

    /// GTR of width α.
    ///
    /// # Errors
    /// [`Error::Alpha`] unless the table reaches down to α, [`Error::AlphaAboveOne`] for α > 1.
    #[inline(always)]
    pub fn isotropic(&self, alpha: T) -> Result<Surface<T, Nodes<T, N>>, Error> {
        self.surface(alpha, |degree, widths2, weights| Nodes::of_rule(degree, widths2, weights))
    }

    /// The surface of a table of γ ≤ 2, with the smaller mask.
    ///
    /// # Errors
    /// As [`isotropic`](Self::isotropic), and [`Error::Gamma`] for γ > 2.
    #[inline(always)]
    pub fn heavy_tailed(&self, alpha: T) -> Result<Surface<T, GgxNodes<T, N>>, Error> {
        if self.degree > 0 {
            return Err(Error::Gamma { value: self.gamma.to_f64(), largest: LARGEST_HEAVY });
        }
        self.surface(alpha, |_, widths2, weights| GgxNodes::of_rule(widths2, weights))
    }

    #[inline(always)]
    fn surface<K>(
        &self,
        alpha: T,
        masking: impl Fn(usize, [T; N], [T; N]) -> K,
    ) -> Result<Surface<T, K>, Error> {
        let alpha = width(alpha)?;
        if alpha < self.smallest_alpha {
            let [value, smallest] = [alpha, self.smallest_alpha].map(T::to_f64);
            return Err(Error::Alpha { value, smallest, largest: 1.0 });
        }
        let (range, log) = range_and_log(alpha.to_f64());
        let density = Density::of_log(alpha, self.gamma, (range, log))?;
        let (widths2, weights) = self.rule(log);
        let masking = masking(self.degree, widths2, weights);
        Ok(Microsurface::new(Gtr { density, masking }, Isotropic::new(T::ONE)?))
    }

    /// The squared widths and weights at an ln α² within the table.
    #[inline(always)]
    fn rule(&self, log: f64) -> ([T; N], [T; N]) {
        let position = (log - self.first) * self.density;
        // The knot at or below, with one before and two after it.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 … KNOTS − 1, rounded down"
        )]
        let start = (position as usize).clamp(1, KNOTS - 3);
        let x = T::lit(position - number(start));
        let [before, after, beyond] = [x + T::ONE, x - T::ONE, x - T::TWO];
        // Lagrange's cubics of the knots −1, 0, 1, 2.
        let sixth = T::lit(1.0 / 6.0);
        let cubics = [
            -sixth * x * after * beyond,
            T::HALF * before * after * beyond,
            -T::HALF * before * x * beyond,
            sixth * before * x * after,
        ];
        let (mut widths2, mut weights) = ([T::ZERO; N], [T::ZERO; N]);
        for (knot, cubic) in self.knots[start - 1..start + 3].iter().zip(cubics) {
            for j in 0..N {
                widths2[j] += cubic * knot.widths2[j];
                weights[j] += cubic * knot.weights[j];
            }
        }
        (widths2, weights)
    }
}

/// The smallest α of a table.
const SMALLEST_ALPHA: f64 = 1e-4;

/// The shortest extent of a table in ln α².
const SHORTEST: f64 = 1e-2;
