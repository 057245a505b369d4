//! A plot: is a moved microsurface the one of another width? For GGX it is, for GTR it is not.

use microsurface::glam::{DMat2, DVec2};
use microsurface::{Error, Ggx, Gtr, Ndf};

use crate::plot::{Axis, Curve, svg};

/// Of the surfaces at rest, and what they are drawn out to.
const WIDTH: f64 = 0.3;
const MOVED: f64 = 0.05;
const TAIL: f64 = 1.4;

pub(crate) const LOOK_FOR: &str = "\
  Slopes along x, both axes logarithmic: surfaces of alpha 0.3 drawn out along x to a sixth of their slope, against
  surfaces of alpha 0.05 along x. The two curves of GGX are one; those of GTR (gamma 1.4) part in the tail, which
  a transform moves with the core and another alpha leaves where it was. Equal cores, unequal peaks and tails.";

/// Decades of the slope and of its density.
const SLOPES: [i32; 2] = [-3, 1];
const DENSITIES: [i32; 2] = [-5, 3];

fn curve(
    name: &'static str,
    colour: &'static str,
    dashes: &'static str,
    surface: &impl Ndf<Scalar = f64>,
) -> Curve {
    let [from, to] = SLOPES.map(f64::from);
    let points = (0..=400)
        .map(|i| {
            let decade = from + (to - from) * f64::from(i) / 400.0;
            [decade, surface.p22(DVec2::new(10_f64.powf(decade), 0.0)).log10()]
        })
        .collect();
    Curve { name, colour, dashes, points }
}

/// The plot as SVG.
pub(crate) fn plot() -> Result<String, Error> {
    let drawn_out = DMat2::from_diagonal(DVec2::new(WIDTH / MOVED, 1.0));
    let gtr = |alpha| Gtr::isotropic(alpha, TAIL);
    // A GTR of the smaller width, as wide as the other across x.
    let across = DMat2::from_diagonal(DVec2::new(1.0, MOVED / WIDTH));
    let curves = [
        curve("GGX, moved", "#1f77b4", "none", &Ggx::isotropic(WIDTH)?.transformed(drawn_out)?),
        curve("GGX, alpha_x = 0.05", "#aec7e8", "8 6", &Ggx::anisotropic(MOVED, WIDTH)?),
        curve("GTR, moved", "#d62728", "none", &gtr(WIDTH)?.transformed(drawn_out)?),
        curve("GTR, alpha = 0.05", "#ff9896", "8 6", &gtr(MOVED)?.transformed(across)?),
    ];
    Ok(svg(&Axis::decades(SLOPES, "slope"), &Axis::decades(DENSITIES, "density"), &curves, 0.7))
}
