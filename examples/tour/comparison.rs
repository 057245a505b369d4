//! How noisy is a picture of GTR by visible normals, by all normals, and by the papers' mixture of
//! all normals and uniform directions?
//!
//! Nothing but the sampling differs: one reflection of the environment's light at what the centre
//! of a pixel sees, without a limit on contributions, from independent random numbers. The mean
//! squared error of n samples is then the variance of one over n, and a ratio of variances the
//! ratio of the samples needed for the same error.

use core::ops::AddAssign;
use core::time::Duration;
use std::time::Instant;

use indicatif::ProgressBar;
use microsurface::bsdf::{AllNormals, RoughConductor, UniformMixture};
use microsurface::glam::{DVec3, Vec2, Vec3};
use microsurface::{Error, Gtr};
use rand::RngExt;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::SeedableRng;

use crate::environment::Environment;
use crate::image::Image;
use crate::integrator::{Faults, by_environment, power_heuristic};
use crate::material::Material;
use crate::metals::ALUMINIUM;
use crate::render::each_row;
use crate::report::{LARGEST_DEVIATION, Verdict, largest};
use crate::scene::{Scene, Vertex, spheres};

/// The columns and, from the back, the rows of spheres.
const GAMMAS: [f32; 6] = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
const ALPHAS: [f32; 4] = [0.08, 0.2, 0.5, 0.8];
const SPHERES: usize = GAMMAS.len() * ALPHAS.len();

const SAMPLINGS: [&str; 3] = ["visible", "all", "mixture"];
const ESTIMATORS: [&str; 2] =
    ["Sampling of the BSDF alone", "Multiple importance sampling of BSDF and light"];

/// One for each sampling under each estimator.
type Each<T> = [[T; SAMPLINGS.len()]; ESTIMATORS.len()];

/// Sums over pixels.
#[derive(Debug, Default, Clone, Copy)]
struct Noise {
    pixels: f64,
    /// Mean of the samples, and their variance, each the mean of the channels.
    mean: f64,
    variance: f64,
    /// Squared standard errors of these.
    mean_error2: f64,
    variance_error2: f64,
    time: Duration,
}

impl AddAssign for Noise {
    fn add_assign(&mut self, other: Self) {
        self.pixels += other.pixels;
        self.mean += other.mean;
        self.variance += other.variance;
        self.mean_error2 += other.mean_error2;
        self.variance_error2 += other.variance_error2;
        self.time += other.time;
    }
}

impl Noise {
    /// Of the samples of one pixel, and their mean.
    fn of(values: &[Vec3], time: Duration) -> (Self, DVec3) {
        let n = values.len() as f64;
        let mean = values.iter().map(|value| value.as_dvec3()).sum::<DVec3>() / n;
        let squares = || values.iter().map(|value| (value.as_dvec3() - mean).length_squared() / 3.0);
        let variance = squares().sum::<f64>() / (n - 1.0);
        let spread = squares().map(|square| (square - variance) * (square - variance)).sum::<f64>();
        let noise = Self {
            pixels: 1.0,
            mean: mean.element_sum() / 3.0,
            variance,
            mean_error2: variance / n,
            variance_error2: spread / (n * (n - 1.0)),
            time,
        };
        (noise, mean)
    }

    /// The ratio of the variances and its standard error.
    fn over(&self, other: &Self) -> (f64, f64) {
        let ratio = self.variance / other.variance;
        let relative = |noise: &Self| noise.variance_error2.sqrt() / noise.variance;
        (ratio, ratio * relative(self).hypot(relative(other)))
    }
}

/// The spheres of every γ and α, by every sampling.
pub(crate) struct Comparison {
    size: [u32; 2],
    /// Sums over the pixels of each sphere, by α and within it by γ.
    spheres: Vec<Each<Noise>>,
    /// The means of the samples, black beside the spheres.
    pixels: Vec<Each<Vec3>>,
}

