//! Batches against the scalar calls, bit by bit, at every level of the instruction set that this
//! machine has.
//!
//! A test binary of its own: every entry point is compiled for every level.
#![expect(clippy::unwrap_used, reason = "a surface that cannot be built is a failed test")]
#![expect(clippy::cast_precision_loss, reason = "counts and random bits become numbers")]
#![expect(clippy::float_cmp, reason = "what was not written must be as it was")]

mod arguments;
#[path = "../surfaces/mod.rs"]
#[expect(dead_code, reason = "not every crate reads every column")]
mod rows;
mod varied;

use core::marker::PhantomData;
use core::panic::AssertUnwindSafe;
use std::panic::catch_unwind;

use arguments::{Arguments, direction, numbers};
use microsurface::batch::simd::{Level, highest, level, limit_to};
use microsurface::batch::{
    Custom, Directions, DirectionsMut, NdfBatch, Numbers, ReflectionBatch, Samples, StagedVndf,
};
use microsurface::beckmann::BeckmannTo1e6;
use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::fresnel::{Conductor, Dielectric, Fresnel, Perfect, Schlick, Spectrum};
use microsurface::glam::Vec3;
use microsurface::ndf::Vec3 as Vec3Of;
use microsurface::profile::{Profile, SampleProfile, SampleVisibleProfile};
use microsurface::transform::Transformed;
use microsurface::{
    AxisAligned, Beckmann, Error, Ggx, Gtr, Microsurface, Ndf, Real, RoughnessMatrix, SampleNdf, SampleVndf,
};
use rows::{Batched, Distribution, Row, Visitor};

/// One more than a block, and a few.
const LONGEST: usize = 67;

/// Bits of one kind of NaN.
fn bits<T: Real>(x: T) -> u64 {
    let x = x.to_f64();
    if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }
}

fn same<T: Real>(what: &str, batch: &[T], scalar: impl Fn(usize) -> T) {
    for (i, &batch_value) in batch.iter().enumerate() {
        let value = scalar(i);
        let len = batch.len();
        assert_eq!(
            bits(batch_value),
            bits(value),
            "{what}[{i}] of {len}: {batch_value} and {value}, {:?}",
            level()
        );
    }
}

fn same_directions<T: Real>(what: &str, batch: &[Vec<T>; 3], scalar: impl Fn(usize) -> T::Vec3) {
    for (k, component) in batch.iter().enumerate() {
        same(what, component, |i| {
            let v: [T; 3] = scalar(i).into();
            v[k]
        });
    }
}

/// One material on batches of every length.
fn one<M: Copy>(materials: [M; 2], check: impl Fn(&M, usize, &dyn Fn(usize) -> M)) {
    for len in 0..=LONGEST {
        check(&materials[0], len, &|_| materials[0]);
    }
}

/// Slices of two materials by turns, of every length.
fn slice<M: Copy>(materials: [M; 2], check: impl Fn(&[M], usize, &dyn Fn(usize) -> M)) {
    for len in 0..=LONGEST {
        let each: Vec<M> = (0..len).map(|i| materials[i % 2]).collect();
        check(&each, len, &|i| materials[i % 2]);
    }
}

type Scalar<B> = <B as NdfBatch>::Scalar;

