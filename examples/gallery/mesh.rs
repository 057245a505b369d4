//! Meshes of parametrised surfaces.

use core::f64::consts::TAU;

use microsurface::glam::{DVec2, DVec3, Vec2, Vec3};

/// Triangles, and for every vertex its place, the unit normal, ∂p/∂u and the texture coordinates.
#[derive(Clone)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) normals: Vec<Vec3>,
    pub(crate) tangents: Vec<Vec3>,
    pub(crate) uv: Vec<Vec2>,
    pub(crate) triangles: Vec<[usize; 3]>,
}

impl Mesh {
    /// The surface p(u, v), (u, v) ∈ [0, 1]², in columns of u and rows of v; ∂p/∂u × ∂p/∂v points
    /// outwards.
    ///
    /// Where a side of the square is one point, a pole, there is a vertex for each column, since
    /// the direction of u is another in each; seams are doubled in the same way.
    pub(crate) fn of(p: impl Fn(DVec2) -> DVec3, [columns, rows]: [usize; 2]) -> Self {
        /// Derivatives are taken this far from a pole at least, where ∂p/∂u = 0.
        const FROM_POLE: f64 = 1e-3;
        const STEP: f64 = 1e-4;
        let mut mesh = Self {
            positions: Vec::new(),
            normals: Vec::new(),
            tangents: Vec::new(),
            uv: Vec::new(),
            triangles: Vec::new(),
        };
        for row in 0..=rows {
            for column in 0..=columns {
                let uv = DVec2::new(column as f64 / columns as f64, row as f64 / rows as f64);
                let near = DVec2::new(uv.x, uv.y.clamp(FROM_POLE, 1.0 - FROM_POLE));
                let along = |step: DVec2| (p(near + step) - p(near - step)) / (2.0 * STEP);
                let (along_u, along_v) = (along(DVec2::X * STEP), along(DVec2::Y * STEP));
                mesh.positions.push(p(uv).as_vec3());
                mesh.normals.push(along_u.cross(along_v).normalize().as_vec3());
                mesh.tangents.push(along_u.as_vec3());
                mesh.uv.push(uv.as_vec2());
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let low = row * (columns + 1) + column;
                let high = low + columns + 1;
                mesh.triangles.extend([[low, low + 1, high + 1], [low, high + 1, high]]);
            }
        }
        mesh
    }

    /// The parallelogram of a corner and two edges.
    pub(crate) fn plane([corner, edge_u, edge_v]: [Vec3; 3]) -> Self {
        let [corner, edge_u, edge_v] = [corner, edge_u, edge_v].map(Vec3::as_dvec3);
        Self::of(|uv| corner + edge_u * uv.x + edge_v * uv.y, [1, 1])
    }

    /// The same mesh, moved so that it stands on the floor at this x and z.
    pub(crate) fn standing_at(mut self, x: f32, z: f32) -> Self {
        let lowest = self.positions.iter().fold(f32::INFINITY, |low, p| low.min(p.y));
        for position in &mut self.positions {
            *position += Vec3::new(x, -lowest, z);
        }
        self
    }
}

/// The direction of a longitude u, counted anticlockwise from +x when seen from above, in turns.
pub(crate) fn longitude(u: f64) -> DVec3 {
    let (sin, cos) = (TAU * u).sin_cos();
    DVec3::new(cos, 0.0, -sin)
}
