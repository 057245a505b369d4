//! What pixels do while the camera moves by parts of a pixel.

/// Collects frames of one method beside those of the reference.
#[derive(Default)]
pub(crate) struct Flicker {
    previous: Option<[Vec<f32>; 2]>,
    /// Sums of absolute differences from frame to frame, of the method and of the reference.
    changes: [f64; 2],
    /// The brightest pixel of each frame over that of the reference.
    peaks: Vec<f64>,
}

impl Flicker {
    pub(crate) fn add(&mut self, radiance: &[f32], reference: &[f32]) {
        let peak = |frame: &[f32]| f64::from(frame.iter().copied().fold(0.0, f32::max));
        self.peaks.push(peak(radiance) / peak(reference));
        let frames = [radiance.to_vec(), reference.to_vec()];
        if let Some(previous) = &self.previous {
            for ((change, before), now) in self.changes.iter_mut().zip(previous).zip(&frames) {
                let difference = |(a, b): (&f32, &f32)| f64::from((a - b).abs());
                *change += before.iter().zip(now).map(difference).sum::<f64>();
            }
        }
        self.previous = Some(frames);
    }

    /// Mean absolute change from frame to frame over that of the reference: 1 is right, more is
    /// flicker.
    pub(crate) fn change(&self) -> f64 {
        self.changes[0] / self.changes[1]
    }

    /// The lowest and the highest peak over that of the reference in the same frame.
    ///
    /// Kaplanyan et al. 2016, Fig. 12, plots these.
    pub(crate) fn peaks(&self) -> [f64; 2] {
        let fold = |start: f64, pick: fn(f64, f64) -> f64| self.peaks.iter().copied().fold(start, pick);
        [fold(f64::INFINITY, f64::min), fold(0.0, f64::max)]
    }
}
