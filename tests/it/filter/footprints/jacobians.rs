//! Jacobians between the sphere, the disk and slopes.

use microsurface::filter::jacobian::{Amplification, disk_to_slope, sphere_to_disk, sphere_to_slope};
use microsurface::glam::{DMat2, DVec2, DVec3, Mat2, Vec3};
use rand_pcg::Pcg64Mcg;

use super::{derivative, direction};
use crate::random::uniform;
use crate::strategies::at_radius;

#[test]
fn jacobians_are_those_of_differences() {
    let mut random = Pcg64Mcg::new(1);
    for _ in 0..2000 {
        let m = direction(&mut random, 0.1);
        let m = if uniform(&mut random, 0.0, 1.0) < 0.5 { m } else { DVec3::new(m.x, m.y, -m.z) };
        let around = DVec3::Z.cross(m).normalize();
        let away = around.cross(m);
        let angles = |along: DVec3, image: &dyn Fn(DVec3) -> DVec2| {
            derivative(|angle| image(m * angle.cos() + along * angle.sin()))
        };
        let disk = |m: DVec3| m.truncate();
        let slope = |m: DVec3| -m.truncate() / m.z;
        let on_disk = |x: f64, y: f64| {
            let p = m.truncate() + m.z * m.z * DVec2::new(x, y);
            -p / (1.0 - p.length_squared()).sqrt().copysign(m.z) / (m.z * m.z)
        };
        for (name, exact, difference, [largest, smallest]) in [
            (
                "disk",
                sphere_to_disk::<f64>(m),
                DMat2::from_cols(angles(away, &disk), angles(around, &disk)),
                [1.0, m.z.abs()],
            ),
            (
                "slope",
                sphere_to_slope::<f64>(m),
                DMat2::from_cols(angles(away, &slope), angles(around, &slope)),
                [m.z.powi(-2), m.z.abs().recip()],
            ),
            (
                "disk to slope",
                disk_to_slope::<f64>(m),
                DMat2::from_cols(derivative(|x| on_disk(x, 0.0)), derivative(|y| on_disk(0.0, y))),
                [m.z.abs().powi(-3), m.z.abs().recip()],
            ),
        ] {
            let size = exact.x_axis.length().max(exact.y_axis.length());
            assert!(exact.abs_diff_eq(difference, 1e-8 * size), "{name} at {m}: {exact} {difference}");
            // The columns' sum of squares is that of the singular values, the determinant their
            // product.
            let squares = exact.x_axis.length_squared() + exact.y_axis.length_squared();
            let product = largest * smallest * if name == "disk to slope" { 1.0 } else { m.z.signum() };
            assert!((squares / (largest * largest + smallest * smallest) - 1.0).abs() < 1e-12, "{name}");
            assert!((exact.determinant() / product - 1.0).abs() < 1e-11, "{name} {}", exact.determinant());
        }
        let chain = disk_to_slope::<f64>(m) * sphere_to_disk::<f64>(m);
        assert!(chain.abs_diff_eq(sphere_to_slope::<f64>(m), 1e-14 * m.z.powi(-3).abs()));
        let (slopes, disk) = (Amplification::<f64>::in_slopes(m), Amplification::<f64>::on_disk(m));
        assert!((slopes.largest * m.z * m.z - 1.0).abs() < 1e-14);
        assert!((slopes.smallest * m.z.abs() - 1.0).abs() < 1e-14);
        assert_eq!([disk.largest, disk.smallest], [1.0, m.z.abs()]);
    }
}

/// Errors of derivatives are amplified by no more and no less than the singular values, and both
/// are reached.
#[test]
fn amplification_is_that_of_angles() {
    let mut random = Pcg64Mcg::new(2);
    for _ in 0..200 {
        let m = direction(&mut random, 0.05);
        for (jacobian, gain) in [
            (sphere_to_slope::<f64>(m), Amplification::<f64>::in_slopes(m)),
            (sphere_to_disk::<f64>(m), Amplification::<f64>::on_disk(m)),
        ] {
            let lengths: Vec<f64> = (0..=180)
                .map(|i| (jacobian * DVec2::from_angle(f64::from(i).to_radians())).length())
                .collect();
            let (least, most) =
                lengths.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), &x| (l.min(x), m.max(x)));
            assert!((least / gain.smallest - 1.0).abs() < 1e-12, "{least} {gain:?}");
            assert!((most / gain.largest - 1.0).abs() < 1e-12, "{most} {gain:?}");
        }
    }
}

#[test]
fn at_the_pole_x_is_radial() {
    assert_eq!(sphere_to_disk::<f64>(DVec3::Z), DMat2::IDENTITY);
    assert_eq!(sphere_to_slope::<f64>(DVec3::Z), -DMat2::IDENTITY);
    assert_eq!(disk_to_slope::<f64>(DVec3::Z), -DMat2::IDENTITY);
    assert_eq!(sphere_to_disk::<f32>(Vec3::new(-0.0, 0.0, 1.0)), Mat2::IDENTITY);
    // Beside it the azimuth is that of m.xy, down to the smallest numbers.
    for r in [1e-3, 1e-8, 1e-20, 1e-160, 1e-300, 1e-320] {
        let jacobian = sphere_to_disk::<f64>(DVec3::new(0.0, -r, 1.0));
        assert_eq!(jacobian, DMat2::from_cols(DVec2::NEG_Y, DVec2::X), "{r}");
        let jacobian = sphere_to_slope::<f64>(DVec3::new(0.0, -r, 1.0));
        assert_eq!(jacobian, DMat2::from_cols(DVec2::Y, DVec2::NEG_X), "{r}");
    }
}

/// The documented bounds: the largest error of an entry in f32, in ε, at grazing angles and at the
/// pole.
#[test]
fn entries_have_their_digits_everywhere() {
    let mut random = Pcg64Mcg::new(3);
    let mut worst = [0.0_f64; 3];
    for i in 0..200_000 {
        let phi = uniform(&mut random, 0.0, core::f64::consts::TAU);
        let small = uniform(&mut random, if i % 4 == 0 { -140.0 } else { -10.0 }, 0.0).exp2();
        let m: [f32; 3] =
            if i % 2 == 0 { at_radius(small, phi) } else { crate::strategies::at_height(small, phi) };
        // Where z³ is a normal number, and x and y are.
        if m[2] < 1e-12 || m[0].abs().min(m[1].abs()) < f32::MIN_POSITIVE {
            continue;
        }
        let wide = DVec3::from_array(m.map(f64::from));
        let exact: [DMat2; 3] = [sphere_to_disk(wide), disk_to_slope(wide), sphere_to_slope(wide)];
        let single: [Mat2; 3] = [sphere_to_disk(m), disk_to_slope(m), sphere_to_slope(m)];
        for ((worst, exact), single) in worst.iter_mut().zip(exact).zip(single) {
            for (e, s) in exact.to_cols_array().into_iter().zip(single.to_cols_array()) {
                if e.abs() > f64::from(f32::MIN_POSITIVE) {
                    *worst = worst.max((f64::from(s) / e - 1.0).abs() / f64::from(f32::EPSILON));
                }
            }
        }
    }
    for (worst, bound) in worst.into_iter().zip([2.5, 2.5, 3.0]) {
        assert!(worst <= bound && worst > 0.5 * bound, "{worst} of {bound}");
    }
}
