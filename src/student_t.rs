//! Student-t slopes: tails from heavier than GGX's to Beckmann's, and Phong's distribution.
//!
//! GGX is γ = 2, Beckmann the limit of γ → ∞, and Phong's power of the cosine one for each width.
//! Unlike [`Gtr`](crate::Gtr) it is a distribution of slopes without a width of its own, so that
//! stretching it gives a Student-t again.

mod marginal;
mod quantile;
mod visible;

use self::marginal::Marginal;
use self::visible::Visible;
use crate::Real;
use crate::elementary::{exp_m1, exp_normal_wide, ln_1p, sin_cos_of_turn};
use crate::error::Error;
use crate::map::{AxisAligned, Isotropic, Linear, Map, RoughnessMatrix};
use crate::microsurface::Microsurface;
use crate::ndf::staged::Forms;
use crate::profile::staged::StagedProfile;
use crate::profile::{Profile, SampleProfile, SampleVisibleProfile};
use crate::vector::below_one;

/// Student-t slopes: P22 = (1 + r²/(γ − 1))^{−γ}/(π αx αy), r² = (x̃/αx)² + (ỹ/αy)².
///
/// γ sets the weight of the tail at one width of the peak: 2 is GGX, less is heavier, ∞ Beckmann.
/// Below γ = 2 the density grows without bound towards horizontal normals, as z^{2γ−4}; at γ = 3/2
/// the projected area is infinite. The mask is exact for every γ: with p = γ − ½, ν = z/(√(γ−1) s)
/// and W = 1/(1 + ν²)
///
/// z Λ = √(γ−1) s (c W^{p−1}/(2p − 2) − ½ ν I_W(γ − 1, ½)),  c = Γ(γ − ½)/(√π Γ(γ − 1)),
///
/// I the regularised incomplete beta function.
///
/// # Numerics
/// The difference cancels; what is evaluated is a power times a positive polynomial, found for each
/// γ by the constructor. That takes 0.2 ms: make one for a material, not for a hit. Normals lower
/// than 2⁻⁵⁰ (f32) or 2⁻⁴⁵⁰ (f64) times the width count as that low in D, which is then finite for
/// γ < 2.
///
/// # Accuracy
/// Relative, in units of ε of the scalar, f32 / f64, the largest found on a table of 50 digits, γ
/// from 1.501 to 50,002 and angles to 89.999° (`cargo test --test it student_t`): σ above the
/// horizon 1.9 / 7.0; σ below it 2.3 / 7.0 and Λ 2.1 / 6.5 times 1 + (γ − 3/2) ln(1 + ν²); D 2.3 /
/// 2.0 times 1 + γ ln(1 + r²/(γ − 1)), the sizes of the exponents. σ below the horizon counts as 0
/// where its exponent is above 64 / 676.
///
/// Visible normals: two slopes, each the inverse of its distribution, without rejection. Seen from
/// below both are monotone in their random numbers. From above, where it takes no iteration, the
/// slope along the view has three monotone pieces, and its sign in the first is drawn by u.y.
///
/// # Example
/// ```
/// use microsurface::{Ndf, SampleVndf, StudentT, glam::{DVec2, DVec3}};
/// let surface = StudentT::isotropic(0.5_f64, 2.5)?;
/// let (s, c) = 80_f64.to_radians().sin_cos();
/// let w = DVec3::new(s, 0.0, c);
/// assert!((surface.lambda(w) / 0.694710439629849 - 1.0).abs() < 1e-14);
/// let wm = surface.sample_vndf(w, DVec2::new(0.3, 0.7));
/// assert!(w.dot(wm) > 0.0 && surface.vndf(w, wm) > 0.0);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Ribardière, Bringier, Meneveaux and Simonot 2017, Eqs. 10–12; Atanasov, Koylazov, Dimov and
/// Wilkie 2022, §4.3; the mask as a hypergeometric function: d'Eon 2023.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("STD", "GTD", "Ribardiere"))]
pub struct StudentT<T: Real> {
    gamma: T,
    /// 1/(γ − 1).
    inverse: T::Wide,
    /// √(γ − 1).
    width: T,
    /// γ/2 − 1.
    power: T::Wide,
    marginal: Marginal<T>,
    visible: Visible<T>,
}

