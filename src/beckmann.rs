//! Beckmann: Gaussian slopes.

mod to_1e6;
mod visible;

pub use to_1e6::BeckmannTo1e6;

use self::visible::{Inversion, ToRounding, VisibleSlopes};
use crate::Real;
use crate::elementary::{exp_normal, exp_normal_wide, exp_wide, ierfcx, ierfcx_near, ln_1p, sin_cos_of_turn};
use crate::map::Map;
use crate::microsurface::Microsurface;
use crate::microsurface::shape_invariant;
use crate::ndf::Vec3;
use crate::ndf::staged::Forms;
use crate::profile::staged::StagedProfile;
use crate::profile::{Profile, SampleProfile, SampleVisibleProfile};
use crate::real::converted;
use crate::vector::below_one;

/// Beckmann slopes: D = exp(−(wm.x²/αx² + wm.y²/αy²)/wm.z²)/(π αx αy wm.z⁴).
///
/// Gaussian, with a covariance of α²/2 along each axis, so that sums of surfaces and filtering are
/// exact. The mask is exact too: with a = w.z/√(wᵀAw), A the roughness matrix,
///
/// Λ = e^{−a²}/(2√π a) − ½ erfc a = e^{−a²} ierfcx(a)/(2a),
///
/// ierfcx(a) = 1/√π − a erfcx(a) = e^{a²} ∫ₐ^∞ erfc.
///
/// # Numerics
/// The difference of the first form loses all digits beyond a ≈ 3 in f32 and a ≈ 6 in f64; ierfcx
/// is evaluated by an approximation of its own and loses none. D and Λ form the exponent in f64,
/// because an error δ of the exponent is a relative error δ of the result: at five times α,
/// rounding the exponent to f32 alone would cost 2e-6. A subnormal D far out is 0, as is σ below
/// the horizon where e^{−a²} is below 2⁻⁹² (f32) or 2⁻⁹⁷⁵ (f64).
///
/// # Accuracy
/// Relative, in units of ε of the scalar, f32 / f64, the largest found by a search over α from 1e-6
/// to 1e3, ratios of α up to 1000 and all directions (D of f32: 4.6 on denser samples of isotropic
/// surfaces):
/// - D 4.6 / 85 where the exponent is at most 26, 0.15 / 3.8 times the exponent beyond: in f64 the
///   exponent's own rounding;
/// - σ above the horizon 4.0 / 3.8, below it 3.8 (1 + a²);
/// - Λ 6.0 / 54 where a² ≤ 26, 0.2 / 2.6 times a² beyond; G1 4.0 / 3.7 everywhere.
///
/// Visible normals: the slope along the view is the exact inverse of its distribution to 3e-8 (f32)
/// or 2e-15 (f64) in u, at worst; both slopes are monotone in their random numbers, for f32 ulp by
/// ulp. [`BeckmannTo1e6`] takes less time for less.
///
/// # Example
/// ```
/// use microsurface::{Beckmann, Ndf, glam::DVec3};
/// let surface = Beckmann::isotropic(0.5_f64)?;
/// let (s, c) = 80_f64.to_radians().sin_cos();
/// assert!((surface.lambda(DVec3::new(s, 0.0, c)) / 0.397389541775568 - 1.0).abs() < 1e-14);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Beckmann and Spizzichino 1963; Smith 1967; Walter, Marschner, Li and Torrance 2007, Eq. 25;
/// Heitz 2014, §5.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[doc(alias = "Gaussian")]
pub struct Beckmann;

shape_invariant!(Beckmann);

impl<T: Real> Profile<T> for Beckmann {
    #[inline(always)]
    fn d<M: Map<Scalar = T>>(&self, map: &M, m: [T; 3], length2: T) -> T {
        let (q, z2) = map.normal_terms_wide(m);
        let half = T::Wide::HALF * (q / z2);
        // Where the exponential is no normal number D is none either; 1/z² may overflow there.
        let last = T::Wide::lit(if T::WIDENS { 87.0 } else { 708.0 });
        let vanished = half > last;
        let half = if vanished { last } else { half };
        // The root of the exponential beside that of 1/z⁴: neither leaves the range before their
        // product does.
        let root = length2 / T::narrow(z2) * exp_normal_wide::<T>(-half);
        let root = if vanished { T::ZERO } else { root };
        // A subnormal D is 0: a microcode assist each would slow batches down to half their speed.
        let unit = T::lit(if T::WIDENS { 9223372036854775808.0 } else { 6.703903964971299e153 }); // 2⁶³, 2⁵¹¹
        let scaled = map.scale() * root;
        let subnormal = (unit * scaled) * (unit * root) < T::ONE;
        scaled * if subnormal { T::ZERO } else { root }
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        z + backfacing(s2, z).0
    }

    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        let (area, vanished) = backfacing(s2, z);
        if vanished { T::ZERO } else { area }
    }

    /// As the area of the facets that look away, with the exponent in the wide scalar.
    #[inline(always)]
    fn lambda<M: Map<Scalar = T>>(&self, map: &M, w: [T; 3]) -> T {
        let z = w[2].widen();
        let exponent = z * z / map.direction_term_wide(w);
        let s = map.direction_term(w).sqrt();
        T::HALF * (s / w[2]) * ierfcx(w[2] / s) * exp_wide::<T>(-exponent)
    }
}

