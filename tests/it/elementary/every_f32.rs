//! All 2³² f32 numbers of every function of one argument against the same function in f64, as
//! batches: `cargo test --release --test it every_f32 -- --ignored --nocapture`, about eight
//! minutes on two cores.

use core::sync::atomic::{AtomicU32, Ordering};
use std::thread;

use microsurface::batch::{Function, map, map_inlined};
use microsurface::elementary as e;

use super::{BUDGET, WorstUlp, single};

/// Numbers taken at a time.
const BLOCK: usize = 1 << 12;
/// All numbers, in blocks.
const BLOCKS: u32 = 1 << 20;

/// The values of a function in f32 and f64 for a block of arguments.
type Values = fn(&[f32], &mut [f32], &[f64], &mut [f64]);

macro_rules! values {
    ($($name:literal, |$x:ident| $value:expr;)*) => {
        &[$(($name, {
            struct F;
            impl Function<f32> for F {
                type Out = f32;
                #[inline(always)]
                fn of(&self, $x: f32) -> f32 {
                    $value
                }
            }
            impl Function<f64> for F {
                type Out = f64;
                #[inline(always)]
                fn of(&self, $x: f64) -> f64 {
                    $value
                }
            }
            |x, y, wide_x, wide_y| {
                map_inlined(x, y, F);
                map_inlined(wide_x, wide_y, F);
            }
        })),*]
    };
}
const VALUES: &[(&str, Values)] = values! {
    "exp", |x| e::exp(x);
    "exp2", |x| e::exp2(x);
    "exp_neg_square", |x| e::exp_neg_square(x);
    "exp_m1", |x| e::exp_m1(x);
    "ln", |x| e::ln(x);
    "log2", |x| e::log2(x);
    "ln_1p", |x| e::ln_1p(x);
    "sin_turns", |x| e::sin_cos_turns(x).0;
    "cos_turns", |x| e::sin_cos_turns(x).1;
    "erf", |x| e::erf(x);
    "erfc", |x| e::erfc(x);
    "erfcx", |x| e::erfcx(x);
    "ierfcx", |x| e::ierfcx(x);
    "erf_inv", |x| e::erf_inv(x);
    "erfc_inv", |x| e::erfc_inv(x);
};

/// The worst of the numbers whose first block is `first`, of `1/stride` of the blocks.
struct Walk {
    x: Vec<f32>,
    y: Vec<f32>,
    wide_x: Vec<f64>,
    wide_y: Vec<f64>,
    error: Vec<f64>,
    worst: WorstUlp,
}

impl Walk {
    fn new() -> Self {
        let wide = || vec![0.0; BLOCK];
        let narrow = || vec![0.0; BLOCK];
        let (x, y, wide_x, wide_y, error) = (narrow(), narrow(), wide(), wide(), wide());
        Self { x, y, wide_x, wide_y, error, worst: WorstUlp::default() }
    }

    fn block(&mut self, block: u32, values: Values) {
        for (x, bits) in self.x.iter_mut().zip(block * BLOCK as u32..) {
            *x = f32::from_bits(bits);
        }
        map(&self.x[..], &mut self.wide_x[..], f64::from);
        values(&self.x, &mut self.y, &self.wide_x, &mut self.wide_y);
        // Vector code for nearly all: the error in ulp; NaN where either value is not finite.
        map((&self.y[..], &self.wide_y[..]), &mut self.error[..], |(got, want)| {
            let ulp =
                f64::from_bits(want.to_bits() & 0x7ff0_0000_0000_0000).max(f64::from(f32::MIN_POSITIVE));
            let infinite = 0.0 * (f64::from(got) + want);
            (f64::from(got) - want).abs() / (ulp * f64::from(f32::EPSILON)) + infinite
        });
        // Whatever is no number or worse than what has been seen is looked at singly.
        let ulp = self.worst.error;
        if self.error.iter().any(|&error| error.is_nan() || error > ulp) {
            for (i, error) in self.error.iter().enumerate() {
                if error.is_nan() || *error > ulp {
                    single(&mut self.worst, (self.x[i], 0.0), self.y[i], self.wide_y[i]);
                }
            }
        }
    }
}

/// The worst of one block in `stride`, on all cores.
fn walk(values: Values, stride: u32) -> WorstUlp {
    let next = AtomicU32::new(0);
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let part = || {
        let mut walk = Walk::new();
        loop {
            let block = next.fetch_add(1, Ordering::Relaxed);
            if block >= BLOCKS / stride {
                return walk.worst;
            }
            walk.block(block * stride, values);
        }
    };
    thread::scope(|scope| {
        let parts: Vec<_> = (0..threads).map(|_| scope.spawn(part)).collect();
        parts.into_iter().map(|part| part.join().expect("no panic")).fold(WorstUlp::default(), WorstUlp::or)
    })
}

#[test]
fn every_function_of_one_argument_is_walked() {
    let walked = |name| VALUES.iter().any(|&(walked, _)| walked == name);
    for budget in BUDGET {
        assert!(walked(budget.name) != matches!(budget.name, "pow" | "atan2"), "{}", budget.name);
    }
    // The short form: every 4096th block.
    for &(name, values) in VALUES {
        let budget = BUDGET.iter().find(|budget| budget.name == name).expect("a budget");
        let worst = walk(values, 4096);
        assert!(worst.error <= budget.f32.0 && worst.error > 0.0, "{name}: {worst:?}");
    }
}

#[test]
#[ignore = "all f32 numbers: eight minutes"]
fn every_f32() {
    let mut failures = Vec::new();
    for &(name, values) in VALUES {
        let budget = BUDGET.iter().find(|budget| budget.name == name).expect("a budget");
        walk(values, 1).check(name, budget.f32, &mut failures);
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
