//! Surfaces convolved with Gaussians of slopes: against direct convolution, 30-digit values, and
//! each other.

use microsurface::filter::{Covariance, Footprint, gaussian};
use microsurface::glam::{DVec2, DVec3, Vec2};
use microsurface::{Beckmann, Ggx, Ndf, RoughnessMatrix, SampleNdf, SampleVndf};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::footprint;
use crate::quadrature::gauss_legendre;
use crate::random::uniform;

/// f(t + c) averaged over Gaussian c of covariance σ²ΔᵀΔ: the product rule of Gauss–Legendre within
/// 8.5 standard deviations along each of the footprint's steps.
fn convolved(
    f: impl Fn(DVec2) -> f64,
    slope: DVec2,
    footprint: &Footprint<f64>,
    variance: f64,
    panels: u32,
) -> f64 {
    let rule = gauss_legendre(16);
    let [u, v] = footprint.steps();
    let deviation = variance.sqrt();
    let reach = 8.5;
    let mut points = Vec::new();
    for panel in 0..panels {
        let width = 2.0 * reach / f64::from(panels);
        for &[x, w] in &rule {
            let z = -reach + width * (f64::from(panel) + 0.5 + 0.5 * x);
            points.push((z, 0.5 * width * w * (-0.5 * z * z).exp() / core::f64::consts::TAU.sqrt()));
        }
    }
    let mut sum = 0.0;
    for &(a, wa) in &points {
        for &(b, wb) in &points {
            sum += wa * wb * f(slope + deviation * (a * u + b * v));
        }
    }
    sum
}

#[test]
fn beckmann_filtered_is_the_convolution() {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let mut worst = 0.0_f64;
    for _ in 0..60 {
        let matrix =
            RoughnessMatrix::rotated(uniform(&mut rng, 0.3, 1.0), uniform(&mut rng, 0.3, 2.0), 0.4).unwrap();
        let surface = Beckmann::from_roughness_matrix(matrix);
        let (footprint, variance) = (footprint(&mut rng), uniform(&mut rng, 0.05, 0.3));
        let slope = DVec2::from_angle(uniform(&mut rng, 0.0, 6.3)) * uniform(&mut rng, 0.0, 2.0);
        let filtered = surface.filtered(footprint.covariance(variance)).unwrap();
        let exact = convolved(|t| surface.p22(t), slope, &footprint, variance, 12);
        worst = worst.max((filtered.p22(slope) / exact - 1.0).abs());
    }
    assert!(worst < 2e-13, "{worst:e}");
}

#[test]
fn the_integral_over_beckmann_surfaces_is_the_convolution_of_ggx() {
    let mut rng = Pcg64Mcg::seed_from_u64(2);
    let mut worst = 0.0_f64;
    for _ in 0..40 {
        let matrix =
            RoughnessMatrix::rotated(uniform(&mut rng, 0.5, 1.0), uniform(&mut rng, 0.5, 2.0), 0.4).unwrap();
        let surface = Ggx::from_roughness_matrix(matrix);
        let (footprint, variance) = (footprint(&mut rng), uniform(&mut rng, 0.05, 0.3));
        let slope = DVec2::from_angle(uniform(&mut rng, 0.0, 6.3)) * uniform(&mut rng, 0.0, 6.0);
        let exact = convolved(|t| surface.p22(t), slope, &footprint, variance, 24);
        let integral = gaussian::p22(&surface, slope, footprint.covariance(variance));
        worst = worst.max((integral / exact - 1.0).abs());
    }
    assert!(worst < 1e-12, "{worst:e}");
}

/// 30-digit values of tests/reference/filter_gaussian.py, isotropic: 2σ²/A, |t|²/A and the density.
#[test]
fn the_integral_is_exact_for_all_kernels() {
    let mut worst = 0.0_f64;
    for row in crate::accuracy::rows(include_str!("../../reference/filter_gaussian.tsv")) {
        let [s, q, p22] = [0, 1, 2].map(|i| crate::accuracy::number(row[i]));
        for alpha in [1.0, 1e-3] {
            let surface = Ggx::isotropic(alpha).unwrap();
            let kernel = Covariance::isotropic(0.5 * s * alpha * alpha);
            let value = gaussian::p22(&surface, DVec2::new(q.sqrt() * alpha, 0.0), kernel) * alpha * alpha;
            worst = worst.max((value / p22 - 1.0).abs());
        }
    }
    assert!(worst < 2e-13, "{worst:e}");
}

