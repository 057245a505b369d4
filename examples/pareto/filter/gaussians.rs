//! GGX convolved with a Gaussian: kernels as wide in every direction, and kernels along a line.

use core::f32::consts::TAU;
use std::io::{self, Write};

use microsurface::filter::{Covariance, Footprint, gaussian};
use microsurface::glam::Vec2;
use microsurface::{Ggx, Ndf};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{ALPHAS, Alternative, Case, Question, Surface, reference, shuffled};
use crate::Effort;

#[derive(Clone, Copy)]
struct Pixel {
    surface: Surface,
    slope: Vec2,
    kernel: Covariance<f32>,
}

/// Standard deviations in units of α.
const SIZES: [f32; 7] = [0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0];
const SHAPES: [&str; 2] = ["isotropic", "line"];

fn cases(pixels: usize) -> Vec<Case<Pixel>> {
    let mut rng = Pcg64Mcg::seed_from_u64(2);
    let mut cases = Vec::new();
    for alpha in ALPHAS {
        #[expect(clippy::cast_possible_truncation, reason = "its f32 is what is given")]
        let Ok(surface) = Ggx::isotropic(alpha as f32) else { continue };
        let alpha = surface.map().alpha();
        let width = f64::from(alpha);
        for (size, deviation) in SIZES.iter().enumerate() {
            for shape in 0..SHAPES.len() {
                for pixel in 0..pixels {
                    let length = alpha * deviation;
                    let step = length * Vec2::from_angle(rng.random_range(0.0..TAU));
                    // From the middle of the highlight to eight times its width.
                    let reach = (alpha * alpha + 2.0 * length * length).sqrt();
                    let far = if pixel == 0 { 0.0 } else { 8.0 * rng.random_range(0.0..1.0_f32).powi(2) };
                    let slope = far * reach * Vec2::from_angle(rng.random_range(0.0..TAU));
                    // What the convolution is, in units of α.
                    let t = slope.as_dvec2() / width;
                    let (kernel, exact, peak) = if shape == 0 {
                        let variance = length * length;
                        let sigma = f64::from(variance).sqrt() / width;
                        let kernel = Covariance::isotropic(variance);
                        (kernel, reference::isotropic(t.length(), sigma), reference::isotropic(0.0, sigma))
                    } else {
                        let sigma = step.as_dvec2() / width;
                        let kernel = Footprint::new(step, Vec2::ZERO).covariance(1.0);
                        (kernel, reference::line(t, sigma), reference::line(0.0 * t, sigma))
                    };
                    let [exact, peak] = [exact, peak].map(|p22| p22 / (width * width));
                    cases.push(Case { pixel: Pixel { surface, slope, kernel }, exact, peak, size, shape });
                }
            }
        }
    }
    shuffled(cases)
}

pub(super) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let cases = cases(2 * effort.pixels);
    // Not projected::filtered: it convolves on the disc of m.xy, which is another question.
    let alternatives = vec![
        Alternative::new("unfiltered", &cases, |p| p.surface.p22(p.slope)),
        Alternative::new("A + 2Σ", &cases, |p| {
            p.surface.filtered(p.kernel).map_or(f32::NAN, |surface| surface.p22(p.slope))
        }),
        Alternative::new("gaussian::filtered_by_two", &cases, |p| {
            gaussian::filtered_by_two(&p.surface, p.kernel).map_or(f32::NAN, |surface| surface.p22(p.slope))
        }),
        Alternative::new("gaussian::filtered", &cases, |p| {
            gaussian::filtered(&p.surface, p.kernel).map_or(f32::NAN, |surface| surface.p22(p.slope))
        }),
        Alternative::new("gaussian::p22", &cases, |p| gaussian::p22(&p.surface, p.slope, p.kernel)),
    ];
    let describe = |p: &Pixel| {
        let alpha = p.surface.map().alpha();
        let [large, small, _] = p.kernel.principal().map(|variance| variance.abs().sqrt() / alpha);
        let t = p.slope.length() / alpha;
        format!("α = {alpha}, σ = {large:.2} α and {small:.2} α, at {t:.2} α")
    };
    let question =
        Question { file: "ggx_filter_gaussian", title: "GGX ⊛ Gaussian", sizes: &SIZES, shapes: &SHAPES };
    question.answer(effort, out, &cases, describe, alternatives)
}
