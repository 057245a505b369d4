//! Interpolation of a function that a material fixes, once, at Chebyshev's points.

use crate::Real;
use crate::elementary::polynomial::polynomial_of;
use crate::real::construction::cos;

/// A polynomial in x ∈ [−1, 1] of up to `N` coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interpolant<T, const N: usize> {
    coefficients: [T; N],
}

/// A small integer as it is.
#[expect(clippy::cast_precision_loss, reason = "no integer here is above a few hundred")]
pub(crate) const fn number(n: usize) -> f64 {
    n as f64
}

impl<T: Real, const N: usize> Interpolant<T, N> {
    /// The polynomials of `count` coefficients, at least 2, that have the values of each part of
    /// `function` at Chebyshev's points.
    pub(crate) fn of_parts<const K: usize>(
        count: usize,
        mut function: impl FnMut(f64) -> [f64; K],
    ) -> [Self; K] {
        let step = core::f64::consts::PI / number(count);
        // Of a quarter of a turn; the others have the same but for signs.
        let mut waves = [0.0; N];
        for (i, wave) in waves[..count].iter_mut().enumerate() {
            *wave = cos(0.5 * step * number(i));
        }
        let wave = |k: usize, j: usize| {
            let turn = (k * (2 * j + 1)) % (4 * count);
            let half = if turn > 2 * count { 4 * count - turn } else { turn };
            let quarter = if half > count { 2 * count - half } else { half };
            let wave = if quarter == count { 0.0 } else { waves[quarter] };
            if half > count { -wave } else { wave }
        };
        let mut values = [[0.0; N]; K];
        for j in 0..count {
            let parts = function(cos(step * (number(j) + 0.5)));
            for (values, part) in values.iter_mut().zip(parts) {
                values[j] = part;
            }
        }
        // Chebyshev coefficients, and by them the powers: T₀ = 1, T₁ = x, Tₖ₊₁ = 2x Tₖ − Tₖ₋₁.
        let mut powers = [[0.0; N]; K];
        let (mut last, mut next) = ([0.0; N], [0.0; N]);
        (last[0], next[1]) = (1.0, 1.0);
        for k in 0..count {
            let mut sums = [0.0; K];
            for j in 0..count {
                for (sum, values) in sums.iter_mut().zip(&values) {
                    *sum += wave(k, j) * values[j];
                }
            }
            let scale = if k == 0 { 1.0 } else { 2.0 } / number(count);
            for (powers, sum) in powers.iter_mut().zip(sums) {
                for (power, t) in powers.iter_mut().zip(&last) {
                    *power += scale * sum * t;
                }
            }
            let mut after = [0.0; N];
            for i in 0..count {
                let shifted = if i > 0 { next[i - 1] } else { 0.0 };
                after[i] = 2.0 * shifted - last[i];
            }
            (last, next) = (next, after);
        }
        powers.map(|powers| Self { coefficients: powers.map(T::lit) })
    }

    /// The value at x by its first `count` coefficients, in the arithmetic of `W`.
    #[inline(always)]
    pub(crate) fn at<W: Real>(&self, count: usize, x: W) -> W {
        polynomial_of(x, count, |i| W::lit(self.coefficients[i].to_f64()))
    }
}
