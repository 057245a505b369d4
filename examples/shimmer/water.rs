//! A tile of wavy water: flat, with the normals of waves, seen at a grazing angle.
//!
//! Beyond the lamp, which hangs low over it, eye and lamp are on the same side: half vectors are
//! far from the normal there, and nothing shines.

use microsurface::glam::{DMat3, DVec2, DVec3, Vec3};

use crate::scene::{Camera, Hit, Ray, Scene, Shape};
use crate::waves::Waves;

/// Half the width of the tile.
const HALF_WIDTH: f64 = 6.0;
/// The waves are between 0.4 and 2 units long.
const WAVES: usize = 16;

struct Water(Waves<WAVES>);

impl Shape for Water {
    fn hit(&self, ray: &Ray) -> Option<Hit> {
        let t = -ray.origin.z / ray.direction.z;
        let position = (ray.origin + ray.direction * t).with_z(0.0);
        if !(t > 0.0 && position.abs().max_element() <= HALF_WIDTH) {
            return None;
        }
        // The level of z − h(x, y).
        let (_, slope) = self.0.value_and_gradient(position);
        Some(Hit { position, geometric_normal: DVec3::Z, gradient: DVec3::Z - slope })
    }

    fn hessian(&self, position: DVec3) -> DMat3 {
        -self.0.hessian(position)
    }
}

pub(crate) fn scene() -> Scene {
    let wave_vector = |i: f64| {
        let along = DVec2::from_angle(2.399_963_229_728_653 * i);
        let length = 0.4 + 1.6 * i / (WAVES - 1) as f64;
        (along * (core::f64::consts::TAU / length)).extend(0.0)
    };
    Scene {
        name: "water",
        shape: Box::new(Water(Waves::of_steepness(0.08, wave_vector))),
        camera: Camera {
            eye: DVec3::new(0.0, -9.0, 2.8),
            target: DVec3::new(0.0, -1.0, 0.0),
            view: 0.55,
            step: DVec3::new(0.011, 0.004, 0.002),
        },
        light: DVec3::new(0.5, 2.5, 2.0),
        intensity: 3.0,
        albedo: 0.05,
        ambient: 0.2,
        tangent: DVec3::X,
        tint: Vec3::new(0.35, 0.9, 1.6),
        crops: [[0.35, 0.45], [0.5, 0.2]],
    }
}
