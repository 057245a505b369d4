//! A brushed gold surface: build it, sample it, evaluate it.

use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Conductor;
use microsurface::glam::{Vec2, Vec3};
use microsurface::{Error, Ggx};

fn main() -> Result<(), Error> {
    // Gold, brushed at 45° to the x tangent: slopes of width 0.1 along the brushing, 0.4 across it.
    let metal = Conductor::new(Vec3::new(0.19, 0.54, 1.33), Vec3::new(3.40, 2.23, 1.87))?;
    let gold = RoughConductor::new(Ggx::rotated(0.1, 0.4, 45_f32.to_radians())?, metal);

    // Unit vectors of the shading frame, z along the normal, pointing away from the surface.
    let wo = Vec3::new(0.6, 0.0, 0.8);
    if let Some(sample) = gold.sample(wo, Vec2::new(0.3, 0.7)) {
        // The path goes on along `wi`, its throughput times `weight` = f cos/pdf.
        println!("wi {:.4}, weight {:.4}", sample.wi, sample.weight);
        // Light from `wi`: f comes without the cosine; the density is for multiple importance
        // sampling.
        let (f, pdf) = (gold.eval(sample.wi, wo), gold.pdf(sample.wi, wo));
        println!("f cos {:.4}, pdf {pdf:.4}", f * sample.wi.z);
        assert!((f * sample.wi.z / pdf - sample.weight).length() < 1e-5);
    }
    Ok(())
}
