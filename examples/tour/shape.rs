//! Spheres and triangles.

use microsurface::glam::{Vec2, Vec3};

use crate::camera::Ray;

/// Where a ray meets a shape.
#[derive(Clone, Copy)]
pub(crate) struct Hit {
    pub(crate) distance: f32,
    pub(crate) position: Vec3,
    /// The unit normal of the surface itself.
    pub(crate) normal: Vec3,
    /// The unit normal to shade with: another one on a mesh of smoothed normals.
    pub(crate) shading_normal: Vec3,
    /// Which material.
    pub(crate) material: usize,
}

pub(crate) enum Shape {
    Sphere { centre: Vec3, radius: f32, material: usize },
    Triangle { corners: [Vec3; 3], normals: [Vec3; 3], material: usize },
}

impl Shape {
    /// The corners of the smallest box around the shape.
    pub(crate) fn bounds(&self) -> [Vec3; 2] {
        match self {
            Self::Sphere { centre, radius, .. } => {
                [centre - Vec3::splat(*radius), centre + Vec3::splat(*radius)]
            }
            Self::Triangle { corners: [a, b, c], .. } => [a.min(*b).min(*c), a.max(*b).max(*c)],
        }
    }

    /// The distance along the ray within (`nearest`, `furthest`), and on a triangle the barycentric
    /// coordinates.
    pub(crate) fn distance(&self, ray: &Ray, nearest: f32, furthest: f32) -> Option<(f32, Vec2)> {
        let (distance, place) = match self {
            Self::Sphere { centre, radius, .. } => (sphere(ray, *centre, *radius, nearest)?, Vec2::ZERO),
            Self::Triangle { corners, .. } => triangle(ray, corners)?,
        };
        (distance > nearest && distance < furthest).then_some((distance, place))
    }

    /// The surface at what `distance` found.
    pub(crate) fn hit(&self, ray: &Ray, distance: f32, place: Vec2) -> Hit {
        let along = ray.origin + ray.direction * distance;
        match self {
            Self::Sphere { centre, radius, material } => {
                let normal = (along - centre).normalize();
                // On the sphere again: the distance is long and its rounding with it.
                let position = centre + normal * *radius;
                Hit { distance, position, normal, shading_normal: normal, material: *material }
            }
            Self::Triangle { corners: [a, b, c], normals, material } => {
                let outwards = (b - a).cross(c - a).normalize();
                let normal = if outwards.dot(ray.direction) > 0.0 { -outwards } else { outwards };
                let [n0, n1, n2] = normals;
                let smooth =
                    (n0 * (1.0 - place.x - place.y) + n1 * place.x + n2 * place.y).normalize_or_zero();
                let smooth = if smooth.dot(normal) < 0.0 { -smooth } else { smooth };
                // A smoothed normal that looks away from the viewer would be black.
                let visible = smooth.dot(ray.direction) < -1e-3;
                let shading_normal = if visible { smooth } else { normal };
                let position = a * (1.0 - place.x - place.y) + b * place.x + c * place.y;
                Hit { distance, position, normal, shading_normal, material: *material }
            }
        }
    }
}

fn sphere(ray: &Ray, centre: Vec3, radius: f32, nearest: f32) -> Option<f32> {
    let to_centre = centre - ray.origin;
    let middle = to_centre.dot(ray.direction);
    // The distance of the ray from the centre, as a difference of vectors: squares would cancel.
    let across = to_centre - ray.direction * middle;
    let half_chord2 = radius * radius - across.length_squared();
    if half_chord2 < 0.0 {
        return None;
    }
    let half_chord = half_chord2.sqrt();
    let entry = middle - half_chord;
    Some(if entry > nearest { entry } else { middle + half_chord })
}

/// Möller and Trumbore 1997.
fn triangle(ray: &Ray, [a, b, c]: &[Vec3; 3]) -> Option<(f32, Vec2)> {
    let (edge1, edge2) = (b - a, c - a);
    let p = ray.direction.cross(edge2);
    let inverse = 1.0 / edge1.dot(p);
    let from_a = ray.origin - a;
    let u = from_a.dot(p) * inverse;
    let q = from_a.cross(edge1);
    let v = ray.direction.dot(q) * inverse;
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    inside.then(|| (edge2.dot(q) * inverse, Vec2::new(u, v)))
}
