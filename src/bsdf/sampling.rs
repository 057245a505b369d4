//! Which micronormals a BSDF samples.

use crate::Real;
use crate::ndf::staged::{Solver, StagedVndf};
use crate::ndf::{Ndf, SampleNdf, SampleVndf, Vec2, Vec3};

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::VisibleNormals {}
    impl Sealed for super::AllNormals {}
    impl<S, T> Sealed for crate::bsdf::UniformMixture<S, T> {}
}

/// A way to draw the micronormal a ray is reflected by.
///
/// The density of the reflected directions is p(wi) = D(wm) `density_over_d` + `constant_density`,
/// 1/sr. A strategy without the constant has a weight that contains no D. Sealed:
/// [`VisibleNormals`], [`AllNormals`], [`UniformMixture`](crate::bsdf::UniformMixture).
pub trait NormalSampling<N: Ndf>: sealed::Sealed {
    /// A vector along the normal for the direction `wo`, of any length, from u ∈ [0, 1)².
    fn sample_along(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> Vec3<N>;

    /// The density of directions reflected by normals in proportion to D, over D(wm):
    /// p(wm)/(4 (wo·wm) D(wm)), as numerator and denominator, for one quotient with what follows.
    ///
    /// # Domain
    /// `sigma_o` = σ(wo); `wo_m` = wo·m and `m_z` = m.z are positive, of a vector m of any length
    /// along wm.
    fn density_over_d(
        &self,
        surface: &N,
        wo: Vec3<N>,
        sigma_o: N::Scalar,
        wo_m: N::Scalar,
        m_z: N::Scalar,
    ) -> [N::Scalar; 2];

    /// The part of the density that is the same for every direction above the horizon, 1/sr. Above
    /// 0; `None` where there is none.
    #[inline(always)]
    fn constant_density(&self) -> Option<N::Scalar> {
        None
    }
}

/// The stages of [`NormalSampling`] for batches; see [`StagedVndf`].
pub trait StagedSampling<N: Ndf>: NormalSampling<N> {
    const STRAIGHT: bool;
    type Solver: Solver;
    fn ask(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> <Self::Solver as Solver>::Question;
    fn normal(
        &self,
        surface: &N,
        wo: Vec3<N>,
        u: Vec2<N>,
        answer: <Self::Solver as Solver>::Answer,
    ) -> (Vec3<N>, bool);
}

/// The normals visible from the viewer, of density D_w: the sample's weight exceeds the reflectance
/// by rounding alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct VisibleNormals;

/// All normals, of density D(wm) wm.z, visible or not: for distributions whose visible normals
/// cannot be drawn.
///
/// Weights are unbounded towards grazing angles, and so is the density of directions, D wm.z/(4
/// wo·wm): it overflows to ∞ where the cosine wo·wm is smaller than D over the largest number of
/// the scalar. [`UniformMixture`](crate::bsdf::UniformMixture) bounds the weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AllNormals;

impl<N: SampleVndf> NormalSampling<N> for VisibleNormals {
    #[inline(always)]
    fn sample_along(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> Vec3<N> {
        surface.sample_vndf_along(wo, u)
    }

    #[inline(always)]
    fn density_over_d(
        &self,
        _: &N,
        _: Vec3<N>,
        sigma_o: N::Scalar,
        _: N::Scalar,
        _: N::Scalar,
    ) -> [N::Scalar; 2] {
        [N::Scalar::ONE, N::Scalar::lit(4.0) * sigma_o]
    }
}

impl<N: StagedVndf> StagedSampling<N> for VisibleNormals {
    const STRAIGHT: bool = N::STRAIGHT;
    type Solver = N::Solver;

    #[inline(always)]
    fn ask(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> <N::Solver as Solver>::Question {
        surface.ask(wo, u)
    }

    #[inline(always)]
    fn normal(
        &self,
        surface: &N,
        wo: Vec3<N>,
        u: Vec2<N>,
        answer: <N::Solver as Solver>::Answer,
    ) -> (Vec3<N>, bool) {
        surface.normal(wo, u, answer)
    }
}

impl<N: SampleNdf> NormalSampling<N> for AllNormals {
    #[inline(always)]
    fn sample_along(&self, surface: &N, _: Vec3<N>, u: Vec2<N>) -> Vec3<N> {
        surface.sample_d(u)
    }

    #[inline(always)]
    fn density_over_d(
        &self,
        _: &N,
        _: Vec3<N>,
        _: N::Scalar,
        wo_m: N::Scalar,
        m_z: N::Scalar,
    ) -> [N::Scalar; 2] {
        [m_z, N::Scalar::lit(4.0) * wo_m]
    }
}

impl<N: SampleNdf> StagedSampling<N> for AllNormals {
    const STRAIGHT: bool = true;
    type Solver = ();

    #[inline(always)]
    fn ask(&self, _: &N, _: Vec3<N>, _: Vec2<N>) {}

    #[inline(always)]
    fn normal(&self, surface: &N, _: Vec3<N>, u: Vec2<N>, (): ()) -> (Vec3<N>, bool) {
        (surface.sample_d(u), true)
    }
}
