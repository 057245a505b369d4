//! What shading costs, with its filter and without the geometry.

use core::hint::black_box;
use std::time::Instant;

use crate::methods::Method;
use crate::pixel::Pixel;

/// Nanoseconds per pixel, the shortest of some repetitions.
pub(crate) fn nanoseconds(method: &Method, pixels: &[Option<Pixel>], repetitions: u32) -> f64 {
    let hit: Vec<Pixel> = pixels.iter().flatten().copied().collect();
    let mut radiance = vec![0.0; hit.len()];
    let once = |_| {
        let start = Instant::now();
        (method.shade)(black_box(&hit), &mut radiance);
        black_box(&mut radiance);
        start.elapsed().as_secs_f64()
    };
    let shortest = (0..repetitions).map(once).fold(f64::INFINITY, f64::min);
    shortest / hit.len() as f64 * 1e9
}
