//! A sphere displaced by waves.

use microsurface::glam::{DMat3, DVec2, DVec3, Vec3};

use crate::scene::{Camera, Hit, Ray, Scene, Shape};
use crate::waves::Waves;

const WAVES: usize = 10;

/// The level 0 of |p| − 1 − waves(p).
struct Pebble {
    waves: Waves<WAVES>,
    /// Of the sphere that holds it.
    radius: f64,
    /// Along a ray the second derivative is no less than minus this: |p| is convex.
    curvature: f64,
}

impl Pebble {
    fn new(waves: Waves<WAVES>) -> Self {
        let [height, curvature] = waves.bounds();
        Self { waves, radius: 1.0 + height, curvature }
    }
}

impl Shape for Pebble {
    fn hit(&self, ray: &Ray) -> Option<Hit> {
        // Between entry and exit of the sphere around it.
        let middle = -ray.origin.dot(ray.direction);
        let half2 = middle * middle - ray.origin.length_squared() + self.radius * self.radius;
        if half2 <= 0.0 {
            return None;
        }
        let half = half2.sqrt();
        let mut t = middle - half;
        loop {
            let p = ray.origin + ray.direction * t;
            let (wave, slope) = self.waves.value_and_gradient(p);
            let height = p.length() - 1.0 - wave;
            if height < 1e-9 {
                let gradient = p.normalize() - slope;
                return Some(Hit { position: p, geometric_normal: gradient.normalize(), gradient });
            }
            // Up to where the parabola of the least second derivative is 0: never past the surface,
            // and as fast as Newton's method near it.
            let descent = slope.dot(ray.direction) - p.dot(ray.direction) / p.length();
            let root = (descent * descent + 2.0 * self.curvature * height).sqrt();
            t += if descent > 0.0 {
                2.0 * height / (descent + root)
            } else {
                (root - descent) / self.curvature
            };
            if t > middle + half {
                return None;
            }
        }
    }

    fn hessian(&self, p: DVec3) -> DMat3 {
        let inv_length = p.length().recip();
        let n = p * inv_length;
        let sphere = (DMat3::IDENTITY - DMat3::from_cols(n * n.x, n * n.y, n * n.z)) * inv_length;
        sphere - self.waves.hessian(p)
    }
}

pub(crate) fn scene() -> Scene {
    let wave_vector = |i: f64| {
        // Directions spread evenly over the sphere, by the golden angle.
        let z = 1.0 - (2.0 * i + 1.0) / WAVES as f64;
        let along = DVec2::from_angle(2.399_963_229_728_653 * i) * (1.0 - z * z).sqrt();
        along.extend(z) * (10.0 + 3.0 * i)
    };
    Scene {
        name: "pebble",
        shape: Box::new(Pebble::new(Waves::of_steepness(0.16, wave_vector))),
        camera: Camera {
            eye: DVec3::new(0.0, -6.0, 0.8),
            target: DVec3::ZERO,
            view: 0.42,
            step: DVec3::new(0.0021, 0.0, 0.0012),
        },
        light: DVec3::new(2.5, -3.0, 3.5),
        intensity: 8.0,
        albedo: 0.05,
        ambient: 0.2,
        tangent: DVec3::new(0.36, 0.48, 0.8),
        tint: Vec3::new(1.5, 0.9, 0.4),
        crops: [[0.45, 0.25], [0.56, 0.3]],
    }
}
