//! The scene that is rendered: meshes, each with a cover that says of what material it is from
//! place to place.

use microsurface::frame::Frame;
use microsurface::glam::{Vec2, Vec3};

use crate::bvh::Bvh;
use crate::camera::{Camera, Ray};
use crate::environment::Environment;
use crate::material::{Diffuse, Material};
use crate::mesh::Mesh;
use crate::shape::{Hit, Shape};

/// Nothing is nearer than this to a ray's origin: objects are about 1 in size.
const NEAREST: f32 = 1e-4;

/// A place on a mesh.
pub(crate) struct Place {
    /// The vertices of the triangle.
    pub(crate) corners: [usize; 3],
    pub(crate) barycentric: [f32; 3],
    pub(crate) uv: Vec2,
}

/// The material at a place, in the frame whose x axis is the direction of ∂p/∂u.
pub(crate) type Cover = Box<dyn Fn(&Place) -> Box<dyn Material> + Sync>;

pub(crate) struct Object {
    pub(crate) mesh: Mesh,
    pub(crate) cover: Cover,
}

pub(crate) struct Scene<'a> {
    pub(crate) camera: Camera,
    pub(crate) environment: &'a Environment,
    /// Each with its triangles, whose materials are their own numbers.
    objects: Vec<(Object, Bvh)>,
}

/// Where a path is: the local frame, the material, and where to leave from.
pub(crate) struct Vertex {
    pub(crate) frame: Frame<f32>,
    material: Box<dyn Material>,
    position: Vec3,
    normal: Vec3,
}

impl Vertex {
    pub(crate) fn material(&self) -> &dyn Material {
        &*self.material
    }

    /// The ray from here, started a little off the surface on the side it goes to.
    pub(crate) fn leave(&self, direction: Vec3) -> Ray {
        let side = NEAREST.copysign(self.normal.dot(direction));
        Ray { origin: self.position + self.normal * side, direction }
    }
}

impl<'a> Scene<'a> {
    pub(crate) fn new(camera: Camera, environment: &'a Environment, objects: Vec<Object>) -> Self {
        let with_triangles = |object: Object| {
            let mesh = &object.mesh;
            let triangle = |(material, corners): (usize, &[usize; 3])| Shape::Triangle {
                corners: corners.map(|i| mesh.positions[i]),
                normals: corners.map(|i| mesh.normals[i]),
                material,
            };
            let shapes = mesh.triangles.iter().enumerate().map(triangle).collect();
            (object, Bvh::new(shapes))
        };
        Self { camera, environment, objects: objects.into_iter().map(with_triangles).collect() }
    }

    /// What the ray meets first.
    pub(crate) fn hit(&self, ray: &Ray) -> Option<Vertex> {
        self.objects
            .iter()
            .filter_map(|(object, shapes)| Some((object, shapes.hit(ray, NEAREST)?)))
            .min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance))
            .map(|(object, hit)| vertex(object, &hit))
    }

    /// Does the ray not reach the environment?
    pub(crate) fn occludes(&self, ray: &Ray) -> bool {
        self.objects.iter().any(|(_, shapes)| shapes.occludes(ray, NEAREST))
    }
}

fn vertex(Object { mesh, cover }: &Object, hit: &Hit) -> Vertex {
    let corners = mesh.triangles[hit.material];
    let barycentric = barycentric(corners.map(|i| mesh.positions[i]), hit.position);
    let tangent: Vec3 = (0..3).map(|i| mesh.tangents[corners[i]] * barycentric[i]).sum();
    let uv = (0..3).map(|i| mesh.uv[corners[i]] * barycentric[i]).sum();
    Vertex {
        frame: Frame::from_normal_and_tangent(hit.shading_normal, tangent),
        material: cover(&Place { corners, barycentric, uv }),
        position: hit.position,
        normal: hit.normal,
    }
}

/// The shares of the corners in a point of a triangle: areas over the whole area.
fn barycentric([a, b, c]: [Vec3; 3], p: Vec3) -> [f32; 3] {
    let normal = (b - a).cross(c - a);
    let share = |from: Vec3, to: Vec3| (to - from).cross(p - from).dot(normal) / normal.length_squared();
    [share(b, c), share(c, a), share(a, b)]
}

/// A grey floor at height 0.
pub(crate) fn floor(albedo: Vec3) -> Object {
    let mesh = Mesh::plane([Vec3::new(-60.0, 0.0, 60.0), Vec3::X * 120.0, Vec3::NEG_Z * 120.0]);
    Object { mesh, cover: Box::new(move |_| Box::new(Diffuse { albedo })) }
}
