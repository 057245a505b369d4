//! Fresnel reflectances, over all indices and all cosines.

use microsurface::Real;
use microsurface::fresnel::{Conductor, Dielectric, Fresnel, Spectrum};

use super::climb::{Effort, worst};
use super::exact::Exact;
use super::{LONG, SHORT};
use crate::accuracy::budget::assert_within;

/// n + ik and a cosine, as the scalar holds them.
type Input<T> = [T; 3];

/// ½ (|r_s|² + |r_p|²) by r_s = (cos − q)/(cos + q), r_p = (m² cos − q)/(m² cos + q).
///
/// m = n + ik and q² = m² − sin².
fn exact<T: Real>(input: Input<T>) -> f64 {
    let [n, k, cos] = input.map(|x| Exact::new(x.to_f64()));
    let (x, y) = (&n.square() - &k.square(), &(&n * &k) * 2.0);
    // q = a + ib.
    let (p, s) = (&(&x - 1.0) + &cos.square(), &y);
    let modulus = (&p.square() + &s.square()).sqrt();
    let larger = &(&modulus + &p.abs()) * 0.5;
    let smaller = if larger.zero() { Exact::new(0.0) } else { &s.square() / &(&larger * 4.0) };
    let (a2, b2) = if p.negative() { (smaller, larger) } else { (larger, smaller) };
    let (a, b) = (a2.sqrt(), b2.sqrt());
    // |u − q|²/|u + q|² of a complex u.
    let share = |re: &Exact, im: &Exact| {
        let below = &(re + &a).square() + &(im + &b).square();
        if below.zero() {
            return None;
        }
        Some(&(&(re - &a).square() + &(im - &b).square()) / &below)
    };
    let both = (share(&cos, &Exact::new(0.0)), share(&(&x * &cos), &(&y * &cos)));
    // Nothing to divide by: no surface.
    if let (Some(s), Some(p)) = both { (&(&s + &p) * 0.5).to_f64() } else { 0.0 }
}

fn decades(x: f64, low: f64, high: f64) -> f64 {
    10_f64.powf(low + (high - low) * x)
}

/// An index of every size, and those near 1.
fn index(kind: f64, x: f64, most: f64) -> f64 {
    match (kind * 5.0) as u32 {
        0 => decades(x, -most, most),
        1 => 1.0 - decades(x, -16.0, 0.0),
        2 => 1.0 + decades(x, -16.0, 1.0),
        3 => x.max(1e-3),
        _ => 1.0 + 4.0 * x,
    }
}

/// A cosine of every size, those near 1, and those near the critical angle and Brewster's.
fn cosine(kind: f64, x: f64, n: f64) -> f64 {
    let near = |cosine: f64| {
        cosine * (1.0 + (if x < 0.5 { -1.0 } else { 1.0 }) * decades(x * 2.0 % 1.0, -17.0, -1.0))
    };
    match (kind * 6.0) as u32 {
        0 => decades(x, -9.0, 0.0),
        1 => 1.0 - decades(x, -17.0, 0.0),
        2..4 => near(((1.0 - n) * (1.0 + n)).abs().sqrt()),
        4 => near(1.0 / (1.0 + n * n).sqrt()),
        _ => x,
    }
}

fn input<T: Real>([kind, x, absorbs, y, angle, z]: [f64; 6], most: f64, absorbing: bool) -> Input<T> {
    let n = T::lit(index(kind, x, most));
    let k = match (absorbs * 4.0) as u32 {
        _ if !absorbing => 0.0,
        0 => 0.0,
        1 => decades(y, -18.0, 0.0),
        2 => decades(y, -most, most.min(9.0)),
        _ => 8.0 * y,
    };
    let cos = cosine(angle, z, n.to_f64()).clamp(0.0, 1.0);
    [n, T::lit(k), T::lit(cos)]
}

fn searched<T: Real + Spectrum<Scalar = T>>(effort: Effort) -> [(f64, Input<T>); 2] {
    let error = |input: &Input<T>, value: T| (value.to_f64() - exact(*input)).abs() / T::EPSILON.to_f64();
    let dielectric = worst(
        effort,
        1,
        |point| input::<T>(point, 12.0, false),
        |&[n, k, cos]| error(&[n, k, cos], Dielectric::new(n).expect("positive").reflectance(cos)),
    );
    let conductor = worst(
        effort,
        2,
        |point| input::<T>(point, 8.9, true),
        |&[n, k, cos]| error(&[n, k, cos], Conductor::new(n, k).expect("positive").reflectance(cos)),
    );
    [(dielectric.error, dielectric.at), (conductor.error, conductor.at)]
}

fn within<T: Real + Spectrum<Scalar = T>>(effort: Effort) {
    let names = ["fresnel_dielectric", "fresnel_conductor"];
    let found = searched::<T>(effort);
    println!("{names:?}: {found:?}");
    for (function, (error, input)) in names.into_iter().zip(found) {
        assert_within::<T>(function, "absolute", error, &format!("{input:?}"));
    }
}

#[test]
fn no_worse_fresnel_f32() {
    within::<f32>(SHORT);
}

#[test]
fn no_worse_fresnel_f64() {
    within::<f64>(SHORT);
}

#[test]
#[ignore = "minutes: see the module's documentation of searches"]
fn the_worst_fresnel() {
    within::<f32>(LONG);
    within::<f64>(LONG);
}
