//! Materials varied by numbers of each element, against scalar calls on the surface of each;
//! functions of one's own.

use std::panic::catch_unwind;

use microsurface::batch::{
    self, AlphaPairs, Alphas, Filtered, FilteredProjected, Footprints, NdfBatch, RoughnessMatrices, Varied,
};
use microsurface::bsdf::RoughConductor;
use microsurface::filter::{Footprint, projected};
use microsurface::fresnel::Schlick;
use microsurface::roughness::clamped;
use microsurface::{Beckmann, Error, Ggx, Gtr, Ndf, Real, RoughnessMatrix};

use crate::arguments::{Arguments, direction};
use crate::{Elementary, LONGEST, evaluates, reflects, same, samples};

/// Widths and steps over their range, the same for the same index.
fn width<T: Real>(i: usize, k: usize) -> T {
    T::lit(10_f64.powf(-4.0 * (0.754877666 * (i + 31 * k) as f64 % 1.0)))
}

/// Among them a footprint of a point, of a line, and one whose first step is 0.
fn step<T: Real>(i: usize, k: usize) -> T {
    match i % 9 {
        2 => T::ZERO,
        4 => T::lit(0.01 * (i as f64)) * if k.is_multiple_of(2) { T::ONE } else { T::TWO },
        6 if k < 2 => T::ZERO,
        _ => T::lit(0.5 - 0.569840290998 * (i + 17 * k) as f64 % 1.0),
    }
}

/// Slices of such numbers.
fn slices<T, const N: usize>(len: usize, number: impl Fn(usize, usize) -> T) -> [Vec<T>; N] {
    core::array::from_fn(|k| (0..len).map(|i| number(i, k)).collect())
}

fn footprints<T>([du_x, du_y, dv_x, dv_y]: &[Vec<T>; 4]) -> Footprints<'_, T> {
    Footprints { du_x, du_y, dv_x, dv_y }
}

fn footprint<T: Real>(i: usize) -> Footprint<T> {
    Footprint::new([step(i, 0), step(i, 1)], [step(i, 2), step(i, 3)])
}

pub(crate) fn everything<T: Elementary>() {
    for len in 0..=LONGEST {
        textures::<T>(len);
        filters::<T>(len);
        functions::<T>(len);
    }
}

fn textures<T: Elementary>(len: usize) {
    let ggx = Ggx::isotropic(T::lit(0.2)).unwrap();
    let [alpha] = &slices(len, width::<T>);
    let textured = Varied::new(&ggx, Alphas::new(alpha).unwrap());
    let at = |i| Ggx::isotropic(width::<T>(i, 0)).unwrap();
    evaluates(&textured, len, &at);
    samples(&textured, len, &at);

    let [x, y] = &slices(len, width::<T>);
    let fresnel = Schlick::new(T::lit(0.9)).unwrap();
    let plastic = RoughConductor::new(Beckmann::isotropic(T::lit(0.2)).unwrap(), fresnel);
    reflects(&Varied::new(&plastic, AlphaPairs::new(x, y).unwrap()), len, &|i| {
        RoughConductor::new(Beckmann::anisotropic(width::<T>(i, 0), width(i, 1)).unwrap(), fresnel)
    });

    let entries = |i| RoughnessMatrix::rotated(width::<T>(i, 0), T::lit(0.1), width(i, 1)).unwrap().entries();
    let matrix = |i| {
        let [xx, xy, yy] = entries(i);
        RoughnessMatrix::new(xx, xy, yy).unwrap()
    };
    let [xx, xy, yy] = &slices(len, |i, k| entries(i)[k]);
    let turned = Varied::new(&ggx, RoughnessMatrices::new(xx, xy, yy).unwrap());
    evaluates(&turned, len, &|i| Ggx::from_roughness_matrix(matrix(i)));
}

fn filters<T: Elementary>(len: usize) {
    let variance = T::lit(1.0 / 12.0);
    let steps = &slices(len, step::<T>);
    let beckmann = Beckmann::anisotropic(T::lit(0.01), T::lit(0.1)).unwrap();
    let by = Filtered::new(footprints(steps), variance).unwrap();
    let filtered = |i| beckmann.filtered(footprint::<T>(i).covariance(variance)).unwrap();
    let fresnel = Schlick::new(T::lit(0.9)).unwrap();
    let plastic = RoughConductor::new(beckmann, fresnel);
    reflects(&Varied::new(&plastic, by), len, &|i| RoughConductor::new(filtered(i), fresnel));

    let ggx = Ggx::isotropic(T::lit(0.01)).unwrap();
    let by = FilteredProjected::new(footprints(steps), variance).unwrap();
    let a = Arguments::<T>::new(len, 8);
    let mut out = vec![T::ONE; len];
    Varied::new(&ggx, by).d_batch(a.wo(), &mut out);
    same("d in projected space", &out, |i| {
        projected::filtered(&ggx, footprint(i), variance).unwrap().d(direction::<T>(&a.wo, i))
    });
}

