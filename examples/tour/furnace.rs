//! Albedos: by a material's own sampler, and by a quadrature that does not use it.

use core::f32::consts::TAU;
use core::hint::black_box;
use core::time::Duration;
use std::time::Instant;

use microsurface::frame::reflected;
use microsurface::glam::{DVec3, Vec2, Vec3};
use rand::RngExt;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::SeedableRng;

use crate::integrator::Faults;
use crate::material::Material;

/// What the quadrature is trusted to; see the reference values of the report.
pub(crate) const QUADRATURE_ERROR: f64 = 2e-4;

/// An estimate and its standard error.
#[derive(Clone, Copy)]
pub(crate) struct Estimate {
    pub(crate) mean: f64,
    pub(crate) error: f64,
}

impl Estimate {
    /// The difference from a quadrature, in units of the error to be expected.
    pub(crate) fn deviation(&self, quadrature: f64) -> f64 {
        ((self.mean - quadrature) / self.error.hypot(QUADRATURE_ERROR)).abs()
    }
}

/// The direction of this cosine, along neither axis of an anisotropic surface.
pub(crate) fn direction(cos: f32) -> Vec3 {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    let (y, x) = (0.7_f32).sin_cos();
    Vec3::new(sin * x, sin * y, cos)
}

/// The share of light from everywhere that leaves towards `wo`: the mean weight of the sampler.
/// Also the time that drawing the samples took.
pub(crate) fn sampled(
    material: &dyn Material,
    wo: Vec3,
    samples: u32,
    seed: u64,
    faults: &mut Faults,
) -> (Estimate, Duration) {
    let mut rng = Pcg32::seed_from_u64(seed);
    let random: Vec<Vec2> = (0..samples).map(|_| Vec2::new(rng.random(), rng.random())).collect();
    let start = Instant::now();
    let drawn: Vec<_> = random.iter().map(|&u| black_box(material).sample(wo, u)).collect();
    let time = start.elapsed();
    let (mut sum, mut sum2) = (0.0, 0.0);
    for sample in drawn.into_iter().flatten() {
        faults.check(&sample.weight.to_array());
        faults.check(&[sample.pdf]);
        let weight = f64::from(sample.weight.x);
        sum += weight;
        sum2 += weight * weight;
    }
    let n = f64::from(samples);
    let mean = sum / n;
    let variance = (sum2 / n - mean * mean).max(0.0);
    (Estimate { mean, error: (variance / (n - 1.0)).sqrt() }, time)
}

/// ∫ f wi.z dwi, by the midpoint rule over the half vector.
///
/// With e^s the tangent of its angle, dwi = 4 (wo·wm) dwm and dwm = sin²θ cosθ ds dφ: every width
/// of the peak is resolved alike. The points of each sector are shifted in s by another share of
/// the step, so that the edge where wi sinks below the horizon is met evenly.
pub(crate) fn quadrature(material: &dyn Material, wo: Vec3, faults: &mut Faults) -> DVec3 {
    const RINGS: u16 = 160;
    const SECTORS: u16 = 96;
    const GOLDEN: f32 = 0.618_034;
    let (first, last) = (1e-5_f32.ln(), 1e3_f32.ln());
    let step = (last - first) / f32::from(RINGS);
    let mut sum = DVec3::ZERO;
    for sector in 0..SECTORS {
        let (sin_phi, cos_phi) = (TAU * (f32::from(sector) + 0.5) / f32::from(SECTORS)).sin_cos();
        let shift = (f32::from(sector) * GOLDEN).fract();
        for ring in 0..RINGS {
            let tan = (first + (f32::from(ring) + shift) * step).exp();
            let cos = 1.0 / tan.hypot(1.0);
            let sin = tan * cos;
            let wm = Vec3::new(sin * cos_phi, sin * sin_phi, cos);
            let wi = reflected::<f32>(wo, wm);
            let wo_wm = wo.dot(wm);
            if wi.z > 0.0 && wo_wm > 0.0 {
                let f = material.eval(wi, wo);
                faults.check(&f.to_array());
                sum += (f * (wi.z * 4.0 * wo_wm * sin * sin * cos)).as_dvec3();
            }
        }
    }
    sum * f64::from(step * TAU / f32::from(SECTORS))
}