fn evaluates<B, N>(batch: &B, len: usize, at: &dyn Fn(usize) -> N)
where
    B: NdfBatch<Material: SampleNdf, Scalar = N::Scalar> + ?Sized,
    N: SampleNdf,
{
    let a = Arguments::<Scalar<B>>::new(len, 1);
    let (wi, wo) = (|i| direction::<Scalar<B>>(&a.wi, i), |i| direction::<Scalar<B>>(&a.wo, i));
    let mut out = vec![Scalar::<B>::ONE; len];
    batch.d_batch(a.wo(), &mut out);
    same("d", &out, |i| at(i).d(wo(i)));
    batch.sigma_batch(a.wo(), &mut out);
    same("sigma", &out, |i| at(i).sigma(wo(i)));
    batch.lambda_batch(a.wo(), &mut out);
    same("lambda", &out, |i| at(i).lambda(wo(i)));
    batch.g1_batch(a.wo(), a.wi(), &mut out);
    same("g1", &out, |i| at(i).g1(wo(i), wi(i)));
    batch.g2_batch(a.wi(), a.wo(), a.wi(), &mut out);
    same("g2", &out, |i| at(i).g2(wi(i), wo(i), wi(i)));
    batch.vndf_batch(a.wo(), a.wi(), &mut out);
    same("vndf", &out, |i| at(i).vndf(wo(i), wi(i)));
    let mut normals = [0, 1, 2].map(|_| vec![Scalar::<B>::ONE; len]);
    let [x, y, z] = &mut normals;
    batch.sample_d_batch(a.u(), DirectionsMut { x, y, z });
    same_directions("sample_d", &normals, |i| at(i).sample_d(numbers(&a.u, i)));
}

fn samples<B, N>(batch: &B, len: usize, at: &dyn Fn(usize) -> N)
where
    B: NdfBatch<Material: StagedVndf, Scalar = N::Scalar> + ?Sized,
    N: SampleVndf,
{
    for a in [Arguments::<Scalar<B>>::new(len, 2), Arguments::usual(len, 2)] {
        let mut normals = [0, 1, 2].map(|_| vec![Scalar::<B>::ONE; len]);
        let [x, y, z] = &mut normals;
        batch.sample_vndf_batch(a.wo(), a.u(), DirectionsMut { x, y, z });
        same_directions("sample_vndf", &normals, |i| {
            at(i).sample_vndf(direction::<Scalar<B>>(&a.wo, i), numbers(&a.u, i))
        });
    }
}

fn reflects<N, F, S, B>(batch: &B, len: usize, at: &dyn Fn(usize) -> RoughConductor<N, F, S>)
where
    N: Ndf + Copy,
    F: Fresnel + Copy,
    F::Output: Spectrum<Scalar = N::Scalar>,
    S: NormalSampling<N> + Copy,
    B: ReflectionBatch<Scalar = N::Scalar, Spectrum = F::Output> + ?Sized,
{
    let nothing = F::Output::splat(N::Scalar::ONE);
    // A channel at a time.
    let same_values = |what: &str, batch: &[F::Output], scalar: &dyn Fn(usize) -> F::Output| {
        for (i, &value) in batch.iter().enumerate() {
            let _ = value.zip(scalar(i), |a, b| {
                assert_eq!(bits(a), bits(b), "{what}[{i}] of {}: {a} and {b}, {:?}", batch.len(), level());
                a
            });
        }
    };
    let a = Arguments::<N::Scalar>::new(len, 3);
    let wi = |i| -> Vec3Of<N> { direction::<N::Scalar>(&a.wi, i) };
    let wo = |i| -> Vec3Of<N> { direction::<N::Scalar>(&a.wo, i) };
    let (mut f, mut pdf) = (vec![nothing; len], vec![N::Scalar::ONE; len]);
    batch.eval_batch(a.wi(), a.wo(), &mut f);
    same_values("eval", &f, &|i| at(i).eval(wi(i), wo(i)));
    batch.pdf_batch(a.wi(), a.wo(), &mut pdf);
    same("pdf", &pdf, |i| at(i).pdf(wi(i), wo(i)));
    f.fill(nothing);
    pdf.fill(N::Scalar::ONE);
    batch.eval_and_pdf_batch(a.wi(), a.wo(), &mut f, &mut pdf);
    same_values("f of both", &f, &|i| at(i).eval(wi(i), wo(i)));
    same("density of both", &pdf, |i| at(i).pdf(wi(i), wo(i)));

    for a in [a, Arguments::usual(len, 3)] {
        let mut sampled = [0, 1, 2].map(|_| vec![N::Scalar::ONE; len]);
        let [x, y, z] = &mut sampled;
        batch.sample_batch(
            a.wo(),
            a.u(),
            Samples { wi: DirectionsMut { x, y, z }, weight: &mut f, pdf: &mut pdf },
        );
        let scalar = |i| at(i).sample(direction::<N::Scalar>(&a.wo, i), numbers(&a.u, i));
        let zero = N::Scalar::ZERO;
        same_values("weight", &f, &|i| scalar(i).map_or(F::Output::splat(zero), |sample| sample.weight));
        same("density of the sample", &pdf, |i| scalar(i).map_or(zero, |sample| sample.pdf));
        same_directions("sample", &sampled, |i| {
            scalar(i).map_or(direction::<N::Scalar>(&sampled, i), |sample| sample.wi)
        });
    }
}

