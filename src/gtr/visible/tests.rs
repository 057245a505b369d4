//! Each bound is below twice what was measured, which stands beside it.

use core::f64::consts::{FRAC_PI_2, PI};

use super::{MAX, Place, View, aside, inside, sample_visible};
use crate::real::Real;

/// Angles from straight up.
const ANGLES: [f64; 17] = [
    0.0,
    1e-6,
    0.05,
    0.5,
    0.9,
    1.2,
    1.5,
    1.57,
    FRAC_PI_2 - 1e-9,
    FRAC_PI_2,
    FRAC_PI_2 + 1e-9,
    1.6,
    2.0,
    2.9,
    PI - 1e-2,
    PI - 1e-3,
    PI - 1e-6,
];
const FRACTIONS: [f64; 19] = [
    6e-17,
    1e-15,
    1e-13,
    1e-10,
    3e-8,
    1e-6,
    1e-4,
    0.003,
    0.02,
    0.11,
    0.3,
    0.5,
    0.71,
    0.9,
    0.99,
    0.9997,
    0.9999999,
    1.0 - 1e-12,
    1.0 - 1.2e-16,
];

/// ∫f over (a, b) by 24 panels of the five-point rule of Gauss.
fn integral(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    const PANELS: u32 = 24;
    let (near, far) = (5.0 - 2.0 * (10.0_f64 / 7.0).sqrt(), 5.0 + 2.0 * (10.0_f64 / 7.0).sqrt());
    let (near, far) = (near.sqrt() / 3.0, far.sqrt() / 3.0);
    let root = 13.0 * 70.0_f64.sqrt();
    let rule = [
        (-far, (322.0 - root) / 900.0),
        (-near, (322.0 + root) / 900.0),
        (0.0, 128.0 / 225.0),
        (near, (322.0 + root) / 900.0),
        (far, (322.0 - root) / 900.0),
    ];
    let half = (b - a) / f64::from(2 * PANELS);
    let mut sum = 0.0;
    for i in 0..PANELS {
        let centre = a + half * f64::from(2 * i + 1);
        sum += rule.iter().map(|&(x, w)| w * f(centre + half * x)).sum::<f64>();
    }
    sum * half
}

fn nth(x: f64, n: usize) -> f64 {
    (0..n).map(|_| x).product()
}

/// The fraction of the distribution on this side of d, from angles: u, and 1 − u.
fn fractions_of_d(k: usize, e: f64, place: &Place<f64>) -> (f64, f64) {
    let d = place.sin_d.atan2(place.cos_d);
    let y = place.sin_y.atan2(place.cos_y);
    // what the power is divided by
    let scale = if e < FRAC_PI_2 { e.sin() } else { 1.0 };
    let c = integral(0.0, d, |x| (x.sin() / scale) * nth((e - x).sin() / scale, 2 * k));
    let g = integral(0.0, y, |x| ((e - x).sin() / scale) * nth(x.sin() / scale, 2 * k));
    (c / (c + g), g / (c + g))
}

/// The share at η, by the integral from the nearer end.
fn fraction_of_aside(k: usize, (sin, cos): (f64, f64)) -> f64 {
    let from_end = cos.atan2(sin.abs());
    let total = integral(0.0, FRAC_PI_2, |x| nth(x.sin(), 2 * k + 2));
    let tail = 0.5 * integral(0.0, from_end, |x| nth(x.sin(), 2 * k + 2)) / total;
    if sin < 0.0 { tail } else { 1.0 - tail }
}

/// The worst error of the fraction for all k: of d and of η.
fn worst<T: Real<Wide = f64>>() -> [(f64, usize, f64, f64); 2] {
    let mut worst = [(0.0, 0, 0.0, 0.0); 2];
    for k in 1..=MAX {
        for u in FRACTIONS {
            let u = inside(T::narrow(u));
            let wide = u.widen();
            for angle in ANGLES {
                let e = PI - angle;
                let place = View::new(k, e.sin().max(super::LOWEST), e.cos()).solve(u);
                let (below, above) = fractions_of_d(k, e, &place);
                let error = if wide < 0.5 { below - wide } else { above - (1.0 - wide) };
                assert!(error.is_finite(), "k = {k}, angle {angle}, u = {wide:e}");
                if error.abs() > worst[0].0 {
                    worst[0] = (error.abs(), k, angle, wide);
                }
            }
            let error = (fraction_of_aside(k, aside::angle(k, u)) - wide).abs();
            if error > worst[1].0 {
                worst[1] = (error, k, 0.0, wide);
            }
        }
    }
    worst
}

#[test]
fn round_trip() {
    let [double, double_aside] = worst::<f64>();
    let [single, single_aside] = worst::<f32>();
    // 4.0e-15, k = 8, straight down but 1e-3; 4.4e-16
    assert!(double.0 < 7e-15, "f64: {double:?}");
    assert!(double_aside.0 < 8e-16, "f64: {double_aside:?}");
    // The arithmetic is that of f64, and so are the errors: 9.4e-15, at the horizon, and 4.2e-16
    assert!(single.0 < 1.8e-14, "f32: {single:?}");
    assert!(single_aside.0 < 8e-16, "f32: {single_aside:?}");
}

