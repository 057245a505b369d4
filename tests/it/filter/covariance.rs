//! Covariances and footprints by themselves, and what of them is refused.

use microsurface::filter::{Covariance, Footprint, determinant_tokuyoshi2019, gaussian};
use microsurface::glam::{DMat2, DVec2, Vec2};
use microsurface::{Beckmann, Error, Ggx, Ndf, RoughnessMatrix};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::footprint;
use crate::random::uniform;

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

#[test]
fn covariances_are_checked_over_the_whole_range_of_f64() {
    for scale in [1e-300, 1e-200, 1e-100, 1.0, 1e100, 1e200, 1e300] {
        assert!(Covariance::new(scale, 10.0 * scale, scale).is_err(), "{scale:e}");
        let near = |[xx, xy, yy]: [f64; 3]| {
            let exact = [4.0, 1.0, 2.0].map(|entry| entry * scale);
            [xx, xy, yy].iter().zip(exact).all(|(x, y)| (x / y - 1.0).abs() < 1e-14)
        };
        let covariance = Covariance::new(4.0 * scale, scale, 2.0 * scale).unwrap();
        assert!(near(covariance.entries()), "{covariance:?}");
        assert!(near(Covariance::nearest(4.0 * scale, scale, 2.0 * scale).entries()));
        let [large, small, _] = covariance.principal().map(|x| x / scale);
        assert!(
            (large - (3.0 + 2.0_f64.sqrt())).abs() < 1e-14 && (small - (3.0 - 2.0_f64.sqrt())).abs() < 1e-14
        );
        let limited = Covariance::nearest(4.0 * scale, -9.0 * scale, scale).entries().map(|x| x / scale);
        assert!((limited[1] + 2.0).abs() < 1e-14 && (limited[2] - 1.0).abs() < 1e-14, "{limited:?}");
    }
    // What no filter can hold is refused by the filter.
    let refused = Ggx::isotropic(0.1).unwrap().filtered(Covariance::new(1e200, 0.0, 1e200).unwrap());
    assert!(matches!(refused, Err(Error::Covariance { .. })));
    assert_eq!(Covariance::<f64>::zero().principal(), [0.0; 3]);
}
