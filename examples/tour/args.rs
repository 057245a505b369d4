//! The command line.

use std::path::PathBuf;

pub(crate) const HELP: &str = "\
Renders spheres of many microsurfaces and checks their numbers.

Usage: cargo run --release --example tour -- [OPTIONS]

  --quick          small pictures of few samples, for continuous integration
  --width N        width of the pictures in pixels, 16 to 8192 (512; 240 with --quick)
  --samples N      paths per pixel, 1 to 65536; powers of two spread best (16; 4 with --quick)
  --mesh FILE.obj  one picture of this mesh instead of the spheres
  --compare-sampling
                   instead, the noise of GTR sampled by visible normals, by all normals and by a mixture of all
                   normals and uniform directions; at least 2 samples (256; 16 with --quick)
  --help           this text

Pictures are written to target/tour/. The exit code is 1 where a number is wrong, 2 for a bad argument.";

/// What to do.
#[derive(Debug, PartialEq)]
pub(crate) enum Command {
    Help,
    Render(Options),
}

/// What the pictures are of.
#[derive(Debug, PartialEq)]
pub(crate) enum Subject {
    /// Spheres of many materials.
    Spheres,
    Mesh(PathBuf),
    /// Spheres of GTR, by several samplings.
    Samplings,
}

#[derive(Debug, PartialEq)]
pub(crate) struct Options {
    pub(crate) width: u32,
    /// Paths per pixel.
    pub(crate) samples: u32,
    /// Samples of a material from each of the table's directions.
    pub(crate) furnace_samples: u32,
    pub(crate) subject: Subject,
}

/// The command of these arguments, the program's name left out.
pub(crate) fn parse(mut args: impl Iterator<Item = String>) -> Result<Command, String> {
    let (mut quick, mut width, mut samples, mut mesh, mut compare) = (false, None, None, None, false);
    while let Some(arg) = args.next() {
        let mut value = || args.next().ok_or_else(|| format!("{arg} needs a value"));
        match arg.as_str() {
            "--help" | "-h" => return Ok(Command::Help),
            "--quick" => quick = true,
            "--width" => width = Some(number("--width", &value()?, 16, 8192)?),
            "--samples" => samples = Some(number("--samples", &value()?, 1, 65536)?),
            "--mesh" => mesh = Some(PathBuf::from(value()?)),
            "--compare-sampling" => compare = true,
            other => return Err(format!("unknown argument {other:?}")),
        }
    }
    let (default_width, mut default_samples, furnace_samples) =
        if quick { (240, 4, 1 << 12) } else { (512, 16, 1 << 14) };
    let subject = match (mesh, compare) {
        (None, false) => Subject::Spheres,
        (Some(path), false) => Subject::Mesh(path),
        (None, true) => Subject::Samplings,
        (Some(_), true) => return Err("--compare-sampling has no --mesh".to_owned()),
    };
    if compare {
        default_samples = if quick { 16 } else { 256 };
        if samples == Some(1) {
            return Err("--compare-sampling needs 2 samples".to_owned());
        }
    }
    Ok(Command::Render(Options {
        width: width.unwrap_or(default_width),
        samples: samples.unwrap_or(default_samples),
        furnace_samples,
        subject,
    }))
}

fn number(name: &str, text: &str, smallest: u32, largest: u32) -> Result<u32, String> {
    match text.parse() {
        Ok(value) if (smallest..=largest).contains(&value) => Ok(value),
        _ => Err(format!("{name} {text:?} is not a whole number from {smallest} to {largest}")),
    }
}
