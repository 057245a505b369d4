//! Plots of curves as SVG.

use core::fmt::Write as _;

const SIZE: [f64; 2] = [720.0, 420.0];
const MARGIN: f64 = 50.0;

/// An axis: its ends, its marks with their names, and what it is.
pub(crate) struct Axis {
    ends: [f64; 2],
    marks: Vec<(f64, String)>,
    name: &'static str,
}

impl Axis {
    /// Logarithmic: points are given by their decades.
    pub(crate) fn decades([from, to]: [i32; 2], name: &'static str) -> Self {
        let marks = (from..=to).map(|decade| (f64::from(decade), format!("1e{decade}"))).collect();
        Self { ends: [from, to].map(f64::from), marks, name }
    }

    /// From 0, with a mark at every `step` and a unit behind its number.
    pub(crate) fn linear(to: u32, step: usize, unit: &str, name: &'static str) -> Self {
        let marks = (0..=to).step_by(step).map(|at| (f64::from(at), format!("{at}{unit}"))).collect();
        Self { ends: [0.0, f64::from(to)], marks, name }
    }

    /// Where a point is between the ends, 0 … 1.
    fn share(&self, at: f64) -> f64 {
        (at - self.ends[0]) / (self.ends[1] - self.ends[0])
    }
}

/// A curve: its name, colour, dashes and points.
pub(crate) struct Curve {
    pub(crate) name: &'static str,
    pub(crate) colour: &'static str,
    pub(crate) dashes: &'static str,
    pub(crate) points: Vec<[f64; 2]>,
}

/// The curves over both axes, as far as they are between the ends of the vertical one; their names
/// at the top, beginning at `legend`, a share of the horizontal axis.
pub(crate) fn svg(horizontal: &Axis, vertical: &Axis, curves: &[Curve], legend: f64) -> String {
    let [width, height] = SIZE;
    let x = |at: f64| MARGIN + (width - 2.0 * MARGIN) * horizontal.share(at);
    let y = |at: f64| height - MARGIN - (height - 2.0 * MARGIN) * vertical.share(at);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let mut line = |[x0, y0]: [f64; 2], [x1, y1]: [f64; 2], [dx, dy]: [f64; 2], name: &str| {
        let _ = writeln!(svg, "<path d=\"M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}\" stroke=\"#ddd\"/>");
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text>",
            x0 + dx,
            y0 + dy
        );
    };
    for (at, name) in &horizontal.marks {
        line([x(*at), y(vertical.ends[0])], [x(*at), y(vertical.ends[1])], [12.0, 16.0], name);
    }
    for (at, name) in &vertical.marks {
        line([x(horizontal.ends[0]), y(*at)], [x(horizontal.ends[1]), y(*at)], [-4.0, 4.0], name);
    }
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
        0.5 * width,
        height - 14.0,
        horizontal.name
    );
    let _ = writeln!(svg, "<text x=\"14\" y=\"{:.1}\">{}</text>", MARGIN - 18.0, vertical.name);
    for (index, Curve { name, colour, dashes, points }) in curves.iter().enumerate() {
        let mut path = String::new();
        for [at, value] in points {
            if (vertical.ends[0]..=vertical.ends[1]).contains(value) {
                let _ = write!(path, "{:.1},{:.1} ", x(*at), y(*value));
            }
        }
        let _ = writeln!(
            svg,
            "<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2.5\" \
             stroke-dasharray=\"{dashes}\"/>"
        );
        let (left, top) = (MARGIN + (width - 2.0 * MARGIN) * legend, MARGIN + 18.0 * (index as f64 + 1.0));
        let _ = writeln!(
            svg,
            "<path d=\"M{left:.1} {top}h40\" stroke=\"{colour}\" stroke-width=\"2.5\" stroke-dasharray=\"{dashes}\"/>\
             <text x=\"{:.1}\" y=\"{}\">{name}</text>",
            left + 50.0,
            top + 4.0
        );
    }
    svg.push_str("</svg>\n");
    svg
}
