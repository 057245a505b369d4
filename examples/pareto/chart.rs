//! Correct digits over the logarithm of the time, as SVG: a panel for each question.

use core::fmt::Write as _;

use crate::report::{Row, epsilon};

/// Of the labels: the width of a letter is a mean, for DejaVu Sans the widest of the usual fonts.
const LETTER: f64 = 6.3;
const LINE: f64 = 13.0;

/// How panels stand on the sheet.
struct Layout {
    columns: usize,
    /// Of a panel, with its margins.
    width: f64,
    height: f64,
    /// The margin right of the axes.
    right: f64,
    /// The height of what stands above all panels.
    head: f64,
}

/// Left of and above the axes of a panel, and below them.
const LEFT: f64 = 60.0;
const TOP: f64 = 50.0;
const BOTTOM: f64 = 40.0;

impl Layout {
    /// Of one question in each scalar, or of several.
    fn of(panels: &[Vec<&Row>]) -> Self {
        let one = panels.iter().all(|panel| panel[0].group.is_empty());
        if one {
            return Self { columns: 1, width: 860.0, height: 430.0, right: 110.0, head: 0.0 };
        }
        // Both scalars side by side.
        let both = panels.iter().any(|panel| panel[0].scalar != panels[0][0].scalar);
        let columns = if both || panels.len() < 8 { 2 } else { 3 };
        Self { columns, width: 430.0, height: 300.0, right: 30.0, head: 40.0 }
    }
}

/// Where a panel has its times and digits.
struct Axes {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    fastest: f64,
    slowest: f64,
    /// 0, or below where errors are larger than 1; in small panels such errors stand at 0, with an
    /// arrow.
    least_digits: f64,
    most_digits: f64,
}

impl Axes {
    fn x(&self, ns: f64) -> f64 {
        self.left + (self.right - self.left) * (ns / self.fastest).ln() / (self.slowest / self.fastest).ln()
    }
    fn y(&self, digits: f64) -> f64 {
        let share = (digits - self.least_digits) / (self.most_digits - self.least_digits);
        self.bottom - (self.bottom - self.top) * share.max(0.0)
    }
}

/// A rectangle by its left upper corner, width and height.
#[derive(Clone, Copy)]
struct Rectangle([f64; 4]);

impl Rectangle {
    fn overlap(self, Rectangle([x, y, w, h]): Self) -> f64 {
        let Self([left, top, width, height]) = self;
        let common = |a: f64, b: f64, c: f64, d: f64| ((a + b).min(c + d) - a.max(c)).max(0.0);
        common(left, width, x, w) * common(top, height, y, h)
    }
}