/// Profiles, maps, samplings and Fresnel terms; every loop is compiled three times, so that not all
/// combinations are here.
fn everything<T: Elementary>() {
    let l = T::lit;
    let matrix = |a| RoughnessMatrix::rotated(l(a), l(0.1), l(0.4)).unwrap();
    for row in Row::SOME {
        for gamma in row.columns().gammas {
            row.visit_some(Every([row.with(0.3, *gamma), row.with(0.01, *gamma)], PhantomData::<T>));
        }
    }
    let ggx = [0.3, 0.01].map(|alpha| Ggx::isotropic(l(alpha)).unwrap());
    let turned = [0.5, 0.02].map(|alpha| Ggx::from_roughness_matrix(matrix(alpha)));
    let beckmann = [0.3, 0.01].map(|alpha| Beckmann::anisotropic(l(alpha), l(0.2)).unwrap());
    let spline = [0.3, 0.05].map(|alpha| Gtr::spline(l(alpha), l(1.5)).unwrap());
    one(ggx, |m, len, at| evaluates(m, len, at));
    slice(ggx, |m, len, at| evaluates(m, len, at));
    one(turned, |m, len, at| evaluates(m, len, at));
    one(turned, |m, len, at| samples(m, len, at));
    slice(turned, |m, len, at| samples(m, len, at));
    let moved = beckmann.map(|surface| Transformed::new(surface, shear::<T>()).unwrap());
    one(moved, |m, len, at| samples(m, len, at));

    let glass = Dielectric::new(l(1.5)).unwrap();
    let rough = ggx.map(|surface| RoughConductor::new(surface, Schlick::new(l(0.9)).unwrap()));
    one(rough, |m, len, at| reflects(m, len, at));
    slice(rough, |m, len, at| reflects(m, len, at));
    one(beckmann.map(|surface| RoughConductor::new(surface, glass)), |m, len, at| reflects(m, len, at));
    let mixture = UniformMixture::new(AllNormals, l(0.3)).unwrap();
    let mixed = spline.map(|surface| RoughConductor::new(surface, Perfect::<T>::new()).sampled_by(mixture));
    one(mixed, |m, len, at| reflects(m, len, at));

    // Forms 0, 1, 2 and beyond.
    for gammas in [[1.5, 2.5], [2.5, 3.5], [3.5, 5.5], [5.5, 1.5]] {
        let any = gammas.map(|gamma| Gtr::with_nodes::<2>(l(0.3), l(gamma)).unwrap());
        one(any, |surface, len, at| {
            let a = Arguments::<T>::new(len, 7);
            let mut out = vec![T::ONE; len];
            surface.sigma_batch(a.wo(), &mut out);
            same("sigma", &out, |i| at(i).sigma(direction::<T>(&a.wo, i)));
            surface.g1_batch(a.wo(), a.wi(), &mut out);
            same("g1", &out, |i| at(i).g1(direction::<T>(&a.wo, i), direction::<T>(&a.wi, i)));
        });
    }
}

/// Every function of two distributions of a row, each under a map along the axes.
struct Every<T>([Distribution; 2], PhantomData<T>);

impl<T: Real> Every<T> {
    fn surfaces<P: Profile<T>>(
        &self,
        profile: impl Fn(T, T) -> Result<P, Error>,
    ) -> [Microsurface<P, AxisAligned<T>>; 2] {
        let widths = |d: &Distribution| AxisAligned::new(T::lit(d.alpha), T::lit(0.2)).unwrap();
        self.0.each_ref().map(|d| Microsurface::new(d.profile(&profile).unwrap(), widths(d)))
    }
}

