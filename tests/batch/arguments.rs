//! What batches and calls are given.

use microsurface::Real;
use microsurface::batch::{Directions, Numbers};

/// Directions, some below the horizon, on it and straight up, and some with a NaN; random numbers
/// with 0 among them.
pub(crate) struct Arguments<T> {
    pub(crate) wi: [Vec<T>; 3],
    pub(crate) wo: [Vec<T>; 3],
    pub(crate) u: [Vec<T>; 2],
}

impl<T: Real> Arguments<T> {
    pub(crate) fn new(len: usize, seed: u64) -> Self {
        Self::with(len, seed, true)
    }

    /// Directions above the horizon, of which batches draw samples by what usually suffices, but
    /// for one in the second block.
    pub(crate) fn usual(len: usize, seed: u64) -> Self {
        Self::with(len, seed, false)
    }

    fn with(len: usize, seed: u64, special: bool) -> Self {
        let mut state = seed;
        let mut random = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        let mut directions = |shift: usize| {
            let mut slices = [const { Vec::new() }; 3];
            for i in 0..len {
                let z = match (i + shift) % 17 {
                    _ if !special => random() * if i == 65 { -1.0 } else { 1.0 },
                    3 => 0.0,
                    5 => -random(),
                    7 => 1.0,
                    9 => 1e-6 * random(),
                    _ => random(),
                };
                let (sin, cos) = (core::f64::consts::TAU * random()).sin_cos();
                let r = (1.0 - z * z).sqrt();
                let nan = if special && (i + shift) % 23 == 11 { f64::NAN } else { 0.0 };
                for (slice, c) in slices.iter_mut().zip([r * cos, r * sin + nan, z]) {
                    slice.push(T::lit(c));
                }
            }
            slices
        };
        let (wi, wo) = (directions(0), directions(4));
        let u = [0, 1].map(|k| {
            let number =
                |i| if (i + k) % 13 == 2 { T::ZERO } else { T::lit(0.618034 * (i + 7 * k) as f64 % 1.0) };
            (0..len).map(number).collect()
        });
        Self { wi, wo, u }
    }

    pub(crate) fn wi(&self) -> Directions<'_, T> {
        borrowed(&self.wi)
    }
    pub(crate) fn wo(&self) -> Directions<'_, T> {
        borrowed(&self.wo)
    }
    pub(crate) fn u(&self) -> Numbers<'_, T> {
        Numbers { x: &self.u[0], y: &self.u[1] }
    }
}

fn borrowed<T>([x, y, z]: &[Vec<T>; 3]) -> Directions<'_, T> {
    Directions { x, y, z }
}

pub(crate) fn direction<T: Real>([x, y, z]: &[Vec<T>; 3], i: usize) -> T::Vec3 {
    [x[i], y[i], z[i]].into()
}

pub(crate) fn numbers<T: Real>([x, y]: &[Vec<T>; 2], i: usize) -> T::Vec2 {
    [x[i], y[i]].into()
}