/// Dots of calls are full, those of loops empty; those of alternatives made for less than the whole
/// range are green. Lines are the frontiers of those made for all of it, of calls drawn through and
/// of loops dashed.
pub(crate) fn chart(title: &str, caption: &str, rows: &[Row]) -> String {
    let mut panels: Vec<Vec<&Row>> = Vec::new();
    for row in rows.iter().filter(|row| row.errors.known()) {
        match panels.iter_mut().find(|panel| panel[0].question() == row.question()) {
            Some(panel) => panel.push(row),
            None => panels.push(vec![row]),
        }
    }
    let times = || panels.iter().flatten().flat_map(|row| row.ns).flatten();
    let fastest = 2_f64.powf(times().fold(f64::INFINITY, f64::min).log2().floor());
    let slowest = 2_f64.powf(times().fold(0.0, f64::max).log2().ceil()).max(2.0 * fastest);
    let looped = rows.iter().any(|row| row.ns[1].is_some());
    let times = if looped { "ns, a scalar call ● or in a loop ○" } else { "ns of a scalar call" };
    let layout = Layout::of(&panels);
    #[expect(clippy::cast_precision_loss, reason = "a few panels")]
    let (columns, lines) = (layout.columns as f64, panels.len().div_ceil(layout.columns) as f64);
    let (width, height) = (columns * layout.width, layout.head + lines * layout.height + 30.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let text = |svg: &mut String, x: f64, y: f64, style: &str, text: &str| {
        let _ = writeln!(svg, "<text x=\"{x:.0}\" y=\"{y:.0}\" {style}>{text}</text>");
    };
    if layout.head > 0.0 {
        let title = format!("{title}: correct digits over {times}");
        text(&mut svg, LEFT, 28.0, "font-size=\"15\"", &title);
    }
    let places = (0..).map(|i| (i / layout.columns, i % layout.columns));
    for (panel, (line, column)) in panels.iter().zip(places) {
        #[expect(clippy::cast_precision_loss, reason = "a few panels")]
        let (left, top) = (column as f64 * layout.width, layout.head + line as f64 * layout.height);
        let (group, scalar) = panel[0].question();
        let least =
            if group.is_empty() { panel.iter().map(|row| row.digits()).fold(0.0, f64::min) } else { 0.0 };
        let axes = Axes {
            left: left + LEFT,
            right: left + layout.width - layout.right,
            top: top + TOP,
            bottom: top + layout.height - BOTTOM,
            fastest,
            slowest,
            least_digits: 2.0 * (0.5 * least).floor(),
            most_digits: if scalar == "f64" { 18.0 } else { 9.0 },
        };
        if group.is_empty() {
            let title = format!("{title}, {scalar}: correct digits over {times}");
            text(&mut svg, axes.left, top + 30.0, "font-size=\"15\"", &title);
        } else {
            text(&mut svg, axes.left, top + 40.0, "font-size=\"13\"", &format!("{group}, {scalar}"));
        }
        grid(&mut svg, &axes, epsilon(scalar));
        for time in [0, 1] {
            frontier(&mut svg, &axes, rows, panel, time);
        }
        dots(&mut svg, &axes, panel, layout.right);
    }
    text(&mut svg, LEFT, height - 14.0, "fill=\"gray\"", caption);
    svg + "</svg>\n"
}

fn grid(svg: &mut String, axes: &Axes, epsilon: f64) {
    let (left, right) = (axes.left, axes.right);
    let mut line = |from: (f64, f64), to: (f64, f64), style: &str| {
        let ((x1, y1), (x2, y2)) = (from, to);
        let _ = writeln!(svg, "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"gray\" {style}/>");
    };
    let mut labels = Vec::new();
    let mut digits = axes.least_digits;
    while digits < axes.most_digits {
        let y = axes.y(digits);
        line((left, y), (right, y), "stroke-opacity=\".3\"");
        labels.push((left - 8.0, y + 4.0, "end", digits.to_string()));
        digits += if axes.most_digits > 10.0 { 4.0 } else { 2.0 };
    }
    let mut tick = axes.fastest;
    while tick <= axes.slowest {
        let x = axes.x(tick);
        line((x, axes.y(axes.least_digits)), (x, axes.y(axes.most_digits)), "stroke-opacity=\".3\"");
        labels.push((x, axes.y(axes.least_digits) + 16.0, "middle", tick.to_string()));
        tick *= 2.0;
    }
    let y = axes.y(-epsilon.log10());
    line((left, y), (right, y), "stroke-dasharray=\"6 4\"");
    labels.push((right + 8.0, y + 4.0, "start", "ε".into()));
    for (x, y, anchor, label) in labels {
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"gray\">{label}</text>"
        );
    }
}

/// Made for as much as any of the same scalar.
fn whole(row: &Row, panel: &[&Row]) -> bool {
    panel.iter().all(|other| row.domain.0 <= other.domain.0 && row.domain.1 >= other.domain.1)
}

fn frontier(svg: &mut String, axes: &Axes, rows: &[Row], panel: &[&Row], time: usize) {
    let frontier = panel.iter().filter(|row| whole(row, panel) && row.on_frontier(rows, time));
    let mut frontier: Vec<(f64, f64)> =
        frontier.filter_map(|row| Some((row.ns[time]?, row.digits()))).collect();
    frontier.sort_by(|a, b| a.0.total_cmp(&b.0));
    let points: Vec<String> =
        frontier.iter().map(|&(ns, digits)| format!("{:.1},{:.1}", axes.x(ns), axes.y(digits))).collect();
    let style = ["", "stroke-dasharray=\"3 2\""][time];
    let _ =
        writeln!(svg, "<polyline points=\"{}\" fill=\"none\" stroke=\"crimson\" {style}/>", points.join(" "));
}

