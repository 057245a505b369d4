//! Everything that is measured of a scene.

use microsurface::Error;

use crate::effort::Effort;
use crate::errors::{Errors, errors};
use crate::flicker::Flicker;
use crate::image::Image;
use crate::materials::Materials;
use crate::methods::methods;
use crate::picture::{Picture, Reference};
use crate::pixel::pixels;
use crate::rows::Region;
use crate::sampled::{Mean, means};
use crate::scene::Scene;
use crate::timing::nanoseconds;

/// The size of the pictures, in pixels: a multiple of 20, so that pictures and their quarters are
/// of whole 2×2 quads.
const HEIGHT: usize = 200;

/// One line of a table.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) errors: Errors,
    pub(crate) flicker: Flicker,
    /// Per pixel; nothing for what is traced.
    pub(crate) nanoseconds: Option<f64>,
    pub(crate) image: Image,
}

/// A scene with one material.
pub(crate) struct Study {
    pub(crate) scene: &'static str,
    pub(crate) material: &'static str,
    /// Supersampling, and then the methods.
    pub(crate) rows: Vec<Row>,
    pub(crate) reference: Image,
    /// The reference's own root mean square error, by the differences of its parts.
    pub(crate) noise: f64,
    /// The share of the pixels whose half vectors are grazing.
    pub(crate) grazing: f64,
    /// What the sheets show enlarged.
    pub(crate) crops: [Region; 2],
}

/// Renders the scene, and its camera's move, with each material.
pub(crate) fn study(scene: &Scene, effort: Effort) -> Result<[Study; 2], Error> {
    let region = Region::whole(HEIGHT);
    let reference = Reference::new(scene, region, 0.0, effort.strata)?;
    let supersampled = supersampled(scene, region, 0.0, effort)?;
    let inputs = pixels(scene, region, 0.0);
    let flickers = flickers(scene, effort)?;
    let mut flickers = flickers.into_iter();

    let methods = methods()?;
    Ok([0, 1].map(|material| {
        let flicker = flickers.next().unwrap_or_default();
        let pictures = supersampled
            .iter()
            .map(|(name, means)| (*name, Picture::of_means(means, material), None))
            .chain(methods[material].iter().map(|method| {
                let time = nanoseconds(method, &inputs, effort.repetitions);
                (method.name, Picture::shaded(&inputs, method), Some(time))
            }));
        let row = |((name, picture, nanoseconds), flicker): ((_, Picture, _), Flicker)| Row {
            name,
            errors: errors(&picture, &reference.mean, material, &inputs),
            flicker,
            nanoseconds,
            image: picture.image(scene, region),
        };
        let hit = inputs.iter().flatten();
        let grazing = hit.clone().filter(|pixel| pixel.m.z.abs() < crate::errors::GRAZING).count();
        let squares = |pixel| reference.standard_error(pixel, material).powi(2);
        Study {
            scene: scene.name,
            material: Materials::NAMES[material],
            rows: pictures.zip(flicker).map(row).collect(),
            reference: Picture::of_means(&reference.mean, material).image(scene, region),
            noise: ((0..region.pixels()).map(squares).sum::<f64>() / hit.clone().count() as f64).sqrt(),
            grazing: grazing as f64 / hit.count() as f64,
            crops: scene.crops.map(|corner| Region::quarter(HEIGHT, corner)),
        }
    }))
}

/// Means of the few samples that a filter competes with, unfiltered.
fn supersampled(
    scene: &Scene,
    region: Region,
    frame: f64,
    effort: Effort,
) -> Result<Vec<(&'static str, Vec<Mean>)>, Error> {
    let sampled = |&(strata, name)| Ok((name, means(scene, region, frame, strata, 0)?));
    effort.supersampled.iter().map(sampled).collect()
}

/// The flicker of each row's highlights with each material.
fn flickers(scene: &Scene, effort: Effort) -> Result<[Vec<Flicker>; 2], Error> {
    let region = Region::quarter(HEIGHT, scene.crops[0]);
    let methods = methods()?;
    let mut flickers = [0, 1].map(|material: usize| {
        let rows = methods[material].len() + effort.supersampled.len();
        (0..rows).map(|_| Flicker::default()).collect::<Vec<_>>()
    });
    for frame in 0..effort.frames {
        let frame = f64::from(frame);
        let reference = Reference::new(scene, region, frame, effort.strata)?;
        let supersampled = supersampled(scene, region, frame, effort)?;
        let inputs = pixels(scene, region, frame);
        for (material, flickers) in flickers.iter_mut().enumerate() {
            let right = Picture::of_means(&reference.mean, material).radiance;
            let shaded = methods[material].iter().map(|method| Picture::shaded(&inputs, method));
            let sampled = supersampled.iter().map(|(_, means)| Picture::of_means(means, material));
            let pictures = sampled.chain(shaded);
            for (flicker, picture) in flickers.iter_mut().zip(pictures) {
                flicker.add(&picture.radiance, &right);
            }
        }
    }
    Ok(flickers)
}