impl Comparison {
    /// Draws `samples`, at least 2, for each pixel, sampling and estimator.
    pub(crate) fn new(
        environment: &Environment,
        size: [u32; 2],
        samples: u32,
        progress: &ProgressBar,
        verdict: &mut Verdict,
    ) -> Result<Self, Error> {
        let places = ALPHAS.iter().flat_map(|&alpha| GAMMAS.map(|gamma| (alpha, gamma)));
        let materials: Vec<_> =
            places.map(|(alpha, gamma)| sampled(alpha, gamma)).collect::<Result<_, _>>()?;
        let (shapes, camera) = spheres([ALPHAS.len(), GAMMAS.len()]);
        let seen = materials.iter().map(|[visible, ..]| &**visible).collect();
        let scene = Scene::new(camera, environment, shapes, seen);

        let [width, height] = size.map(|pixels| pixels as f32);
        let (rows, faults) = each_row(size[1], progress, |y, faults| {
            let mut noise = vec![Each::<Noise>::default(); SPHERES];
            let mut pixels = vec![Each::<Vec3>::default(); size[0] as usize];
            for (x, pixel) in pixels.iter_mut().enumerate() {
                let place = Vec2::new(x as f32 + 0.5 - 0.5 * width, y as f32 + 0.5 - 0.5 * height) / height;
                let ray = scene.camera.ray(place);
                let Some(vertex) = scene.hit(&ray) else { continue };
                let Some(sphere) = vertex.index else { continue };
                let wo = vertex.frame.to_local(-ray.direction);
                for (way, sum) in noise[sphere].iter_mut().flatten().enumerate() {
                    let (estimator, sampling) = (way / SAMPLINGS.len(), way % SAMPLINGS.len());
                    let material = &*materials[sphere][sampling];
                    let seed = (u64::from(y) << 16 | x as u64) << 3 | way as u64;
                    let mut rng = Pcg32::seed_from_u64(seed);
                    let start = Instant::now();
                    let values: Vec<Vec3> = (0..samples)
                        .map(|_| reflected(&scene, &vertex, material, wo, estimator == 1, &mut rng, faults))
                        .collect();
                    let (of_pixel, mean) = Noise::of(&values, start.elapsed());
                    *sum += of_pixel;
                    pixel[estimator][sampling] = mean.as_vec3();
                }
            }
            (noise, pixels)
        });
        verdict.faults += faults;
        let mut comparison = Self { size, spheres: vec![Each::default(); SPHERES], pixels: Vec::new() };
        for (noise, pixels) in rows {
            for (sums, row) in comparison.spheres.iter_mut().zip(noise) {
                add(sums, &row);
            }
            comparison.pixels.extend(pixels);
        }
        Ok(comparison)
    }

    /// The pictures and their names.
    pub(crate) fn images(&self) -> impl Iterator<Item = (String, Image)> + '_ {
        let [width, height] = self.size;
        (0..ESTIMATORS.len()).flat_map(move |estimator| {
            SAMPLINGS.iter().enumerate().map(move |(sampling, name)| {
                let light = ["", "-and-light"][estimator];
                let pixels = self.pixels.iter().map(|pixel| pixel[estimator][sampling]).collect();
                (format!("sampling-{name}{light}"), Image { width, height, pixels })
            })
        })
    }

    /// Prints a table for each estimator, and checks that the samplings agree.
    pub(crate) fn print(&self, verdict: &mut Verdict) {
        println!(
            "
Variance of one sample, mean over the pixels of a sphere and the channels, by visible normals, all normals, and the
mixture of all normals and uniform directions; a ratio is that of the samples needed for the same error, with the
standard error of its last digits in brackets."
        );
        let mut total = Each::<Noise>::default();
        for sphere in &self.spheres {
            add(&mut total, sphere);
        }
        for (estimator, name) in ESTIMATORS.iter().enumerate() {
            println!("\n{name}\n");
            println!(
                "| gamma | alpha | visible | all | mixture | all/visible | mixture/visible | mixture/all |"
            );
            println!("|---|---|---|---|---|---|---|---|");
            let mut logs = [[0.0; 3]; ALPHAS.len()];
            for (g, gamma) in GAMMAS.iter().enumerate() {
                for (a, alpha) in ALPHAS.iter().enumerate() {
                    let noise = &self.spheres[a * GAMMAS.len() + g][estimator];
                    print_row(&format!("{gamma} | {alpha}"), noise);
                    for (log, (ratio, _)) in logs[a].iter_mut().zip(ratios(noise)) {
                        *log += ratio.ln() / GAMMAS.len() as f64;
                    }
                }
            }
            for (alpha, logs) in ALPHAS.iter().zip(logs) {
                let [a, b, c] = logs.map(f64::exp);
                println!("| geometric mean | {alpha} | | | | {a:.2} | {b:.2} | {c:.2} |");
            }
            print_row("all pixels |", &total[estimator]);
            let [a, b, c] = total[estimator]
                .map(|noise| noise.time.as_secs_f64() / total[estimator][0].time.as_secs_f64());
            println!("\nTime of a sample, relative: visible {a:.2}, all {b:.2}, mixture {c:.2}");
        }
        let deviation = self.spheres.iter().map(deviation).fold(0.0, largest);
        println!(
            "\nMean radiances of the spheres differ between samplings by at most {deviation:.1} standard errors"
        );
        if deviation.is_nan() || deviation > LARGEST_DEVIATION {
            verdict.failures.push(format!("samplings differ by {deviation:.1} sigma"));
        }
    }
}