/// ½ ∫ |f − g| over the slopes of a unit surface, the largest |f/g − 1|, and f/g − 1 at the peak;
/// `stretch` holds the width of the filtered surface along the axes.
fn compared(f: impl Fn(DVec2) -> f64, g: impl Fn(DVec2) -> f64, stretch: DVec2, reach: f64) -> [f64; 3] {
    let (mut moved, mut largest) = (0.0, 0.0_f64);
    let rule = gauss_legendre(12);
    for i in 0..24 {
        let direction = DVec2::from_angle((f64::from(i) + 0.5) * core::f64::consts::FRAC_PI_2 / 24.0);
        for panel in 0..40 {
            let width = (9.0 + reach) / 40.0;
            for &[x, w] in &rule {
                let log = -9.0 + width * (f64::from(panel) + 0.5 + 0.5 * x);
                let slope = stretch * direction * log.exp();
                let area = stretch.x * stretch.y * (2.0 * log).exp() * core::f64::consts::TAU / 24.0;
                let (a, b) = (f(slope), g(slope));
                moved += 0.5 * 0.5 * width * w * area * (a - b).abs();
                largest = largest.max((a / b - 1.0).abs());
            }
        }
    }
    [moved, largest, f(DVec2::ZERO) / g(DVec2::ZERO) - 1.0]
}

/// The statements of the table in the documentation of `filter::gaussian`, from both sides: light
/// at wrong slopes, the largest relative error out to 1000 (isotropic) and 7 (others) widths of the
/// filtered surface, and at the peak.
#[test]
fn the_mixtures_are_as_near_to_the_convolution_as_stated() {
    let surface = Ggx::isotropic(1.0_f64).unwrap();
    let isotropic: Vec<[f64; 2]> =
        [-8, -6, -4, -2, 0, 1, 2, 3, 4, 5, 6, 7, 8, 10].map(|n| [f64::from(n).exp2(); 2]).to_vec();
    let lines: Vec<[f64; 2]> = (-8..=10).step_by(3).map(|n| [f64::from(n).exp2(), 0.0]).collect();
    // Every elongation; kernels up to 8000 α wide.
    let others: Vec<[f64; 2]> = [-2, 2, 5, 7, 10, 14, 20, 26]
        .into_iter()
        .flat_map(|n| {
            let across = [1, 3, 6, 11, 15, 19, 22, 25].into_iter().filter(move |m| *m < n + 6);
            let across = across.map(move |m| [f64::from(n).exp2(), f64::from(n - m).exp2()]);
            across.chain([[f64::from(n).exp2(), 0.0]])
        })
        .collect();
    // Of proxy, two and seven components; 0 where nothing is stated.
    let stated = [
        (isotropic, [[0.205, 1024.0, 0.24], [0.032, 0.33, 0.025], [0.0046, 0.33, 0.012]]),
        (lines, [[0.145, 29e3, 0.16], [0.11, 250.0, 0.037], [0.0125, 3.7, 0.012]]),
        (others, [[0.2, 0.0, 0.23], [0.126, 0.0, 0.051], [0.0125, 0.0, 0.005]]),
    ];
    for (shape, (kernels, stated)) in stated.iter().enumerate() {
        let mut worst = [[(0.0_f64, [0.0; 2]); 3]; 3];
        for &[s, across] in kernels {
            let kernel = Covariance::axis_aligned(0.5 * s, 0.5 * across);
            let [xx, _, yy] = kernel.entries();
            let stretch = DVec2::new(1.0 + 2.0 * xx, 1.0 + 2.0 * yy).map(f64::sqrt);
            let exact = |t: DVec2| gaussian::p22(&surface, t, kernel);
            let proxy = surface.filtered(kernel).unwrap();
            let two = gaussian::filtered_by_two(&surface, kernel).unwrap();
            let seven = gaussian::filtered(&surface, kernel).unwrap();
            let reach = if shape == 0 { 7.0 } else { 2.0 };
            let errors = [
                compared(|t| proxy.p22(t), exact, stretch, reach),
                compared(|t| two.p22(t), exact, stretch, reach),
                compared(|t| seven.p22(t), exact, stretch, reach),
            ];
            for (worst, error) in worst.as_flattened_mut().iter_mut().zip(errors.as_flattened()) {
                if error.abs() > worst.0 {
                    *worst = (error.abs(), [s, across]);
                }
            }
            // The statement about the tail of isotropic kernels up to σ = α.
            assert!(shape > 0 || s > 2.0 || errors[2][1] < 0.1, "{s} {errors:?}");
        }
        println!("{worst:.4?}");
        let both = worst.as_flattened().iter().zip(stated.as_flattened());
        for ((worst, at), stated) in both.filter(|(_, stated)| **stated > 0.0) {
            assert!(worst <= stated && *worst > 0.8 * stated, "{shape}: {worst} of {stated} at {at:?}");
        }
    }
}

