//! The worst of what a test has seen.

/// The largest error, and where it was seen first.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Worst<I = String> {
    pub(crate) error: f64,
    pub(crate) at: I,
    /// How many errors were seen.
    pub(crate) count: u64,
}

impl<I> Worst<I> {
    /// Takes in the size of an error; NaN is ∞.
    pub(crate) fn see(&mut self, error: f64, at: impl FnOnce() -> I) {
        let error = if error.is_nan() { f64::INFINITY } else { error.abs() };
        self.count += 1;
        if self.count == 1 || error > self.error {
            (self.error, self.at) = (error, at());
        }
    }

    /// The worse of two.
    pub(crate) fn or(self, other: Self) -> Self {
        let count = self.count + other.count;
        Self { count, ..if other.error > self.error { other } else { self } }
    }
}
