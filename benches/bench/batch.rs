//! Does a plain loop over slices become vector code?
//!
//! Each `slices` function below is what a user would write who keeps directions as structure of
//! arrays: nothing of the crate but the scalar call, in a loop. Beside it stands `scalar`, the same
//! call with every result opaque, so that it stays scalar, and the textbook's form in the same
//! loop. What the compiler makes of them depends on the target: compare with `RUSTFLAGS="-C
//! target-cpu=native"`.

mod entry;
mod varied;

use core::cell::RefCell;
use core::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput};
use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::{Schlick, Spectrum};
use microsurface::{Beckmann, Ggx, Gtr, Ndf, Real, SampleVndf};

use crate::input::{direction, generator, name, uniform};
use crate::textbook::{Anisotropic, Elementary, Width, ggx};

/// Elements: within the second-level cache, and beyond it.
const SIZES: [usize; 2] = [4096, 65536];

const ALPHA: f64 = 0.3;
const F0: f64 = 0.9;

/// Directions as structure of arrays.
struct Directions<T> {
    x: Vec<T>,
    y: Vec<T>,
    z: Vec<T>,
}

impl<T: Real> Directions<T> {
    fn random(n: usize, rng: &mut impl rand::Rng) -> Self {
        let mut directions = Self { x: Vec::new(), y: Vec::new(), z: Vec::new() };
        for [x, y, z] in (0..n).map(|_| direction::<T>(rng)) {
            directions.x.push(x);
            directions.y.push(y);
            directions.z.push(z);
        }
        directions
    }
    fn slices(&self) -> [&[T]; 3] {
        [&self.x, &self.y, &self.z]
    }
}

/// `call` of every direction, as a user would write it.
#[inline(always)]
fn slices<T: Real>([x, y, z]: [&[T]; 3], out: &mut [T], call: impl Fn(T::Vec3) -> T) {
    for (((out, &x), &y), &z) in out.iter_mut().zip(x).zip(y).zip(z) {
        *out = call([x, y, z].into());
    }
}

/// `call` of every pair of directions.
#[inline(always)]
fn pair_slices<T: Real>(
    [ix, iy, iz]: [&[T]; 3],
    [ox, oy, oz]: [&[T]; 3],
    out: &mut [T],
    call: impl Fn(T::Vec3, T::Vec3) -> T,
) {
    let incident = ix.iter().zip(iy).zip(iz);
    let outgoing = ox.iter().zip(oy).zip(oz);
    for ((out, ((&ix, &iy), &iz)), ((&ox, &oy), &oz)) in out.iter_mut().zip(incident).zip(outgoing) {
        *out = call([ix, iy, iz].into(), [ox, oy, oz].into());
    }
}

#[inline(never)]
fn d<N: Ndf>(surface: &N, wm: [&[N::Scalar]; 3], out: &mut [N::Scalar]) {
    slices(wm, out, |wm| surface.d(wm));
}

#[inline(never)]
fn sigma<N: Ndf>(surface: &N, w: [&[N::Scalar]; 3], out: &mut [N::Scalar]) {
    slices(w, out, |w| surface.sigma_above(w));
}

/// G1 towards the facets that face w, so that one direction is enough.
#[inline(never)]
fn g1<N: Ndf>(surface: &N, w: [&[N::Scalar]; 3], out: &mut [N::Scalar]) {
    slices(w, out, |w| surface.g1(w, w));
}

#[inline(never)]
fn eval<N: Ndf<Scalar = T>, T: Real + Spectrum<Scalar = T>>(
    brdf: &RoughConductor<N, Schlick<T>>,
    wi: [&[T]; 3],
    wo: [&[T]; 3],
    out: &mut [T],
) {
    pair_slices(wi, wo, out, |wi, wo| brdf.eval(wi, wo));
}

#[inline(never)]
fn textbook_d<T: Elementary>(width: Width<T>, wm: [&[T]; 3], out: &mut [T]) {
    slices(wm, out, |wm| ggx::d(width, wm.into()));
}

#[inline(never)]
fn textbook_eval<T: Elementary>(width: Width<T>, wi: [&[T]; 3], wo: [&[T]; 3], out: &mut [T]) {
    pair_slices(wi, wo, out, |wi, wo| ggx::reflection(width, T::lit(F0), wi.into(), wo.into()));
}

