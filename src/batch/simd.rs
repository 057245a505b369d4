//! The instruction set that batches use: which vectors the processor has, and a limit for tests.
//!
//! The crate's only unsafe code is here: calls of functions that were compiled for an extension of
//! the instruction set, after asking the processor whether it has it.
#![allow(
    unsafe_code,
    reason = "calling a function compiled for a target feature; each call says why it is sound"
)]

/// A loop that is compiled for each level.
pub(super) trait Vectorized {
    fn run(self);
}

/// A level of the instruction set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The level the build was compiled for.
    Target,
    /// AVX2: 8 f32, 4 f64.
    Avx2,
    /// AVX-512 F, BW, DQ and VL: 16 f32, 8 f64.
    Avx512,
}

#[cfg(not(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64"))))]
use fixed as chosen;
#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
use x86 as chosen;

pub(super) use chosen::run;
pub use chosen::{highest, level, limit_to};

/// Nothing to choose from.
#[cfg(not(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64"))))]
mod fixed {
    use super::{Level, Vectorized};

    /// The highest level of this processor: the build's own.
    #[must_use]
    pub fn highest() -> Level {
        Level::Target
    }

    /// Limits all batches of the process to a level; there is but one here.
    #[expect(clippy::must_use_candidate, reason = "called for its effect")]
    pub fn limit_to(_: Level) -> Level {
        Level::Target
    }

    /// The level in use.
    #[must_use]
    pub fn level() -> Level {
        Level::Target
    }

    #[inline]
    pub(crate) fn run(batch: impl Vectorized) {
        batch.run();
    }
}

#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
mod x86 {
    use core::sync::atomic::{AtomicU8, Ordering};

    use super::{Level, Vectorized};

    /// The level in use, as a number one higher; 0 before the processor has been asked. Only
    /// [`set`] writes it, and only what [`highest`] allows.
    static LEVEL: AtomicU8 = AtomicU8::new(0);

    /// The highest level of this processor.
    #[must_use]
    pub fn highest() -> Level {
        let avx2 = std::is_x86_feature_detected!("avx2");
        let avx512 = std::is_x86_feature_detected!("avx512f")
            && std::is_x86_feature_detected!("avx512bw")
            && std::is_x86_feature_detected!("avx512dq")
            && std::is_x86_feature_detected!("avx512vl");
        match (avx2, avx512) {
            (true, true) => Level::Avx512,
            (true, false) => Level::Avx2,
            (false, _) => Level::Target,
        }
    }

    /// Limits all batches of the process to a level, for tests and measurements; what the processor
    /// does not have is not used. Returns the level in use from here on.
    #[expect(clippy::must_use_candidate, reason = "called for its effect")]
    pub fn limit_to(limit: Level) -> Level {
        set(limit.min(highest()))
    }

    fn set(level: Level) -> Level {
        let number = match level {
            Level::Target => 1,
            Level::Avx2 => 2,
            Level::Avx512 => 3,
        };
        LEVEL.store(number, Ordering::Relaxed);
        level
    }

    /// The level in use.
    #[inline]
    #[must_use]
    pub fn level() -> Level {
        match LEVEL.load(Ordering::Relaxed) {
            0 => set(highest()),
            3 => Level::Avx512,
            2 => Level::Avx2,
            _ => Level::Target,
        }
    }

    #[inline]
    pub(crate) fn run(batch: impl Vectorized) {
        match level() {
            // SAFETY: `level` is at most `highest`, which asked the processor for each of the
            // features.
            Level::Avx512 => unsafe { avx512(batch) },
            // SAFETY: the same.
            Level::Avx2 => unsafe { avx2(batch) },
            Level::Target => batch.run(),
        }
    }

    // Without `fma`: nothing is contracted, so it would change nothing.
    #[target_feature(enable = "avx2")]
    fn avx2(batch: impl Vectorized) {
        batch.run();
    }

    #[target_feature(enable = "avx2,avx512f,avx512bw,avx512dq,avx512vl")]
    fn avx512(batch: impl Vectorized) {
        batch.run();
    }
}
