//! The published approximations that the crate offers beside the exact functions are what their
//! documentation says: Walter's Beckmann mask, the spline mask of GTR, Beckmann with the quicker
//! sampling.

use microsurface::beckmann::BeckmannTo1e6;
use microsurface::filter::{Footprint, polygon};
use microsurface::gtr::Density;
use microsurface::gtr::spline::Spline;
use microsurface::{
    Beckmann, Gtr, Isotropic, Microsurface, Ndf, Real, RoughnessMatrix, SampleNdf, SampleVndf, glam::DVec3,
};

/// The direction of this cotangent.
fn direction(cot: f64) -> DVec3 {
    DVec3::new(1.0, 0.0, cot).normalize()
}

#[test]
fn walter_is_as_far_from_beckmann_as_documented() {
    let surface = Beckmann::isotropic(1.0).unwrap();
    let (mut worst, mut at, mut above_one, mut worst_lambda) = (0.0_f64, 0.0, 0.0_f64, 0.0_f64);
    for i in 1..200_000 {
        let a = f64::from(i) * 1e-5;
        let w = direction(a);
        let (exact, fit) = (surface.g1(w, w), surface.g1_walter2007(w));
        if (fit - exact).abs() > worst {
            (worst, at) = ((fit - exact).abs(), a);
        }
        above_one = above_one.max(fit - 1.0);
        let (exact, fit) = (surface.lambda(w), surface.lambda_walter2007(w));
        assert!(a >= 1.6 || (surface.g1_walter2007(w) * (1.0 + fit) - 1.0).abs() < 1e-14);
        if (0.1..=1.0).contains(&a) {
            worst_lambda = worst_lambda.max((fit / exact - 1.0).abs());
        }
    }
    // Computed at 50 digits: tests/reference/numbers.tsv.
    assert!((worst - 3.108505e-3).abs() < 1e-9 && (at - 1.33828).abs() < 1e-4, "{worst} at {at}");
    assert!((above_one - 6.13393e-5).abs() < 1e-9, "{above_one}");
    assert!((worst_lambda - 0.04614).abs() < 1e-5, "{worst_lambda}");
    let beyond = direction(1.7);
    assert!(surface.g1_walter2007(beyond) >= 1.0 && surface.lambda_walter2007(beyond) <= 0.0);
}

/// All but the visible normals of f32.
#[test]
fn beckmann_to_1e_6_is_beckmann() {
    fn check<T: Real>(different_normals: usize) {
        let l = T::lit;
        let matrix = RoughnessMatrix::new(l(0.3), l(0.1), l(0.2)).unwrap();
        let quick = BeckmannTo1e6::from_roughness_matrix(matrix);
        let exact = Beckmann::from_roughness_matrix(matrix);
        let step: (T::Vec2, T::Vec2) = ([l(0.1), l(0.05)].into(), [l(-0.1), l(0.2)].into());
        let mut different = 0;
        for i in 0..200 {
            let (cos, turn) = (f64::from(i) / 100.0 - 0.995, f64::from(i));
            let sin = (1.0 - cos * cos).sqrt();
            let w: T::Vec3 = [l(sin * turn.cos()), l(sin * turn.sin()), l(cos)].into();
            let u: T::Vec2 = [l(0.381 * turn % 1.0), l(0.618 * turn % 1.0)].into();
            assert_eq!(quick.d(w), exact.d(w));
            assert_eq!(quick.sigma(w), exact.sigma(w));
            assert_eq!(quick.lambda(w), exact.lambda(w));
            assert_eq!(quick.sample_d(u), exact.sample_d(u));
            assert_eq!(
                polygon::mean_p22(&quick, u, step.0, step.1),
                polygon::mean_p22(&exact, u, step.0, step.1)
            );
            different += usize::from(quick.sample_vndf(w, u) != exact.sample_vndf(w, u));
        }
        assert!(different >= different_normals, "{different}");
        assert_eq!(different == 0, different_normals == 0);
        let covariance = Footprint::<T>::new(step.0, step.1).covariance(l(0.25));
        assert_eq!(quick.filtered(covariance).unwrap().map(), exact.filtered(covariance).unwrap().map());
    }
    check::<f32>(100);
    check::<f64>(0);
}

