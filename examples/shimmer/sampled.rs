//! Pictures of many samples per pixel, unfiltered: the reference, and what supersampling gives for
//! its price.

use microsurface::Error;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

use crate::materials::Materials;
use crate::rows::{Region, each_pixel};
use crate::scene::Scene;

/// The mean over a pixel.
#[derive(Clone, Copy, Default)]
pub(crate) struct Mean {
    /// Radiance with each material.
    pub(crate) radiance: [f32; 2],
    /// The diffuse part of it.
    pub(crate) diffuse: f32,
    /// The share of the pixel where something is hit.
    pub(crate) coverage: f32,
}

/// Box filtered means over strata × strata samples of each pixel.
pub(crate) fn means(
    scene: &Scene,
    region: Region,
    frame: f64,
    strata: u32,
    seed: u64,
) -> Result<Vec<Mean>, Error> {
    let (camera, materials) = (scene.camera(frame), Materials::new()?);
    Ok(each_pixel(region, |x, y| {
        let mut random = Pcg32::seed_from_u64(seed << 48 | (x as u64) << 24 | y as u64);
        let mut unit = || f64::from(random.next_u32()) * (1.0 / 4_294_967_296.0);
        let (mut radiance, mut diffuse, mut hits) = ([0.0; 2], 0.0, 0_u32);
        for stratum in 0..strata * strata {
            let (column, row) = (f64::from(stratum % strata), f64::from(stratum / strata));
            let within = [(column + unit()) / f64::from(strata), (row + unit()) / f64::from(strata)];
            let place = region.place(x as f64 + within[0], y as f64 + within[1]);
            let Some(hit) = scene.shape.hit(&camera.ray(place.into())) else { continue };
            let lit = scene.lit(&hit, camera.eye);
            let f = materials.eval(lit.wi.as_vec3(), lit.wo.as_vec3());
            radiance = [0, 1].map(|i| radiance[i] + lit.diffuse + lit.irradiance * f64::from(f[i]));
            diffuse += lit.diffuse;
            hits += 1;
        }
        let inv = 1.0 / f64::from(strata * strata);
        Mean {
            radiance: radiance.map(|sum| (sum * inv) as f32),
            diffuse: (diffuse * inv) as f32,
            coverage: (f64::from(hits) * inv) as f32,
        }
    }))
}
