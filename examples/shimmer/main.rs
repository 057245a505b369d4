//! Specular antialiasing on scenes whose highlights are smaller than pixels: what the filters of
//! this crate make of one sample per pixel, measured against a reference of many.
//!
//! `cargo run --release --example shimmer` prints a table for each scene and material and writes
//! pictures to `target/shimmer/` in about two minutes; `-- --quick` makes small ones of few
//! samples.
//!
//! Where to look: `methods.rs` has every method in a few lines, from what a renderer knows of a
//! pixel (`pixel.rs`) to its radiance. The scenes are `water.rs`, after Kaplanyan et al. 2016,
//! Figs. 2 and 6, and `pebble.rs`.
#![expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "pixel indices are small, and colours are within 0 … 255"
)]

mod claims;
mod effort;
mod errors;
mod flicker;
#[path = "../tour/image.rs"]
mod image;
mod materials;
mod methods;
mod pebble;
mod picture;
mod pixel;
mod report;
mod rows;
mod sampled;
mod scene;
mod sheet;
mod study;
mod timing;
mod water;
mod waves;

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use crate::effort::Effort;
use crate::study::Study;

const OUTPUT: &str = "target/shimmer";

const HELP: &str = "\
Measures filters of highlights against a reference of many samples per pixel, on two scenes with two materials.

Usage: cargo run --release --example shimmer -- [OPTIONS]

  --quick   small pictures of few samples, for continuous integration
  --help    this text

Pictures and a table of all numbers are written to target/shimmer/. The exit code is 1 where a claim does not hold, 2 for
a bad argument.";

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
    match shimmer(effort) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => {
            eprintln!("error: a claim does not hold");
            ExitCode::FAILURE
        }
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}

/// Renders, prints and writes everything. Returns whether all claims hold.
fn shimmer(effort: Effort) -> Result<bool, String> {
    std::fs::create_dir_all(OUTPUT).map_err(|error| format!("cannot create {OUTPUT}: {error}"))?;
    report::print_legend();
    let start = Instant::now();
    let mut studies = Vec::new();
    for scene in [water::scene(), pebble::scene()] {
        for study in study::study(&scene, effort).map_err(|error| error.to_string())? {
            write_pictures(&study)?;
            report::print(&study);
            studies.push(study);
        }
    }
    let path = Path::new(OUTPUT).join("shimmer.csv");
    std::fs::write(&path, report::csv(&studies))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    println!(
        "\n{OUTPUT}/SCENE-MATERIAL.png: the reference, number 0, and the methods by their numbers in the table;\n\
         -highlights.png and -grazing.png: parts of them, enlarged; -selected.png: the reference, then unfiltered, A + 2Σ,\n\
         projected, GGX * Gaussian and the parallelogram; shimmer.csv: all numbers. {:.0} s\n",
        start.elapsed().as_secs_f64()
    );
    Ok(claims::check(&studies))
}

fn write_pictures(study: &Study) -> Result<(), String> {
    let path = |kind: &str| {
        let name = format!("{}-{}{kind}.png", study.scene, study.material.to_lowercase());
        Path::new(OUTPUT).join(name)
    };
    sheet::whole(study).write_png(&path(""))?;
    let [highlights, grazing] = study.crops;
    sheet::crop(study, highlights).write_png(&path("-highlights"))?;
    sheet::crop(study, grazing).write_png(&path("-grazing"))?;
    if study.material == "GGX" {
        sheet::selected(study, methods::SELECTED).write_png(&path("-selected"))?;
    }
    Ok(())
}
