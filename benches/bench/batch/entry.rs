//! The entry points of [`microsurface::batch`] at each level of the instruction set that this
//! processor has, beside the loop a user would write and the scalar call with every result opaque,
//! of the crate and of the textbook.

use core::cell::RefCell;
use core::hint::black_box;

use criterion::Criterion;
use microsurface::batch::simd::{Level, highest, limit_to};
use microsurface::batch::{
    self, DirectionsMut, Material, NdfBatch, Numbers, ReflectionBatch, Samples, StagedVndf,
};
use microsurface::beckmann::BeckmannTo1e6;
use microsurface::bsdf::RoughConductor;
use microsurface::elementary::{erf, erf_inv};
use microsurface::fresnel::{Schlick, Spectrum};
use microsurface::{Beckmann, Ggx, Gtr, Real};

use super::{
    ALPHA, Alternative, Directions, F0, compare, d, eval, normal_slices, opaque, pair_slices, slices,
    visible_normal,
};
use crate::input::{generator, uniform};
use crate::textbook::{Anisotropic, Elementary, Width, beckmann, ggx};

impl<T> Directions<T> {
    pub(super) fn borrowed(&self) -> batch::Directions<'_, T> {
        batch::Directions { x: &self.x, y: &self.y, z: &self.z }
    }
}

