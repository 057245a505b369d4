//! The table: what each material reflects, checked two ways.

use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Perfect;
use microsurface::glam::Vec3;
use microsurface::{Error, Ggx};

use crate::furnace::{self, Estimate, direction, quadrature, sampled};
use crate::integrator::Faults;
use crate::picture::{Entry, Picture};

/// The cosines at which albedos are listed.
const COSINES: [f32; 4] = [0.2, 0.5, 0.8, 1.0];

/// Above this many standard errors between sampler and quadrature, one of them is wrong.
pub(crate) const LARGEST_DEVIATION: f64 = 6.0;

/// What the checks found.
#[derive(Default)]
pub(crate) struct Verdict {
    pub(crate) faults: Faults,
    /// One sentence for each material or reference that failed.
    pub(crate) failures: Vec<String>,
}

/// Explains the columns.
pub(crate) fn print_legend() {
    println!(
        "\
E(mu)      share of white light from everywhere that leaves at cosine mu to the normal, single reflection with
           height-correlated masking and reflectance 1: mean weight of samples by visible normals; the digits in
           brackets are the standard error of the last digits. What is missing from 1 is reflected more than once.
deviation  largest difference of these from a quadrature that does not sample, in standard errors
           (fails above {LARGEST_DEVIATION}; the quadrature counts as uncertain by {})
albedo     with the metal's Fresnel reflectance at mu = 0.8 for red, green and blue (linear), by the quadrature
samples/s  of sample() on one thread, in millions",
        furnace::QUADRATURE_ERROR
    );
}

/// Prints the materials of a picture, one line each.
pub(crate) fn print_table(picture: &Picture, samples: u32, verdict: &mut Verdict) {
    println!("\n{}.png  {}", picture.name, picture.title);
    print!("  {:54}", "row.column  material");
    for cos in COSINES {
        print!(" {:>11}", format!("E({cos:.1})"));
    }
    println!("  deviation  albedo             samples/s");
    for (r, row) in picture.rows.iter().enumerate() {
        for (c, entry) in row.iter().enumerate() {
            print!("  {}.{}  {:49}", r + 1, c + 1, entry.label);
            print_numbers(entry, samples, (10 * r + c) as u64, verdict);
        }
    }
}

fn print_numbers(entry: &Entry, samples: u32, seed: u64, verdict: &mut Verdict) {
    let mut deviation = 0.0_f64;
    let mut seconds = 0.0;
    for (i, cos) in COSINES.into_iter().enumerate() {
        let wo = direction(cos);
        let (estimate, time) =
            sampled(&*entry.furnace, wo, samples, seed << 8 | i as u64, &mut verdict.faults);
        let exact = quadrature(&*entry.furnace, wo, &mut verdict.faults).x;
        deviation = largest(deviation, estimate.deviation(exact));
        seconds += time.as_secs_f64();
        print!(" {:>11}", with_error(estimate));
    }
    let albedo = quadrature(&*entry.material, direction(0.8), &mut verdict.faults);
    let speed = f64::from(samples) * COSINES.len() as f64 / seconds * 1e-6;
    println!("  {deviation:9.1}  {:.3} {:.3} {:.3}  {speed:9.1}", albedo.x, albedo.y, albedo.z);
    if deviation.is_nan() || deviation > LARGEST_DEVIATION {
        verdict
            .failures
            .push(format!("{}: sampler and quadrature differ by {deviation:.1} sigma", entry.label));
    }
}

/// The larger of two numbers that are not negative; NaN where either is.
pub(crate) fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// 0.7453(12) for 0.7453 ± 0.0012.
fn with_error(Estimate { mean, error }: Estimate) -> String {
    format!("{mean:.4}({:.0})", error * 1e4)
}

/// E(mu) of GGX at mu = 0.1, 0.3, 0.5, 0.7, 0.9, 1, integrated independently to all digits given.
const GGX_REFERENCE: [(f32, [f64; 6]); 2] = [
    (0.5, [0.8601, 0.7453, 0.6983, 0.6830, 0.6840, 0.6879]),
    (1.0, [0.7602, 0.5601, 0.4507, 0.3789, 0.3275, 0.3069]),
];

/// Compares the quadrature with known albedos of GGX.
pub(crate) fn print_reference(verdict: &mut Verdict) -> Result<(), Error> {
    let mut difference = 0.0_f64;
    for (alpha, albedos) in GGX_REFERENCE {
        let material = RoughConductor::new(Ggx::isotropic(alpha)?, Perfect::<Vec3>::new());
        for (cos, known) in [0.1, 0.3, 0.5, 0.7, 0.9, 1.0].into_iter().zip(albedos) {
            let albedo = quadrature(&material, direction(cos), &mut verdict.faults).x;
            difference = largest(difference, (albedo - known).abs());
        }
    }
    println!(
        "\nGGX of alpha 0.5 and 1: E(mu) by quadrature differs from 12 known values by at most {difference:.5}"
    );
    if difference.is_nan() || difference > furnace::QUADRATURE_ERROR {
        verdict.failures.push(format!("GGX albedos are off by {difference:.5}"));
    }
    Ok(())
}
