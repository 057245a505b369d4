//! GGX filtered: means over the parallelogram of a footprint, and convolutions with Gaussians.
//!
//! Errors are differences of P22 as a share of its peak after filtering with the same kernel: what
//! a picture shows, in which that peak is the brightest. Every call makes its filter, as a pixel
//! must, from its footprint or its covariance. Times are of neighbours that are unlike, which
//! branches do not foresee; those of a picture are alike, and faster.

use std::io::{self, Write};

use microsurface::{Ggx, Isotropic, Microsurface};

use crate::Effort;
use crate::measure::{Errors, Run, calls_of, times};
use crate::report::{Row, report};

mod appendix;
mod gaussians;
mod means;
mod reference;

type Surface = Microsurface<Ggx, Isotropic<f32>>;

/// The widths: the closed form of the paper has an absolute limit, so that one would not do.
const ALPHAS: [f64; 2] = [0.01, 0.1];

/// One call, and what is right.
#[derive(Clone, Copy)]
struct Case<P> {
    pixel: P,
    exact: f64,
    /// The peak of the filtered surface.
    peak: f64,
    /// By which the tables of errors are grouped: an index.
    size: usize,
    shape: usize,
}

/// A filter: its errors in every case, and its time.
struct Alternative {
    name: &'static str,
    errors: Vec<f64>,
    run: Run,
}

impl Alternative {
    fn new<P: Copy + 'static>(
        name: &'static str,
        cases: &[Case<P>],
        filter: impl Fn(&P) -> f32 + 'static,
    ) -> Self {
        let error = |case: &Case<P>| (f64::from(filter(&case.pixel)) - case.exact) / case.peak;
        let errors = cases.iter().map(error).collect();
        // Few enough to stay in a first-level cache.
        let stride = cases.len().div_ceil(512);
        let pixels = cases.iter().step_by(stride).map(|case| case.pixel).collect();
        Self { name, errors, run: calls_of(pixels, filter) }
    }
}

/// What is asked.
struct Question<'a> {
    file: &'a str,
    title: &'a str,
    /// In units of α.
    sizes: &'a [f32],
    shapes: &'a [&'a str],
}

impl Question<'_> {
    /// Reports alternatives, and their worst errors by size and by shape.
    fn answer<P>(
        &self,
        effort: &Effort,
        out: &mut impl Write,
        cases: &[Case<P>],
        describe: impl Fn(&P) -> String,
        alternatives: Vec<Alternative>,
    ) -> io::Result<()> {
        let (mut rows, mut runs, mut all) = (Vec::new(), Vec::new(), Vec::new());
        for Alternative { name, errors, run } in alternatives {
            let mut total = Errors::default();
            for (case, error) in cases.iter().zip(&errors) {
                total.add(*error, || describe(&case.pixel));
            }
            rows.push(Row { name: name.into(), scalar: "f32", errors: total, ..Row::default() });
            runs.push(run);
            all.push((name, errors));
        }
        for (row, ns) in rows.iter_mut().zip(times(&mut runs, effort.rounds)) {
            row.ns[0] = Some(ns);
        }
        report(out, effort, self.file, self.title, &rows)?;
        let by_size: fn(&Case<P>) -> usize = |case| case.size;
        let by_shape: fn(&Case<P>) -> usize = |case| case.shape;
        let sizes = self.sizes.iter().map(|size| format!("{size} α")).collect();
        let shapes: Vec<String> = self.shapes.iter().map(ToString::to_string).collect();
        for (what, columns, group) in [("size", sizes, by_size), ("shape", shapes, by_shape)] {
            writeln!(out, "Worst errors by {what}:\n\n| | {} |", columns.join(" | "))?;
            writeln!(out, "|---{}|", "|---".repeat(columns.len()))?;
            for (name, errors) in &all {
                write!(out, "| {name} |")?;
                for column in 0..columns.len() {
                    let of_column = cases.iter().zip(errors).filter(|(case, _)| group(case) == column);
                    let worst = of_column.fold(0.0_f64, |worst, (_, error)| worst.max(error.abs()));
                    write!(out, " {worst:.1e} |")?;
                }
                writeln!(out)?;
            }
            writeln!(out)?;
        }
        Ok(())
    }
}

/// Puts neighbours far apart.
fn shuffled<P>(cases: Vec<Case<P>>) -> Vec<Case<P>> {
    let mut keyed: Vec<_> = cases.into_iter().zip((0_u32..).map(|i| i.wrapping_mul(0x9e37_79b1))).collect();
    keyed.sort_by_key(|&(_, key)| key);
    keyed.into_iter().map(|(case, _)| case).collect()
}

pub(crate) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    reference::validate(out)?;
    means::run(effort, out)?;
    gaussians::run(effort, out)
}
