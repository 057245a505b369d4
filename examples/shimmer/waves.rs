//! Sums of sines, with their derivatives.

use core::array::from_fn;
use core::f64::consts::TAU;

use microsurface::elementary::sin_cos_turns;
use microsurface::glam::{DMat3, DVec3};

/// The sum of amplitude · sin(k·p + phase) over N waves.
///
/// Arrays of each coordinate, so that the loop over all sines becomes vector code.
pub(crate) struct Waves<const N: usize> {
    k: [[f64; N]; 3],
    amplitude: [f64; N],
    /// In turns.
    phase: [f64; N],
}

impl<const N: usize> Waves<N> {
    /// Waves of these wave vectors, each of the same steepness amplitude · |k|. The phases are the
    /// golden ratio's multiples.
    pub(crate) fn of_steepness(steepness: f64, wave_vector: impl Fn(f64) -> DVec3) -> Self {
        let vectors: [DVec3; N] = from_fn(|i| wave_vector(i as f64));
        Self {
            k: from_fn(|axis| vectors.map(|k| k[axis])),
            amplitude: vectors.map(|k| steepness / k.length()),
            phase: from_fn(|i| (i as f64 * 0.618_033_988_75).fract()),
        }
    }

    fn wave_vector(&self, i: usize) -> DVec3 {
        DVec3::new(self.k[0][i], self.k[1][i], self.k[2][i])
    }

    /// Bounds of the value and of the second derivative in any direction.
    pub(crate) fn bounds(&self) -> [f64; 2] {
        let curvature = |i: usize| self.amplitude[i] * self.wave_vector(i).length_squared();
        [self.amplitude.iter().sum(), (0..N).map(curvature).sum()]
    }

    fn sines(&self, p: DVec3) -> [(f64, f64); N] {
        let [x, y, z] = (p * (1.0 / TAU)).to_array();
        let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let turns = self.k[0][i] * x + self.k[1][i] * y + self.k[2][i] * z + self.phase[i];
            let (sin, cos) = sin_cos_turns(turns);
            sines[i] = self.amplitude[i] * sin;
            cosines[i] = self.amplitude[i] * cos;
        }
        from_fn(|i| (sines[i], cosines[i]))
    }

    pub(crate) fn value_and_gradient(&self, p: DVec3) -> (f64, DVec3) {
        self.sines(p)
            .into_iter()
            .enumerate()
            .fold((0.0, DVec3::ZERO), |(value, gradient), (i, (sin, cos))| {
                (value + sin, gradient + self.wave_vector(i) * cos)
            })
    }

    /// The matrix of second derivatives.
    pub(crate) fn hessian(&self, p: DVec3) -> DMat3 {
        self.sines(p).into_iter().enumerate().fold(DMat3::ZERO, |hessian, (i, (sin, _))| {
            let k = self.wave_vector(i);
            let s = k * -sin;
            hessian + DMat3::from_cols(k * s.x, k * s.y, k * s.z)
        })
    }
}