impl<T: Real> Visitor<T> for Every<T> {
    type Output = ();

    fn visible<P>(self, profile: impl Fn(T, T) -> Result<P, Error>)
    where
        P: SampleProfile<T> + SampleVisibleProfile<T>,
        Microsurface<P, AxisAligned<T>>: Batched<T> + StagedVndf,
    {
        let surfaces = self.surfaces(profile);
        one(surfaces, |m, len, at| evaluates(m, len, at));
        one(surfaces, |m, len, at| samples(m, len, at));
    }

    fn all_normals<P>(self, profile: impl Fn(T, T) -> Result<P, Error>)
    where
        P: SampleProfile<T>,
        Microsurface<P, AxisAligned<T>>: Batched<T>,
    {
        one(self.surfaces(profile), |m, len, at| evaluates(m, len, at));
    }
}

/// A matrix that is neither symmetric nor near 1.
fn shear<T: Real>() -> T::Mat2 {
    T::matrix([[T::lit(1.5), T::lit(-0.3)], [T::lit(0.8), T::lit(0.6)]])
}

/// f32 and f64 as their own spectra.
trait Elementary: Real + Spectrum<Scalar = Self> {}
impl Elementary for f32 {}
impl Elementary for f64 {}

/// The only test that limits the level; the others are right at any.
#[test]
fn every_entry_point_is_the_scalar_call_at_every_level() {
    for limit in [Level::Target, Level::Avx2, Level::Avx512] {
        let used = limit_to(limit);
        assert!(used <= limit && used <= highest() && level() == used);
        if used == limit {
            everything::<f32>();
            everything::<f64>();
            varied::everything::<f32>();
            varied::everything::<f64>();
        }
    }
    assert_eq!(limit_to(highest()), highest());
}

/// Not `Copy`.
struct Table(Vec<microsurface::Microsurface<Ggx, microsurface::Isotropic<f32>>>);
impl Ndf for Table {
    type Scalar = f32;
    fn d(&self, wm: Vec3) -> f32 {
        self.0[1].d(wm)
    }
    fn sigma(&self, w: Vec3) -> f32 {
        self.0[1].sigma(w)
    }
}

#[test]
fn spectra_of_three_and_borrowed_distributions() {
    let gold = Conductor::new(Vec3::new(0.14, 0.43, 1.38), Vec3::new(3.697, 2.455, 1.914)).unwrap();
    let surfaces = [0.2_f32, 0.05].map(|alpha| Ggx::isotropic(alpha).unwrap());
    one(surfaces.map(|surface| RoughConductor::new(surface, gold)), |m, len, at| reflects(m, len, at));
    let table = Table(surfaces.to_vec());
    let a = Arguments::<f32>::new(LONGEST, 5);
    let mut densities = [0.0; LONGEST];
    Custom(&table).vndf_batch(a.wo(), a.wi(), &mut densities);
    same("vndf of a table", &densities, |i| table.vndf(direction(&a.wo, i), direction(&a.wi, i)));
}

/// Borrowed distributions and mixtures ask as the distributions themselves; of whatever type is
/// only known at run time, every element is drawn by its own sampler.
#[test]
fn slopes_of_borrowed_and_of_mixed_beckmann() {
    let surfaces = [0.3_f32, 0.01].map(|alpha| Beckmann::isotropic(alpha).unwrap());
    one(surfaces.each_ref(), |m, len, at| samples(m, len, at));
    let (beckmann, ggx) = (surfaces[0], Ggx::isotropic(0.2_f32).unwrap());
    let fast = BeckmannTo1e6::isotropic(0.2_f32).unwrap();
    let any: [[&dyn SampleVndf<Scalar = f32>; 2]; 4] =
        [[&beckmann, &ggx], [&ggx, &beckmann], [&fast, &fast], [&ggx, &fast]];
    for pair in any {
        one(pair.map(Custom), |m, len, at| samples(m, len, at));
        slice(pair.map(Custom), |m, len, at| samples(m, len, at));
    }
    let mixture = UniformMixture::new(VisibleNormals, 0.3).unwrap();
    let mixed =
        surfaces.map(|surface| RoughConductor::new(surface, Perfect::<f32>::new()).sampled_by(mixture));
    one(mixed, |m, len, at| reflects(m, len, at));
}

