//! Student-t slopes: the mask against 50 digits, the limits GGX and Beckmann, and the test kit.

use microsurface::batch::{Directions, NdfBatch};
use microsurface::glam::{DVec2, DVec3};
use microsurface::student_t::Phong;
use microsurface::verify::{Float, Kit};
use microsurface::{Beckmann, Error, Ggx, Ndf, Real, RoughnessMatrix, SampleNdf, SampleVndf, StudentT};

use crate::random::Random;
use crate::worst::Worst;

const TABLE: &str = include_str!("../reference/student_t.tsv");

/// γ, x, z, Λ and D of each row.
fn rows() -> impl Iterator<Item = [f64; 5]> {
    TABLE.lines().filter(|line| !line.starts_with('#')).map(|line| {
        let mut numbers = line.split('\t').map(|number| number.parse().expect("a number"));
        core::array::from_fn(|_| numbers.next().expect("five columns"))
    })
}

/// The largest errors of [Λ, σ above, σ below, D], in roundings; those of the exponent are divided
/// by 1 + (γ − 3/2) ln(1 + ν²) or 1 + γ ln(1 + q).
fn errors<T: Real>() -> [Worst<[f64; 3]>; 4] {
    let mut worst = core::array::from_fn(|_| Worst::default());
    for [gamma, x, z, lambda, d] in rows() {
        let surface = StudentT::isotropic(T::ONE, T::lit(gamma)).unwrap();
        let above: T::Vec3 = [x, 0.0, z].map(T::lit).into();
        let below: T::Vec3 = [-x, 0.0, -z].map(T::lit).into();
        let slope2 = (z / x).powi(2) / (gamma - 1.0);
        let steepness = 1.0 + (gamma - 1.5) * slope2.ln_1p();
        let at = [gamma, x, z];
        let roundings = |is: T, exact: f64| (is.to_f64() / exact - 1.0).abs() / T::EPSILON.to_f64();
        let normal = |x: f64| x > T::MIN_POSITIVE.to_f64() / T::EPSILON.to_f64();
        if normal(lambda) {
            worst[0].see(roundings(surface.lambda(above), lambda) / steepness, || at);
        }
        worst[1].see(roundings(surface.sigma(above), z + z * lambda), || at);
        // Beyond, it counts as 0.
        if (gamma - 1.5) * slope2.ln_1p() < if T::WIDENS { 63.0 } else { 675.0 } {
            worst[2].see(roundings(surface.sigma(below), z * lambda) / steepness, || at);
        }
        let tilt = 1.0 + gamma * (x * x / (z * z * (gamma - 1.0))).ln_1p();
        if normal(d) {
            worst[3].see(roundings(surface.d(above), d) / tilt, || at);
        }
    }
    worst
}

fn check<T: Real>(bounds: [f64; 4]) {
    for ((worst, bound), what) in errors::<T>().iter().zip(bounds).zip(["Λ", "σ above", "σ below", "D"]) {
        let Worst { error, at, count } = worst;
        assert!(*error <= bound && *error > 0.5 * bound, "{what}: {error} of {bound} at {at:?} of {count}");
    }
}

#[test]
fn masks_and_densities_of_f64() {
    check::<f64>([7.5, 8.0, 8.0, 2.5]);
}

#[test]
fn masks_and_densities_of_f32() {
    check::<f32>([2.5, 2.5, 3.0, 3.0]);
}

#[test]
fn two_is_ggx_and_many_is_beckmann() {
    let (ggx, beckmann) = (Ggx::isotropic(0.3_f64).unwrap(), Beckmann::isotropic(0.3_f64).unwrap());
    let (two, many) = (StudentT::isotropic(0.3, 2.0).unwrap(), StudentT::isotropic(0.3, 1e9).unwrap());
    let mut random = Random(1);
    for _ in 0..10_000 {
        let (z, turn) = (2.0 * random.unit() - 1.0, core::f64::consts::TAU * random.unit());
        let s = (1.0 - z * z).sqrt();
        let w = DVec3::new(s * turn.cos(), s * turn.sin(), z);
        assert!((two.sigma(w) / ggx.sigma(w) - 1.0).abs() < 4e-15, "σ at {w}");
        assert!((two.d(w) - ggx.d(w)).abs() <= 2e-15 * ggx.d(w), "D at {w}");
        // The deviation is of the order of ν⁴/γ, relatively.
        let steep = z / (0.3 * s);
        let fourth = (1.0 + steep * steep).powi(2);
        // Further down Beckmann's σ counts as 0.
        if fourth < 1e5 {
            assert!((many.sigma(w) / beckmann.sigma(w) - 1.0).abs() < 1e-9 * fourth, "σ at {w}");
        }
        let tan = s / (0.3 * z);
        if z > 0.0 && tan < 10.0 {
            let bound = 1e-9 * (1.0 + tan * tan).powi(2);
            assert!((many.d(w) / beckmann.d(w) - 1.0).abs() < bound, "D at {w}");
        }
    }
}

