//! Reflection of many directions.

use crate::batch::blocks::Body;
use crate::batch::{Directions, Material, Materials, Numbers, Samples};
use crate::bsdf::{NormalSampling, RoughConductor};
use crate::fresnel::{Fresnel, Spectrum};
use crate::ndf::{Course, Ndf, Slopes};

/// A direction, a weight and a density, as [`Samples`] stores them.
type Sampled<T, S> = ((T, T, T), S, T);

/// A BSDF of reflection by its scalar methods, as batches see it. Sealed: [`RoughConductor`].
pub trait Reflection: Material {
    /// See [`NormalSampling`].
    fn course(&self) -> Course;
    type Scalar: crate::Real;
    type Spectrum: Spectrum<Scalar = Self::Scalar>;
    fn eval_of(&self, wi: [Self::Scalar; 3], wo: [Self::Scalar; 3]) -> Self::Spectrum;
    fn pdf_of(&self, wi: [Self::Scalar; 3], wo: [Self::Scalar; 3]) -> Self::Scalar;
    fn normal_of(&self, wo: [Self::Scalar; 3], u: [Self::Scalar; 2]) -> [Self::Scalar; 3];
    fn usual_normal_of(
        &self,
        wo: [Self::Scalar; 3],
        u: [Self::Scalar; 2],
        slopes: Slopes<'_, Self::Scalar>,
    ) -> ([Self::Scalar; 3], bool);
    fn reflected_of(
        &self,
        wo: [Self::Scalar; 3],
        normal: [Self::Scalar; 3],
    ) -> Sampled<Self::Scalar, Self::Spectrum>;
}

impl<N, F, S> Reflection for RoughConductor<N, F, S>
where
    N: Ndf + Copy,
    F: Fresnel + Copy,
    F::Output: Spectrum<Scalar = N::Scalar>,
    S: NormalSampling<N> + Copy,
{
    type Scalar = N::Scalar;
    type Spectrum = F::Output;
    #[inline(always)]
    fn course(&self) -> Course {
        self.sampling().course(self.surface())
    }
    #[inline(always)]
    fn eval_of(&self, wi: [N::Scalar; 3], wo: [N::Scalar; 3]) -> F::Output {
        self.eval(wi.into(), wo.into())
    }
    #[inline(always)]
    fn pdf_of(&self, wi: [N::Scalar; 3], wo: [N::Scalar; 3]) -> N::Scalar {
        self.pdf(wi.into(), wo.into())
    }
    #[inline(always)]
    fn normal_of(&self, wo: [N::Scalar; 3], u: [N::Scalar; 2]) -> [N::Scalar; 3] {
        self.sampling().sample_along(self.surface(), wo.into(), u.into()).into()
    }
    #[inline(always)]
    fn usual_normal_of(
        &self,
        wo: [N::Scalar; 3],
        u: [N::Scalar; 2],
        slopes: Slopes<'_, N::Scalar>,
    ) -> ([N::Scalar; 3], bool) {
        let (normal, usual) = self.sampling().usual_sample_along(self.surface(), wo.into(), u.into(), slopes);
        (normal.into(), usual)
    }
    #[inline(always)]
    fn reflected_of(&self, wo: [N::Scalar; 3], normal: [N::Scalar; 3]) -> Sampled<N::Scalar, F::Output> {
        let sample = self.reflected_or_nothing(wo.into(), normal.into());
        let wi: [N::Scalar; 3] = sample.wi.into();
        (wi.into(), sample.weight, sample.pdf)
    }
}

struct Eval;
struct Pdf;
struct EvalAndPdf;
struct Sample;

type Vec3<R> = [<R as Reflection>::Scalar; 3];
type Vec2<R> = [<R as Reflection>::Scalar; 2];

impl<R: Reflection> Body<R, (Vec3<R>, Vec3<R>)> for Eval {
    type Number = R::Scalar;
    type Out = R::Spectrum;
    #[inline(always)]
    fn of(&self, brdf: &R, (wi, wo): (Vec3<R>, Vec3<R>), _: Vec3<R>) -> R::Spectrum {
        brdf.eval_of(wi, wo)
    }
}

impl<R: Reflection> Body<R, (Vec3<R>, Vec3<R>)> for Pdf {
    type Number = R::Scalar;
    type Out = R::Scalar;
    #[inline(always)]
    fn of(&self, brdf: &R, (wi, wo): (Vec3<R>, Vec3<R>), _: Vec3<R>) -> R::Scalar {
        brdf.pdf_of(wi, wo)
    }
}

impl<R: Reflection> Body<R, (Vec3<R>, Vec3<R>)> for EvalAndPdf {
    type Number = R::Scalar;
    type Out = (R::Spectrum, R::Scalar);
    #[inline(always)]
    fn of(&self, brdf: &R, (wi, wo): (Vec3<R>, Vec3<R>), _: Vec3<R>) -> Self::Out {
        (brdf.eval_of(wi, wo), brdf.pdf_of(wi, wo))
    }
}

