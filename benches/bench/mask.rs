//! The cost of the projected area σ, Smith's Λ and the mask G1, under which map, and beside the
//! textbook's forms?

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};
use microsurface::{Beckmann, Gtr, Microsurface, Real, SampleNdf};

use crate::input::{
    CALLS, Question, alphas, calls, directions, each_surface, generator, group, materials, normals,
};
use crate::textbook::{Anisotropic, Elementary, Width, beckmann, ggx};

struct Sigma<'a, 'b, T: Real>(&'a mut BenchmarkGroup<'b, WallTime>, &'a [T::Vec3]);
struct Lambda<'a, 'b, T: Real>(&'a mut BenchmarkGroup<'b, WallTime>, &'a [T::Vec3]);
struct G1<'a, 'b, T: Real>(&'a mut BenchmarkGroup<'b, WallTime>, &'a [T::Vec3]);

impl<T: Real> Question<T> for Sigma<'_, '_, T> {
    fn ask<N: SampleNdf<Scalar = T> + Copy>(&mut self, id: (&str, &str), materials: &[N]) {
        calls(self.0, id, materials, self.1, N::sigma);
    }
}

impl<T: Real> Question<T> for Lambda<'_, '_, T> {
    fn ask<N: SampleNdf<Scalar = T> + Copy>(&mut self, id: (&str, &str), materials: &[N]) {
        calls(self.0, id, materials, self.1, N::lambda);
    }
}

impl<T: Real> Question<T> for G1<'_, '_, T> {
    fn ask<N: SampleNdf<Scalar = T> + Copy>(&mut self, id: (&str, &str), materials: &[N]) {
        let pairs: Vec<_> = self.1.iter().copied().zip(normals(materials)).collect();
        calls(self.0, id, materials, &pairs, |surface, (w, wm)| surface.g1(w, wm));
    }
}

/// The masks of GTR beside those that every map is asked about, isotropic.
fn each_gtr<T: Real>(question: &mut impl Question<T>) {
    for (gamma, [four, twelve]) in [
        (1.5, ["gtr-4-nodes-1.5", "gtr-12-nodes-1.5"]),
        (2.5, ["gtr-4-nodes-2.5", "gtr-12-nodes-2.5"]),
        (3.5, ["gtr-4-nodes-3.5", "gtr-12-nodes-3.5"]),
    ] {
        let gamma = T::lit(gamma);
        question.ask((four, "isotropic"), &materials(|alpha| Gtr::with_nodes::<4>(alpha, gamma).ok()));
        question.ask((twelve, "isotropic"), &materials(|alpha| Gtr::with_nodes::<12>(alpha, gamma).ok()));
    }
    for (gamma, eight) in [(2.5, "gtr-8-nodes-2.5"), (3.5, "gtr-8-nodes-3.5")] {
        let materials = materials(|alpha| Gtr::isotropic(alpha, T::lit(gamma)).ok());
        question.ask((eight, "isotropic"), &materials);
    }
    question.ask(("gtr-closed-6", "isotropic"), &materials(|alpha| Gtr::closed::<6>(alpha).ok()));
}

pub(crate) fn bench(criterion: &mut Criterion) {
    scalar::<f32>(criterion);
    scalar::<f64>(criterion);
}

fn scalar<T: Elementary>(criterion: &mut Criterion) {
    let w = directions::<T>(CALLS, &mut generator());
    let arrays: Vec<[T; 3]> = w.iter().map(|&w| w.into()).collect();
    let widths: Vec<_> = alphas::<T>().into_iter().map(Width::new).collect();
    let pairs: Vec<_> = alphas::<T>().into_iter().map(Anisotropic::new).collect();

    let mut sigma = group::<T>(criterion, "sigma");
    each_surface(&mut Sigma::<T>(&mut sigma, &w));
    each_gtr(&mut Sigma::<T>(&mut sigma, &w));
    sigma.finish();

    let mut lambda = group::<T>(criterion, "lambda");
    each_surface(&mut Lambda::<T>(&mut lambda, &w));
    let surfaces = materials(|alpha: T| Beckmann::isotropic(alpha).ok());
    calls(&mut lambda, ("beckmann-walter2007", "isotropic"), &surfaces, &w, Microsurface::lambda_walter2007);
    calls(&mut lambda, ("textbook-ggx", "isotropic"), &widths, &arrays, |&a, w| ggx::lambda(a, w));
    calls(&mut lambda, ("textbook-ggx", "axis-aligned"), &pairs, &arrays, |&a, w| {
        ggx::lambda_anisotropic(a, w)
    });
    calls(&mut lambda, ("textbook-beckmann-walter2007", "isotropic"), &widths, &arrays, |&a, w| {
        beckmann::lambda_walter2007(a, w)
    });
    lambda.finish();

    let mut g1 = group::<T>(criterion, "g1");
    each_surface(&mut G1::<T>(&mut g1, &w));
    calls(&mut g1, ("beckmann-walter2007", "isotropic"), &surfaces, &w, Microsurface::g1_walter2007);
    g1.finish();
}
