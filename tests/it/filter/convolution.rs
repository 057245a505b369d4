//! Surfaces convolved with Gaussians of slopes: against direct convolution, 50-digit values, and each other.

use microsurface::filter::{Covariance, Footprint, determinant_tokuyoshi2019, gaussian};
use microsurface::glam::{DMat2, DVec2, DVec3, Vec2};
use microsurface::{Beckmann, Error, Ggx, Ndf, RoughnessMatrix, SampleNdf, SampleVndf};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::uniform;
use crate::quadrature::gauss_legendre;

/// A footprint as it comes: any shape and size, in slopes.
fn footprint(rng: &mut Pcg64Mcg) -> Footprint<f64> {
    let [u, v] = [(); 2].map(|()| {
        let length = uniform(rng, -6.0, 1.0).exp2();
        DVec2::from_angle(uniform(rng, 0.0, 6.3)) * length
    });
    Footprint::new(u, if rng.random_bool(0.3) { 1e-3 * v + 0.4 * u } else { v })
}

/// f(t + c) averaged over Gaussian c of covariance σ²ΔᵀΔ: the product rule of Gauss–Legendre within 8.5 standard
/// deviations along each of the footprint's steps.
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
        let integral = gaussian::p22(&surface, footprint.covariance(variance), slope);
        worst = worst.max((integral / exact - 1.0).abs());
    }
    assert!(worst < 1e-12, "{worst:e}");
}

/// 50-digit values of tests/reference/filter_gaussian.py, isotropic: 2σ²/A, |t|²/A and the density.
#[test]
fn the_integral_is_exact_for_all_kernels() {
    let mut worst = 0.0_f64;
    for row in crate::accuracy::rows(include_str!("../../reference/filter_gaussian.tsv")) {
        let [s, q, p22] = [0, 1, 2].map(|i| crate::accuracy::number(row[i]));
        for alpha in [1.0, 1e-3] {
            let surface = Ggx::isotropic(alpha).unwrap();
            let kernel = Covariance::isotropic(0.5 * s * alpha * alpha);
            let value = gaussian::p22(&surface, kernel, DVec2::new(q.sqrt() * alpha, 0.0)) * alpha * alpha;
            worst = worst.max((value / p22 - 1.0).abs());
        }
    }
    assert!(worst < 2e-13, "{worst:e}");
}

/// ½ ∫ |f − g| over the slopes of a unit surface, the largest |f/g − 1|, and f/g − 1 at the peak; `stretch` holds the
/// width of the filtered surface along the axes.
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

/// The statements of the table in the documentation of `filter::gaussian`, from both sides: light at wrong slopes, the
/// largest relative error out to 1000 (isotropic) and 7 (line) widths of the filtered surface, and at the peak.
#[test]
fn the_mixtures_are_as_near_to_the_convolution_as_stated() {
    let surface = Ggx::isotropic(1.0_f64).unwrap();
    // Of proxy, two and seven components.
    let stated = [
        [[0.205, 1024.0, 0.24], [0.032, 0.33, 0.025], [0.0046, 0.33, 0.012]],
        [[0.145, 29e3, 0.16], [0.115, 400.0, 0.075], [0.0105, 70.0, 0.012]],
    ];
    for (shape, stated) in stated.iter().enumerate() {
        let mut worst = [[0.0_f64; 3]; 3];
        for exponent in [-8, -6, -4, -2, 0, 1, 2, 3, 4, 5, 6, 7, 8, 10] {
            let s = f64::from(exponent).exp2();
            let kernel = Covariance::axis_aligned(0.5 * s, if shape == 0 { 0.5 * s } else { 0.0 });
            let [xx, _, yy] = kernel.entries();
            let stretch = DVec2::new(1.0 + 2.0 * xx, 1.0 + 2.0 * yy).map(f64::sqrt);
            let exact = |t: DVec2| gaussian::p22(&surface, kernel, t);
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
                *worst = worst.max(error.abs());
            }
            // The statement about the tail of isotropic kernels up to σ = α.
            assert!(shape == 1 || s > 2.0 || errors[2][1] < 0.1, "{s} {errors:?}");
        }
        for (worst, stated) in worst.as_flattened().iter().zip(stated.as_flattened()) {
            assert!(worst <= stated && *worst > 0.8 * stated, "{shape}: {worst} {stated}");
        }
    }
}

