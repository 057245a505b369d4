//! The papers' mask of GTR for real γ: a natural cubic spline through the exact masks of γ = 0, 1,
//! 2, 3, 4.
//!
//! With the masks Sₖ(μ) as values at the equidistant knots k, a natural spline is a linear
//! combination G1 = Σₖ wₖ(γ) Sₖ(μ) whose weights depend on γ alone: they are computed when the
//! surface is built.
//!
//! # Accuracy
//! max |ΔG1| against the exact mask over γ ∈ [0, 4] and all angles: 0.336 at α = 0.001, 0.170 at
//! 0.01, 0.059 at 0.05, 0.029 at 0.1, 0.012 at 0.2, 0.003 at 0.4, 1.6e-4 at 0.8, at γ ≈ 1.4 for
//! small α and 0.4 for large; exact at the knots. As a maximum, the 0.1 % that Dimov reports as a
//! mean is reached between α = 0.4 and 0.8.
//!
//! The spline overshoots: at α = 0.01 it ranges from −0.035 to 1.059, at 0.001 from −0.099 to
//! 1.092. [`Spline::g1`] returns it as it is; the surface limits it to [S₀, 1], the range of all
//! GTR masks, so that no radiance is negative and σ ≥ z.
//!
//! References: Dimov 2015, §5; Atanasov, Koylazov, Dimov and Wilkie 2022, Appendix A.

use crate::Real;
use crate::error::Error;
use crate::gtr::closed::Closed;
use crate::gtr::{Gtr, Masking};
use crate::map::Isotropic;
use crate::microsurface::Microsurface;
use crate::ndf::staged::Forms;

/// Dimov's interpolated mask.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spline<T> {
    weights: [T; 5],
    gamma0: Closed<T, 0>,
    gamma1: Closed<T, 1>,
    gamma2: Closed<T, 2>,
    gamma3: Closed<T, 3>,
    gamma4: Closed<T, 4>,
}

/// The second derivatives m₁, m₂, m₃ of a natural spline (m₀ = m₄ = 0) solve tridiag(1, 4, 1) m = 6
/// Δ²S; this is the inverse of that matrix, times 56.
const INVERSE: [[f64; 3]; 3] = [[15.0, -4.0, 1.0], [-4.0, 16.0, -4.0], [1.0, -4.0, 15.0]];

/// The second derivative at `knot` of the spline that is 1 at the knot `k` and 0 at the others.
fn second_derivative(knot: usize, k: usize) -> f64 {
    if knot == 0 || knot == 4 {
        return 0.0;
    }
    let second_difference = |j: usize| match j.abs_diff(k) {
        0 => -2.0,
        1 => 1.0,
        _ => 0.0,
    };
    (1..4).map(|j| 6.0 / 56.0 * INVERSE[knot - 1][j - 1] * second_difference(j)).sum()
}

/// The weights of the five knots at `gamma` ∈ [0, 4].
fn weights(gamma: f64) -> [f64; 5] {
    let left = usize::from(gamma >= 1.0) + usize::from(gamma >= 2.0) + usize::from(gamma >= 3.0);
    let t = gamma - [0.0, 1.0, 2.0, 3.0][left];
    let s = 1.0 - t;
    core::array::from_fn(|k| {
        let linear = if k == left {
            s
        } else if k == left + 1 {
            t
        } else {
            0.0
        };
        linear
            + (s * s * s - s) / 6.0 * second_derivative(left, k)
            + (t * t * t - t) / 6.0 * second_derivative(left + 1, k)
    })
}

impl<T: Real> Spline<T> {
    /// The spline's G1(μ) as the papers have it, at a direction of cosine z > 0 and s² = |M⁻¹
    /// w_xy|².
    ///
    /// # Returns
    /// May leave [0, 1]: see the [module](self).
    #[inline(always)]
    #[must_use]
    pub fn g1(&self, s2: T, z: T) -> T {
        z * self.reciprocal_sigma(s2, z)
    }

    /// Σ wₖ/σₖ = G1/z, finite at the horizon.
    #[inline(always)]
    fn reciprocal_sigma(&self, s2: T, z: T) -> T {
        let w = &self.weights;
        w[0] / self.gamma0.sigma_above(s2, z)
            + w[1] / self.gamma1.sigma_above(s2, z)
            + w[2] / self.gamma2.sigma_above(s2, z)
            + w[3] / self.gamma3.sigma_above(s2, z)
            + w[4] / self.gamma4.sigma_above(s2, z)
    }
}

impl<T: Real> Forms for Spline<T> {}

impl<T: Real> Masking<T> for Spline<T> {
    fn new(alpha: T, gamma: T) -> Result<Self, Error> {
        let g = gamma.to_f64();
        if !(0.0..=LARGEST_GAMMA).contains(&g) {
            return Err(Error::Gamma { value: g, largest: LARGEST_GAMMA });
        }
        Ok(Self {
            weights: weights(g).map(T::lit),
            gamma0: Closed::new(alpha, T::lit(0.0))?,
            gamma1: Closed::new(alpha, T::lit(1.0))?,
            gamma2: Closed::new(alpha, T::lit(2.0))?,
            gamma3: Closed::new(alpha, T::lit(3.0))?,
            gamma4: Closed::new(alpha, T::lit(4.0))?,
        })
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        let lowest = T::ONE / self.gamma0.sigma_above(s2, z);
        let reciprocal = self.reciprocal_sigma(s2, z);
        let limited = if reciprocal < lowest { lowest } else { reciprocal };
        let sigma = T::ONE / limited;
        if sigma < z { z } else { sigma }
    }

    /// The difference σ − z: its error is the spline's, far above the rounding.
    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        self.sigma_above(s2, z) - z
    }
}

impl<T: Real> Gtr<T, Spline<T>> {
    /// GTR with the interpolated mask of the papers, 0 ≤ γ ≤ 4.
    ///
    /// # Errors
    /// [`Error::Alpha`] or [`Error::AlphaAboveOne`] unless 0 < α ≤ 1, [`Error::Gamma`] unless 0 ≤ γ
    /// ≤ 4.
    ///
    /// # Example
    /// ```
    /// use microsurface::{Gtr, Ndf, glam::Vec3};
    /// let surface = Gtr::spline(0.3_f32, 1.4)?;
    /// assert!(surface.d(Vec3::Z) > 0.0 && surface.g1(Vec3::new(0.8, 0.0, 0.6), Vec3::Z) < 1.0);
    /// assert!(Gtr::spline(0.3_f32, 4.5).is_err());
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    pub fn spline(alpha: T, gamma: T) -> Result<Microsurface<Self, Isotropic<T>>, Error> {
        Self::surface(alpha, gamma)
    }
}

/// The last knot.
const LARGEST_GAMMA: f64 = 4.0;
