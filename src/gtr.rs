//! GTR, the generalised distribution of Trowbridge and Reitz, with a tail of any weight.
//!
//! D ∝ 1/(α² cos²θ + sin²θ)^γ: γ = 2 is GGX, γ < 2 has heavier tails, γ > 2 lighter ones, γ = 1 is
//! the Berry distribution, and γ = 0 or α = 1 does not depend on the angle. It is not
//! shape-invariant: α and the map are different things, and a stretched GTR is no GTR of another α.
//!
//! The density ([`Density`]) is one formula for every γ. What the papers leave open, its mask and
//! its visible normals, follows from one fact: GTR is a positive mixture, over widths between α and
//! 1, of GGX (γ ≤ 2) or of GTR of the next integer exponent, and areas and visible normals of a
//! mixture are those of its components. Masking comes in kinds, the second parameter of [`Gtr`]:
//!
//! | constructor | γ | max \|ΔG1\| | kind, and what it holds |
//! |---|---|---|---|
//! | [`Gtr::isotropic`] | 0 … 10 | 8e-6 | [`Mixture`](mixture::Mixture): 8 nodes, and components to sample visible normals fast |
//! | [`Gtr::with_nodes`] | 0 … 10 | 1e-3 … 1e-7 | the same with another number of nodes |
//! | [`Gtr::heavy_tailed`] | 0 … 2 | 1e-3 … 1e-7 | [`GgxNodes`](nodes::GgxNodes): nodes alone, no branch |
//! | [`GtrTable`](table::GtrTable) | 0 … 10 | 1.6e-4 | nodes interpolated in α, for textures |
//! | [`Gtr::closed`] | 0, 1, …, 10 | rounding | [`Closed`](closed::Closed): nothing is paid for other γ |
//! | [`Gtr::spline`] | 0 … 4 | 0.34 | [`Spline`](spline::Spline): the papers' interpolation, for comparison |
//!
//! All but the spline can draw visible normals, with the density D_w of D itself.
//!
//! |γ − 1| |ln α²| must not exceed 700, so that α^(2γ−2) is a number of f64. That refuses γ = 10 below
//! α = 1.3e-17. In f32, whose smallest α is 4.7e-10, it refuses γ above 17, which [`Density`] alone
//! has.

pub mod closed;
pub mod components;
mod gauss;
mod integer;
mod measure;
pub mod mixture;
pub mod nodes;
pub mod spline;
pub mod table;
mod visible;

use crate::Real;
use crate::alpha::checked;
use crate::elementary::{exp_m1, inverse_power_of_ratio, ln, ln_1p, sin_cos_of_turn};
use crate::error::Error;
use crate::gtr::components::Components;
use crate::map::{Isotropic, Map};
use crate::microsurface::Microsurface;
use crate::ndf::staged::Forms;
use crate::profile::staged::StagedProfile;
use crate::profile::{Profile, SampleProfile, SampleVisibleProfile};
use crate::vector::below_one;

/// GTR slopes with the masking of kind `K`.
///
/// D = c/(α² wm.z² + wm.x² + wm.y²)^γ with c = (γ−1)(α²−1)/(π(1 − α^{2−2γ})), whose limits at γ = 1
/// and α = 1 are reached smoothly; under a map, c (z² + q)^{γ−2}/(q + α² z²)^γ, see
/// [`crate::profile`].
///
/// # Numerics
/// The power is taken of (q/α² + z²)/(q + z²) ∈ [1, 1/α²], formed in f64, and scaled by the density
/// at the pole, so that nothing overflows for any γ. γ − 1 enters only through y/(eʸ − 1) with y =
/// (γ − 1) ln α².
///
/// The product of α and the width of the map wants to stay within
/// [`alpha_range`](crate::roughness::alpha_range), which constructors check of each alone: below
/// it, G2 of denormal cosines can be NaN.
///
/// # Accuracy
/// Relative, in units of ε of the scalar, f32 / f64, the largest found by a search over α from 1e-6
/// to 1 and all directions: D 4.2 / 24 for γ up to 10, the worst where the power is steepest.
/// Closed masks of γ ≤ 4: σ 7 / 7 above the horizon and 10 / 10 below it, Λ 9 / 9, G1 7 / 7; of γ ≤
/// 10: σ 12 / 12 and 30 / 28, Λ 28 / 30, G1 12 / 13.
///
/// # References
/// Burley 2012, "Physically-based shading at Disney", Appendix B; Dimov 2015; Atanasov, Koylazov,
/// Dimov and Wilkie 2022, Eqs. 32–39.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gtr<T: Real, K> {
    density: Density<T>,
    masking: K,
}