fn functions<T: Elementary>(len: usize) {
    let a = Arguments::<T>::new(len, 9);
    let [alpha] = &slices(len, width::<T>);
    let gtr = Gtr::spline(T::lit(0.3), T::lit(1.5)).unwrap();
    let (mut ratio, mut cosine) = (vec![T::ONE; len], vec![T::ONE; len]);
    batch::map((&alpha[..], a.wi(), a.wo()), (&mut ratio[..], &mut cosine[..]), |(alpha, wi, wo)| {
        (alpha * gtr.d(wi.into()), wo[2])
    });
    same("a function", &ratio, |i| alpha[i] * gtr.d(direction::<T>(&a.wi, i)));
    same("its second value", &cosine, |i| a.wo[2][i]);
}

#[test]
fn numbers_that_make_no_surface_are_refused() {
    let mut alpha = vec![0.3_f32; 70];
    assert!(Alphas::new(&alpha).is_ok());
    let good = [0.5_f32; 70];
    for bad in [0.0, -0.1, f32::NAN, f32::INFINITY, 1e-12] {
        alpha[66] = bad;
        let named = |error| matches!(error, Error::Alpha { value, .. } if value.to_bits() == f64::from(bad).to_bits());
        assert!(named(Alphas::new(&alpha).unwrap_err()), "{bad}");
        assert!(named(AlphaPairs::new(&good, &alpha).unwrap_err()), "{bad}");
        assert!(named(AlphaPairs::new(&alpha, &good).unwrap_err()), "{bad}");
    }
    let correlated = [0.1_f64, 0.3];
    let refused = RoughnessMatrices::new(&[0.2, 0.2], &correlated, &[0.2, 0.2]).unwrap_err();
    assert!(matches!(refused, Error::RoughnessMatrix { xy: 0.3, .. }));
    assert!(catch_unwind(|| RoughnessMatrices::new(&[0.2, 0.2], &[0.0], &[0.2, 0.2])).is_err());
}

/// Where a checked texture is refused a clamping one has the nearest width, and all others are as
/// they were.
#[test]
fn clamped_numbers_make_a_surface_each() {
    let texels: Vec<f32> =
        (0..70).map(|i| [0.3, 0.0, -0.1, f32::NAN, f32::INFINITY, 1e-12, 1.0][i % 7]).collect();
    let a = Arguments::<f32>::new(70, 11);
    let surface = Ggx::isotropic(0.2_f32).unwrap();
    let mut d = [f32::NAN; 70];
    Varied::new(&surface, Alphas::clamped(&texels)).d_batch(a.wi(), &mut d);
    same("clamped α", &d, |i| Ggx::isotropic(clamped(texels[i])).unwrap().d(direction::<f32>(&a.wi, i)));
    let others: Vec<f32> = texels.iter().rev().copied().collect();
    Varied::new(&surface, AlphaPairs::clamped(&texels, &others)).d_batch(a.wi(), &mut d);
    same("clamped α of two axes", &d, |i| {
        let [x, y] = [texels[i], others[i]].map(clamped);
        Ggx::anisotropic(x, y).unwrap().d(direction::<f32>(&a.wi, i))
    });
}

#[test]
fn footprints_that_no_filter_takes_are_refused() {
    let still = [0.0_f32; 70];
    let mut du = [0.01_f32; 70];
    let new = |du: &[f32], variance| {
        let footprints = Footprints { du_x: &still, du_y: du, dv_x: &still, dv_y: &still };
        let projected = FilteredProjected::new(footprints, variance).is_err();
        let refused = Filtered::new(footprints, variance).err();
        assert_eq!(refused.is_some(), projected);
        refused
    };
    assert_eq!(new(&du, 0.25), None);
    for variance in [-0.25, f32::NAN, f32::INFINITY] {
        assert!(matches!(new(&du, variance), Some(Error::Covariance { .. })), "{variance}");
    }
    for bad in [f32::NAN, f32::INFINITY, -f32::INFINITY, 2e9] {
        du[65] = bad;
        let Some(Error::Covariance { xx, yy, .. }) = new(&du, 0.25) else { panic!("{bad}") };
        assert!(xx == 0.0 || xx.is_nan(), "{xx}");
        assert!(!yy.is_finite() || yy > 9e17, "{yy}");
    }
    // The largest that is taken leaves a surface.
    du[65] = 1e9;
    let footprints = Footprints { du_x: &du, du_y: &du, dv_x: &du, dv_y: &du };
    let surface = Beckmann::isotropic(0.1_f32).unwrap();
    let a = Arguments::<f32>::new(70, 10);
    let mut d = [f32::NAN; 70];
    Varied::new(&surface, Filtered::new(footprints, 0.25).unwrap()).d_batch(a.wi(), &mut d);
    assert!(d.iter().zip(&a.wi[1]).all(|(d, y)| d.is_finite() || y.is_nan()));
}

#[test]
#[should_panic(expected = "differ in length: 3 and 2")]
fn a_texture_of_another_length_panics() {
    let surface = Ggx::isotropic(0.1_f32).unwrap();
    let a = Arguments::<f32>::new(3, 1);
    Varied::new(&surface, Alphas::new(&[0.1, 0.2]).unwrap()).d_batch(a.wi(), &mut [0.0; 3]);
}
