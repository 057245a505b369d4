//! GGX's reflection where every element has a surface of its own: as a slice of materials,
//! textured, and filtered over its footprint, beside the scalar calls that do the same.

use core::hint::black_box;

use criterion::Criterion;
use microsurface::batch::{
    AlphaPairs, Alphas, Filtered, FilteredProjected, Footprints, ReflectionBatch, Varied, map,
};
use microsurface::bsdf::RoughConductor;
use microsurface::filter::{Footprint, projected};
use microsurface::fresnel::{Schlick, Spectrum};
use microsurface::{Ggx, Isotropic, Microsurface, Ndf, Real};

use super::entry::compare_levels;
use super::{ALPHA, Directions, F0, compare};
use crate::input::{generator, uniform};

/// σ² of the kernels.
const VARIANCE: f64 = 1.0 / 12.0;

pub(super) fn bench<T: Real + Spectrum<Scalar = T>>(criterion: &mut Criterion, n: usize) {
    let mut rng = generator();
    let (wi, wo) = (Directions::<T>::random(n, &mut rng), Directions::<T>::random(n, &mut rng));
    let (alpha_x, alpha_y) = (alphas::<T>(n, &mut rng), alphas(n, &mut rng));
    let steps = [0, 1, 2, 3].map(|_| {
        let unit: Vec<T> = uniform(n, &mut rng);
        unit.into_iter().map(|u| T::lit(0.2) * (u - T::HALF)).collect::<Vec<T>>()
    });
    let fresnel = Schlick::new(black_box(T::lit(F0))).expect("a share");
    let metal = |surface| RoughConductor::new(surface, fresnel);
    let one = metal(Ggx::isotropic(black_box(T::lit(ALPHA))).expect("a width"));
    let each: Vec<_> = alpha_x.iter().map(|&a| metal(Ggx::isotropic(a).expect("a width"))).collect();

    let [du_x, du_y, dv_x, dv_y] = &steps;
    let footprints = Footprints { du_x, du_y, dv_x, dv_y };
    let variance = T::lit(VARIANCE);
    let footprint = |[ux, uy, vx, vy]: [T; 4]| Footprint::new([ux, uy], [vx, vy]);
    let direction = |w: &Directions<T>, i: usize| -> T::Vec3 { [w.x[i], w.y[i], w.z[i]].into() };
    let scalar = |out: &mut [T], surface: &dyn Fn(usize, T::Vec3, T::Vec3) -> T| {
        for (i, out) in out.iter_mut().enumerate() {
            *out = black_box(surface(i, direction(&wi, i), direction(&wo, i)));
        }
    };
    let at = |i: usize| footprint([du_x[i], du_y[i], dv_x[i], dv_y[i]]);
    let surface: &Microsurface<Ggx, Isotropic<T>> = one.surface();
    compare(
        criterion,
        "varied_scalar",
        n,
        &mut [
            ("alphas", &mut |out| {
                scalar(out, &|i, wi, wo| metal(Ggx::isotropic(alpha_x[i]).expect("a width")).eval(wi, wo));
            }),
            ("filtered", &mut |out| {
                scalar(out, &|i, wi, wo| eval(surface.filtered(at(i).covariance(variance)), fresnel, wi, wo));
            }),
            ("projected", &mut |out| {
                scalar(out, &|i, wi, wo| {
                    eval(projected::filtered(surface, at(i), variance), fresnel, wi, wo)
                });
            }),
            ("mean", &mut |out| scalar(out, &|i, wi, wo| one.eval_over(wi, wo, at(i)))),
        ],
    );

    let (wi, wo) = (wi.borrowed(), wo.borrowed());
    let mut ask = |name: &str, run: &mut dyn FnMut(&mut [T])| {
        compare_levels(criterion, &format!("varied_{name}"), n, &mut [], run);
    };
    ask("one", &mut |out| one.eval_batch(wi, wo, out));
    ask("slice", &mut |out| each.eval_batch(wi, wo, out));
    let textured = Varied::new(&one, Alphas::new(&alpha_x).expect("widths"));
    ask("alphas", &mut |out| textured.eval_batch(wi, wo, out));
    let textured = Varied::new(&one, AlphaPairs::new(&alpha_x, &alpha_y).expect("widths"));
    ask("alpha-pairs", &mut |out| textured.eval_batch(wi, wo, out));
    let filtered = Varied::new(&one, Filtered::new(footprints, variance).expect("footprints"));
    ask("filtered", &mut |out| filtered.eval_batch(wi, wo, out));
    let filtered = Varied::new(&one, FilteredProjected::new(footprints, variance).expect("footprints"));
    ask("projected", &mut |out| filtered.eval_batch(wi, wo, out));
    ask("mean", &mut |out| {
        map((wi, wo, footprints), out, |(wi, wo, steps)| {
            one.eval_over(wi.into(), wo.into(), footprint(steps))
        });
    });
}

/// Widths from 1e-3 to 1.
fn alphas<T: Real>(n: usize, rng: &mut impl rand::Rng) -> Vec<T> {
    let unit: Vec<T> = uniform(n, rng);
    unit.into_iter().map(|u| T::lit(10_f64.powf(-3.0 * u.to_f64()))).collect()
}

fn eval<N: Ndf<Scalar = T>, T: Real + Spectrum<Scalar = T>>(
    surface: Result<N, microsurface::Error>,
    fresnel: Schlick<T>,
    wi: T::Vec3,
    wo: T::Vec3,
) -> T {
    RoughConductor::new(surface.expect("in range"), fresnel).eval(wi, wo)
}