/// The usual surface of GTR: what [`Gtr::isotropic`] and, under other maps, [`Gtr::anisotropic`]
/// and [`Gtr::rotated`] return.
///
/// # Example
/// ```
/// use microsurface::{Gtr, Linear, gtr::GtrSurface};
/// struct Coat {
///     surface: GtrSurface<f32>,
///     turned: GtrSurface<f32, Linear<f32>>,
/// }
/// let surface = Gtr::isotropic(0.2, 1.0)?;
/// let coat = Coat { surface, turned: Gtr::rotated(0.1, 0.4, 0.5, 1.0)? };
/// # let _ = coat;
/// # Ok::<(), microsurface::Error>(())
/// ```
pub type GtrSurface<T, M = Isotropic<T>> = Microsurface<Gtr<T, mixture::Mixture<T, 8>>, M>;

impl<T: Real, K> Gtr<T, K> {
    /// α, the width of the peak.
    #[inline]
    #[must_use]
    pub fn alpha(&self) -> T {
        self.density.alpha
    }

    /// γ, the exponent of the tail.
    #[inline]
    #[must_use]
    pub fn gamma(&self) -> T {
        self.density.gamma
    }

    /// The density and its sampling, without a mask.
    #[inline]
    #[must_use]
    pub fn density(&self) -> &Density<T> {
        &self.density
    }

    /// The masking.
    #[inline]
    #[must_use]
    pub fn masking(&self) -> &K {
        &self.masking
    }
}

impl<T: Real, K: Masking<T>> Gtr<T, K> {
    pub(crate) fn new(alpha: T, gamma: T) -> Result<Self, Error> {
        // The mask first: its range of γ is the narrower, and the one an error should name.
        let masking = K::new(width(alpha)?, gamma)?;
        Ok(Self { density: Density::new(alpha, gamma)?, masking })
    }

    /// The profile under the identity.
    fn surface(alpha: T, gamma: T) -> Result<Microsurface<Self, Isotropic<T>>, Error> {
        Ok(Microsurface::new(Self::new(alpha, gamma)?, Isotropic::new(T::ONE)?))
    }
}

/// The way the projected area of a GTR is computed. Sealed: the kinds in this module.
pub trait Masking<T: Real>: Forms {
    /// The mask for the width α, checked by the caller, and the exponent γ.
    ///
    /// # Errors
    /// [`Error::Gamma`] or [`Error::Parameter`] for a γ that this kind does not cover.
    fn new(alpha: T, gamma: T) -> Result<Self, Error>;

    /// (n/d)^{−γ/2}, n ≥ d: a kind for which γ is an integer has a shorter way than the power.
    #[inline(always)]
    fn root_of_power(n: T::Wide, d: T::Wide, gamma: T) -> T {
        root_of_power(n, d, gamma)
    }

    /// σ_P(s², z) for z ≥ 0.
    fn sigma_above(&self, s2: T, z: T) -> T;

    /// z Λ = σ_P(s², −z) for z ≥ 0, without cancellation.
    fn sigma_backfacing(&self, s2: T, z: T) -> T;
}

impl<T: Real, K: Masking<T>> Profile<T> for Gtr<T, K> {
    #[inline(always)]
    fn d<M: Map<Scalar = T>>(&self, map: &M, m: [T; 3], length2: T) -> T {
        let (q, z2) = map.normal_terms_wide(m);
        let (sum, [n, d]) = self.density.ratio(q, z2);
        self.density.homogeneous(map.scale(), length2, sum, K::root_of_power(n, d, self.density.gamma))
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        self.masking.sigma_above(s2, z)
    }

    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        self.masking.sigma_backfacing(s2, z)
    }
}

impl<T: Real, K: Forms> Forms for Gtr<T, K> {
    #[inline(always)]
    fn form(&self) -> usize {
        self.masking.form()
    }

    #[inline(always)]
    fn with_form(self, form: usize) -> Self {
        Self { density: self.density, masking: self.masking.with_form(form) }
    }
}

impl<T: Real, K: Masking<T>> SampleProfile<T> for Gtr<T, K> {
    #[inline(always)]
    fn sample_d(&self, u: [T; 2]) -> [T; 3] {
        self.density.sample(u)
    }
}

