//! Filters after Kaplanyan, Hill, Patney and Lefohn 2016.

use microsurface::Real;

use super::Elementary;

/// The least side of a rectangle: §5.2.
const EPSILON: f64 = 1e-3;

/// The mean of GGX over the bounding rectangle of the steps u and v of a footprint: Eq. 16 and
/// Appendix A, between h ± ½Δ as in Eq. 16.
#[inline(always)]
pub(crate) fn mean_of_rectangle<T: Elementary>(
    [alpha, beta]: [T; 2],
    [s, t]: [T; 2],
    [u, v]: [[T; 2]; 2],
) -> T {
    let [ds, dt] = [0, 1].map(|i| (u[i].abs() + v[i].abs()).max(T::lit(EPSILON)));
    let (s0, s1) = (s - T::HALF * ds, s + T::HALF * ds);
    let (t0, t1) = (t - T::HALF * dt, t + T::HALF * dt);
    let sum = phi(s0, t0, alpha, beta) - phi(s0, t1, alpha, beta) + phi(s1, t1, alpha, beta)
        - phi(s1, t0, alpha, beta)
        + phi(t0, s0, beta, alpha)
        - phi(t0, s1, beta, alpha)
        + phi(t1, s1, beta, alpha)
        - phi(t1, s0, beta, alpha);
    sum / (T::TWO * T::PI * (ds * dt).abs())
}

#[inline(always)]
fn phi<T: Elementary>(x: T, y: T, gamma: T, delta: T) -> T {
    let root = (x * x + gamma * gamma).sqrt();
    x * (gamma * y / (root * delta)).atan() / root
}

/// α' of the bounding rectangle, αᵢ'² = αᵢ² + min(2σ²Δᵢ², κ), σ² = ¼: Eq. 20, and P22 of GGX with
/// it.
#[inline(always)]
pub(crate) fn proxy_of_rectangle<T: Real>(alphas: [T; 2], slope: [T; 2], [u, v]: [[T; 2]; 2]) -> T {
    let squares = [0, 1].map(|i| {
        let extent = u[i].abs() + v[i].abs();
        alphas[i] * alphas[i] + (T::HALF * (extent * extent)).min(T::HALF)
    });
    let sum = T::ONE + slope[0] * slope[0] / squares[0] + slope[1] * slope[1] / squares[1];
    T::ONE / (T::PI * (squares[0] * squares[1]).sqrt() * (sum * sum))
}