/// A natural cubic spline through five values at 0, 1, 2, 3, 4, by elimination: independent of the
/// crate's weights.
fn natural_spline(values: [f64; 5], x: f64) -> f64 {
    let mut second = [0.0; 5];
    let mut diagonal = [4.0; 3];
    let mut right: [f64; 3] =
        core::array::from_fn(|i| 6.0 * (values[i] - 2.0 * values[i + 1] + values[i + 2]));
    for i in 1..3 {
        let factor = 1.0 / diagonal[i - 1];
        diagonal[i] -= factor;
        right[i] -= factor * right[i - 1];
    }
    second[3] = right[2] / diagonal[2];
    for i in (0..2).rev() {
        second[i + 1] = (right[i] - second[i + 2]) / diagonal[i];
    }
    let (left, t) =
        [(0, x), (1, x - 1.0), (2, x - 2.0), (3, x - 3.0)].into_iter().rfind(|(_, t)| *t >= 0.0).unwrap();
    let s = 1.0 - t;
    s * values[left]
        + t * values[left + 1]
        + ((s * s * s - s) * second[left] + (t * t * t - t) * second[left + 1]) / 6.0
}

/// Dimov's printed G1 at γ = 0 … 4, as functions of μ = cot θ and α: the papers' formulas, not the
/// crate's.
fn dimov(alpha: f64, mu: f64) -> [f64; 5] {
    let t = alpha * alpha;
    let r = (mu * mu + t).sqrt();
    let unit = (mu * mu + 1.0).sqrt();
    let a4 = 8.0 * t * t + 8.0 * t + 8.0;
    [
        2.0 / (1.0 + (1.0 / (mu * mu) + 1.0).sqrt()),
        mu * t.ln() / (r - unit + mu * (t * (mu + unit) / (mu + r)).ln()),
        2.0 / (1.0 + (t / (mu * mu) + 1.0).sqrt()),
        4.0 * (t + 1.0) * mu * r / (t * (3.0 * t + 1.0) + 2.0 * mu * (t + 1.0) * (mu + r)),
        2.0 * a4 * mu * r.powi(3)
            / (a4 * mu * (r.powi(3) + mu.powi(3))
                + 3.0 * t * (t * (5.0 * t * t + 2.0 * t + 1.0) + 4.0 * mu * mu * (2.0 * t * t + t + 1.0))),
    ]
}

fn masking(alpha: f64, gamma: f64) -> Microsurface<Gtr<f64, Spline<f64>>, Isotropic<f64>> {
    Gtr::spline(alpha, gamma).unwrap()
}

#[test]
fn the_spline_is_that_of_the_papers() {
    for alpha in [0.01, 0.05, 0.3, 0.8] {
        for i in 0..=80 {
            let gamma = f64::from(i) / 20.0;
            let surface = masking(alpha, gamma);
            for mu in [0.01, 0.1, 0.5, 1.0, 4.0] {
                let w = direction(mu);
                let papers = natural_spline(dimov(alpha, mu), gamma);
                let raw = surface.profile().masking().g1(1.0 - w.z * w.z, w.z);
                assert!((raw - papers).abs() < 1e-12, "α {alpha} γ {gamma} μ {mu}: {raw} {papers}");
                // The surface only keeps it within the range of all GTR masks.
                let limited = papers.clamp(dimov(alpha, mu)[0], 1.0);
                assert!((surface.g1(w, w) - limited).abs() < 1e-12, "α {alpha} γ {gamma} μ {mu}");
            }
        }
    }
}

#[test]
fn the_spline_is_as_far_from_the_exact_mask_as_documented() {
    // 30-digit masks at the γ between the knots; the largest errors of a fine scan are in
    // numbers.tsv.
    let documented = [(1e-3, 0.336), (0.01, 0.170), (0.05, 0.0591), (0.1, 0.0290), (0.8, 1.6e-4)];
    for (alpha, bound) in documented {
        let mut worst = 0.0_f64;
        for line in include_str!("../reference/masking_gtr.tsv").lines().filter(|l| !l.starts_with('#')) {
            let column: Vec<&str> = line.split('\t').collect();
            let number = |i: usize| column[i].parse::<f64>().unwrap();
            let (gamma, z) = (number(3), number(6));
            if (number(1) / alpha - 1.0).abs() > 1e-6 || gamma > 4.0 || z <= 0.0 {
                continue;
            }
            let w = DVec3::new(number(4), number(5), z);
            let raw = masking(number(1), gamma).profile().masking().g1(w.x * w.x + w.y * w.y, w.z);
            worst = worst.max((raw - z / number(7)).abs());
        }
        // The table's γ and angles are few, so they come near the scan's worst without reaching it.
        assert!(worst <= bound && worst > 0.3 * bound, "α = {alpha}: {worst}, documented {bound}");
    }
}