/// Everything that the kit asks of a distribution; the exponents at which half of a surface seen
/// from the side is steeper than a cubature resolves are below.
fn kit<T: Float>() {
    for gamma in [2.0, 2.3, 3.0, 8.5, 60.0] {
        let isotropic = StudentT::isotropic(T::lit(0.4), T::lit(gamma)).unwrap();
        let matrix = RoughnessMatrix::rotated(T::lit(0.3), T::lit(0.08), T::lit(0.7)).unwrap();
        let turned = StudentT::from_roughness_matrix(matrix, T::lit(gamma)).unwrap();
        let kit = Kit::new();
        let report = kit.ndf(&isotropic).and(kit.normals(&isotropic)).and(kit.visible_normals(&isotropic));
        assert!(report.passed(), "γ = {gamma}\n{report}");
        let report = kit.ndf(&turned).and(kit.normals(&turned)).and(kit.visible_normals(&turned));
        assert!(report.passed(), "γ = {gamma}, turned\n{report}");
    }
}

#[test]
fn the_kit_passes_in_f64() {
    kit::<f64>();
}

#[test]
fn the_kit_passes_in_f32() {
    kit::<f32>();
}

/// The mass seen from ν of slopes below y: ∫ (ν sin t + cos t) sin^{2γ−4} t dt over t = arccot of
/// the slope, from that of y to that of −ν.
///
/// By Simpson's rule in t^(1/5), in which the end of the slopes is no singularity for γ ≥ 1.6.
fn seen_below(gamma: f64, nu: f64, y: f64) -> f64 {
    let power = 2.0 * gamma - 4.0;
    let [low, high] = [y, -nu].map(|slope| 1.0_f64.atan2(slope).powf(0.2));
    let f = |root: f64| {
        let t = root.powi(5);
        let (sin, cos) = t.sin_cos();
        let ratio = if t > 0.0 { sin / t } else { 1.0 };
        // The last exponent is 0 or more; as 5 (2γ − 4) + 4 it may be −0 by rounding.
        (nu * sin + cos) * ratio.powf(power) * 5.0 * root.powf((5.0 * power + 4.0).max(0.0))
    };
    let steps = 2000;
    let width = (high - low) / f64::from(steps);
    let weight = |i: i32| if i == 0 || i == steps { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    (0..=steps).map(|i| weight(i) * f(low + width * f64::from(i))).sum::<f64>() * width / 3.0
}

/// Slopes along the view, sorted, against their distribution function: Kolmogorov's distance.
#[test]
fn slopes_along_the_view_are_distributed_as_stated() {
    let count = 4000;
    for gamma in [1.6, 1.8, 2.0, 2.7, 6.0, 30.0] {
        let surface = StudentT::isotropic(1.0, gamma).unwrap();
        let unit = (gamma - 1.0_f64).sqrt();
        for cot in [3.0, 0.7, 0.05, 1e-4, -0.02, -0.6] {
            let w = DVec3::new(1.0, 0.0, cot).normalize();
            let nu = cot / unit;
            let mut random = Random(7);
            let mut slopes: Vec<f64> = (0..count)
                .map(|i| {
                    let u = (f64::from(i) + random.unit()) / f64::from(count);
                    let m = surface.sample_vndf(w, DVec2::new(u, random.unit()));
                    m.x / m.z / unit
                })
                .collect();
            slopes.sort_by(f64::total_cmp);
            let all = seen_below(gamma, nu, f64::INFINITY);
            let distance = slopes.iter().enumerate().step_by(97).map(|(i, &y)| {
                let expected = seen_below(gamma, nu, y) / all;
                (expected - (i as f64 + 0.5) / f64::from(count)).abs()
            });
            let distance = distance.fold(0.0, f64::max);
            // Stratified samples of a map of few pieces; random ones would be at 0.02. The sign of
            // the middle part comes from the other number.
            let bound = if cot > 0.0 { 0.02 } else { 1e-3 };
            assert!(distance < bound, "γ = {gamma}, ν = {nu}: {distance}");
        }
    }
}

#[test]
fn batches_are_the_calls() {
    let surface = StudentT::anisotropic(0.2_f32, 0.5, 3.3).unwrap();
    let mut random = Random(3);
    let mut numbers = || (0..200).map(|_| random.unit() as f32 - 0.5).collect::<Vec<_>>();
    let (x, y, z) = (numbers(), numbers(), numbers());
    let mut out = vec![0.0; 200];
    surface.sigma_batch(Directions { x: &x, y: &y, z: &z }, &mut out);
    for i in 0..200 {
        let w = microsurface::glam::Vec3::new(x[i], y[i], z[i]);
        assert_eq!(out[i].to_bits(), surface.sigma(w).to_bits(), "{w}");
    }
}

#[test]
fn ends_of_the_random_numbers_give_finite_visible_normals() {
    for gamma in [1.5001_f32, 2.0, 3.5, 1e6] {
        let surface = StudentT::isotropic(0.1, gamma).unwrap();
        for z in [1.0_f32, 0.3, 1e-6, 0.0, -1e-6, -0.4] {
            let w = microsurface::glam::Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
            for u in [0.0_f32, 1e-9, 0.5, 1.0 - f32::EPSILON / 2.0, 1.0] {
                for v in [0.0_f32, 0.25, 0.5, 1.0] {
                    let u = microsurface::glam::Vec2::new(u, v);
                    let m = surface.sample_vndf(w, u);
                    assert!(m.is_normalized() && m.z >= 0.0 && w.dot(m) > 0.0, "γ {gamma} w {w} u {u}: {m}");
                    let m = surface.sample_d(u);
                    assert!(m.is_normalized() && m.z >= 0.0, "γ {gamma} u {u}: {m}");
                }
            }
        }
    }
}

#[test]
fn phong_is_a_power_of_the_cosine_with_an_exact_mask() {
    let (s, c) = 80.0_f64.to_radians().sin_cos();
    // Λ at 80°, by quadrature.
    for (exponent, lambda) in
        [(2.0, 0.983104665202641), (10.0, 0.313323846024574), (50.0, 0.0412319617490643)]
    {
        let phong = Phong::isotropic(exponent).unwrap();
        assert!((phong.lambda(DVec3::new(s, 0.0, c)) / lambda - 1.0).abs() < 1e-13, "{exponent}");
    }
    for exponent in [0.0, 0.3, 1.0, 7.0, 120.0, 1e5] {
        let phong = Phong::isotropic(exponent).unwrap();
        for i in 0..100 {
            let (s, c) = (f64::from(i) * 0.015).sin_cos();
            let exact = (exponent + 2.0) / core::f64::consts::TAU * c.powf(exponent);
            // An error of the cosine is one of the power, times the exponent.
            let bound = 4e-15 * (1.0 + exponent * (1.0 - c.ln()));
            let d = phong.d(DVec3::new(s, 0.0, c));
            assert!((d - exact).abs() <= bound * exact + 1e-290, "{exponent} at {c}: {d:e} {exact:e}");
        }
    }
    for exponent in [-1e-9, -1.0, f64::NAN, f64::INFINITY] {
        let error = Phong::isotropic(exponent).unwrap_err();
        assert!(matches!(error, Error::Parameter { name: "exponent", .. }), "{error}");
    }
}

#[test]
fn bad_exponents_are_refused_by_name() {
    for gamma in [1.5, 0.0, -2.0, f64::NAN, f64::INFINITY] {
        let error = StudentT::isotropic(0.3, gamma).unwrap_err();
        assert!(matches!(error, Error::Parameter { name: "gamma", .. }), "{error}");
    }
    assert!(matches!(StudentT::isotropic(0.0_f32, 2.0), Err(Error::Alpha { .. })));
}
