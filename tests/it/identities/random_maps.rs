//! The identities under random maps of entries within ±10 and of ratios of singular values up to
//! 1e6, for surfaces under a map and for black boxes moved by the same matrix.

use microsurface::glam::DMat2;
use microsurface::ndf::Ndf;
use microsurface::transform::Transformed;
use rand_pcg::Pcg64Mcg;

use super::{Checked, limit, plane};
use crate::random::uniform;
use crate::rows::{Distribution, Mask, Row};
use crate::scalar::{dot, unit, vec3};
use crate::surfaces::{Move, Spec, Surface, Widths};

/// The columns of a matrix: rotation × diag × rotation with a ratio of up to 1e6, entries within
/// ±10.
fn matrix(random: &mut Pcg64Mcg) -> [[f64; 2]; 2] {
    let ratio = 10_f64.powf(uniform(random, 0.0, 6.0));
    let largest = uniform(random, 0.1, 7.0);
    let ((s, c), (t, d)) = (uniform(random, 0.0, 6.3).sin_cos(), uniform(random, 0.0, 6.3).sin_cos());
    let (x, y) = (largest, if uniform(random, 0.0, 1.0) < 0.5 { -largest } else { largest } / ratio);
    [[c * x * d - s * y * t, s * x * d + c * y * t], [-c * x * t - s * y * d, -s * x * t + c * y * d]]
}

/// A distribution of the rows by turns.
fn distribution(random: &mut Pcg64Mcg, index: usize) -> Distribution {
    let rows: Vec<Row> = Row::with_own_density().filter(|row| row.columns().mask != Mask::Spline).collect();
    let row = rows[index % rows.len()];
    row.with(10_f64.powf(uniform(random, -3.0, 0.0)), uniform(random, 0.0, 6.0))
}

/// One map: ∫D cos = 1, ∫D max(0, w·m) = σ, ∫D_w = 1 and the furnace ∫G1 D max(0, w·m) = w.z.
fn see<N: Ndf<Scalar = f64>>(
    worst: &mut [Checked; 4],
    ndf: &N,
    spec: &Spec,
    w: [f64; 3],
    at: &dyn Fn() -> String,
) {
    let (plane, direction) = (plane::<f64>(spec), vec3::<f64>(w));
    let [normalised] = plane.over_visible_normals([0.0, 0.0, 1.0], |m| [ndf.d(vec3::<f64>(m)) * m[2]]);
    worst[0].see(normalised, 1.0, at);
    let sigma = ndf.sigma(direction);
    let [area, visible, masked] = plane.over_visible_normals(w, |m| {
        let normal = vec3::<f64>(m);
        let facing = ndf.d(normal) * dot(w, m);
        [facing, ndf.vndf(direction, normal), facing * ndf.g1(direction, normal)]
    });
    worst[1].see(area, sigma, at);
    worst[2].see(visible, 1.0, at);
    worst[3].see(masked, w[2], at);
}

fn check(maps: usize) {
    let mut random = Pcg64Mcg::new(11);
    let [mut exact, mut nodes, mut boxed]: [[Checked; 4]; 3] = Default::default();
    for index in 0..maps {
        let distribution = distribution(&mut random, index);
        let widths = if distribution.row.columns().own_width {
            Widths::Isotropic(1.0)
        } else {
            Widths::Isotropic(10_f64.powf(uniform(&mut random, -3.0, 0.0)))
        };
        let columns = matrix(&mut random);
        let spec = Spec::new(distribution, widths, Move::Transform(columns));
        let z = uniform(&mut random, 0.02, 1.0);
        let phi = uniform(&mut random, 0.0, 6.3);
        let s = (1.0 - z * z).sqrt();
        let w = unit([s * phi.cos(), s * phi.sin(), z]);
        let surface: Surface<f64> = spec.build().expect("within the domain");
        let at = || format!("{surface:?} {w:?}");
        let worst = if spec.mask() == Mask::Exact { &mut exact } else { &mut nodes };
        see(worst, &surface, &spec, w, &at);
        if index % 4 == 0 {
            let at_rest: Surface<f64> =
                Spec { moved: Move::Stay, ..spec }.build().expect("within the domain");
            let moved = Transformed::new(at_rest, DMat2::from_cols_array_2d(&columns)).expect("invertible");
            // Only what rounding costs more than for the surface under its own map is of interest.
            if spec.mask() == Mask::Exact {
                see(&mut boxed, &moved, &spec, w, &|| format!("black box, {surface:?} {w:?}"));
            }
        }
    }
    let names = ["∫D cos = 1", "∫D max(0, w·m) = σ", "∫D_w = 1", "∫G1 D max(0, w·m) = w.z"];
    for (kind, worst, relative) in
        [("exact masks", exact, LIMITS[0]), ("8 nodes", nodes, LIMITS[1]), ("black boxes", boxed, LIMITS[2])]
    {
        for (worst, name) in worst.iter().zip(names) {
            worst.check(&format!("{name}, {kind}"), &limit(relative, 1.0));
        }
    }
}

/// Relative deviations of surfaces with exact masks, with masks of nodes, and of black boxes.
const LIMITS: [f64; 3] = [9e-11, 1e-5, 9e-11];

#[test]
fn identities_hold_under_random_maps() {
    check(360);
}

#[test]
#[ignore = "ten thousand maps: two minutes"]
fn identities_hold_under_ten_thousand_maps() {
    check(10_000);
}