/// The smallest γ, 3/2 + 2⁻²⁰: at 3/2 there is no projected area, and Λ is about a million here.
const SMALLEST: f64 = 1.5 + 1.0 / 1048576.0;
/// The largest γ: beyond it the distribution is Beckmann's to the rounding of f32.
const LARGEST: f64 = 1073741824.0; // 2³⁰

impl<T: Real> StudentT<T> {
    /// The profile of the exponent γ.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless 3/2 + 2⁻²⁰ ≤ γ ≤ 2³⁰.
    pub fn new(gamma: T) -> Result<Self, Error> {
        let g = gamma.to_f64();
        if !(SMALLEST..=LARGEST).contains(&g) {
            return Err(Error::Parameter { name: "gamma", value: g, smallest: SMALLEST, largest: LARGEST });
        }
        let wide = T::Wide::lit;
        Ok(Self {
            gamma,
            inverse: wide(1.0 / (g - 1.0)),
            width: T::lit(Real::sqrt(g - 1.0)),
            power: wide(0.5 * g - 1.0),
            marginal: Marginal::new(g - 1.5),
            visible: Visible::new(g - 1.5),
        })
    }

    /// γ, the exponent of the tail.
    #[inline]
    #[must_use]
    pub fn gamma(&self) -> T {
        self.gamma
    }

    /// The distribution of slope width α in every direction.
    ///
    /// # Errors
    /// [`Error::Alpha`] unless α is within [`alpha_range`](crate::roughness::alpha_range),
    /// [`Error::Parameter`] unless 3/2 + 2⁻²⁰ ≤ γ ≤ 2³⁰.
    pub fn isotropic(alpha: T, gamma: T) -> Result<Microsurface<Self, Isotropic<T>>, Error> {
        Ok(Microsurface::new(Self::new(gamma)?, Isotropic::new(alpha)?))
    }

    /// The distribution of slope widths αx along x and αy along y.
    ///
    /// # Errors
    /// As [`isotropic`](Self::isotropic), for either α.
    pub fn anisotropic(
        alpha_x: T,
        alpha_y: T,
        gamma: T,
    ) -> Result<Microsurface<Self, AxisAligned<T>>, Error> {
        Ok(Microsurface::new(Self::new(gamma)?, AxisAligned::new(alpha_x, alpha_y)?))
    }

    /// The distribution of slope widths αx along the direction at `angle` radians from x, and αy
    /// across it.
    ///
    /// # Errors
    /// As [`isotropic`](Self::isotropic), and [`Error::Parameter`] if the angle is not finite.
    pub fn rotated(
        alpha_x: T,
        alpha_y: T,
        angle: T,
        gamma: T,
    ) -> Result<Microsurface<Self, Linear<T>>, Error> {
        Self::from_roughness_matrix(RoughnessMatrix::rotated(alpha_x, alpha_y, angle)?, gamma)
    }

    /// The distribution of a roughness matrix A: slope widths that differ along any two directions.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless 3/2 + 2⁻²⁰ ≤ γ ≤ 2³⁰.
    pub fn from_roughness_matrix(
        matrix: RoughnessMatrix<T>,
        gamma: T,
    ) -> Result<Microsurface<Self, Linear<T>>, Error> {
        Ok(Microsurface::new(Self::new(gamma)?, Linear::from(matrix)))
    }
}

/// Phong's distribution D = (n + 2)/(2π) cosⁿθ: Student-t slopes of γ = (n + 4)/2 and α² = 2/(n +
/// 2).
///
/// # Example
/// ```
/// use microsurface::{Ndf, glam::DVec3, student_t::Phong};
/// let d = Phong::isotropic(10.0_f64)?.d(DVec3::new(0.6, 0.0, 0.8));
/// assert!((d / (6.0 / core::f64::consts::PI * 0.8_f64.powi(10)) - 1.0).abs() < 1e-14);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Phong 1975; its normalisation as a distribution of normals: Walter, Marschner, Li and Torrance
/// 2007, Eq. 30.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[doc(alias = "Blinn")]
pub struct Phong;

