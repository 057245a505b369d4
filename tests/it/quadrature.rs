//! Cubature over normals and directions in f64, with an error bound of its own.
//!
//! Normals are integrated over the slopes p of the *isotropic profile*: t = F p, F a factor of the
//! roughness matrix that the test derives from the surface's parameters, ρ = |p|, x = ln ρ. In x
//! every profile is smooth on a scale of 1 at any α: the nearest singularities of GGX and GTR are
//! at distance π/2 off the real axis. Radially Gauss–Legendre panels; the azimuth by the periodic
//! trapezoid rule on whole circles, by Gauss–Legendre on the arc of visible slopes otherwise. The
//! plane of w cuts the circles from ρ = |w.z|/|Fᵀw_xy| on; there the radial integrand has a root
//! singularity, which x = x₀ + y² removes.
//!
//! Every integral is computed twice, with fewer and with more nodes in every direction; the
//! difference is the bound, that of the coarser result.

use core::f64::consts::{PI, TAU};

use crate::scalar::{dot, unit};

/// An integral and a bound on its error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Estimate {
    pub(crate) value: f64,
    pub(crate) bound: f64,
}

/// Nodes and weights of the Gauss–Legendre rule on [−1, 1].
pub(crate) fn gauss_legendre(n: u32) -> Vec<[f64; 2]> {
    let root = |i: u32| {
        let mut x = (PI * (f64::from(i) + 0.75) / (f64::from(n) + 0.5)).cos();
        let mut weight = 0.0;
        for _ in 0..8 {
            let (mut previous, mut p) = (1.0, x);
            for k in 2..=n {
                let k = f64::from(k);
                (previous, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * previous) / k);
            }
            let derivative = f64::from(n) * (x * p - previous) / (x * x - 1.0);
            x -= p / derivative;
            weight = 2.0 / ((1.0 - x * x) * derivative * derivative);
        }
        [x, weight]
    };
    (0..n).map(root).collect()
}

/// The rule on [a, b].
fn on(rule: &[[f64; 2]], a: f64, b: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    rule.iter().map(move |&[x, w]| (middle + half * x, half * w))
}

/// The periodic trapezoid rule with `n` nodes from `start` on.
fn around(n: usize, start: f64) -> impl Iterator<Item = (f64, f64)> {
    let step = TAU / (n as f64);
    (0..n).map(move |i| (start + step * (i as f64), step))
}

/// The slope plane of a surface: t = F p, and the range of ln |p| that holds all but 1e-16 of every
/// integral.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    /// F by columns.
    pub(crate) factor: [[f64; 2]; 2],
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// The length of a radial panel.
    pub(crate) panel: f64,
}

impl Plane {
    /// For densities that fall as ρ⁻⁴ beyond ρ = 1 and are flat below ρ = `core`.
    pub(crate) fn heavy(factor: [[f64; 2]; 2], core: f64) -> Self {
        Self { factor, from: core.ln() - 19.0, to: 37.0, panel: 0.7 }
    }

    /// For Gaussian densities of width 1.
    pub(crate) fn gaussian(factor: [[f64; 2]; 2]) -> Self {
        Self { factor, from: -19.0, to: 6.3_f64.ln(), panel: 0.25 }
    }

    /// |det F|.
    fn area(&self) -> f64 {
        let [[a, b], [c, d]] = self.factor;
        (a * d - b * c).abs()
    }

    fn slope(&self, rho: f64, phi: f64) -> [f64; 2] {
        let (s, c) = phi.sin_cos();
        let [u, v] = self.factor;
        [rho * (c * u[0] + s * v[0]), rho * (c * u[1] + s * v[1])]
    }

    /// Fᵀw_xy: its length and azimuth.
    fn tilt(&self, w: [f64; 3]) -> (f64, f64) {
        let [x, y] = self.factor.map(|column| column[0] * w[0] + column[1] * w[1]);
        (x.hypot(y), y.atan2(x))
    }

    /// The radial panels [a, b], and whether a is the root singularity.
    fn panels(&self, w: [f64; 3]) -> Vec<(f64, f64, bool)> {
        let (tilt, _) = self.tilt(w);
        let kink = (w[2].abs() / tilt).ln();
        let split = |a: f64, b: f64, singular: bool| {
            let n = ((b - a) / self.panel).ceil().max(1.0);
            let step = (b - a) / n;
            (0..(n as u32)).map(move |i| {
                let i = f64::from(i);
                (a + step * i, a + step * (i + 1.0), singular && i < 0.5)
            })
        };
        if kink <= self.from {
            return split(self.from, self.to, false).collect();
        }
        if w[2] < 0.0 {
            // Nothing is visible below the kink; the tail beyond it counts in full.
            return split(kink, self.to.max(kink + self.to - self.from), true).collect();
        }
        if kink >= self.to {
            return split(self.from, self.to, false).collect();
        }
        split(self.from, kink, false).chain(split(kink, self.to, true)).collect()
    }

