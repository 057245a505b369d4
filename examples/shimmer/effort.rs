//! How much work it shall be.

/// Sizes and numbers of samples.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// Of the pictures, in pixels: a multiple of 20, so that pictures and their quarters are of whole 2×2 quads.
    pub(crate) height: usize,
    /// The reference is the mean of four sets of strata × strata samples.
    pub(crate) strata: u32,
    /// Of the camera's move.
    pub(crate) frames: u32,
    /// Of each timing, of which the shortest counts.
    pub(crate) repetitions: u32,
}

impl Effort {
    pub(crate) const FULL: Self = Self { height: 200, strata: 16, frames: 8, repetitions: 15 };
    pub(crate) const QUICK: Self = Self { height: 100, strata: 8, frames: 3, repetitions: 3 };
}
