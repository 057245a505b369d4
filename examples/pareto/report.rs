//! A Markdown table, the same as CSV, and a chart of both axes.

use core::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use crate::Effort;
use crate::chart::chart;
use crate::measure::Errors;

/// One alternative.
#[derive(Default)]
pub(crate) struct Row {
    /// What it is an alternative in, where one table has several such questions.
    pub(crate) group: String,
    pub(crate) name: String,
    pub(crate) scalar: &'static str,
    /// The range of the parameter that it is made for.
    pub(crate) domain: (f64, f64),
    /// Nanoseconds of a scalar call, and per element of a loop over slices where there is one.
    pub(crate) ns: [Option<f64>; 2],
    pub(crate) errors: Errors,
    /// Errors are counted in ulp.
    pub(crate) in_ulp: bool,
}

impl Row {
    /// Correct digits: none where there was no finite number, negative ones of errors above 1.
    pub(crate) fn digits(&self) -> f64 {
        let worst = if self.in_ulp { self.errors.worst * epsilon(self.scalar) } else { self.errors.worst };
        if worst.is_finite() { -worst.max(1e-17).log10() } else { 0.0 }
    }

    /// No other of the same question that is made for as much is both faster and more accurate.
    pub(crate) fn on_frontier(&self, rows: &[Row], time: usize) -> bool {
        let Some(ns) = self.ns[time].filter(|_| self.errors.known() && self.errors.worst.is_finite()) else {
            return false;
        };
        !rows.iter().any(|other| {
            other.question() == self.question()
                && other.domain.0 <= self.domain.0
                && other.domain.1 >= self.domain.1
                && other.ns[time].is_some_and(|other| other < ns)
                && other.errors.worst < self.errors.worst
        })
    }

    /// Only alternatives in the same are compared.
    pub(crate) fn question(&self) -> (&str, &str) {
        (&self.group, self.scalar)
    }

    /// The first of its question that has such a time, to which times are ratios.
    fn first(&self, rows: &[Row], time: usize) -> Option<f64> {
        rows.iter().filter(|row| row.question() == self.question()).find_map(|row| row.ns[time])
    }
}

/// ε of a scalar by its name.
pub(crate) fn epsilon(scalar: &str) -> f64 {
    if scalar == "f64" { f64::EPSILON } else { f32::EPSILON.into() }
}

pub(crate) fn report(
    out: &mut impl Write,
    effort: &Effort,
    file: &str,
    title: &str,
    rows: &[Row],
) -> io::Result<()> {
    let directory = Path::new("target/pareto");
    std::fs::create_dir_all(directory)?;
    std::fs::write(directory.join(file).with_extension("csv"), csv(rows))?;
    std::fs::write(directory.join(file).with_extension("svg"), chart(title, &effort.caption, rows))?;

    writeln!(out, "## {title}\n")?;
    let ulp = if rows.iter().any(|row| row.in_ulp) { ", ulp" } else { "" };
    writeln!(
        out,
        "| | ns per call | ratio | in a loop | ratio | worst error{ulp} | at | RMS | frontier |\n\
         |---|---|---|---|---|---|---|---|---|"
    )?;
    for row in rows {
        let (name, scalar) = (&row.name, row.scalar);
        let group = if row.group.is_empty() { String::new() } else { format!("{}: ", row.group) };
        let [call, looped] = [0, 1].map(|time| match (row.ns[time], row.first(rows, time)) {
            (Some(ns), Some(first)) => format!("{ns:.2} | {:.2}", ns / first),
            _ => "– | –".into(),
        });
        let errors = match &row.errors {
            errors if !errors.known() => "– | – | –".into(),
            errors if row.in_ulp && errors.worst < 1e4 => {
                format!("{:.2} | {} | {:.2}", errors.worst, errors.at, errors.rms())
            }
            errors => format!("{:.2e} | {} | {:.1e}", errors.worst, errors.at, errors.rms()),
        };
        let frontier = match [0, 1].map(|time| row.on_frontier(rows, time)) {
            [true, true] => "both",
            [true, false] => "calls",
            [false, true] => "loops",
            [false, false] => "",
        };
        writeln!(out, "| {group}{name}, {scalar} | {call} | {looped} | {errors} | {frontier} |")?;
    }
    writeln!(out)
}

fn csv(rows: &[Row]) -> String {
    let mut csv = String::from("group,name,scalar,from,to,ns,ns_in_loop,worst,at,rms\n");
    for Row { group, name, scalar, domain: (from, to), ns, errors, .. } in rows {
        let [call, looped] = ns.map(|ns| ns.map_or(String::new(), |ns| format!("{ns:.3}")));
        let _ = write!(csv, "\"{group}\",\"{name}\",{scalar},{from},{to},{call},{looped},");
        let _ = match errors {
            Errors { worst, at, .. } if errors.known() => {
                writeln!(csv, "{worst:e},\"{at}\",{:e}", errors.rms())
            }
            _ => writeln!(csv, ",,"),
        };
    }
    csv
}
