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

/// The part of a [`Polar`] chart whose normals reflect `wo` above the horizon, stretched over the
/// unit square.
///
/// wi.z > 0 is |t + wo.xy/wo.z| < 1/wo.z for the slope t, a disk that contains t = 0: along every
/// azimuth the slopes reach from 0 to its rim, a share p = F(x)/F(x at the rim) of that way, and
/// the first coordinate is 1 − √(1 − p). The density of reflected directions has no discontinuity
/// inside, and that of visible normals, which grows with the slope like (1 − F)^{−1/2}, no
/// singularity.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reflecting {
    pub(crate) polar: Polar,
    pub(crate) wo: [f64; 3],
}

impl Reflecting {
    /// The first coordinate u₁ of the polar chart at the rim.
    fn rim(&self, azimuth: f64) -> f64 {
        let (sin, cos) = azimuth.sin_cos();
        let [x, y] = self.polar.inverse.slope([cos, sin]);
        // r² (x² + y²) + 2 b r = 1 for the radius r, in the form without cancellation.
        let (a, b) = (x * x + y * y, (x * self.wo[0] + y * self.wo[1]) / self.wo[2]);
        let root = (a + b * b).sqrt();
        let r = if b > 0.0 { 1.0 / (b + root) } else { (root - b) / a };
        self.polar.radial.cdf(r * r)
    }
}

impl Chart for Reflecting {
    fn coordinates(&self, m: [f64; 3]) -> [f64; 2] {
        let [x, azimuth] = self.polar.coordinates(m);
        [1.0 - (1.0 - self.polar.radial.cdf(x) / self.rim(azimuth)).max(0.0).sqrt(), azimuth]
    }

    fn quantile(&self, axis: usize, u: f64) -> f64 {
        if axis == 0 { u } else { self.polar.quantile(1, u) }
    }

    fn cdf(&self, axis: usize, coordinate: f64) -> f64 {
        if axis == 0 { coordinate } else { self.polar.cdf(1, coordinate) }
    }

    fn point(&self, [u, azimuth]: [f64; 2]) -> ([f64; 3], f64) {
        let (rim, share) = (self.rim(azimuth), u * (2.0 - u));
        let (m, solid_angle) = self.polar.point([self.polar.radial.quantile(share * rim), azimuth]);
        (m, 2.0 * (1.0 - u) * rim * solid_angle)
    }
}
