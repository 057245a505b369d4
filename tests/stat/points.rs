//! Points of the unit square: random and evenly spread.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// A source of points in [0, 1)².
pub(crate) trait Points {
    /// The i-th point; called in order.
    fn point(&mut self, i: usize) -> [f64; 2];
}

/// Independent points on the grid of the scalar under test: 2⁻²⁴ for f32, so that none rounds to 1,
/// 2⁻⁵³ for f64.
pub(crate) struct Random {
    generator: Pcg64,
    bits: u32,
}

impl Random {
    pub(crate) fn new(seed: u64, bits: u32) -> Self {
        Self { generator: Pcg64::seed_from_u64(seed), bits }
    }

    #[expect(clippy::cast_precision_loss, reason = "at most 53 bits")]
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.generator.next_u64() >> (64 - self.bits)) as f64 / (1_u64 << self.bits) as f64
    }

    /// A direction of the given polar angle in degrees and a random azimuth.
    pub(crate) fn direction(&mut self, degrees: f64) -> [f64; 3] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (sin_phi, cos_phi) = (2.0 * core::f64::consts::PI * self.uniform()).sin_cos();
        [sin * cos_phi, sin * sin_phi, cos]
    }
}

impl Points for Random {
    fn point(&mut self, _: usize) -> [f64; 2] {
        [self.uniform(), self.uniform()]
    }
}

/// The 2ᵏ points (i/2ᵏ, radical inverse of i): one in every elementary interval, 0 included
/// (Hammersley 1960).
pub(crate) struct Hammersley(pub(crate) u32);

impl Points for Hammersley {
    fn point(&mut self, i: usize) -> [f64; 2] {
        let bits = u32::try_from(i).expect("less than 2³² points").reverse_bits();
        [crate::special::count(i) / f64::from(1_u32 << self.0), f64::from(bits) / 2_f64.powi(32)]
    }
}

/// The additive recurrence of the plastic number (Roberts 2018, "The unreasonable effectiveness of
/// quasirandom sequences"), rounded to 2⁻²⁴ so that f32 represents it; its first point is 0.
pub(crate) struct LowDiscrepancy;

impl Points for LowDiscrepancy {
    fn point(&mut self, i: usize) -> [f64; 2] {
        const STEPS: [f64; 2] = [0.754_877_666_246_692_76, 0.569_840_290_998_053_27];
        STEPS.map(|step| {
            let scale = f64::from(1_u32 << 24);
            ((crate::special::count(i) * step).fract() * scale).floor() / scale
        })
    }
}
