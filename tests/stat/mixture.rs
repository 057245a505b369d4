//! What `UniformMixture::for_alpha` does to the variance: the table of its documentation.
//!
//! Variances are integrals, ∫ (f L wi.z)²/pdf dwi − (∫ f L wi.z dwi)², over the square of the mean,
//! and are estimated as such for every sampling from the same stratified directions, half of them
//! uniform: the weights of all normals at grazing angles are too rare to be met by their own
//! samples.

use microsurface::bsdf::{AllNormals, UniformMixture};

use crate::points::Random;
use crate::rows::{Distribution, Row};
use crate::special::count;
use crate::surfaces::{Conductor, MapSpec, Normals, conductor};

/// GTR, and GGX where there is no γ.
const GAMMAS: [Option<f64>; 5] = [Some(0.1), Some(1.0), Some(1.5), None, Some(4.0)];
const ANGLES: [f64; 4] = [0.0, 30.0, 60.0, 80.0];

/// The radiance of a direction, given that of mirror reflection.
type Light = fn([f64; 3], [f64; 3]) -> f64;
const LIGHTS: [Light; 2] = [
    |_, _| 1.0,
    // The lobe cos⁸ about the mirror direction.
    |wi, mirror| (wi[0] * mirror[0] + wi[1] * mirror[1] + wi[2] * mirror[2]).max(0.0).powi(8),
];

/// The variances of the samplings relative to the square of the mean, under each light.
fn variances(samplings: &[&dyn Conductor], proposal: &dyn Conductor, degrees: f64, n: u32) -> Vec<[f64; 2]> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (wo, mirror) = ([sin, 0.0, cos], [-sin, 0.0, cos]);
    let mut random = Random::new(9, 53);
    let mut means = [0.0; 2];
    let mut squares = vec![[0.0; 2]; samplings.len()];
    for i in 0..n * n {
        let u = [i / n, i % n].map(|k| (f64::from(k) + random.uniform()) / f64::from(n));
        let Some((wi, _)) = proposal.sample(wo, u) else { continue };
        let (f, density) = (proposal.eval(wi, wo) * wi[2], proposal.pdf(wi, wo) * f64::from(n * n));
        let radiance = LIGHTS.map(|light| f * light(wi, mirror));
        for (mean, value) in means.iter_mut().zip(radiance) {
            *mean += value / density;
        }
        for (square, brdf) in squares.iter_mut().zip(samplings) {
            let pdf = brdf.pdf(wi, wo) * density;
            for (square, value) in square.iter_mut().zip(radiance) {
                *square += value * value / pdf;
            }
        }
    }
    squares.iter().map(|s| [0, 1].map(|l| s[l] / (means[l] * means[l]) - 1.0)).collect()
}

/// The variances of all normals and of the mixture; for GGX those of visible normals too.
fn measured(alpha: f64, gamma: Option<f64>, degrees: f64, n: u32) -> Vec<[f64; 2]> {
    let p = UniformMixture::for_alpha(AllNormals, alpha).expect("a width").probability();
    let (distribution, map) = match gamma {
        None => (Distribution::GGX, MapSpec::Isotropic(alpha)),
        Some(gamma) => (Row::SplineGtr.with(alpha, gamma), MapSpec::Isotropic(1.0)),
    };
    let brdf = |normals| conductor::<f64>(distribution, map, normals);
    let [all, mixed, half] = [Normals::All, Normals::Mixed(p), Normals::Mixed(0.5)].map(brdf);
    if gamma.is_none() {
        return variances(&[&*all, &*mixed, &*brdf(Normals::Visible)], &*half, degrees, n);
    }
    variances(&[&*all, &*mixed], &*half, degrees, n)
}

/// Mean variances over γ and angles, of [all normals, the mixture], each under [light all around, a
/// lobe].
fn means(alpha: f64, n: u32) -> [[f64; 2]; 2] {
    let mut sums = [[0.0; 2]; 2];
    for gamma in GAMMAS {
        for degrees in ANGLES {
            let variances = measured(alpha, gamma, degrees, n);
            for (sum, variance) in sums.iter_mut().zip(variances) {
                for (sum, variance) in sum.iter_mut().zip(variance) {
                    *sum += variance / count(GAMMAS.len() * ANGLES.len());
                }
            }
        }
    }
    sums
}

const ALPHAS: [f64; 7] = [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0];

#[test]
fn mixtures_lower_the_variance_of_rough_surfaces() {
    for alpha in ALPHAS {
        let [[all, all_lobe], [mixed, mixed_lobe]] = means(alpha, 48);
        let [around, lobe] = [mixed / all, mixed_lobe / all_lobe];
        eprintln!(
            "alpha = {alpha}: variance times {around:.3} under a light all around, {lobe:.3} under a lobe"
        );
        // What the documentation says, to 2 % of sampling noise.
        assert!(around < 1.0 - 0.5 * alpha, "alpha = {alpha}: {around}");
        assert!(lobe < 1.07, "alpha = {alpha}: {lobe}");
    }
}

#[test]
#[ignore = "prints tables, those of the documentation among them"]
fn long_mixture() {
    eprintln!(
        "mean over gamma and angles: light all around, all normals and mixture, ratio; the same for a lobe"
    );
    for alpha in ALPHAS {
        let [all, mixed] = means(alpha, 256);
        let [around, lobe] =
            [0, 1].map(|l| format!("{:.2} | {:.2} | {:.2}", all[l], mixed[l], mixed[l] / all[l]));
        eprintln!("| {alpha} | {around} | {lobe} |");
    }
    for (l, light) in ["light all around", "a lobe"].into_iter().enumerate() {
        eprintln!("GGX, {light}, at {ANGLES:?} degrees: all normals, mixture, visible normals");
        for alpha in ALPHAS {
            let row = ANGLES.map(|degrees| {
                let v = measured(alpha, None, degrees, 256);
                format!("{:.3} {:.3} {:.3}", v[0][l], v[1][l], v[2][l])
            });
            eprintln!("| {alpha} | {} |", row.join(" | "));
        }
    }
}
