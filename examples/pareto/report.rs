//! A Markdown table, the same as CSV, and a chart of both axes.

use core::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use crate::Effort;
use crate::chart::chart;
use crate::measure::Errors;

/// One alternative.
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) scalar: &'static str,
    /// The range of the parameter that it is made for.
    pub(crate) domain: (f64, f64),
    /// Nanoseconds of a scalar call, and per element of a loop over slices where there is one.
    pub(crate) ns: [Option<f64>; 2],
    pub(crate) errors: Errors,
}

impl Row {
    /// Correct digits: none where there was no number, negative ones of errors above 1.
    pub(crate) fn digits(&self) -> f64 {
        let worst = self.errors.worst;
        if worst.is_nan() { 0.0 } else { -worst.max(1e-17).log10() }
    }

    /// No other of the same scalar that is made for as much is both faster and more accurate.
    pub(crate) fn on_frontier(&self, rows: &[Row], time: usize) -> bool {
        let Some(ns) = self.ns[time] else { return false };
        !rows.iter().any(|other| {
            other.scalar == self.scalar
                && other.domain.0 <= self.domain.0
                && other.domain.1 >= self.domain.1
                && other.ns[time].is_some_and(|other| other < ns)
                && other.errors.worst < self.errors.worst
        })
    }

    /// The first of its scalar, to which times are ratios.
    fn first<'a>(&self, rows: &'a [Row]) -> &'a Row {
        rows.iter().find(|row| row.scalar == self.scalar).unwrap_or(&rows[0])
    }
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
    writeln!(
        out,
        "| | ns per call | ratio | in a loop | ratio | worst error | at | RMS | frontier |\n\
         |---|---|---|---|---|---|---|---|---|"
    )?;
    for row in rows {
        let Errors { worst, at, .. } = &row.errors;
        let (name, scalar, first, rms) = (&row.name, row.scalar, row.first(rows).ns, row.errors.rms());
        let [call, looped] = [0, 1].map(|time| match (row.ns[time], first[time]) {
            (Some(ns), Some(first)) => format!("{ns:.2} | {:.2}", ns / first),
            _ => "– | –".into(),
        });
        let frontier = match [0, 1].map(|time| row.on_frontier(rows, time)) {
            [true, true] => "both",
            [true, false] => "calls",
            [false, true] => "loops",
            [false, false] => "",
        };
        writeln!(
            out,
            "| {name}, {scalar} | {call} | {looped} | {worst:.2e} | {at} | \
             {rms:.1e} | {frontier} |"
        )?;
    }
    writeln!(out)
}

fn csv(rows: &[Row]) -> String {
    let mut csv = String::from("name,scalar,from,to,ns,ns_in_loop,worst,at,rms\n");
    for Row { name, scalar, domain: (from, to), ns, errors } in rows {
        let Errors { worst, at, .. } = errors;
        let [call, looped] = ns.map(|ns| ns.map_or(String::new(), |ns| format!("{ns:.3}")));
        let rms = errors.rms();
        let _ = writeln!(csv, "\"{name}\",{scalar},{from},{to},{call},{looped},{worst:e},\"{at}\",{rms:e}");
    }
    csv
}
