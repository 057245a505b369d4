//! Widths: artists' maps by their values, clamping, the ends of the range, and rotated widths of
//! any ratio.

use core::f64::consts::{FRAC_PI_2, PI};

use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Perfect;
use microsurface::glam::{DMat2, Vec3};
use microsurface::roughness::{
    alpha_burley2012, alpha_burley2012_clamped, alpha_dimov2015, alpha_dimov2015_clamped, alpha_pbrt4,
    alpha_pbrt4_clamped, alpha_range, alpha_walter2007, alphas_burley2012, alphas_burley2012_clamped,
    alphas_kulla2017, alphas_kulla2017_clamped, alphas_openpbr, alphas_openpbr_clamped, clamped,
    mirror_alpha,
};
use microsurface::transform::Transformed;
use microsurface::{AxisAligned, Beckmann, Error, Ggx, Gtr, Linear, Microsurface, Ndf, RoughnessMatrix};

use crate::scalar::Scalar;

fn is_near(a: f64, b: f64) {
    assert!((a / b - 1.0).abs() < 1e-15, "{a} instead of {b}");
}

/// Values worked out by hand from the sources' formulas.
#[test]
fn artists_maps_have_the_values_of_their_sources() {
    is_near(alpha_burley2012(0.3).unwrap(), 0.09);
    is_near(alpha_pbrt4(0.0625).unwrap(), 0.25);
    is_near(alpha_dimov2015(0.75).unwrap(), 0.0625);
    is_near(alpha_walter2007(0.0).unwrap(), 1.0);
    is_near(alpha_walter2007(6.0).unwrap(), 0.5);
    is_near(alpha_walter2007(198.0).unwrap(), 0.1);
    let both = |alphas: Result<[f64; 2], Error>, expected: [f64; 2]| {
        for (a, b) in alphas.unwrap().into_iter().zip(expected) {
            is_near(a, b);
        }
    };
    // √(1 − 0.9) and √(1 − 0.45).
    both(alphas_burley2012(1.0, 1.0), [3.1622776601683795, 0.31622776601683794]);
    both(alphas_burley2012(0.5, 0.5), [0.25 / 0.7416198487095663, 0.25 * 0.7416198487095663]);
    both(alphas_kulla2017(0.5, 0.6), [0.4, 0.1]);
    both(alphas_kulla2017(0.5, -0.6), [0.1, 0.4]);
    // b = ½: √(2/1.25).
    both(alphas_openpbr(1.0, 0.5), [1.2649110640673518, 0.6324555320336759]);
    both(alphas_openpbr(0.5, 0.0), [0.25, 0.25]);
}

/// A texel is never an error; within the domain clamping changes nothing.
fn clamping_maps_take_every_texel<T: Scalar>() {
    let (mirror, largest) = (mirror_alpha::<T>(), alpha_range::<T>().1);
    let valid = [0.1, 0.5, 0.9].map(T::lit);
    for r in valid {
        assert_eq!(alpha_burley2012_clamped(r), alpha_burley2012(r).unwrap());
        assert_eq!(alpha_pbrt4_clamped(r), alpha_pbrt4(r).unwrap());
        assert_eq!(alpha_dimov2015_clamped(r), alpha_dimov2015(r).unwrap());
        for a in valid {
            assert_eq!(alphas_burley2012_clamped(r, a), alphas_burley2012(r, a).unwrap());
            assert_eq!(alphas_kulla2017_clamped(r, a), alphas_kulla2017(r, a).unwrap());
            assert_eq!(alphas_openpbr_clamped(r, a), alphas_openpbr(r, a).unwrap());
        }
    }
    let texels =
        [T::NAN, T::INFINITY, -T::INFINITY, -T::ONE, -T::TINIEST, T::ZERO, T::TINIEST, T::ONE, T::TWO];
    for r in texels {
        let widths =
            [alpha_burley2012_clamped(r), alpha_pbrt4_clamped(r), alpha_dimov2015_clamped(r), clamped(r)];
        assert!(widths.iter().all(|&alpha| alpha >= mirror && alpha <= largest), "{widths:?} of {}", r.hex());
        for a in texels {
            for [x, y] in [
                alphas_burley2012_clamped(r, a),
                alphas_kulla2017_clamped(r, a),
                alphas_openpbr_clamped(r, a),
            ] {
                assert!(
                    x >= mirror && y >= mirror && x <= largest && y <= largest,
                    "{} {}",
                    r.hex(),
                    a.hex()
                );
            }
        }
    }
    // The α that vanishes is clamped, the other kept.
    assert_eq!(alphas_kulla2017_clamped(T::HALF, -T::ONE), [mirror, T::HALF]);
    let [x, y] = alphas_openpbr_clamped(T::HALF, T::ONE);
    assert_eq!((x, y), (T::lit(0.25) * T::TWO.sqrt(), mirror));
}

#[test]
fn clamping_maps_take_every_texel_f32() {
    clamping_maps_take_every_texel::<f32>();
}

