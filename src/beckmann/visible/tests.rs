//! Each bound is below twice what was measured, which stands beside it.

use super::{Inversion, Outset, To1e6, ToRounding, View, solve};
use crate::elementary::{erfc_inv, exp, ln};
use crate::real::Real;

/// Two tables of two generators, the first with ν − x to all digits.
const TABLES: [&str; 2] = [
    include_str!("../../../tests/reference/beckmann_visible_tails.tsv"),
    include_str!("../../../tests/reference/beckmann_visible.tsv"),
];
const VIEWS: [f64; 17] =
    [-1e3, -30.0, -3.0, -1.0, -0.2, -1e-3, 0.0, 1e-3, 0.1, 0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 1e8, f64::INFINITY];

/// ν, u, x, ν − x.
fn table() -> impl Iterator<Item = [f64; 4]> {
    TABLES.into_iter().flat_map(str::lines).filter(|line| !line.starts_with('#')).map(|line| {
        let mut fields = line.split('\t').map(|field| field.parse::<f64>().unwrap());
        let [nu, u, x] = core::array::from_fn(|_| fields.next().unwrap());
        [nu, u, x, fields.next().unwrap_or(nu - x)]
    })
}

/// F(x)/F(ν) at (ξ, f).
fn fraction(view: &View<f64>, at: (f64, f64)) -> f64 {
    view.distribution(at, <ToRounding as Inversion<f64>>::FIT).0 / view.total
}

/// ν as a scalar holds it.
fn view<T: Real<Wide = f64>>(nu: f64) -> (View<f64>, Outset<T>) {
    View::new(nu, <ToRounding as Inversion<T>>::FIT)
}

fn visible_slope<T: Real<Wide = f64>>(nu: f64, u: T) -> f64 {
    super::visible_slope::<ToRounding, T>(nu, u)
}

/// The largest difference of u between computed and tabulated slopes, without what rounding of x
/// itself makes.
fn worst_of_table<T: Real<Wide = f64>>() -> f64 {
    let mut worst = 0.0_f64;
    for [nu, u, x, w] in table() {
        let narrowed = T::narrow(u);
        if (narrowed.to_f64() - u).abs() > 0.0 || narrowed < T::lit(0.25) * T::EPSILON {
            continue;
        }
        let error = (visible_slope(nu, narrowed) - x).abs();
        let error = (error - 0.5 * f64::EPSILON * x.abs()).max(0.0);
        let (view, _) = view::<f64>(nu);
        let xi = if nu < 0.0 { w } else { -x };
        // the density is nearly linear in w beside ν
        let (_, density) =
            view.distribution((xi, view.b * (w + 0.5 * error)), <ToRounding as Inversion<f64>>::FIT);
        let difference = error * density / view.total;
        // The step of an f32 u below 1; the tests assert far less of the worst.
        assert!(difference < f64::from(f32::EPSILON), "nu = {nu}, u = {u:e}: off by {error:e}");
        worst = worst.max(difference);
    }
    worst
}

#[test]
fn agrees_with_the_table() {
    let (double, single) = (worst_of_table::<f64>(), worst_of_table::<f32>());
    // 7.6e-16 and 1.02e-8
    assert!(double < 1.1e-15, "f64: {double:e}");
    assert!(single < 1.5e-8, "f32: {single:e}");
}

/// A small generator for the random inputs (Knuth's multiplier), uniform in [0, 1).
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    f64::from(u32::try_from(*state >> 32).unwrap()) / 4294967296.0
}

