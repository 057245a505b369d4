//! Moments of slopes against direct sums, layers, tilts, and Toksvig's lengths.

use microsurface::filter::Covariance;
use microsurface::filter::normal_map::{
    Moments, alpha_toksvig2005, exponent_toksvig2005, variance_toksvig2005,
};
use microsurface::frame::{Frame, normal_to_slope, slope_to_normal};
use microsurface::glam::{DMat2, DVec2, DVec3, Vec2, Vec3};
use microsurface::{Error, Ggx};
use rand_pcg::Pcg64Mcg;

use crate::random::uniform;

fn slopes(random: &mut Pcg64Mcg, count: usize, mean: DVec2, width: DVec2) -> Vec<DVec2> {
    let mut entry = |m: f64, w: f64| m + uniform(random, -w, w);
    (0..count).map(|_| DVec2::new(entry(mean.x, width.x), entry(mean.y, width.y))).collect()
}

/// Mean and covariance in two passes.
fn direct(slopes: &[DVec2], weights: &[f64]) -> (DVec2, [f64; 3]) {
    let total: f64 = weights.iter().sum();
    let mean = slopes.iter().zip(weights).map(|(t, w)| *w * *t).sum::<DVec2>() / total;
    let moment =
        |f: fn(DVec2) -> f64| slopes.iter().zip(weights).map(|(t, w)| w * f(*t - mean)).sum::<f64>() / total;
    (mean, [moment(|d| d.x * d.x), moment(|d| d.x * d.y), moment(|d| d.y * d.y)])
}

fn assert_near(moments: &Moments<f64>, (mean, covariance): (DVec2, [f64; 3]), tolerance: f64) {
    let entries = moments.covariance().entries();
    assert!((moments.mean_slope() - mean).length() < tolerance, "{} {mean}", moments.mean_slope());
    let near = (0..3).all(|i| (entries[i] - covariance[i]).abs() < tolerance);
    assert!(near, "{entries:?} {covariance:?}");
}

#[test]
fn means_are_direct_sums() {
    let mut random = Pcg64Mcg::new(1);
    for count in [1, 2, 7, 256] {
        let set = slopes(&mut random, count, DVec2::new(0.5, -0.2), DVec2::new(0.4, 0.1));
        let ones = vec![1.0; count];
        let moments = Moments::<f64>::mean(set.iter().map(|t| Moments::of_slope(*t))).unwrap();
        assert_near(&moments, direct(&set, &ones), 1e-14);
        let normals = set.iter().map(|t| Moments::of_normal(3.0 * slope_to_normal::<f64>(*t)));
        assert_near(&Moments::mean(normals).unwrap(), direct(&set, &ones), 1e-14);
        let weights: Vec<f64> =
            (0..count).map(|i| if i == 3 { 0.0 } else { uniform(&mut random, 0.1, 2.0) }).collect();
        let weighted = set.iter().zip(&weights).map(|(t, w)| (Moments::of_slope(*t), *w));
        assert_near(&Moments::weighted_mean(weighted).unwrap(), direct(&set, &weights), 1e-14);
        // By raw moments, as a texture unit does.
        let mean = set.iter().sum::<DVec2>() / count as f64;
        let second = [|t: DVec2| t.x * t.x, |t: DVec2| t.x * t.y, |t: DVec2| t.y * t.y]
            .map(|f| set.iter().map(|t| f(*t)).sum::<f64>() / count as f64);
        assert_near(&Moments::from_raw(mean, second), direct(&set, &ones), 1e-14);
    }
}

#[test]
fn mip_maps_are_the_mean_of_all() {
    let mut random = Pcg64Mcg::new(2);
    let set = slopes(&mut random, 256, DVec2::new(-0.3, 0.1), DVec2::new(0.5, 0.5));
    let mut level: Vec<_> = set.iter().map(|t| Moments::of_slope(*t)).collect();
    while level.len() > 1 {
        level = level.chunks(4).map(|four| Moments::mean(four.iter().copied()).unwrap()).collect();
    }
    assert_near(&level[0], direct(&set, &[1.0; 256]), 1e-15);
    // Bilinear: rows, then columns, is the weighted mean.
    let four = [set[0], set[1], set[2], set[3]].map(Moments::of_slope);
    let (u, v) = (0.3, 0.8);
    let bilinear = four[0].lerp(&four[1], u).lerp(&four[2].lerp(&four[3], u), v);
    let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v];
    assert_near(&bilinear, direct(&set[..4], &weights), 1e-15);
}

