//! Figure 8: vases of brushed aluminium.

use microsurface::bsdf::RoughConductor;
use microsurface::glam::{DVec2, DVec3, Vec3};
use microsurface::{Error, Gtr, SampleVndf};

use crate::camera::Camera;
use crate::environment::Environment;
use crate::mesh::{Mesh, longitude};
use crate::metals::ALUMINIUM;
use crate::scene::{Cover, Object, Scene, floor};
use crate::sheet::{Effort, Sheet};

pub(crate) const LOOK_FOR: &str = "\
  Figure 8: vases of brushed aluminium, GTR, stretched by 5/2 around the axis and 2/5 along it.
  Columns: alpha = 0.01, 0.04, 0.16. Rows: gamma = 1, the Berry distribution, and gamma = 3.5.
  Highlights are drawn out along the axis, across the brushing. A heavy tail, above, is a sharp core in a wide haze; a
  light one, below, has clear edges.";

const SIZE: [u32; 2] = [840, 370];

/// The paper's caption has s = 5/2, which Eq. 31 does not allow; with s = 3/5 the surface is drawn
/// out by 1/(1 − s) = 5/2 along x and compressed by 1 − s = 2/5 along y.
const STRETCH: f32 = 0.6;

/// Radius and height along the profile: up the outside, over the lip and down the inside.
const PROFILE: [[f64; 2]; 13] = [
    [0.0, 0.0],
    [0.30, 0.0],
    [0.36, 0.05],
    [0.52, 0.32],
    [0.60, 0.66],
    [0.50, 1.02],
    [0.28, 1.32],
    [0.22, 1.55],
    [0.30, 1.76],
    [0.36, 1.84],
    [0.33, 1.84],
    [0.24, 1.70],
    [0.17, 1.45],
];

/// A smooth curve through the points of the profile at t ∈ [0, 1] (Catmull and Rom 1974).
fn profile(t: f64) -> DVec2 {
    let last = PROFILE.len() - 1;
    let place = t.clamp(0.0, 1.0) * last as f64;
    let i = (place as usize).min(last - 1);
    let point = |i: usize| DVec2::from(PROFILE[i.min(last)]);
    let [a, b, c, d] = [point(i.saturating_sub(1)), point(i), point(i + 1), point(i + 2)];
    let x = place - i as f64;
    0.5 * (2.0 * b + x * ((c - a) + x * ((2.0 * a - 5.0 * b + 4.0 * c - d) + x * (3.0 * (b - c) + d - a))))
}

fn vase(uv: DVec2) -> DVec3 {
    let DVec2 { x: radius, y: height } = profile(uv.y);
    longitude(uv.x) * radius + DVec3::Y * height
}

/// Aluminium of this surface everywhere; the frame's x axis runs around the vase, as the brushing
/// does.
fn brushed<N>(surface: N) -> Result<Cover, Error>
where
    N: SampleVndf<Scalar = f32> + Copy + Sync + 'static,
{
    let material = RoughConductor::new(surface, ALUMINIUM.fresnel()?);
    Ok(Box::new(move |_| Box::new(material)))
}

pub(crate) fn figure(effort: Effort) -> Result<Sheet, Error> {
    let environment = Environment::studio();
    let berry = |alpha| brushed(Gtr::closed::<1>(alpha)?.stretched(STRETCH)?);
    let light = |alpha| brushed(Gtr::isotropic(alpha, 3.5)?.stretched(STRETCH)?);
    let alphas = [0.01, 0.04, 0.16];
    let mesh = Mesh::of(vase, [128, 104]);
    let mut sheet = Sheet::new(1);
    for covers in [alphas.map(berry), alphas.map(light)] {
        let mut objects = vec![floor(Vec3::splat(0.12))];
        for (i, cover) in covers.into_iter().enumerate() {
            let mesh = mesh.clone().standing_at(1.7 * (i as f32 - 1.0), 0.0);
            objects.push(Object { mesh, cover: cover? });
        }
        let camera = Camera::new(Vec3::Y * 0.88, 14.0, 0.30, 2.4);
        sheet.render(&Scene::new(camera, &environment, objects), SIZE, effort);
    }
    Ok(sheet)
}
