//! The test kit on the crate's own distributions and BSDFs, and what each of its checks must
//! reject.
#![expect(clippy::unwrap_used, reason = "a surface that cannot be built is a failed test")]

mod bad;
mod brdfs;
mod distributions;
mod faults;
#[path = "../surfaces/mod.rs"]
#[expect(dead_code, reason = "not every crate reads every column")]
mod rows;

use microsurface::verify::{Report, Verdict};

/// The report has failed at least one of these checks.
fn assert_rejected(what: &str, report: &Report, names: &[&str]) {
    let found = |name: &&str| {
        report.checks.iter().any(|check| check.name == *name && check.verdict == Verdict::Failed)
    };
    assert!(names.iter().all(found), "{what}: not all of {names:?} have failed\n{report}");
}
