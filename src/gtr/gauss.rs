//! Gauss quadrature for a discrete measure: the fewest points that integrate as many polynomials as
//! possible.
//!
//! The three-term recurrence of the polynomials orthogonal to the measure is found by the Stieltjes
//! procedure, and its Jacobi matrix diagonalised by the implicit QL algorithm (Golub and Welsch
//! 1969, "Calculation of Gauss quadrature rules"; Gautschi 2004, "Orthogonal Polynomials", §2.2 and
//! §3.1).

use crate::Real;

/// The abscissae, ascending, and weights, which sum to 1, of the `N`-point rule of the measure that
/// has `weights` at `x`.
///
/// A measure of fewer than `N` points, to rounding, has that many points in the rule; the others
/// have no weight.
pub(super) fn gauss<const N: usize>(x: &[f64], weights: &[f64]) -> ([f64; N], [f64; N]) {
    let (diagonal, off_diagonal) = recurrence::<N>(x, weights);
    eigenvalues(diagonal, off_diagonal)
}

/// As many points as a measure may have.
pub(super) const MOST_POINTS: usize = 128;

/// The Jacobi matrix: its diagonal, and below the diagonal, of which the last number is not used.
fn recurrence<const N: usize>(x: &[f64], weights: &[f64]) -> ([f64; N], [f64; N]) {
    let count = x.len().min(MOST_POINTS);
    let (x, weights) = (&x[..count], &weights[..count]);
    let (mut before, mut polynomial) = ([0.0; MOST_POINTS], [1.0; MOST_POINTS]);
    let (mut diagonal, mut off_diagonal) = ([x[0]; N], [0.0; N]);
    let mut norm = 0.0;
    for k in 0..N {
        let values = &mut polynomial[..count];
        let square: f64 = values.iter().zip(weights).map(|(p, w)| w * p * p).sum();
        let next_norm = Real::sqrt(square);
        if next_norm == 0.0 {
            break;
        }
        let inverse = 1.0 / next_norm;
        // The first norm is that of the measure.
        if k > 0 {
            norm = next_norm;
            off_diagonal[k - 1] = norm;
        }
        let mut mean = 0.0;
        for ((p, w), x) in values.iter_mut().zip(weights).zip(x) {
            *p *= inverse;
            mean += w * *p * *p * x;
        }
        diagonal[k] = mean;
        for ((p, before), x) in values.iter_mut().zip(&mut before).zip(x) {
            (*p, *before) = ((x - mean) * *p - norm * *before, *p);
        }
    }
    (diagonal, off_diagonal)
}

/// The eigenvalues of a symmetric tridiagonal matrix and the squares of the first components of its
/// eigenvectors.
fn eigenvalues<const N: usize>(mut d: [f64; N], mut e: [f64; N]) -> ([f64; N], [f64; N]) {
    /// Far more than QL takes; with as many the matrix is diagonal to rounding.
    const MOST_SWEEPS: usize = 60;
    let mut first = [0.0; N];
    first[0] = 1.0;
    for l in 0..N {
        for _ in 0..MOST_SWEEPS {
            let negligible = |i: &usize| e[*i].abs() <= f64::EPSILON * (d[*i].abs() + d[i + 1].abs());
            let m = (l..N - 1).find(negligible).unwrap_or(N - 1);
            if m == l {
                break;
            }
            sweep(&mut d, &mut e, &mut first, l, m);
        }
    }
    let mut order: [usize; N] = core::array::from_fn(|i| i);
    order.sort_unstable_by(|&i, &j| d[i].total_cmp(&d[j]));
    (order.map(|i| d[i]), order.map(|i| first[i] * first[i]))
}

/// One implicit QL step on the rows l … m.
fn sweep<const N: usize>(d: &mut [f64; N], e: &mut [f64; N], first: &mut [f64; N], l: usize, m: usize) {
    // Wilkinson's shift.
    let half = (d[l + 1] - d[l]) / (2.0 * e[l]);
    let root = Real::sqrt(half * half + 1.0);
    let mut g = d[m] - d[l] + e[l] / (half + root.copysign(half));
    let (mut sin, mut cos, mut shift) = (1.0, 1.0, 0.0);
    for i in (l..m).rev() {
        let f = sin * e[i];
        let b = cos * e[i];
        let radius = Real::sqrt(f * f + g * g);
        e[i + 1] = radius;
        if radius == 0.0 {
            d[i + 1] -= shift;
            e[m] = 0.0;
            return;
        }
        sin = f / radius;
        cos = g / radius;
        let difference = d[i + 1] - shift;
        let sum = (d[i] - difference) * sin + 2.0 * cos * b;
        shift = sin * sum;
        d[i + 1] = difference + shift;
        g = cos * sum - b;
        (first[i], first[i + 1]) = (cos * first[i] - sin * first[i + 1], sin * first[i] + cos * first[i + 1]);
    }
    d[l] -= shift;
    e[l] = g;
    e[m] = 0.0;
}
