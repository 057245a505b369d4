//! Pictures in rows and columns, numbered.

use microsurface::glam::Vec3;

use crate::image::Image;
use crate::rows::Region;
use crate::study::Study;

const COLUMNS: usize = 4;
/// Between pictures.
const GAP: usize = 3;
/// Crops are enlarged by this.
const ZOOM: usize = 3;
/// Digits, three pixels wide, from the top row down.
const DIGITS: [u16; 10] =
    [0o75557, 0o26227, 0o71747, 0o71717, 0o55711, 0o74717, 0o74757, 0o71111, 0o75757, 0o75717];

/// The reference, number 0, and the methods with the numbers of the table.
pub(crate) fn whole(study: &Study) -> Image {
    joined(
        images(study)
            .map(|image| enlarged(image, [0, 0], [image.width, image.height].map(|n| n as usize), 1)),
    )
}

/// The same of a part, enlarged.
pub(crate) fn crop(study: &Study, region: Region) -> Image {
    joined(images(study).map(|image| enlarged(image, region.corner, region.size, ZOOM)))
}

/// The reference and these methods, three in a row, without numbers.
pub(crate) fn selected(study: &Study, names: [&str; 5]) -> Image {
    let chosen = names.iter().filter_map(|name| study.rows.iter().find(|row| row.name == *name));
    let images = core::iter::once(&study.reference).chain(chosen.map(|row| &row.image));
    let copied = |image: &Image| enlarged(image, [0, 0], [image.width, image.height].map(|n| n as usize), 1);
    in_columns::<3>(images.map(copied).collect())
}

fn images(study: &Study) -> impl Iterator<Item = &Image> {
    core::iter::once(&study.reference).chain(study.rows.iter().map(|row| &row.image))
}

fn enlarged(image: &Image, corner: [usize; 2], size: [usize; 2], zoom: usize) -> Image {
    let [width, height] = size.map(|pixels| pixels * zoom);
    let pixel = |i: usize| {
        let [x, y] = [corner[0] + i % width / zoom, corner[1] + i / width / zoom];
        image.pixels[y * image.width as usize + x]
    };
    let pixels = (0..width * height).map(pixel).collect();
    Image { width: width as u32, height: height as u32, pixels }
}

/// All pictures as one, their numbers in their corners.
fn joined(images: impl Iterator<Item = Image>) -> Image {
    let numbered = images.enumerate().map(|(i, mut image)| {
        number(&mut image, i);
        image
    });
    in_columns::<COLUMNS>(numbered.collect())
}

/// All pictures as one, with lines between them.
fn in_columns<const COLUMNS: usize>(images: Vec<Image>) -> Image {
    let size = [images[0].width as usize, images[0].height as usize];
    let whole = |count: usize, size: usize| count * (size + GAP) - GAP;
    let total = [whole(COLUMNS, size[0]), whole(images.len().div_ceil(COLUMNS), size[1])];
    let mut pixels = vec![Vec3::splat(0.05); total[0] * total[1]];
    for (i, image) in images.into_iter().enumerate() {
        let [x, y] = [(i % COLUMNS) * (size[0] + GAP), (i / COLUMNS) * (size[1] + GAP)];
        for (row, line) in image.pixels.chunks_exact(size[0]).enumerate() {
            let start = (y + row) * total[0] + x;
            pixels[start..start + size[0]].copy_from_slice(line);
        }
    }
    Image { width: total[0] as u32, height: total[1] as u32, pixels }
}

/// Writes a number below 100 into the left upper corner.
fn number(image: &mut Image, number: usize) {
    const SCALE: usize = 2;
    let width = image.width as usize;
    for (place, digit) in [number / 10, number % 10].into_iter().enumerate() {
        for y in 0..5 * SCALE {
            for x in 0..3 * SCALE {
                let bit = 14 - (y / SCALE * 3 + x / SCALE);
                if DIGITS[digit] >> bit & 1 == 1 {
                    image.pixels[(4 + y) * width + 4 + place * 4 * SCALE + x] = Vec3::splat(4.0);
                }
            }
        }
    }
}