#[test]
fn round_trip() {
    let (mut double, mut single, mut state) = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 1);
    for i in 0..400_000 {
        let nu = match i % 4 {
            0 => 16.0 * random(&mut state) - 8.0,
            1 => 4.0 * random(&mut state) - 2.0,
            2 => 1.0 / (2.0 * random(&mut state) - 1.0),
            _ => VIEWS[i / 4 % VIEWS.len()],
        };
        let u = random(&mut state) + random(&mut state) / 4294967296.0;
        let u = if i % 3 == 0 { (u * u * u).max(2e-16) } else { u.min(1.0 - 1.2e-16) };
        let u = if i % 5 == 0 { 1.0 - (u * u * u).max(2e-16) } else { u };
        let (view, outset) = view::<f64>(nu);
        let error = (fraction(&view, solve::<ToRounding, f64>(&view, &outset, u)) - u).abs();
        if error > double.0 {
            double = (error, nu, u);
        }
        #[expect(clippy::cast_possible_truncation, reason = "any f32 will do")]
        let narrow = (u as f32).clamp(3e-8, 1.0 - 6e-8);
        let (view_of_single, outset) = super::tests::view::<f32>(nu);
        let error = (fraction(&view, solve::<ToRounding, f32>(&view_of_single, &outset, narrow))
            - f64::from(narrow))
        .abs();
        if error > single.0 {
            single = (error, nu, u);
        }
    }
    // 1.1e-15, ν = −30, and 2.6e-8, ν = 2.5: below 2⁻²⁵, half the step of u towards 1
    assert!(double.0 < 2e-15, "f64: {double:?}");
    assert!(single.0 < 3e-8, "f32: {single:?}");
}

#[test]
fn round_trip_to_1e_6() {
    let (mut worst, mut relative, mut squares, mut state) = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 4);
    let count = 400_000_u32;
    for i in 0..count {
        let nu = match i % 5 {
            0 => 16.0 * random(&mut state) - 8.0,
            1 => 4.0 * random(&mut state) - 2.0,
            2 => 1.0 / (2.0 * random(&mut state) - 1.0),
            3 => exp(20.0 * random(&mut state) - 10.0),
            _ => VIEWS[i as usize / 5 % VIEWS.len()],
        };
        let u = random(&mut state);
        let u = if i % 3 == 0 { u * u * u } else { u };
        let u = if i % 4 == 0 { 1.0 - u * u * u } else { u };
        #[expect(clippy::cast_possible_truncation, reason = "any f32 will do")]
        let (nu, u) = (nu.max(-1e6) as f32, (u as f32).clamp(3e-8, 1.0 - 6e-8));
        let (quick, outset) = View::new(nu, <To1e6 as Inversion<f32>>::FIT);
        let xi = f64::from(solve::<To1e6, f32>(&quick, &outset, u).0);
        let (view, _) = view::<f64>(f64::from(nu));
        let error = (fraction(&view, (xi, view.bv + view.b * xi)) - f64::from(u)).abs();
        squares += error * error;
        if error > worst.0 {
            worst = (error, nu, u);
        }
        if error / f64::from(u) > relative.0 {
            relative = (error / f64::from(u), nu, u);
        }
    }
    // Of 2·10⁷: 6.3e-7 (ν = −3.97; above the horizon 4.5e-7), 4.7e-6 and 6.1e-8.
    assert!(worst.0 < 8e-7 && worst.0 > 3e-7, "{worst:?}");
    assert!(relative.0 < 6e-6, "{relative:?}");
    let rms = (squares / f64::from(count)).sqrt();
    assert!(rms < 7e-8, "{rms:e}");
}

#[test]
fn known_inverses() {
    for i in 1..2000 {
        let u = f64::from(i) / 2000.0;
        let (x, error) = ((-ln(u)).sqrt(), (visible_slope(0.0, u) + (-ln(u)).sqrt()).abs());
        // 2.5ε; or half an ulp of u, which moves x by as much as ¼ε/x.
        assert!(error < 4.0 * f64::EPSILON || 2.0 * x * error < 0.51 * f64::EPSILON, "{u}: {error:e}");
        for nu in [f64::INFINITY, 1e300] {
            let error = (visible_slope(nu, u) + erfc_inv(2.0 * u)).abs();
            // 9.3e-15: in the tails x moves by the rounding of u over the density.
            assert!(error < 1.8e-14, "{u}: {error:e}");
        }
    }
}

