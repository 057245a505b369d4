//! A Markdown table, the same as CSV, and a chart of both axes.

use core::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use crate::measure::Errors;

/// One alternative.
pub(crate) struct Row {
    name: String,
    ns: f64,
    errors: Errors,
}

impl Row {
    pub(crate) fn new(name: &str, ns: f64, errors: Errors) -> Self {
        Self { name: name.into(), ns, errors }
    }

    fn digits(&self) -> f64 {
        -self.errors.worst.max(1e-17).log10()
    }

    /// No other is both faster and more accurate.
    fn on_frontier(&self, rows: &[Row]) -> bool {
        !rows.iter().any(|other| other.ns < self.ns && other.errors.worst < self.errors.worst)
    }
}

pub(crate) fn report(out: &mut impl Write, file: &str, title: &str, rows: &[Row]) -> io::Result<()> {
    let directory = Path::new("target/pareto");
    std::fs::create_dir_all(directory)?;
    std::fs::write(directory.join(file).with_extension("csv"), csv(rows))?;
    std::fs::write(directory.join(file).with_extension("svg"), chart(title, rows))?;

    writeln!(out, "## {title}\n")?;
    writeln!(
        out,
        "| | ns per call | ratio | worst error | at | RMS | frontier |\n|---|---|---|---|---|---|---|"
    )?;
    for row in rows {
        let Errors { worst, at, .. } = &row.errors;
        let (ratio, rms) = (row.ns / rows[0].ns, row.errors.rms());
        let frontier = if row.on_frontier(rows) { "•" } else { "" };
        writeln!(
            out,
            "| {} | {:.2} | {ratio:.2} | {worst:.2e} | {at} | {rms:.1e} | {frontier} |",
            row.name, row.ns
        )?;
    }
    writeln!(out)
}

fn csv(rows: &[Row]) -> String {
    let mut csv = String::from("name,ns,ratio,worst,at,rms\n");
    for row in rows {
        let Errors { worst, at, .. } = &row.errors;
        let (ratio, rms) = (row.ns / rows[0].ns, row.errors.rms());
        let _ = writeln!(csv, "\"{}\",{:.3},{ratio:.3},{worst:e},\"{at}\",{rms:e}", row.name, row.ns);
    }
    csv
}

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 480.0;
const MARGIN: f64 = 60.0;
/// Correct digits at the top of the chart.
const DIGITS: f64 = 17.0;

/// Correct digits over the logarithm of the time, the frontier drawn through the alternatives on it.
fn chart(title: &str, rows: &[Row]) -> String {
    let times = rows.iter().map(|row| row.ns);
    let fastest = 2_f64.powf(times.clone().fold(f64::INFINITY, f64::min).log2().floor());
    let slowest = 2_f64.powf(times.fold(0.0, f64::max).log2().ceil()).max(2.0 * fastest);
    let x = |ns: f64| MARGIN + (WIDTH - 2.0 * MARGIN) * (ns / fastest).ln() / (slowest / fastest).ln();
    let y = |digits: f64| HEIGHT - MARGIN - (HEIGHT - 2.0 * MARGIN) * digits / DIGITS;
    let (left, right) = (MARGIN, WIDTH - MARGIN);

    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{left}\" y=\"30\" font-size=\"16\">{title}: correct digits over ns per call</text>\n"
    );
    let mut line = |from: (f64, f64), to: (f64, f64), style: &str, label: &str| {
        let ((x1, y1), (x2, y2)) = (from, to);
        let _ = writeln!(svg, "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"gray\" {style}/>");
        let _ =
            writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"gray\">{label}</text>", x1 - 26.0, y1 + 14.0);
    };
    for digits in [0.0, 4.0, 8.0, 12.0, 16.0] {
        line((left, y(digits)), (right, y(digits)), "stroke-opacity=\".3\"", &digits.to_string());
    }
    let mut tick = fastest;
    while tick <= slowest {
        line((x(tick), y(0.0)), (x(tick), y(DIGITS)), "stroke-opacity=\".3\"", &format!("{tick}"));
        tick *= 2.0;
    }
    for (epsilon, label) in [(f64::from(f32::EPSILON), "f32"), (f64::EPSILON, "f64")] {
        let height = y(-epsilon.log10());
        line((left, height), (right, height), "stroke-dasharray=\"6 4\"", label);
    }

    let mut frontier: Vec<&Row> = rows.iter().filter(|row| row.on_frontier(rows)).collect();
    frontier.sort_by(|a, b| a.ns.total_cmp(&b.ns));
    let points: Vec<String> =
        frontier.iter().map(|row| format!("{:.1},{:.1}", x(row.ns), y(row.digits()))).collect();
    let _ = writeln!(svg, "<polyline points=\"{}\" fill=\"none\" stroke=\"crimson\"/>", points.join(" "));
    for row in rows {
        let (cx, cy) = (x(row.ns), y(row.digits()));
        let _ = writeln!(svg, "<circle cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"4\" fill=\"navy\"/>");
        let anchor = if cx > WIDTH * 0.6 { "end" } else { "start" };
        let shift = if cx > WIDTH * 0.6 { -8.0 } else { 8.0 };
        let (tx, ty, name) = (cx + shift, cy + 4.0, &row.name);
        let _ = writeln!(svg, "<text x=\"{tx:.1}\" y=\"{ty:.1}\" text-anchor=\"{anchor}\">{name}</text>");
    }
    svg.push_str("</svg>\n");
    svg
}