/// GTR by each of the samplings.
fn sampled(alpha: f32, gamma: f32) -> Result<[Box<dyn Material>; SAMPLINGS.len()], Error> {
    let visible = RoughConductor::new(Gtr::isotropic(alpha, gamma)?, ALUMINIUM.fresnel()?);
    let mixture = UniformMixture::for_alpha(AllNormals, alpha)?;
    Ok([Box::new(visible), Box::new(visible.sampled_by(AllNormals)), Box::new(visible.sampled_by(mixture))])
}

/// The light that the vertex reflects of the environment, estimated by one sample of the material
/// and, with `light`, one of the environment.
fn reflected(
    scene: &Scene,
    vertex: &Vertex,
    material: &dyn Material,
    wo: Vec3,
    light: bool,
    rng: &mut Pcg32,
    faults: &mut Faults,
) -> Vec3 {
    let mut random = || Vec2::new(rng.random(), rng.random());
    let by_light =
        if light { by_environment(scene, vertex, material, wo, random(), faults) } else { Vec3::ZERO };
    let Some(sample) = material.sample(wo, random()) else { return by_light };
    faults.check(&sample.weight.to_array());
    faults.check(&[sample.pdf]);
    let direction = vertex.frame.to_world(sample.wi).normalize();
    if scene.occludes(&vertex.leave(direction)) {
        return by_light;
    }
    let share = if light { power_heuristic(sample.pdf, scene.environment.pdf(direction)) } else { 1.0 };
    by_light + sample.weight * scene.environment.radiance(direction) * share
}

fn add(sums: &mut Each<Noise>, noise: &Each<Noise>) {
    for (sum, &noise) in sums.iter_mut().flatten().zip(noise.iter().flatten()) {
        *sum += noise;
    }
}

/// All normals and the mixture over visible normals, the mixture over all normals.
fn ratios([visible, all, mixture]: &[Noise; 3]) -> [(f64, f64); 3] {
    [all.over(visible), mixture.over(visible), mixture.over(all)]
}

fn print_row(place: &str, noise: &[Noise; 3]) {
    let [visible, all, mixture] = noise.map(|noise| format!("{:.4}", noise.variance / noise.pixels));
    let [a, b, c] = ratios(noise).map(|(ratio, error)| format!("{ratio:.2}({:.0})", error * 100.0));
    println!("| {place} | {visible} | {all} | {mixture} | {a} | {b} | {c} |");
}

/// The largest difference of the means from that of visible normals and light, in standard errors.
fn deviation(sphere: &Each<Noise>) -> f64 {
    let best = sphere[1][0];
    let against = |noise: &Noise| {
        let difference = (noise.mean - best.mean).abs();
        // No light and no difference is agreement.
        if difference > 0.0 { difference / (noise.mean_error2 + best.mean_error2).sqrt() } else { 0.0 }
    };
    sphere.iter().flatten().map(against).fold(0.0, largest)
}
