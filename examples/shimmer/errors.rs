//! How far a picture is from the reference.

use crate::picture::Picture;
use crate::pixel::Pixel;
use crate::sampled::Mean;

/// Half vectors with a smaller cosine to the normal count as grazing.
pub(crate) const GRAZING: f32 = 0.5;

#[derive(Clone, Copy)]
pub(crate) struct Errors {
    /// Root mean square error of radiance.
    pub(crate) rmse: f64,
    /// The same of r/(1 + r), in which one firefly does not decide all.
    pub(crate) toned: f64,
    /// All radiance over that of the reference.
    pub(crate) energy: f64,
    /// Mean error at grazing half vectors over the mean radiance of the reference there.
    pub(crate) grazing: f64,
    /// Pixels that are NaN, infinite or negative.
    pub(crate) faults: usize,
}

/// Compares radiance with a reference. Pixels at the silhouette, which are covered in part, do not
/// count: a filter of normals does nothing for them.
pub(crate) fn errors(
    picture: &Picture,
    reference: &[Mean],
    material: usize,
    pixels: &[Option<Pixel>],
) -> Errors {
    let (mut count, mut squares, mut toned) = (0.0, 0.0, 0.0);
    let (mut sum, mut reference_sum) = (0.0, 0.0);
    let (mut grazing, mut reference_grazing) = (0.0, 0.0);
    let mut faults = 0;
    for ((&radiance, mean), pixel) in picture.radiance.iter().zip(reference).zip(pixels) {
        if !(radiance.is_finite() && radiance >= 0.0) {
            faults += 1;
        }
        let Some(pixel) = pixel.filter(|_| mean.coverage >= 1.0) else { continue };
        let (x, r) = (f64::from(radiance), f64::from(mean.radiance[material]));
        count += 1.0;
        squares += (x - r).powi(2);
        toned += (tone(x) - tone(r)).powi(2);
        sum += x;
        reference_sum += r;
        if pixel.m.z.abs() < GRAZING {
            grazing += (x - r).abs();
            reference_grazing += r;
        }
    }
    Errors {
        rmse: (squares / count).sqrt(),
        toned: (toned / count).sqrt(),
        energy: sum / reference_sum,
        grazing: grazing / reference_grazing,
        faults,
    }
}

fn tone(radiance: f64) -> f64 {
    radiance / (1.0 + radiance)
}
