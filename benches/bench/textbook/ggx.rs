//! GGX after Walter 2007 (Eqs. 33–34), Burley 2012, Heitz 2014 and 2018, and Dupuy and
//! Benyoub 2023.

use microsurface::Real;

use super::{
    Anisotropic, Elementary, Width, cos_phi, cos2, cross, dot, normalized, reflection as reflection_of,
    schlick, sin_phi, tan2,
};

/// D = α²/(π cos⁴ (α² + tan²)²): Walter 2007, Eq. 33.
#[inline(always)]
pub(crate) fn d<T: Real>(Width { alpha }: Width<T>, wm: [T; 3]) -> T {
    if wm[2] <= T::ZERO {
        return T::ZERO;
    }
    let alpha2 = alpha * alpha;
    let sum = alpha2 + tan2(wm);
    let cos4 = cos2(wm) * cos2(wm);
    alpha2 / (T::PI * cos4 * (sum * sum))
}

/// D = 1/(π αx αy cos⁴ (1 + tan² (cos²φ/αx² + sin²φ/αy²))²): Heitz 2014, Eq. 85.
#[inline(always)]
pub(crate) fn d_anisotropic<T: Real>(Anisotropic { alpha_x, alpha_y }: Anisotropic<T>, wm: [T; 3]) -> T {
    if wm[2] <= T::ZERO {
        return T::ZERO;
    }
    let (along_x, along_y) = (cos_phi(wm) / alpha_x, sin_phi(wm) / alpha_y);
    let sum = T::ONE + tan2(wm) * (along_x * along_x + along_y * along_y);
    let cos4 = cos2(wm) * cos2(wm);
    T::ONE / (T::PI * alpha_x * alpha_y * cos4 * (sum * sum))
}

/// Λ = (−1 + √(1 + α² tan²))/2: Heitz 2014, Eq. 72.
#[inline(always)]
pub(crate) fn lambda<T: Real>(Width { alpha }: Width<T>, w: [T; 3]) -> T {
    (-T::ONE + (T::ONE + alpha * alpha * tan2(w)).sqrt()) * T::HALF
}

/// The same with the width of the azimuth, α² = αx² cos²φ + αy² sin²φ: Heitz 2014, Eqs. 80 and 87.
#[inline(always)]
pub(crate) fn lambda_anisotropic<T: Real>(Anisotropic { alpha_x, alpha_y }: Anisotropic<T>, w: [T; 3]) -> T {
    let (along_x, along_y) = (alpha_x * cos_phi(w), alpha_y * sin_phi(w));
    (-T::ONE + (T::ONE + (along_x * along_x + along_y * along_y) * tan2(w)).sqrt()) * T::HALF
}

#[inline(always)]
pub(crate) fn reflection<T: Real>(width: Width<T>, f0: T, wi: [T; 3], wo: [T; 3]) -> T {
    reflection_of(f0, wi, wo, |m| d(width, m), |w| lambda(width, w))
}

#[inline(always)]
pub(crate) fn reflection_anisotropic<T: Real>(widths: Anisotropic<T>, f0: T, wi: [T; 3], wo: [T; 3]) -> T {
    reflection_of(f0, wi, wo, |m| d_anisotropic(widths, m), |w| lambda_anisotropic(widths, w))
}

/// Heitz 2018, "Sampling the GGX distribution of visible normals", JCGT 7(4), §3: stretch the view,
/// build a basis about it, warp a disc, lift it to the hemisphere, unstretch.
#[inline(always)]
pub(crate) fn visible_normal_heitz2018<T: Elementary>(
    Anisotropic { alpha_x, alpha_y }: Anisotropic<T>,
    w: [T; 3],
    [u1, u2]: [T; 2],
) -> [T; 3] {
    let view = normalized([alpha_x * w[0], alpha_y * w[1], w[2]]);
    let across2 = view[0] * view[0] + view[1] * view[1];
    let first = if across2 > T::ZERO {
        let inv = T::ONE / across2.sqrt();
        [-view[1] * inv, view[0] * inv, T::ZERO]
    } else {
        [T::ONE, T::ZERO, T::ZERO]
    };
    let second = cross(view, first);

    let radius = u1.sqrt();
    let phi = T::TWO * T::PI * u2;
    let t1 = radius * phi.cos();
    let s = T::HALF * (T::ONE + view[2]);
    let t2 = (T::ONE - s) * (T::ONE - t1 * t1).sqrt() + s * (radius * phi.sin());

    let t3 = (T::ONE - t1 * t1 - t2 * t2).max(T::ZERO).sqrt();
    let normal = [0, 1, 2].map(|i| t1 * first[i] + t2 * second[i] + t3 * view[i]);
    normalized([alpha_x * normal[0], alpha_y * normal[1], normal[2].max(T::ZERO)])
}

/// Dupuy and Benyoub 2023, "Sampling visible GGX normals with spherical caps", as printed: a point
/// of the cap about the vertical that the stretched view bounds, and the half vector of both.
#[inline(always)]
pub(crate) fn visible_normal_dupuy2023<T: Elementary>(
    Anisotropic { alpha_x, alpha_y }: Anisotropic<T>,
    w: [T; 3],
    [u1, u2]: [T; 2],
) -> [T; 3] {
    let view = normalized([alpha_x * w[0], alpha_y * w[1], w[2]]);
    let phi = T::TWO * T::PI * u1;
    let z = (T::ONE - u2) * (T::ONE + view[2]) - view[2];
    let sin = (T::ONE - z * z).max(T::ZERO).min(T::ONE).sqrt();
    let half = [sin * phi.cos() + view[0], sin * phi.sin() + view[1], z + view[2]];
    normalized([alpha_x * half[0], alpha_y * half[1], half[2]])
}

/// A reflected direction by a visible normal, with the weight F G2/G1 and the density D G1/(4 cos):
/// Heitz 2018, §5.
#[inline(always)]
pub(crate) fn sampled_reflection_heitz2018<T: Elementary>(
    widths: Anisotropic<T>,
    f0: T,
    wo: [T; 3],
    u: [T; 2],
) -> Option<([T; 3], T, T)> {
    let wm = visible_normal_heitz2018(widths, wo, u);
    let cos = dot(wo, wm);
    let wi = [0, 1, 2].map(|i| T::TWO * cos * wm[i] - wo[i]);
    if wi[2] <= T::ZERO || wo[2] <= T::ZERO {
        return None;
    }
    let (lambda_i, lambda_o) = (lambda_anisotropic(widths, wi), lambda_anisotropic(widths, wo));
    let g1 = T::ONE / (T::ONE + lambda_o);
    let g2 = T::ONE / (T::ONE + lambda_i + lambda_o);
    let pdf = g1 * d_anisotropic(widths, wm) / (T::lit(4.0) * wo[2]);
    Some((wi, schlick(f0, cos) * g2 / g1, pdf))
}