/// ½ s e^{−ν²} ierfcx ν, ν = z/s, and whether ν is so large that the area counts as 0; what it is
/// then is below 2⁻⁹² z.
#[inline(always)]
fn backfacing<T: Real>(s2: T, z: T) -> (T, bool) {
    let s = s2.sqrt();
    let (nu, last) = (z / s, T::lit(if T::WIDENS { 8.0 } else { 26.0 }));
    let vanished = nu > last;
    let nu = if vanished { last } else { nu };
    (T::HALF * s * exp_normal(-(nu * nu)) * ierfcx_near(nu), vanished)
}

impl<T: Real> SampleProfile<T> for Beckmann {
    /// tan²θ = −ln(1 − u.x), azimuth 2π u.y: Walter 2007, Eqs. 28–29.
    #[inline(always)]
    fn sample_d(&self, [u1, u2]: [T; 2]) -> [T; 3] {
        let (sin, cos) = sin_cos_of_turn(u2);
        let radius = (-ln_1p(-below_one(u1))).sqrt();
        [radius * cos, radius * sin, T::ONE]
    }
}

impl<T: Real> SampleVisibleProfile<T> for Beckmann {
    /// The slope along the view by inversion of its distribution from u.x, the slope across it a
    /// Gaussian from u.y; monotone in both. A number below ε/4 counts as ε/4, so that both slopes
    /// are finite at 0.
    ///
    /// Heitz and d'Eon 2014, §4.1, with an inversion of our own, derived in `beckmann/visible.rs`.
    #[inline(always)]
    fn sample_visible(&self, v: [T; 3], s2: T, u: [T; 2]) -> [T; 3] {
        sample::<ToRounding, T>(v, s2, u)
    }
}

impl Forms for Beckmann {}

impl<T: Real> StagedProfile<T> for Beckmann {
    const STRAIGHT: bool = true;
    type Solver = VisibleSlopes<ToRounding, T>;

    #[inline(always)]
    fn ask(&self, v: [T; 3], s2: T, u: [T; 2]) -> (T::Wide, [T; 2]) {
        (cotangent::<ToRounding, T>(v[2], s2.sqrt()), u)
    }

    #[inline(always)]
    fn normal(&self, v: [T; 3], s2: T, u: [T; 2], slopes: [T; 2]) -> ([T; 3], bool) {
        facet_from_above(v, s2, u, slopes)
    }
}

/// See [`SampleVisibleProfile::sample_visible`].
#[inline(always)]
fn sample<I: Inversion<T>, T: Real>(v: [T; 3], s2: T, u: [T; 2]) -> [T; 3] {
    let s = s2.sqrt();
    facet(v, s, u, visible::slopes::<I, T>(cotangent::<I, T>(v[2], s), u))
}

/// The normal with these slopes, and whether the view is from above: the common path.
#[inline(always)]
fn facet_from_above<T: Real>(v: [T; 3], s2: T, u: [T; 2], slopes: [T; 2]) -> ([T; 3], bool) {
    (facet(v, s2.sqrt(), u, slopes), v[2] >= T::ZERO)
}

/// ν of a view with this height and length of the horizontal part.
#[inline(always)]
fn cotangent<I: Inversion<T>, T: Real>(z: T, s: T) -> I::Wide {
    converted::<T, I::Wide>(z) / converted(s)
}

/// The root of the smallest normal number.
#[inline(always)]
fn shortest<T: Real>() -> T {
    T::lit(if T::WIDENS { 1.0842021724855044e-19 } else { 1.4916681462400413e-154 }) // 2⁻⁶³, 2⁻⁵¹¹
}

