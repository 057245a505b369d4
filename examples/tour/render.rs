//! Pictures of scenes, on all cores.

use core::sync::atomic::{AtomicU32, Ordering};
use std::thread;

use indicatif::ProgressBar;
use microsurface::glam::{Vec2, Vec3, Vec4};

use crate::image::Image;
use crate::integrator::{Faults, radiance};
use crate::sampler::Sampler;
use crate::scene::Scene;

/// The light that the paths through one row of pixels give to the row above, to their own and to
/// the row below: sums of weighted radiance, and of weights.
type Row = [Vec<Vec4>; 3];

/// The picture, and what was wrong with its numbers. It does not depend on the number of threads.
pub(crate) fn render(
    scene: &Scene,
    [width, height]: [u32; 2],
    samples: u32,
    progress: &ProgressBar,
) -> (Image, Faults) {
    let (rows, mut faults) =
        each_row(height, progress, |y, faults| row(scene, y, [width, height], samples, faults));
    let pixels = gathered(rows, [width as usize, height as usize]);
    for pixel in &pixels {
        faults.check(&pixel.to_array());
    }
    (Image { width, height, pixels }, faults)
}

/// The results of `row` for each row of a picture, from the top, on all cores; and what was wrong
/// with its numbers.
pub(crate) fn each_row<T: Send>(
    height: u32,
    progress: &ProgressBar,
    row: impl Fn(u32, &mut Faults) -> T + Sync,
) -> (Vec<T>, Faults) {
    let threads = thread::available_parallelism().map_or(1, core::num::NonZero::get);
    let next_row = AtomicU32::new(0);
    let work = || {
        let mut rows = Vec::new();
        let mut faults = Faults::default();
        loop {
            let y = next_row.fetch_add(1, Ordering::Relaxed);
            if y >= height {
                return (rows, faults);
            }
            rows.push((y, row(y, &mut faults)));
            progress.inc(1);
        }
    };
    let mut rows = Vec::new();
    let mut faults = Faults::default();
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        for worker in workers {
            let (worker_rows, worker_faults) = worker.join().expect("a worker does not panic");
            faults += worker_faults;
            rows.extend(worker_rows);
        }
    });
    rows.sort_unstable_by_key(|&(y, _)| y);
    (rows.into_iter().map(|(_, row)| row).collect(), faults)
}

/// Follows the paths through a row of pixels.
fn row(scene: &Scene, y: u32, [width, height]: [u32; 2], samples: u32, faults: &mut Faults) -> Row {
    let size = Vec2::new(width as f32, height as f32);
    let mut sums = [0; 3].map(|_| vec![Vec4::ZERO; width as usize]);
    for x in 0..width {
        let seed = u64::from(y) << 32 | u64::from(x);
        for index in 0..samples {
            let mut sampler = Sampler::new(seed, index);
            let within = sampler.next();
            let place = Vec2::new(x as f32, y as f32) + within;
            let ray = scene.camera.ray((place - 0.5 * size) / size.y);
            let value = radiance(scene, ray, samples as f32 / 16.0, &mut sampler, faults).extend(1.0);
            let (weights_x, weights_y) = (tents(within.x), tents(within.y));
            for (sums, weight_y) in sums.iter_mut().zip(weights_y) {
                for (i, weight_x) in weights_x.into_iter().enumerate() {
                    if let Some(sum) = (x as usize + i).checked_sub(1).and_then(|x| sums.get_mut(x)) {
                        *sum += value * (weight_x * weight_y);
                    }
                }
            }
        }
    }
    sums
}

/// The weights of a place t ∈ [0, 1) inside a pixel for the pixel before, its own and the next:
/// tents two pixels wide. A path counts for up to four pixels, which quiets the noise by a third.
fn tents(t: f32) -> [f32; 3] {
    let from_centre = t - 0.5;
    [(-from_centre).max(0.0), 1.0 - from_centre.abs(), from_centre.max(0.0)]
}

/// The weighted means.
fn gathered(rows: Vec<Row>, [width, height]: [usize; 2]) -> Vec<Vec3> {
    let mut sums = vec![Vec4::ZERO; width * height];
    for (y, given) in rows.into_iter().enumerate() {
        for (i, line) in given.into_iter().enumerate() {
            let Some(to) = (y + i).checked_sub(1).filter(|&to| to < height) else { continue };
            for (sum, value) in sums[to * width..].iter_mut().zip(line) {
                *sum += value;
            }
        }
    }
    sums.into_iter().map(|sum| sum.truncate() / sum.w).collect()
}
