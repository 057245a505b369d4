//! Coordinates of the sphere of normals in which a distribution is flat.
//!
//! A chart maps the unit square to normals by inverting the distribution function of one coordinate
//! after the other (Rosenblatt 1952), from closed forms of the papers and a map R of the test's
//! own: no code of the crate takes part. Where sampler and density are right both are uniform in
//! (u₁, u₂), whatever α, the map or the angle, so that equal rectangles are cells of equal
//! probability and a quadrature over a cell is exact to rounding. Where one of them is wrong the
//! chart is still a bijection with a known Jacobian, and the test is still valid.

mod mixed;
mod polar;
mod view;

pub(crate) use mixed::Mixed;
pub(crate) use polar::{Polar, Radial};
pub(crate) use view::{Cap, View, VisibleProfile};

/// A bijection of the unit square and the upper hemisphere (or a part of it), one coordinate for
/// each axis.
pub(crate) trait Chart {
    /// The coordinates of a normal, which increase with u₁ and u₂.
    fn coordinates(&self, m: [f64; 3]) -> [f64; 2];

    /// The coordinate of the given axis below which the share u of the reference distribution lies.
    fn quantile(&self, axis: usize, u: f64) -> f64;

    /// The inverse of [`quantile`](Self::quantile).
    fn cdf(&self, axis: usize, coordinate: f64) -> f64;

    /// The unit normal of these coordinates, and the solid angle dω/(du₁ du₂) there.
    fn point(&self, coordinates: [f64; 2]) -> ([f64; 3], f64);
}

/// The root of an increasing function: bisection to a bracket of 0.06, then the Illinois variant of
/// the false position. What precision is lost moves a node of the quadrature, not its integral.
fn root(excess: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    while high - low > 0.06 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let (mut at_low, mut at_high) = (excess(low), excess(high));
    for _ in 0..40 {
        let xi = high - at_high * (high - low) / (at_high - at_low);
        let value = excess(xi);
        if value.abs() < 1e-15 || !(low < xi && xi < high) {
            return xi.clamp(low, high);
        }
        if value < 0.0 {
            (low, at_low) = (xi, value);
            at_high *= 0.5;
        } else {
            (high, at_high) = (xi, value);
            at_low *= 0.5;
        }
    }
    0.5 * (low + high)
}

/// R = M⁻¹ by rows, the inverse of the map that takes a profile to the surface.
///
/// Heights stay where they are when the plane is moved, h(p) = h_P(R p), hence slopes are t = Rᵀ
/// t_P.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inverse(pub(crate) [[f64; 2]; 2]);

impl Inverse {
    pub(crate) fn determinant(self) -> f64 {
        let [[a, b], [c, d]] = self.0;
        (a * d - b * c).abs()
    }

    /// The slope Rᵀ t of the surface for the slope t of the profile.
    fn slope(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [[a, b], [c, d]] = self.0;
        [a * x + c * y, b * x + d * y]
    }

    /// The slope of the profile for the normal m of the surface.
    fn profile_slope(self, m: [f64; 3]) -> [f64; 2] {
        let [[a, b], [c, d]] = self.0;
        let z = -m[2].max(f64::MIN_POSITIVE) * (a * d - b * c);
        [(d * m[0] - c * m[1]) / z, (a * m[1] - b * m[0]) / z]
    }

    /// R w: the horizontal part of a direction as the profile sees it.
    fn direction(self, w: [f64; 3]) -> [f64; 2] {
        let [[a, b], [c, d]] = self.0;
        [a * w[0] + b * w[1], c * w[0] + d * w[1]]
    }

    /// The normal of the profile's slope `t`, and the solid angle cos³θ |det R| of a unit of
    /// profile slopes.
    fn normal(self, t: [f64; 2]) -> ([f64; 3], f64) {
        let [x, y] = self.slope(t);
        let cos = 1.0 / (1.0 + x * x + y * y).sqrt();
        ([-x * cos, -y * cos, cos], cos * cos * cos * self.determinant())
    }
}
