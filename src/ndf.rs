//! The traits of a normal distribution function: evaluation, and sampling of all or of visible
//! normals.

pub(crate) mod forwarded;
pub(crate) mod staged;

use crate::Real;
use crate::vector::{dot, normalized, positive_part, step};

/// The glam vector of two components that belongs to an NDF's scalar.
pub type Vec2<N> = <<N as Ndf>::Scalar as Real>::Vec2;
/// The glam vector of three components that belongs to an NDF's scalar.
pub type Vec3<N> = <<N as Ndf>::Scalar as Real>::Vec3;

/// A normal distribution function of a microsurface under Smith's assumption.
///
/// Directions are unit vectors of the local frame, z up, pointing away from the surface: `wo` to
/// the viewer, `wi` to the light, `wm` a micronormal, `w` either of the first two. The quantities
/// follow from two: the density D and the projected area σ(w) = ∫ D(wm) max(0, w·wm) dwm = w.z (1 +
/// Λ(w)). Because σ stays finite at the horizon, nothing here divides by a cosine.
///
/// | method | quantity | reference |
/// |---|---|---|
/// | [`d`](Self::d) | D(wm), area of facets with normal wm per macrosurface area and solid angle, 1/sr | Walter 2007, §3.1 |
/// | [`sigma`](Self::sigma) | σ(w), area of facets seen from w per macrosurface area | Heitz 2016, Eq. 2 |
/// | [`lambda`](Self::lambda) | Smith's Λ(w) = σ/z − 1 | Smith 1967, Heitz 2014 Eq. 43 |
/// | [`g1`](Self::g1) | masking | Heitz 2014, Eq. 43 |
/// | [`g2`](Self::g2) | height-correlated masking and shadowing | Heitz 2014, Eq. 99 |
/// | [`vndf`](Self::vndf) | density of visible normals D_w(wm) | Heitz 2014, Eq. 16 |
///
/// # Special cases
/// NaN in any argument gives NaN, unless another number alone makes the result 0, such as a z below
/// the horizon. Vectors that are not of unit length give meaningless numbers, never a panic.
///
/// # Example
/// A distribution of one's own needs two functions; masking, visible-normal density and the rest
/// follow.
/// ```
/// use microsurface::{Ggx, Ndf, glam::Vec3};
/// /// Half of the surface smooth, half rough.
/// struct Blend;
/// impl Ndf for Blend {
///     type Scalar = f32;
///     fn d(&self, wm: Vec3) -> f32 {
///         0.5 * (Ggx::isotropic(0.1).unwrap().d(wm) + Ggx::isotropic(0.5).unwrap().d(wm))
///     }
///     fn sigma(&self, w: Vec3) -> f32 {
///         0.5 * (Ggx::isotropic(0.1).unwrap().sigma(w) + Ggx::isotropic(0.5).unwrap().sigma(w))
///     }
/// }
/// let w = Vec3::new(0.8, 0.0, 0.6);
/// assert!((Blend.g1(w, Vec3::Z) - 1.0 / (1.0 + Blend.lambda(w))).abs() < 1e-6);
/// ```
#[doc(alias("normal distribution function", "microfacet", "masking", "Smith"))]
pub trait Ndf {
    /// f32 or f64.
    type Scalar: Real;

    /// The density D(wm) of micronormals, 1/sr.
    ///
    /// # Special cases
    /// wm.z < 0 → 0: no facet of a heightfield looks down.
    fn d(&self, wm: Vec3<Self>) -> Self::Scalar;

    /// The projected area σ(w) = ∫ D(wm) max(0, w·wm) dwm of the facets seen from w, without
    /// dimension.
    ///
    /// Defined on the whole sphere; σ(w) − σ(−w) = w.z.
    ///
    /// # Returns
    /// At least max(0, w.z).
    fn sigma(&self, w: Vec3<Self>) -> Self::Scalar;

    /// Smith's Λ(w) = σ(w)/w.z − 1, evaluated in a form that does not cancel: by default
    /// |w.z| Λ = σ of the direction below the horizon.
    ///
    /// # Returns
    /// 0 … ∞ above the horizon.
    ///
    /// # Special cases
    /// w.z = 0 → ∞; w.z < 0 → −1 − Λ(−w), as in Heitz 2016.
    #[inline(always)]
    fn lambda(&self, w: Vec3<Self>) -> Self::Scalar {
        let [x, y, z]: [Self::Scalar; 3] = w.into();
        let below = z < Self::Scalar::ZERO;
        let lambda = self.sigma(if below { w } else { [-x, -y, -z].into() }) / z.abs();
        if below { -Self::Scalar::ONE - lambda } else { lambda }
    }

