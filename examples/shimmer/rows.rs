//! Rows of pixels, on all cores.

use core::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// A rectangle of pixels of a picture. Its corner is even, so that 2×2 quads are whole.
#[derive(Clone, Copy)]
pub(crate) struct Region {
    /// The height of the whole picture, which is 16 : 10.
    pub(crate) height: usize,
    /// The left upper corner and the size.
    pub(crate) corner: [usize; 2],
    pub(crate) size: [usize; 2],
}

impl Region {
    /// The whole picture.
    pub(crate) fn whole(height: usize) -> Self {
        Self { height, corner: [0, 0], size: [width(height), height] }
    }

    /// A quarter of the picture along each side, from a place in it.
    pub(crate) fn quarter(height: usize, [x, y]: [f64; 2]) -> Self {
        let even = |share: f64, pixels: usize| (share * pixels as f64 / 2.0) as usize * 2;
        let size = [width(height), height];
        Self {
            height,
            corner: [even(x, size[0]), even(y, size[1])],
            size: size.map(|pixels| even(0.25, pixels)),
        }
    }

    pub(crate) fn pixels(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// A place of the picture, in heights of the whole from its centre, from pixels within this
    /// region.
    pub(crate) fn place(&self, x: f64, y: f64) -> [f64; 2] {
        let height = self.height as f64;
        let [left, top] = self.corner.map(|pixels| pixels as f64);
        [(left + x - 0.5 * width(self.height) as f64) / height, (top + y) / height - 0.5]
    }
}

fn width(height: usize) -> usize {
    height * 16 / 10
}

/// The results of `pixel` for each pixel of a region, row by row, on all cores. The result does not
/// depend on their number.
pub(crate) fn each_pixel<T: Send>(region: Region, pixel: impl Fn(usize, usize) -> T + Sync) -> Vec<T> {
    let threads = thread::available_parallelism().map_or(1, core::num::NonZero::get);
    let next_row = AtomicUsize::new(0);
    let work = || {
        let mut rows = Vec::new();
        loop {
            let y = next_row.fetch_add(1, Ordering::Relaxed);
            if y >= region.size[1] {
                return rows;
            }
            rows.push((y, (0..region.size[0]).map(|x| pixel(x, y)).collect::<Vec<T>>()));
        }
    };
    let mut rows = Vec::new();
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        for worker in workers {
            rows.extend(worker.join().expect("a worker does not panic"));
        }
    });
    rows.sort_unstable_by_key(|&(y, _)| y);
    rows.into_iter().flat_map(|(_, row)| row).collect()
}
