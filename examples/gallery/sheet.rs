//! Figures: pictures in rows and columns.

use indicatif::ProgressBar;
use microsurface::glam::Vec3;

use crate::image::Image;
use crate::integrator::Faults;
use crate::render::render;
use crate::scene::Scene;

/// How much work a figure is worth.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// Of the sizes of the full pictures.
    scale: f32,
    samples: u32,
}

impl Effort {
    pub(crate) const FULL: Self = Self { scale: 1.0, samples: 16 };
    pub(crate) const QUICK: Self = Self { scale: 0.2, samples: 4 };

    /// This many times the samples.
    pub(crate) const fn times(self, factor: u32) -> Self {
        Self { samples: self.samples * factor, ..self }
    }
}

/// Pictures of one size, row by row.
pub(crate) struct Sheet {
    columns: usize,
    pub(crate) images: Vec<Image>,
    /// What was wrong with the numbers.
    pub(crate) faults: Faults,
}

impl Sheet {
    pub(crate) fn new(columns: usize) -> Self {
        Self { columns, images: Vec::new(), faults: Faults::default() }
    }

    /// Renders the next picture; the size is that of the full effort.
    pub(crate) fn render(&mut self, scene: &Scene, size: [u32; 2], effort: Effort) {
        let size = size.map(|pixels| (pixels as f32 * effort.scale) as u32);
        let (image, faults) = render(scene, size, effort.samples, &ProgressBar::hidden());
        self.images.push(image);
        self.faults += faults;
    }

    /// All pictures as one, with dark lines between them.
    pub(crate) fn joined(&self) -> Image {
        const GAP: usize = 2;
        let [width, height] = [self.images[0].width as usize, self.images[0].height as usize];
        let whole = |count: usize, size: usize| count * (size + GAP) - GAP;
        let total = [whole(self.columns, width), whole(self.images.len() / self.columns, height)];
        let mut pixels = vec![Vec3::ZERO; total[0] * total[1]];
        for (i, image) in self.images.iter().enumerate() {
            let [x, y] = [(i % self.columns) * (width + GAP), (i / self.columns) * (height + GAP)];
            for (row, line) in image.pixels.chunks_exact(width).enumerate() {
                let start = (y + row) * total[0] + x;
                pixels[start..start + width].copy_from_slice(line);
            }
        }
        Image { width: total[0] as u32, height: total[1] as u32, pixels }
    }
}
