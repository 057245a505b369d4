//! What constructors refuse and how they say it.

mod evaluation;

use microsurface::bsdf::{AllNormals, UniformMixture};
use microsurface::fresnel::{Conductor, Dielectric, Schlick};
use microsurface::glam::{DMat2, DVec3};
use microsurface::gtr::Density;
use microsurface::gtr::components::Components;
use microsurface::gtr::table::GtrTable;
use microsurface::roughness::{
    alpha_burley2012, alpha_dimov2015, alpha_pbrt4, alpha_range, alpha_walter2007, alphas_burley2012,
    alphas_kulla2017, alphas_openpbr, checked, clamped, mirror_alpha,
};
use microsurface::{Beckmann, Error, Ggx, Gtr, Ndf, RoughnessMatrix, SampleVndf};

use crate::scalar::Scalar;

/// 0, −0, negative, NaN, infinite, too small and too large.
fn not_widths<T: Scalar>() -> [T; 9] {
    let (smallest, largest) = alpha_range::<T>();
    [
        T::ZERO,
        -T::ZERO,
        -T::ONE,
        T::NAN,
        T::INFINITY,
        -T::INFINITY,
        T::TINIEST,
        smallest.stepped(-1),
        largest.stepped(1),
    ]
}

fn widths_are_refused<T: Scalar>() {
    let (smallest, largest) = alpha_range::<T>();
    for alpha in not_widths::<T>() {
        let one = T::ONE;
        let results = [
            checked(alpha).err(),
            Ggx::isotropic(alpha).err(),
            Ggx::anisotropic(alpha, one).err(),
            Ggx::anisotropic(one, alpha).err(),
            Beckmann::isotropic(alpha).err(),
            RoughnessMatrix::rotated(one, alpha, one).err(),
            Density::new(alpha, one).err(),
            Gtr::spline(alpha, one).err(),
            Gtr::closed::<2>(alpha).err(),
            Gtr::isotropic(alpha, one).err(),
            Gtr::with_nodes::<4>(alpha, one).err(),
            Gtr::heavy_tailed::<4>(alpha, one).err(),
            Components::new(alpha, one).err(),
        ];
        for error in results {
            let Some(Error::Alpha { value, smallest: low, largest: high }) = error else {
                panic!("{}: {error:?}", alpha.hex());
            };
            assert!(value == alpha.to_f64() || (value.is_nan() && alpha.to_f64().is_nan()), "{value}");
            assert_eq!((low, high), (smallest.to_f64(), largest.to_f64()));
            let message = error.unwrap().to_string();
            assert!(message.contains(&format!("alpha = {value}")), "{message}");
        }
        let near = clamped(alpha);
        assert!(checked(near).is_ok(), "{}", near.hex());
    }
    assert_eq!(clamped(T::NAN), mirror_alpha());
    assert_eq!(clamped(T::INFINITY), largest);
    assert_eq!(clamped(T::HALF), T::HALF);
    assert!(checked(smallest).is_ok() && checked(largest).is_ok());
    let wide = T::ONE.stepped(1);
    assert_eq!(Gtr::spline(wide, T::ONE).err(), Some(Error::AlphaAboveOne { value: wide.to_f64() }));
    let above_one = Some(Error::AlphaAboveOne { value: wide.to_f64() });
    assert_eq!(Density::new(wide, T::ONE).err(), above_one);
    assert_eq!(Gtr::isotropic(wide, T::ONE).err(), above_one);
    assert_eq!(Gtr::closed::<7>(wide).err(), above_one);
    assert_eq!(Components::new(wide, T::ONE).err(), above_one);
    assert_eq!(GtrTable::<T, 4>::new(T::ONE, wide).err(), above_one);
    let table = GtrTable::<T, 4>::new(T::ONE, T::lit(0.01)).unwrap();
    assert_eq!(table.isotropic(wide).err(), above_one);
    assert!(table.isotropic(T::lit(0.01)).is_ok() && table.heavy_tailed(T::ONE).is_ok());
    let below = T::lit(0.01).stepped(-1);
    for error in [table.isotropic(below).err(), table.heavy_tailed(below).err()] {
        let Some(Error::Alpha { value, smallest, largest }) = error else { panic!("{error:?}") };
        assert_eq!((value, smallest, largest), (below.to_f64(), T::lit(0.01).to_f64(), 1.0));
    }
    assert!(matches!(table.isotropic(T::NAN).err(), Some(Error::Alpha { .. })));
    for smallest in [T::ZERO, T::NAN, -T::ONE, T::lit(1e-4).stepped(-1)] {
        assert!(
            matches!(GtrTable::<T, 4>::new(T::ONE, smallest), Err(Error::Alpha { .. })),
            "{}",
            smallest.hex()
        );
    }
    narrowest_gtr(smallest);
}