#[test]
fn clamping_maps_take_every_texel_f64() {
    clamping_maps_take_every_texel::<f64>();
}

/// The densities that a power heuristic squares and adds are numbers for the smoothest clamped
/// surfaces, and would not be for much smoother ones.
fn squares_of_densities_are_numbers<T: Scalar>() {
    fn largest<T: Scalar>(surface: impl microsurface::SampleVndf<Scalar = T>) -> T {
        let mirror = RoughConductor::new(surface, Perfect::<T>::new());
        let mut largest = T::ZERO;
        for exponent in 0..200 {
            let z = T::lit(2_f64.powf(-f64::from(exponent)));
            let wo: T::Vec3 = [((T::ONE - z) * (T::ONE + z)).sqrt(), T::ZERO, z].into();
            for u in [T::ZERO, T::HALF, T::BELOW_ONE] {
                let pdf = mirror.sample(wo, [u, T::HALF].into()).map_or(T::ZERO, |sample| sample.pdf);
                largest = largest.max(pdf);
            }
        }
        largest
    }
    for factor in [1.0, 0.0625] {
        let alpha = T::lit(factor) * mirror_alpha();
        let of_all = [
            largest(Ggx::isotropic(alpha).unwrap()),
            largest(Beckmann::isotropic(alpha).unwrap()),
            // In f64 a GTR so narrow has no larger exponent.
            if T::NAME == "f32" {
                largest(Gtr::closed::<10>(alpha).unwrap())
            } else {
                largest(Gtr::closed::<3>(alpha).unwrap())
            },
        ];
        // The bounds of the documentation.
        let alpha3 = alpha.to_f64().powi(3);
        let of_gtr = if T::NAME == "f32" { 3.3 } else { 0.17 };
        for (pdf, bound) in of_all.into_iter().zip([0.16, 0.29, of_gtr]) {
            let share = pdf.to_f64() * alpha3 / bound;
            assert!(share > 0.5 && share < 1.01, "{share}");
        }
        let squares = of_all.map(|pdf| pdf * pdf + pdf * pdf);
        assert_eq!(squares.iter().all(|square| square.is_finite()), factor >= 1.0, "{squares:?}");
    }
}

#[test]
fn squares_of_densities_are_numbers_f32() {
    squares_of_densities_are_numbers::<f32>();
}

#[test]
fn squares_of_densities_are_numbers_f64() {
    squares_of_densities_are_numbers::<f64>();
}

/// Widths of three ratios that entries of A in f32 lose: the peak is 1/(π αx αy).
#[test]
fn rotated_widths_of_any_ratio_are_kept() {
    let peak = |x: f32, y: f32| 1.0 / (PI * f64::from(x) * f64::from(y));
    for (alpha, angle) in [(0.001_f32, 1.0225885), (0.0002, 0.677), (0.0001, 2.823)] {
        let matrix = RoughnessMatrix::rotated(1.0, alpha, angle).unwrap();
        let gtr = Gtr::rotated(1.0, alpha, angle, 2.0).unwrap();
        for d in [
            Ggx::rotated(1.0, alpha, angle).unwrap().d(Vec3::Z),
            Ggx::from_roughness_matrix(matrix).d(Vec3::Z),
            Ggx::from_roughness_matrix(Ggx::from_roughness_matrix(matrix).roughness_matrix().unwrap())
                .d(Vec3::Z),
            Beckmann::rotated(1.0, alpha, angle).unwrap().d(Vec3::Z),
            gtr.d(Vec3::Z),
        ] {
            assert!((f64::from(d) / peak(1.0, alpha) - 1.0).abs() < 4e-7, "{d} at {alpha}");
        }
        // One entry in f32 holds no more than this.
        let [xx, xy, yy] = matrix.entries();
        let held = RoughnessMatrix::new(xx, xy, yy).map_or(0.0, |matrix| matrix.principal()[1]);
        assert!((held / alpha - 1.0).abs() > 1e-3, "{held}");
    }
    for ratio in [1e-8, 1e-14] {
        let d = Ggx::rotated(1.0, ratio, 0.7).unwrap().d(Vec3::Z.into());
        assert!((d * PI * ratio - 1.0).abs() < 1e-15, "{d}");
    }
    // Along and across the direction of αx.
    let (narrow, angle) = (Ggx::rotated(0.1_f64, 0.4, 0.3).unwrap(), 0.3_f64);
    let aligned = Ggx::anisotropic(0.1, 0.4).unwrap();
    for phi in [0.0, 0.5, FRAC_PI_2, 2.0] {
        let at = |azimuth: f64| [0.28 * azimuth.cos(), 0.28 * azimuth.sin(), 0.96].into();
        assert!((narrow.d(at(angle + phi)) / aligned.d(at(phi)) - 1.0).abs() < 1e-13);
    }
}

