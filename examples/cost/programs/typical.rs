//! A metal as a path tracer uses it.

use std::hint::black_box;

use microsurface::Ggx;
use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Conductor;
use microsurface::glam::{Vec2, Vec3};

fn main() {
    let (n, k) = black_box((Vec3::new(0.19, 0.54, 1.33), Vec3::new(3.40, 2.23, 1.87)));
    let (Ok(surface), Ok(gold)) = (Ggx::isotropic(black_box(0.3_f32)), Conductor::new(n, k)) else { return };
    let brdf = RoughConductor::new(surface, gold);
    let (wi, wo, u) = black_box((Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec2::new(0.3, 0.7)));
    black_box(brdf.eval(wi, wo));
    black_box(brdf.pdf(wi, wo));
    black_box(brdf.sample(wo, u));
}
