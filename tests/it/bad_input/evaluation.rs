//! What evaluation answers to NaN, and at the horizon.

use microsurface::bsdf::{AllNormals, RoughConductor, UniformMixture};
use microsurface::fresnel::{Conductor, Dielectric, Fresnel, Perfect, Schlick};
use microsurface::glam::{DVec2, DVec3};
use microsurface::{Ndf, SampleNdf, SampleVndf};

use crate::rows::Row;
use crate::scalar::Scalar;
use crate::surfaces::{Move, Spec, Surface, Widths};

/// A surface of each profile under each type of map.
fn surfaces<T: Scalar>() -> Vec<Surface<T>> {
    let mut surfaces = Vec::new();
    for distribution in Row::ALL.iter().flat_map(|row| row.of_width(0.3)) {
        for widths in [
            Widths::Isotropic(0.7),
            Widths::AxisAligned(0.2, 0.9),
            Widths::Matrix { x: 0.3, y: 0.5, correlation: 0.4 },
        ] {
            surfaces.push(Spec::new(distribution, widths, Move::Stay).build().unwrap());
        }
    }
    surfaces
}

/// One NaN in any argument, above the horizon, gives NaN.
fn nan_gives_nan<T: Scalar>() {
    let is_nan = |x: T| x.to_f64().is_nan();
    let [w, v, m] = [[0.6, 0.0, 0.8], [0.0, 0.28, 0.96], [0.1, -0.2, 0.97]].map(|v| v.map(T::lit));
    let u = [T::HALF, T::lit(0.25)];
    for surface in surfaces::<T>() {
        for k in 0..3 {
            let spoiled = |mut v: [T; 3]| -> T::Vec3 {
                v[k] = T::NAN;
                v.into()
            };
            let (bad_w, bad_m, w, v, m) = (spoiled(w), spoiled(m), w.into(), v.into(), m.into());
            let brdf = RoughConductor::new(surface.clone(), Schlick::new(T::HALF).unwrap());
            let mixture = UniformMixture::new(AllNormals, T::HALF).unwrap();
            let mixed = brdf.clone().sampled_by(mixture);
            assert!(mixed.sample(bad_w, u.into()).is_none(), "{surface:?}: no sample of nowhere");
            let by_name = [
                ("d", surface.d(bad_m)),
                ("sigma", surface.sigma(bad_w)),
                ("lambda", surface.lambda(bad_w)),
                ("d_along", surface.d_along(bad_m)),
                ("g1 w", surface.g1(bad_w, m)),
                ("g1 m", surface.g1(w, bad_m)),
                ("g2 i", surface.g2(bad_w, v, m)),
                ("g2 o", surface.g2(v, bad_w, m)),
                ("g2 m", surface.g2(w, v, bad_m)),
                ("separable", surface.g2_separable(w, v, bad_m)),
                ("vndf w", surface.vndf(bad_w, m)),
                ("vndf m", surface.vndf(w, bad_m)),
                ("pdf_d", surface.pdf_d(bad_m)),
                ("eval i", brdf.eval(bad_w, v)),
                ("eval o", brdf.eval(v, bad_w)),
                ("mixture i", mixed.pdf(bad_w, v)),
                ("mixture o", mixed.pdf(v, bad_w)),
            ];
            for (name, value) in by_name {
                assert!(is_nan(value), "{surface:?} {name}, component {k}: {}", value.hex());
            }
            if surface.samples_visible() {
                let sample: [T; 3] = surface.sample_vndf(bad_w, u.into()).into();
                assert!(sample.iter().any(|&c| is_nan(c)), "{surface:?} {sample:?}");
                assert!(is_nan(brdf.pdf(bad_w, v)) && is_nan(brdf.pdf(v, bad_w)), "{surface:?}");
                assert!(brdf.sample(bad_w, u.into()).is_none(), "{surface:?}: no sample of nowhere");
            }
        }
        for k in 0..2 {
            let mut bad = u;
            bad[k] = T::NAN;
            assert!(is_nan(surface.p22(bad.into())), "{surface:?}");
            let mixture = UniformMixture::new(AllNormals, T::HALF).unwrap();
            let mixed =
                RoughConductor::new(surface.clone(), Schlick::new(T::HALF).unwrap()).sampled_by(mixture);
            assert!(mixed.sample(w.into(), bad.into()).is_none(), "{surface:?}");
            let sample: [T; 3] = surface.sample_d(bad.into()).into();
            assert!(sample.iter().any(|&c| is_nan(c)), "{surface:?} {k}: {sample:?}");
            if surface.samples_visible() {
                let sample: [T; 3] = surface.sample_vndf(w.into(), bad.into()).into();
                assert!(sample.iter().any(|&c| is_nan(c)), "{surface:?} {k}: {sample:?}");
            }
        }
    }
    assert!(is_nan(Schlick::new(T::HALF).unwrap().reflectance(T::NAN)));
    assert!(is_nan(Dielectric::new(T::TWO).unwrap().reflectance(T::NAN)));
    assert!(is_nan(Conductor::new(T::TWO, T::ONE).unwrap().reflectance(T::NAN)));
}