#[test]
fn anisotropic_gtr_of_exponent_2_is_ggx() {
    let (gtr, ggx) =
        (Gtr::rotated(0.1_f64, 0.8, 0.4, 2.0).unwrap(), Ggx::rotated(0.1_f64, 0.8, 0.4).unwrap());
    let aligned = (Gtr::anisotropic(0.1_f64, 0.8, 2.0).unwrap(), Ggx::anisotropic(0.1_f64, 0.8).unwrap());
    for i in 0..100 {
        let (z, phi) = (f64::from(i) / 100.0 + 0.005, 2.4 * f64::from(i));
        let s = (1.0 - z * z).sqrt();
        let w = [s * phi.cos(), s * phi.sin(), z].into();
        for (a, b) in [
            (gtr.d(w), ggx.d(w)),
            (gtr.sigma(w), ggx.sigma(w)),
            (aligned.0.d(w), aligned.1.d(w)),
            (aligned.0.g1(w, w), aligned.1.g1(w, w)),
        ] {
            assert!((a / b - 1.0).abs() < 1e-13, "{a} and {b}");
        }
    }
    assert!(Gtr::anisotropic(0.5, 1.9, 1.5).is_ok(), "the mean width is below 1");
    assert!(matches!(Gtr::anisotropic(0.5, 8.0, 1.5), Err(Error::AlphaAboveOne { .. })));
    assert!(matches!(Gtr::rotated(0.5, 0.5, f64::NAN, 1.5), Err(Error::Parameter { name: "angle", .. })));
}

/// A principal α at the very end of the range stays, one a hundredth beyond is refused, on every
/// way to a map; also where squares of it are no numbers.
fn the_range_ends_where_it_ends<T: Scalar>() {
    let (smallest, largest) = alpha_range::<T>();
    let scaled = |alpha: T, factor: f64| T::lit(alpha.to_f64() * factor);
    let accepts = |alpha: T| {
        let (wide, one) = (alpha * alpha, T::ONE);
        let diagonal = |x: T, y: T| T::matrix([[x, T::ZERO], [T::ZERO, y]]);
        let (s, c) = (T::lit(0.6), T::lit(0.8));
        let unit = Ggx::isotropic(one).unwrap();
        let rotated = [[c * alpha, s * alpha], [-s * alpha, c * alpha]];
        [
            Ggx::isotropic(alpha).is_ok(),
            AxisAligned::new(one, alpha).is_ok(),
            RoughnessMatrix::rotated(one, alpha, one).is_ok(),
            RoughnessMatrix::new(wide, T::ZERO, one).is_ok(),
            Linear::from_inverse([[alpha, T::ZERO], [T::ZERO, alpha]]).is_ok(),
            Linear::from_inverse([[c, -s * alpha], [s, c * alpha]]).is_ok(),
            Linear::from_inverse(rotated).is_ok(),
            unit.transformed(diagonal(one / alpha, one / alpha)).is_ok(),
            Transformed::new(unit, diagonal(alpha, alpha)).is_ok(),
        ]
    };
    assert_eq!(accepts(smallest), [true; 9]);
    assert_eq!(accepts(largest), [true; 9]);
    for alpha in [scaled(smallest, 0.99), scaled(largest, 1.01)] {
        assert_eq!(accepts(alpha), [false; 9], "{}", alpha.hex());
    }
    let tiny = if T::NAME == "f32" { 1e-30 } else { 1e-100 };
    for factor in [tiny, tiny * 1e-8, 1.0 / tiny] {
        assert_eq!(accepts(T::lit(factor)), [false; 9], "{factor}");
    }
}

#[test]
fn the_range_ends_where_it_ends_f32() {
    the_range_ends_where_it_ends::<f32>();
}

#[test]
fn the_range_ends_where_it_ends_f64() {
    the_range_ends_where_it_ends::<f64>();
}

/// A refused map names its own determinant, whatever refuses it.
#[test]
fn errors_name_the_determinant_of_the_map() {
    let named = |error: Error| match error {
        Error::Map { determinant } => determinant,
        error => panic!("{error:?}"),
    };
    let surface = Ggx::isotropic(0.5).unwrap();
    let matrix = DMat2::from_cols_array(&[3e90, 1e90, 0.0, 2e90]);
    is_near(named(surface.transformed(matrix).unwrap_err()), 6e180);
    is_near(named(Transformed::new(surface, matrix).unwrap_err()), 6e180);
    // M = R⁻¹.
    is_near(named(Linear::from_inverse([[2e-80, 1.0], [0.0, 4e-80]]).unwrap_err()), 1.25e159);
    let narrow = Ggx::anisotropic(1e-76, 1.0).unwrap();
    is_near(named(narrow.stretched(0.9).unwrap_err()), 1e76);
    let sheared = Microsurface::new(Ggx, Linear::from_inverse([[1e-76, 0.0], [0.0, 1.0]]).unwrap());
    is_near(named(sheared.stretched(0.9).unwrap_err()), 1e76);
    let Err(Error::RoughnessMatrix { determinant, .. }) = RoughnessMatrix::new(2.0, 3.0, 4.0) else {
        panic!("accepted")
    };
    is_near(determinant, -1.0);
}
