//! Which micronormals a BSDF samples.

use crate::Real;
use crate::ndf::{Course, Ndf, SampleNdf, SampleVndf, Slopes, Vec2, Vec3};

/// A way to draw the micronormal a ray is reflected by.
///
/// The density of the reflected directions is p(wi) = D(wm) `density_over_d` + `constant_density`, 1/sr. A strategy
/// without the constant has a weight that contains no D.
pub trait NormalSampling<N: Ndf> {
    /// See [`SampleVndf::course`].
    #[doc(hidden)]
    #[inline(always)]
    #[must_use]
    fn course(&self, _surface: &N) -> Course {
        Course::Straight
    }

    /// A unit normal for the direction `wo`, from u ∈ [0, 1)².
    fn sample(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> Vec3<N>;

    /// See [`SampleVndf::sample_along`].
    #[doc(hidden)]
    #[inline(always)]
    fn sample_along(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> Vec3<N> {
        self.sample(surface, wo, u)
    }

    /// See [`SampleVndf::usual_sample_along`].
    #[doc(hidden)]
    #[inline(always)]
    fn usual_sample_along(
        &self,
        surface: &N,
        wo: Vec3<N>,
        u: Vec2<N>,
        _slopes: Slopes<'_, N::Scalar>,
    ) -> (Vec3<N>, bool) {
        (self.sample_along(surface, wo, u), true)
    }

    /// The density of directions reflected by normals in proportion to D, over D(wm): p(wm)/(4 (wo·wm) D(wm)), as a
    /// fraction, numerator and denominator, so that whoever divides by more divides once.
    ///
    /// # Domain
    /// `wo_m` = wo·m and `m_z` = m.z are positive, of a vector m of any length along wm; `sigma_o` = σ(wo).
    fn density_over_d(&self, sigma_o: N::Scalar, wo_m: N::Scalar, m_z: N::Scalar) -> [N::Scalar; 2];

    /// The part of the density that is the same for every direction above the horizon, 1/sr; above 0, and `None` where
    /// there is none, which the compiler should see.
    #[inline(always)]
    fn constant_density(&self) -> Option<N::Scalar> {
        None
    }
}

/// The normals visible from the viewer, of density D_w: the sample's weight exceeds the reflectance by rounding
/// alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct VisibleNormals;

/// All normals, of density D(wm) wm.z, visible or not: for distributions whose visible normals cannot be drawn.
///
/// Weights are unbounded towards grazing angles, and so is the density of directions, D wm.z/(4 wo·wm): it overflows to
/// ∞ where the cosine wo·wm is smaller than D over the largest number of the scalar.
/// [`UniformMixture`](crate::bsdf::UniformMixture) bounds the weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AllNormals;

impl<N: SampleVndf> NormalSampling<N> for VisibleNormals {
    #[inline(always)]
    fn course(&self, surface: &N) -> Course {
        surface.course()
    }

    #[inline(always)]
    fn sample(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> Vec3<N> {
        surface.sample_vndf(wo, u)
    }

    #[inline(always)]
    fn sample_along(&self, surface: &N, wo: Vec3<N>, u: Vec2<N>) -> Vec3<N> {
        surface.sample_along(wo, u)
    }

    #[inline(always)]
    fn usual_sample_along(
        &self,
        surface: &N,
        wo: Vec3<N>,
        u: Vec2<N>,
        slopes: Slopes<'_, N::Scalar>,
    ) -> (Vec3<N>, bool) {
        surface.usual_sample_along(wo, u, slopes)
    }

    #[inline(always)]
    fn density_over_d(&self, sigma_o: N::Scalar, _: N::Scalar, _: N::Scalar) -> [N::Scalar; 2] {
        [N::Scalar::ONE, N::Scalar::lit(4.0) * sigma_o]
    }
}

impl<N: SampleNdf> NormalSampling<N> for AllNormals {
    #[inline(always)]
    fn sample(&self, surface: &N, _: Vec3<N>, u: Vec2<N>) -> Vec3<N> {
        surface.sample_d(u)
    }

    #[inline(always)]
    fn density_over_d(&self, _: N::Scalar, wo_m: N::Scalar, m_z: N::Scalar) -> [N::Scalar; 2] {
        [m_z, N::Scalar::lit(4.0) * wo_m]
    }
}