#[test]
fn layers_are_sums_of_all_pairs() {
    let mut random = Pcg64Mcg::new(3);
    let a = slopes(&mut random, 30, DVec2::new(0.5, 0.1), DVec2::new(0.3, 0.2));
    let b = slopes(&mut random, 20, DVec2::new(-0.1, 0.4), DVec2::new(0.1, 0.6));
    let strength = -0.7;
    let pairs: Vec<_> = a.iter().flat_map(|s| b.iter().map(move |t| *s + strength * *t)).collect();
    let of = |set: &[DVec2]| Moments::<f64>::mean(set.iter().map(|t| Moments::of_slope(*t))).unwrap();
    let layers = of(&a) + of(&b).scaled(strength);
    assert_near(&layers, direct(&pairs, &[1.0; 600]), 1e-14);
    // In raw moments: with the cross terms, not without.
    let ((m1, e1), (m2, e2)) = (of(&a).raw(), of(&b).scaled(strength).raw());
    let cross = [2.0 * m1.x * m2.x, m1.x * m2.y + m2.x * m1.y, 2.0 * m1.y * m2.y];
    let (_, e) = layers.raw();
    assert!((0..3).all(|i| (e[i] - (e1[i] + e2[i] + cross[i])).abs() < 1e-14), "{e:?}");
}

#[test]
fn other_coordinates() {
    let mut random = Pcg64Mcg::new(4);
    let set = slopes(&mut random, 50, DVec2::new(0.5, 0.1), DVec2::new(0.3, 0.2));
    let jacobian = DMat2::from_cols(DVec2::new(1.5, -0.3), DVec2::new(0.4, 2.0));
    let moved: Vec<_> = set.iter().map(|t| jacobian * *t).collect();
    let moments = Moments::<f64>::mean(set.iter().map(|t| Moments::of_slope(*t))).unwrap();
    assert_near(&moments.transformed(jacobian), direct(&moved, &[1.0; 50]), 1e-14);
    // h(u(q)) has the slopes (∂u/∂q)ᵀ ∂h/∂u.
    let (u_of_q, q, step) = (jacobian, DVec2::new(0.3, 0.6), 1e-5);
    let height = |u: DVec2| u.x * u.x + (3.0 * u.y).sin() * u.x;
    let gradient = |f: &dyn Fn(DVec2) -> f64, p: DVec2| {
        let d = |e: DVec2| (f(p + step * e) - f(p - step * e)) / (2.0 * step);
        DVec2::new(d(DVec2::X), d(DVec2::Y))
    };
    let in_texture = Moments::<f64>::of_slope(gradient(&height, u_of_q * q));
    let in_plane = gradient(&|q| height(u_of_q * q), q);
    assert!((in_texture.transformed(u_of_q.transpose()).mean_slope() - in_plane).length() < 1e-8);
}

/// The covariance in the tilted frame against slopes of normals turned into it.
#[test]
fn tilted_covariances() {
    let mut random = Pcg64Mcg::new(5);
    for _ in 0..100 {
        let mean = DVec2::new(uniform(&mut random, -2.0, 2.0), uniform(&mut random, -2.0, 2.0));
        let width = 1e-4;
        let set = slopes(&mut random, 40, mean, DVec2::new(width, 0.3 * width));
        let moments = Moments::<f64>::mean(set.iter().map(|t| Moments::of_slope(*t))).unwrap();
        let (frame, covariance) = moments.tilted();
        assert!((frame.axes()[2] - slope_to_normal::<f64>(moments.mean_slope())).length() < 1e-15);
        let seen: Vec<_> =
            set.iter().map(|t| normal_to_slope::<f64>(frame.to_local(slope_to_normal::<f64>(*t)))).collect();
        let (_, expected) = direct(&seen, &[1.0; 40]);
        let entries = covariance.entries();
        let size = expected[0] + expected[2];
        // σ tanθ is up to 3e-4.
        assert!((0..3).all(|i| (entries[i] - expected[i]).abs() < 1e-3 * size), "{entries:?} {expected:?}");
    }
    let untilted = Moments::<f64>::new(DVec2::ZERO, Covariance::new(0.04, 0.01, 0.02).unwrap());
    let (frame, covariance) = untilted.tilted();
    assert_eq!(frame, Frame::from_normal(DVec3::Z));
    assert!((covariance.entries()[1] - 0.01).abs() < 1e-17);
}

