//! Worst and mean errors, and times of alternatives that take turns: as scalar calls, and as loops
//! over slices.

use core::hint::black_box;
use std::time::Instant;

use microsurface::Real;

/// The largest error and where it is, and the root of the mean square.
#[derive(Clone, Default)]
pub(crate) struct Errors {
    pub(crate) worst: f64,
    pub(crate) at: String,
    sum_of_squares: f64,
    count: f64,
}

impl Errors {
    /// Counts one error; `at` is asked where it is the largest so far.
    pub(crate) fn add(&mut self, error: f64, at: impl Fn() -> String) {
        self.sum_of_squares += error * error;
        self.count += 1.0;
        // NaN counts as the worst of all.
        if error.is_nan() || error.abs() > self.worst {
            self.worst = error.abs();
            self.at = at();
        }
    }

    /// Counts the errors of another.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.sum_of_squares += other.sum_of_squares;
        self.count += other.count;
        if other.worst.is_nan() || other.worst > self.worst {
            (self.worst, self.at) = (other.worst, other.at.clone());
        }
    }

    /// There is something to compare with.
    pub(crate) fn known(&self) -> bool {
        self.count > 0.0
    }

    pub(crate) fn rms(&self) -> f64 {
        (self.sum_of_squares / self.count).sqrt()
    }
}

/// Directions in the plane of x and z, with cot θ from 1e-6 to 1e3 in equal steps of its logarithm.
pub(crate) fn directions<T: Real>(n: u32) -> Vec<T::Vec3> {
    (0..n)
        .map(|i| {
            let cot = 10_f64.powf(-6.0 + 9.0 * f64::from(i) / f64::from(n - 1));
            let sin = 1.0 / (1.0 + cot * cot).sqrt();
            [T::lit(sin), T::ZERO, T::lit(sin * cot)].into()
        })
        .collect()
}

/// The squared sine and the cosine of a direction, exactly as the function gets it.
pub(crate) fn exactly<T: Real>(w: T::Vec3) -> (f64, f64) {
    let [x, y, z] = w.into().map(T::to_f64);
    (x * x + y * y, z)
}

/// θ in degrees, for messages.
pub(crate) fn degrees((s2, z): (f64, f64)) -> f64 {
    s2.sqrt().atan2(z).to_degrees()
}

/// Something that is timed as a whole, and of how many calls it consists.
pub(crate) struct Run {
    calls: u32,
    run: Box<dyn FnMut()>,
}

impl Run {
    pub(crate) fn new(calls: u32, run: impl FnMut() + 'static) -> Self {
        Self { calls, run: Box::new(run) }
    }
}

/// Arguments per round.
const CALLS: u32 = 4096;

/// Arguments that a loop over slices takes for one material.
const SLICE: usize = 128;

/// Directions uniform over a hemisphere, in an order in which neighbours are unlike.
///
/// Not those that errors are searched at: near the normal, where these seldom are, e^{−ν²} and
/// powers of α² underflow, and what denormal numbers cost is no property of the method.
fn arguments<T: Real>() -> Vec<T::Vec3> {
    const COUNT: u32 = 4093;
    (0..CALLS)
        .map(|i| {
            let z = (f64::from(i * 1291 % COUNT) + 0.5) / f64::from(COUNT);
            [T::lit(((1.0 - z) * (1.0 + z)).sqrt()), T::ZERO, T::lit(z)].into()
        })
        .collect()
}

/// Scalar calls and loops over slices of the same materials.
pub(crate) fn both<T: Real, N: Clone + 'static>(
    materials: Vec<N>,
    call: impl Fn(&N, T::Vec3) -> T + Copy + 'static,
) -> [Run; 2] {
    [calls(materials.clone(), call), loops(materials, call)]
}

/// A run of scalar calls: every result is opaque, and the materials take turns.
fn calls<T: Real, N: 'static>(materials: Vec<N>, call: impl Fn(&N, T::Vec3) -> T + 'static) -> Run {
    let arguments = arguments::<T>();
    Run::new(CALLS, move || {
        for (&w, material) in black_box(&arguments).iter().zip(materials.iter().cycle()) {
            black_box(call(material, w));
        }
    })
}

/// A run of scalar calls of arguments of any kind, whose results are opaque.
pub(crate) fn calls_of<A: 'static, R>(arguments: Vec<A>, call: impl Fn(&A) -> R + 'static) -> Run {
    let calls = u32::try_from(arguments.len()).expect("fewer arguments");
    Run::new(calls, move || {
        for argument in black_box(&arguments) {
            black_box(call(argument));
        }
    })
}

/// A run of loops as a user writes them over structures of arrays, which the compiler may make
/// vector code of.
fn loops<T: Real, N: 'static>(materials: Vec<N>, call: impl Fn(&N, T::Vec3) -> T + 'static) -> Run {
    let arrays: Vec<[T; 3]> = arguments::<T>().into_iter().map(Into::into).collect();
    let [x, y, z] = [0, 1, 2].map(|axis| arrays.iter().map(|w| w[axis]).collect::<Vec<T>>());
    let mut out = vec![T::ZERO; x.len()];
    Run::new(CALLS, move || {
        let [x, y, z] = black_box([&x, &y, &z]).map(|axis| axis.chunks(SLICE));
        let slices = x.zip(y).zip(z).zip(out.chunks_mut(SLICE));
        for ((((x, y), z), out), material) in slices.zip(materials.iter().cycle()) {
            for (((out, &x), &y), &z) in out.iter_mut().zip(x).zip(y).zip(z) {
                *out = call(material, [x, y, z].into());
            }
        }
        black_box(&mut out);
    })
}

/// The median times per call, in nanoseconds, over `rounds` in which the runs take turns.
pub(crate) fn times(runs: &mut [Run], rounds: usize) -> Vec<f64> {
    let mut samples = vec![Vec::with_capacity(rounds); runs.len()];
    for _ in 0..rounds {
        for (Run { calls, run }, samples) in runs.iter_mut().zip(&mut samples) {
            let start = Instant::now();
            run();
            samples.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(*calls));
        }
    }
    samples
        .into_iter()
        .map(|mut samples| {
            samples.sort_by(f64::total_cmp);
            samples[samples.len() / 2]
        })
        .collect()
}

/// The same for pairs of runs.
pub(crate) fn pairs_of_times(runs: impl IntoIterator<Item = [Run; 2]>, rounds: usize) -> Vec<[f64; 2]> {
    let mut runs: Vec<Run> = runs.into_iter().flatten().collect();
    times(&mut runs, rounds).chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
}
