//! Reflection of many directions.

use crate::batch::arrays::{Directions, Numbers, Samples};
use crate::batch::material::Materials;
use crate::batch::stages::{Body, without_normals};
use crate::bsdf::{RoughConductor, StagedSampling};
use crate::fresnel::{Fresnel, Spectrum};
use crate::ndf::Ndf;
use crate::ndf::staged::Solver;
use crate::real::Real;

/// A direction, a weight and a density, as [`Samples`] stores them.
type Sampled<T, S> = ((T, T, T), S, T);

/// A BSDF of reflection by its scalar methods, as batches see it. Sealed: [`RoughConductor`].
pub trait Reflection: sealed::Sealed {
    /// f32 or f64.
    type Scalar: Real;
    /// f: a scalar, or a glam vector of three.
    type Spectrum: Spectrum<Scalar = Self::Scalar>;
    #[doc(hidden)]
    const STRAIGHT: bool;
    #[doc(hidden)]
    type Solver: Solver;
    #[doc(hidden)]
    fn eval_of(&self, wi: [Self::Scalar; 3], wo: [Self::Scalar; 3]) -> Self::Spectrum;
    #[doc(hidden)]
    fn pdf_of(&self, wi: [Self::Scalar; 3], wo: [Self::Scalar; 3]) -> Self::Scalar;
    #[doc(hidden)]
    fn ask(&self, wo: [Self::Scalar; 3], u: [Self::Scalar; 2]) -> <Self::Solver as Solver>::Question;
    #[doc(hidden)]
    fn normal(
        &self,
        wo: [Self::Scalar; 3],
        u: [Self::Scalar; 2],
        answer: <Self::Solver as Solver>::Answer,
    ) -> ([Self::Scalar; 3], bool);
    #[doc(hidden)]
    fn normal_in_full(&self, wo: [Self::Scalar; 3], u: [Self::Scalar; 2]) -> [Self::Scalar; 3];
    #[doc(hidden)]
    fn reflected(
        &self,
        wo: [Self::Scalar; 3],
        normal: [Self::Scalar; 3],
    ) -> Sampled<Self::Scalar, Self::Spectrum>;
}

mod sealed {
    pub trait Sealed {}
    impl<N, F, S> Sealed for crate::bsdf::RoughConductor<N, F, S> {}
}

impl<N, F, S> Reflection for RoughConductor<N, F, S>
where
    N: Ndf,
    F: Fresnel,
    F::Output: Spectrum<Scalar = N::Scalar>,
    S: StagedSampling<N>,
{
    type Scalar = N::Scalar;
    type Spectrum = F::Output;
    const STRAIGHT: bool = S::STRAIGHT;
    type Solver = S::Solver;
    #[inline(always)]
    fn eval_of(&self, wi: [N::Scalar; 3], wo: [N::Scalar; 3]) -> F::Output {
        self.eval(wi.into(), wo.into())
    }
    #[inline(always)]
    fn pdf_of(&self, wi: [N::Scalar; 3], wo: [N::Scalar; 3]) -> N::Scalar {
        self.pdf(wi.into(), wo.into())
    }
    #[inline(always)]
    fn ask(&self, wo: [N::Scalar; 3], u: [N::Scalar; 2]) -> <S::Solver as Solver>::Question {
        self.sampling().ask(self.surface(), wo.into(), u.into())
    }
    #[inline(always)]
    fn normal(
        &self,
        wo: [N::Scalar; 3],
        u: [N::Scalar; 2],
        answer: <S::Solver as Solver>::Answer,
    ) -> ([N::Scalar; 3], bool) {
        let (normal, usual) = self.sampling().normal(self.surface(), wo.into(), u.into(), answer);
        (normal.into(), usual)
    }
    #[inline(always)]
    fn normal_in_full(&self, wo: [N::Scalar; 3], u: [N::Scalar; 2]) -> [N::Scalar; 3] {
        self.sampling().sample_along(self.surface(), wo.into(), u.into()).into()
    }
    #[inline(always)]
    fn reflected(&self, wo: [N::Scalar; 3], normal: [N::Scalar; 3]) -> Sampled<N::Scalar, F::Output> {
        let sample = self.reflected_or_nothing(wo.into(), normal.into());
        let wi: [N::Scalar; 3] = sample.wi.into();
        (wi.into(), sample.weight, sample.pdf)
    }
}

type Vec3<R> = [<R as Reflection>::Scalar; 3];
type Vec2<R> = [<R as Reflection>::Scalar; 2];

/// A body of both directions.
macro_rules! of_directions {
    ($name:ident: $out:ty, |$brdf:ident, $wi:ident, $wo:ident| $body:expr) => {
        struct $name;
        impl<R: Reflection> Body<R, (Vec3<R>, Vec3<R>)> for $name {
            type Out = $out;
            without_normals!(R, (Vec3<R>, Vec3<R>), R::Scalar);
            #[inline(always)]
            fn result(&self, $brdf: &R, ($wi, $wo): (Vec3<R>, Vec3<R>), _: Vec3<R>) -> $out {
                $body
            }
        }
    };
}
of_directions!(Eval: R::Spectrum, |brdf, wi, wo| brdf.eval_of(wi, wo));
of_directions!(Pdf: R::Scalar, |brdf, wi, wo| brdf.pdf_of(wi, wo));
of_directions!(EvalAndPdf: (R::Spectrum, R::Scalar), |brdf, wi, wo| (brdf.eval_of(wi, wo), brdf.pdf_of(wi, wo)));

