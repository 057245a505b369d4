//! The ends of the domain: what the documentation says, and never a panic.

use microsurface::filter::jacobian::{
    Curvature, HalfVector, InterpolatedNormals, Motion, disk_to_slope, sphere_to_disk, sphere_to_slope,
};
use microsurface::filter::ray::RayDifferential;
use microsurface::frame::Frame;
use microsurface::glam::{DVec2, DVec3, Vec3};
use microsurface::{Error, Ggx};
use proptest::prelude::*;

use crate::strategies::anywhere;

/// A curved surface seen by some pixel.
fn motions() -> [Motion<f32>; 2] {
    let frame = Frame::<f32>::from_normal(Vec3::Z);
    [Vec3::new(0.1, 0.02, 0.0), Vec3::new(-0.03, 0.2, 0.0)].map(|point| {
        let normal = Curvature::sphere(2.0).normal_step(&frame, point);
        Motion { point, normal, ..Motion::default() }
    })
}

#[test]
fn on_the_horizon_only_the_projection_is_finite() {
    let frame = Frame::<f32>::from_normal(Vec3::Z);
    let [du, dv] = motions();
    for (wi, wo) in [
        (Vec3::X, Vec3::Y),
        (Vec3::X, Vec3::X),
        (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.6, 0.0, -0.8)),
        (Vec3::new(0.0, 0.6, 0.8), Vec3::new(0.6, 0.0, -0.8)),
    ] {
        let half = HalfVector::<f32>::at_distances(&frame, wi, 2.0, wo, 3.0);
        assert!(!half.is_above_horizon() && half.wm().z == 0.0);
        assert!((half.projected().length() - 1.0).abs() < 1e-6);
        assert!(half.projected_footprint(&du, &dv).is_finite());
        assert!(!half.slope().is_finite());
        let slopes = half.slope_footprint(&du, &dv);
        assert!(!slopes.is_finite() && slopes.steps().iter().all(|step| !step.is_finite()));
        assert!(slopes.clamped(1.0).is_finite());
        let surface = Ggx::isotropic(0.1_f32).unwrap();
        assert!(matches!(surface.filtered(slopes.covariance(0.25)), Err(Error::Covariance { .. })));
        surface.filtered(slopes.clamped(1.0).covariance(0.25)).unwrap();
    }
}

#[test]
fn without_a_direction_all_is_nan() {
    let frame = Frame::<f32>::from_normal(Vec3::Z);
    let [du, dv] = motions();
    let w = Vec3::new(0.6, 0.0, 0.8);
    for half in [
        HalfVector::<f32>::far(&frame, w, -w),
        HalfVector::new(&frame, Vec3::ONE, Vec3::ONE, Vec3::new(3.0, 2.0, 8.0)),
        HalfVector::new(&frame, Vec3::ONE, Vec3::new(3.0, 2.0, 8.0), Vec3::ONE),
        HalfVector::far(&frame, Vec3::NAN, w),
        HalfVector::far(&frame, w, Vec3::new(0.0, 0.0, f32::INFINITY)),
    ] {
        assert!(!half.is_above_horizon() && !half.wm().is_finite());
        for footprint in [half.slope_footprint(&du, &dv), half.projected_footprint(&du, &dv)] {
            assert!(!footprint.is_finite() && footprint.clamped(0.5).is_finite());
            assert_eq!(footprint.clamped(0.5).extents().to_array(), [0.5, 0.5]);
        }
    }
}

