//! The cost of an element of a batch as the batch grows, as threads share it, and as its materials
//! differ, in width too.
//!
//! ```text
//! cargo bench --bench bench -- scaling            # five minutes, and half a gigabyte for the batches of 10⁷
//! cargo bench --bench bench -- scaling_materials  # one of scaling_{size,alpha,threads,materials}
//! ```
//!
//! Short batches show the price of a call, long ones that of memory: an element reads five or six
//! numbers and writes one or three. Two threads share a batch by halves and are started for each,
//! as by a caller without a pool of threads. Where every element has a material of its own, copies
//! lie in the order of the elements, so that the number of distinct ones matters only to what
//! depends on their numbers; what is paid is their reading.

use core::hint::black_box;
use std::thread;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};
use microsurface::batch::{Directions, DirectionsMut, NdfBatch, Numbers, ReflectionBatch};
use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::{Schlick, Spectrum};
use microsurface::profile::Profile;
use microsurface::{AxisAligned, Beckmann, Ggx, Isotropic, Linear, Microsurface, Ndf, Real};
use rand::RngExt;

use crate::input::{direction, generator, name, uniform};

const SIZES: [usize; 7] = [64, 256, 1024, 4096, 65_536, 1_000_000, 10_000_000];
/// Sizes that threads share.
const SHARED: [usize; 2] = [65_536, 1_000_000];
/// Elements whose materials differ, and how many distinct ones they have.
const ELEMENTS: usize = 65_536;
const DISTINCT: [usize; 4] = [1, 16, 256, 4096];

/// The width of the one material, the middle of [`widths`], and widths of one that are compared.
const ALPHA: f64 = 0.03;
const ALPHAS: [f64; 6] = [1.0, 0.3, 0.1, 0.03, 0.01, 0.001];
const F0: f64 = 0.9;

/// `n` widths from 0.001 to 1, log-uniform.
fn widths<T: Real>(n: usize) -> impl Iterator<Item = T> {
    let mut rng = generator();
    (0..n).map(move |_| T::lit(0.001_f64.powf(rng.random_range(0.0..1.0))))
}

/// The largest size that the arguments of the command leave time and memory for.
fn largest() -> usize {
    let given = |argument| std::env::args().any(|other| other == argument);
    if given("--test") || !given("--bench") {
        ELEMENTS
    } else if given("--quick") {
        1_000_000
    } else {
        usize::MAX
    }
}

/// What a batch reads; those of two numbers leave the last array empty.
type Read<'a, T> = [&'a [T]; 6];
/// What it writes; those of scalars leave two empty.
type Written<'a, T> = [&'a mut [T]; 3];

struct Arrays<T> {
    read: [Vec<T>; 6],
    written: [Vec<T>; 3],
}

impl<T: Real> Arrays<T> {
    /// Pairs of directions, and a scalar each.
    fn pairs(n: usize) -> Self {
        let mut rng = generator();
        let mut arrays = Self { read: Default::default(), written: [vec![T::ZERO; n], vec![], vec![]] };
        for _ in 0..n {
            for axes in arrays.read.chunks_exact_mut(3) {
                for (axis, component) in axes.iter_mut().zip(direction::<T>(&mut rng)) {
                    axis.push(component);
                }
            }
        }
        arrays
    }

    /// Directions with two random numbers, and a normal each.
    fn normals(n: usize) -> Self {
        let Self { read: [x, y, z, ..], .. } = Self::pairs(n);
        let mut rng = generator();
        let u = [uniform(n, &mut rng), uniform(n, &mut rng)];
        let [u, v] = u;
        Self { read: [x, y, z, u, v, vec![]], written: [0, 1, 2].map(|_| vec![T::ZERO; n]) }
    }

    fn borrowed(&mut self) -> (Read<'_, T>, Written<'_, T>) {
        (self.read.each_ref().map(Vec::as_slice), self.written.each_mut().map(Vec::as_mut_slice))
    }
}

