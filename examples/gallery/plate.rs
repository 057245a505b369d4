//! Figure 1: what maps of the microsurface do to the highlight on a rough silver plate.

use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Schlick;
use microsurface::glam::{Mat2, Vec2, Vec3};
use microsurface::transform::jacobian_of_uv_map;
use microsurface::{Error, Gtr};

use crate::camera::Camera;
use crate::environment::{Environment, Softbox};
use crate::inset;
use crate::mesh::Mesh;
use crate::scene::{Cover, Object, Place, Scene, floor};
use crate::sheet::{Effort, Sheet};

pub(crate) const LOOK_FOR: &str = "\
  Figure 1: a silver plate of GTR, gamma = 1.7, alpha = 0.0121, and a grid that moves with its microsurface.
  Top left: at rest; the highlight is as wide on the plate in all directions.
  Top right: stretched 5 times horizontally; smoother there, so that the highlight is narrow.
  Bottom left: sheared by [[1, 2], [0, 1]]; the highlight is long across the direction in
  which the facets were drawn out, up to the right.
  Bottom right: moved by (u, v + 2u^5), its Jacobian taken at every hit; the highlight is prolonged to the right, where
  the map compresses the surface.";

const ALPHA: f32 = 0.0121;
const GAMMA: f32 = 1.7;
/// Reflectance at normal incidence.
const SILVER: Vec3 = Vec3::new(0.971, 0.960, 0.914);
const SIZE: [u32; 2] = [450, 290];

/// (u, v) ↦ (u, v + 2u⁵).
fn curved(uv: Vec2) -> Vec2 {
    Vec2::new(uv.x, uv.y + 2.0 * uv.x.powi(5))
}

/// A map of texture coordinates, for the inset.
type UvMap = Box<dyn Fn(Vec2) -> Vec2>;

/// Reflectance of a place of the texture at rest: the lines of a 10×10 grid are darker.
fn silver(uv: Vec2) -> Schlick<Vec3> {
    const HALF_WIDTH: f32 = 0.025;
    let cells = uv * 10.0;
    let on_line = (cells - cells.round()).abs().min_element() < HALF_WIDTH;
    Schlick::new(SILVER * if on_line { 0.45 } else { 1.0 }).expect("a share")
}

/// The plate moved by a matrix about its centre.
fn moved(matrix: Mat2) -> Result<Cover, Error> {
    let surface = Gtr::isotropic(ALPHA, GAMMA)?.transformed(matrix)?;
    let back = matrix.inverse();
    Ok(Box::new(move |place: &Place| {
        let at_rest = back * (place.uv - 0.5) + 0.5;
        Box::new(RoughConductor::new(surface, silver(at_rest)))
    }))
}

/// The plate moved by [`curved`].
fn bent() -> Result<Cover, Error> {
    let surface = Gtr::isotropic(ALPHA, GAMMA)?;
    Ok(Box::new(move |place: &Place| {
        let Vec2 { x: u, y: v } = place.uv;
        let at_rest = Vec2::new(u, v - 2.0 * u.powi(5));
        let matrix = jacobian_of_uv_map::<f32>(curved, at_rest, 5e-3);
        // Of determinant 1, and 10 at most: a map of every surface.
        let surface = surface.transformed(matrix).expect("a shear is invertible");
        Box::new(RoughConductor::new(surface, silver(at_rest)))
    }))
}

pub(crate) fn figure(effort: Effort) -> Result<Sheet, Error> {
    const ELEVATION: f32 = 0.75;
    // A lamp that the plate reflects to the camera a little left of its centre, under a dim sky.
    let mirror = Vec3::new(-0.45 / 8.0, ELEVATION.sin(), -ELEVATION.cos());
    let lamp = Softbox::new(mirror, Vec2::splat(0.016), Vec3::new(38.0, 36.0, 32.0));
    let environment =
        Environment::new([Vec3::new(0.010, 0.011, 0.014), Vec3::new(0.008, 0.009, 0.012)], vec![lamp]);

    let stretch = Mat2::from_diagonal(Vec2::new(5.0, 1.0));
    let shear = Mat2::from_cols(Vec2::new(1.0, 0.0), Vec2::new(2.0, 1.0));
    let linear = |matrix: Mat2| move |uv: Vec2| matrix * uv;
    let panels: [(Cover, UvMap); 4] = [
        (moved(Mat2::IDENTITY)?, Box::new(linear(Mat2::IDENTITY))),
        (moved(stretch)?, Box::new(linear(stretch))),
        (moved(shear)?, Box::new(linear(shear))),
        (bent()?, Box::new(curved)),
    ];
    let mut sheet = Sheet::new(2);
    for (cover, map) in panels {
        let mesh = Mesh::plane([Vec3::new(-1.0, 0.02, 1.0), Vec3::X * 2.0, Vec3::NEG_Z * 2.0]);
        let objects = vec![floor(Vec3::splat(0.03)), Object { mesh, cover }];
        let camera = Camera::new(Vec3::X * 0.2, 8.0, ELEVATION, 1.85);
        sheet.render(&Scene::new(camera, &environment, objects), SIZE, effort.times(2));
        if let Some(image) = sheet.images.last_mut() {
            inset::draw(image, map);
        }
    }
    Ok(sheet)
}