/// A small generator for the random inputs (Knuth's multiplier), uniform in [0, 1).
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    f64::from(u32::try_from(*state >> 32).unwrap()) / 4294967296.0
}

/// An angle from straight up, in all orders of magnitude from either end and from the horizon, and
/// a fraction.
fn any_view(i: u32, state: &mut u64) -> (f64, f64) {
    let small = 10.0_f64.powf(-8.0 * random(state));
    let angle = match i % 5 {
        0 => small,
        1 => PI - 1e-3_f64.max(small),
        2 => FRAC_PI_2 + small,
        3 => FRAC_PI_2 - small,
        _ => PI * random(state),
    };
    let small = 10.0_f64.powf(-15.0 * random(state));
    let u = match i % 3 {
        0 => small,
        1 => 1.0 - small,
        _ => random(state),
    };
    (angle, u)
}

#[test]
fn anywhere() {
    let (mut double, mut single, mut state) = ((0.0, 0, 0.0, 0.0), (0.0, 0, 0.0, 0.0), 1);
    for i in 0..30_000 {
        let (angle, u) = any_view(i, &mut state);
        let (e, k) = (PI - angle, 1 + usize::try_from(i / 15).unwrap() % MAX);
        let view = View::new(k, e.sin(), e.cos());
        let u = inside(u);
        let (below, above) = fractions_of_d(k, e, &view.solve(u));
        let error = if u < 0.5 { below - u } else { above - (1.0 - u) }.abs();
        if error.is_nan() || error > double.0 {
            double = (error, k, angle, u);
        }
        #[expect(clippy::cast_possible_truncation, reason = "any f32 will do")]
        let u = inside(u as f32);
        let (below, above) = fractions_of_d(k, e, &view.solve(u));
        let u = f64::from(u);
        let error = if u < 0.5 { below - u } else { above - (1.0 - u) }.abs();
        if error.is_nan() || error > single.0 {
            single = (error, k, angle, u);
        }
    }
    // 4.8e-15, k = 8; 1.4e-9 where v is 7e-5 above the horizon and u is 0
    assert!(double.0 < 9e-15, "f64: {double:?}");
    assert!(single.0 < 2.7e-9, "f32: {single:?}");
}

/// At the edge of visibility C = u·G(e) holds relatively, up to the rounding of G(e) over u: so d
/// has its digits.
#[test]
fn edge_of_visibility() {
    let (mut double, mut single) = ((0.0, 0, 0.0, 0.0), (0.0, 0, 0.0, 0.0));
    for k in 1..=MAX {
        for angle in ANGLES {
            let e = PI - angle;
            let view = View::new(k, e.sin().max(super::LOWEST), e.cos());
            for exponent in 1..=15 {
                let u = 10.0_f64.powi(-exponent);
                let place = view.solve(u);
                let error = (fractions_of_d(k, e, &place).0 / u - 1.0).abs() * u;
                assert!(place.sin_d > 0.0 && place.sin_y > 0.0, "k = {k}, angle {angle}, u = {u:e}");
                if error > double.0 {
                    double = (error, k, angle, u);
                }
                #[expect(clippy::cast_possible_truncation, reason = "any f32 will do")]
                let u = inside(u as f32);
                let place = view.solve(u);
                let error = (fractions_of_d(k, e, &place).0 / f64::from(u) - 1.0).abs();
                if error > single.0 {
                    single = (error, k, angle, f64::from(u));
                }
            }
        }
    }
    // 3.9e-15 over u; 1.2e-7, at u = 0
    assert!(double.0 < 7e-15, "{double:?}");
    assert!(single.0 < 2.3e-7, "{single:?}");
}

/// The mean over the sphere of what is asked, weighted with max(0, v·m)·m.z^(2k), by the midpoint
/// rule.
fn mean_over_sphere(k: usize, v: [f64; 3], f: impl Fn([f64; 3]) -> f64) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for i in 0..600 {
        let z = (f64::from(i) + 0.5) / 600.0;
        let r = (1.0 - z * z).sqrt();
        for j in 0..600 {
            let (sin, cos) = ((f64::from(j) + 0.5) / 300.0 * PI).sin_cos();
            let m = [r * cos, r * sin, z];
            let weight = (v[0] * m[0] + v[1] * m[1] + v[2] * m[2]).max(0.0) * nth(z, 2 * k);
            sum += weight * f(m);
            total += weight;
        }
    }
    sum / total
}

