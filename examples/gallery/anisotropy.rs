//! A plot: is a moved microsurface the one of another width? For GGX it is, for GTR it is not.

use core::fmt::Write as _;

use microsurface::glam::{DMat2, DVec2};
use microsurface::{Error, Ggx, Gtr, Ndf};

/// Of the surfaces at rest, and what they are drawn out to.
const WIDTH: f64 = 0.3;
const MOVED: f64 = 0.05;
const TAIL: f64 = 1.4;

pub(crate) const LOOK_FOR: &str = "\
  Slopes along x, both axes logarithmic: surfaces of alpha 0.3 drawn out along x to a sixth of their slope, against
  surfaces of alpha 0.05 along x. The two curves of GGX are one; those of GTR (gamma 1.4) part in the tail, which
  a transform moves with the core and another alpha leaves where it was. Equal cores, unequal peaks and tails.";

const SIZE: [f64; 2] = [720.0, 420.0];
const MARGIN: f64 = 50.0;
/// Decades of the slope and of its density.
const SLOPES: [f64; 2] = [-3.0, 1.0];
const DENSITIES: [f64; 2] = [-5.0, 3.0];

/// A curve: its name, colour, dashes and density of slopes along x.
struct Curve {
    name: &'static str,
    colour: &'static str,
    dashes: &'static str,
    density: Box<dyn Fn(f64) -> f64>,
}

fn curve<N: Ndf<Scalar = f64> + 'static>(
    name: &'static str,
    colour: &'static str,
    dashes: &'static str,
    surface: N,
) -> Curve {
    Curve { name, colour, dashes, density: Box::new(move |slope| surface.p22(DVec2::new(slope, 0.0))) }
}

/// The plot as SVG.
pub(crate) fn plot() -> Result<String, Error> {
    let drawn_out = DMat2::from_diagonal(DVec2::new(WIDTH / MOVED, 1.0));
    let gtr = |alpha| Gtr::isotropic(alpha, TAIL);
    // A GTR of the smaller width, as wide as the other across x.
    let across = DMat2::from_diagonal(DVec2::new(1.0, MOVED / WIDTH));
    let curves = [
        curve("GGX, moved", "#1f77b4", "none", Ggx::isotropic(WIDTH)?.transformed(drawn_out)?),
        curve("GGX, alpha_x = 0.05", "#aec7e8", "8 6", Ggx::anisotropic(MOVED, WIDTH)?),
        curve("GTR, moved", "#d62728", "none", gtr(WIDTH)?.transformed(drawn_out)?),
        curve("GTR, alpha = 0.05", "#ff9896", "8 6", gtr(MOVED)?.transformed(across)?),
    ];
    let [width, height] = SIZE;
    let x = |decade: f64| MARGIN + (width - 2.0 * MARGIN) * (decade - SLOPES[0]) / (SLOPES[1] - SLOPES[0]);
    let y = |decade: f64| {
        height - MARGIN - (height - 2.0 * MARGIN) * (decade - DENSITIES[0]) / (DENSITIES[1] - DENSITIES[0])
    };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let mut line = |from: [f64; 2], to: [f64; 2], [dx, dy]: [f64; 2], decade: i32| {
        let ([x0, y0], [x1, y1]) = (from, to);
        let _ = writeln!(svg, "<path d=\"M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}\" stroke=\"#ddd\"/>");
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">1e{decade}</text>",
            x0 + dx,
            y0 + dy
        );
    };
    for decade in -3..=1_i32 {
        let at = f64::from(decade);
        line([x(at), y(DENSITIES[0])], [x(at), y(DENSITIES[1])], [12.0, 16.0], decade);
    }
    for decade in -5..=3_i32 {
        let at = f64::from(decade);
        line([x(SLOPES[0]), y(at)], [x(SLOPES[1]), y(at)], [-4.0, 4.0], decade);
    }
    for (index, Curve { name, colour, dashes, density }) in curves.iter().enumerate() {
        let points: String = (0..=400)
            .filter_map(|i| {
                let decade = SLOPES[0] + (SLOPES[1] - SLOPES[0]) * f64::from(i) / 400.0;
                let value = density(10_f64.powf(decade)).log10();
                (value >= DENSITIES[0]).then(|| format!("{:.1},{:.1} ", x(decade), y(value)))
            })
            .collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2.5\" \
             stroke-dasharray=\"{dashes}\"/>"
        );
        let top = MARGIN + 18.0 * index as f64;
        let _ = writeln!(
            svg,
            "<path d=\"M{0} {top}h40\" stroke=\"{colour}\" stroke-width=\"2.5\" stroke-dasharray=\"{dashes}\"/>\
             <text x=\"{1}\" y=\"{2}\">{name}</text>",
            width - 230.0,
            width - 180.0,
            top + 4.0
        );
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}
