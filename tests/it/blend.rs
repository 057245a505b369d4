//! Mixtures of two distributions.

use microsurface::batch::{Directions, DirectionsMut, NdfBatch, Numbers};
use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Perfect;
use microsurface::glam::{DVec2, DVec3, Vec2, Vec3};
use microsurface::verify::{Float, Kit};
use microsurface::{
    Beckmann, Blend, Error, Ggx, Gtr, Ndf, Real, RoughnessMatrix, SampleNdf, SampleVndf, StudentT,
};

use crate::random::Random;

/// Haze, and three parts of three families and maps in one.
fn blends<T: Real>()
-> (impl SampleNdf<Scalar = T> + SampleVndf + Copy, impl SampleNdf<Scalar = T> + SampleVndf + Copy) {
    let l = T::lit;
    let haze = Blend::new(Ggx::isotropic(l(0.02)).unwrap(), Ggx::isotropic(l(0.5)).unwrap(), l(0.1)).unwrap();
    let matrix = RoughnessMatrix::rotated(l(0.1), l(0.4), l(0.6)).unwrap();
    let two = Blend::new(
        Beckmann::from_roughness_matrix(matrix),
        StudentT::anisotropic(l(0.3), l(0.15), l(3.4)).unwrap(),
        l(0.3),
    );
    let three = Blend::new(two.unwrap(), Gtr::isotropic(l(0.2), l(1.3)).unwrap(), l(0.25)).unwrap();
    (haze, three)
}

fn kit<T: Float>() {
    let (haze, three) = blends::<T>();
    let kit = Kit::new();
    kit.ndf(&haze).and(kit.normals(&haze)).and(kit.visible_normals(&haze)).assert();
    kit.ndf(&three).and(kit.normals(&three)).and(kit.visible_normals(&three)).assert();
}

#[test]
fn the_kit_passes_in_f64() {
    kit::<f64>();
}

#[test]
fn the_kit_passes_in_f32() {
    kit::<f32>();
}

/// Everything linear in D is the mixture, and Λ below the horizon −1 − Λ(−w).
#[test]
fn what_is_linear_is_mixed() {
    let (a, b) = (Ggx::anisotropic(0.1_f64, 0.3).unwrap(), Beckmann::isotropic(0.4_f64).unwrap());
    let blend = Blend::new(a, b, 0.3).unwrap();
    assert_eq!((blend.first(), blend.second()), (&a, &b));
    let mixed = |first: f64, second: f64| 0.7 * first + 0.3 * second;
    let mut random = Random(5);
    for _ in 0..2000 {
        let mut direction = || {
            let (z, turn) = (random.within(-1.0, 1.0), random.within(0.0, core::f64::consts::TAU));
            let s = (1.0 - z * z).sqrt();
            DVec3::new(s * turn.cos(), s * turn.sin(), z)
        };
        let (w, m) = (direction(), direction());
        let same = |is: f64, exact: f64, what: &str| {
            assert!(
                (is - exact).abs() <= 4.0 * f64::EPSILON * exact.abs(),
                "{what}: {is} {exact} at {w} {m}"
            );
        };
        same(blend.d(m), mixed(a.d(m), b.d(m)), "D");
        same(blend.sigma(w), mixed(a.sigma(w), b.sigma(w)), "σ");
        same(blend.lambda(w), mixed(a.lambda(w), b.lambda(w)), "Λ");
        let slope = DVec2::new(m.x, m.y) / m.z;
        same(blend.p22(slope), mixed(a.p22(slope), b.p22(slope)), "P22");
        let mean = mixed(a.sigma(w), b.sigma(w));
        let seen = mixed(a.sigma(w) * a.vndf(w, m), b.sigma(w) * b.vndf(w, m)) / mean;
        assert!((blend.vndf(w, m) - seen).abs() <= 1e-14 * seen, "D_w at {w} {m}");
        if w.z > 0.0 && m.z > 0.0 {
            // By way of the reflection, which takes the quotients of the parts.
            let rough = RoughConductor::new(blend, Perfect::<f64>::new());
            let h = (w + m).normalize();
            let f = blend.d(h) * blend.g2(w, m, h) / (4.0 * w.z * m.z);
            assert!((rough.eval(m, w) / f - 1.0).abs() < 1e-13, "f at {w} {m}");
        }
    }
}

