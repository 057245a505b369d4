//! Sums of sines, with their derivatives.

use microsurface::glam::{DMat3, DVec3};

/// One wave: amplitude · sin(k·p + phase).
struct Wave {
    k: DVec3,
    amplitude: f64,
    phase: f64,
}

/// A sum of sines of a place.
pub(crate) struct Waves(Vec<Wave>);

impl Waves {
    /// Waves of these wave vectors, each of the same steepness amplitude · |k|. The phases are the golden ratio's
    /// multiples.
    pub(crate) fn of_steepness(steepness: f64, wave_vectors: impl IntoIterator<Item = DVec3>) -> Self {
        let wave = |(i, k): (u32, DVec3)| Wave {
            k,
            amplitude: steepness / k.length(),
            phase: core::f64::consts::TAU * (f64::from(i) * 0.618_033_988_75).fract(),
        };
        Self((0..).zip(wave_vectors).map(wave).collect())
    }

    /// Bounds of the value and of the second derivative in any direction.
    pub(crate) fn bounds(&self) -> [f64; 2] {
        let curvature = |wave: &Wave| wave.amplitude * wave.k.length_squared();
        [self.0.iter().map(|wave| wave.amplitude).sum(), self.0.iter().map(curvature).sum()]
    }

    pub(crate) fn value_and_gradient(&self, p: DVec3) -> (f64, DVec3) {
        self.0.iter().fold((0.0, DVec3::ZERO), |(value, gradient), wave| {
            let (sin, cos) = (wave.k.dot(p) + wave.phase).sin_cos();
            (value + wave.amplitude * sin, gradient + wave.k * (wave.amplitude * cos))
        })
    }

    /// The gradient and the matrix of second derivatives.
    pub(crate) fn derivatives(&self, p: DVec3) -> (DVec3, DMat3) {
        let mut gradient = DVec3::ZERO;
        let mut hessian = DMat3::ZERO;
        for &Wave { k, amplitude, phase } in &self.0 {
            let (sin, cos) = (k.dot(p) + phase).sin_cos();
            gradient += k * (amplitude * cos);
            let s = k * (-amplitude * sin);
            hessian += DMat3::from_cols(k * s.x, k * s.y, k * s.z);
        }
        (gradient, hessian)
    }
}
