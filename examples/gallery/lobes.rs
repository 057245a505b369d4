//! A plot: the density of every distribution, relative to its peak.

use microsurface::glam::DVec3;
use microsurface::{Beckmann, Error, Ggx, Gtr, Ndf};

use crate::plot::{Axis, Curve, svg};

pub(crate) const LOOK_FOR: &str = "\
  D relative to its peak against the angle of the normal, all of α = 0.1. The smaller γ, the more is left at large
  angles. GTR of γ above 2 leaves its peak sooner than Beckmann, which has the roundest peak and the shortest tail.";

const ALPHA: f64 = 0.1;
/// The decades of the relative density that are shown.
const DECADES: [i32; 2] = [-6, 0];

fn curve(name: &'static str, colour: &'static str, ndf: &dyn Ndf<Scalar = f64>) -> Curve {
    let peak = ndf.d(DVec3::Z);
    let points = (0..=900)
        .map(|tenths| {
            let angle = 0.1 * f64::from(tenths);
            let (sin, cos) = angle.to_radians().sin_cos();
            [angle, (ndf.d(DVec3::new(sin, 0.0, cos)) / peak).log10()]
        })
        .collect();
    Curve { name, colour, dashes: "none", points }
}

/// The plot as SVG.
pub(crate) fn plot() -> Result<String, Error> {
    let curves = [
        curve("GTR, γ = 0.5", "#d62728", &Gtr::isotropic(ALPHA, 0.5)?),
        curve("GTR, γ = 1", "#ff7f0e", &Gtr::closed::<1>(ALPHA)?),
        curve("GTR, γ = 1.5", "#bcbd22", &Gtr::isotropic(ALPHA, 1.5)?),
        curve("GGX, which is GTR of γ = 2", "#000000", &Ggx::isotropic(ALPHA)?),
        curve("GTR, γ = 3", "#2ca02c", &Gtr::closed::<3>(ALPHA)?),
        curve("GTR, γ = 4", "#1f77b4", &Gtr::closed::<4>(ALPHA)?),
        curve("Beckmann", "#9467bd", &Beckmann::isotropic(ALPHA)?),
    ];
    let angle = Axis::linear(90, 10, "°", "angle of the normal");
    Ok(svg(&angle, &Axis::decades(DECADES, "D relative to its peak"), &curves, 0.6))
}