/// Every GTR that the density accepts is a finite one, down to the smallest width.
fn narrowest_gtr<T: Scalar>(smallest: T) {
    let grazing = T::Vec3::from([T::lit(0.8), T::lit(0.6), T::lit(1e-3)]);
    for alpha in [smallest, T::lit(1e-8), T::lit(1e-3), T::ONE.stepped(-1), T::ONE] {
        for gamma in [0.0, T::TINIEST.to_f64(), 0.5, 1.0, 2.0, 2.5, 4.0, 9.9, 10.0].map(T::lit) {
            let Ok(surface) = Gtr::isotropic(alpha, gamma) else {
                assert!(Density::new(alpha, gamma).is_err(), "{} {}", alpha.hex(), gamma.hex());
                continue;
            };
            for value in [surface.sigma(grazing), surface.lambda(grazing)] {
                assert!(value.is_finite() && value >= T::ZERO, "{} {}: {value}", alpha.hex(), gamma.hex());
            }
            let table = GtrTable::<T, 8>::new(gamma, T::lit(1e-4)).unwrap();
            if alpha >= T::lit(1e-4) {
                let sigma = table.isotropic(alpha).unwrap().sigma(grazing).to_f64();
                let difference = sigma - surface.sigma(grazing).to_f64();
                assert!(difference.abs() < 1e-4 * sigma, "{} {}: {difference}", alpha.hex(), gamma.hex());
            }
            for u in [T::ZERO, T::HALF, T::BELOW_ONE] {
                let normal: [T; 3] = surface.sample_vndf(grazing, [u, u].into()).into();
                assert!(normal.iter().all(|c| c.is_finite()) && normal[2] >= T::ZERO, "{normal:?}");
            }
            let total: f64 = Components::new(alpha, gamma).unwrap().iter().map(|c| c.weight.to_f64()).sum();
            assert!((total - 1.0).abs() < 1e-5, "{} {}: {total}", alpha.hex(), gamma.hex());
        }
    }
}

#[test]
fn widths_are_refused_f32() {
    widths_are_refused::<f32>();
}

#[test]
fn widths_are_refused_f64() {
    widths_are_refused::<f64>();
}

#[test]
fn tail_exponents_are_refused() {
    for gamma in [-0.1, -f64::TINIEST, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 4.0_f64.stepped(1), 10.0] {
        let Some(Error::Gamma { value, largest }) = Gtr::spline(0.3, gamma).err() else { panic!("{gamma}") };
        assert!(value.to_bits() == gamma.to_bits() && largest == 4.0, "{value}");
        assert!(Gtr::spline(0.3, gamma).unwrap_err().to_string().contains(&format!("gamma = {gamma}")));
    }
    for gamma in [-0.1, -f64::TINIEST, f64::NAN, f64::INFINITY, 10.0_f64.stepped(1)] {
        for error in [
            Gtr::isotropic(0.3, gamma).err(),
            Gtr::with_nodes::<12>(0.3, gamma).err(),
            Components::new(0.3, gamma).err(),
            GtrTable::<f64, 8>::new(gamma, 0.01).err(),
        ] {
            let Some(Error::Gamma { value, largest }) = error else { panic!("{gamma}") };
            assert!(value.to_bits() == gamma.to_bits() && largest == 10.0, "{value}");
        }
    }
    let above_two = 2.0_f64.stepped(1);
    let refused = Some(Error::Gamma { value: above_two, largest: 2.0 });
    assert_eq!(Gtr::heavy_tailed::<8>(0.3, above_two).err(), refused);
    assert_eq!(GtrTable::<f64, 8>::new(above_two, 0.01).unwrap().heavy_tailed(0.3).err(), refused);
    assert!(Gtr::heavy_tailed::<8>(0.3, 2.0).is_ok() && Gtr::isotropic(0.3, -0.0).is_ok());
    for gamma in [-0.1, f64::NAN, f64::INFINITY, 1e4] {
        assert!(matches!(Density::new(0.3, gamma), Err(Error::Gamma { .. })), "{gamma}");
    }
    assert!(Gtr::spline(0.3, 0.0).is_ok() && Gtr::spline(0.3, 4.0).is_ok() && Gtr::spline(0.3, -0.0).is_ok());
    assert!(Density::new(1e-16, 10.0_f64).is_ok());
}

