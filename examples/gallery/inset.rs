//! A drawing of what a map does to the unit square, in the corner of a picture.

use microsurface::glam::{Vec2, Vec3};

use crate::image::Image;

/// Lines of the grid, one more than cells.
const LINES: usize = 11;
/// Straight pieces of a line: maps need not be linear.
const PIECES: usize = 40;

/// Draws the unit square and its 10×10 grid, moved by `map`, into the top right corner.
pub(crate) fn draw(image: &mut Image, map: impl Fn(Vec2) -> Vec2) {
    let polyline = |from: Vec2, to: Vec2| {
        let point = move |i: usize| from.lerp(to, i as f32 / PIECES as f32);
        (0..PIECES).map(move |i| [point(i), point(i + 1)])
    };
    let at = |i: usize| i as f32 / (LINES - 1) as f32;
    let segments: Vec<[Vec2; 2]> = (0..LINES)
        .flat_map(|i| {
            polyline(Vec2::new(at(i), 0.0), Vec2::new(at(i), 1.0))
                .chain(polyline(Vec2::new(0.0, at(i)), Vec2::new(1.0, at(i))))
        })
        .map(|ends| ends.map(&map))
        .collect();
    let bound = |(low, high): (Vec2, Vec2), p: &Vec2| (low.min(*p), high.max(*p));
    let (low, high) = segments.iter().flatten().fold((Vec2::INFINITY, Vec2::NEG_INFINITY), bound);

    let (size, margin) = (image.height as f32 * 0.38, image.height as f32 * 0.03);
    let corner = Vec2::new(image.width as f32 - size, 0.0);
    let scale = (size - 2.0 * margin) / (high - low).max_element();
    let centre = corner + Vec2::splat(0.5 * size);
    // v runs up, rows run down.
    let placed = |p: Vec2| centre + (p - 0.5 * (low + high)) * Vec2::new(scale, -scale);
    let segments: Vec<[Vec2; 2]> = segments.into_iter().map(|ends| ends.map(placed)).collect();

    for y in 0..size as usize {
        for x in corner.x as usize..image.width as usize {
            let pixel = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let distance = segments.iter().fold(f32::INFINITY, |d, s| d.min(distance(pixel, *s)));
            let ink = (0.9 - distance).clamp(0.0, 0.7);
            image.pixels[y * image.width as usize + x] = Vec3::splat(0.004).lerp(Vec3::splat(1.5), ink);
        }
    }
}

fn distance(p: Vec2, [a, b]: [Vec2; 2]) -> f32 {
    let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    p.distance(a.lerp(b, t))
}