/// The far tail, of an isotropic kernel, of a long one by two and of a long one by seven.
#[test]
fn tails_are_as_stated() {
    let surface = Ggx::isotropic(0.1_f64).unwrap();
    let tail =
        |f: &dyn Fn(DVec2) -> f64| [DVec2::X, DVec2::Y].map(|axis| f(1e7 * axis) / surface.p22(1e7 * axis));
    let near = |[x, y]: [f64; 2], ratio: f64| {
        assert!((x / ratio - 1.0).abs() < 1e-6 && (y * ratio - 1.0).abs() < 1e-6, "{x} {y} {ratio}");
    };
    let wide = gaussian::filtered_by_two(&surface, Covariance::isotropic(0.02)).unwrap();
    near(tail(&|t| wide.p22(t)), 1.0);
    let kernel = Covariance::new(0.5, 0.0, 1e-4).unwrap();
    let long = gaussian::filtered_by_two(&surface, kernel).unwrap();
    let [larger, smaller, _] = long.tail().1.roughness_matrix().unwrap().principal();
    assert!(larger > 2.0 * smaller);
    near(tail(&|t| long.p22(t)), (larger / smaller).powi(2));
    let seven = gaussian::filtered(&surface, kernel).unwrap();
    near(tail(&|t| seven.p22(t)), 1.0);
}

/// Masks, normalisation and samples of the mixture are those of a surface.
#[test]
fn the_mixture_is_a_surface() {
    let surface = Ggx::from_roughness_matrix(RoughnessMatrix::rotated(0.1, 0.3, 0.5).unwrap());
    let kernel = Covariance::new(0.04, 0.01, 0.01).unwrap();
    let filtered = gaussian::filtered(&surface, kernel).unwrap();
    let plane = crate::quadrature::Plane::heavy([[0.5, 0.1], [0.1, 0.3]], 0.1);
    for w in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.36, 0.93, 0.07]] {
        let w = crate::scalar::unit(w);
        let [normalisation, area] = plane.over_visible_normals(w, |m| {
            [filtered.vndf(w.into(), m.into()), filtered.d(m.into()) * crate::scalar::dot(m, w)]
        });
        assert!((normalisation.value - 1.0).abs() < 1e-8 + normalisation.bound, "{w:?} {normalisation:?}");
        let sigma = filtered.sigma(w.into());
        assert!((area.value / sigma - 1.0).abs() < 1e-8 + area.bound / sigma, "{w:?} {area:?} {sigma}");
        let below: f64 = filtered.sigma(-DVec3::from(w));
        assert!((sigma - below - w[2]).abs() < 1e-14, "{w:?}");
        let lambda = filtered.lambda(w.into());
        assert!((w[2] * (1.0 + lambda) - sigma).abs() < 1e-12 * sigma, "{w:?}");
    }
    // All samples are visible, and their means are those of the components by what is seen of each.
    let w = DVec3::new(0.36, 0.93, 0.07).normalize();
    let (n, m) = (100_u32, 2000_u32);
    let means = |sample: &dyn Fn(DVec2) -> DVec3| {
        let mut sums = [DVec3::ZERO; 2];
        for i in 0..n * m {
            let u =
                DVec2::new((f64::from(i % n) + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(m));
            let wm = sample(u);
            sums[0] += wm;
            sums[1] += wm * wm;
        }
        sums.map(|sum| sum / f64::from(n * m))
    };
    let visible = means(&|u| {
        let wm = filtered.sample_vndf(w, u);
        assert!(w.dot(wm) > 0.0 && filtered.vndf(w, wm) > 0.0);
        wm
    });
    let all = means(&|u| filtered.sample_d(u));
    let (weight, tail) = filtered.tail();
    let mut expected_visible = means(&|u| tail.sample_vndf(w, u)).map(|m| m * weight * tail.sigma(w));
    let mut expected_all = means(&|u| tail.sample_d(u)).map(|m| m * weight);
    let mut total = *weight;
    for (weight, core) in filtered.cores() {
        total += weight;
        for (sum, m) in expected_visible.iter_mut().zip(means(&|u| core.sample_vndf(w, u))) {
            *sum += m * weight * core.sigma(w);
        }
        for (sum, m) in expected_all.iter_mut().zip(means(&|u| core.sample_d(u))) {
            *sum += m * weight;
        }
    }
    assert!((total - 1.0).abs() < 1e-15, "{total}");
    let sigma = filtered.sigma(w);
    for k in 0..2 {
        assert!(
            visible[k].abs_diff_eq(expected_visible[k] / sigma, 1e-3),
            "{visible:?} {expected_visible:?}"
        );
        assert!(all[k].abs_diff_eq(expected_all[k], 1e-3), "{all:?} {expected_all:?}");
    }
}

