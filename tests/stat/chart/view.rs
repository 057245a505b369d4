//! Visible normals: the slope along the view and the slope across it.

use core::f64::consts::PI;

use super::{Chart, Inverse, root};
use crate::rows::Distribution;
use crate::special::{erfc, erfcx};

/// The two profiles whose visible slopes separate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum VisibleProfile {
    Ggx,
    Beckmann,
}

impl VisibleProfile {
    /// The profile of a distribution without a width of its own.
    pub(crate) fn of(distribution: Distribution) -> Self {
        if distribution.gamma == f64::INFINITY { Self::Beckmann } else { Self::Ggx }
    }
}

/// The chart of the normals visible from w.
///
/// With the profile's slope x along R w and y across it, and ν = w.z/|R w|, a facet is visible
/// where x < ν and the density of visible slopes is (ν − x) P22(x, y)/∫. For both profiles it is a
/// product: x has the density (ν − x) P₂(x)/∫ with P₂ = ½(1 + x²)^{−3/2} (GGX) or e^{−x²}/√π
/// (Beckmann), and the second coordinate τ = y/√(1 + x²) or y has the density (2/π)/(1 + τ²)² or
/// e^{−τ²}/√π. Heitz and d'Eon 2014, §4.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View {
    profile: VisibleProfile,
    inverse: Inverse,
    nu: f64,
    along: [f64; 2],
    /// The integral of (ν − x) P₂, without e^{−ν²} for Beckmann below the horizon.
    norm: f64,
}

impl View {
    pub(crate) fn new(profile: VisibleProfile, inverse: Inverse, w: [f64; 3]) -> Self {
        let [x, y] = inverse.direction(w);
        let s = x.hypot(y);
        let along = if s > 0.0 { [x / s, y / s] } else { [1.0, 0.0] };
        // Beyond ν = 1e9 the marginal is P₂ to rounding.
        let nu = w[2] / s.max(1e-9 * w[2].abs());
        let view = Self { profile, inverse, nu, along, norm: 1.0 };
        Self { norm: view.scaled_integral(nu), ..view }
    }

    /// ν, the slope along the view at the edge of visibility.
    pub(crate) fn nu(&self) -> f64 {
        self.nu
    }

    /// e^{−x²}, times e^{ν²} below the horizon.
    fn gaussian(&self, x: f64) -> f64 {
        let nu = self.nu.min(0.0);
        ((nu - x) * (nu + x)).exp()
    }

    /// ∫_{−∞}^x (ν − x') P₂ dx', scaled like [`gaussian`](Self::gaussian). No term cancels but by
    /// the factor ν² of Beckmann below the horizon, where |ν| stays below 25.
    fn scaled_integral(&self, x: f64) -> f64 {
        let nu = self.nu;
        match (self.profile, x < 0.0) {
            (VisibleProfile::Ggx, true) => {
                let h = x.hypot(1.0);
                0.5 / h * (1.0 + nu / (h - x))
            }
            (VisibleProfile::Ggx, false) => {
                let h = x.hypot(1.0);
                0.5 * (nu * (1.0 + x / h) + 1.0 / h)
            }
            (VisibleProfile::Beckmann, true) => 0.5 * self.gaussian(x) * (1.0 / PI.sqrt() + nu * erfcx(-x)),
            (VisibleProfile::Beckmann, false) => 0.5 * (nu * erfc(-x) + self.gaussian(x) / PI.sqrt()),
        }
    }

    fn density(&self, [x, tau]: [f64; 2]) -> f64 {
        match self.profile {
            VisibleProfile::Ggx => {
                let h2 = 1.0 + x * x;
                let t2 = 1.0 + tau * tau;
                (self.nu - x) / (2.0 * h2 * h2.sqrt() * self.norm) * (2.0 / PI) / (t2 * t2)
            }
            VisibleProfile::Beckmann => {
                (self.nu - x) * self.gaussian(x) / (PI * self.norm) * (-tau * tau).exp()
            }
        }
    }
}

impl Chart for View {
    fn coordinates(&self, m: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.inverse.profile_slope(m);
        let [c, s] = self.along;
        let (along, across) = (c * x + s * y, c * y - s * x);
        match self.profile {
            VisibleProfile::Ggx => [along, across / along.hypot(1.0)],
            VisibleProfile::Beckmann => [along, across],
        }
    }

    /// In asinh of the coordinate.
    fn quantile(&self, axis: usize, u: f64) -> f64 {
        let end = if axis == 0 { self.nu.asinh() } else { 30.0 };
        root(|xi| self.cdf(axis, xi.sinh()) - u, -60.0, end).sinh()
    }

    fn cdf(&self, axis: usize, c: f64) -> f64 {
        match (axis, self.profile) {
            (0, _) => self.scaled_integral(c.min(self.nu)) / self.norm,
            (_, VisibleProfile::Ggx) => 0.5 + (c / (1.0 + c * c) + c.atan()) / PI,
            (_, VisibleProfile::Beckmann) => 0.5 * erfc(-c),
        }
    }

    fn point(&self, [x, tau]: [f64; 2]) -> ([f64; 3], f64) {
        let stretch = if self.profile == VisibleProfile::Ggx { x.hypot(1.0) } else { 1.0 };
        let y = tau * stretch;
        let [c, s] = self.along;
        let (m, area) = self.inverse.normal([c * x - s * y, s * x + c * y]);
        (m, area * stretch / self.density([x, tau]))
    }
}

/// The spherical cap of Dupuy and Benyoub 2023 for GGX: reflected about the profile's normal, the
/// profile's view direction v is uniform on the part of the unit sphere above −v.z. For the
/// Kolmogorov–Smirnov test only.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cap {
    inverse: Inverse,
    v: [f64; 3],
    /// 1 + v.z, the height of the cap.
    height: f64,
}

impl Cap {
    pub(crate) fn new(inverse: Inverse, w: [f64; 3]) -> Self {
        let [x, y] = inverse.direction(w);
        let length = x.hypot(y).hypot(w[2]);
        let v = [x / length, y / length, w[2] / length];
        let height = if v[2] < 0.0 { (v[0] * v[0] + v[1] * v[1]) / (1.0 - v[2]) } else { 1.0 + v[2] };
        Self { inverse, v, height }
    }

    /// The height above the rim and the azimuth, each scaled to [0, 1].
    pub(crate) fn uniform(&self, m: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.inverse.profile_slope(m);
        let v = self.v;
        let twice = 2.0 * (v[2] - v[0] * x - v[1] * y) / (1.0 + x * x + y * y);
        let azimuth = (-twice * y - v[1]).atan2(-twice * x - v[0]) / (2.0 * PI);
        [twice / self.height, if azimuth < 0.0 { azimuth + 1.0 } else { azimuth }]
    }
}