impl<R: Reflection> Body<R, (Vec3<R>, Vec2<R>)> for Sample {
    type Number = R::Scalar;
    type Out = Sampled<R::Scalar, R::Spectrum>;
    #[inline(always)]
    fn course(&self, brdf: &R) -> Course {
        brdf.course()
    }
    #[inline(always)]
    fn normal(&self, brdf: &R, (wo, u): (Vec3<R>, Vec2<R>)) -> Vec3<R> {
        brdf.normal_of(wo, u)
    }
    #[inline(always)]
    fn usual_normal(
        &self,
        brdf: &R,
        (wo, u): (Vec3<R>, Vec2<R>),
        slopes: Slopes<'_, R::Scalar>,
    ) -> (Vec3<R>, bool) {
        brdf.usual_normal_of(wo, u, slopes)
    }
    #[inline(always)]
    fn of(&self, brdf: &R, (wo, _): (Vec3<R>, Vec2<R>), normal: Vec3<R>) -> Self::Out {
        brdf.reflected_of(wo, normal)
    }
}

/// The scalar of the BRDFs of a batch.
type Scalar<B> = <<B as Materials>::Material as Reflection>::Scalar;
/// f of the BRDFs of a batch: a scalar, or three in a glam vector.
type Value<B> = <<B as Materials>::Material as Reflection>::Spectrum;

/// [`RoughConductor`] over many directions: on a BRDF, or on a slice with one for each element.
///
/// Domains and special cases are those of the method without `_batch`, element by element. f and weights are written as
/// the Fresnel term gives them, one scalar or one glam vector for each element.
///
/// # Panics
/// Every method where slices, that of BRDFs included, differ in length; nothing has been written then.
///
/// # Example
/// ```
/// use microsurface::batch::{Directions, ReflectionBatch};
/// use microsurface::{Ggx, bsdf::RoughConductor, fresnel::Schlick, glam::Vec3};
/// let gold = RoughConductor::new(Ggx::isotropic(0.2_f32)?, Schlick::new(Vec3::new(1.0, 0.78, 0.34))?);
/// let wi = Directions { x: &[-0.6, 0.0], y: &[0.0, 0.6], z: &[0.8, 0.8] };
/// let wo = Directions { x: &[0.6, 0.0], y: &[0.0, -0.6], z: &[0.8, 0.8] };
/// let (mut f, mut pdf) = ([Vec3::ZERO; 2], [0.0; 2]);
/// gold.eval_and_pdf_batch(wi, wo, &mut f, &mut pdf);
/// assert_eq!(f[0], gold.eval(Vec3::new(-0.6, 0.0, 0.8), Vec3::new(0.6, 0.0, 0.8)));
/// # Ok::<(), microsurface::Error>(())
/// ```
pub trait ReflectionBatch: Materials<Material: Reflection> {
    /// f(wi, wo), see [`RoughConductor::eval`].
    #[inline]
    fn eval_batch(
        &self,
        wi: Directions<'_, Scalar<Self>>,
        wo: Directions<'_, Scalar<Self>>,
        out: &mut [Value<Self>],
    ) {
        self.each(Eval, (wi, wo), out);
    }

    /// The density with which wi is sampled, see [`RoughConductor::pdf`].
    #[inline]
    fn pdf_batch(
        &self,
        wi: Directions<'_, Scalar<Self>>,
        wo: Directions<'_, Scalar<Self>>,
        out: &mut [Scalar<Self>],
    ) {
        self.each(Pdf, (wi, wo), out);
    }

    /// Both together: the half vector, D and σ(wo) are computed once.
    #[inline]
    fn eval_and_pdf_batch(
        &self,
        wi: Directions<'_, Scalar<Self>>,
        wo: Directions<'_, Scalar<Self>>,
        f: &mut [Value<Self>],
        pdf: &mut [Scalar<Self>],
    ) {
        self.each(EvalAndPdf, (wi, wo), (f, pdf));
    }

    /// Directions to the light, weights and densities, see [`RoughConductor::sample`].
    ///
    /// # Special cases
    /// Where `sample` returns `None` → weight 0 and density 0; wi is then no direction to follow.
    #[inline]
    fn sample_batch(
        &self,
        wo: Directions<'_, Scalar<Self>>,
        u: Numbers<'_, Scalar<Self>>,
        out: Samples<'_, Scalar<Self>, Value<Self>>,
    ) {
        self.each(Sample, (wo, u), out);
    }
}

impl<M: Materials<Material: Reflection> + ?Sized> ReflectionBatch for M {}