    /// ∫ f(wm) dwm over the upper hemisphere of normals with w·wm > 0, for several f at once.
    pub(crate) fn over_visible_normals<const K: usize>(
        &self,
        w: [f64; 3],
        f: impl Fn([f64; 3]) -> [f64; K],
    ) -> [Estimate; K] {
        estimates(|fine| {
            let radial = gauss_legendre(if fine { 15 } else { 13 });
            let azimuthal = gauss_legendre(if fine { 16 } else { 14 });
            let circle = if fine { 10 } else { 7 };
            let (tilt, azimuth) = self.tilt(w);
            let kink = (w[2].abs() / tilt).ln();
            let mut sum = [0.0; K];
            let mut add = |rho: f64, weight: f64, phi: f64, arc: f64| {
                let [x, y] = self.slope(rho, phi);
                let m = unit([-x, -y, 1.0]);
                let weight = weight * arc * m[2] * m[2] * m[2];
                for (sum, f) in sum.iter_mut().zip(f(m)) {
                    *sum += weight * f;
                }
            };
            for (a, b, singular) in self.panels(w) {
                let end = if singular { (b - a).sqrt() } else { b - a };
                for (y, dy) in on(&radial, 0.0, end) {
                    let (step, dx) = if singular { (y * y, 2.0 * y * dy) } else { (y, dy) };
                    let rho = (a + step).exp();
                    let weight = dx * rho * rho * self.area();
                    let beyond = if singular { step } else { a + step - kink };
                    if beyond <= 0.0 {
                        // Panels below the kink exist only where these circles are visible as a
                        // whole.
                        around(circle, azimuth + 0.1).for_each(|(phi, arc)| add(rho, weight, phi, arc));
                    } else {
                        // acos(w.z/(ρ tilt)) from 1 − e^{−beyond}, which has all its digits at the
                        // kink.
                        let small = 2.0 * (-0.5 * (-beyond).exp_m1()).sqrt().asin();
                        let edge = if w[2] > 0.0 { small } else { PI - small };
                        on(&azimuthal, azimuth + edge, azimuth + TAU - edge)
                            .for_each(|(phi, arc)| add(rho, weight, phi, arc));
                    }
                }
            }
            sum
        })
    }

    /// ∫ f(wm) dwm over the normals that reflect w to above the horizon: a disc of slopes about
    /// −w_xy/w.z.
    pub(crate) fn over_reflecting_normals(&self, w: [f64; 3], f: impl Fn([f64; 3]) -> f64) -> Estimate {
        let [estimate] = estimates(|fine| {
            let radial = gauss_legendre(if fine { 16 } else { 13 });
            let mut sum = 0.0;
            for (phi, arc) in around(if fine { 128 } else { 112 }, 0.1) {
                // w.z ρ²|g|² + 2ρ w·g = w.z at the edge, g the slope of ρ = 1.
                let g = self.slope(1.0, phi);
                let (along, length2) = (w[0] * g[0] + w[1] * g[1], g[0] * g[0] + g[1] * g[1]);
                let root = (along * along + w[2] * w[2] * length2).sqrt();
                let edge =
                    if along > 0.0 { w[2] / (along + root) } else { (root - along) / (w[2] * length2) };
                let n = ((edge.ln() - self.from) / self.panel).ceil();
                let step = (edge.ln() - self.from) / n;
                for i in 0..(n as u32) {
                    let a = self.from + step * f64::from(i);
                    for (x, dx) in on(&radial, a, a + step) {
                        let [sx, sy] = self.slope(x.exp(), phi);
                        let m = unit([-sx, -sy, 1.0]);
                        sum += arc * dx * (2.0 * x).exp() * self.area() * m[2] * m[2] * m[2] * f(m);
                    }
                }
            }
            [sum]
        });
        estimate
    }
}

/// Both resolutions of an integral.
fn estimates<const K: usize>(integral: impl Fn(bool) -> [f64; K]) -> [Estimate; K] {
    let (coarse, fine) = (integral(false), integral(true));
    core::array::from_fn(|k| Estimate { value: fine[k], bound: (fine[k] - coarse[k]).abs() })
}

