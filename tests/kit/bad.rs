//! Subjects that misbehave are reported, and nothing hangs.

use microsurface::glam::DVec3;
use microsurface::verify::{Bsdf, Kit, Report, Verdict};

const FINITE: &str = "f and pdf finite and not negative";

fn report(
    eval: impl Fn(DVec3, DVec3) -> f64,
    pdf: impl Fn(DVec3, DVec3) -> f64,
    sample: impl Fn(DVec3, [f64; 2]) -> Option<(DVec3, f64, f64)>,
) -> Report {
    Kit::new().samples(5000).bsdf(&Bsdf::new(eval, pdf, sample))
}

fn failed(report: &Report, name: &str) -> bool {
    report.checks.iter().any(|check| check.name == name && check.verdict == Verdict::Failed)
}

const UP: Option<(DVec3, f64, f64)> = Some((DVec3::Z, 1.0, 1.0));

#[test]
fn nan_and_negative_values_are_reported() {
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert!(failed(&report(|_, _| bad, |_, _| 1.0, |_, _| UP), FINITE), "{bad}");
        assert!(failed(&report(|_, _| 1.0, |_, _| bad, |_, _| UP), FINITE), "{bad}");
        let sampled = report(|_, _| 1.0, |_, _| 1.0, |_, _| Some((DVec3::splat(bad), bad, bad)));
        assert!(failed(&sampled, "every sample usable"), "{bad}");
        assert!(failed(&sampled, "samples: unit vectors with a pdf"), "{bad}");
    }
}

#[test]
fn panics_are_reported() {
    let fault = |_, _| -> f64 { panic!("a renderer's assertion") };
    for report in [
        report(fault, |_, _| 1.0, |_, _| UP),
        report(|_, _| 1.0, fault, |_, _| UP),
        report(|_, _| 1.0, |_, _| 1.0, |_, _| panic!("another")),
    ] {
        let check = report.check("no panic").unwrap();
        assert!(check.verdict == Verdict::Failed && check.at.contains("panicked at"), "{report}");
    }
}

#[test]
fn samplers_that_never_sample_are_reported() {
    let black = report(|_, _| 0.0, |_, _| 0.0, |_, _| None);
    // Of nothing there is nothing to compare: it says so.
    assert!(
        !black.passed() && black.checks.iter().any(|check| check.verdict == Verdict::Undecided),
        "{black}"
    );
    let cosine = |wi: DVec3, _: DVec3| wi.z.max(0.0) / core::f64::consts::PI;
    let never = report(|_, _| 0.3, cosine, |_, _| None);
    assert!(failed(&never, "∫ pdf = the share of samples that are"), "{never}");
}

#[test]
fn a_constant_direction_has_no_density() {
    let report = report(|_, _| 0.3, |wi, _| wi.z.max(0.0) / core::f64::consts::PI, |_, _| UP);
    assert!(failed(&report, "sample against pdf, χ²"), "{report}");
}

#[test]
#[should_panic(expected = "FAILED")]
fn assert_panics_with_the_table() {
    report(|_, _| f64::NAN, |_, _| 1.0, |_, _| UP).assert();
}

/// The precision that would be needed cannot be had: the kit does not say passed.
#[test]
fn what_cannot_be_integrated_is_undecided() {
    // A density of a million stripes.
    let stripes = |wi: DVec3| if (1e6 * wi.x).sin() > 0.0 { 2.0 } else { 0.0 };
    let pdf = |wi: DVec3, _: DVec3| stripes(wi) * wi.z.max(0.0) / core::f64::consts::PI;
    let sample = |_: DVec3, u: [f64; 2]| {
        let (r, (sin, cos)) = (u[0].sqrt(), (core::f64::consts::TAU * u[1]).sin_cos());
        let wi = DVec3::new(r * cos, r * sin, (1.0 - u[0]).sqrt());
        (stripes(wi) > 0.0).then_some((wi, 1.0, 1.0))
    };
    let report = report(|_, _| 0.3, pdf, sample);
    let check = report.check("sample against pdf, χ²").unwrap();
    assert_eq!(check.verdict, Verdict::Undecided, "{report}");
    assert!(!report.passed());
}
