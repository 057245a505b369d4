//! Figures 1, 6 and 8 of Atanasov, Koylazov, Dimov and Wilkie 2022, "Microsurface Transformations",
//! rendered with this crate and the tour's path tracer.
//!
//! `cargo run --release --example gallery` writes them to `target/gallery/` in less than a minute
//! and prints what to look for, and three plots: the lobes of the distributions, what sets a
//! transform apart from another width, and how much slopes add to the errors of a filter's
//! derivatives. `-- --quick` makes small pictures of few samples.
//!
//! Where to look: `plate.rs`, `bodies.rs` and `vases.rs` are a figure each, and their covers are
//! all that a renderer has to do at a hit: `surface.transformed(m)`.
#![expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "pixel and cell indices are small, and colours are within 0 … 255"
)]

mod amplification;
mod anisotropy;
mod bodies;
mod inset;
mod lobes;
mod mesh;
mod plate;
mod plot;
mod rubber;
mod scene;
mod sheet;
mod vases;

// The path tracer is the tour's: it asks of `scene` what the tour's own scene gives it.
#[path = "../tour/bvh.rs"]
mod bvh;
#[path = "../tour/camera.rs"]
mod camera;
#[path = "../tour/environment.rs"]
mod environment;
#[path = "../tour/image.rs"]
mod image;
#[path = "../tour/integrator.rs"]
mod integrator;
#[path = "../tour/material.rs"]
mod material;
#[allow(dead_code, reason = "the tour has more metals")]
#[path = "../tour/metals.rs"]
mod metals;
#[path = "../tour/render.rs"]
mod render;
#[path = "../tour/sampler.rs"]
mod sampler;
#[allow(dead_code, reason = "the tour has spheres")]
#[path = "../tour/shape.rs"]
mod shape;

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use crate::sheet::{Effort, Sheet};

const OUTPUT: &str = "target/gallery";

const HELP: &str = "\
Renders figures 1, 6 and 8 of \"Microsurface Transformations\" into target/gallery/.

Usage: cargo run --release --example gallery -- [OPTIONS]

  --quick   small pictures of few samples, for continuous integration
  --help    this text

The exit code is 1 where a material returned NaN, infinite or negative values, 2 for a bad argument.";

fn main() -> ExitCode {
    let mut effort = Effort::FULL;
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--quick" => effort = Effort::QUICK,
            "--help" | "-h" => {
                println!("{HELP}");
                return ExitCode::SUCCESS;
            }
            other => {
                eprintln!("error: unknown argument {other:?}\n\n{HELP}");
                return ExitCode::from(2);
            }
        }
    }
    match gallery(effort) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}

/// Renders the figures and says what to look for.
fn gallery(effort: Effort) -> Result<(), String> {
    std::fs::create_dir_all(OUTPUT).map_err(|error| format!("cannot create {OUTPUT}: {error}"))?;
    let figures = [
        ("plate", plate::figure as fn(Effort) -> Result<Sheet, microsurface::Error>, plate::LOOK_FOR),
        ("bodies", bodies::figure, bodies::LOOK_FOR),
        ("vases", vases::figure, vases::LOOK_FOR),
    ];
    for (name, figure, look_for) in figures {
        let start = Instant::now();
        let sheet = figure(effort).map_err(|error| error.to_string())?;
        let path = Path::new(OUTPUT).join(name).with_extension("png");
        let image = sheet.joined();
        image.write_png(&path)?;
        println!(
            "{}: {}x{}, {:.1} s\n{look_for}\n",
            path.display(),
            image.width,
            image.height,
            start.elapsed().as_secs_f64()
        );
        if !sheet.faults.none() {
            return Err(format!(
                "a material of {name} returned numbers that it should not: {:?}",
                sheet.faults
            ));
        }
    }
    let anisotropy = anisotropy::plot().map_err(|error| error.to_string())?;
    let lobes = lobes::plot().map_err(|error| error.to_string())?;
    for (name, plot, look_for) in [
        ("anisotropy", anisotropy, anisotropy::LOOK_FOR),
        ("lobes", lobes, lobes::LOOK_FOR),
        ("error_amplification", amplification::plot(), amplification::LOOK_FOR),
    ] {
        let path = Path::new(OUTPUT).join(name).with_extension("svg");
        std::fs::write(&path, plot).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        println!("{}:\n{look_for}\n", path.display());
    }
    Ok(())
}
