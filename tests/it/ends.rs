//! The ends of the domain of samplers: numbers of exactly 1, and views so steep that squares
//! vanish.

use microsurface::bsdf::{AllNormals, RoughConductor, UniformMixture};
use microsurface::fresnel::Perfect;
use microsurface::{Beckmann, Ndf, SampleNdf, SampleVndf};

use crate::rows::Row;
use crate::scalar::{Scalar, dot, wide};
use crate::surfaces::{Move, Shape, Spec, Surface, Widths};

/// A surface of every distribution.
fn surfaces<T: Scalar>() -> Vec<Surface<T>> {
    let rows = Row::ALL.iter();
    // Of the narrow ones with a light tail nothing of the density is left at the horizon.
    let shapes = rows.flat_map(|row| row.of_width(0.3).chain(row.of_width(1e-3))).map(Shape::from);
    let filtered = [false, true].map(|by_two| Shape::Filtered { deviations: [0.1, 0.3], by_two });
    let build = |shape| Spec::new(shape, Widths::Isotropic(0.7), Move::Stay).build().unwrap();
    shapes.chain(filtered).map(build).collect()
}

/// Generators of f32 round to 1 now and then: it counts as the number below it.
fn one_is_the_last_number<T: Scalar>() {
    let last = |u: T| if u == T::ONE { T::BELOW_ONE } else { u };
    let views =
        [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [0.28, 0.0, -0.96]].map(|w| w.map(T::lit));
    for surface in surfaces::<T>() {
        for [u1, u2] in [[T::ONE, T::HALF], [T::lit(0.3), T::ONE], [T::ONE; 2], [T::ONE, T::ZERO]] {
            let (u, before): (T::Vec2, T::Vec2) = ([u1, u2].into(), [last(u1), last(u2)].into());
            let close = |name: &str, a: T::Vec3, b: T::Vec3| {
                let (a, b): ([T; 3], [T; 3]) = (a.into(), b.into());
                let difference = wide(a).iter().zip(wide(b)).fold(0.0, |sum, (a, b)| sum + (a - b).abs());
                assert!(difference < 32.0 * T::EPSILON.to_f64(), "{surface:?} {name} {u:?}: {a:?} and {b:?}");
            };
            close("sample_d", surface.sample_d(u), surface.sample_d(before));
            if !surface.samples_visible() {
                continue;
            }
            // From where next to nothing is visible a normal has no density.
            let sees = |w: [T; 3]| surface.sigma(w.into()) >= T::MIN_POSITIVE.sqrt();
            for w in views.into_iter().filter(|&w| sees(w)) {
                let (at_one, at_last) =
                    (surface.sample_vndf(w.into(), u), surface.sample_vndf(w.into(), before));
                close("sample_vndf", at_one, at_last);
                let seen = dot(w, at_one.into()) > T::ZERO && surface.vndf(w.into(), at_one) > T::ZERO;
                assert!(seen, "{surface:?} {w:?} {u:?}: {at_one:?}");
            }
        }
        let wo: T::Vec3 = [T::lit(0.6), T::ZERO, T::lit(0.8)].into();
        let mixture = UniformMixture::new(AllNormals, T::HALF).unwrap();
        let mixed = RoughConductor::new(surface.clone(), Perfect::<T>::new()).sampled_by(mixture);
        let sample =
            mixed.sample(wo, [T::ONE, T::HALF].into()).expect("a uniform direction just above the horizon");
        assert!(sample.pdf > T::ZERO && sample.weight.is_finite(), "{surface:?}: {sample:?}");
    }
}

#[test]
fn one_is_the_last_number_f32() {
    one_is_the_last_number::<f32>();
}

#[test]
fn one_is_the_last_number_f64() {
    one_is_the_last_number::<f64>();
}

/// A view so near to the normal that the square of its horizontal part is subnormal sees the slopes
/// of the normal's view.
fn slopes_of_steep_views_are_those_of_the_normal<T: Scalar>() {
    let surface = Beckmann::isotropic(T::lit(0.1)).unwrap();
    let slope = |x: f64, u: [f64; 2]| -> f64 {
        let w: T::Vec3 = [T::lit(x), T::ZERO, T::ONE].into();
        let [x, y, z] = wide(surface.sample_vndf(w, u.map(T::lit).into()).into());
        (x / z).hypot(y / z)
    };
    let squared_below_normal = T::MIN_POSITIVE.sqrt().to_f64();
    for u in [[0.1, 0.2], [0.5, 0.7], [0.9, 0.4]] {
        let expected = slope(0.0, u);
        for exponent in -20..20 {
            let x = squared_below_normal * 2_f64.powi(exponent);
            let share = slope(x, u) / expected;
            assert!((share - 1.0).abs() < 4.0 * T::EPSILON.to_f64(), "{share} at {x:e}");
        }
    }
}

#[test]
fn slopes_of_steep_views_are_those_of_the_normal_f32() {
    slopes_of_steep_views_are_those_of_the_normal::<f32>();
}

#[test]
fn slopes_of_steep_views_are_those_of_the_normal_f64() {
    slopes_of_steep_views_are_those_of_the_normal::<f64>();
}

/// Walter's fits below the horizon are what the exact functions are there.
#[test]
fn the_fits_of_walter_know_the_horizon() {
    let surface = Beckmann::isotropic(0.5_f64).unwrap();
    for z in [1.0, 0.9, 0.3, 1e-3, 1e-300] {
        let r = f64::sqrt((1.0 - z) * (1.0 + z));
        let (up, down) = ([r, 0.0, z].into(), [r, 0.0, -z].into());
        assert_eq!(surface.g1_walter2007(down), 0.0);
        assert_eq!(surface.lambda_walter2007(down), -1.0 - surface.lambda_walter2007(up));
    }
    let level = [1.0, 0.0, 0.0].into();
    assert_eq!((surface.g1_walter2007(level), surface.lambda_walter2007(level)), (0.0, f64::INFINITY));
}

/// A direction whose height vanishes once it is normalised keeps its side.
#[test]
fn lambda_of_a_moved_surface_keeps_its_side() {
    use microsurface::glam::{Mat2, Vec2, Vec3};
    use microsurface::{Ggx, transform::Transformed};
    let ggx = Ggx::isotropic(0.1_f32).unwrap();
    let matrix = Mat2::from_diagonal(Vec2::new(0.5, 0.5));
    let (wrapped, moved) = (Transformed::new(ggx, matrix).unwrap(), ggx.transformed(matrix).unwrap());
    for z in [-1e-45_f32, 1e-45] {
        let w = Vec3::new(1.0, 0.0, z);
        assert_eq!(wrapped.lambda(w), moved.lambda(w), "{z}");
        assert_eq!(wrapped.lambda(w), f32::INFINITY.copysign(z));
    }
    let w = Vec3::new(0.019998668, 0.0, 0.9998);
    let stretched = Mat2::from_diagonal(Vec2::new(2.0, 1.0));
    for sigma in [
        Transformed::new(Beckmann::isotropic(0.1_f32).unwrap(), stretched).unwrap().sigma(w),
        Transformed::new(ggx, stretched).unwrap().sigma(w),
    ] {
        assert!(sigma >= w.z, "{sigma}");
    }
}