#[test]
fn roughness_matrices_are_refused() {
    let bad = [
        [1.0, 1.0, 1.0],
        [1.0, 2.0, 1.0],
        [-1.0, 0.0, -1.0],
        [1.0, 0.0, -1.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 0.0],
        [f64::NAN, 0.0, 1.0],
        [1.0, f64::NAN, 1.0],
        [1.0, 0.0, f64::INFINITY],
        [f64::INFINITY, 0.0, f64::INFINITY],
        [1.0, f64::INFINITY, 1.0],
        [1e-300, 0.0, 1e-300],
        [1e200, 0.0, 1.0],
    ];
    for [xx, xy, yy] in bad {
        let error = RoughnessMatrix::new(xx, xy, yy).unwrap_err();
        let Error::RoughnessMatrix { xx: a, xy: b, yy: c, determinant } = error else { panic!("{error:?}") };
        assert_eq!([a, b, c].map(f64::to_bits), [xx, xy, yy].map(f64::to_bits));
        if [xx, xy, yy].iter().all(|x| x.abs() < 10.0) {
            assert_eq!(determinant, xx * yy - xy * xy);
        }
        let message = error.to_string();
        assert!(message.contains(&format!("[[{xx}, {xy}], [{xy}, {yy}]]")), "{message}");
    }
    // One ulp from singular is a matrix.
    assert!(RoughnessMatrix::new(1.0, f64::BELOW_ONE, 1.0).is_ok());
    assert!(RoughnessMatrix::rotated(0.1, 0.2, f64::NAN).is_err());
    assert!(RoughnessMatrix::rotated(0.1, 0.2, f64::INFINITY).is_err());
}

#[test]
fn maps_are_refused() {
    let surface = Ggx::anisotropic(0.1, 0.4).unwrap();
    let columns = |a: [f64; 4]| DMat2::from_cols_array(&a);
    for (matrix, determinant) in [
        ([1.0, 2.0, 2.0, 4.0], 0.0),
        ([0.0; 4], 0.0),
        ([1.0, 0.0, 0.0, 0.0], 0.0),
        ([1e300, 0.0, 0.0, 1.0], 1e300),
        ([1e-200, 0.0, 0.0, 1e-100], 1e-300),
        ([f64::NAN, 0.0, 0.0, 1.0], f64::NAN),
        ([f64::INFINITY, 0.0, 0.0, 1.0], f64::INFINITY),
        ([1.0, f64::NEG_INFINITY, 0.0, 1.0], f64::NAN),
    ] {
        let error = surface.transformed(columns(matrix)).unwrap_err();
        let Error::Map { determinant: named } = error else { panic!("{error:?}") };
        // What is not finite has no determinant, or any.
        let finite = matrix.iter().all(|x| x.is_finite());
        assert!(
            !finite || (named / determinant - 1.0).abs() < 1e-12 || named == determinant,
            "{matrix:?}: {named}"
        );
        assert!(error.to_string().contains(&format!("determinant {named}")), "{error}");
    }
    assert!(surface.transformed(columns([1.0, 2.0, 2.0, 4.000001])).is_ok());
    assert!(surface.transformed(columns([0.0, 1.0, 1.0, 0.0])).is_ok(), "mirrors are maps");
    for s in [1.0, -1.0, 1.5, -2.0, f64::NAN, f64::INFINITY] {
        let Some(Error::Stretch { value }) = surface.stretched(s).err() else { panic!("{s}") };
        assert_eq!(value.to_bits(), s.to_bits());
    }
    assert!(surface.stretched(f64::BELOW_ONE).is_ok() && surface.stretched(-f64::BELOW_ONE).is_ok());
    assert!(matches!(Ggx::isotropic(1e-76).unwrap().stretched(0.9), Err(Error::Map { .. })));
}

