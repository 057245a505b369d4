//! A brushed gold surface: build it, sample it, evaluate it.

use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Conductor;
use microsurface::glam::{Vec2, Vec3};
use microsurface::{Ggx, RoughnessMatrix};

fn main() -> Result<(), microsurface::Error> {
    // The metal: refractive index n and extinction k of gold in red, green and blue.
    let gold = Conductor::new(Vec3::new(0.19, 0.54, 1.33), Vec3::new(3.40, 2.23, 1.87))?;
    // The surface: slopes of width 0.1 along the brushing, which runs 45° from the x tangent, and 0.4 across it.
    let brushed = RoughnessMatrix::rotated(0.1, 0.4, 45_f32.to_radians())?;
    let material = RoughConductor::new(Ggx::from_roughness_matrix(brushed), gold);

    // Directions are in the shading frame (z is the normal) and point away from the surface.
    let to_viewer = Vec3::new(0.6, 0.0, 0.8);
    let random = Vec2::new(0.3, 0.7);

    // A path continues in direction `wi`; None means that it ends here, and carries nothing on.
    if let Some(sample) = material.sample(to_viewer, random) {
        println!("continue towards      {:.4}", sample.wi);
        // The throughput is multiplied by the weight: it is f cos/pdf already.
        println!("throughput times      {:.4}", sample.weight);
        // Light arriving from `wi` leaves towards the viewer as f times the cosine wi.z.
        let f = material.eval(sample.wi, to_viewer);
        println!("light arriving times  {:.4}", f * sample.wi.z);
        // The density is what multiple importance sampling weighs against that of the light sampler.
        let pdf = material.pdf(sample.wi, to_viewer);
        println!("density, 1/sr         {pdf:.4}");
        // The three numbers agree, whichever way the direction was found.
        assert!((f * sample.wi.z / pdf - sample.weight).length() < 1e-5);
    }
    Ok(())
}