/// Masks, normalisation and samples of the mixture are those of a surface.
#[test]
fn the_mixture_is_a_surface() {
    let surface = Ggx::from_roughness_matrix(RoughnessMatrix::rotated(0.1, 0.3, 0.5).unwrap());
    let kernel = Covariance::new(0.04, 0.01, 0.01).unwrap();
    let filtered = gaussian::filtered(&surface, kernel).unwrap();
    // Its slopes are twice the unit circle's at most: all but 1e-9 of them within 1e4.
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
    let (n, m) = (100_usize, 2000);
    let means = |sample: &dyn Fn(DVec2) -> DVec3| {
        let mut sums = [DVec3::ZERO; 2];
        for i in 0..n * m {
            let u = DVec2::new(((i % n) as f64 + 0.5) / n as f64, ((i / n) as f64 + 0.5) / m as f64);
            let wm = sample(u);
            sums[0] += wm;
            sums[1] += wm * wm;
        }
        sums.map(|sum| sum / (n * m) as f64)
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
fn determinants_of_thin_kernels_keep_their_digits() {
    let mut lost = 0.0_f64;
    let mut kept = 0.0_f64;
    for i in 0..200 {
        let angle = 0.1 + 0.007 * f64::from(i);
        let (s, c) = (angle.sin() as f32, angle.cos() as f32);
        let footprint = Footprint::<f32>::new(Vec2::new(c, s), Vec2::new(1e-4 * s, -1e-4 * c));
        let alpha = 0.01_f32;
        let kernel = footprint.covariance(0.25);
        let filtered = Ggx::isotropic(alpha).unwrap().filtered(kernel).unwrap();
        // det(αI + 2Σ) in f64: the steps are at right angles up to rounding.
        let wide =
            Footprint::<f64>::new(DVec2::new(c.into(), s.into()), Vec2::new(1e-4 * s, -1e-4 * c).as_dvec2());
        let (a2, [xx, xy, yy]) = (f64::from(alpha).powi(2), wide.covariance(0.25).entries());
        let exact = a2 * a2 + 2.0 * a2 * (xx + yy) + 4.0 * (xx * yy - xy * xy);
        let (_, det) = super::matrix(filtered.map());
        kept = kept.max((det / exact - 1.0).abs());
        let matrix = RoughnessMatrix::new(alpha * alpha, 0.0, alpha * alpha).unwrap();
        lost = lost.max((f64::from(determinant_tokuyoshi2019(&matrix, kernel)) / exact - 1.0).abs());
    }
    // f32 rounds at 6e-8.
    assert!(kept < 5e-7 && lost > 1e-4, "{kept:e} {lost:e}");
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
        let fallen = 1.0 - gaussian::p22(&ggx, kernel, DVec2::ZERO) / ggx.p22(DVec2::ZERO);
        let change = ggx.change_by_filter(kernel);
        assert!(fallen > 0.999 * change - 1e-13 && fallen < 2.0 * change + 1e-13, "{fallen:e} {change:e}");
        // At any slope, where the bound is small.
        let slope = DVec2::from_angle(uniform(&mut rng, 0.0, 6.3)) * uniform(&mut rng, -6.0, 3.0).exp2();
        let bound = ggx.change_by_filter_at(slope, kernel);
        if bound < 0.1 {
            let change = (gaussian::p22(&ggx, kernel, slope) / ggx.p22(slope) - 1.0).abs();
            assert!(change <= bound + 1e-13, "{change:e} {bound:e}");
            tightest = tightest.max(change / bound);
        }
    }
    assert!(beckmann_worst < 1e-4, "{beckmann_worst:e}");
    assert!(tightest > 0.3, "a bound so wide is of no use: {tightest}");
    let surface = Ggx::isotropic(0.1).unwrap();
    assert_eq!(surface.change_by_filter(Covariance::zero()), 0.0);
    assert!(surface.change_by_filter(Covariance::isotropic(f64::NAN)).is_nan());
}

#[test]
fn covariances_are_positive_semidefinite_and_add_up() {
    assert!(matches!(Covariance::new(1.0, 1.1, 1.0), Err(Error::Covariance { xy: 1.1, .. })));
    assert!(Covariance::new(-1e-9, 0.0, 1.0).is_err() && Covariance::new(f64::NAN, 0.0, 1.0).is_err());
    assert!(Covariance::new(f64::INFINITY, 0.0, 1.0).is_err() && Covariance::new(0.0, 0.1, 0.0).is_err());
    assert!(Covariance::new(0.0_f32, 0.0, 0.0).is_ok() && Covariance::new(0.0_f32, 0.0, 2.0).is_ok());
    assert_eq!(Covariance::nearest(1.0, 2.0, 1.0).entries(), [1.0, 1.0, 1.0]);
    assert_eq!(Covariance::nearest(-1e-9, 1e-9, 1.0).entries(), [0.0, 0.0, 1.0]);
    let mut rng = Pcg64Mcg::seed_from_u64(5);
    for _ in 0..300 {
        let f = footprint(&mut rng);
        let (a, b) = (f.covariance(0.25), footprint(&mut rng).covariance(0.5));
        let near =
            |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-13 * (1.0 + y.abs()));
        let [[xx, xy, yy], other] = [a, b].map(|c| c.entries());
        assert!(near((a + b).entries(), [xx + other[0], xy + other[1], yy + other[2]]));
        assert!(near(Covariance::new(xx, xy, yy).map_or(a, |c| c).entries(), [xx, xy, yy]));
        assert!(near(a.scaled(3.0).entries(), [3.0 * xx, 3.0 * xy, 3.0 * yy]));
        let j = DMat2::from_cols_array(&[0.3, 1.2, -0.7, 0.4]);
        let moved = j * DMat2::from_cols_array(&[xx, xy, xy, yy]) * j.transpose();
        assert!(near(a.transformed(j).entries(), [moved.x_axis.x, moved.x_axis.y, moved.y_axis.y]));
        assert!(near(f.transformed(j).covariance(0.25).entries(), a.transformed(j).entries()));
        let [large, small, angle] = a.principal();
        let (s, c) = angle.sin_cos();
        assert!(near(
            [xx, xy, yy],
            [large * c * c + small * s * s, (large - small) * s * c, large * s * s + small * c * c]
        ));
        // Limited: the eigenvectors stay.
        let limit = uniform(&mut rng, 0.0, 1.0) * large;
        let clamped = a.clamped(limit).principal();
        assert!((clamped[0] - limit).abs() < 1e-12 && (clamped[1] - small.min(limit)).abs() < 1e-12);
        assert!(
            small > 0.999 * limit || ((clamped[2] - angle).sin() * (limit - small)).abs() < 1e-9,
            "{clamped:?} {angle}"
        );
        assert_eq!(a.clamped(large * 1.001), a);
        // A footprint within bounds.
        let clamped = f.clamped(0.1);
        assert!(clamped.extents().max_element() < 0.1 * (1.0 + 1e-15));
        let bounds = f.covariance_of_bounds(0.25).entries();
        assert!(bounds[0] >= xx * (1.0 - 1e-14) && bounds[2] >= yy * (1.0 - 1e-14));
        assert_eq!(f.clamped_extents(0.2), f.extents().min(DVec2::splat(0.2)));
    }
}