/// ∫ f(wi) dwi over all directions whose half vector with w points up, in polar coordinates about
/// w: no normal and no Jacobian of a half vector enters. For densities of width ≥ 0.2.
pub(crate) fn over_reflected_directions(w: [f64; 3], f: impl Fn([f64; 3]) -> f64) -> Estimate {
    // e points down the slope of the sphere at w, b is horizontal.
    let sin = w[0].hypot(w[1]);
    let (c, s) = if sin > 0.0 { (w[0] / sin, w[1] / sin) } else { (1.0, 0.0) };
    let (e, b) = ([w[2] * c, w[2] * s, -sin], [-s, c, 0.0]);
    let [estimate] = estimates(|fine| {
        let azimuthal = gauss_legendre(if fine { 48 } else { 36 });
        let polar = gauss_legendre(if fine { 28 } else { 20 });
        let mut sum = 0.0;
        for quarter in [-0.5 * PI, 0.0, 0.5 * PI, PI] {
            for (phi, dphi) in on(&azimuthal, quarter, quarter + 0.5 * PI) {
                let side: [f64; 3] = core::array::from_fn(|k| phi.cos() * e[k] + phi.sin() * b[k]);
                // wm = cos(θ/2) w + sin(θ/2) side reaches the horizon at this θ, if before π.
                let end = if side[2] < 0.0 { 2.0 * w[2].atan2(-side[2]) } else { PI };
                for panel in 0..8 {
                    let a = end * f64::from(panel) / 8.0;
                    for (theta, dtheta) in on(&polar, a, a + end / 8.0) {
                        let wi = core::array::from_fn(|k| theta.cos() * w[k] + theta.sin() * side[k]);
                        sum += dphi * dtheta * theta.sin() * f(wi);
                    }
                }
            }
        }
        [sum]
    });
    estimate
}

/// ∫ f(wi) dwi over the upper hemisphere, in spherical coordinates. For densities of width ≥ 0.2.
pub(crate) fn over_hemisphere(f: impl Fn([f64; 3]) -> f64) -> Estimate {
    let [estimate] = estimates(|fine| {
        let polar = gauss_legendre(if fine { 28 } else { 20 });
        let mut sum = 0.0;
        for panel in 0..4 {
            let a = 0.125 * PI * f64::from(panel);
            for (theta, dtheta) in on(&polar, a, a + 0.125 * PI) {
                let (s, c) = theta.sin_cos();
                for (phi, dphi) in around(if fine { 144 } else { 120 }, 0.1) {
                    sum += dtheta * dphi * s * f([s * phi.cos(), s * phi.sin(), c]);
                }
            }
        }
        [sum]
    });
    estimate
}

/// The mirror direction of w about the normal of slope t, and the area |∂wi/∂t₁ × ∂wi/∂t₂| it
/// sweeps: the derivative of the reflection itself, not the textbook's 4 w·wm.
pub(crate) fn reflection(w: [f64; 3], m: [f64; 3]) -> ([f64; 3], f64) {
    let wm = dot(w, m);
    // m = (−t, 1)/L with L = 1/m.z, so ∂m/∂t_j = −m.z e_j + m.z m.j m  (t_j = −m.j/m.z).
    let derivative = |j: usize| -> [f64; 3] {
        let dm: [f64; 3] = core::array::from_fn(|k| m[2] * (m[j] * m[k] - if k == j { 1.0 } else { 0.0 }));
        let dot_dm = dot(w, dm);
        core::array::from_fn(|k| 2.0 * (dot_dm * m[k] + wm * dm[k]))
    };
    let (a, b) = (derivative(0), derivative(1));
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    (core::array::from_fn(|k| 2.0 * wm * m[k] - w[k]), dot(cross, cross).sqrt())
}

#[test]
fn the_rules_integrate_what_is_known() {
    let power: f64 = on(&gauss_legendre(12), 0.0, 2.0).map(|(x, w)| w * x.powi(23)).sum();
    assert!((power / (2_f64.powi(24) / 24.0) - 1.0).abs() < 1e-13, "{power}");
    // The solid angle of the visible half of the hemisphere of normals.
    let w = unit([0.48, 0.64, 0.6]);
    let plane = Plane { factor: [[0.9, 0.2], [-0.2, 0.9]], from: -19.0, to: 37.0, panel: 0.5 };
    let [area, projected] = plane.over_visible_normals(w, |m| [1.0, dot(m, w)]);
    let visible = PI + 2.0 * w[2].asin();
    assert!((area.value - visible).abs() < 1e-7, "{area:?} {visible}");
    assert!((projected.value - 0.5 * PI * (1.0 + w[2])).abs() < 1e-7, "{projected:?}");
    let directions = over_reflected_directions(w, |_| 1.0);
    let upper = over_hemisphere(|wi| wi[2]);
    assert!((upper.value - PI).abs() < 1e-11, "{upper:?}");
    // The half vector points up above wi.z = −w.z.
    assert!((directions.value - TAU * (1.0 + w[2])).abs() < 1e-12, "{directions:?}");
    // The area a reflection sweeps is 4 (w·m) m.z³ in slopes.
    let m = unit([0.1, -0.3, 0.8]);
    let (wi, swept) = reflection(w, m);
    assert!((dot(wi, wi) - 1.0).abs() < 1e-14);
    assert!((swept / (4.0 * dot(w, m) * m[2].powi(3)) - 1.0).abs() < 1e-13, "{swept}");
}