/// All of one part is that part, also where the other one is not seen.
#[test]
fn shares_of_0_and_1_are_one_part() {
    let (narrow, wide) = (Ggx::isotropic(0.001_f32).unwrap(), Ggx::isotropic(1.0_f32).unwrap());
    let mut random = Random(9);
    for (share, whole) in [(0.0, narrow), (1.0, wide)] {
        let blend = Blend::new(narrow, wide, share).unwrap();
        for _ in 0..1000 {
            let [u, v] = [random.unit() as f32, random.unit() as f32].map(|u| u.min(1.0 - f32::EPSILON));
            for w in [Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.8, 0.0, -0.6), Vec3::NEG_Z] {
                let (a, b) = (blend.sample_vndf(w, Vec2::new(u, v)), whole.sample_vndf(w, Vec2::new(u, v)));
                assert!(a.dot(b) > 0.999 || w == Vec3::NEG_Z, "{a} {b} at {w}, u {u} {v}");
            }
        }
    }
}

/// From below a narrow part is hardly seen, and no random number may choose it for a normal that
/// has no density.
#[test]
fn every_sample_has_a_density() {
    let blend =
        Blend::new(Beckmann::isotropic(0.01_f32).unwrap(), Ggx::isotropic(0.5).unwrap(), 0.5).unwrap();
    for z in [0.9_f32, 0.1, 0.0, -0.1, -0.5, -0.99] {
        let w = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
        for u in [0.0_f32, 1e-9, 0.3, 0.999, 1.0 - f32::EPSILON / 2.0, 1.0] {
            for v in [0.0_f32, 1e-9, 0.5, 0.999_999, 1.0] {
                let m = blend.sample_vndf(w, Vec2::new(u, v));
                assert!(m.is_normalized() && blend.vndf(w, m) > 0.0, "{m} at {w}, u {u} {v}");
            }
        }
    }
}

#[test]
fn batches_are_the_calls() {
    let ggx = Ggx::anisotropic(0.2_f32, 0.5).unwrap();
    let blend = Blend::new(ggx, Gtr::isotropic(0.3, 1.5).unwrap(), 0.4).unwrap();
    let mut random = Random(3);
    let n = 200;
    let mut numbers =
        |low: f64, high: f64| (0..n).map(|_| random.within(low, high) as f32).collect::<Vec<_>>();
    let (x, y, z) = (numbers(-0.5, 0.5), numbers(-0.5, 0.5), numbers(-0.2, 1.0));
    let (u, v) = (numbers(0.0, 1.0), numbers(0.0, 1.0));
    let directions = Directions { x: &x, y: &y, z: &z };
    let (mut d, mut sigma) = (vec![0.0; n], vec![0.0; n]);
    blend.d_batch(directions, &mut d);
    blend.sigma_batch(directions, &mut sigma);
    let [mut mx, mut my, mut mz] = [(); 3].map(|()| vec![0.0; n]);
    let points = Numbers { x: &u, y: &v };
    blend.sample_vndf_batch(directions, points, DirectionsMut { x: &mut mx, y: &mut my, z: &mut mz });
    for i in 0..n {
        let w = Vec3::new(x[i], y[i], z[i]);
        assert_eq!(d[i].to_bits(), blend.d(w).to_bits(), "D at {w}");
        assert_eq!(sigma[i].to_bits(), blend.sigma(w).to_bits(), "σ at {w}");
        assert_eq!(Vec3::new(mx[i], my[i], mz[i]), blend.sample_vndf(w, Vec2::new(u[i], v[i])), "{w}");
    }
}

#[test]
fn bad_shares_are_refused_by_name() {
    let ggx = Ggx::isotropic(0.3_f32).unwrap();
    for share in [-0.1, 1.1, f32::NAN, f32::INFINITY] {
        let error = Blend::new(ggx, ggx, share).unwrap_err();
        assert!(matches!(error, Error::Parameter { name: "share_of_second", .. }), "{error}");
    }
}