proptest! {
    /// Half vectors above, on and below the horizon, however short: the projection moves by finite
    /// steps unless H = 0 or the step is beyond the largest number, slopes unless H.z = 0; NaN
    /// never comes back for either.
    #[test]
    fn projections_are_never_nan(wi in anywhere::<f32>(), wo in anywhere::<f32>()) {
        let frame = Frame::<f32>::from_normal(Vec3::Z);
        let [du, dv] = motions();
        let [wi, wo] = [Vec3::from(wi), Vec3::from(wo)];
        let half = HalfVector::<f32>::at_distances(&frame, wi, 2.0, wo, 3.0);
        let h = wi + wo;
        if h != Vec3::ZERO {
            prop_assert!((half.wm().length() - 1.0).abs() < 1e-5, "{}", half.wm());
            prop_assert_eq!(half.is_above_horizon(), half.wm().z > 0.0);
            let footprint = half.projected_footprint(&du, &dv);
            prop_assert!(footprint.steps().iter().all(|step| !step.is_nan()), "{:?}", footprint);
            if h.abs().max_element() > 1e-30 {
                prop_assert!(footprint.is_finite(), "{:?}", footprint);
            }
        }
        if h.z.abs() > 1e-10 {
            prop_assert!(half.slope().is_finite());
            prop_assert!(half.slope_footprint(&du, &dv).is_finite());
        }
    }

    /// Jacobians of unit vectors off the horizon are numbers.
    #[test]
    fn jacobians_are_never_nan(m in anywhere::<f32>()) {
        let m = Vec3::from(m);
        prop_assert!(sphere_to_disk::<f32>(m).is_finite());
        if m.z.abs() > 1e-12 {
            prop_assert!(sphere_to_slope::<f32>(m).is_finite() && disk_to_slope::<f32>(m).is_finite(), "{}", m);
        }
    }
}

#[test]
fn jacobians_on_the_horizon() {
    let m = DVec3::new(0.6, -0.8, 0.0);
    let disk = sphere_to_disk::<f64>(m);
    assert!(disk.is_finite() && disk.determinant() == 0.0);
    assert!(!sphere_to_slope::<f64>(m).is_finite() && !disk_to_slope::<f64>(m).is_finite());
    assert!(sphere_to_disk::<f64>(DVec3::NAN).is_nan());
    assert!(sphere_to_disk::<f64>(DVec3::new(f64::NAN, 0.0, 1.0)).is_nan());
    assert!(sphere_to_slope::<f64>(DVec3::new(0.0, f64::NAN, 1.0)).is_nan());
}

#[test]
fn rays_that_graze_cover_the_plane() {
    let rays = RayDifferential::<f64>::pinhole(DVec3::X, DVec3::Z / 100.0, DVec3::Y / 100.0);
    let [du, dv] = rays.onto_plane(DVec3::X, 3.0, DVec3::Z);
    assert!(!du.is_finite() && !dv.is_finite());
    let nothing = RayDifferential::<f64>::pinhole(DVec3::ZERO, DVec3::X, DVec3::Y);
    assert!(nothing.direction_du.is_nan() && nothing.origin_du == DVec3::ZERO);
}

#[test]
fn sources_of_normals_without_a_direction() {
    let flat = InterpolatedNormals::<f64> {
        positions: [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X],
        normals: [DVec3::Z; 3],
    };
    assert!(flat.normal_step([1.0, 0.0, 0.0], DVec3::X).is_nan());
    let opposite = InterpolatedNormals::<f64> {
        positions: [DVec3::ZERO, DVec3::X, DVec3::Y],
        normals: [DVec3::Z, -DVec3::Z, DVec3::Z],
    };
    assert!(opposite.normal([0.5, 0.5, 0.0]).is_nan());
    assert!(opposite.normal_step([0.5, 0.5, 0.0], DVec3::X).is_nan());
    let frame = Frame::<f64>::from_normal(DVec3::Z);
    let still = Motion::<f64>::default();
    assert!(!still.with_tangent(&frame, DVec3::Z, DVec3::Y).twist.is_finite());
    assert!(still.perturbed(&frame, DVec3::ZERO, DVec3::X).normal.is_nan());
    let saddle = Curvature::principal(2.0, -2.0, DVec2::from_angle(0.5));
    assert!((saddle.normal_step(&frame, DVec3::X).length() - 2.0).abs() < 1e-15);
    assert_eq!(Curvature::flat().normal_step(&frame, DVec3::X), DVec3::ZERO);
}