/// `sample` of every direction and two random numbers: a normal each, as structure of arrays again.
#[inline(always)]
fn normal_slices<T: Real>(
    [x, y, z]: [&[T]; 3],
    [u1, u2]: [&[T]; 2],
    [mx, my, mz]: &mut [Vec<T>; 3],
    sample: impl Fn(T::Vec3, T::Vec2) -> T::Vec3,
) {
    let arguments = x.iter().zip(y).zip(z).zip(u1.iter().zip(u2));
    let normals = mx.iter_mut().zip(my).zip(mz);
    for (((&x, &y), &z), (&u1, &u2), ((mx, my), mz)) in arguments.zip(normals).map(|((w, u), m)| (w, u, m)) {
        [*mx, *my, *mz] = sample([x, y, z].into(), [u1, u2].into()).into();
    }
}

#[inline(never)]
fn visible_normal<N: SampleVndf>(
    surface: &N,
    w: [&[N::Scalar]; 3],
    u: [&[N::Scalar]; 2],
    m: &mut [Vec<N::Scalar>; 3],
) {
    normal_slices(w, u, m, |w, u| surface.sample_vndf(w, u));
}

#[inline(never)]
fn heitz2018<T: Elementary>(widths: Anisotropic<T>, w: [&[T]; 3], u: [&[T]; 2], m: &mut [Vec<T>; 3]) {
    normal_slices(w, u, m, |w, u| ggx::visible_normal_heitz2018(widths, w.into(), u.into()).into());
}

/// What is timed: a name, and a loop over all elements.
type Alternative<'a, T> = (&'a str, &'a mut dyn FnMut(&mut [T]));