/// A kind of mask that is the exact one of its density, so that visible normals have a density.
pub trait VisibleMasking<T: Real>: Masking<T> {
    /// A normal visible from `v`, of the profile itself (map I), of any length.
    ///
    /// From the [`Components`] of α and γ, made on the spot unless the kind keeps them.
    #[inline]
    fn sample_visible(&self, alpha: T, gamma: T, v: [T; 3], u: [T; 2]) -> [T; 3] {
        Components::of(alpha.to_f64(), gamma.to_f64()).sample_visible(v, u)
    }
}

impl<T: Real, K: VisibleMasking<T>> SampleVisibleProfile<T> for Gtr<T, K> {
    #[inline(always)]
    fn sample_visible(&self, v: [T; 3], _: T, u: [T; 2]) -> [T; 3] {
        self.masking.sample_visible(self.density.alpha, self.density.gamma, v, u)
    }
}

impl<T: Real, K: VisibleMasking<T>> StagedProfile<T> for Gtr<T, K> {
    /// The choice of a component branches.
    const STRAIGHT: bool = false;
    type Solver = ();

    #[inline(always)]
    fn ask(&self, _: [T; 3], _: T, _: [T; 2]) {}

    #[inline(always)]
    fn normal(&self, v: [T; 3], s2: T, u: [T; 2], (): ()) -> ([T; 3], bool) {
        (self.sample_visible(v, s2, u), true)
    }
}

/// (n/d)^{−γ/2}.
#[inline(always)]
fn root_of_power<T: Real>(n: T::Wide, d: T::Wide, gamma: T) -> T {
    inverse_power_of_ratio(n, d, T::HALF * gamma)
}

/// The density of GTR for any γ ≥ 0 and 0 < α ≤ 1, and normals drawn from it.
///
/// # Example
/// γ = 3/2 is the Henyey–Greenstein function of the half vector.
/// ```
/// use microsurface::{glam::DVec3, gtr::Density};
/// let alpha = 0.3_f64;
/// let d = Density::new(alpha, 1.5)?.d(DVec3::new(0.6, 0.0, 0.8));
/// let c = alpha * (1.0 + alpha) / (2.0 * core::f64::consts::PI);
/// let henyey_greenstein = c / (0.36 + alpha * alpha * 0.64).powf(1.5);
/// assert!((d / henyey_greenstein - 1.0).abs() < 1e-14);
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Density<T: Real> {
    alpha: T,
    gamma: T,
    /// π D at the pole.
    peak: T,
    /// 1/(1 − γ) and v^{1−γ} − 1 at the ends of the range of v, where the other end is 1: see
    /// [`Self::sample`].
    inv_one_minus_gamma: T::Wide,
    to_horizon: T::Wide,
    to_pole: T::Wide,
    /// 1/(1 − α²) and α²/(1 − α²).
    inv_range: T::Wide,
    scaled_range: T::Wide,
}

/// Nearer to γ = 1 than this, γ counts as this far from it: what is computed from γ − 1 agrees with
/// the limit to (γ − 1) ln α² < 2⁻⁵⁰, the rounding of f64. 2⁻⁶⁰.
const LIMIT_EXCESS: f64 = 8.673617379884035e-19;

/// α^{2γ−2} and its inverse are representable in f64 up to this exponent.
const LARGEST_EXPONENT: f64 = 700.0;

/// α, checked.
///
/// # Errors
/// [`Error::Alpha`] or [`Error::AlphaAboveOne`] unless 0 < α ≤ 1.
fn width<T: Real>(alpha: T) -> Result<T, Error> {
    let alpha = checked(alpha)?;
    if alpha > T::ONE { Err(Error::AlphaAboveOne { value: alpha.to_f64() }) } else { Ok(alpha) }
}

/// 1 − α² and ln α². α = 1 counts as the next smaller width, whose distribution differs by its
/// rounding.
#[inline(always)]
pub(crate) fn range_and_log(alpha: f64) -> (f64, f64) {
    let range = ((1.0 - alpha) * (1.0 + alpha)).max(f64::EPSILON);
    let log = if alpha < 0.5 { 2.0 * ln(alpha) } else { ln_1p(-range) };
    (range, log)
}

impl<T: Real> Density<T> {
    /// The density of width α and tail exponent γ.
    ///
    /// # Errors
    /// [`Error::Alpha`] or [`Error::AlphaAboveOne`] unless 0 < α ≤ 1, [`Error::Gamma`] unless γ ≥ 0
    /// and
    /// |γ − 1| ≤ 700/|ln α²|: at least 10 for every α ≥ 1e-16.
    pub fn new(alpha: T, gamma: T) -> Result<Self, Error> {
        let alpha = width(alpha)?;
        Self::of_log(alpha, gamma, range_and_log(alpha.to_f64()))
    }