/// Where monotonicity is tested: both ends, the middle, where the guess changes its formula, and
/// anywhere.
fn places(nu: f64, state: &mut u64) -> [f64; 7] {
    let (view, _) = view::<f64>(nu);
    let seam = if nu < 0.0 { 0.25 } else { fraction(&view, (0.0, view.bv)) };
    [0.0, 0.5, 1.0, seam, random(state), random(state), random(state)]
}

#[test]
fn monotone_ulp_by_ulp_in_f32() {
    let mut state = 2;
    for nu in VIEWS {
        for place in places(nu, &mut state) {
            #[expect(clippy::cast_possible_truncation, reason = "any f32 will do")]
            let centre = (place as f32).to_bits();
            let mut last = f64::NEG_INFINITY;
            for bits in centre.saturating_sub(4000)..(centre + 4000).min(1.0_f32.to_bits()) {
                let x = visible_slope(nu, f32::from_bits(bits));
                assert!(x >= last, "nu = {nu}, u = {:e}: {x:e} after {last:e}", f32::from_bits(bits));
                last = x;
            }
        }
    }
}

#[test]
fn monotone_in_f64() {
    let mut state = 3;
    let step = 1.0 / 17592186044416.0; // 2⁻⁴⁴
    for nu in VIEWS {
        for place in places(nu, &mut state) {
            let mut last = f64::NEG_INFINITY;
            for i in -4000..4000 {
                let u = place + f64::from(i) * step;
                if (0.0..1.0).contains(&u) {
                    let x = visible_slope(nu, u);
                    assert!(x >= last, "nu = {nu}, u = {u:e}: {x:e} after {last:e}");
                    last = x;
                }
            }
        }
    }
}

#[test]
fn continuous_in_the_view() {
    // the slope follows ν, no faster than ν itself, also where the formulas change: ν = 0, ν = 1,
    // F(0) = u·F(ν)
    let step = 1.0 / 4096.0;
    for u in [1e-6, 0.01, 0.2, 0.5, 0.7, 0.9, 0.99, 0.9999] {
        let mut last = visible_slope(-12.0, u);
        for i in 1..24 * 4096 {
            let x = visible_slope(f64::from(i) * step - 12.0, u);
            assert!(x >= last - 1e-14 && x - last <= step + 1e-14, "nu step {i}, u = {u}: {last} to {x}");
            last = x;
        }
    }
}

#[test]
fn extremes_stay_finite_and_visible() {
    let views =
        VIEWS.into_iter().chain([1e300, f64::MAX, f64::MIN_POSITIVE, -f64::MIN_POSITIVE, -0.0, 1.0, 1e5]);
    for nu in views.chain([-1e4, -1e6, -1e10, -1e200, f64::MIN]) {
        for u in [
            0.0,
            f64::MIN_POSITIVE,
            1e-17,
            0.5,
            1.0 - 1e-8,
            1.0 - f64::EPSILON,
            1.0 - 0.5 * f64::EPSILON,
            1.0,
        ] {
            let x = visible_slope(nu, u);
            assert!(x.is_finite() && x <= nu, "nu = {nu:e}, u = {u:e}: {x:e}");
            assert!(x < nu || nu < -1e3, "nu = {nu:e}, u = {u:e}: {x:e}");
            assert!(nu < 0.0 || x > -6.2, "nu = {nu:e}, u = {u:e}: {x:e}");
        }
        for u in [0.0_f32, 1e-30, 1e-8, 0.5, 1.0 - f32::EPSILON, 1.0 - 0.5 * f32::EPSILON, 1.0] {
            #[expect(clippy::cast_possible_truncation, reason = "infinite where it is too high")]
            let narrow = nu.max(-1e38) as f32;
            let x = super::visible_slope::<To1e6, f32>(narrow, u);
            assert!(x.is_finite() && x <= narrow && (nu < 0.0 || x > -4.2), "nu = {nu:e}, u = {u:e}: {x:e}");
            let x = visible_slope(nu, u);
            assert!(x.is_finite() && x <= nu && (nu < 0.0 || x > -4.2), "nu = {nu:e}, u = {u:e}: {x:e}");
        }
    }
}
