//! The mean over the parallelogram of a footprint: what a box filter over the pixel sees.

use core::f32::consts::TAU;
use std::io::{self, Write};

use microsurface::filter::covariance::{variance_kaplanyan2016, variance_of_box};
use microsurface::filter::{Footprint, gaussian, polygon, rectangle};
use microsurface::glam::Vec2;
use microsurface::{Ggx, Ndf};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{ALPHAS, Alternative, Case, Question, Surface, appendix, reference, shuffled};
use crate::Effort;

#[derive(Clone, Copy)]
struct Pixel {
    surface: Surface,
    slope: Vec2,
    footprint: Footprint<f32>,
}

/// The longer step in units of α.
const SIZES: [f32; 5] = [0.01, 0.1, 1.0, 10.0, 100.0];
const SHAPES: [&str; 5] = ["box", "square, turned", "parallelogram", "1 : 30", "line"];

/// The steps of a shape whose longer step is 1.
fn shape(index: usize, rng: &mut Pcg64Mcg) -> [Vec2; 2] {
    let u = Vec2::from_angle(rng.random_range(0.0..TAU));
    match index {
        0 => [Vec2::X, rng.random_range(0.3..1.0) * Vec2::Y],
        1 => [u, u.perp()],
        2 => [u, rng.random_range(0.3..1.0) * Vec2::from_angle(rng.random_range(0.0..TAU))],
        3 => [u, Vec2::from_angle(rng.random_range(0.0..TAU)) / 30.0],
        _ => [u, Vec2::ZERO],
    }
}

fn cases(pixels: usize) -> Vec<Case<Pixel>> {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let mut cases = Vec::new();
    for alpha in ALPHAS {
        #[expect(clippy::cast_possible_truncation, reason = "its f32 is what is given")]
        let Ok(surface) = Ggx::isotropic(alpha as f32) else { continue };
        let alpha = surface.map().alpha();
        for (size, length) in SIZES.iter().enumerate() {
            for kind in 0..SHAPES.len() {
                for pixel in 0..pixels {
                    let [u, v] = shape(kind, &mut rng).map(|step| alpha * length * step);
                    // At the highlight, within a footprint of it, or beside.
                    let (a, b) = (rng.random_range(-0.7..0.7), rng.random_range(-0.7..0.7));
                    let beside = Vec2::from_angle(rng.random_range(0.0..TAU)) * alpha;
                    let slope = match pixel % 3 {
                        0 => Vec2::ZERO,
                        1 => a * u + b * v,
                        _ => a * u + b * v + rng.random_range(0.0..4.0) * beside,
                    };
                    let footprint = Footprint::new(u, v);
                    // In units of α, of the numbers as they are in f32.
                    let width = f64::from(alpha);
                    let [t, u, v] = [slope, u, v].map(|x| x.as_dvec2() / width);
                    let exact = reference::mean(t, u, v) / (width * width);
                    let peak = reference::mean(microsurface::glam::DVec2::ZERO, u, v) / (width * width);
                    let pixel = Pixel { surface, slope, footprint };
                    cases.push(Case { pixel, exact, peak, size, shape: kind });
                }
            }
        }
    }
    shuffled(cases)
}

/// The mean of N × N samples, one at the middle of each part of the footprint.
fn samples<const N: u8>(pixel: &Pixel) -> f32 {
    let ([u, v], n) = (pixel.footprint.steps(), f32::from(N));
    let at = |i: u8| (f32::from(i) + 0.5) / n - 0.5;
    let row = |i| (0..N).map(|j| pixel.surface.p22(pixel.slope + at(i) * u + at(j) * v)).sum::<f32>();
    (0..N).map(row).sum::<f32>() / (n * n)
}

/// A + 2Σ of a pixel filter of this variance.
fn proxy(pixel: &Pixel, variance: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "a constant")]
    let kernel = pixel.footprint.covariance(variance as f32);
    pixel.surface.filtered(kernel).map_or(f32::NAN, |surface| surface.p22(pixel.slope))
}

pub(super) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let cases = cases(effort.pixels);
    let closed = |least| {
        move |p: &Pixel| appendix::mean(p.surface.map().alpha(), p.slope, p.footprint.extents(), least)
    };
    let alternatives = vec![
        Alternative::new("unfiltered", &cases, |p| p.surface.p22(p.slope)),
        Alternative::new("2×2 samples", &cases, samples::<2>),
        Alternative::new("4×4 samples", &cases, samples::<4>),
        Alternative::new("8×8 samples", &cases, samples::<8>),
        Alternative::new("16×16 samples", &cases, samples::<16>),
        Alternative::new("A + 2Σ, σ² = 1/12", &cases, |p| proxy(p, variance_of_box::<f64>())),
        Alternative::new("A + 2Σ, σ² = 1/4", &cases, |p| proxy(p, variance_kaplanyan2016::<f64>())),
        Alternative::new("gaussian::filtered_by_two, 1/12", &cases, |p| {
            let filtered = gaussian::filtered_by_two(&p.surface, p.footprint.covariance(variance_of_box()));
            filtered.map_or(f32::NAN, |surface| surface.p22(p.slope))
        }),
        Alternative::new("gaussian::filtered, 1/12", &cases, |p| {
            let filtered = gaussian::filtered(&p.surface, p.footprint.covariance(variance_of_box()));
            filtered.map_or(f32::NAN, |surface| surface.p22(p.slope))
        }),
        Alternative::new("Kaplanyan 2016, App. A", &cases, closed(1e-3)),
        Alternative::new("the same without limit", &cases, closed(0.0)),
        Alternative::new("rectangle::mean_p22", &cases, |p| {
            rectangle::mean_p22(&p.surface, p.slope, 0.5 * p.footprint.extents())
        }),
        Alternative::new("polygon::mean_p22", &cases, |p| {
            let [u, v] = p.footprint.steps();
            polygon::mean_p22(&p.surface, p.slope, u, v)
        }),
    ];
    let describe = |p: &Pixel| {
        let alpha = p.surface.map().alpha();
        let [u, v, t] = [p.footprint.steps()[0], p.footprint.steps()[1], p.slope].map(|x| x / alpha);
        format!(
            "α = {alpha}, steps ({:.3} {:.3}) ({:.3} {:.3}) α, slope ({:.2} {:.2}) α",
            u.x, u.y, v.x, v.y, t.x, t.y
        )
    };
    let question = Question {
        file: "ggx_filter_box",
        title: "GGX over the parallelogram of a pixel",
        sizes: &SIZES,
        shapes: &SHAPES,
    };
    question.answer(effort, out, &cases, describe, alternatives)
}