/// A pair of dots a row, joined, and its name where it overlaps least with what is there.
fn dots(svg: &mut String, axes: &Axes, panel: &[&Row], margin: f64) {
    let mut taken: Vec<Rectangle> = Vec::new();
    // Where there is no loop or no call, its place is that of the other.
    let positions: Vec<[f64; 3]> = panel
        .iter()
        .map(|row| {
            let [call, looped] = row.ns;
            let x = |ns: Option<f64>| axes.x(ns.unwrap_or(axes.fastest));
            [x(call.or(looped)), x(looped.or(call)), axes.y(row.digits())]
        })
        .collect();
    for (row, &[call, looped, y]) in panel.iter().zip(&positions) {
        let colour = if whole(row, panel) { "navy" } else { "seagreen" };
        let _ = writeln!(
            svg,
            "<path d=\"M{call:.1} {y:.1}H{looped:.1}\" stroke=\"{colour}\" stroke-opacity=\".35\"/>"
        );
        if row.ns[0].is_some() {
            let _ = writeln!(svg, "<circle cx=\"{call:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{colour}\"/>");
        }
        if row.ns[1].is_some() {
            let _ = writeln!(
                svg,
                "<circle cx=\"{looped:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"white\" stroke=\"{colour}\"/>"
            );
        }
        taken.extend([call, looped].map(|x| Rectangle([x - 5.0, y - 5.0, 10.0, 10.0])));
        taken.push(Rectangle([call.min(looped), y - 1.0, (call - looped).abs(), 2.0]));
    }
    for (row, &[call, looped, y]) in panel.iter().zip(&positions) {
        #[expect(clippy::cast_precision_loss, reason = "a few letters")]
        let width = LETTER * row.name.chars().count() as f64;
        let (left, right) = (call.min(looped) - 8.0 - width, call.max(looped) + 8.0);
        let lines = [0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 4.0, -4.0, 5.0, -5.0, 6.0, -6.0].into_iter();
        let candidates = lines.flat_map(|lines| [(lines, true), (lines, false)]);
        let place = |(lines, to_right): (f64, bool)| {
            Rectangle([if to_right { right } else { left }, y + LINE * (lines - 0.5), width, LINE])
        };
        let cost = |candidate| {
            let label = place(candidate);
            let Rectangle([x, top, ..]) = label;
            let outside = x < axes.left
                || x + width > axes.right + margin
                || top < axes.top
                || top + LINE > axes.bottom;
            let overlap: f64 = taken.iter().map(|&other| label.overlap(other)).sum();
            overlap + LINE * candidate.0.abs() + if outside { 1e4 } else { 0.0 }
        };
        let Some(candidate) = candidates.min_by(|&a, &b| cost(a).total_cmp(&cost(b))) else { continue };
        let label = place(candidate);
        taken.push(label);
        let Rectangle([_, top, ..]) = label;
        let (anchor, from, at) = if candidate.1 {
            ("start", call.max(looped), right)
        } else {
            ("end", call.min(looped), left + width)
        };
        let middle = top + 0.5 * LINE;
        let _ = writeln!(
            svg,
            "<path d=\"M{from:.1} {y:.1}L{at:.1} {middle:.1}\" stroke=\"gray\" stroke-opacity=\".5\"/>"
        );
        let below =
            if row.digits() < axes.least_digits || !row.errors.worst.is_finite() { " ↓" } else { "" };
        let (baseline, name) = (top + 10.0, format!("{}{below}", row.name));
        let _ =
            writeln!(svg, "<text x=\"{at:.1}\" y=\"{baseline:.1}\" text-anchor=\"{anchor}\">{name}</text>");
    }
}
