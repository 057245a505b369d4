//! Beckmann after Walter 2007 (Eqs. 25 and 27), Heitz and d'Eon 2014 and Jakob 2014.

use microsurface::Real;
use microsurface::elementary::{erf, erf_inv};

use super::{Elementary, Width, cos2, normalized, reflection as reflection_of, tan2};

/// D = e^{−tan²/α²}/(π α² cos⁴): Walter 2007, Eq. 25.
#[inline(always)]
pub(crate) fn d<T: Elementary>(Width { alpha }: Width<T>, wm: [T; 3]) -> T {
    if wm[2] <= T::ZERO {
        return T::ZERO;
    }
    let alpha2 = alpha * alpha;
    let cos4 = cos2(wm) * cos2(wm);
    (-tan2(wm) / alpha2).exp() / (T::PI * alpha2 * cos4)
}

/// Λ of the rational approximation of G1 of Walter 2007, Eq. 27.
#[inline(always)]
pub(crate) fn lambda_walter2007<T: Real>(Width { alpha }: Width<T>, w: [T; 3]) -> T {
    let a = T::ONE / (alpha * tan2(w).sqrt());
    if a >= T::lit(1.6) {
        return T::ZERO;
    }
    (T::ONE - T::lit(1.259) * a + T::lit(0.396) * a * a) / (T::lit(3.535) * a + T::lit(2.181) * a * a)
}

/// Λ = (e^{−a²}/(a√π) − erfc a)/2: Heitz 2014, Eq. 66.
#[inline(always)]
pub(crate) fn lambda<T: Elementary>(Width { alpha }: Width<T>, w: [T; 3]) -> T {
    let a = T::ONE / (alpha * tan2(w).sqrt());
    ((-a * a).exp() / (a * T::SQRT_PI) - (T::ONE - erf(a))) * T::HALF
}

#[inline(always)]
pub(crate) fn reflection<T: Elementary>(width: Width<T>, f0: T, wi: [T; 3], wo: [T; 3]) -> T {
    reflection_of(f0, wi, wo, |m| d(width, m), |w| lambda(width, w))
}

#[inline(always)]
pub(crate) fn reflection_walter2007<T: Elementary>(width: Width<T>, f0: T, wi: [T; 3], wo: [T; 3]) -> T {
    reflection_of(f0, wi, wo, |m| d(width, m), |w| lambda_walter2007(width, w))
}

/// Heitz and d'Eon 2014, §4.1, the slope along the view inverted as in Jakob 2014, "An improved
/// visible normal sampling routine for the Beckmann distribution": Newton's iteration for b =
/// erf(slope), guarded by bisection, until the distribution function is met to 1e-5 or ten steps
/// are done; by these error functions.
#[inline(always)]
pub(crate) fn visible_normal_jakob2014<T: Elementary>(
    width: Width<T>,
    w: [T; 3],
    u: [T; 2],
    erf: impl Fn(T) -> T + Copy,
    erf_inv: impl Fn(T) -> T + Copy,
) -> [T; 3] {
    visible_normal(width, w, u, erf_inv, |cos, sin, u| slope_jakob2014(cos, sin, u, erf, erf_inv))
}

/// The sampler of Mitsuba: another start, without jumps in u, and three steps of Newton's without a
/// guard.
#[inline(always)]
pub(crate) fn visible_normal_mitsuba<T: Elementary>(width: Width<T>, w: [T; 3], u: [T; 2]) -> [T; 3] {
    visible_normal(width, w, u, erf_inv, slope_mitsuba)
}

/// A normal of the slope `along` the view of cosine, sine and number.
#[inline(always)]
fn visible_normal<T: Elementary>(
    Width { alpha }: Width<T>,
    w: [T; 3],
    [u1, u2]: [T; 2],
    erf_inv: impl Fn(T) -> T,
    along: impl Fn(T, T, T) -> T,
) -> [T; 3] {
    let view = normalized([alpha * w[0], alpha * w[1], w[2]]);
    let sin = (view[0] * view[0] + view[1] * view[1]).sqrt();
    let [cos_phi, sin_phi] = if sin > T::ZERO { [view[0] / sin, view[1] / sin] } else { [T::ONE, T::ZERO] };
    let along = along(view[2], sin, u1.max(T::lit(1e-6)));
    let across = erf_inv(T::TWO * u2.max(T::lit(1e-6)) - T::ONE);
    let [x, y] = [cos_phi * along - sin_phi * across, sin_phi * along + cos_phi * across];
    normalized([-alpha * x, -alpha * y, T::ONE])
}

#[inline(always)]
fn slope_mitsuba<T: Elementary>(cos: T, sin: T, u: T) -> T {
    let (tan, cot, one) = (sin / cos, cos / sin, T::ONE);
    let u = u.min(one - T::lit(1e-6));
    let start = erf(cot);
    let scale = tan * T::FRAC_1_SQRT_PI;
    let mut b = start - (start + one) * erf((-u.ln()).sqrt());
    let mass = u * (one + start + scale * (-cot * cot).exp());
    for _ in 0..3 {
        let slope = erf_inv(b);
        b -= (one + b + scale * (-slope * slope).exp() - mass) / (one - slope * tan);
    }
    erf_inv(b)
}

#[inline(always)]
fn slope_jakob2014<T: Elementary>(cos: T, sin: T, u: T, erf: impl Fn(T) -> T, erf_inv: impl Fn(T) -> T) -> T {
    let tan = sin / cos;
    let cot = cos / sin;
    let one = T::ONE;
    let mut low = -one;
    let mut high = erf(cot);
    let start = high;
    let theta = cos.acos();
    // The fit of the starting point, printed there.
    let exponent = one + theta * (T::lit(-0.876) + theta * (T::lit(0.4265) - T::lit(0.0594) * theta));
    let mut b = start - (one + start) * (one - u).powf(exponent);
    let scale = tan * T::FRAC_1_SQRT_PI;
    let norm = one / (one + start + scale * (-cot * cot).exp());
    for _ in 0..10 {
        if !(b >= low && b <= high) {
            b = T::HALF * (low + high);
        }
        let slope = erf_inv(b);
        let excess = norm * (one + b + scale * (-slope * slope).exp()) - u;
        let derivative = norm * (one - slope * tan);
        if excess.abs() < T::lit(1e-5) {
            break;
        }
        if excess > T::ZERO {
            high = b;
        } else {
            low = b;
        }
        b -= excess / derivative;
    }
    erf_inv(b)
}
