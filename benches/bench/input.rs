//! Arguments and materials, the same for every question: drawn once from a fixed seed.

use core::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};
use microsurface::profile::{Profile, SampleProfile, SampleVisibleProfile};
use microsurface::{Error, Isotropic, Microsurface, Real, SampleNdf, SampleVndf};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::rows::{Columns, Row, Visitor};

/// Arguments per iteration of a scalar question.
pub(crate) const CALLS: usize = 4096;

/// Materials a scalar question cycles through: few enough to stay in the first-level cache.
pub(crate) const MATERIALS: u8 = 32;

pub(crate) fn generator() -> impl Rng {
    Pcg64Mcg::seed_from_u64(0x6d_6963_726f)
}

/// `n` numbers in [0, 1).
pub(crate) fn uniform<T: Real>(n: usize, rng: &mut impl Rng) -> Vec<T> {
    (0..n).map(|_| T::lit(f64::from(rng.random::<f32>()))).collect()
}

/// A direction uniform over the upper hemisphere.
pub(crate) fn direction<T: Real>(rng: &mut impl Rng) -> [T; 3] {
    let z = rng.random_range(1e-4..1.0_f64);
    let (sin, cos) = rng.random_range(0.0..core::f64::consts::TAU).sin_cos();
    let r = ((1.0 - z) * (1.0 + z)).sqrt();
    [T::lit(r * cos), T::lit(r * sin), T::lit(z)]
}

/// `n` directions uniform over the upper hemisphere.
pub(crate) fn directions<T: Real>(n: usize, rng: &mut impl Rng) -> Vec<T::Vec3> {
    (0..n).map(|_| direction::<T>(rng).into()).collect()
}

/// One normal per call: by turns uniform over the hemisphere, where narrow distributions underflow,
/// and drawn from the material.
pub(crate) fn normals<N: SampleNdf>(materials: &[N]) -> Vec<<N::Scalar as Real>::Vec3> {
    let mut rng = generator();
    let cycle = materials.iter().cycle().take(CALLS).enumerate();
    cycle
        .map(|(i, material)| {
            let u: [N::Scalar; 2] = [0, 1].map(|_| N::Scalar::lit(rng.random_range(0.0..1.0)));
            if i % 2 == 0 { direction::<N::Scalar>(&mut rng).into() } else { material.sample_d(u.into()) }
        })
        .collect()
}

/// Slope widths from 0.01 to 1, log-uniform and shuffled.
pub(crate) fn alphas<T: Real>() -> Vec<T> {
    (0..MATERIALS).map(|i| T::lit(0.01_f64.powf(f64::from(i) * 13.0 / f64::from(MATERIALS) % 1.0))).collect()
}

/// What is asked about every distribution under every map.
pub(crate) trait Question<T: Real> {
    fn ask<N: SampleNdf<Scalar = T> + Copy>(&mut self, id: (&str, &str), materials: &[N]);

    /// Asks about one whose visible normals can be drawn.
    fn ask_visible<N: SampleNdf<Scalar = T> + SampleVndf + Copy>(
        &mut self,
        id: (&str, &str),
        materials: &[N],
    ) {
        self.ask(id, materials);
    }
}

/// The exponent of the tail, where there is a choice.
const GAMMA: f64 = 1.5;

/// Asks about every distribution that stands for all, under every map.
pub(crate) fn each_surface<T: Real>(question: &mut impl Question<T>) {
    for &row in Row::SOME {
        row.visit_some(Asked { row, question: &mut *question });
    }
}

/// A row that a question is asked about.
struct Asked<'a, Q> {
    row: Row,
    question: &'a mut Q,
}

impl<Q> Asked<'_, Q> {
    fn name(&self) -> String {
        let Columns { name, range: [low, high], .. } = self.row.columns();
        if low < high { format!("{name}-{GAMMA}") } else { name.into() }
    }
}

/// The isotropic surface of a row and a width.
fn surface<T: Real, P: Profile<T>>(
    row: Row,
    profile: impl Fn(T, T) -> Result<P, Error>,
) -> impl Fn(T) -> Option<Microsurface<P, Isotropic<T>>> {
    move |alpha| {
        let map = Isotropic::new(if row.columns().own_width { T::ONE } else { alpha }).ok()?;
        Some(Microsurface::new(profile(alpha, T::lit(GAMMA)).ok()?, map))
    }
}

impl<T: Real, Q: Question<T>> Visitor<T> for Asked<'_, Q> {
    type Output = ();

    fn visible<P>(self, profile: impl Fn(T, T) -> Result<P, Error>)
    where
        P: SampleProfile<T> + SampleVisibleProfile<T>,
    {
        let (name, surface) = (self.name(), surface(self.row, profile));
        self.question.ask_visible((&name, "isotropic"), &materials(&surface));
        self.question.ask_visible((&name, "axis-aligned"), &stretched(&surface));
        self.question.ask_visible((&name, "general"), &transformed(&surface));
    }

    fn all_normals<P: SampleProfile<T>>(self, profile: impl Fn(T, T) -> Result<P, Error>) {
        let (name, surface) = (self.name(), surface(self.row, profile));
        self.question.ask((&name, "isotropic"), &materials(&surface));
        self.question.ask((&name, "axis-aligned"), &stretched(&surface));
        self.question.ask((&name, "general"), &transformed(&surface));
    }
}

pub(crate) fn materials<T: Real, N>(surface: impl Fn(T) -> Option<N>) -> Vec<N> {
    alphas().into_iter().map(|alpha| surface(alpha).expect("a width within the range")).collect()
}

/// The materials compressed along x and stretched along y.
pub(crate) fn stretched<T: Real, P: Profile<T>>(
    surface: impl Fn(T) -> Option<Microsurface<P, Isotropic<T>>>,
) -> Vec<Microsurface<P, microsurface::AxisAligned<T>>> {
    materials(|alpha| surface(alpha)?.stretched(T::lit(-0.3)).ok())
}

/// The materials sheared and turned.
pub(crate) fn transformed<T: Real, P: Profile<T>>(
    surface: impl Fn(T) -> Option<Microsurface<P, Isotropic<T>>>,
) -> Vec<Microsurface<P, microsurface::Linear<T>>> {
    let matrix = [[0.8, 0.3], [-0.4, 1.1]].map(|column| column.map(T::lit));
    materials(|alpha| surface(alpha)?.transformed(T::matrix(matrix)).ok())
}

/// The name of a scalar, for the name of a group.
pub(crate) fn name<T>() -> &'static str {
    core::any::type_name::<T>()
}

/// A group whose times are per call.
pub(crate) fn group<'a, T>(criterion: &'a mut Criterion, question: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(format!("{question}/{}", name::<T>()));
    group.throughput(Throughput::Elements(CALLS as u64));
    group
}

/// Times `call(material, argument)`, the materials taken by turns.
pub(crate) fn calls<M, A: Copy, R>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    (alternative, variant): (&str, &str),
    materials: &[M],
    arguments: &[A],
    call: impl Fn(&M, A) -> R,
) {
    group.bench_function(BenchmarkId::new(alternative, variant), |bencher| {
        bencher.iter(|| {
            for some in black_box(arguments).chunks_exact(materials.len()) {
                for (material, &argument) in materials.iter().zip(some) {
                    black_box(call(material, argument));
                }
            }
        });
    });
}
