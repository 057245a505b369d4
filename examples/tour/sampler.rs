//! Random points in the unit square, evenly spread over the samples of a pixel.

use microsurface::glam::Vec2;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// The random numbers of one path: an Owen-scrambled Sobol sequence for each decision along it.
///
/// Every decision has its own scrambling and its own order of the points, both seeded by the pixel
/// alone, so that pictures do not depend on the number of threads.
///
/// References: Burley 2020, "Practical hash-based Owen scrambling"; Laine and Karras 2011.
pub(crate) struct Sampler {
    seeds: Pcg32,
    index: u32,
}

impl Sampler {
    /// The numbers of the path `index` through the pixel of this seed.
    pub(crate) fn new(seed: u64, index: u32) -> Self {
        Self { seeds: Pcg32::seed_from_u64(seed), index }
    }

    /// The point of the next decision.
    pub(crate) fn next(&mut self) -> Vec2 {
        let (order, seed_x, seed_y) = (self.seeds.next_u32(), self.seeds.next_u32(), self.seeds.next_u32());
        // Any aligned block of the sequence is as evenly spread as the first: 16 bits of the index
        // suffice.
        let index = scrambled(self.index.reverse_bits(), order).reverse_bits() & 0xffff;
        let x = scrambled(index, seed_x).reverse_bits();
        let y = scrambled(sobol_second(index), seed_y).reverse_bits();
        Vec2::new(unit(x), unit(y))
    }
}

/// The top 24 bits as a number in [0, 1).
fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// A permutation in which a bit depends on the bits below it only: Owen's scrambling of the
/// reversed number.
fn scrambled(x: u32, seed: u32) -> u32 {
    let x = x.wrapping_add(seed);
    // An even factor moves information upwards only, and x ^ (even · x) can be undone bit by bit.
    let x = x ^ x.wrapping_mul((seed >> 16) << 1 | 0x5a2c_6e04);
    let x = x ^ x.wrapping_mul(0xb34d_7a52);
    let x = x.wrapping_mul(seed | 1);
    x ^ x.wrapping_mul(0x7c19_e6b8)
}

/// The second dimension of Sobol's sequence, reversed: the primitive polynomial 1 + x.
fn sobol_second(mut index: u32) -> u32 {
    let (mut direction, mut y) = (1_u32, 0);
    while index != 0 {
        if index & 1 != 0 {
            y ^= direction;
        }
        direction ^= direction << 1;
        index >>= 1;
    }
    y
}