#[test]
fn the_overshoot_of_the_spline_is_as_documented() {
    let (mut lowest, mut highest) = (1.0_f64, 0.0_f64);
    for i in 0..=400 {
        let surface = masking(0.01, f64::from(i) / 100.0);
        for j in 0..400 {
            let w = direction(10_f64.powf(f64::from(j) / 100.0 - 3.0));
            let raw = surface.profile().masking().g1(1.0 - w.z * w.z, w.z);
            lowest = lowest.min(raw);
            highest = highest.max(raw);
            let g1 = surface.g1(w, w);
            assert!((0.0..=1.0).contains(&g1) && surface.lambda(w) >= 0.0);
        }
    }
    assert!((lowest + 0.0354).abs() < 2e-4 && (highest - 1.0594).abs() < 2e-4, "{lowest} {highest}");
}

/// D(γ) at a micronormal, whose squared sine is `sin2`.
fn density(alpha: f64, gamma: f64, sin2: f64) -> f64 {
    Density::new(alpha, gamma).unwrap().d(DVec3::new(sin2.sqrt(), 0.0, (1.0 - sin2).sqrt()))
}

#[test]
fn gtr_is_smooth_across_gamma_one() {
    for alpha in [1e-4, 0.01, 0.3, 0.9, 1.0] {
        for sin2 in [0.0, 0.25 * alpha * alpha, 0.3, 0.9] {
            let at = |excess: f64| density(alpha, 1.0 + excess, sin2);
            let middle = at(0.0);
            // d ln D/dγ at 1, from the limit of the normalisation: ln v' with v' = α² + sin²θ(1 −
            // α²), and d/dγ ln[(γ−1)/(1 − α^{2−2γ})] = ½ ln α².
            let log = 2.0 * alpha.ln();
            let exact = 0.5 * log - (alpha * alpha + sin2 * (1.0 - alpha * alpha)).ln();
            for h in [1e-4, 1e-5, 1e-6] {
                let (left, right) = ((middle - at(-h)) / (h * middle), (at(h) - middle) / (h * middle));
                // The one-sided slopes differ from the derivative by h times the second one, and by
                // the rounding of D over h: no jump of either.
                let tolerance = h * (exact * exact + log * log + 1.0) + 1e-14 / h;
                assert!(
                    (left - exact).abs() < tolerance && (right - exact).abs() < tolerance,
                    "α {alpha} sin² {sin2} h {h}: {left} {right}, exact {exact}"
                );
            }
            // Down to the last digits of γ.
            for h in [1e-12, f64::EPSILON, -0.5 * f64::EPSILON] {
                assert!((at(h) / middle - 1.0 - h * exact).abs() < 1e-14, "α {alpha} sin² {sin2} h {h}");
            }
        }
    }
}

#[test]
fn masks_meet_at_integer_gamma_and_at_alpha_one() {
    for mu in [1e-3, 0.1, 1.0, 10.0] {
        let w = direction(mu);
        for alpha in [1e-3, 0.2, 0.9] {
            let closed = [
                Gtr::closed::<0>(alpha).unwrap().lambda(w),
                Gtr::closed::<1>(alpha).unwrap().lambda(w),
                Gtr::closed::<2>(alpha).unwrap().lambda(w),
                Gtr::closed::<3>(alpha).unwrap().lambda(w),
                Gtr::closed::<4>(alpha).unwrap().lambda(w),
            ];
            for (gamma, lambda) in (0_u8..).zip(closed) {
                let gamma = f64::from(gamma);
                let exact_g1 = 1.0 / (1.0 + lambda);
                assert!((masking(alpha, gamma).g1(w, w) - exact_g1).abs() < 1e-13);
                for h in [-1e-7, 1e-7] {
                    if (0.0..=4.0).contains(&(gamma + h)) {
                        assert!((masking(alpha, gamma + h).g1(w, w) - exact_g1).abs() < 1e-6);
                    }
                }
            }
        }
        // α = 1: every γ is the same distribution, γ = 0.
        let limit = Gtr::closed::<0>(1.0).unwrap().lambda(w);
        let one = Gtr::closed::<1>(1.0).unwrap().lambda(w);
        let four = Gtr::closed::<4>(1.0).unwrap().lambda(w);
        assert!((one / limit - 1.0).abs() < 1e-13 && (four / limit - 1.0).abs() < 1e-13);
        assert!((density(1.0, 7.3, 0.5) * f64::PI - 1.0).abs() < 1e-14);
    }
}
