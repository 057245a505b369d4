//! Uniform directions mixed with those of sampled normals.

use crate::Real;
use crate::alpha::checked;
use crate::bsdf::sampling::{NormalSampling, StagedSampling};
use crate::elementary::sin_cos_of_turn;
use crate::error::Error;
use crate::ndf::staged::Solver;
use crate::ndf::{Ndf, Vec2, Vec3};
use crate::vector::{below_one, normalized};

/// With probability p a direction uniform on the hemisphere, otherwise one reflected by a normal of
/// `S`.
///
/// The papers' sampling of GTR, whose visible normals they could not draw: the density of
/// directions is p/(2π) + (1 − p) D(wm) wm.z/(4 wo·wm) over
/// [`AllNormals`](crate::bsdf::AllNormals), which is the balance heuristic. One of the two random
/// numbers decides and is used again. The weight is at most 2π f wi.z/p: where all normals alone
/// have weights without bound, at grazing angles, it is bounded.
///
/// # Variance
/// Variance of all normals and of [`for_alpha`](Self::for_alpha), relative to the square of the
/// mean, for a reflectance of 1: means over γ = 0.1, 1, 1.5, 2, 4 and views from 0°, 30°, 60°, 80°
/// (`cargo test --test stat long_mixture -- --ignored --nocapture`).
///
/// | α | light all around: all normals | mixture | | lobe cos⁸ about the mirror direction: all normals | mixture | |
/// |---|---|---|---|---|---|---|
/// | 0.05 | 0.60 | 0.57 | −4 % | 1.30 | 1.30 | |
/// | 0.1 | 0.70 | 0.63 | −10 % | 1.46 | 1.46 | |
/// | 0.2 | 0.84 | 0.68 | −19 % | 1.79 | 1.81 | +1 % |
/// | 0.3 | 0.96 | 0.70 | −27 % | 2.16 | 2.22 | +3 % |
/// | 0.5 | 1.17 | 0.68 | −42 % | 3.05 | 3.20 | +5 % |
/// | 0.7 | 1.38 | 0.59 | −57 % | 4.18 | 4.26 | +2 % |
/// | 1 | 1.75 | 0.29 | −83 % | 6.61 | 4.92 | −26 % |
///
/// The best p depends on γ and on the light as much as on α: heavier tails and light away from the
/// mirror direction want more, lighter tails and light about it less.
///
/// # Example
/// ```
/// use microsurface::bsdf::{AllNormals, RoughConductor, UniformMixture};
/// use microsurface::{Gtr, fresnel::Schlick, glam::{Vec2, Vec3}};
/// let (alpha, gamma) = (0.5_f32, 1.5);
/// let rough = RoughConductor::new(Gtr::spline(alpha, gamma)?, Schlick::new(0.9_f32)?);
/// let mixed = rough.sampled_by(UniformMixture::for_alpha(AllNormals, alpha)?);
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// // The last numbers of [0, 1) belong to uniform directions: wi.z = (1 − u.x)/p.
/// let sample = mixed.sample(wo, Vec2::new(0.9, 0.6)).expect("above the horizon");
/// assert!((sample.wi.z - 0.1 / 0.2).abs() < 1e-5);
/// let by_normals = rough.sampled_by(AllNormals).pdf(sample.wi, wo);
/// let balance = 0.2 / core::f32::consts::TAU + 0.8 * by_normals;
/// assert!((sample.pdf / balance - 1.0).abs() < 1e-5);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Atanasov, Koylazov, Dimov and Wilkie 2022, Appendix B, which does not print its p; Veach and
/// Guibas 1995.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UniformMixture<S, T> {
    other: S,
    /// p and 1 − p, which add up to 1 exactly.
    uniform: T,
    rest: T,
    /// p/(2π).
    density: T,
}

impl<S, T: Real> UniformMixture<S, T> {
    /// Uniform directions with the given probability p, the normals of `other` with 1 − p.
    ///
    /// p is rounded to a multiple of ε/2, as random numbers are.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless 0 ≤ p < 1.
    #[inline]
    pub fn new(other: S, probability: T) -> Result<Self, Error> {
        if !(probability >= T::ZERO && probability < T::ONE) {
            return Err(Error::Parameter {
                name: "probability",
                value: probability.to_f64(),
                smallest: 0.0,
                largest: 1.0,
            });
        }
        // The second difference is exact (Sterbenz): both parts have the probability that their
        // density says.
        let rest = T::ONE - probability;
        let uniform = T::ONE - rest;
        Ok(Self { other, uniform, rest, density: T::HALF * T::FRAC_1_PI * uniform })
    }

