//! Pictures of a scene: radiance, and what of it is diffuse.

use microsurface::Error;
use microsurface::glam::Vec3;

use crate::image::Image;
use crate::methods::Method;
use crate::pixel::Pixel;
use crate::rows::Region;
use crate::sampled::{Mean, means};
use crate::scene::Scene;

/// Sets of samples of a reference.
const SETS: u16 = 4;

/// Radiance pixel by pixel, 0 where nothing is hit.
pub(crate) struct Picture {
    pub(crate) radiance: Vec<f32>,
    diffuse: Vec<f32>,
}

impl Picture {
    /// One material of a picture of many samples.
    pub(crate) fn of_means(means: &[Mean], material: usize) -> Self {
        Self {
            radiance: means.iter().map(|mean| mean.radiance[material]).collect(),
            diffuse: means.iter().map(|mean| mean.diffuse).collect(),
        }
    }

    /// Pixels shaded once each.
    pub(crate) fn shaded(pixels: &[Option<Pixel>], method: &Method) -> Self {
        let hit: Vec<Pixel> = pixels.iter().flatten().copied().collect();
        let mut shaded = vec![0.0; hit.len()];
        (method.shade)(&hit, &mut shaded);
        let mut shaded = shaded.into_iter();
        let next = |pixel: &Option<Pixel>| pixel.and_then(|_| shaded.next()).unwrap_or(0.0);
        Self {
            radiance: pixels.iter().map(next).collect(),
            diffuse: pixels.iter().map(|pixel| pixel.map_or(0.0, |pixel| pixel.diffuse)).collect(),
        }
    }

    /// For looking at: white highlights on the tint.
    pub(crate) fn image(&self, scene: &Scene, region: Region) -> Image {
        let colour =
            |(&radiance, &diffuse): (&f32, &f32)| Vec3::splat(radiance - diffuse) + scene.tint * diffuse;
        Image {
            width: region.size[0] as u32,
            height: region.size[1] as u32,
            pixels: self.radiance.iter().zip(&self.diffuse).map(colour).collect(),
        }
    }
}

/// What the others are compared with.
pub(crate) struct Reference {
    sets: Vec<Vec<Mean>>,
    pub(crate) mean: Vec<Mean>,
}

impl Reference {
    pub(crate) fn new(scene: &Scene, region: Region, frame: f64, strata: u32) -> Result<Self, Error> {
        let set = |seed: u16| means(scene, region, frame, strata, u64::from(seed) + 1);
        let sets = (0..SETS).map(set).collect::<Result<Vec<_>, _>>()?;
        let share = 1.0 / f32::from(SETS);
        let mut mean = vec![Mean::default(); region.pixels()];
        for set in &sets {
            for (mean, of_set) in mean.iter_mut().zip(set) {
                for (sum, radiance) in mean.radiance.iter_mut().zip(of_set.radiance) {
                    *sum += share * radiance;
                }
                mean.diffuse += share * of_set.diffuse;
                mean.coverage += share * of_set.coverage;
            }
        }
        Ok(Self { sets, mean })
    }

    /// The standard error of a pixel, from the differences of the sets.
    pub(crate) fn standard_error(&self, pixel: usize, material: usize) -> f64 {
        let mean = f64::from(self.mean[pixel].radiance[material]);
        let deviation = |set: &Vec<Mean>| (f64::from(set[pixel].radiance[material]) - mean).powi(2);
        let squares: f64 = self.sets.iter().map(deviation).sum();
        (squares / f64::from(SETS * (SETS - 1))).sqrt()
    }
}
