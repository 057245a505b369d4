//! The scene that is rendered: shapes on a floor, in an environment.

use microsurface::frame::Frame;
use microsurface::glam::Vec3;

use crate::bvh::Bvh;
use crate::camera::{Camera, Ray};
use crate::environment::Environment;
use crate::material::{Diffuse, Material};
use crate::shape::{Hit, Shape};

/// Nothing is nearer than this to a ray's origin: spheres have radius 0.45.
const NEAREST: f32 = 1e-4;

pub(crate) struct Scene<'a> {
    pub(crate) camera: Camera,
    pub(crate) environment: &'a Environment,
    shapes: Bvh,
    materials: Vec<&'a dyn Material>,
    floor: Floor,
}

/// Where a path is: the local frame, the material, and where to leave from.
pub(crate) struct Vertex<'a> {
    pub(crate) frame: Frame<f32>,
    pub(crate) material: &'a dyn Material,
    /// Which of the scene's materials; the floor's is none.
    pub(crate) index: Option<usize>,
    position: Vec3,
    normal: Vec3,
}

impl Vertex<'_> {
    pub(crate) fn material(&self) -> &dyn Material {
        self.material
    }

    /// The ray from here, started a little off the surface on the side it goes to.
    pub(crate) fn leave(&self, direction: Vec3) -> Ray {
        let side = NEAREST.copysign(self.normal.dot(direction));
        Ray { origin: self.position + self.normal * side, direction }
    }
}

/// Two greys in a chequered pattern that fades in the distance.
struct Floor {
    tones: Vec<Diffuse>,
}

impl Floor {
    const SQUARE: f32 = 0.5;
    const TONES: usize = 16;

    fn new() -> Self {
        let (dark, light) = (Vec3::new(0.05, 0.052, 0.056), Vec3::new(0.17, 0.165, 0.16));
        let tone = |i: usize| Diffuse { albedo: dark.lerp(light, i as f32 / (Self::TONES - 1) as f32) };
        Self { tones: (0..Self::TONES).map(tone).collect() }
    }

    fn material(&self, at: Vec3) -> &Diffuse {
        let square = (at / Self::SQUARE).floor();
        let light = (square.x + square.z).rem_euclid(2.0) > 0.5;
        let distance = at.length();
        let contrast = (1.0 - distance / 24.0).clamp(0.0, 1.0);
        let tone = 0.5 + if light { 0.5 } else { -0.5 } * contrast;
        &self.tones[(tone * (Self::TONES - 1) as f32).round() as usize]
    }
}

impl<'a> Scene<'a> {
    pub(crate) fn new(
        camera: Camera,
        environment: &'a Environment,
        shapes: Vec<Shape>,
        materials: Vec<&'a dyn Material>,
    ) -> Self {
        Self { camera, environment, shapes: Bvh::new(shapes), materials, floor: Floor::new() }
    }

    /// What the ray meets first.
    pub(crate) fn hit(&self, ray: &Ray) -> Option<Vertex<'_>> {
        let to_floor = -ray.origin.y / ray.direction.y;
        let floor = (to_floor > NEAREST && to_floor.is_finite()).then_some(to_floor);
        match (self.shapes.hit(ray, NEAREST), floor) {
            (Some(hit), None) => Some(self.on_shape(&hit)),
            (Some(hit), Some(floor)) if hit.distance < floor => Some(self.on_shape(&hit)),
            (_, Some(floor)) => Some(self.on_floor(ray.origin + ray.direction * floor)),
            (None, None) => None,
        }
    }

    /// Does the ray not reach the environment?
    pub(crate) fn occludes(&self, ray: &Ray) -> bool {
        ray.direction.y <= 0.0 || self.shapes.occludes(ray, NEAREST)
    }

    /// x runs around the vertical axis, as the grooves of an object turned on a lathe do.
    fn on_shape(&self, hit: &Hit) -> Vertex<'_> {
        Vertex {
            frame: Frame::from_normal_and_tangent(hit.shading_normal, Vec3::Y.cross(hit.shading_normal)),
            material: self.materials[hit.material],
            index: Some(hit.material),
            position: hit.position,
            normal: hit.normal,
        }
    }

    fn on_floor(&self, position: Vec3) -> Vertex<'_> {
        let position = Vec3::new(position.x, 0.0, position.z);
        Vertex {
            frame: Frame::from_normal_and_tangent(Vec3::Y, Vec3::X),
            material: self.floor.material(position),
            index: None,
            position,
            normal: Vec3::Y,
        }
    }
}

/// Spheres in rows on the floor, the material of each its number from the back left, and a camera
/// that sees them all.
pub(crate) fn spheres([rows, columns]: [usize; 2]) -> (Vec<Shape>, Camera) {
    const RADIUS: f32 = 0.45;
    const ROW_DISTANCE: f32 = 1.45;
    const ELEVATION: f32 = 0.72;
    let centred = |i: usize, count: usize| i as f32 - 0.5 * (count as f32 - 1.0);
    let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let shapes = places.enumerate().map(|(material, (row, column))| {
        let centre = Vec3::new(centred(column, columns), RADIUS, ROW_DISTANCE * centred(row, rows));
        Shape::Sphere { centre, radius: RADIUS, material }
    });
    // Room for the columns across and for the rows, seen from above, down the picture.
    let across = (columns as f32 + 0.5) * 9.0 / 16.0;
    let down = (rows as f32 - 1.0) * ROW_DISTANCE * ELEVATION.sin() + 2.0 * RADIUS + 0.5;
    let camera = Camera::new(Vec3::Y * (0.8 * RADIUS), 30.0, ELEVATION, across.max(down));
    (shapes.collect(), camera)
}