#[test]
fn more_kernel_is_more_roughness() {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    for _ in 0..300 {
        let matrix =
            RoughnessMatrix::rotated(uniform(&mut rng, 0.01, 1.0), uniform(&mut rng, 0.01, 1.0), 0.4)
                .unwrap();
        let surface = Ggx::from_roughness_matrix(matrix);
        let (first, second) = (footprint(&mut rng).covariance(0.25), footprint(&mut rng).covariance(0.1));
        let once = surface.filtered(first).unwrap();
        // Nested filters are one of the sum, in any order.
        let nested = once.filtered(second).unwrap();
        let both = surface.filtered(second + first).unwrap();
        let (nested, det) = super::matrix(nested.map());
        let (both, det_both) = super::matrix(both.map());
        for (a, b) in nested.iter().zip(both) {
            assert!((a - b).abs() < 1e-13 * (both[0] + both[2]), "{nested:?} {both:?}");
        }
        assert!((det / det_both - 1.0).abs() < 1e-13);
        // A' − A is 2Σ, positive semidefinite, and the peak falls.
        let (a, _) = super::matrix(surface.map());
        let (b, _) = super::matrix(once.map());
        for ((a, b), sigma) in a.iter().zip(b).zip(first.entries()) {
            assert!((b - a - 2.0 * sigma).abs() < 1e-13 * (b.abs() + a.abs() + 1e-3));
        }
        assert!(once.p22(DVec2::ZERO) < surface.p22(DVec2::ZERO));
        assert!(once.change_by_filter(second) > 0.0);
    }
}

