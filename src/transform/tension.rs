//! The tension of a deformed mesh: the matrix that each of its triangles moved the microsurface by.
//!
//! A triangle at rest and the same triangle deformed are laid into a plane each, along the
//! direction of the texture coordinate u; T = D R⁻¹ takes the edges of the one to those of the
//! other. [`Microsurface::transformed`] by T is what the deformation made of the microsurface:
//! smoother where the object is stretched, rougher where it is compressed.
//!
//! The shading frame that goes with T has the normal (p₁ − p₀) × (p₂ − p₀) of the deformed triangle
//! as z and the direction of ∂p/∂u as x; [`Triangle::frame`] gives it.
//!
//! [`Microsurface::transformed`]: crate::Microsurface::transformed
//!
//! References: Atanasov, Koylazov, Dimov and Wilkie 2022, §5.1.

use crate::elementary::exact::difference_of_products;
use crate::error::Error;
use crate::frame::Frame;
use crate::map::invertible;
use crate::real::{Real, Vector};
use crate::vector::{cross, dot, minus};

/// A triangle at rest and deformed, with its texture coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle<T: Real> {
    /// The corners at rest.
    pub rest: [T::Vec3; 3],
    /// The corners, deformed.
    pub deformed: [T::Vec3; 3],
    /// Their texture coordinates.
    pub uv: [T::Vec2; 3],
}

/// Axes of a triangle's plane, x along ∂p/∂u and y across it, and the normal z.
struct Axes {
    x: [f64; 3],
    y: [f64; 3],
    z: [f64; 3],
}

/// v/|v|, or none where |v|² is no normal number.
fn direction(v: [f64; 3]) -> Option<[f64; 3]> {
    let length2 = dot(v, v);
    (length2.is_normal()).then(|| v.map(|c| c / Real::sqrt(length2)))
}

fn edges<T: Real>(corners: [T::Vec3; 3]) -> [[f64; 3]; 2] {
    let [p, q, r] = corners.map(|corner| corner.into().map(T::to_f64));
    [minus(q, p), minus(r, p)]
}

/// The axes of a triangle of these edges; `uv` are those of the texture.
fn axes([e1, e2]: [[f64; 3]; 2], [[u1, v1], [u2, v2]]: [[f64; 2]; 2]) -> Option<Axes> {
    // The direction of ∂p/∂u; only its sign depends on that of the area in texture space.
    let sign = difference_of_products(u1, v2, u2, v1);
    let along = core::array::from_fn(|i| (e1[i] * v2 - e2[i] * v1) * sign.signum());
    if sign == 0.0 || sign.is_nan() {
        return None;
    }
    let z = direction(cross(e1, e2))?;
    let x = direction(along)?;
    Some(Axes { x, y: cross(z, x), z })
}

impl<T: Real> Triangle<T> {
    /// The triangle of these corners, at rest and deformed, and of these texture coordinates.
    #[inline]
    #[must_use]
    pub fn new<V: Vector<3, Scalar = T>>(
        rest: [V; 3],
        deformed: [V; 3],
        uv: [impl Vector<2, Scalar = T>; 3],
    ) -> Self {
        let of = |v: V| v.components().into();
        Self { rest: rest.map(of), deformed: deformed.map(of), uv: uv.map(|uv| uv.components().into()) }
    }

    /// T = D R⁻¹.
    ///
    /// # Errors
    /// [`Error::Map`] with the determinant of T, 0 or NaN, where a triangle or its texture
    /// coordinates have no area, or where T is out of the range that
    /// [`Microsurface::transformed`](crate::Microsurface::transformed) accepts.
    ///
    /// # Example
    /// ```
    /// use microsurface::{Gtr, glam::{Vec2, Vec3}, transform::tension::Triangle};
    /// let rest = [Vec3::ZERO, Vec3::X, Vec3::Y];
    /// let uv = [Vec2::ZERO, Vec2::X, Vec2::Y];
    /// // Drawn out to twice its length along u, and turned somewhere else.
    /// let deformed = [Vec3::ZERO, Vec3::Z * 2.0, Vec3::X].map(|p| p + Vec3::new(1.0, 2.0, 3.0));
    /// let tension = Triangle::new(rest, deformed, uv).tension()?;
    /// assert!((tension.x_axis - Vec2::new(2.0, 0.0)).length() < 1e-6);
    /// let stretched = Gtr::isotropic(0.25_f32, 2.2)?.transformed(tension)?;
    /// # let _ = stretched;
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    pub fn tension(&self) -> Result<T::Mat2, Error> {
        let matrix = self.columns().ok_or(Error::Map { determinant: 0.0 })?;
        invertible::<T>(matrix)?;
        Ok(T::matrix(matrix.map(|column| column.map(T::lit))))
    }

    fn columns(&self) -> Option<[[f64; 2]; 2]> {
        let (rest, deformed, uv) = (edges::<T>(self.rest), edges::<T>(self.deformed), self.uv_edges());
        let [at_rest, moved] = [axes(rest, uv)?, axes(deformed, uv)?];
        let planar = |axes: &Axes, edge: [f64; 3]| [dot(axes.x, edge), dot(axes.y, edge)];
        let [[a, b], [c, d]] = rest.map(|edge| planar(&at_rest, edge));
        let [first, second] = deformed.map(|edge| planar(&moved, edge));
        // D R⁻¹ with R⁻¹ = adj R/det R; the columns of R and D are the edges.
        let det = difference_of_products(a, d, b, c);
        let column = |p: f64, q: f64| core::array::from_fn(|i| (first[i] * p + second[i] * q) / det);
        Some([column(d, -b), column(-c, a)])
    }