/// A batch by name, and its arrays.
struct Question<T> {
    name: &'static str,
    arrays: fn(usize) -> Arrays<T>,
}

impl<T: Real> Question<T> {
    fn group<'a>(&self, criterion: &'a mut Criterion, scaling: &str) -> BenchmarkGroup<'a, WallTime> {
        criterion.benchmark_group(format!("scaling_{scaling}/{}_{}", self.name, name::<T>()))
    }

    /// Times `run`. Arrays are made when it is first called, so that what is not asked for takes no
    /// memory.
    fn time(
        &self,
        group: &mut BenchmarkGroup<'_, WallTime>,
        id: BenchmarkId,
        n: usize,
        run: impl Fn(Read<'_, T>, Written<'_, T>),
    ) {
        let mut arrays = None;
        group.throughput(Throughput::Elements(n as u64));
        // The longest batches vary little, and a hundred of them take a minute.
        group.sample_size(if n < 1_000_000 { 100 } else { 10 });
        group.bench_function(id, |bencher| {
            let arrays = arrays.get_or_insert_with(|| (self.arrays)(n));
            bencher.iter(|| {
                let (read, written) = black_box(&mut *arrays).borrowed();
                run(read, written);
            });
        });
    }

    fn sizes<M>(
        &self,
        criterion: &mut Criterion,
        material: &M,
        run: impl Fn(&M, Read<'_, T>, Written<'_, T>),
    ) {
        let mut group = self.group(criterion, "size");
        for n in SIZES.into_iter().filter(|&n| n <= largest()) {
            self.time(&mut group, BenchmarkId::from_parameter(n), n, |read, written| {
                run(material, read, written);
            });
        }
    }

    /// One material of several widths: the code is the same, but not how many numbers are subnormal
    /// on the way.
    fn alphas<M>(
        &self,
        criterion: &mut Criterion,
        material: impl Fn(T) -> M,
        run: impl Fn(&M, Read<'_, T>, Written<'_, T>),
    ) {
        let mut group = self.group(criterion, "alpha");
        for alpha in ALPHAS {
            let material = black_box(material(T::lit(alpha)));
            self.time(&mut group, BenchmarkId::from_parameter(alpha), SIZES[3], |read, written| {
                run(&material, read, written);
            });
        }
    }

    fn threads<M: Sync>(
        &self,
        criterion: &mut Criterion,
        material: &M,
        run: impl Fn(&M, Read<'_, T>, Written<'_, T>) + Sync,
    ) {
        let mut group = self.group(criterion, "threads");
        for n in SHARED.into_iter().filter(|&n| n <= largest()) {
            self.time(&mut group, BenchmarkId::new("1", n), n, |read, written| run(material, read, written));
            self.time(&mut group, BenchmarkId::new("2", n), n, |read, written| {
                let [first, second] = halves(read, written);
                thread::scope(|scope| {
                    scope.spawn(|| run(material, first.0, first.1));
                    run(material, second.0, second.1);
                });
            });
        }
    }

    /// One material, and one for each element.
    fn materials<M: Copy>(
        &self,
        criterion: &mut Criterion,
        map: &str,
        material: impl Fn(T) -> M,
        same: impl Fn(&M, Read<'_, T>, Written<'_, T>),
        various: impl Fn(&[M], Read<'_, T>, Written<'_, T>),
    ) {
        let mut group = self.group(criterion, "materials");
        let one = black_box(material(T::lit(ALPHA)));
        self.time(&mut group, BenchmarkId::new(map, "one"), ELEMENTS, |read, written| {
            same(&one, read, written);
        });
        for distinct in DISTINCT {
            let table: Vec<M> = widths(distinct).map(&material).collect();
            let mut rng = generator();
            let each: Vec<M> = (0..ELEMENTS).map(|_| table[rng.random_range(0..distinct)]).collect();
            let id = BenchmarkId::new(map, format!("each-of-{distinct}"));
            self.time(&mut group, id, ELEMENTS, |read, written| various(&each, read, written));
        }
    }
}

