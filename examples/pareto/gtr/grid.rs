//! Where GTR's masks are compared: widths, exponents, directions, and the exact G1 there, computed
//! once for all.

use microsurface::Real;

use crate::measure::{Errors, degrees, directions, exactly};
use crate::reference::{LARGEST_GAMMA, Mixture};
use crate::{ALPHAS, Effort};

/// One γ and one width, with the exact G1 at the directions.
pub(crate) struct Point<T> {
    pub(crate) alpha: T,
    pub(crate) gamma: T,
    /// The width's index in [`ALPHAS`].
    pub(crate) width: usize,
    g1: Vec<f64>,
}

pub(crate) struct Grid<T: Real> {
    directions: Vec<T::Vec3>,
    /// By γ.
    pub(crate) points: Vec<Point<T>>,
}

/// γ in equal steps up to 4, and beyond, where few alternatives go, just above the integers and at
/// quarters.
fn gammas(per_unit: u32) -> Vec<f64> {
    let step = 1.0 / f64::from(per_unit);
    let mut gammas: Vec<f64> = (0..4 * per_unit).map(|i| step * f64::from(i)).collect();
    for integer in (4..LARGEST_GAMMA).map(f64::from) {
        gammas.extend([0.0, step, 0.5, 0.75].map(|fraction| integer + fraction));
    }
    gammas.push(LARGEST_GAMMA.into());
    gammas
}

impl<T: Real> Grid<T> {
    pub(crate) fn new(effort: &Effort) -> Self {
        let directions = directions::<T>(effort.angles);
        let mut points = Vec::new();
        for gamma in gammas(effort.gammas).into_iter().map(T::lit) {
            for (width, alpha) in ALPHAS.map(T::lit).into_iter().enumerate() {
                let mixture = Mixture::new(alpha.to_f64(), gamma.to_f64());
                let exact = |&w| {
                    let (s2, z) = exactly::<T>(w);
                    1.0 / (1.0 + mixture.lambda(s2, z))
                };
                points.push(Point { alpha, gamma, width, g1: directions.iter().map(exact).collect() });
            }
        }
        Self { directions, points }
    }

    /// The errors of a mask at a point.
    pub(crate) fn errors(&self, point: &Point<T>, g1: impl Fn(T::Vec3) -> T) -> Errors {
        let mut errors = Errors::default();
        for (&w, &exact) in self.directions.iter().zip(&point.g1) {
            errors.add(g1(w).to_f64() - exact, || {
                let (alpha, gamma) = (ALPHAS[point.width], point.gamma.to_f64());
                format!("α = {alpha}, γ = {gamma:.2}, θ = {:.2}°", degrees(exactly::<T>(w)))
            });
        }
        errors
    }
}
