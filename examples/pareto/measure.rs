//! Worst and mean errors, and times of alternatives that take turns.

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

/// Runs over [`CALLS`] arguments.
pub(crate) type Run = Box<dyn FnMut()>;

/// Arguments per round.
const CALLS: u16 = 4096;

/// A run of scalar calls: every result is opaque, and the materials take turns.
pub(crate) fn calls<T: Real, N: 'static>(
    materials: Vec<N>,
    call: impl Fn(&N, T::Vec3) -> T + 'static,
) -> Run {
    // A stride through the directions, so that neighbours are unlike.
    let sorted = directions::<T>(4093);
    let arguments: Vec<T::Vec3> = (0..usize::from(CALLS)).map(|i| sorted[i * 1291 % sorted.len()]).collect();
    Box::new(move || {
        for (&w, material) in black_box(&arguments).iter().zip(materials.iter().cycle()) {
            black_box(call(material, w));
        }
    })
}

/// The median times per call, in nanoseconds, over `rounds` in which the runs take turns.
pub(crate) fn times(runs: &mut [Run], rounds: usize) -> Vec<f64> {
    let mut samples = vec![Vec::with_capacity(rounds); runs.len()];
    for _ in 0..rounds {
        for (run, samples) in runs.iter_mut().zip(&mut samples) {
            let start = Instant::now();
            run();
            samples.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS));
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
