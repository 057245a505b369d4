//! What does a visible normal cost, and beside the samplers of the papers before?

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};
use microsurface::elementary::{erf, erf_inv};
use microsurface::{Gtr, Real, SampleNdf, SampleVndf};

use crate::input::{
    CALLS, Question, alphas, calls, directions, each_surface, generator, group, materials, uniform,
};
use crate::textbook::{Anisotropic, Elementary, Width, beckmann, ggx};

pub(crate) fn bench(criterion: &mut Criterion) {
    scalar::<f32>(criterion);
    scalar::<f64>(criterion);
}

fn scalar<T: Elementary>(criterion: &mut Criterion) {
    let mut rng = generator();
    let w = directions::<T>(CALLS, &mut rng);
    let (u1, u2) = (uniform::<T>(CALLS, &mut rng), uniform::<T>(CALLS, &mut rng));
    let arrays: Vec<([T; 3], [T; 2])> =
        w.iter().zip(u1.iter().zip(&u2)).map(|(&w, (&u1, &u2))| (w.into(), [u1, u2])).collect();
    let vectors: Vec<(T::Vec3, T::Vec2)> = arrays.iter().map(|&(w, u)| (w.into(), u.into())).collect();
    let mut group = group::<T>(criterion, "visible_normals");

    each_surface(&mut Visible::<T>(&mut group, &vectors));
    for (gamma, name) in [(0.7, "gtr-8-nodes-0.7"), (2.5, "gtr-8-nodes-2.5"), (3.4, "gtr-8-nodes-3.4")] {
        let surfaces = materials(|alpha| Gtr::isotropic(alpha, T::lit(gamma)).ok());
        calls(&mut group, (name, "isotropic"), &surfaces, &vectors, |s, (w, u)| s.sample_vndf(w, u));
    }

    let widths: Vec<_> = alphas::<T>().into_iter().map(Width::new).collect();
    let pairs: Vec<_> = alphas::<T>().into_iter().map(Anisotropic::new).collect();
    calls(&mut group, ("heitz2018-ggx", "axis-aligned"), &pairs, &arrays, |&a, (w, u)| {
        ggx::visible_normal_heitz2018(a, w, u)
    });
    calls(&mut group, ("dupuy2023-ggx", "axis-aligned"), &pairs, &arrays, |&a, (w, u)| {
        ggx::visible_normal_dupuy2023(a, w, u)
    });
    calls(&mut group, ("jakob2014-beckmann", "isotropic"), &widths, &arrays, |&a, (w, u)| {
        beckmann::visible_normal_jakob2014(a, w, u, erf, erf_inv)
    });
    calls(&mut group, ("mitsuba-beckmann", "isotropic"), &widths, &arrays, |&a, (w, u)| {
        beckmann::visible_normal_mitsuba(a, w, u)
    });
    group.finish();
}

struct Visible<'a, 'b, T: Real>(&'a mut BenchmarkGroup<'b, WallTime>, &'a [(T::Vec3, T::Vec2)]);

impl<T: Real> Question<T> for Visible<'_, '_, T> {
    fn ask<N: SampleNdf<Scalar = T> + Copy>(&mut self, _: (&str, &str), _: &[N]) {}

    fn ask_visible<N: SampleNdf<Scalar = T> + SampleVndf + Copy>(
        &mut self,
        id: (&str, &str),
        materials: &[N],
    ) {
        calls(self.0, id, materials, self.1, |surface, (w, u)| surface.sample_vndf(w, u));
    }
}