    /// The density of a width that has been checked, with its 1 − α² and ln α².
    #[inline(always)]
    pub(super) fn of_log(alpha: T, gamma: T, (range, log): (f64, f64)) -> Result<Self, Error> {
        let (a, g) = (alpha.to_f64(), gamma.to_f64());
        let excess = if (g - 1.0).abs() < LIMIT_EXCESS { LIMIT_EXCESS } else { g - 1.0 };
        let y = excess * log;
        if !(g >= 0.0 && y.abs() <= LARGEST_EXPONENT) {
            return Err(Error::Gamma { value: g, largest: 1.0 - LARGEST_EXPONENT / log });
        }
        // e^−|y| − 1 = −p/(1 + p) of p = e^|y| − 1.
        let growth = exp_m1(y.abs());
        let decay = -growth / (1.0 + growth);
        let (to_horizon, to_pole) = if y > 0.0 { (growth, decay) } else { (decay, growth) };
        let inv_range = 1.0 / range;
        let alpha2 = a * a;
        let peak = range * y / (to_horizon * (-log * alpha2));
        let wide = T::Wide::lit;
        Ok(Self {
            alpha,
            gamma,
            peak: T::lit(peak),
            inv_one_minus_gamma: wide(-1.0 / excess),
            to_horizon: wide(to_horizon),
            to_pole: wide(to_pole),
            inv_range: wide(inv_range),
            scaled_range: wide(alpha2 * inv_range),
        })
    }

    /// D(wm) of the isotropic distribution, for any γ, 1/sr.
    ///
    /// # Special cases
    /// wm.z < 0 → 0.
    #[inline(always)]
    #[must_use]
    pub fn d(&self, wm: T::Vec3) -> T {
        let m: [T; 3] = wm.into();
        let [x, y, z] = m.map(T::widen);
        let (sum, [n, d]) = self.ratio(x * x + y * y, z * z);
        let d = self.homogeneous(T::FRAC_1_PI, T::ONE, sum, root_of_power(n, d, self.gamma));
        if m[2] < T::ZERO { T::ZERO } else { d }
    }

    /// z² + q, and numerator and denominator of (q + α²z²)/(α²(z² + q)) ≥ 1.
    #[inline(always)]
    fn ratio(&self, q: T::Wide, z2: T::Wide) -> (T::Wide, [T::Wide; 2]) {
        let alpha = self.alpha.widen();
        let alpha2 = alpha * alpha;
        let sum = q + z2;
        (sum, [q + alpha2 * z2, alpha2 * sum])
    }

    /// `scale` `length2`² π c (z² + q)^{γ−2}/(q + α²z²)^γ, with z² + q and the
    /// [`ratio`](Self::ratio) to the power −γ/2.
    #[inline(always)]
    fn homogeneous(&self, scale: T, length2: T, sum: T::Wide, root_of_power: T) -> T {
        // The root of the power: at α = 1e-6 and γ = 4 the power itself underflows in f32 where D
        // does not.
        let root = length2 / T::narrow(sum) * root_of_power;
        // The scale of a narrow map first: root² alone may overflow where D does not.
        (scale * self.peak) * root * root
    }

    /// A normal of density D cos θ, of any length: sin²θ by inversion from u.x, azimuth 2π u.y.
    ///
    /// With v = sin²θ + α² cos²θ ∈ [α², 1], v^{1−γ} is uniform (Burley 2012, Eq. B.2). The sine
    /// follows from v/α² and the cosine from v, each by way of eˣ − 1 and ln(1 + x), so that
    /// neither pole nor horizon cancels and γ = 1 needs no case of its own.
    #[inline(always)]
    fn sample(&self, [u1, u2]: [T; 2]) -> [T; 3] {
        let u = below_one(u1).widen();
        let log_from_pole = ln_1p(u * self.to_horizon) * self.inv_one_minus_gamma;
        let log_to_horizon = ln_1p((T::Wide::ONE - u) * self.to_pole) * self.inv_one_minus_gamma;
        let sin = (self.scaled_range * exp_m1(log_from_pole)).max(T::Wide::ZERO).sqrt();
        let cos = (-self.inv_range * exp_m1(log_to_horizon)).max(T::Wide::ZERO).sqrt();
        let (sin_phi, cos_phi) = sin_cos_of_turn(u2);
        let (sin, cos) = (T::narrow(sin), T::narrow(cos));
        [sin * cos_phi, sin * sin_phi, cos]
    }
}