    /// σ(w) for w on or above the horizon, without what only the lower half needs.
    ///
    /// # Domain
    /// w.z ≥ 0; elsewhere meaningless, and perhaps no number.
    #[inline(always)]
    fn sigma_above(&self, w: Vec3<Self>) -> Self::Scalar {
        self.sigma(w)
    }

    /// D in the direction of a vector that need not be normalised, such as the half vector wi + wo.
    ///
    /// A [`Microsurface`](crate::Microsurface) needs neither a square root nor a normalisation for
    /// it: its D is homogeneous.
    ///
    /// # Domain
    /// h.z ≥ 0, |h|² not overflowing and at least 2⁻⁶⁴ (f32) or 2⁻⁵¹² (f64).
    #[inline(always)]
    fn d_along(&self, h: Vec3<Self>) -> Self::Scalar {
        self.d(normalized(h.into()).into())
    }

    /// D along a vector m of this squared length, times a fraction, numerator and denominator: one
    /// quotient for both.
    ///
    /// # Domain
    /// As [`d_along`](Self::d_along).
    #[doc(hidden)]
    #[inline(always)]
    fn d_times(&self, m: Vec3<Self>, length2: Self::Scalar, fraction: [Self::Scalar; 2]) -> Self::Scalar {
        let d = if length2 == Self::Scalar::ONE { self.d(m) } else { self.d_along(m) };
        d * fraction[0] / fraction[1]
    }

    /// zi zo/G2 of two directions above the horizon, times [`cosine_scale`].
    #[doc(hidden)]
    #[inline(always)]
    fn masked_cosines(&self, wi: Vec3<Self>, wo: Vec3<Self>) -> Self::Scalar {
        let ([_, _, zi], [_, _, zo]): ([Self::Scalar; 3], [Self::Scalar; 3]) = (wi.into(), wo.into());
        masked_cosines(zi, zo, self.sigma_above(wi), self.sigma_above(wo))
    }

    /// The density P22 of slopes (−wm.x/wm.z, −wm.y/wm.z): D(wm) wm.z⁴.
    ///
    /// # Domain
    /// Any finite slope whose square does not overflow.
    ///
    /// # References
    /// Heitz 2014, Eq. 13.
    #[inline(always)]
    fn p22(&self, slope: Vec2<Self>) -> Self::Scalar {
        let [x, y]: [Self::Scalar; 2] = slope.into();
        let wm = normalized([-x, -y, Self::Scalar::ONE]);
        let z2 = wm[2] * wm[2];
        self.d(wm.into()) * z2 * z2
    }

    /// Smith's masking G1(w, wm) = χ⁺(w·wm) / (1 + Λ(w)) = χ⁺(w·wm) w.z/σ(w).
    ///
    /// # Returns
    /// 0 … 1.
    ///
    /// # Special cases
    /// w.z ≤ 0 or w·wm ≤ 0 → 0.
    #[inline(always)]
    fn g1(&self, w: Vec3<Self>, wm: Vec3<Self>) -> Self::Scalar {
        let v: [Self::Scalar; 3] = w.into();
        let g1 = step(dot(v, wm.into())) * (v[2] / self.sigma_above(w));
        if v[2] <= Self::Scalar::ZERO { Self::Scalar::ZERO } else { g1 }
    }

    /// Height-correlated masking and shadowing G2 = χ⁺ χ⁺ / (1 + Λ(wi) + Λ(wo)) of reflection.
    ///
    /// Evaluated as z/(σ(w) + z/z′ σ(w′) − z), with z the lower of both cosines: their product,
    /// which may underflow long before the result, is not formed.
    ///
    /// # Returns
    /// 0 … min(G1(wi), G1(wo)), above it by at most 4 ε of rounding, and never above 1.
    ///
    /// # Special cases
    /// A direction at or below the horizon, or on the back of wm → 0.
    ///
    /// # References
    /// Ross, Dion and Potvin 2005; Heitz 2014, Eq. 99.
    #[inline(always)]
    fn g2(&self, wi: Vec3<Self>, wo: Vec3<Self>, wm: Vec3<Self>) -> Self::Scalar {
        let (i, o, m): ([Self::Scalar; 3], [Self::Scalar; 3], _) = (wi.into(), wo.into(), wm.into());
        let (zi, zo) = (i[2], o[2]);
        let visible = step(dot(i, m)) * step(dot(o, m));
        // a and b are zi and zo over the higher of both.
        let (lower, higher) = if zo < zi { (zo, zi) } else { (zi, zo) };
        let (one, ratio) = (Self::Scalar::ONE, lower / higher);
        let (a, b) = if zo < zi { (one, ratio) } else { (ratio, one) };
        let g2 = lower / ((b * self.sigma_above(wi) + a * self.sigma_above(wo)) - lower);
        // Not above 1 by rounding.
        let g2 = if g2 > Self::Scalar::ONE { Self::Scalar::ONE } else { g2 };
        if zi <= Self::Scalar::ZERO || zo <= Self::Scalar::ZERO { Self::Scalar::ZERO } else { visible * g2 }
    }