    /// The probability ⅘ α², chosen for GTR by the [variances measured](Self#variance); ⅘ for α >
    /// 1, of GGX.
    ///
    /// For a surface under a map, α is that of the profile times the width of the map, √|det M⁻¹|.
    ///
    /// # Errors
    /// [`Error::Alpha`] unless α is within [`alpha_range`](crate::roughness::alpha_range).
    #[inline]
    pub fn for_alpha(other: S, alpha: T) -> Result<Self, Error> {
        let alpha = checked(alpha)?.min(T::ONE);
        Self::new(other, T::lit(0.8) * (alpha * alpha))
    }

    /// The numbers for a normal of the other sampling.
    #[inline(always)]
    fn of_other(&self, u: T::Vec2) -> T::Vec2 {
        let [u1, u2]: [T; 2] = u.into();
        [if u1 < self.rest { u1 / self.rest } else { u1 }, u2].into()
    }

    /// `m` of the other sampling, or the normal halfway between `wo` and a uniform direction.
    #[inline(always)]
    fn or_uniform(&self, wo: T::Vec3, u: T::Vec2, m: T::Vec3) -> T::Vec3 {
        let [u1, u2]: [T; 2] = u.into();
        let u1 = below_one(u1);
        let z = (T::ONE - u1) / self.uniform;
        let radius = ((T::ONE - z) * (T::ONE + z)).sqrt();
        let (sin, cos) = sin_cos_of_turn(u2);
        let [x, y, height]: [T; 3] = wo.into();
        let half = normalized([radius * cos + x, radius * sin + y, z + height]);
        let m: [T; 3] = m.into();
        if u1 < self.rest { m.into() } else { half.into() }
    }

    /// p, the probability of a uniform direction.
    #[inline]
    #[must_use]
    pub fn probability(&self) -> T {
        self.uniform
    }

    /// The sampling of normals in the mixture.
    #[inline]
    #[must_use]
    pub fn other(&self) -> &S {
        &self.other
    }
}

impl<N: Ndf, S: NormalSampling<N>> NormalSampling<N> for UniformMixture<S, N::Scalar> {
    /// A normal of `S`, or the one halfway between `wo` and a uniform direction.
    ///
    /// u.x < 1 − p chooses the normals, for which u.x/(1 − p) is below 1 after rounding too; else
    /// (1 − u.x)/p ∈ (0, 1] is the height of a uniform direction, at least ε/2, so that the half
    /// vector does not vanish.
    #[inline(always)]
    fn sample_along(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> Vec3<N> {
        self.or_uniform(wo, u, self.other.sample_along(surface, wo, self.of_other(u)))
    }

    #[inline(always)]
    fn density_over_d(
        &self,
        surface: &N,
        wo: Vec3<N>,
        sigma_o: N::Scalar,
        wo_m: N::Scalar,
        m_z: N::Scalar,
    ) -> [N::Scalar; 2] {
        let [numerator, denominator] = self.other.density_over_d(surface, wo, sigma_o, wo_m, m_z);
        [self.rest * numerator, denominator]
    }

    #[inline(always)]
    fn constant_density(&self) -> Option<N::Scalar> {
        let density = match self.other.constant_density() {
            None => self.density,
            Some(other) => self.density + self.rest * other,
        };
        // Without it, D may leave the weight, which would be 0/0 where D has underflowed.
        (density > N::Scalar::ZERO).then_some(density)
    }
}

impl<N: Ndf, S: StagedSampling<N>> StagedSampling<N> for UniformMixture<S, N::Scalar> {
    const STRAIGHT: bool = S::STRAIGHT;
    type Solver = S::Solver;

    #[inline(always)]
    fn ask(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> <S::Solver as Solver>::Question {
        self.other.ask(surface, wo, self.of_other(u))
    }

    #[inline(always)]
    fn normal(
        &self,
        surface: &N,
        wo: Vec3<N>,
        u: Vec2<N>,
        answer: <S::Solver as Solver>::Answer,
    ) -> (Vec3<N>, bool) {
        let (m, usual) = self.other.normal(surface, wo, self.of_other(u), answer);
        (self.or_uniform(wo, u, m), usual)
    }
}