#[test]
fn moments_are_those_of_visible_normals() {
    let mut worst = 0.0_f64;
    for k in [1, 2, 5, 8] {
        for angle in [0.3, 1.2, 1.6, 2.3] {
            let (sin, cos) = f64::sin_cos(angle);
            let v = [0.6 * sin, 0.8 * sin, cos];
            let across = [-0.8, 0.6, 0.0];
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let moments: [&dyn Fn([f64; 3]) -> f64; 5] =
                [&|m| m[2], &|m| dot(v, m), &|m| m[0], &|m| dot(across, m) * dot(across, m), &|m| {
                    m[2] * m[1] * dot(v, m)
                }];
            let mut sums = [0.0; 5];
            for i in 0..400 {
                for j in 0..400 {
                    let u = [(f64::from(i) + 0.5) / 400.0, (f64::from(j) + 0.5) / 400.0];
                    let m = sample_visible(k, v.map(|x| x * 30.0), u);
                    let length = dot(m, m).sqrt();
                    let m = m.map(|x| x / length);
                    for (sum, f) in sums.iter_mut().zip(moments) {
                        *sum += f(m) / 160_000.0;
                    }
                }
            }
            for (sum, f) in sums.into_iter().zip(moments) {
                worst = worst.max((sum - mean_over_sphere(k, v, f)).abs());
            }
        }
    }
    // a negative control: the normals of the next k are as far as this
    let v = [0.6, 0.0, 0.8];
    let other = (mean_over_sphere(8, v, |m| m[2]) - mean_over_sphere(7, v, |m| m[2])).abs();
    // 1.7e-4, of the two midpoint rules
    assert!(worst < 3e-4 && worst < 0.1 * other, "{worst:e} {other:e}");
}

#[test]
fn monotone() {
    let mut state = 3;
    for k in 1..=MAX {
        for angle in ANGLES {
            let e = PI - angle;
            let view = View::new(k, e.sin().max(super::LOWEST), e.cos());
            for place in [0.0, 0.5, 1.0, random(&mut state)] {
                let (mut last, mut last_aside) = (0.0, f64::NEG_INFINITY);
                #[expect(clippy::cast_possible_truncation, reason = "any f32 will do")]
                let centre = (place as f32).to_bits();
                for bits in centre.saturating_sub(300)..(centre + 300).min(1.0_f32.to_bits()) {
                    let u = inside(f32::from_bits(bits));
                    let (x, side) = (view.solve(u), aside::angle(k, u));
                    let (x, side) = (1.0 - x.cos_d, side.0 / side.1);
                    assert!(x >= last && side >= last_aside, "k = {k}, angle {angle}, f32 {u:e}");
                    (last, last_aside) = (x, side);
                }
                let (mut last, mut last_aside) = (0.0, f64::NEG_INFINITY);
                for i in -300..300 {
                    let u = place + f64::from(i) / 4398046511104.0; // 2⁻⁴²
                    if !(0.0..1.0).contains(&u) {
                        continue;
                    }
                    let u = inside(u);
                    let (x, side) = (view.solve(u), aside::angle(k, u));
                    let (x, side) = (x.sin_d.atan2(x.cos_d), side.0 / side.1);
                    assert!(x >= last && side >= last_aside, "k = {k}, angle {angle}, f64 {u:e}");
                    (last, last_aside) = (x, side);
                }
            }
        }
    }
}

/// Finite normals above the horizon, visible up to rounding, wherever.
fn corners<T: Real<Wide = f64>>(lengths: &[f64], tiny: &[f64]) {
    let [zero, one] = [0.0, 1.0];
    let mut views = std::vec![[zero, zero, one], [zero, zero, -one], [one, zero, zero], [zero, -one, -zero]];
    for &t in tiny {
        views.extend([[t, zero, one], [-t, t, -one], [one, t, t], [t, one, -t], [t, zero, -one]]);
    }
    for k in 1..=MAX {
        for view in &views {
            for &length in lengths {
                let v = view.map(|x| T::narrow(x * length));
                for a in [0.0, 1e-38, 1e-8, 0.25, 0.5, 0.75, 1.0 - 1e-7, 1.0 - T::EPSILON.to_f64(), 1.0] {
                    for b in [0.0, 1e-38, 1e-8, 0.25, 0.5, 0.75, 1.0 - 1e-7, 1.0 - T::EPSILON.to_f64(), 1.0] {
                        let m = sample_visible(k, v, [T::narrow(a), T::narrow(b)]);
                        let [x, y, z] = m.map(Real::to_f64);
                        let cos = (x * view[0] + y * view[1] + z * view[2]) / (x * x + y * y + z * z).sqrt();
                        assert!(
                            z >= 0.0 && cos >= -T::EPSILON.to_f64(),
                            "k = {k}, {v:?}, {a}, {b}: {m:?}, {cos:e}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn extremes_stay_finite_and_visible() {
    corners::<f64>(
        &[1e-6, 1.0, 1e6],
        &[5e-324, 1e-300, 1e-160, 1e-154, 1e-60, 1e-31, 1e-20, 1e-8, 1e-3, 1.0],
    );
    corners::<f32>(&[1e-3, 1.0, 1e3], &[1e-45, 1e-38, 1e-20, 1e-8, 1e-4, 1e-3, 1.0]);
}
