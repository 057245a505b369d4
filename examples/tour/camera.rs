//! A pinhole camera.

use microsurface::glam::{Vec2, Vec3};

/// A half line; the direction is a unit vector.
#[derive(Clone, Copy)]
pub(crate) struct Ray {
    pub(crate) origin: Vec3,
    pub(crate) direction: Vec3,
}

pub(crate) struct Camera {
    position: Vec3,
    /// Across the picture and down it, for one unit of picture height, and to its centre.
    right: Vec3,
    down: Vec3,
    forward: Vec3,
}

impl Camera {
    /// A camera that sees `view_height` world units at the target, from `elevation` radians above
    /// the horizon.
    pub(crate) fn new(target: Vec3, distance: f32, elevation: f32, view_height: f32) -> Self {
        let back = Vec3::new(0.0, elevation.sin(), elevation.cos());
        let right = Vec3::X * (view_height / distance);
        let down = back.cross(Vec3::X) * (-view_height / distance);
        Self { position: target + back * distance, right, down, forward: -back }
    }

    /// The ray through a place of the picture, measured in picture heights from its centre.
    pub(crate) fn ray(&self, place: Vec2) -> Ray {
        let direction = self.forward + self.right * place.x + self.down * place.y;
        Ray { origin: self.position, direction: direction.normalize() }
    }
}