struct Sample;
impl<R: Reflection> Body<R, (Vec3<R>, Vec2<R>)> for Sample {
    type Number = R::Scalar;
    type Out = Sampled<R::Scalar, R::Spectrum>;
    const STRAIGHT: bool = R::STRAIGHT;
    type Solver = R::Solver;
    #[inline(always)]
    fn ask(&self, brdf: &R, (wo, u): (Vec3<R>, Vec2<R>)) -> <R::Solver as Solver>::Question {
        brdf.ask(wo, u)
    }
    #[inline(always)]
    fn normal(
        &self,
        brdf: &R,
        (wo, u): (Vec3<R>, Vec2<R>),
        answer: <R::Solver as Solver>::Answer,
    ) -> (Vec3<R>, bool) {
        brdf.normal(wo, u, answer)
    }
    #[inline(always)]
    fn normal_in_full(&self, brdf: &R, (wo, u): (Vec3<R>, Vec2<R>)) -> Vec3<R> {
        brdf.normal_in_full(wo, u)
    }
    #[inline(always)]
    fn result(&self, brdf: &R, (wo, _): (Vec3<R>, Vec2<R>), normal: Vec3<R>) -> Self::Out {
        brdf.reflected(wo, normal)
    }
}

/// [`RoughConductor`] over many directions: on a BRDF, or on a slice with one for each element.
///
/// Domains and special cases are those of the method without `_batch`, element by element. f and
/// weights are written as the Fresnel term gives them, one scalar or one glam vector for each
/// element.
///
/// # Panics
/// Every method where slices, that of BRDFs included, differ in length; nothing has been written
/// then.
///
/// # Example
/// ```
/// use microsurface::batch::{Directions, ReflectionBatch};
/// use microsurface::{Ggx, bsdf::RoughConductor, fresnel::Schlick, glam::Vec3};
/// let f0 = Schlick::new(Vec3::new(1.0, 0.78, 0.34))?;
/// let gold = RoughConductor::new(Ggx::isotropic(0.2_f32)?, f0);
/// let wi = Directions { x: &[-0.6, 0.0], y: &[0.0, 0.6], z: &[0.8, 0.8] };
/// let wo = Directions { x: &[0.6, 0.0], y: &[0.0, -0.6], z: &[0.8, 0.8] };
/// let (mut f, mut pdf) = ([Vec3::ZERO; 2], [0.0; 2]);
/// gold.eval_and_pdf_batch(wi, wo, &mut f, &mut pdf);
/// assert_eq!(f[0], gold.eval(Vec3::new(-0.6, 0.0, 0.8), Vec3::new(0.6, 0.0, 0.8)));
/// # Ok::<(), microsurface::Error>(())
/// ```
pub trait ReflectionBatch: Materials {
    /// f32 or f64.
    type Scalar: Real;
    /// f: a scalar, or a glam vector of three.
    type Spectrum: Spectrum<Scalar = Self::Scalar>;

    /// f(wi, wo), see [`RoughConductor::eval`].
    fn eval_batch(
        &self,
        wi: Directions<'_, Self::Scalar>,
        wo: Directions<'_, Self::Scalar>,
        out: &mut [Self::Spectrum],
    );

    /// The density with which wi is sampled, see [`RoughConductor::pdf`].
    fn pdf_batch(
        &self,
        wi: Directions<'_, Self::Scalar>,
        wo: Directions<'_, Self::Scalar>,
        out: &mut [Self::Scalar],
    );

    /// Both together: the half vector, D and σ(wo) are computed once.
    fn eval_and_pdf_batch(
        &self,
        wi: Directions<'_, Self::Scalar>,
        wo: Directions<'_, Self::Scalar>,
        f: &mut [Self::Spectrum],
        pdf: &mut [Self::Scalar],
    );

    /// Directions to the light, weights and densities, see [`RoughConductor::sample`].
    ///
    /// # Special cases
    /// Where `sample` returns `None` → weight 0 and density 0; wi is then no direction to follow.
    fn sample_batch(
        &self,
        wo: Directions<'_, Self::Scalar>,
        u: Numbers<'_, Self::Scalar>,
        out: Samples<'_, Self::Scalar, Self::Spectrum>,
    );
}

impl<M: Materials<Material: Reflection> + ?Sized> ReflectionBatch for M {
    type Scalar = <M::Material as Reflection>::Scalar;
    type Spectrum = <M::Material as Reflection>::Spectrum;

    #[inline]
    fn eval_batch(
        &self,
        wi: Directions<'_, Self::Scalar>,
        wo: Directions<'_, Self::Scalar>,
        out: &mut [Self::Spectrum],
    ) {
        self.each(Eval, (wi, wo), out);
    }

    #[inline]
    fn pdf_batch(
        &self,
        wi: Directions<'_, Self::Scalar>,
        wo: Directions<'_, Self::Scalar>,
        out: &mut [Self::Scalar],
    ) {
        self.each(Pdf, (wi, wo), out);
    }

    #[inline]
    fn eval_and_pdf_batch(
        &self,
        wi: Directions<'_, Self::Scalar>,
        wo: Directions<'_, Self::Scalar>,
        f: &mut [Self::Spectrum],
        pdf: &mut [Self::Scalar],
    ) {
        self.each(EvalAndPdf, (wi, wo), (f, pdf));
    }

    #[inline]
    fn sample_batch(
        &self,
        wo: Directions<'_, Self::Scalar>,
        u: Numbers<'_, Self::Scalar>,
        out: Samples<'_, Self::Scalar, Self::Spectrum>,
    ) {
        self.each(Sample, (wo, u), out);
    }
}
