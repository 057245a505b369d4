//! The cost of single reflection: evaluation, density and sampling of a rough conductor with a
//! scalar Schlick term?
//!
//! GGX and Beckmann are sampled by visible normals, GTR by all normals, with or without uniform
//! directions among them.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};
use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::fresnel::{Schlick, Spectrum};
use microsurface::profile::Profile;
use microsurface::{AxisAligned, Beckmann, Ggx, Gtr, Isotropic, Linear, Microsurface, Ndf, Real, SampleNdf};

use crate::input::{
    CALLS, Question, alphas, calls, directions, each_surface, generator, group, materials, stretched,
    transformed, uniform,
};
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
    let heavy = materials(|alpha| Gtr::heavy_tailed::<8>(alpha, T::lit(1.5)).ok());
    Eval::<T>(&mut eval, &pairs).ask("gtr-heavy-8-nodes-1.5", "isotropic", &heavy);
    let any = materials(|alpha| Gtr::isotropic(alpha, T::lit(1.5)).ok());
    Eval::<T>(&mut eval, &pairs).ask("gtr-8-nodes-1.5", "isotropic", &any);
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
    each_visible::<T>(|profile, map, surfaces| surfaces.pdf(&mut pdf, (profile, map), &pairs));
    each_gtr::<T>(|profile, map, surfaces| surfaces.pdf(&mut pdf, (profile, map), &pairs));
    pdf.finish();

    let draw_arrays: Vec<([T; 3], [T; 2])> = draws.iter().map(|&(wo, u)| (wo.into(), u.into())).collect();
    let mut sample = group::<T>(criterion, "reflection_sample");
    each_visible::<T>(|profile, map, surfaces| surfaces.sample(&mut sample, (profile, map), &draws));
    each_gtr::<T>(|profile, map, surfaces| surfaces.sample(&mut sample, (profile, map), &draws));
    calls(&mut sample, ("heitz2018-ggx", "axis-aligned"), &width_pairs, &draw_arrays, |&a, (wo, u)| {
        ggx::sampled_reflection_heitz2018(a, T::lit(F0), wo, u)
    });
    sample.finish();
}

struct Eval<'a, 'b, T: Real>(&'a mut BenchmarkGroup<'b, WallTime>, &'a Pairs<T>);

impl<T: Elementary> Question<T> for Eval<'_, '_, T> {
    fn ask<N: SampleNdf<Scalar = T> + Copy>(&mut self, profile: &str, map: &str, materials: &[N]) {
        let conductors = conductors(materials, VisibleNormals);
        calls(self.0, (profile, map), &conductors, self.1, |brdf, (wi, wo)| brdf.eval(wi, wo));
    }
}

fn conductors<T: Spectrum<Scalar = T> + Real, N: Ndf<Scalar = T> + Copy, S: Copy>(
    surfaces: &[N],
    sampling: S,
) -> Vec<RoughConductor<N, Schlick<T>, S>> {
    let fresnel = Schlick::new(T::lit(F0)).expect("a share");
    surfaces.iter().map(|&surface| RoughConductor::new(surface, fresnel).sampled_by(sampling)).collect()
}

/// A question about a sampler, with the types of the surface and of the choice of normals
/// hidden.
trait Sampler<T: Real> {
    fn pdf(&self, group: &mut BenchmarkGroup<'_, WallTime>, id: (&str, &str), pairs: &Pairs<T>);
    fn sample(&self, group: &mut BenchmarkGroup<'_, WallTime>, id: (&str, &str), draws: &Draws<T>);
}

impl<T, N, S> Sampler<T> for Vec<RoughConductor<N, Schlick<T>, S>>
where
    T: Spectrum<Scalar = T> + Real,
    N: Ndf<Scalar = T>,
    S: NormalSampling<N>,
{
    fn pdf(&self, group: &mut BenchmarkGroup<'_, WallTime>, id: (&str, &str), pairs: &Pairs<T>) {
        calls(group, id, self, pairs, |brdf, (wi, wo)| brdf.pdf(wi, wo));
    }
    fn sample(&self, group: &mut BenchmarkGroup<'_, WallTime>, id: (&str, &str), draws: &Draws<T>) {
        calls(group, id, self, draws, |brdf, (wo, u)| brdf.sample(wo, u));
    }
}

/// The distributions with a sampler of visible normals, under every map.
fn each_visible<T: Elementary>(mut ask: impl FnMut(&str, &str, &dyn Sampler<T>)) {
    each_map("ggx", VisibleNormals, &mut ask, |alpha| Ggx::isotropic(alpha).ok());
    each_map("beckmann", VisibleNormals, &mut ask, |alpha| Beckmann::isotropic(alpha).ok());
}

/// GTR, sampled by all normals and by a mixture, under every map.
fn each_gtr<T: Elementary>(mut ask: impl FnMut(&str, &str, &dyn Sampler<T>)) {
    each_map("gtr-closed-1", AllNormals, &mut ask, |alpha| Gtr::closed::<1>(alpha).ok());
    each_map("gtr-closed-3", AllNormals, &mut ask, |alpha| Gtr::closed::<3>(alpha).ok());
    each_map("gtr-spline-1.5", AllNormals, &mut ask, |alpha| Gtr::spline(alpha, T::lit(1.5)).ok());
    let mixture = UniformMixture::new(AllNormals, T::lit(0.2)).expect("a probability");
    each_map("gtr-spline-1.5-mixture", mixture, &mut ask, |alpha| Gtr::spline(alpha, T::lit(1.5)).ok());
}

fn each_map<T: Elementary, P: Profile<T>, S>(
    profile: &str,
    sampling: S,
    ask: &mut impl FnMut(&str, &str, &dyn Sampler<T>),
    surface: impl Fn(T) -> Option<Microsurface<P, Isotropic<T>>>,
) where
    S: Copy
        + NormalSampling<Microsurface<P, Isotropic<T>>>
        + NormalSampling<Microsurface<P, AxisAligned<T>>>
        + NormalSampling<Microsurface<P, Linear<T>>>,
{
    ask(profile, "isotropic", &conductors(&materials(&surface), sampling));
    ask(profile, "axis-aligned", &conductors(&stretched(&surface), sampling));
    ask(profile, "general", &conductors(&transformed(&surface), sampling));
}