/// `run` as one more alternative for each level, the build's own target first.
pub(super) fn compare_levels<T: Real>(
    criterion: &mut Criterion,
    question: &str,
    n: usize,
    others: &mut [Alternative<'_, T>],
    run: &mut dyn FnMut(&mut [T]),
) {
    compare(criterion, question, n, others);
    for (name, level) in [("target", Level::Target), ("avx2", Level::Avx2), ("avx512", Level::Avx512)] {
        if limit_to(level) == level {
            compare(criterion, question, n, &mut [(&format!("batch-{name}"), run)]);
        }
    }
    limit_to(highest());
}

pub(super) fn bench<T: Elementary + Spectrum<Scalar = T>>(criterion: &mut Criterion, n: usize) {
    let alpha = black_box(T::lit(ALPHA));
    let gamma = T::lit(1.5);
    let mut rng = generator();
    let arguments = Arguments {
        wi: Directions::random(n, &mut rng),
        wo: Directions::random(n, &mut rng),
        u: [uniform(n, &mut rng), uniform(n, &mut rng)],
    };
    arguments.textbook(criterion, alpha);
    arguments.limits(criterion);
    arguments.ask(criterion, "ggx", Ggx::isotropic(alpha).expect("a width"));
    arguments.ask(criterion, "beckmann", Beckmann::isotropic(alpha).expect("a width"));
    let quick = BeckmannTo1e6::isotropic(alpha).expect("a width");
    arguments.visible_normals(criterion, "beckmann-to-1e-6", quick);
    arguments.samples(
        criterion,
        "beckmann-to-1e-6",
        RoughConductor::new(quick, Schlick::new(black_box(T::lit(F0))).expect("a share")),
    );
    arguments.ask(criterion, "gtr-8-nodes-1.5", Gtr::isotropic(alpha, gamma).expect("a width"));
}

/// `sample` of every direction and two random numbers: a weight each.
#[inline(always)]
fn sample_slices<T: Real>(
    [x, y, z]: [&[T]; 3],
    [u1, u2]: [&[T]; 2],
    out: &mut [T],
    sample: impl Fn(T::Vec3, T::Vec2) -> T,
) {
    let arguments = x.iter().zip(y).zip(z).zip(u1.iter().zip(u2));
    for (out, (((&x, &y), &z), (&u1, &u2))) in out.iter_mut().zip(arguments) {
        *out = sample([x, y, z].into(), [u1, u2].into());
    }
}

struct Arguments<T> {
    wi: Directions<T>,
    wo: Directions<T>,
    u: [Vec<T>; 2],
}

impl<T: Elementary + Spectrum<Scalar = T>> Arguments<T> {
    /// The forms of the textbook, in the groups that [`ask`](Self::ask) goes on with. That of GGX
    /// is the measure of all.
    fn textbook(&self, criterion: &mut Criterion, alpha: T) {
        let n = self.wo.x.len();
        let (wi, wo) = (self.wi.slices(), self.wo.slices());
        let u: [&[T]; 2] = [&self.u[0], &self.u[1]];
        let (width, widths) = (Width::new(alpha), Anisotropic::new(alpha));
        let f0 = black_box(T::lit(F0));
        let scalar = "textbook-scalar";
        let d = &mut opaque(wo, |w| ggx::d(width, w.into()));
        compare(criterion, "entry_d_ggx", n, &mut [(scalar, d)]);
        let d = &mut opaque(wo, |w| beckmann::d(width, w.into()));
        compare(criterion, "entry_d_beckmann", n, &mut [(scalar, d)]);
        let eval = |wi: T::Vec3, wo: T::Vec3| black_box(ggx::reflection(width, f0, wi.into(), wo.into()));
        let eval = &mut |out: &mut [T]| pair_slices(wi, wo, out, eval);
        for question in ["entry_eval_ggx", "entry_eval_gtr-8-nodes-1.5"] {
            compare(criterion, question, n, &mut [("textbook-ggx-scalar", eval)]);
        }
        let exact =
            |wi: T::Vec3, wo: T::Vec3| black_box(beckmann::reflection(width, f0, wi.into(), wo.into()));
        let exact = &mut |out: &mut [T]| pair_slices(wi, wo, out, exact);
        compare(criterion, "entry_eval_beckmann", n, &mut [("textbook-ggx-scalar", eval), (scalar, exact)]);

        let mut normals = [0, 1, 2].map(|_| vec![T::ZERO; n]);
        let normal = |w: T::Vec3, u: T::Vec2| {
            black_box(ggx::visible_normal_heitz2018(widths, w.into(), u.into()).into())
        };
        let normal = &mut |_: &mut [T]| normal_slices(wo, u, &mut normals, normal);
        compare(criterion, "entry_visible_normal_ggx", n, &mut [(scalar, normal)]);
        let mut normals = [0, 1, 2].map(|_| vec![T::ZERO; n]);
        let normal = |w: T::Vec3, u: T::Vec2| {
            black_box(beckmann::visible_normal_jakob2014(width, w.into(), u.into(), erf, erf_inv).into())
        };
        let normal = &mut |_: &mut [T]| normal_slices(wo, u, &mut normals, normal);
        compare(criterion, "entry_visible_normal_beckmann", n, &mut [(scalar, normal)]);

        let sample = |w: T::Vec3, u: T::Vec2| {
            black_box(ggx::sampled_reflection_heitz2018(widths, f0, w.into(), u.into()))
                .map_or(T::ZERO, |(_, weight, _)| weight)
        };
        let sample = &mut |out: &mut [T]| sample_slices(wo, u, out, sample);
        compare(criterion, "entry_sample_ggx", n, &mut [(scalar, sample)]);
    }

    /// The least that every form of GGX's reflection needs: its loads and its store, three roots,
    /// one quotient.
    fn limits(&self, criterion: &mut Criterion) {
        let n = self.wo.x.len();
        let input = (self.wi.borrowed(), self.wo.borrowed());
        let sums = |(i, o): ([T; 3], [T; 3])| [i[0] + o[0], i[1] + o[1], i[2] + o[2]];
        let loads = &mut |out: &mut [T]| {
            batch::map(input, out, |pair| {
                let [a, b, c] = sums(pair);
                a + b + c
            });
        };
        compare_levels(criterion, "entry_limit_loads", n, &mut [], loads);
        let roots = &mut |out: &mut [T]| {
            batch::map(input, out, |pair| {
                let [a, b, c] = sums(pair).map(Real::sqrt);
                a + b + c
            });
        };
        compare_levels(criterion, "entry_limit_roots", n, &mut [], roots);
        let quotient = &mut |out: &mut [T]| {
            batch::map(input, out, |pair| {
                let [a, b, c] = sums(pair);
                (a + b) / c
            });
        };
        compare_levels(criterion, "entry_limit_quotient", n, &mut [], quotient);
        let all = &mut |out: &mut [T]| {
            batch::map(input, out, |pair| {
                let h = sums(pair);
                let [a, b, c] = h.map(Real::sqrt);
                (a + b + c) / h[0]
            });
        };
        compare_levels(criterion, "entry_limit_ggx_eval", n, &mut [], all);
    }

    fn ask<N>(&self, criterion: &mut Criterion, name: &str, surface: N)
    where
        N: StagedVndf<Scalar = T> + Material<Local = N>,
    {
        let n = self.wo.x.len();
        let (wi, wo) = (self.wi.slices(), self.wo.slices());
        let (wi_batch, wo_batch) = (self.wi.borrowed(), self.wo.borrowed());

        compare_levels::<T>(
            criterion,
            &format!("entry_d_{name}"),
            n,
            &mut [("scalar", &mut opaque(wo, |w| surface.d(w))), ("loop", &mut |out| d(&surface, wo, out))],
            &mut |out| surface.d_batch(wo_batch, out),
        );
        compare_levels::<T>(
            criterion,
            &format!("entry_sigma_{name}"),
            n,
            &mut [
                ("scalar", &mut opaque(wo, |w| surface.sigma(w))),
                ("loop", &mut |out| slices(wo, out, |w| surface.sigma(w))),
            ],
            &mut |out| surface.sigma_batch(wo_batch, out),
        );

        let brdf = RoughConductor::new(surface, Schlick::new(black_box(T::lit(F0))).expect("a share"));
        compare_levels::<T>(
            criterion,
            &format!("entry_eval_{name}"),
            n,
            &mut [
                ("scalar", &mut |out| pair_slices(wi, wo, out, |wi, wo| black_box(brdf.eval(wi, wo)))),
                ("loop", &mut |out| eval(&brdf, wi, wo, out)),
            ],
            &mut |out| brdf.eval_batch(wi_batch, wo_batch, out),
        );

        self.visible_normals(criterion, name, surface);
        self.samples(criterion, name, brdf);
    }

    fn visible_normals<N>(&self, criterion: &mut Criterion, name: &str, surface: N)
    where
        N: StagedVndf<Scalar = T> + Material<Local = N>,
    {
        let (n, wo, wo_batch) = (self.wo.x.len(), self.wo.slices(), self.wo.borrowed());
        let u: [&[T]; 2] = [&self.u[0], &self.u[1]];
        let u_batch = Numbers { x: u[0], y: u[1] };
        let normals = RefCell::new([0, 1, 2].map(|_| vec![T::ZERO; n]));
        compare_levels::<T>(
            criterion,
            &format!("entry_visible_normal_{name}"),
            n,
            &mut [
                ("scalar", &mut |_| {
                    normal_slices(wo, u, &mut normals.borrow_mut(), |w, u| {
                        black_box(surface.sample_vndf(w, u))
                    });
                }),
                ("loop", &mut |_| visible_normal(&surface, wo, u, black_box(&mut normals.borrow_mut()))),
            ],
            &mut |_| {
                let [x, y, z] = &mut *normals.borrow_mut();
                surface.sample_vndf_batch(wo_batch, u_batch, DirectionsMut { x, y, z });
            },
        );
    }

    fn samples<N>(&self, criterion: &mut Criterion, name: &str, brdf: RoughConductor<N, Schlick<T>>)
    where
        N: StagedVndf<Scalar = T> + Material<Local = N>,
    {
        let (n, wo, wo_batch) = (self.wo.x.len(), self.wo.slices(), self.wo.borrowed());
        let u: [&[T]; 2] = [&self.u[0], &self.u[1]];
        let u_batch = Numbers { x: u[0], y: u[1] };
        let mut wi = [0, 1, 2].map(|_| vec![T::ZERO; n]);
        let mut pdf = vec![T::ZERO; n];
        compare_levels::<T>(
            criterion,
            &format!("entry_sample_{name}"),
            n,
            &mut [("scalar", &mut |out| {
                sample_slices(wo, u, out, |w, u| {
                    black_box(brdf.sample(w, u)).map_or(T::ZERO, |sample| sample.weight)
                });
            })],
            &mut |weight| {
                let [x, y, z] = &mut wi;
                let wi = DirectionsMut { x, y, z };
                brdf.sample_batch(wo_batch, u_batch, Samples { wi, weight, pdf: &mut pdf });
            },
        );
    }
}
