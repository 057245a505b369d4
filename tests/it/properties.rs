//! Properties that hold at every argument, over strategies biased to the hard cases; one body for
//! both scalars.
//!
//! Seeds are fixed, so that a run can be repeated; `PROPTEST_RNG_SEED=… PROPTEST_CASES=…` explores
//! further. Failing seeds go to `tests/it/proptest-regressions` and stay there.

use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, RngSeed, TestCaseError, TestRunner};

use crate::rows::{Distribution, Mask};
use crate::scalar::Scalar;
use crate::surfaces::{Shape, Spec};

mod evaluation;
mod frames;
mod maps;
mod sampling;

/// Tests of the same names for both scalars.
macro_rules! for_both_scalars {
    ($($name:ident)*) => {
        mod f32 { $(#[test] fn $name() { super::$name::<f32>(); })* }
        mod f64 { $(#[test] fn $name() { super::$name::<f64>(); })* }
    };
}
use for_both_scalars;

type Outcome = Result<(), TestCaseError>;

/// Runs `property` over `cases` values of `strategy`, or as many as `PROPTEST_CASES` says.
fn check<S: Strategy>(cases: u32, strategy: S, property: impl Fn(S::Value) -> Outcome) {
    let mut config = ProptestConfig::default();
    if std::env::var_os("PROPTEST_CASES").is_none() {
        config.cases = cases;
    }
    if config.rng_seed == RngSeed::Random {
        config.rng_seed = RngSeed::Fixed(0x6d69_6372_6f73);
    }
    config.failure_persistence =
        Some(Box::new(FileFailurePersistence::Direct("tests/it/proptest-regressions/properties.txt")));
    config.source_file = Some(file!());
    (config.max_global_rejects, config.max_local_rejects) = (50 * config.cases, 50 * config.cases);
    if let Err(error) = TestRunner::new(config).run(&strategy, property) {
        panic!("{error}");
    }
}

/// Both are equal to `roundings` ε, or both are too small to have all their digits.
fn near<T: Scalar>(name: &str, a: T, b: T, roundings: f64) -> Outcome {
    let (x, y) = (a.to_f64(), b.to_f64());
    let tiny = 64.0 * T::MIN_POSITIVE.to_f64();
    let close = x == y || (x - y).abs() <= roundings * T::EPSILON.to_f64() * x.abs().max(y.abs());
    prop_assert!(
        close || (x.abs() <= tiny && y.abs() <= tiny),
        "{name}: {} and {} differ by {:.1} of {roundings:.1} roundings",
        a.hex(),
        b.hex(),
        (x - y).abs() / (T::EPSILON.to_f64() * x.abs().max(y.abs()))
    );
    Ok(())
}

/// How many roundings D changes by when every component of a normal changes by one relative
/// rounding and by `absolute` further ones of 1: the conditioning of D, from the surface's
/// parameters.
fn roundings_of_d(spec: &Spec, m: [f64; 3], absolute: f64) -> f64 {
    let [[a, b], [c, d]] = spec.factor::<f64>();
    let det = a * d - b * c;
    // p = F⁻¹ (−m_xy)/m.z; the change of m.z acts as a relative change of all of p.
    let p = [(d * m[0] - c * m[1]) / (det * m[2]), (a * m[1] - b * m[0]) / (det * m[2])];
    let change = [m[0].abs() + absolute, m[1].abs() + absolute];
    let moved = [
        (d.abs() * change[0] + c.abs() * change[1]) / (det.abs() * m[2]),
        (a.abs() * change[1] + b.abs() * change[0]) / (det.abs() * m[2]),
    ];
    let q = p[0] * p[0] + p[1] * p[1];
    let z = 1.0 + absolute / m[2];
    let dq =
        2.0 * (p[0].abs() * moved[0] + p[1].abs() * moved[1] + q * z) + absolute * moved[0].hypot(moved[1]);
    let Distribution { row, alpha, gamma } = spec.distribution();
    let [fixed, by_gamma] = row.columns().roundings;
    if gamma == f64::INFINITY {
        return fixed * z + dq;
    }
    (fixed + by_gamma * gamma) * z + gamma * dq / (alpha * alpha + q) + (gamma - 2.0).abs() * dq / (1.0 + q)
}

/// How many roundings σ by one route is from σ by another: the sum over the nodes of a mixture has
/// more.
fn roundings_of_sigma(spec: &Spec) -> f64 {
    let sum = spec.mask() == Mask::Nodes || matches!(spec.shape, Shape::Filtered { .. });
    if sum { 8.0 } else { 3.0 }
}

/// How far rounding turns the stored map, in roundings of q: about half the ratio of its principal
/// widths.
pub(crate) fn skewness(spec: &Spec) -> f64 {
    let [[a, b], [c, d]] = spec.factor::<f64>();
    let det = (a * d - b * c).abs();
    (a.abs() * d.abs() + b.abs() * c.abs()).max(0.5 * (a * a + b * b + c * c + d * d)) / det
}
