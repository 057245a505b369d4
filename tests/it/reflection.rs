//! The BRDF of a rough conductor where properties over random arguments see little: the vanishing
//! half vector, the density of a sample against that of its direction, weights against 1.

use microsurface::Ggx;
use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Perfect;
use microsurface::glam::{DVec3, Vec3};
use microsurface::{Beckmann, Gtr, Real, SampleVndf};
use rand::{Rng, RngExt};
use rand_pcg::Pcg64Mcg;

use crate::scalar::Scalar;

/// Opposite directions a little above the horizon are reflected by a half vector of length 4e-5,
/// and no longer below 2⁻³² (f32) or 2⁻²⁵⁶ (f64).
#[test]
fn the_half_vector_vanishes_where_documented() {
    let mirror = RoughConductor::new(Ggx::isotropic(1.0_f32).unwrap(), Perfect::<f32>::new());
    let opposite = |z: f32| mirror.eval(Vec3::new(1.0, 0.0, z), Vec3::new(-1.0, 0.0, z));
    // D = 1/π, σ = ½ at the horizon: 1/(4π z).
    let f = opposite(2e-5);
    assert!((f / 3978.8736 - 1.0).abs() < 2e-5, "{f}");
    let shortest = 1.1641532e-10; // half of 2⁻³²
    assert!(opposite(1.01 * shortest) > 0.0);
    assert_eq!(opposite(0.99 * shortest), 0.0);
    let mirror = RoughConductor::new(Ggx::isotropic(1.0_f64).unwrap(), Perfect::<f64>::new());
    let opposite = |z: f64| mirror.eval(DVec3::new(1.0, 0.0, z), DVec3::new(-1.0, 0.0, z));
    let shortest = 4.318084277547222e-78; // half of 2⁻²⁵⁶
    assert!(opposite(1.01 * shortest) > 0.0);
    assert_eq!(opposite(0.99 * shortest), 0.0);
}

/// Directions uniform over the hemisphere, and two numbers.
fn view_and_numbers<T: Real>(random: &mut impl Rng) -> (T::Vec3, T::Vec2) {
    let (z, phi): (f64, f64) = (random.random(), core::f64::consts::TAU * random.random::<f64>());
    let s = ((1.0 - z) * (1.0 + z)).sqrt();
    let u = [random.random::<f64>(), random.random()].map(T::lit);
    ([s * phi.cos(), s * phi.sin(), z].map(T::lit).into(), u.into())
}

/// The median, the 99th percentile and the largest of |ratio − 1| of `sample.pdf` and `pdf(wi,
/// wo)`.
fn deviations<T: Scalar>(alpha: f64) -> [f64; 3] {
    let mut random = Pcg64Mcg::new(3);
    let mirror = RoughConductor::new(Ggx::isotropic(T::lit(alpha)).unwrap(), Perfect::<T>::new());
    let mut deviations: Vec<f64> = (0..100_000)
        .filter_map(|_| {
            let (wo, u) = view_and_numbers::<T>(&mut random);
            let sample = mirror.sample(wo, u)?;
            Some((sample.pdf.to_f64() / mirror.pdf(sample.wi, wo).to_f64() - 1.0).abs())
        })
        .collect();
    deviations.sort_by(f64::total_cmp);
    let count = deviations.len();
    [deviations[count / 2], deviations[count * 99 / 100], deviations[count - 1]]
}

/// The table of [`Sample`](microsurface::bsdf::Sample): α, and per scalar the median, the 99th
/// percentile, the largest. The largest of a hundred thousand is within a factor of ten of that of
/// millions.
#[test]
fn densities_of_samples_differ_as_documented() {
    for (alpha, single, double) in [
        (0.3, [1.1e-7, 5e-7, 5e-6], [2.2e-16, 1.2e-15, 2e-14]),
        (0.1, [1.9e-7, 2e-6, 3e-5], [3.3e-16, 3.4e-15, 8e-14]),
        (0.01, [1.4e-6, 6e-5, 2e-3], [2.7e-15, 1.1e-13, 5e-12]),
        (1e-3, [1.4e-5, 1e-3, 0.1], [2.6e-14, 2e-12, 3e-10]),
        (1e-4, [1.4e-4, 1e-2, 5.0], [2.6e-13, 2e-11, 1e-8]),
    ] {
        for (seen, documented) in [(deviations::<f32>(alpha), single), (deviations::<f64>(alpha), double)] {
            println!("α {alpha}: {seen:?} of {documented:?}");
            for (k, least) in [(0, 0.8), (1, 0.5), (2, 0.1)] {
                let share = seen[k] / documented[k];
                assert!(share > least && share < 1.2, "α {alpha}: {seen:?} instead of {documented:?}");
            }
        }
    }
}

/// Weights of visible normals are above 1 by 2ε at most, and are above it now and then.
fn weights_exceed_the_reflectance_by_rounding<T: Scalar>() {
    fn largest<T: Scalar>(surface: impl SampleVndf<Scalar = T>) -> f64 {
        let mirror = RoughConductor::new(surface, Perfect::<T>::new());
        let mut random = Pcg64Mcg::new(4);
        (0..50_000).fold(0.0, |largest: f64, _| {
            let (wo, u) = view_and_numbers::<T>(&mut random);
            let weight = mirror.sample(wo, u).map_or(0.0, |sample| sample.weight.to_f64());
            largest.max((weight - 1.0) / T::EPSILON.to_f64())
        })
    }
    let mut worst = 0.0_f64;
    for alpha in [1e-4, 1e-3, 0.1, 1.0].map(T::lit) {
        worst = worst.max(largest(Ggx::isotropic(alpha).unwrap()));
        worst = worst.max(largest(Ggx::rotated(alpha, T::ONE, T::HALF).unwrap()));
        worst = worst.max(largest(Beckmann::isotropic(alpha).unwrap()));
        worst = worst.max(largest(Gtr::isotropic(alpha, T::lit(1.5)).unwrap()));
    }
    assert!(worst > 0.0 && worst <= 2.0, "{worst} ε");
}

#[test]
fn weights_exceed_the_reflectance_by_rounding_f32() {
    weights_exceed_the_reflectance_by_rounding::<f32>();
}

#[test]
fn weights_exceed_the_reflectance_by_rounding_f64() {
    weights_exceed_the_reflectance_by_rounding::<f64>();
}
