//! What does a density D cost, under which map, and beside the textbook's form?

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};
use microsurface::SampleNdf;

use crate::input::{Question, alphas, calls, each_surface, group, materials, normals};
use crate::textbook::{Anisotropic, Elementary, Width, beckmann, ggx};

struct Density<'a, 'b>(&'a mut BenchmarkGroup<'b, WallTime>);

impl<T: Elementary> Question<T> for Density<'_, '_> {
    fn ask<N: SampleNdf<Scalar = T> + Copy>(&mut self, id: (&str, &str), materials: &[N]) {
        calls(self.0, id, materials, &normals(materials), N::d);
    }
}

pub(crate) fn bench(criterion: &mut Criterion) {
    scalar::<f32>(criterion);
    scalar::<f64>(criterion);
}

fn scalar<T: Elementary>(criterion: &mut Criterion) {
    let mut group = group::<T>(criterion, "distribution");
    each_surface::<T>(&mut Density(&mut group));

    let narrow = materials(|alpha: T| microsurface::Ggx::isotropic(alpha).ok());
    let wm: Vec<[T; 3]> = normals(&narrow).into_iter().map(Into::into).collect();
    let widths: Vec<_> = alphas().into_iter().map(Width::new).collect();
    let pairs: Vec<_> = alphas().into_iter().map(Anisotropic::new).collect();
    calls(&mut group, ("textbook-ggx", "isotropic"), &widths, &wm, |&a, m| ggx::d(a, m));
    calls(&mut group, ("textbook-ggx", "axis-aligned"), &pairs, &wm, |&a, m| ggx::d_anisotropic(a, m));
    calls(&mut group, ("textbook-beckmann", "isotropic"), &widths, &wm, |&a, m| beckmann::d(a, m));
    group.finish();
}
