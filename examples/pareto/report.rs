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
    /// Nanoseconds of a scalar call, and per element of a loop over slices.
    pub(crate) ns: [f64; 2],
    pub(crate) errors: Errors,
}

impl Row {
    /// Correct digits.
    pub(crate) fn digits(&self) -> f64 {
        -self.errors.worst.max(1e-17).log10()
    }

    /// No other of the same scalar that is made for as much is both faster and more accurate.
    pub(crate) fn on_frontier(&self, rows: &[Row], time: usize) -> bool {
        !rows.iter().any(|other| {
            other.scalar == self.scalar
                && other.domain.0 <= self.domain.0
                && other.domain.1 >= self.domain.1
                && other.ns[time] < self.ns[time]
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
        let (name, scalar, [call, looped], first) = (&row.name, row.scalar, row.ns, row.first(rows).ns);
        let (ratio, loop_ratio, rms) = (call / first[0], looped / first[1], row.errors.rms());
        let frontier = match [0, 1].map(|time| row.on_frontier(rows, time)) {
            [true, true] => "both",
            [true, false] => "calls",
            [false, true] => "loops",
            [false, false] => "",
        };
        writeln!(
            out,
            "| {name}, {scalar} | {call:.2} | {ratio:.2} | {looped:.2} | {loop_ratio:.2} | {worst:.2e} | {at} | \
             {rms:.1e} | {frontier} |"
        )?;
    }
    writeln!(out)
}

fn csv(rows: &[Row]) -> String {
    let mut csv = String::from("name,scalar,from,to,ns,ns_in_loop,worst,at,rms\n");
    for Row { name, scalar, domain: (from, to), ns: [call, looped], errors } in rows {
        let Errors { worst, at, .. } = errors;
        let rms = errors.rms();
        let _ =
            writeln!(csv, "\"{name}\",{scalar},{from},{to},{call:.3},{looped:.3},{worst:e},\"{at}\",{rms:e}");
    }
    csv
}
