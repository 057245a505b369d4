//! The filter in projected space, over all roughness matrices within the disc and all footprints.

use microsurface::filter::{Footprint, projected};
use microsurface::map::Map;
use microsurface::{Ggx, Linear, Microsurface, Real};

use super::climb::{Effort, worst};
use super::exact::Exact;
use crate::accuracy::budget::bound;

/// A symmetric matrix by its entries xx, xy, yy.
struct Matrix([Exact; 3]);

impl Matrix {
    fn determinant(&self) -> Exact {
        let [xx, xy, yy] = &self.0;
        &(xx * yy) - &xy.square()
    }

    fn inverse(&self) -> Self {
        let [xx, xy, yy] = &self.0;
        let determinant = self.determinant();
        Self([yy / &determinant, -&(xy / &determinant), xx / &determinant])
    }

    fn plus(&self, other: &Self) -> Self {
        Self(core::array::from_fn(|i| &self.0[i] + &other.0[i]))
    }

    fn plus_identity(&self, sign: f64) -> Self {
        let [xx, xy, yy] = &self.0;
        Self([xx + sign, xy.clone(), yy + sign])
    }

    /// Σ scale·rᵀr over rows r.
    fn of_rows(rows: [[f64; 2]; 2], scale: f64) -> Self {
        let [[a, b], [c, d]] = rows.map(|row| row.map(Exact::new));
        let sum = |p: &Exact, q: &Exact, r: &Exact, s: &Exact| &(&(p * q) + &(r * s)) * scale;
        Self([sum(&a, &a, &c, &c), sum(&a, &b, &c, &d), sum(&b, &b, &d, &d)])
    }
}

/// The map R⁻¹ of a triangular R, the steps of a footprint and a variance.
#[derive(Clone, Debug)]
struct Input<T> {
    factor: [T; 3],
    steps: [[T; 2]; 2],
    variance: T,
}

fn decades(x: f64, low: f64, high: f64) -> f64 {
    10_f64.powf(low + (high - low) * x)
}

fn input<T: Real>([a, b, turn, kind, u, v, along, apart, by]: [f64; 9]) -> Input<T> {
    // Principal widths up to 1, and those that nearly are.
    let width = |x: f64| if x < 0.7 { decades(x / 0.7, -3.0, 0.0) } else { 1.0 - decades(x, -14.0, -0.1) };
    let (x, y) = (width(a).min(0.999_999), width(b).min(0.999_999));
    let (sin, cos) = (core::f64::consts::TAU * turn).sin_cos();
    let (xx, xy) = (x * x * cos * cos + y * y * sin * sin, (x * x - y * y) * sin * cos);
    let r11 = xx.sqrt();
    let factor = match (kind * 3.0) as u32 {
        0 => [x, 0.0, y],
        _ => [r11, xy / r11, x * y / r11],
    };
    let (first, second) = (decades(u, -7.0, 0.0), decades(v, -7.0, 0.0));
    let direction = core::f64::consts::TAU * along;
    let other = direction + if by < 0.3 { decades(apart, -9.0, 0.0) } else { core::f64::consts::TAU * apart };
    let step = |length: f64, angle: f64| [length * angle.cos(), length * angle.sin()].map(T::lit);
    Input {
        factor: factor.map(T::lit),
        steps: [step(first, direction), step(second, other)],
        variance: T::lit([0.25, 0.5 * core::f64::consts::FRAC_1_PI, 1.0 / 12.0, by][(4.0 * by) as usize]),
    }
}

/// Errors of the entries, relative to √(A'ᵢᵢA'ⱼⱼ), in ε, and of the determinant, in (4 + κ) ε with
/// the ratio κ of the principal widths.
fn errors<T: Real>(input: &Input<T>) -> [f64; 2] {
    let [r11, r12, r22] = input.factor;
    let Ok(map) = Linear::from_inverse([[r11, r12], [T::ZERO, r22]]) else { return [0.0; 2] };
    let rows = map.inverse().map(|row| row.map(T::to_f64));
    let a = Matrix::of_rows(rows, 1.0);
    // Within the disc alone.
    let inside = a.plus_identity(-1.0);
    if !inside.0[0].negative() || inside.determinant().negative() || inside.determinant().zero() {
        return [0.0; 2];
    }
    let kernel = Matrix::of_rows(input.steps.map(|row| row.map(T::to_f64)), 2.0 * input.variance.to_f64());
    let on_disc = a.inverse().plus_identity(-1.0).inverse().plus(&kernel);
    let exact = on_disc.inverse().plus_identity(1.0).inverse();
    let [u, v] = input.steps;
    let surface = Microsurface::new(Ggx, map);
    let Ok(filtered) = projected::filtered(&surface, Footprint::new(u, v), input.variance) else {
        return [f64::NAN; 2];
    };
    let value = Matrix::of_rows(filtered.map().inverse().map(|row| row.map(T::to_f64)), 1.0);
    let epsilon = T::EPSILON.to_f64();
    let [xx, xy, yy] = core::array::from_fn(|i| (&value.0[i] - &exact.0[i]).abs().to_f64());
    let [x, _, y] = [0, 1, 2].map(|i| exact.0[i].to_f64());
    let entries = (xx / x).max(yy / y).max(xy / (x * y).sqrt());
    let determinant = exact.determinant();
    let of_determinant = (&value.determinant() - &determinant).abs().to_f64() / determinant.to_f64();
    // The ratio of the principal widths: the kernel's own factor is rounded, across the wide axis
    // too.
    let [xx, xy, yy] = core::array::from_fn(|i| a.0[i].to_f64());
    let largest = 0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
    let ratio = largest / a.determinant().sqrt().to_f64();
    [entries / epsilon, of_determinant / (epsilon * (4.0 + ratio))]
}

fn within<T: Real>(effort: Effort, least: f64) {
    for (i, domain) in ["entries", "determinant"].into_iter().enumerate() {
        let found = worst(effort, 400 + i as u64, input::<T>, |input| errors(input)[i]);
        println!("projected {domain}: {:.3} at {:?}", found.error, found.at);
        let bound = bound("projected", domain).bounds[usize::from(!T::WIDENS)];
        assert!(
            found.error <= bound && found.error > least * bound,
            "{domain}: {} of {bound} at {:?}",
            found.error,
            found.at
        );
    }
}

/// A part of the usual effort: the oracle takes longer than that of the other searches.
const SHORT: Effort = Effort { starts: 100, moves: 30, finalists: 6 };
const LONG: Effort = Effort { starts: 4_000, moves: 40, finalists: 100 };

#[test]
fn no_worse_projected() {
    within::<f32>(SHORT, 0.3);
    within::<f64>(SHORT, 0.3);
}

#[test]
#[ignore = "a minute: see the module's documentation of searches"]
fn the_worst_projected() {
    within::<f32>(LONG, 0.7);
    within::<f64>(LONG, 0.7);
}