#[test]
fn fresnel_terms_are_refused() {
    for eta in [0.0, -0.0, -1.5, f64::NAN, f64::INFINITY] {
        let Some(Error::RefractiveIndex { value, .. }) = Dielectric::new(eta).err() else { panic!("{eta}") };
        assert_eq!(value.to_bits(), eta.to_bits());
        assert!(matches!(Conductor::new(eta, 1.0), Err(Error::RefractiveIndex { .. })));
        // The channel at fault is named.
        let Some(Error::RefractiveIndex { value, .. }) = Dielectric::new(DVec3::new(1.5, eta, -7.0)).err()
        else {
            panic!("{eta}")
        };
        assert_eq!(value.to_bits(), eta.to_bits());
    }
    for k in [-0.1, f64::NAN, f64::INFINITY] {
        let Some(Error::Extinction { value, .. }) = Conductor::new(1.0, k).err() else { panic!("{k}") };
        assert_eq!(value.to_bits(), k.to_bits());
    }
    assert!(Conductor::new(0.2, 0.0).is_ok() && Conductor::new(1e9_f32, 1e9).is_ok());
    for large in [1.1e9, f64::MAX] {
        assert_eq!(Conductor::new(large, 1.0), Err(Error::RefractiveIndex { value: large, largest: 1e9 }));
        assert_eq!(Conductor::new(1.0, large), Err(Error::Extinction { value: large, largest: 1e9 }));
    }
    for f0 in [-1e-9, 1.000001, 7.5, f64::NAN, f64::INFINITY] {
        let Some(Error::Reflectance { value }) = Schlick::new(f0).err() else { panic!("{f0}") };
        assert_eq!(value.to_bits(), f0.to_bits());
        assert!(Schlick::new(DVec3::new(0.5, f0, 1.0)).is_err());
    }
    assert!(Schlick::new(0.0).is_ok() && Schlick::new(DVec3::ONE).is_ok());
}

#[test]
fn artists_parameters_are_refused() {
    fn names<R>(result: Result<R, Error>, expected: &str) {
        let Some(Error::Parameter { name, .. }) = result.err() else { panic!("{expected} accepted") };
        assert_eq!(name, expected);
    }
    for bad in [-0.1, 1.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        names(alpha_burley2012(bad), "roughness");
        names(alpha_dimov2015(bad), "sharpness");
        names(alphas_burley2012(bad, 0.5), "roughness");
        names(alphas_burley2012(0.5, bad), "anisotropic");
        names(alphas_kulla2017(bad, 0.5), "roughness");
        names(alphas_openpbr(bad, 0.5), "roughness");
        names(alphas_openpbr(0.5, bad), "anisotropy");
        if bad != 1.1 {
            names(alphas_kulla2017(0.5, if bad == -0.1 { -1.1 } else { bad }), "anisotropy");
        }
        if bad < 0.0 || bad.is_nan() {
            names(alpha_pbrt4(bad), "roughness");
            names(alpha_walter2007(bad), "exponent");
        }
    }
    names(alpha_walter2007(f64::INFINITY), "exponent");
    for mirror in [alpha_burley2012(0.0), alpha_pbrt4(0.0), alpha_dimov2015(1.0)] {
        assert!(matches!(mirror, Err(Error::Alpha { value: 0.0, .. })), "{mirror:?}");
    }
    assert!(matches!(alpha_pbrt4(f64::INFINITY), Err(Error::Alpha { .. })));
    assert!(matches!(alphas_kulla2017(0.5, 1.0), Err(Error::Alpha { value: 0.0, .. })));
    assert!(matches!(alphas_openpbr(0.5, 1.0), Err(Error::Alpha { value: 0.0, .. })));
}

fn probabilities_are_refused<T: Scalar>() {
    for p in [T::ONE, -T::TINIEST, -T::ONE, T::TWO, T::NAN, T::INFINITY, -T::INFINITY] {
        let error = UniformMixture::new(AllNormals, p).unwrap_err();
        let Error::Parameter { name: "probability", value, .. } = error else { panic!("{error:?}") };
        assert_eq!(value.to_bits(), p.to_f64().to_bits());
        assert!(error.to_string().contains(&format!("probability = {value}")), "{error}");
    }
    for p in [T::ZERO, -T::ZERO, T::TINIEST, T::HALF, T::BELOW_ONE] {
        let mixture = UniformMixture::new(AllNormals, p).unwrap();
        assert!(mixture.probability() >= T::ZERO && mixture.probability() < T::ONE, "{mixture:?}");
    }
    for alpha in not_widths::<T>() {
        assert!(matches!(UniformMixture::for_alpha(AllNormals, alpha), Err(Error::Alpha { .. })));
    }
    let (smallest, largest) = alpha_range::<T>();
    let probability =
        |alpha: T| -> f64 { UniformMixture::for_alpha(AllNormals, alpha).unwrap().probability().to_f64() };
    assert!(probability(smallest) <= 0.0 && (probability(largest) - 0.8).abs() < 1e-7);
    assert!((probability(T::HALF) - 0.2).abs() < 1e-7);
}

#[test]
fn probabilities_are_refused_f32() {
    probabilities_are_refused::<f32>();
}

#[test]
fn probabilities_are_refused_f64() {
    probabilities_are_refused::<f64>();
}
