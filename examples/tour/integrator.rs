//! Paths: the environment and the material are both sampled at every vertex, and weighed by their
//! densities.

use core::ops::AddAssign;

use microsurface::glam::{Vec2, Vec3};

use crate::camera::Ray;
use crate::material::Material;
use crate::sampler::Sampler;
use crate::scene::{Scene, Vertex};

/// Reflections along a path, at most.
const BOUNCES: usize = 4;

/// Numbers that no material should return, and how many were looked at.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub(crate) struct Faults {
    pub(crate) checked: u64,
    pub(crate) nan: u64,
    pub(crate) infinite: u64,
    pub(crate) negative: u64,
}

impl Faults {
    /// Looks at values that have to be finite and at least 0.
    pub(crate) fn check(&mut self, values: &[f32]) {
        self.checked += values.len() as u64;
        if values.iter().all(|&value| (0.0..f32::INFINITY).contains(&value)) {
            return;
        }
        for &value in values {
            self.nan += u64::from(value.is_nan());
            self.infinite += u64::from(value.is_infinite());
            self.negative += u64::from(value < 0.0);
        }
    }

    /// Nothing was found.
    pub(crate) fn none(&self) -> bool {
        self.nan + self.infinite + self.negative == 0
    }
}

impl AddAssign for Faults {
    fn add_assign(&mut self, other: Self) {
        self.checked += other.checked;
        self.nan += other.nan;
        self.infinite += other.infinite;
        self.negative += other.negative;
    }
}

/// The radiance that arrives along the ray, estimated with one path; for `tolerance` see
/// [`limited`].
pub(crate) fn radiance(
    scene: &Scene,
    mut ray: Ray,
    tolerance: f32,
    sampler: &mut Sampler,
    faults: &mut Faults,
) -> Vec3 {
    let mut sum = Vec3::ZERO;
    let mut throughput = Vec3::ONE;
    // The density with which the material chose the ray; none chose the camera's.
    let mut density: Option<f32> = None;
    let mut limit = f32::INFINITY;
    for bounce in 0..=BOUNCES {
        let Some(vertex) = scene.hit(&ray) else {
            // The environment's sampler might have come here too.
            let weight = density.map_or(1.0, |p| power_heuristic(p, scene.environment.pdf(ray.direction)));
            sum += limited(throughput * scene.environment.radiance(ray.direction) * weight, limit);
            break;
        };
        if let Some(p) = density {
            limit = limit.min(tolerance * (0.1 + 0.2 * p));
        }
        if bounce == BOUNCES {
            break;
        }
        let wo = vertex.frame.to_local(-ray.direction);
        let (light_u, material_u) = (sampler.next(), sampler.next());

        let light = by_environment(scene, &vertex, vertex.material(), wo, light_u, faults);
        sum += limited(throughput * light, limit);

        // Along a direction of the material's own choice; the weight is f cos/pdf.
        let Some(sample) = vertex.material().sample(wo, material_u) else { break };
        faults.check(&sample.weight.to_array());
        faults.check(&[sample.pdf]);
        throughput *= sample.weight;
        density = Some(sample.pdf);
        ray = vertex.leave(vertex.frame.to_world(sample.wi).normalize());

        // Russian roulette: of paths that carry little some end, and the others carry more.
        let survival = (2.0 * throughput.max_element()).min(1.0);
        if survival < 1.0 && sampler.next().x >= survival {
            break;
        }
        throughput /= survival;
    }
    sum
}

/// The light that the vertex reflects towards `wo` of the light from a direction that the
/// environment samples, weighed against the directions that the material samples.
pub(crate) fn by_environment(
    scene: &Scene,
    vertex: &Vertex,
    material: &dyn Material,
    wo: Vec3,
    u: Vec2,
    faults: &mut Faults,
) -> Vec3 {
    let (direction, radiance, density) = scene.environment.sample(u);
    let wi = vertex.frame.to_local(direction);
    // Without the cosine.
    let f = material.eval(wi, wo);
    faults.check(&f.to_array());
    if f.max_element() <= 0.0 || density <= 0.0 || scene.occludes(&vertex.leave(direction)) {
        return Vec3::ZERO;
    }
    let p = material.pdf(wi, wo);
    faults.check(&[p]);
    f * radiance * (wi.z / density * power_heuristic(density, p))
}

/// The contribution of a path, made smaller where its largest channel exceeds the limit.
///
/// The light that a rough surface receives by way of a smooth one, a caustic, arrives along few
/// paths of great weight: bright dots at few samples. The limit grows with the least density along
/// the path, so that it darkens caustics and leaves mirror images as they are, and with the number
/// of samples, so that the bias vanishes in the end. The table has no such limit.
fn limited(contribution: Vec3, limit: f32) -> Vec3 {
    let largest = contribution.max_element();
    if largest > limit { contribution * (limit / largest) } else { contribution }
}

/// The weight of a direction drawn with density `p` that another sampler would have drawn with
/// density `q`.
///
/// Veach and Guibas 1995, "Optimally combining sampling techniques for Monte Carlo rendering",
/// §3.2.
pub(crate) fn power_heuristic(p: f32, q: f32) -> f32 {
    let ratio = q / p;
    1.0 / (1.0 + ratio * ratio)
}
