//! One component of Student-t slopes, y with the density f = c/(1 + y²)^p, and what is beyond a
//! height ν: the mass U(ν) = ∫_ν^∞ f and the area B(ν) = ∫_ν^∞ (y − ν) f.
//!
//! With p = γ − ½ they are the mask, z Λ = s B(z/s), and what visible normals are drawn by. Both
//! are incomplete beta functions, elementary where 2γ is an integer; here one form serves every γ.
//! With 1 + y² = (1 + ν²) eᵛ
//!
//! U = ½ c W^{p−1} ∫ e^{−(p−1)v} dv/y,  B = ½ c W^{p−1} ∫ e^{−(p−1)v} (1 − ν/y) dv,  W = 1/(1 + ν²),
//!
//! over v > 0: the power carries all orders of magnitude, and what is left is a smooth function of
//! the cosine μ = ν/√(1 + ν²). Divided by its values at both ends,
//!
//! U = W^{p−½} u(μ)/(1 + √p μ),  B = W^{p−1} b(μ)/(1 + (2p − 2) μ²),
//!
//! u and b vary by less than a factor of 2. Their singularities are at μ = −1 and ∞, which x =
//! (μ − k)/(μ + k) takes far from [0, 1]: 14 coefficients of a polynomial in x are exact to the
//! rounding of f32 for every γ, 28 to that of f64. They are found once per material, from the
//! integrals by double exponential quadrature.

use crate::Real;
use crate::elementary::chebyshev::{Interpolant, number};
use crate::elementary::{exp_normal, exp_wide, ln_1p};
use crate::real::construction::{exp, exp_m1};
use crate::real::converted;

/// The most coefficients, of f64.
pub(super) const MOST: usize = 28;

/// The coefficients of the scalar.
const fn count<T: Real>() -> usize {
    if T::WIDENS { 14 } else { MOST }
}

/// U, B and the powers for one p.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Marginal<T> {
    /// p − 1, √p, 2p − 2.
    excess: T,
    mass_slope: T,
    area_slope: T,
    /// k, and what takes x to [−1, 1].
    centre: T,
    twice_centre: T,
    /// c.
    pub(super) constant: T,
    mass: Interpolant<T, MOST>,
    area: Interpolant<T, MOST>,
}

/// A height ν = z/s over the slopes.
#[derive(Clone, Copy)]
struct Height<W> {
    /// Where the interpolants are evaluated.
    x: W,
    /// √W and μ.
    sine: W,
    cosine: W,
    /// (p − 1) ln(1 + ν²).
    exponent: W,
}

impl<T: Real> Marginal<T> {
    /// For p − 1 = `excess` > 0.
    pub(super) fn new(excess: f64) -> Self {
        let (p, centre) =
            (excess + 1.0, (3.0 / Real::sqrt(excess + 0.5)).min(1.0 + core::f64::consts::SQRT_2));
        let rule = Rule::new(excess);
        let constant = 1.0 / rule.integrals(0.0)[0];
        let slopes = [Real::sqrt(p), 2.0 * excess];
        // [u, b] where x' = (x of the module's text, taken to [−1, 1]).
        let scaled = |x: f64| {
            let lean = (x + 1.0) * centre;
            let cosine = (lean / (2.0 * (1.0 + centre) - (x + 1.0))).min(1.0);
            let [mass, area] = rule.integrals(cosine);
            [
                0.5 * constant * mass * (1.0 + slopes[0] * cosine),
                0.5 * constant * area * (1.0 + slopes[1] * (cosine * cosine)),
            ]
        };
        let [mass, area] = Interpolant::of_parts(count::<T>(), scaled);
        Self {
            excess: T::lit(excess),
            mass_slope: T::lit(slopes[0]),
            area_slope: T::lit(slopes[1]),
            centre: T::lit(centre),
            twice_centre: T::lit(1.0 + 2.0 * centre),
            constant: T::lit(constant),
            mass,
            area,
        }
    }

    /// p − 1.
    pub(super) fn excess(&self) -> T {
        self.excess
    }

    /// The height z/s of z ≥ 0, s ≥ 0.
    #[inline(always)]
    fn height<W: Real>(&self, s: W, z: W) -> Height<W> {
        let (s2, z2) = (s * s, z * z);
        let r = (s2 + z2).sqrt();
        let inverse = W::ONE / r;
        let cosine = z * inverse;
        let x = (converted::<T, W>(self.twice_centre) * z - converted::<T, W>(self.centre) * r)
            / (z + converted::<T, W>(self.centre) * r);
        // Where s is 0 so is what follows.
        let ratio = (z2 / s2).min(W::MAX);
        Height { x, sine: s * inverse, cosine, exponent: converted::<T, W>(self.excess) * ln_1p(ratio) }
    }

