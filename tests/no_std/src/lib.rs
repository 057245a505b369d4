//! Proof that microsurface links without std: a panic handler of its own, which std would
//! duplicate.
#![no_std]

use microsurface::batch::{Directions, NdfBatch};
use microsurface::bsdf::RoughConductor;
use microsurface::filter::{Footprint, gaussian};
use microsurface::fresnel::Dielectric;
use microsurface::glam::{DVec2, DVec3, Vec2, Vec3};
use microsurface::{Beckmann, Ggx, Gtr, Ndf, SampleNdf};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {}
}

/// GGX in f32: the weight of a sampled reflection, or −1.
#[unsafe(no_mangle)]
pub extern "C" fn ggx_weight(alpha: f32, u: f32, v: f32) -> f32 {
    let (Ok(surface), Ok(fresnel)) = (Ggx::isotropic(alpha), Dielectric::new(1.5_f32)) else { return -1.0 };
    let sample = RoughConductor::new(surface, fresnel).sample(Vec3::new(0.6, 0.0, 0.8), Vec2::new(u, v));
    sample.map_or(-1.0, |sample| sample.weight)
}

/// Beckmann in f64: f, or −1.
#[unsafe(no_mangle)]
pub extern "C" fn beckmann_eval(alpha: f64) -> f64 {
    let (Ok(surface), Ok(fresnel)) = (Beckmann::isotropic(alpha), Dielectric::new(1.5_f64)) else {
        return -1.0;
    };
    RoughConductor::new(surface, fresnel).eval(DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, 0.6, 0.8))
}

/// GTR in f64: the masking of a sampled normal, or −1.
#[unsafe(no_mangle)]
pub extern "C" fn gtr_masking(alpha: f64, gamma: f64) -> f64 {
    let Ok(surface) = Gtr::spline(alpha, gamma) else { return -1.0 };
    surface.g1(DVec3::new(0.6, 0.0, 0.8), surface.sample_d(DVec2::new(0.5, 0.5)))
}

/// A highlight over the footprint of a pixel, in f32, or −1.
#[unsafe(no_mangle)]
pub extern "C" fn ggx_over(alpha: f32, step: f32) -> f32 {
    let (Ok(surface), Ok(fresnel)) = (Ggx::isotropic(alpha), Dielectric::new(1.5_f32)) else { return -1.0 };
    let footprint = Footprint::<f32>::new(Vec2::new(step, 0.0), Vec2::new(0.0, step)).clamped(1.0);
    let convolved = gaussian::filtered(&surface, footprint.covariance(0.25)).map_or(-1.0, |s| s.d(Vec3::Z));
    let material = RoughConductor::new(surface, fresnel);
    convolved + material.eval_over(Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.6, 0.8), footprint)
}

/// D of Beckmann of one direction, as a batch, or −1.
#[unsafe(no_mangle)]
pub extern "C" fn batch_d(alpha: f32) -> f32 {
    let Ok(surface) = Beckmann::isotropic(alpha) else { return -1.0 };
    let mut d = [0.0; 1];
    surface.d_batch(Directions { x: &[0.6], y: &[0.0], z: &[0.8] }, &mut d);
    d[0]
}