    fn uv_edges(&self) -> [[f64; 2]; 2] {
        let [p, q, r] = self.uv.map(|corner| corner.into().map(T::to_f64));
        [[q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]]
    }

    /// The shading frame of the deformed triangle that [`tension`](Self::tension) belongs to.
    ///
    /// # Errors
    /// [`Error::Map`] with a determinant of 0 where the triangle or its texture coordinates have no
    /// area.
    pub fn frame(&self) -> Result<Frame<T>, Error> {
        let axes = axes(edges::<T>(self.deformed), self.uv_edges()).ok_or(Error::Map { determinant: 0.0 })?;
        let [normal, tangent] = [axes.z, axes.x].map(|axis| axis.map(T::lit));
        Ok(Frame::from_normal_and_tangent(normal, tangent))
    }

    /// The area at rest.
    fn area(&self) -> f64 {
        let [e1, e2] = edges::<T>(self.rest);
        let normal = cross(e1, e2);
        0.5 * Real::sqrt(dot(normal, normal))
    }
}

/// A mean of matrices, such as of the triangles about a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Mean<T> {
    sum: [[T; 2]; 2],
    weight: T,
}

impl<T: Real> Mean<T> {
    /// Adds a matrix of this weight.
    pub fn add(&mut self, matrix: T::Mat2, weight: T) {
        let columns = T::columns(matrix);
        for (sum, column) in self.sum.iter_mut().zip(columns) {
            for (sum, entry) in sum.iter_mut().zip(column) {
                *sum += weight * entry;
            }
        }
        self.weight += weight;
    }

    /// The mean; of nothing the identity, which leaves a surface as it is.
    #[must_use]
    pub fn matrix(&self) -> T::Mat2 {
        if self.weight == T::ZERO {
            return T::matrix([[T::ONE, T::ZERO], [T::ZERO, T::ONE]]);
        }
        let inverse = T::ONE / self.weight;
        T::matrix(self.sum.map(|column| column.map(|sum| sum * inverse)))
    }
}

/// A mesh at rest and deformed: one position of each and one texture coordinate for every vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mesh<'a, T: Real> {
    /// The vertices at rest.
    pub rest: &'a [T::Vec3],
    /// The vertices, deformed.
    pub deformed: &'a [T::Vec3],
    /// Their texture coordinates.
    pub uv: &'a [T::Vec2],
    /// The vertices of each triangle.
    pub triangles: &'a [[usize; 3]],
}

impl<T: Real> Mesh<'_, T> {
    /// A triangle of the mesh, or none if it does not exist or names a vertex that does not.
    #[must_use]
    pub fn triangle(&self, index: usize) -> Option<Triangle<T>> {
        let [i, j, k] = *self.triangles.get(index)?;
        let corners = |v: &[T::Vec3]| Some([*v.get(i)?, *v.get(j)?, *v.get(k)?]);
        let uv = [*self.uv.get(i)?, *self.uv.get(j)?, *self.uv.get(k)?];
        Some(Triangle { rest: corners(self.rest)?, deformed: corners(self.deformed)?, uv })
    }

    /// The mean tension at every vertex, weighted by the areas of its triangles at rest, added to
    /// `means`.
    ///
    /// The texture direction u, to which the matrices of neighbouring triangles refer, has to be
    /// continuous across their edges: at a seam or a pole of the texture vertices are to be
    /// doubled, as they are for the coordinates themselves. The frame that goes with interpolated
    /// means has the interpolated normal as z and the interpolated ∂p/∂u as x:
    /// [`Frame::from_normal_and_tangent`].
    ///
    /// # Returns
    /// The number of triangles left out because they have no tension: vertices that have no other
    /// stay at rest.
    ///
    /// # Errors
    /// [`Error::Mesh`] with the first triangle that names a vertex which one of the slices, or
    /// `means`, does not have; then nothing is written.
    pub fn add_tension_of_vertices(&self, means: &mut [Mean<T>]) -> Result<usize, Error> {
        let known = self.rest.len().min(self.deformed.len()).min(self.uv.len()).min(means.len());
        if let Some(triangle) = self.triangles.iter().position(|corners| corners.iter().any(|&i| i >= known))
        {
            return Err(Error::Mesh { triangle });
        }
        let mut left_out = 0;
        for (index, corners) in self.triangles.iter().enumerate() {
            let Some(triangle) = self.triangle(index) else { continue };
            let Ok(tension) = triangle.tension() else {
                left_out += 1;
                continue;
            };
            let area = T::lit(triangle.area());
            for &corner in corners {
                means[corner].add(tension, area);
            }
        }
        Ok(left_out)
    }
}

/// The tension within a triangle: the mean of those of its vertices by barycentric coordinates.
///
/// # Example
/// ```
/// use microsurface::{glam::{Mat2, Vec2}, transform::tension::interpolated};
/// let corners = [1.0_f32, 2.0, 3.0].map(|k| Mat2::from_diagonal(Vec2::new(k, 1.0)));
/// assert!((interpolated(corners, [0.5_f32, 0.25, 0.25]).x_axis.x - 1.75).abs() < 1e-6);
/// ```
#[must_use]
pub fn interpolated<T: Real>(corners: [T::Mat2; 3], barycentric: [T; 3]) -> T::Mat2 {
    let [a, b, c] = corners.map(T::columns);
    T::matrix(core::array::from_fn(|column| {
        core::array::from_fn(|row| {
            barycentric[0] * a[column][row]
                + barycentric[1] * b[column][row]
                + barycentric[2] * c[column][row]
        })
    }))
}