fn compare<T: Real>(
    criterion: &mut Criterion,
    question: &str,
    n: usize,
    alternatives: &mut [Alternative<'_, T>],
) {
    let mut group = criterion.benchmark_group(format!("batch_{question}/{}", name::<T>()));
    group.throughput(Throughput::Elements(n as u64));
    let mut out = vec![T::ZERO; n];
    for (alternative, run) in alternatives {
        group.bench_function(BenchmarkId::new(*alternative, n), |bencher| {
            bencher.iter(|| {
                run(black_box(&mut out));
                black_box(&mut out);
            });
        });
    }
    group.finish();
}

/// The same call with every result opaque.
#[inline(always)]
fn opaque<T: Real>(w: [&[T]; 3], call: impl Fn(T::Vec3) -> T) -> impl FnMut(&mut [T]) {
    move |out| slices(w, out, |w| black_box(call(w)))
}

pub(crate) fn bench(criterion: &mut Criterion) {
    for n in SIZES {
        scalar::<f32>(criterion, n);
        scalar::<f64>(criterion, n);
        gtr::<f32>(criterion, n);
        gtr::<f64>(criterion, n);
        entry::bench::<f32>(criterion, n);
        entry::bench::<f64>(criterion, n);
        varied::bench::<f32>(criterion, n);
        varied::bench::<f64>(criterion, n);
    }
}

fn scalar<T: Elementary>(criterion: &mut Criterion, n: usize) {
    let mut rng = generator();
    let (wi, wo) = (Directions::<T>::random(n, &mut rng), Directions::<T>::random(n, &mut rng));
    let (wi, wo) = (wi.slices(), wo.slices());
    let alpha = black_box(T::lit(ALPHA));
    let ggx = Ggx::isotropic(alpha).expect("a width");
    let beckmann = Beckmann::isotropic(alpha).expect("a width");
    let closed = Gtr::closed::<3>(alpha).expect("a width");
    let spline = Gtr::spline(alpha, T::lit(1.5)).expect("a width");
    let heavy = Gtr::heavy_tailed::<8>(alpha, T::lit(1.5)).expect("a width");
    let any = Gtr::isotropic(alpha, T::lit(1.5)).expect("a width");
    let textbook = Width::new(alpha);

    compare(
        criterion,
        "d",
        n,
        &mut [
            ("ggx-scalar", &mut opaque(wo, |w| ggx.d(w))),
            ("ggx", &mut |out| d(&ggx, wo, out)),
            ("textbook-ggx", &mut |out| textbook_d(textbook, wo, out)),
            ("beckmann-scalar", &mut opaque(wo, |w| beckmann.d(w))),
            ("beckmann", &mut |out| d(&beckmann, wo, out)),
            ("gtr-closed-3", &mut |out| d(&closed, wo, out)),
            ("gtr-spline-1.5", &mut |out| d(&spline, wo, out)),
        ],
    );
    compare(
        criterion,
        "sigma",
        n,
        &mut [
            ("ggx-scalar", &mut opaque(wo, |w| ggx.sigma_above(w))),
            ("ggx", &mut |out| sigma(&ggx, wo, out)),
            ("beckmann", &mut |out| sigma(&beckmann, wo, out)),
            ("gtr-closed-3", &mut |out| sigma(&closed, wo, out)),
            ("gtr-spline-1.5", &mut |out| sigma(&spline, wo, out)),
        ],
    );
    compare(
        criterion,
        "g1",
        n,
        &mut [
            ("ggx-scalar", &mut opaque(wo, |w| ggx.g1(w, w))),
            ("ggx", &mut |out| g1(&ggx, wo, out)),
            ("beckmann", &mut |out| g1(&beckmann, wo, out)),
        ],
    );

    let (u1, u2) = (uniform::<T>(n, &mut rng), uniform::<T>(n, &mut rng));
    let u: [&[T]; 2] = [&u1, &u2];
    let mut m = [0, 1, 2].map(|_| vec![T::ZERO; n]);
    let m = RefCell::new(&mut m);
    compare::<T>(
        criterion,
        "visible_normal",
        n,
        &mut [
            ("ggx", &mut |_| visible_normal(&ggx, wo, u, black_box(&mut m.borrow_mut()))),
            ("heitz2018-ggx", &mut |_| {
                heitz2018(Anisotropic::new(alpha), wo, u, black_box(&mut m.borrow_mut()));
            }),
            ("beckmann", &mut |_| visible_normal(&beckmann, wo, u, black_box(&mut m.borrow_mut()))),
        ],
    );

    let fresnel = Schlick::new(black_box(T::lit(F0))).expect("a share");
    let ggx = RoughConductor::new(ggx, fresnel);
    let beckmann = RoughConductor::new(beckmann, fresnel);
    let heavy = RoughConductor::new(heavy, fresnel);
    let any = RoughConductor::new(any, fresnel);
    compare(
        criterion,
        "eval",
        n,
        &mut [
            ("ggx-scalar", &mut |out| pair_slices(wi, wo, out, |wi, wo| black_box(ggx.eval(wi, wo)))),
            ("ggx", &mut |out| eval(&ggx, wi, wo, out)),
            ("textbook-ggx-scalar", &mut |out| {
                pair_slices(wi, wo, out, |wi: T::Vec3, wo: T::Vec3| {
                    black_box(ggx::reflection(textbook, T::lit(F0), wi.into(), wo.into()))
                });
            }),
            ("textbook-ggx", &mut |out| textbook_eval(textbook, wi, wo, out)),
            ("beckmann", &mut |out| eval(&beckmann, wi, wo, out)),
            ("gtr-heavy-8-nodes-1.5", &mut |out| eval(&heavy, wi, wo, out)),
            ("gtr-8-nodes-1.5", &mut |out| eval(&any, wi, wo, out)),
        ],
    );
}

/// GTR's masks by nodes, beside the spline and closed forms.
fn gtr<T: Real>(criterion: &mut Criterion, n: usize) {
    let directions = Directions::<T>::random(n, &mut generator());
    let w = directions.slices();
    let alpha = black_box(T::lit(ALPHA));
    let spline = Gtr::spline(alpha, T::lit(1.5)).expect("a width");
    let closed_3 = Gtr::closed::<3>(alpha).expect("a width");
    let closed_6 = Gtr::closed::<6>(alpha).expect("a width");
    let heavy = Gtr::heavy_tailed::<8>(alpha, T::lit(1.5)).expect("a width");
    let gammas = [1.5, 2.5, 3.5].map(T::lit);
    let four = gammas.map(|gamma| Gtr::with_nodes::<4>(alpha, gamma).expect("a width"));
    let eight = gammas.map(|gamma| Gtr::isotropic(alpha, gamma).expect("a width"));
    let twelve = gammas.map(|gamma| Gtr::with_nodes::<12>(alpha, gamma).expect("a width"));
    compare(
        criterion,
        "sigma_gtr",
        n,
        &mut [
            ("spline-1.5", &mut |out| sigma(&spline, w, out)),
            ("closed-3", &mut |out| sigma(&closed_3, w, out)),
            ("closed-6", &mut |out| sigma(&closed_6, w, out)),
            ("heavy-8-nodes-1.5", &mut |out| sigma(&heavy, w, out)),
            ("4-nodes-1.5", &mut |out| sigma(&four[0], w, out)),
            ("4-nodes-2.5", &mut |out| sigma(&four[1], w, out)),
            ("4-nodes-3.5", &mut |out| sigma(&four[2], w, out)),
            ("8-nodes-1.5", &mut |out| sigma(&eight[0], w, out)),
            ("8-nodes-2.5", &mut |out| sigma(&eight[1], w, out)),
            ("8-nodes-3.5", &mut |out| sigma(&eight[2], w, out)),
            ("12-nodes-1.5", &mut |out| sigma(&twelve[0], w, out)),
            ("12-nodes-2.5", &mut |out| sigma(&twelve[1], w, out)),
            ("12-nodes-3.5", &mut |out| sigma(&twelve[2], w, out)),
        ],
    );
}
