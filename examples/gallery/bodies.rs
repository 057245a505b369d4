//! Figure 6: elastic bodies, whose microsurface is deformed with them.

use core::f64::consts::PI;

use microsurface::fresnel::Dielectric;
use microsurface::glam::{DVec2, DVec3, Mat2, Vec2, Vec3};
use microsurface::transform::tension::{self, Mean, interpolated};
use microsurface::{Error, Gtr};

use crate::camera::Camera;
use crate::environment::{Environment, Softbox};
use crate::mesh::{Mesh, longitude};
use crate::rubber::Rubber;
use crate::scene::{Cover, Object, Place, Scene, floor};
use crate::sheet::{Effort, Sheet};

pub(crate) const LOOK_FOR: &str = "\
  Figure 6: elastic dielectric bodies at rest, drawn out, inflated, squeezed from the sides and bent.
  Rows 1 and 2: GTR, alpha = 0.25, gamma = 2.2; rows 3 and 4: alpha = 0.16, gamma = 1.4.
  Rows 1 and 3: the isotropic material at rest on all of them. Rows 2 and 4: the same moved by the tension of the mesh.
  Of each pair the first body is the same in both; the inflated one is glossier below, like a balloon; the highlight
  is sharper along the direction a body was stretched in, broader along the one it was compressed in.";

const SIZE: [u32; 2] = [880, 210];

/// A bird, about 1.6 in length, that looks along x.
fn bird(uv: DVec2) -> DVec3 {
    let (sin, cos) = (PI * uv.y).sin_cos();
    let direction = longitude(uv.x) * sin + DVec3::NEG_Y * cos;
    let bump = |towards: DVec3, height: f64, sharpness: f64| {
        height * (sharpness * (direction.dot(towards.normalize()) - 1.0)).exp()
    };
    let radius = 0.62
        + bump(DVec3::new(0.75, 0.75, 0.0), 0.42, 7.0)
        + bump(DVec3::new(1.0, 0.62, 0.0), 0.16, 160.0)
        + bump(DVec3::new(-1.0, 0.25, 0.0), 0.55, 9.0);
    direction * radius * DVec3::new(0.78, 0.72, 0.68)
}

/// A gourd, 1.4 in height.
fn gourd(uv: DVec2) -> DVec3 {
    let (sin, cos) = (PI * uv.y).sin_cos();
    let waist = 1.0 + 0.22 * (2.6 * cos + 0.5).sin();
    longitude(uv.x) * (0.5 * sin * waist) + DVec3::NEG_Y * (0.7 * cos)
}

fn rest(p: DVec3) -> DVec3 {
    p
}

fn drawn_out(p: DVec3) -> DVec3 {
    p * DVec3::new(0.78, 1.65, 0.78)
}

fn inflated(p: DVec3) -> DVec3 {
    p * 1.45
}

fn squeezed(p: DVec3) -> DVec3 {
    p * DVec3::new(0.5, 1.3, 1.3)
}

/// Bent about the z axis so that a line along y becomes an arc of radius 1/K.
fn bent(p: DVec3) -> DVec3 {
    const K: f64 = 0.95;
    let (sin, cos) = (K * p.y).sin_cos();
    let radius = 1.0 / K + p.x;
    DVec3::new(radius * cos - 1.0 / K, radius * sin, p.z)
}

type Deformation = fn(DVec3) -> DVec3;
const POSES: [Deformation; 5] = [rest, drawn_out, inflated, squeezed, bent];

type Shape = fn(DVec2) -> DVec3;

struct Row {
    shape: Shape,
    alpha: f32,
    gamma: f32,
    dye: Vec3,
    tracked: bool,
}

/// The material at rest, everywhere.
fn isotropic(row: &Row) -> Result<Cover, Error> {
    let (surface, dye) = (Gtr::isotropic(row.alpha, row.gamma)?, row.dye);
    let fresnel = Dielectric::new(Vec3::splat(1.5))?;
    Ok(Box::new(move |_| Box::new(Rubber::new(surface, fresnel, dye))))
}

/// The material that the deformation makes of it: moved by the mean tension of the vertices.
fn tracked(row: &Row, rest: &Mesh, deformed: &Mesh) -> Result<Cover, Error> {
    let mut means = vec![Mean::default(); rest.positions.len()];
    tension::Mesh::<f32> {
        rest: &rest.positions,
        deformed: &deformed.positions,
        uv: &rest.uv,
        triangles: &rest.triangles,
    }
    .add_tension_of_vertices(&mut means)?;
    let tensions: Vec<Mat2> = means.iter().map(Mean::matrix).collect();
    let (surface, dye) = (Gtr::isotropic(row.alpha, row.gamma)?.transformed(Mat2::IDENTITY)?, row.dye);
    let fresnel = Dielectric::new(Vec3::splat(1.5))?;
    Ok(Box::new(move |place: &Place| {
        let tension = interpolated::<f32>(place.corners.map(|i| tensions[i]), place.barycentric);
        // Where a mean is singular, the material at rest.
        let surface = surface.transformed(tension).unwrap_or(surface);
        Box::new(Rubber::new(surface, fresnel, dye))
    }))
}

pub(crate) fn figure(effort: Effort) -> Result<Sheet, Error> {
    let lamp = Softbox::new(Vec3::new(-0.45, 0.8, 0.9), Vec2::splat(0.13), Vec3::new(62.0, 59.0, 54.0));
    let environment = Environment::new([Vec3::splat(0.07), Vec3::splat(0.03)], vec![lamp]);
    let (red, blue) = (Vec3::new(0.13, 0.008, 0.006), Vec3::new(0.006, 0.03, 0.10));
    let birds = |tracked| Row { shape: bird, alpha: 0.25, gamma: 2.2, dye: red, tracked };
    let gourds = |tracked| Row { shape: gourd, alpha: 0.16, gamma: 1.4, dye: blue, tracked };
    let mut sheet = Sheet::new(1);
    for row in [birds(false), birds(true), gourds(false), gourds(true)] {
        let mut objects = vec![floor(Vec3::splat(0.08))];
        let at_rest = Mesh::of(row.shape, [112, 56]);
        for (i, pose) in POSES.into_iter().enumerate() {
            let mesh = Mesh::of(|uv| pose((row.shape)(uv)), [112, 56]);
            let cover = if row.tracked { tracked(&row, &at_rest, &mesh)? } else { isotropic(&row)? };
            objects.push(Object { mesh: mesh.standing_at(2.05 * (i as f32 - 2.0), 0.0), cover });
        }
        let camera = Camera::new(Vec3::Y * 1.0, 14.0, 0.3, 2.6);
        sheet.render(&Scene::new(camera, &environment, objects), SIZE, effort);
    }
    Ok(sheet)
}