#[test]
fn what_is_not_finite_is_refused_or_the_largest_kernel() {
    let surface = Beckmann::isotropic(0.1_f32).unwrap();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for (u, v) in [
            (Vec2::new(bad, 0.0), Vec2::Y),
            (Vec2::X, Vec2::new(0.0, bad)),
            (Vec2::splat(bad), Vec2::splat(bad)),
        ] {
            let footprint = Footprint::<f32>::new(u, v);
            assert!(!footprint.is_finite());
            assert!(matches!(surface.filtered(footprint.covariance(0.25)), Err(Error::Covariance { .. })));
            assert!(
                gaussian::filtered(&Ggx::isotropic(0.1_f32).unwrap(), footprint.covariance(0.25)).is_err()
            );
            let clamped = footprint.clamped(1.0);
            assert_eq!(clamped.steps(), [Vec2::X, Vec2::Y]);
            assert_eq!(footprint.clamped_extents(1.0), Vec2::ONE);
            assert_eq!(footprint.covariance(0.25).clamped(0.09), Covariance::isotropic(0.09));
            assert!(surface.filtered(clamped.covariance(0.25)).unwrap().p22(Vec2::ZERO) > 0.0);
        }
    }
    // Finite, and too large.
    let huge = Covariance::isotropic(1e30_f32);
    let message = surface.filtered(huge).unwrap_err().to_string();
    assert!(message.starts_with("covariance") && message.ends_with("too large"), "{message}");
    let point = Footprint::<f32>::new(Vec2::ZERO, Vec2::ZERO);
    assert_eq!(point.clamped(1.0), point);
    assert_eq!(surface.filtered(point.covariance(0.25)).unwrap().p22(Vec2::ZERO), surface.p22(Vec2::ZERO));
}
