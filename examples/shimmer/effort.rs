//! How much work it shall be.

/// Sizes and numbers of samples.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// The reference is the mean of four sets of strata × strata samples.
    pub(crate) strata: u32,
    /// What it is compared with: strata × strata samples and their name.
    pub(crate) supersampled: &'static [(u32, &'static str)],
    /// Of the camera's move.
    pub(crate) frames: u32,
    /// Of each timing, of which the shortest counts.
    pub(crate) repetitions: u32,
}

pub(crate) const SIXTEEN: &str = "16 samples";

impl Effort {
    pub(crate) const FULL: Self = Self {
        strata: 16,
        supersampled: &[(2, "4 samples"), (4, SIXTEEN), (8, "64 samples")],
        frames: 8,
        repetitions: 9,
    };
    /// The pictures are as large: what a pixel covers decides everything here.
    pub(crate) const QUICK: Self =
        Self { strata: 4, supersampled: &[(4, SIXTEEN)], frames: 3, repetitions: 1 };
}
