//! Isotropic slope profiles: what the distributions differ in.
//!
//! A profile is two homogeneous functions, of which everything else is made: the density P(q, z²)
//! and the projected area σ_P(s², z). Under a map M of the tangent plane (see [`crate::map`])
//!
//! D(wm) = |det M| P(|Mᵀ wm_xy|², wm.z²),  σ(w) = σ_P(|M⁻¹ w_xy|², w.z).
//!
//! P is of degree −2, so D at h/|h| is |h|⁴ times the value at h: no normalisation is needed.
//!
//! | profile | P(q, z²) | σ_P(s², z) |
//! |---|---|---|
//! | [`Ggx`](crate::Ggx) | 1/(π (q + z²)²) | ½(z + √(z² + s²)) |
//! | [`Beckmann`](crate::Beckmann) | exp(−q/z²)/(π z⁴) | z + ½ s e^{−ν²} ierfcx(ν), ν = z/s |
//! | [`StudentT`](crate::StudentT) | (1 + q/((γ−1) z²))^{−γ}/(π z⁴) | see [`student_t`](crate::student_t) |
//! | [`Gtr`](crate::Gtr) | c (z² + q)^{γ−2}/(q + α² z²)^γ | see [`gtr`](crate::gtr) |

pub(crate) mod staged;

use crate::Real;
use crate::map::Map;
use crate::ndf::masked_cosines;

/// An isotropic slope profile.
///
/// Implement it to add a distribution that lives under every map; implement [`Ndf`](crate::Ndf)
/// directly for one that is not an isotropic profile.
pub trait Profile<T: Real>: Copy {
    /// |m|⁴ |det M| P(|Mᵀ m_xy|², m.z²): D in the direction of m, whose squared length is `length2`.
    ///
    /// # Domain
    /// m.z ≥ 0, m ≠ 0.
    fn d<M: Map<Scalar = T>>(&self, map: &M, m: [T; 3], length2: T) -> T;

    /// [`d`](Self::d) times a positive fraction, numerator and denominator: for profiles whose D is
    /// a quotient, one for both.
    #[inline(always)]
    fn d_times<M: Map<Scalar = T>>(&self, map: &M, m: [T; 3], length2: T, fraction: [T; 2]) -> T {
        self.d(map, m, length2) * fraction[0] / fraction[1]
    }

    /// σ_P(s², z) for z ≥ 0.
    fn sigma_above(&self, s2: T, z: T) -> T;

    /// zi zo/G2 times 2⁴⁰ (f32) or 2²⁷⁰ (f64), from (s², z) of two directions above the horizon.
    #[inline(always)]
    fn masked_cosines(&self, [s2_i, z_i]: [T; 2], [s2_o, z_o]: [T; 2]) -> T {
        masked_cosines(z_i, z_o, self.sigma_above(s2_i, z_i), self.sigma_above(s2_o, z_o))
    }

    /// The projected area of the facets that look away, z Λ = σ_P(s², z) − z = σ_P(s², −z), for z
    /// ≥ 0.
    ///
    /// Evaluated without the cancellation of that difference.
    fn sigma_backfacing(&self, s2: T, z: T) -> T;

    /// Λ at a direction whose z is positive.
    #[inline(always)]
    fn lambda<M: Map<Scalar = T>>(&self, map: &M, w: [T; 3]) -> T {
        self.sigma_backfacing(map.direction_term(w), w[2]) / w[2]
    }
}

/// A profile without parameters of its own, whose width is the map's: filtering it is another map.
pub trait ShapeInvariant: Copy {}

/// A profile whose normals can be drawn with density D cos θ.
pub trait SampleProfile<T: Real>: Profile<T> {
    /// A normal of the profile itself (map I), of any length, from u ∈ [0, 1)².
    fn sample_d(&self, u: [T; 2]) -> [T; 3];
}

/// A profile whose visible normals can be drawn.
pub trait SampleVisibleProfile<T: Real>: Profile<T> {
    /// A normal of the profile itself (map I), of any length, visible from `v`, a vector of any
    /// length.
    ///
    /// `s2` is v.x² + v.y² to rounding, the very number that [`sigma_above`](Profile::sigma_above)
    /// gets, so that both share one root.
    fn sample_visible(&self, v: [T; 3], s2: T, u: [T; 2]) -> [T; 3];
}