    /// b(μ)/(1 + (2p − 2) μ²).
    #[inline(always)]
    fn scaled_area<W: Real>(&self, height: &Height<W>) -> W {
        let mu2 = height.cosine * height.cosine;
        self.area.at(count::<T>(), height.x) / (W::ONE + converted::<T, W>(self.area_slope) * mu2)
    }

    /// √W u(μ)/(1 + √p μ).
    #[inline(always)]
    fn scaled_mass<W: Real>(&self, height: &Height<W>) -> W {
        let slope = W::ONE + converted::<T, W>(self.mass_slope) * height.cosine;
        height.sine * self.mass.at(count::<T>(), height.x) / slope
    }

    /// s B(z/s), and whether it is so small that it counts as 0.
    #[inline(always)]
    pub(super) fn area(&self, s: T, z: T) -> (T, bool) {
        let height = self.height(s, z);
        let last = T::lit(if T::WIDENS { 64.0 } else { 676.0 });
        let vanished = height.exponent > last;
        let exponent = if vanished { last } else { height.exponent };
        (s * exp_normal(-exponent) * self.scaled_area(&height), vanished)
    }

    /// s B(z/s)/z with the exponent in the wide scalar.
    #[inline(always)]
    pub(super) fn area_over_height(&self, s: T, z: T) -> T {
        let (wide_s, wide_z) = (s.widen(), z.widen());
        let ratio = wide_z / wide_s;
        let square = (ratio * ratio).min(T::Wide::MAX);
        let exponent = self.excess.widen() * ln_1p(square);
        s / z * self.scaled_area(&self.height(s, z)) * exp_wide::<T>(-exponent)
    }

    /// U, B and (p − 1) ln(1 + ν²) at ν; U and B are divided by W^{p−1} where that is asked for.
    #[inline]
    pub(super) fn beyond<W: Real>(&self, nu: W, scaled: bool) -> [W; 3] {
        let height = self.height(W::ONE, nu);
        let last = W::lit(700.0);
        let power = if scaled { W::ONE } else { exp_normal(-height.exponent.min(last)) };
        [power * self.scaled_mass(&height), power * self.scaled_area(&height), height.exponent]
    }
}

/// The points of the double exponential rule over v, as weights e^{−(p−1)v} dv and eᵛ − 1.
struct Rule {
    points: [[f64; 2]; Self::MOST],
    count: usize,
}

impl Rule {
    const STEPS_IN_ONE: usize = 32;
    /// From 1e-34, whose root is below the rounding, to where e^{−(p−1)v} is.
    const FIRST: f64 = -4.6;
    const MOST: usize = 300;

    fn new(excess: f64) -> Self {
        // Between the width of the power and that of eᵛ − 1: both are then resolved.
        let scale = if excess < 1.0 { 1.0 / Real::sqrt(excess) } else { 1.0 / excess };
        let mut rule = Self { points: [[0.0; 2]; Self::MOST], count: 0 };
        let step = core::f64::consts::PI * 0.25 / number(Self::STEPS_IN_ONE);
        for point in &mut rule.points {
            let tau = Self::FIRST + number(rule.count) / number(Self::STEPS_IN_ONE);
            let (grown, shrunk) = (exp(tau), exp(-tau));
            let v = scale * exp(0.25 * core::f64::consts::PI * (grown - shrunk));
            if excess * v > 45.0 {
                break;
            }
            *point = [exp(-excess * v) * v * step * (grown + shrunk), exp_m1(v.min(700.0))];
            rule.count += 1;
        }
        rule
    }

    /// The integrals of U, over √W, and B at μ: ∫ e^{−(p−1)v} dv/Y and ∫ e^{−(p−1)v} (1 − μ/Y) dv
    /// with Y = √W y = √(μ² + eᵛ − 1).
    fn integrals(&self, cosine: f64) -> [f64; 2] {
        let (mut mass, mut area) = (0.0, 0.0);
        for [weight, rise] in &self.points[..self.count] {
            let y = Real::sqrt(cosine * cosine + rise);
            let share = weight / y;
            mass += share;
            area += share * rise / (y + cosine);
        }
        [mass, area]
    }
}
