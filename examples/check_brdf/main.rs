//! The test kit on BRDFs as renderers write them: a GGX metal, a clear coat and rough glass, right
//! and with each of eleven mistakes of practice.
//!
//! `cargo run --release --features verify --example check_brdf` prints which check finds which
//! mistake; `-- --report` prints the whole reports, `-- --sensitivity` how small an error each
//! check finds.

mod mistake;
mod sensitivity;
mod textbook;

use std::process::ExitCode;

use microsurface::glam::DVec3;
use microsurface::verify::{Bsdf, Kit, Report};

use mistake::Mistake;
use textbook::{ClearCoat, Glass, Metal};

/// The report of the BRDF that a mistake is made in.
fn report(mistake: Mistake, kit: &Kit) -> Report {
    match mistake {
        Mistake::NoJacobianOfClearCoat => clear_coat(mistake, kit),
        Mistake::HalfVectorNotFlipped | Mistake::InvertedEta => glass(mistake, kit),
        _ => metal(mistake, [0.1, 0.4], kit),
    }
}

fn metal(mistake: Mistake, alpha: [f64; 2], kit: &Kit) -> Report {
    let metal = Metal { alpha, mistake };
    kit.bsdf(&Bsdf::new(
        |wi: DVec3, wo: DVec3| metal.eval(wi, wo),
        |wi, wo| metal.pdf(wi, wo),
        |wo, u: [f64; 2]| metal.sample(wo, u),
    ))
}

fn clear_coat(mistake: Mistake, kit: &Kit) -> Report {
    let coat = ClearCoat { alpha: 0.1, mistake };
    kit.bsdf(
        &Bsdf::new(
            |wi: DVec3, wo: DVec3| coat.eval(wi, wo),
            |wi, wo| coat.pdf(wi, wo),
            |wo, u: [f64; 2]| coat.sample(wo, u),
        )
        .isotropic(),
    )
}

fn glass(mistake: Mistake, kit: &Kit) -> Report {
    let glass = Glass { alpha: 0.3, eta: 1.5, mistake };
    kit.bsdf(
        &Bsdf::new(
            |wi: DVec3, wo: DVec3| glass.eval(wi, wo),
            |wi, wo| glass.pdf(wi, wo),
            |wo, u: [f64; 2]| glass.sample(wo, u),
        )
        .isotropic()
        .transmits(glass.eta),
    )
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let given = |name: &str| arguments.iter().any(|argument| argument == name);
    if let Some(other) =
        arguments.iter().find(|a| !["--report", "--sensitivity", "--quick"].contains(&a.as_str()))
    {
        eprintln!("error: unknown argument {other:?}");
        return ExitCode::from(2);
    }
    let kit = Kit::new().samples(if given("--quick") { 20_000 } else { 100_000 });
    if given("--sensitivity") {
        sensitivity::print(given("--quick"));
        return ExitCode::SUCCESS;
    }
    let (mut not_passed, mut not_found) = (0, 0);
    let right: [(&str, Report); 3] = [
        ("GGX metal", metal(Mistake::None, [0.1, 0.4], &kit)),
        ("clear coat", clear_coat(Mistake::None, &kit)),
        ("rough glass", glass(Mistake::None, &kit)),
    ];
    for (name, report) in &right {
        println!("{name}, right: {}", if report.passed() { "passed" } else { "NOT PASSED" });
        if given("--report") || !report.passed() {
            println!("{report}");
        }
        not_passed += usize::from(!report.passed());
    }
    for mistake in Mistake::ALL {
        let report = report(mistake, &kit);
        let mut names: Vec<&str> = report.failures().map(|check| check.name).collect();
        names.sort_unstable();
        names.dedup();
        println!("\n{}:", mistake.text());
        for name in &names {
            println!("  fails: {name}");
        }
        if given("--report") {
            println!("{report}");
        }
        not_found += usize::from(names.is_empty());
    }
    println!("\n{} of {} mistakes found", Mistake::ALL.len() - not_found, Mistake::ALL.len());
    if not_passed + not_found == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
