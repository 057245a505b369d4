//! A tour of the crate: a small path tracer that uses its public interface only.
//!
//! `cargo run --release --example tour` renders spheres of many microsurfaces into `target/tour/`
//! and prints what each reflects, checked by its own sampler against a quadrature. `-- --help`
//! lists the options; one of them, `--compare-sampling`, measures the noise of GTR by three
//! samplings instead.
//!
//! Where to look: `material.rs` is all that a renderer needs from a BSDF and `picture.rs` builds
//! the materials; `integrator.rs` is where they are evaluated and sampled.
#![expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "pixel and cell indices are small, and colours are within 0 … 255"
)]

mod args;
mod bvh;
mod camera;
mod comparison;
mod environment;
mod furnace;
mod image;
mod integrator;
mod material;
mod mesh;
mod metals;
mod picture;
mod render;
mod report;
mod sampler;
mod scene;
mod shape;

use std::io::{IsTerminal, stderr};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use microsurface::glam::Vec3;

use crate::args::{Command, Options, Subject};
use crate::camera::Camera;
use crate::comparison::Comparison;
use crate::environment::Environment;
use crate::material::Material;
use crate::picture::Picture;
use crate::report::Verdict;
use crate::scene::Scene;

const OUTPUT: &str = "target/tour";

fn main() -> ExitCode {
    let options = match args::parse(std::env::args().skip(1)) {
        Ok(Command::Help) => {
            println!("{}", args::HELP);
            return ExitCode::SUCCESS;
        }
        Ok(Command::Render(options)) => options,
        Err(problem) => {
            eprintln!("error: {problem}\n\n{}", args::HELP);
            return ExitCode::from(2);
        }
    };
    let checked = match options.subject {
        Subject::Samplings => compare(&options),
        Subject::Spheres | Subject::Mesh(_) => tour(&options),
    };
    match checked {
        Ok(failures) if failures.is_empty() => ExitCode::SUCCESS,
        Ok(failures) => {
            eprintln!("error: {}", failures.join("\nerror: "));
            ExitCode::FAILURE
        }
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}

/// Renders the pictures and prints the table. Returns what was wrong.
fn tour(options: &Options) -> Result<Vec<String>, String> {
    let describe = |error: microsurface::Error| error.to_string();
    let pictures = match options.subject {
        Subject::Mesh(_) => vec![picture::mesh().map_err(describe)?],
        _ => [picture::tails(), picture::brushed(), picture::metals()]
            .into_iter()
            .collect::<Result<_, _>>()
            .map_err(describe)?,
    };
    create_output()?;

    let mut verdict = Verdict::default();
    let environment = Environment::studio();
    for picture in &pictures {
        render_picture(picture, &environment, options, &mut verdict)?;
    }
    println!();
    report::print_legend();
    for picture in &pictures {
        report::print_table(picture, options.furnace_samples, &mut verdict);
    }
    report::print_reference(&mut verdict).map_err(describe)?;
    Ok(concluded(verdict))
}

/// Compares samplings of GTR. Returns what was wrong.
fn compare(options: &Options) -> Result<Vec<String>, String> {
    create_output()?;
    let size = size(options);
    let mut verdict = Verdict::default();
    let progress = progress_bar("samplings", size[1]);
    let start = Instant::now();
    let comparison = Comparison::new(&Environment::studio(), size, options.samples, &progress, &mut verdict)
        .map_err(|error| error.to_string())?;
    progress.finish_and_clear();
    for (name, image) in comparison.images() {
        image.write_png(&Path::new(OUTPUT).join(name).with_extension("png"))?;
    }
    println!(
        "{OUTPUT}/sampling-*.png: {}x{}, {} samples, {:.2} s",
        size[0],
        size[1],
        options.samples,
        start.elapsed().as_secs_f64()
    );
    comparison.print(&mut verdict);
    Ok(concluded(verdict))
}

/// Prints what the checks found. Returns what was wrong.
fn concluded(mut verdict: Verdict) -> Vec<String> {
    let faults = verdict.faults;
    println!(
        "Of {} values checked {} are NaN, {} infinite, {} negative",
        faults.checked, faults.nan, faults.infinite, faults.negative
    );
    if !faults.none() {
        verdict.failures.push("a material returned NaN, infinite or negative values".to_owned());
    }
    verdict.failures
}

fn create_output() -> Result<(), String> {
    std::fs::create_dir_all(OUTPUT).map_err(|error| format!("cannot create {OUTPUT}: {error}"))
}

/// Width and height of the pictures.
fn size(options: &Options) -> [u32; 2] {
    [options.width, options.width * 9 / 16]
}

fn render_picture(
    picture: &Picture,
    environment: &Environment,
    options: &Options,
    verdict: &mut Verdict,
) -> Result<(), String> {
    let start = Instant::now();
    let size = size(options);
    let (shapes, camera) = match &options.subject {
        Subject::Mesh(path) => {
            let (shapes, height) = mesh::load(path, 0)?;
            (shapes, Camera::new(Vec3::Y * (0.5 * height), 12.0, 0.42, 2.8))
        }
        _ => scene::spheres([picture.rows.len(), picture.rows[0].len()]),
    };
    let materials: Vec<&dyn Material> = picture.rows.iter().flatten().map(|entry| &*entry.material).collect();
    let scene = Scene::new(camera, environment, shapes, materials);

    let progress = progress_bar(picture.name, size[1]);
    let (image, faults) = render::render(&scene, size, options.samples, &progress);
    progress.finish_and_clear();
    verdict.faults += faults;

    let path = Path::new(OUTPUT).join(picture.name).with_extension("png");
    image.write_png(&path)?;
    let seconds = start.elapsed().as_secs_f64();
    let paths = f64::from(size[0]) * f64::from(size[1]) * f64::from(options.samples);
    println!(
        "{}: {}x{}, {} paths per pixel, {seconds:.2} s, {:.2} million paths/s",
        path.display(),
        size[0],
        size[1],
        options.samples,
        paths / seconds * 1e-6
    );
    Ok(())
}

/// A bar on a terminal, a line elsewhere.
fn progress_bar(name: &str, rows: u32) -> ProgressBar {
    if !stderr().is_terminal() {
        eprintln!("rendering {name} …");
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{msg:10} {wide_bar} {percent:>3} %, {eta} left");
    ProgressBar::new(u64::from(rows))
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_message(name.to_owned())
}