/// Every slice in turn one too short and one too long.
#[test]
fn slices_of_unequal_lengths_panic_before_anything_is_written() {
    const LEN: usize = 65;
    let surface = Ggx::isotropic(0.3_f64).unwrap();
    let brdf = RoughConductor::new(surface, Schlick::new(0.9).unwrap());
    let a = Arguments::<f64>::new(LEN + 1, 4);
    for wrong in [0, LEN - 1, LEN + 1] {
        for odd in 0..10 {
            let len = |k: usize| if k == odd { wrong } else { LEN };
            let wo = Directions { x: &a.wo[0][..len(0)], y: &a.wo[1][..len(1)], z: &a.wo[2][..len(2)] };
            let u = Numbers { x: &a.u[0][..len(3)], y: &a.u[1][..len(4)] };
            let mut out = [0, 1, 2, 3, 4].map(|k| vec![-7.0; len(5 + k)]);
            let [x, y, z, weight, pdf] = &mut out;
            let panicked = catch_unwind(AssertUnwindSafe(|| {
                brdf.sample_batch(wo, u, Samples { wi: DirectionsMut { x, y, z }, weight, pdf });
            }));
            assert!(panicked.is_err(), "slice {odd} of length {wrong}");
            assert!(out.iter().flatten().all(|&value| value == -7.0), "slice {odd} of length {wrong}");
        }
        let full = Directions { x: &a.wo[0][..LEN], y: &a.wo[1][..LEN], z: &a.wo[2][..LEN] };
        let mut out = vec![-7.0; LEN];
        for (surfaces, wi, out_len) in [(wrong, LEN, LEN), (LEN, wrong, LEN), (LEN, LEN, wrong.min(LEN - 1))]
        {
            let (surfaces, out) = (vec![surface; surfaces], &mut out[..out_len]);
            let w = Directions { x: &a.wi[0][..LEN], y: &a.wi[1][..LEN], z: &a.wi[2][..wi] };
            let panicked = catch_unwind(AssertUnwindSafe(|| surfaces[..].g1_batch(full, w, out)));
            assert!(panicked.is_err() && out.iter().all(|&value| value == -7.0), "length {wrong}");
        }
    }
}

#[test]
fn nan_stays_in_its_lane() {
    let surface = Beckmann::anisotropic(0.3_f32, 0.1).unwrap();
    let mut a = Arguments::<f32>::new(LONGEST, 6);
    for slice in a.wo.iter_mut().chain(&mut a.wi) {
        for value in slice {
            *value = if value.is_nan() { 0.5 } else { *value };
        }
    }
    let values = |a: &Arguments<f32>| {
        let (mut g2, mut normals) = ([0.0; LONGEST], [0, 1, 2].map(|_| vec![0.0; LONGEST]));
        surface.g2_batch(a.wi(), a.wo(), a.wo(), &mut g2);
        let [x, y, z] = &mut normals;
        surface.sample_vndf_batch(a.wo(), a.u(), DirectionsMut { x, y, z });
        (g2, normals)
    };
    let (g2, normals) = values(&a);
    for lane in 0..LONGEST {
        let saved = core::mem::replace(&mut a.wo[0][lane], f32::NAN);
        let (g2_beside, normals_beside) = values(&a);
        let others = |i: usize| i != lane;
        assert!((0..LONGEST).filter(|&i| others(i)).all(|i| bits(g2[i]) == bits(g2_beside[i])));
        for (before, beside) in normals.iter().zip(&normals_beside) {
            assert!((0..LONGEST).filter(|&i| others(i)).all(|i| bits(before[i]) == bits(beside[i])));
            assert!(beside[lane].is_nan());
        }
        a.wo[0][lane] = saved;
    }
}
