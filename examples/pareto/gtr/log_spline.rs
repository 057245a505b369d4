//! A spline over γ of ln Λ instead of G1: what the papers' interpolation could have been without
//! overshoot.

use microsurface::elementary::{exp, ln};
use microsurface::gtr::Gtr;
use microsurface::gtr::closed::Closed;
use microsurface::{Isotropic, Microsurface, Ndf, Real};

type Surface<T, const G: u8> = Microsurface<Gtr<T, Closed<T, G>>, Isotropic<T>>;

/// The mask whose ln Λ is the natural cubic spline through those of γ = 0, 1, 2, 3, 4: positive,
/// and exact at the knots.
#[derive(Clone, Copy)]
pub(crate) struct LogSpline<T: Real> {
    weights: [T; 5],
    gamma0: Surface<T, 0>,
    gamma1: Surface<T, 1>,
    gamma2: Surface<T, 2>,
    gamma3: Surface<T, 3>,
    gamma4: Surface<T, 4>,
}

impl<T: Real> LogSpline<T> {
    /// For γ up to 4.
    pub(crate) fn new(alpha: T, gamma: T) -> Option<Self> {
        if gamma.to_f64() > 4.0 {
            return None;
        }
        Some(Self {
            weights: weights(gamma.to_f64()).map(T::lit),
            gamma0: Gtr::closed(alpha).ok()?,
            gamma1: Gtr::closed(alpha).ok()?,
            gamma2: Gtr::closed(alpha).ok()?,
            gamma3: Gtr::closed(alpha).ok()?,
            gamma4: Gtr::closed(alpha).ok()?,
        })
    }

    /// G1 towards facets that face w.
    #[inline(always)]
    pub(crate) fn g1(&self, w: T::Vec3) -> T {
        let [w0, w1, w2, w3, w4] = self.weights;
        let log_lambda = w0 * ln(self.gamma0.lambda(w))
            + w1 * ln(self.gamma1.lambda(w))
            + w2 * ln(self.gamma2.lambda(w))
            + w3 * ln(self.gamma3.lambda(w))
            + w4 * ln(self.gamma4.lambda(w));
        T::ONE / (T::ONE + exp(log_lambda))
    }
}

/// The weights of the knots: the spline of values 1 at one knot and 0 at the others, at γ.
fn weights(gamma: f64) -> [f64; 5] {
    let knots = [0.0, 1.0, 2.0, 3.0, 4.0];
    core::array::from_fn(|k| {
        let value = |j: usize| if j == k { 1.0 } else { 0.0 };
        // Second derivatives: m₀ = m₄ = 0, mⱼ₋₁ + 4 mⱼ + mⱼ₊₁ = 6 Δ²ⱼ, by Gauss and Seidel's
        // iteration, which contracts by 8.
        let mut m = [0.0; 5];
        for _ in 0..40 {
            for j in 1..4 {
                let second_difference = value(j - 1) - 2.0 * value(j) + value(j + 1);
                m[j] = (6.0 * second_difference - m[j - 1] - m[j + 1]) / 4.0;
            }
        }
        let left = knots[1..4].iter().filter(|&&knot| knot <= gamma).count();
        let t = gamma - knots[left];
        let s = 1.0 - t;
        let bends = (s * s * s - s) * m[left] + (t * t * t - t) * m[left + 1];
        s * value(left) + t * value(left + 1) + bends / 6.0
    })
}