#[test]
fn what_a_filter_would_change_is_known_before() {
    let mut rng = Pcg64Mcg::seed_from_u64(4);
    let (mut beckmann_worst, mut tightest) = (0.0_f64, 0.0_f64);
    for _ in 0..400 {
        let (ax, ay) = (uniform(&mut rng, 0.02, 1.0), uniform(&mut rng, 0.02, 1.0));
        let kernel = footprint(&mut rng).scaled(uniform(&mut rng, -8.0, 0.0).exp2()).covariance(0.25);
        let beckmann = Beckmann::anisotropic(ax, ay).unwrap();
        let fallen = 1.0 - beckmann.filtered(kernel).unwrap().p22(DVec2::ZERO) / beckmann.p22(DVec2::ZERO);
        beckmann_worst =
            beckmann_worst.max((beckmann.change_by_filter(kernel) / fallen - 1.0).abs().min(1e9 * fallen));
        let ggx = Ggx::anisotropic(ax, ay).unwrap();
        let fallen = 1.0 - gaussian::p22(&ggx, DVec2::ZERO, kernel) / ggx.p22(DVec2::ZERO);
        let change = ggx.change_by_filter(kernel);
        assert!(fallen > 0.999 * change - 1e-13 && fallen < 2.0 * change + 1e-13, "{fallen:e} {change:e}");
        // At any slope, where the bound is small.
        let slope = DVec2::from_angle(uniform(&mut rng, 0.0, 6.3)) * uniform(&mut rng, -6.0, 3.0).exp2();
        let bound = ggx.change_by_filter_at(slope, kernel);
        if bound < 0.1 {
            let change = (gaussian::p22(&ggx, slope, kernel) / ggx.p22(slope) - 1.0).abs();
            assert!(change <= bound + 1e-13, "{change:e} {bound:e}");
            tightest = tightest.max(change / bound);
        }
    }
    assert!(beckmann_worst < 1e-4, "{beckmann_worst:e}");
    assert!(tightest > 0.3, "a bound so wide is of no use: {tightest}");
    let surface = Ggx::isotropic(0.1).unwrap();
    // The limit of small changes is 10 in place of 12 for a line along the slope, far out. Beyond
    // it 10 is no bound.
    let far = |share: f64| {
        let (slope, kernel) = (DVec2::new(100.0, 0.0), Covariance::new(share * 1e4, 0.0, 0.0).unwrap());
        let change = gaussian::p22(&surface, slope, kernel) / surface.p22(slope) - 1.0;
        (change, surface.change_by_filter_at(slope, kernel))
    };
    let (change, bound) = far(1e-5);
    assert!((change / bound - 10.0 / 12.0).abs() < 1e-3, "{change:e} {bound:e}");
    let (change, bound) = far(0.0081);
    assert!(bound < 0.1 && change > 0.9 * bound && change <= bound, "{change:e} {bound:e}");
    // A + 2Σ changes the tail by a share that does not fall: tr(A⁻¹Σ), and 3 times that along a
    // line.
    let (slope, line) = (DVec2::new(300.0, 0.0), Covariance::new(1e-7, 0.0, 0.0).unwrap());
    for (kernel, share) in [(Covariance::isotropic(1e-6), 2e-4), (line, 3e-5)] {
        let change = surface.filtered(kernel).unwrap().p22(slope) / surface.p22(slope) - 1.0;
        assert!((change / share - 1.0).abs() < 1e-3, "{change:e} {share:e}");
        assert!(surface.change_by_filter_at(slope, kernel) < 0.01 * change);
    }
    assert_eq!(surface.change_by_filter(Covariance::zero()), 0.0);
    assert!(surface.change_by_filter(Covariance::isotropic(f64::NAN)).is_nan());
}

/// Anything finite gives numbers, and every sample a density.
#[test]
fn the_mixture_is_sound_at_the_ends_of_the_domain() {
    let mut rng = Pcg64Mcg::seed_from_u64(6);
    for _ in 0..20_000 {
        let alpha = [(); 2].map(|()| uniform(&mut rng, -13.0, 0.0).exp2() as f32);
        let footprint = footprint(&mut rng).scaled(uniform(&mut rng, -20.0, 2.0).exp2());
        let [du, dv] = footprint.steps().map(DVec2::as_vec2);
        let kernel = Footprint::<f32>::new(du, dv).covariance(0.25);
        let surface = Ggx::anisotropic(alpha[0], alpha[1]).unwrap();
        let z = uniform(&mut rng, -40.0, 0.0).exp2() * if rng.random_bool(0.3) { -1.0 } else { 1.0 };
        let w = (DVec2::from_angle(uniform(&mut rng, 0.0, 6.3)) * (1.0 - z * z).sqrt()).extend(z).as_vec3();
        let corner = [0.0, 0.5, 1.0 - 2_f32.powi(-24), uniform(&mut rng, 0.0, 1.0) as f32];
        let u = Vec2::new(corner[rng.random_range(0..4)], corner[rng.random_range(0..4)]);
        let sound = |wm: microsurface::glam::Vec3, [d, vndf, g1, sigma]: [f32; 4]| {
            assert!(
                (wm.length() - 1.0).abs() < 1e-5 && w.dot(wm) > 0.0,
                "{alpha:?} {kernel:?} {w} {u}: {wm}"
            );
            assert!(
                d >= 0.0 && vndf > 0.0 && (0.0..=1.0).contains(&g1),
                "{alpha:?} {kernel:?} {w} {u}: {d} {vndf} {g1}"
            );
            assert!(sigma >= w.z.max(0.0), "{alpha:?} {kernel:?} {w}: {sigma}");
        };
        let seven = gaussian::filtered(&surface, kernel).unwrap();
        let wm = seven.sample_vndf(w, u);
        sound(wm, [seven.d(wm), seven.vndf(w, wm), seven.g1(w, wm), seven.sigma(w)]);
        let two = gaussian::filtered_by_two(&surface, kernel).unwrap();
        let wm = two.sample_vndf(w, u);
        sound(wm, [two.d(wm), two.vndf(w, wm), two.g1(w, wm), two.sigma(w)]);
    }
}