/// Both halves of every array.
fn halves<'a, T>(read: Read<'a, T>, written: Written<'a, T>) -> [(Read<'a, T>, Written<'a, T>); 2] {
    let middle = read[0].len() / 2;
    let at = |len: usize| middle.min(len);
    let [x, y, z] = written.map(|array| array.split_at_mut(at(array.len())));
    [
        (read.map(|array| &array[..at(array.len())]), [x.0, y.0, z.0]),
        (read.map(|array| &array[at(array.len())..]), [x.1, y.1, z.1]),
    ]
}

fn brdf<N: Ndf<Scalar: Spectrum>>(surface: N) -> RoughConductor<N, Schlick<N::Scalar>> {
    RoughConductor::new(surface, Schlick::new(N::Scalar::lit(F0)).expect("a share"))
}

type Surface<P, M> = Microsurface<P, M>;

/// The surface compressed along x and stretched along y.
fn stretched<P: Profile<T>, T: Real>(surface: Surface<P, Isotropic<T>>) -> Surface<P, AxisAligned<T>> {
    surface.stretched(T::lit(-0.3)).expect("within the range of α")
}

/// The surface sheared and turned.
fn moved<P: Profile<T>, T: Real>(surface: Surface<P, Isotropic<T>>) -> Surface<P, Linear<T>> {
    let matrix = [[0.8, 0.3], [-0.4, 1.1]].map(|column| column.map(T::lit));
    surface.transformed(T::matrix(matrix)).expect("within the range of α")
}

/// A batch of one material, compiled once for all who call it.
type Same<M, T> = fn(&M, Read<'_, T>, Written<'_, T>);

fn compiled_once<M, T>(_: &M, run: Same<M, T>) -> Same<M, T> {
    run
}

/// Everything about one batch. A macro, because the batch is a method of the material and of slices
/// of it, and the material a type for each map.
macro_rules! ask {
    ($criterion:ident, $name:literal, $arrays:ident, $profile:ident, $scalar:ty, $material:path, $run:expr) => {{
        let question = Question::<$scalar> { name: $name, arrays: Arrays::$arrays };
        let surface = |alpha| $profile::isotropic::<$scalar>(alpha).expect("a width within the range");
        let material = black_box($material(surface(<$scalar>::lit(ALPHA))));
        let same = compiled_once(&material, $run);
        question.sizes($criterion, &material, same);
        question.alphas($criterion, |alpha| $material(surface(alpha)), same);
        question.threads($criterion, &material, same);
        question.materials($criterion, "isotropic", |alpha| $material(surface(alpha)), same, $run);
        question.materials(
            $criterion,
            "axis-aligned",
            |alpha| $material(stretched(surface(alpha))),
            $run,
            $run,
        );
        question.materials($criterion, "linear", |alpha| $material(moved(surface(alpha))), $run, $run);
    }};
}

/// f of pairs of directions.
macro_rules! eval {
    () => {
        |materials, [ox, oy, oz, ix, iy, iz], [f, ..]| {
            materials.eval_batch(Directions { x: ix, y: iy, z: iz }, Directions { x: ox, y: oy, z: oz }, f);
        }
    };
}

/// Visible normals.
macro_rules! visible_normal {
    () => {
        |materials, [x, y, z, u, v, _], [mx, my, mz]| {
            let out = DirectionsMut { x: mx, y: my, z: mz };
            materials.sample_vndf_batch(Directions { x, y, z }, Numbers { x: u, y: v }, out);
        }
    };
}

pub(crate) fn bench(criterion: &mut Criterion) {
    use core::convert::identity;
    ask!(criterion, "ggx_eval", pairs, Ggx, f32, brdf, eval!());
    ask!(criterion, "ggx_eval", pairs, Ggx, f64, brdf, eval!());
    ask!(criterion, "ggx_visible_normal", normals, Ggx, f32, identity, visible_normal!());
    ask!(criterion, "beckmann_eval", pairs, Beckmann, f32, brdf, eval!());
}