    /// Separable masking and shadowing G1(wi, wm) G1(wo, wm): darker than [`g2`](Self::g2), which
    /// it bounds from below.
    #[inline(always)]
    fn g2_separable(&self, wi: Vec3<Self>, wo: Vec3<Self>, wm: Vec3<Self>) -> Self::Scalar {
        self.g1(wi, wm) * self.g1(wo, wm)
    }

    /// The density D_w(wm) = max(0, w·wm) D(wm)/σ(w) of the normals visible from w, 1/sr; it
    /// integrates to 1.
    ///
    /// # Domain
    /// w on the whole sphere, as far below the horizon as σ(w) ≥ 2⁻⁶³ (f32) or 2⁻⁵¹¹ (f64): nearer
    /// to the nadir nothing is visible to the precision of the scalar.
    ///
    /// # Special cases
    /// Where σ is 0 (w = −z) → 0.
    ///
    /// # References
    /// Heitz 2014, Eq. 16.
    #[inline(always)]
    fn vndf(&self, w: Vec3<Self>, wm: Vec3<Self>) -> Self::Scalar {
        let sigma = self.sigma(w);
        let m: [Self::Scalar; 3] = wm.into();
        let facing = positive_part(dot(w.into(), m));
        let density = self.d_times(wm, Self::Scalar::ONE, [facing, sigma]);
        let density = if m[2] < Self::Scalar::ZERO { Self::Scalar::ZERO } else { density };
        if sigma <= Self::Scalar::ZERO { Self::Scalar::ZERO } else { density }
    }
}

/// 2⁴⁰ (f32) or 2²⁷⁰ (f64).
#[inline(always)]
pub(crate) fn cosine_scale<T: Real>() -> T {
    T::lit(if T::WIDENS { 1099511627776.0 } else { 1.8971375900641885e81 })
}

/// zi zo/G2 = zo σ(wi) + zi σ(wo) − zi zo, times [`cosine_scale`]: above 0 for every positive
/// cosine, where the products themselves may be too small to be numbers.
#[inline(always)]
pub(crate) fn masked_cosines<T: Real>(zi: T, zo: T, sigma_i: T, sigma_o: T) -> T {
    let (scaled_i, scaled_o) = (cosine_scale::<T>() * zi, cosine_scale::<T>() * zo);
    scaled_o * sigma_i + scaled_i * sigma_o - scaled_i * zo
}

/// Sampling of all normals, with density D(wm) wm.z.
pub trait SampleNdf: Ndf {
    /// A micronormal of density D(wm) wm.z from two random numbers.
    ///
    /// # Domain
    /// u ∈ [0, 1]²: 1, which some generators round to, counts as the number below it.
    ///
    /// # Returns
    /// A unit vector with z ≥ 0.
    fn sample_d(&self, u: Vec2<Self>) -> Vec3<Self>;

    /// The density of [`sample_d`](Self::sample_d), D(wm) wm.z, 1/sr.
    #[inline(always)]
    fn pdf_d(&self, wm: Vec3<Self>) -> Self::Scalar {
        let m: [Self::Scalar; 3] = wm.into();
        self.d(wm) * positive_part(m[2])
    }
}

/// Sampling of the normals visible from a direction; the density is [`Ndf::vndf`].
pub trait SampleVndf: Ndf {
    /// A micronormal visible from `w`, of density [`vndf(w, ·)`](Ndf::vndf), from two random
    /// numbers.
    ///
    /// # Domain
    /// w as for [`vndf`](Ndf::vndf); u ∈ [0, 1]²: 1, which some generators round to, counts as the
    /// number below it.
    ///
    /// # Returns
    /// A unit vector with z ≥ 0 and w·wm > 0.
    fn sample_vndf(&self, w: Vec3<Self>, u: Vec2<Self>) -> Vec3<Self>;

    /// A vector along [`sample_vndf`](Self::sample_vndf), not normalised: for callers that need its
    /// direction alone.
    ///
    /// # Returns
    /// A vector whose squared length is a normal number.
    #[inline(always)]
    fn sample_vndf_along(&self, w: Vec3<Self>, u: Vec2<Self>) -> Vec3<Self> {
        self.sample_vndf(w, u)
    }
}