/// The normal with these slopes along and across the view v, whose horizontal part has the length
/// s.
#[inline(always)]
fn facet<T: Real>(v: [T; 3], s: T, [u1, u2]: [T; 2], [along, across]: [T; 2]) -> [T; 3] {
    let inverse = T::ONE / s;
    // A length whose square is subnormal has lost its digits. The view is then vertical to every
    // digit, and any direction is along it.
    let has_direction = s >= shortest();
    let [along_x, along_y] = if has_direction { [v[0] * inverse, v[1] * inverse] } else { [T::ONE, T::ZERO] };
    // The limits of the inversion would turn a NaN into a number.
    let z = T::ONE + T::ZERO * (v[0] + v[1] + v[2] + u1 + u2);
    [across * along_y - along * along_x, -(along * along_y) - across * along_x, z]
}

impl<M: Map> Microsurface<Beckmann, M> {
    /// Walter's rational approximation of Λ, in common use; [`lambda`](crate::Ndf::lambda) is the
    /// exact one.
    ///
    /// 1/G1 − 1 with the G1 of [`g1_walter2007`](Self::g1_walter2007): slightly negative just below
    /// a = 1.6 and 0 above, where the exact Λ falls like e^{−a²}.
    ///
    /// # Special cases
    /// w.z = 0 → ∞; w.z < 0 → −1 − Λ(−w), as of [`lambda`](crate::Ndf::lambda).
    ///
    /// # Accuracy
    /// Relative error 4.6 % for a ∈ [0.1, 1], up to 91 % in [1, 1.5] and 100 % above 1.6.
    #[inline(always)]
    #[must_use]
    pub fn lambda_walter2007(&self, w: Vec3<Self>) -> M::Scalar {
        let lit = M::Scalar::lit;
        let w: [M::Scalar; 3] = w.into();
        let a = w[2].abs() / self.map().direction_term(w).sqrt();
        let lambda =
            (lit(1.0) - lit(1.259) * a + lit(0.396) * (a * a)) / (lit(3.535) * a + lit(2.181) * (a * a));
        let lambda = if a >= lit(1.6) { M::Scalar::ZERO } else { lambda };
        if w[2] < M::Scalar::ZERO { -M::Scalar::ONE - lambda } else { lambda }
    }

    /// Walter's rational approximation of the masking G1(w) of facets that face w.
    ///
    /// (3.535 a + 2.181 a²)/(1 + 2.276 a + 2.577 a²) below a = 1.6, 1 above.
    ///
    /// # Special cases
    /// w.z ≤ 0 → 0, as of [`g1`](crate::Ndf::g1).
    ///
    /// # Accuracy
    /// max |ΔG1| = 3.11e-3, at a = 1.338; above 1 by up to 6.1e-5 from a = 1.548 to 1.6, where it
    /// steps down by 5.7e-5.
    ///
    /// # References
    /// Walter, Marschner, Li and Torrance 2007, Eq. 27 (after Schlick).
    #[inline(always)]
    #[must_use]
    pub fn g1_walter2007(&self, w: Vec3<Self>) -> M::Scalar {
        let lit = M::Scalar::lit;
        let w: [M::Scalar; 3] = w.into();
        let a = w[2] / self.map().direction_term(w).sqrt();
        let g1 = (lit(3.535) * a + lit(2.181) * (a * a)) / (lit(1.0) + lit(2.276) * a + lit(2.577) * (a * a));
        let g1 = if a >= lit(1.6) { M::Scalar::ONE } else { g1 };
        if w[2] <= M::Scalar::ZERO { M::Scalar::ZERO } else { g1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The slope across the view, from the u.y with these bits.
    fn across(bits: u32) -> f32 {
        let [_, y, _] = Beckmann.sample_visible([1.0_f32, 0.0, 0.5], 1.0, [0.5, f32::from_bits(bits)]);
        -y
    }

    #[test]
    fn the_slope_across_the_view_is_monotone_ulp_by_ulp() {
        // Both ends, the middle, and the seams of the fit at 2u = 0.1 and 1.9.
        for centre in [1e-7_f32, 0.001, 0.05, 0.25, 0.4999, 0.5, 0.75, 0.95, 0.9999999] {
            let first = centre.to_bits() - 5000;
            let last = (centre.to_bits() + 5000).min(1.0_f32.to_bits() - 1);
            for bits in first..last {
                assert!(across(bits) <= across(bits + 1), "u = {}", f32::from_bits(bits));
            }
        }
        assert!(across(0).is_finite() && across(0) < -3.7);
    }
}
