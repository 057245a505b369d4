//! The cost of single reflection: evaluation, density and sampling of a rough conductor with a
//! scalar Schlick term?
//!
//! Sampled are visible normals where they can be drawn; else all normals, with or without uniform
//! directions among them.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};
use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::fresnel::{Schlick, Spectrum};
use microsurface::{Ndf, Real, SampleNdf, SampleVndf};

use crate::input::{CALLS, Question, alphas, calls, directions, each_surface, generator, group, uniform};
use crate::textbook::{Anisotropic, Elementary, Width, beckmann, ggx};

/// Reflectance at normal incidence.
const F0: f64 = 0.9;

/// Pairs of directions.
type Pairs<T> = [(<T as Real>::Vec3, <T as Real>::Vec3)];
/// A direction and two random numbers.
type Draws<T> = [(<T as Real>::Vec3, <T as Real>::Vec2)];

pub(crate) fn bench(criterion: &mut Criterion) {
    scalar::<f32>(criterion);
    scalar::<f64>(criterion);
}

fn scalar<T: Elementary>(criterion: &mut Criterion) {
    let mut rng = generator();
    let wi = directions::<T>(CALLS, &mut rng);
    let wo = directions::<T>(CALLS, &mut rng);
    let pairs: Vec<_> = wi.iter().copied().zip(wo.iter().copied()).collect();
    let (u1, u2) = (uniform::<T>(CALLS, &mut rng), uniform::<T>(CALLS, &mut rng));
    let draws: Vec<(T::Vec3, T::Vec2)> =
        wo.iter().zip(u1.iter().zip(&u2)).map(|(&wo, (&u1, &u2))| (wo, [u1, u2].into())).collect();

    let mut eval = group::<T>(criterion, "reflection_eval");
    each_surface(&mut Eval::<T>(&mut eval, &pairs));
    let arrays: Vec<([T; 3], [T; 3])> = pairs.iter().map(|&(wi, wo)| (wi.into(), wo.into())).collect();
    let widths: Vec<_> = alphas::<T>().into_iter().map(Width::new).collect();
    let width_pairs: Vec<_> = alphas::<T>().into_iter().map(Anisotropic::new).collect();
    calls(&mut eval, ("textbook-ggx", "isotropic"), &widths, &arrays, |&a, (wi, wo)| {
        ggx::reflection(a, T::lit(F0), wi, wo)
    });
    calls(&mut eval, ("textbook-ggx", "axis-aligned"), &width_pairs, &arrays, |&a, (wi, wo)| {
        ggx::reflection_anisotropic(a, T::lit(F0), wi, wo)
    });
    calls(&mut eval, ("textbook-beckmann-walter2007", "isotropic"), &widths, &arrays, |&a, (wi, wo)| {
        beckmann::reflection_walter2007(a, T::lit(F0), wi, wo)
    });
    eval.finish();

    let mut pdf = group::<T>(criterion, "reflection_pdf");
    each_surface(&mut Sampled(&mut pdf, Pdf::<T>(&pairs)));
    pdf.finish();

    let draw_arrays: Vec<([T; 3], [T; 2])> = draws.iter().map(|&(wo, u)| (wo.into(), u.into())).collect();
    let mut sample = group::<T>(criterion, "reflection_sample");
    each_surface(&mut Sampled(&mut sample, Sample::<T>(&draws)));
    calls(&mut sample, ("heitz2018-ggx", "axis-aligned"), &width_pairs, &draw_arrays, |&a, (wo, u)| {
        ggx::sampled_reflection_heitz2018(a, T::lit(F0), wo, u)
    });
    sample.finish();
}

struct Eval<'a, 'b, T: Real>(&'a mut BenchmarkGroup<'b, WallTime>, &'a Pairs<T>);

impl<T: Elementary> Question<T> for Eval<'_, '_, T> {
    fn ask<N: SampleNdf<Scalar = T> + Copy>(&mut self, id: (&str, &str), materials: &[N]) {
        let conductors = conductors(materials, VisibleNormals);
        calls(self.0, id, &conductors, self.1, |brdf, (wi, wo)| brdf.eval(wi, wo));
    }
}

fn conductors<T: Spectrum<Scalar = T> + Real, N: Ndf<Scalar = T> + Copy, S: Copy>(
    surfaces: &[N],
    sampling: S,
) -> Vec<RoughConductor<N, Schlick<T>, S>> {
    let fresnel = Schlick::new(T::lit(F0)).expect("a share");
    surfaces.iter().map(|&surface| RoughConductor::new(surface, fresnel).sampled_by(sampling)).collect()
}

/// A question about every sampling of a distribution: visible normals where they can be drawn, else
/// all of them, alone and among uniform directions.
struct Sampled<'a, 'b, F>(&'a mut BenchmarkGroup<'b, WallTime>, F);

/// A question about a sampler.
trait Ask<T: Real> {
    fn ask<N, S>(
        &self,
        group: &mut BenchmarkGroup<'_, WallTime>,
        id: (&str, &str),
        conductors: &[RoughConductor<N, Schlick<T>, S>],
    ) where
        N: Ndf<Scalar = T>,
        S: NormalSampling<N>;
}

struct Pdf<'a, T: Real>(&'a Pairs<T>);
struct Sample<'a, T: Real>(&'a Draws<T>);

impl<T: Elementary> Ask<T> for Pdf<'_, T> {
    fn ask<N, S>(
        &self,
        group: &mut BenchmarkGroup<'_, WallTime>,
        id: (&str, &str),
        conductors: &[RoughConductor<N, Schlick<T>, S>],
    ) where
        N: Ndf<Scalar = T>,
        S: NormalSampling<N>,
    {
        calls(group, id, conductors, self.0, |brdf, (wi, wo)| brdf.pdf(wi, wo));
    }
}

impl<T: Elementary> Ask<T> for Sample<'_, T> {
    fn ask<N, S>(
        &self,
        group: &mut BenchmarkGroup<'_, WallTime>,
        id: (&str, &str),
        conductors: &[RoughConductor<N, Schlick<T>, S>],
    ) where
        N: Ndf<Scalar = T>,
        S: NormalSampling<N>,
    {
        calls(group, id, conductors, self.0, |brdf, (wo, u)| brdf.sample(wo, u));
    }
}

impl<T: Elementary, F: Ask<T>> Question<T> for Sampled<'_, '_, F> {
    fn ask<N: SampleNdf<Scalar = T> + Copy>(&mut self, (name, map): (&str, &str), materials: &[N]) {
        self.1.ask(self.0, (name, map), &conductors(materials, AllNormals));
        let mixture = UniformMixture::new(AllNormals, T::lit(0.2)).expect("a probability");
        self.1.ask(self.0, (&format!("{name}-mixture"), map), &conductors(materials, mixture));
    }

    fn ask_visible<N: SampleNdf<Scalar = T> + SampleVndf + Copy>(
        &mut self,
        id: (&str, &str),
        materials: &[N],
    ) {
        self.1.ask(self.0, id, &conductors(materials, VisibleNormals));
    }
}
