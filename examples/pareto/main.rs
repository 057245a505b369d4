//! Time per call against worst error: what an approximation saves, and what it costs.
//!
//! ```text
//! cargo run --release --example pareto                      # four minutes
//! cargo run --release --example pareto -- --quick           # coarse grids, rough times
//! cargo run --release --example pareto -- --caption "CPU"   # a line below the charts
//! ```
//!
//! Prints one Markdown table per question and writes it, as CSV and as an SVG chart, to
//! `target/pareto/`. Errors are differences from f64 or 50 digits at the very numbers the function
//! was given, so that the rounding of an argument to f32 is nobody's error:
//! - of masks absolute differences of G1 from the quadrature of [`reference`],
//! - of filters differences of P22 from that of [`filter`]'s as a share of the filtered peak,
//! - of samplers displacements of the normal, in units of √density ([`vndf`]),
//! - of elementary functions ulps ([`elementary`]),
//! - of reflection in batches and of D and σ under maps relative ([`batch`], [`maps`]).
//!
//! Times, of scalar calls and of loops over slices, are medians of rounds in which the alternatives
//! take turns; only their ratios mean anything.

use core::error::Error;
use std::io;

mod batch;
mod beckmann;
mod blocks;
mod chart;
mod elementary;
mod filter;
mod gtr;
mod maps;
mod measure;
mod reference;
mod report;
#[path = "../../benches/bench/textbook.rs"]
#[allow(dead_code, reason = "benchmarks use the rest")]
mod textbook;
mod vndf;

/// How finely errors are searched, and how long times are taken.
pub(crate) struct Effort {
    /// Directions per material.
    pub(crate) angles: u32,
    /// Values of γ per unit.
    pub(crate) gammas: u32,
    /// Pixels per size and shape of a footprint.
    pub(crate) pixels: usize,
    /// Arguments of which the errors of samplers and elementary functions are taken.
    pub(crate) samples: usize,
    /// Rounds of timing.
    pub(crate) rounds: usize,
    /// What stands below the charts.
    pub(crate) caption: String,
}

/// The widths of every question.
pub(crate) const ALPHAS: [f64; 7] = [0.001, 0.01, 0.05, 0.1, 0.2, 0.4, 0.8];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (mut quick, mut caption) = (false, String::new());
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--quick" => quick = true,
            "--caption" => caption = arguments.next().unwrap_or_default(),
            other => return Err(format!("{other}: neither --quick nor --caption").into()),
        }
    }
    let effort = if quick {
        Effort { angles: 120, gammas: 4, pixels: 3, samples: 1 << 14, rounds: 20, caption }
    } else {
        Effort { angles: 600, gammas: 20, pixels: 40, samples: 1 << 20, rounds: 300, caption }
    };
    let mut out = io::stdout().lock();
    reference::validate(&mut out)?;
    beckmann::run(&effort, &mut out)?;
    gtr::run(&effort, &mut out)?;
    filter::run(&effort, &mut out)?;
    vndf::run(&effort, &mut out)?;
    elementary::run(&effort, &mut out)?;
    batch::run(&effort, &mut out)?;
    maps::run(&effort, &mut out)?;
    Ok(())
}