impl Phong {
    /// The distribution of the exponent n, with its exact mask.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless 0 ≤ n ≤ 2³⁰.
    pub fn isotropic<T: Real>(exponent: T) -> Result<Microsurface<StudentT<T>, Isotropic<T>>, Error> {
        let n = exponent.to_f64();
        if !(0.0..=LARGEST).contains(&n) {
            return Err(Error::Parameter { name: "exponent", value: n, smallest: 0.0, largest: LARGEST });
        }
        StudentT::isotropic(T::lit(Real::sqrt(2.0 / (n + 2.0))), T::lit(0.5 * n + 2.0))
    }
}

impl<T: Real> Profile<T> for StudentT<T> {
    /// As GGX's of the slopes over √(γ − 1), times ((z² + q)/z²)^{2−γ}.
    #[inline(always)]
    fn d<M: Map<Scalar = T>>(&self, map: &M, m: [T; 3], length2: T) -> T {
        let (q, z2) = map.normal_terms_wide(m);
        let q = self.inverse * q;
        // A normal lower than the smallest number is taken as that low: for γ < 2 D has no bound.
        let largest = T::Wide::lit(if T::WIDENS { 1.2676506002282294e30 } else { 8.452712498170644e270 }); // 2¹⁰⁰, 2⁹⁰⁰
        let exponent = self.power * ln_1p((q / z2).min(largest));
        let last = T::Wide::lit(if T::WIDENS { 87.0 } else { 708.0 });
        let vanished = exponent > last;
        let exponent = if vanished { last } else { exponent };
        let root = length2 / T::narrow(z2 + q) * exp_normal_wide::<T>(-exponent);
        map.scale() * root * if vanished { T::ZERO } else { root }
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        z + self.marginal.area(self.width * s2.sqrt(), z).0
    }

    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        let (area, vanished) = self.marginal.area(self.width * s2.sqrt(), z);
        if vanished { T::ZERO } else { area }
    }

    #[inline(always)]
    fn lambda<M: Map<Scalar = T>>(&self, map: &M, w: [T; 3]) -> T {
        self.marginal.area_over_height(self.width * map.direction_term(w).sqrt(), w[2])
    }
}

impl<T: Real> Forms for StudentT<T> {}

impl<T: Real> SampleProfile<T> for StudentT<T> {
    /// (1 + tan²θ/(γ − 1))^{1−γ} = 1 − u.x, azimuth 2π u.y.
    #[inline(always)]
    fn sample_d(&self, [u1, u2]: [T; 2]) -> [T; 3] {
        let (sin, cos) = sin_cos_of_turn(u2);
        let log = -ln_1p(-below_one(u1)).widen() * self.inverse;
        let radius = T::narrow((exp_m1(log) / self.inverse).sqrt());
        [radius * cos, radius * sin, T::ONE]
    }
}

impl<T: Real> SampleVisibleProfile<T> for StudentT<T> {
    /// The slope along the view from u.x and, where its sign is open, u.y; the slope across it from
    /// u.y.
    #[inline]
    fn sample_visible(&self, v: [T; 3], s2: T, u: [T; 2]) -> [T; 3] {
        let width = self.width.widen();
        let s = s2.sqrt();
        // A view along the normal: every slope is as much seen as any other.
        let steepest = T::Wide::lit(1e30);
        let nu = (v[2].widen() / (width * s.widen())).min(steepest).max(-steepest);
        let [along, across] = self.visible.slopes(&self.marginal, nu, u);
        let inverse = T::Wide::ONE / (T::Wide::ONE + along * along).sqrt();
        let [x, y] =
            if s > T::ZERO { [v[0] / s, v[1] / s].map(Real::widen) } else { [T::Wide::ONE, T::Wide::ZERO] };
        let along = width * (along * inverse);
        let across = width * across;
        // Limits would turn a NaN into a number.
        let nan = T::Wide::ZERO * (v[0] + v[1] + v[2] + u[0] + u[1]).widen();
        [along * x - across * y + nan, along * y + across * x, inverse].map(T::narrow)
    }
}

impl<T: Real> StagedProfile<T> for StudentT<T> {
    /// The choice of a part branches.
    const STRAIGHT: bool = false;
    type Solver = ();

    #[inline(always)]
    fn ask(&self, _: [T; 3], _: T, _: [T; 2]) {}

    #[inline(always)]
    fn normal(&self, v: [T; 3], s2: T, u: [T; 2], (): ()) -> ([T; 3], bool) {
        (self.sample_visible(v, s2, u), true)
    }
}