/// Raw moments in f32 have no digit where the mean is 1 and σ is 1e-4; central ones, and raw ones
/// about a reference, do.
#[test]
fn digits_of_a_narrow_texture() {
    let mut random = Pcg64Mcg::new(6);
    let set = slopes(&mut random, 64, DVec2::new(1.0, 0.5), DVec2::new(1.7e-4, 1.7e-4));
    let (_, exact) = direct(&set, &[1.0; 64]);
    let texels: Vec<Moments<f32>> = set.iter().map(|t| Moments::of_slope(t.as_vec2())).collect();
    let central = Moments::mean(texels.iter().copied()).unwrap();
    let error = |m: &Moments<f32>| {
        let entries = m.covariance().entries().map(f64::from);
        (entries[0] - exact[0]).abs().max((entries[2] - exact[2]).abs()) / exact[0]
    };
    // Every texel's raw moments stored in f32, their average exact: as good as a texture unit can
    // be.
    let averaged = |reference: Vec2| {
        let raw: Vec<_> = texels.iter().map(|m| m.raw_about(reference)).collect();
        let mean = raw.iter().map(|(m, _)| m.as_dvec2()).sum::<DVec2>() / 64.0;
        let second = [0, 1, 2].map(|i| (raw.iter().map(|(_, e)| f64::from(e[i])).sum::<f64>() / 64.0) as f32);
        Moments::<f32>::from_raw_about(reference, mean.as_vec2(), second)
    };
    assert!(error(&central) < 1e-3, "{}", error(&central));
    assert!(error(&averaged(Vec2::ZERO)) > 0.1, "{}", error(&averaged(Vec2::ZERO)));
    assert!(
        error(&averaged(Vec2::new(1.001, 0.499))) < 1e-3,
        "{}",
        error(&averaged(Vec2::new(1.001, 0.499)))
    );
    // There and back.
    let (mean, second) = central.raw();
    assert!(Moments::<f32>::from_raw(mean, second).mean_slope() == central.mean_slope());
    let (mean, second) = central.raw_about(central.mean_slope());
    assert_eq!(Moments::from_raw_about(central.mean_slope(), mean, second), central);
}

/// Both variances of isotropic bumps agree to second order: their relative difference falls with
/// σ².
#[test]
fn lengths_and_moments_agree_to_second_order() {
    let difference = |sigma: f64| {
        let set: Vec<_> = (0..16)
            .map(|i| {
                sigma
                    * core::f64::consts::SQRT_2
                    * DVec2::from_angle(f64::from(i) * core::f64::consts::TAU / 16.0)
            })
            .collect();
        let average = set.iter().map(|t| slope_to_normal::<f64>(*t)).sum::<DVec3>() / 16.0;
        let [xx, xy, yy] =
            Moments::<f64>::mean(set.iter().map(|t| Moments::of_slope(*t))).unwrap().covariance().entries();
        assert!((xx - sigma * sigma).abs() < 1e-15 && (xx - yy).abs() < 1e-15 && xy.abs() < 1e-15);
        (variance_toksvig2005::<f64>(average) / xx - 1.0).abs()
    };
    assert!(difference(0.02) < 1e-3);
    assert!(
        (difference(0.04) / difference(0.02) - 4.0).abs() < 0.1,
        "{}",
        difference(0.04) / difference(0.02)
    );
}