#[test]
fn nan_gives_nan_f32() {
    nan_gives_nan::<f32>();
}

#[test]
fn nan_gives_nan_f64() {
    nan_gives_nan::<f64>();
}

/// What the documentation says of the horizon and below.
#[test]
fn the_horizon_is_as_documented() {
    let (up, level, down) =
        (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.6, 0.8, 0.0), DVec3::new(0.6, 0.0, -0.8));
    for surface in surfaces::<f64>() {
        assert_eq!(surface.d(down), 0.0);
        assert_eq!(surface.lambda(level), f64::INFINITY);
        assert_eq!(surface.lambda(-up), -1.0 - surface.lambda(up));
        assert!(surface.sigma(level) > 0.0 && surface.sigma(down) > 0.0);
        for low in [level, down] {
            assert_eq!(surface.g1(low, low), 0.0, "{surface:?}");
            assert_eq!(surface.g2(low, up, DVec3::Z), 0.0);
            assert_eq!(surface.g2(up, low, DVec3::Z), 0.0);
        }
        assert_eq!(surface.g1(up, DVec3::new(-0.8, 0.0, 0.6)), 0.0, "on the back");
        assert_eq!(surface.vndf(-DVec3::Z, DVec3::Z), 0.0, "nothing is visible from the nadir");
        let brdf = RoughConductor::new(surface.clone(), Perfect::<f64>::new());
        for low in [level, down] {
            assert_eq!((brdf.eval(low, up), brdf.eval(up, low)), (0.0, 0.0));
        }
        if surface.samples_visible() {
            assert_eq!((brdf.pdf(down, up), brdf.pdf(up, level)), (0.0, 0.0));
            assert!(
                brdf.sample(level, DVec2::new(0.2, 0.3)).is_none()
                    && brdf.sample(down, DVec2::ZERO).is_none()
            );
        }
        let mixed = brdf.clone().sampled_by(UniformMixture::new(AllNormals, 0.5).unwrap());
        assert_eq!((mixed.pdf(down, up), mixed.pdf(up, level)), (0.0, 0.0));
        for u in [DVec2::new(0.2, 0.3), DVec2::new(0.7, 0.3)] {
            assert!(mixed.sample(level, u).is_none() && mixed.sample(down, u).is_none());
        }
        let (left, right) = (DVec3::new(-1.0, 0.0, 1e-160), DVec3::new(1.0, 0.0, 1e-160));
        assert_eq!(brdf.eval(left, right), 0.0, "no half vector");
        assert_eq!(
            mixed.pdf(left, right),
            0.25 * core::f64::consts::FRAC_1_PI,
            "uniform directions are left"
        );
    }
}
