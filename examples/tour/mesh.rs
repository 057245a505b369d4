//! Triangles from a Wavefront OBJ file.

use std::path::Path;

use microsurface::glam::Vec3;

use crate::shape::Shape;

/// The triangles of a file, standing on the floor at the origin, and their height: scaled to height
/// 2 or width 3.
pub(crate) fn load(path: &Path, material: usize) -> Result<(Vec<Shape>, f32), String> {
    let describe = |problem: String| format!("cannot load the mesh {}: {problem}", path.display());
    let (models, _) =
        tobj::load_obj(path, &tobj::GPU_LOAD_OPTIONS).map_err(|error| describe(error.to_string()))?;
    let mut shapes = Vec::new();
    for model in models {
        let mesh = model.mesh;
        let vectors = |flat: &[f32]| -> Vec<Vec3> { flat.chunks_exact(3).map(Vec3::from_slice).collect() };
        let (positions, normals) = (vectors(&mesh.positions), vectors(&mesh.normals));
        for triangle in mesh.indices.chunks_exact(3) {
            let corner = |i: usize| positions.get(triangle[i] as usize).copied();
            let [Some(a), Some(b), Some(c)] = [corner(0), corner(1), corner(2)] else {
                return Err(describe(format!("a face of {:?} has no such vertex", model.name)));
            };
            let flat = (b - a).cross(c - a).normalize_or_zero();
            // A triangle without area is never hit.
            if flat == Vec3::ZERO || !flat.is_finite() {
                continue;
            }
            let normals = [0, 1, 2].map(|i| normals.get(triangle[i] as usize).copied().unwrap_or(flat));
            shapes.push(Shape::Triangle { corners: [a, b, c], normals, material });
        }
    }
    if shapes.is_empty() {
        return Err(describe("it has no triangles".to_owned()));
    }
    let height = place(&mut shapes);
    Ok((shapes, height))
}

/// Scales and moves the shapes, and returns their height.
fn place(shapes: &mut [Shape]) -> f32 {
    let (low, high) = shapes
        .iter()
        .map(Shape::bounds)
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), [a, b]| (low.min(a), high.max(b)));
    let size = high - low;
    let scale = (2.0 / size.y).min(3.0 / size.x.max(size.z));
    let foot = Vec3::new(0.5 * (low.x + high.x), low.y, 0.5 * (low.z + high.z));
    for shape in shapes {
        if let Shape::Triangle { corners, .. } = shape {
            *corners = corners.map(|corner| (corner - foot) * scale);
        }
    }
    scale * size.y
}