#[test]
fn toksvig() {
    for (exponent, length) in [(10.0, 0.9), (1000.0, 0.999), (3.0, 0.1)] {
        let normal = length * DVec3::new(0.6, 0.0, 0.8);
        let variance = variance_toksvig2005::<f64>(normal);
        assert!((variance - (1.0 - length) / length).abs() < 1e-14);
        let filtered = exponent_toksvig2005::<f64>(exponent, normal);
        assert!((1.0 / filtered - (1.0 / exponent + variance)).abs() < 1e-13);
        // As printed: |N| s/(|N| + s (1 − |N|)).
        assert!(
            (filtered - length * exponent / (length + exponent * (1.0 - length))).abs() < 1e-12 * exponent
        );
        let alpha = alpha_toksvig2005((2.0 / exponent).sqrt(), normal).unwrap();
        assert!((alpha - (2.0 / filtered).sqrt()).abs() < 1e-14);
    }
    let z = |length: f32| Vec3::new(0.0, 0.0, length);
    assert_eq!(variance_toksvig2005::<f32>(z(1.0)), 0.0);
    assert_eq!(variance_toksvig2005::<f32>(z(1.001)), 0.0);
    assert_eq!(variance_toksvig2005::<f32>(z(0.0)), f32::INFINITY);
    assert!(variance_toksvig2005::<f32>(z(f32::NAN)).is_nan());
    assert_eq!(exponent_toksvig2005::<f32>(50.0, z(0.0)), 0.0);
    assert_eq!(exponent_toksvig2005::<f32>(50.0, z(1.1)), 50.0);
    assert_eq!(exponent_toksvig2005::<f32>(0.0, z(0.5)), 0.0);
    assert_eq!(exponent_toksvig2005::<f32>(f32::INFINITY, z(0.5)), 1.0);
    assert_eq!(alpha_toksvig2005(0.2_f32, z(1.0)), Ok(0.2));
    for normal in [z(0.0), z(f32::NAN)] {
        assert!(matches!(alpha_toksvig2005(0.2_f32, normal), Err(Error::Alpha { .. })));
    }
}

#[test]
fn bad_input() {
    let fine = Moments::of_slope(Vec2::new(0.1, 0.2));
    for bad in [f32::NAN, f32::INFINITY] {
        let moments = Moments::of_slope(Vec2::new(bad, 0.0));
        assert!(!moments.is_finite() && !moments.covariance().is_finite());
        let spread = Moments::<f32>::new(Vec2::new(0.0, bad), Covariance::isotropic(0.1));
        assert!(!spread.is_finite() && !spread.covariance().is_finite());
        assert!(!(fine + moments).covariance().is_finite() && !moments.tilted().1.is_finite());
        let refused = Ggx::isotropic(0.1_f32).unwrap().filtered(moments.covariance());
        assert!(matches!(refused, Err(Error::Covariance { .. })));
        assert!(Moments::weighted_mean([(fine, bad)]).is_none_or(|m| !m.mean_slope().is_finite()));
    }
    // Texels without a slope: upright, overhanging, empty.
    for normal in [Vec3::X, Vec3::new(0.3, 0.1, -0.5), -Vec3::Z, Vec3::ZERO, Vec3::NAN] {
        let none = Moments::<f32>::of_normal(normal);
        assert!(!none.is_finite() && !none.covariance().is_finite() && !none.tilted().1.is_finite());
        assert_eq!(Moments::weighted_mean([(none, 0.0), (fine, 2.0)]), Some(fine));
        assert_eq!(Moments::mean([none, fine, none]), Some(fine));
        assert_eq!(Moments::mean([none, none]), None);
        assert_eq!([fine.lerp(&none, 0.7), none.lerp(&fine, 0.2)], [fine; 2]);
    }
    assert_eq!(Moments::<f32>::mean([]), None);
    assert_eq!(Moments::weighted_mean([(fine, 0.0)]), None);
    // Rounding of a texture may leave what is no covariance; the nearest one is built.
    let broken = Moments::<f32>::from_raw(Vec2::new(0.5, 0.5), [0.2499, 0.26, 0.26]);
    let [xx, xy, yy] = broken.covariance().entries();
    assert!(xx == 0.0 && xy == 0.0 && (yy - 0.01).abs() < 1e-6, "{xx} {xy} {yy}");
}
