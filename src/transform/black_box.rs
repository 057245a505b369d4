//! Any distribution, moved by a matrix.

use crate::Real;
use crate::error::Error;
use crate::map::invertible;
use crate::microsurface::{in_view, turned_into_view};
use crate::ndf::staged::{Forms, Solver, StagedVndf};
use crate::ndf::{Ndf, SampleNdf, SampleVndf, Vec2, Vec3};
use crate::vector::{at_least_cosine, dot, normalized};

/// Any distribution, moved by a 2×2 matrix of the tangent plane.
///
/// Nothing is asked of the distribution but [`Ndf`], so it may be anisotropic, discrete, measured
/// or a user's own. A [`Microsurface`](crate::Microsurface) costs no more moved than at rest, by
/// its own [`transformed`](crate::Microsurface::transformed); this gives the same.
///
/// # Domain
/// Unit vectors; those of the distribution at rest are formed with a relative error of a few ε
/// times the ratio of the singular values of the matrix.
///
/// # Special cases
/// As those of the distribution at rest: heights keep their sign.
///
/// # Example
/// A distribution of one's own, drawn out to twice its length along x.
/// ```
/// use microsurface::{Ndf, glam::{Mat2, Vec2, Vec3}, transform::Transformed};
/// /// Facets of equal area in all directions of the hemisphere.
/// #[derive(Clone, Copy)]
/// struct Uniform;
/// impl Ndf for Uniform {
///     type Scalar = f32;
///     fn d(&self, wm: Vec3) -> f32 {
///         if wm.z < 0.0 { 0.0 } else { core::f32::consts::FRAC_1_PI }
///     }
///     fn sigma(&self, w: Vec3) -> f32 {
///         0.5 * (w.z + w.length())
///     }
/// }
/// let drawn = Transformed::new(Uniform, Mat2::from_diagonal(Vec2::new(2.0, 1.0)))?;
/// // GGX of α = 1 is this distribution: half as rough along x.
/// let ggx = microsurface::Ggx::anisotropic(0.5_f32, 1.0)?;
/// let (w, wm) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.28, 0.0, 0.96));
/// assert!((drawn.d(wm) / ggx.d(wm) - 1.0).abs() < 1e-6);
/// assert!((drawn.vndf(w, wm) / ggx.vndf(w, wm) - 1.0).abs() < 1e-6);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Atanasov, Koylazov, Dimov and Wilkie 2022, §4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transformed<N: Ndf> {
    ndf: N,
    /// M by columns.
    matrix: [[N::Scalar; 2]; 2],
    /// M⁻¹ by columns.
    inverse: [[N::Scalar; 2]; 2],
    /// |det M|.
    area: N::Scalar,
}

impl<N: Ndf> Transformed<N> {
    /// The distribution moved by `matrix`.
    ///
    /// # Errors
    /// [`Error::Map`], with the determinant, unless the matrix is finite and its singular values
    /// are within [`alpha_range`](crate::roughness::alpha_range).
    pub fn new(ndf: N, matrix: <N::Scalar as Real>::Mat2) -> Result<Self, Error> {
        Self::of_columns(ndf, N::Scalar::columns(matrix).map(|column| column.map(N::Scalar::to_f64)))
    }

    fn of_columns(ndf: N, columns: [[f64; 2]; 2]) -> Result<Self, Error> {
        let ([[a, b], [c, d]], det) = (columns, invertible::<N::Scalar>(columns)?);
        let inverse = [[d / det, -b / det], [-c / det, a / det]];
        let [matrix, inverse] = [columns, inverse].map(|m| m.map(|column| column.map(N::Scalar::lit)));
        Ok(Self { ndf, matrix, inverse, area: N::Scalar::lit(det.abs()) })
    }

    /// This distribution moved once more: `t.transformed(b)?` is `Transformed::new(ndf, b *
    /// a)?` of a `t` that was moved by `a`.
    ///
    /// # Errors
    /// As [`new`](Self::new), of the product.
    pub fn transformed(self, matrix: <N::Scalar as Real>::Mat2) -> Result<Self, Error> {
        let [first, second] =
            [self.matrix, N::Scalar::columns(matrix)].map(|m| m.map(|c| c.map(N::Scalar::to_f64)));
        let product = first.map(|column| applied(second, column));
        Self::of_columns(self.ndf, product)
    }

    /// The distribution at rest.
    #[inline]
    #[must_use]
    pub const fn at_rest(&self) -> &N {
        &self.ndf
    }

    /// M.
    #[inline]
    #[must_use]
    pub fn matrix(&self) -> <N::Scalar as Real>::Mat2 {
        N::Scalar::matrix(self.matrix)
    }

    /// Mᵀm: a normal as the surface at rest has it, not normalised.
    #[inline(always)]
    fn pulled_normal(&self, m: Vec3<N>) -> [N::Scalar; 3] {
        let [x, y, z]: [N::Scalar; 3] = m.into();
        let [u, v] = transposed_applied(self.matrix, [x, y]);
        [u, v, z]
    }

    /// M⁻ᵀm: a normal at rest as the moved surface has it, not normalised.
    #[inline(always)]
    fn pushed_normal(&self, m: Vec3<N>) -> [N::Scalar; 3] {
        let [x, y, z]: [N::Scalar; 3] = m.into();
        let [u, v] = transposed_applied(self.inverse, [x, y]);
        [u, v, z]
    }

    /// M⁻¹w normalised, and its length.
    #[inline(always)]
    fn pulled_direction(&self, w: Vec3<N>) -> (Vec3<N>, N::Scalar) {
        let [x, y, z]: [N::Scalar; 3] = w.into();
        let [u, v] = applied(self.inverse, [x, y]);
        let length = dot([u, v, z], [u, v, z]).sqrt();
        let inverse = N::Scalar::ONE / length;
        ([u * inverse, v * inverse, z * inverse].into(), length)
    }
}

/// M v, of columns.
#[inline(always)]
fn applied<T: Real>([[a, b], [c, d]]: [[T; 2]; 2], [x, y]: [T; 2]) -> [T; 2] {
    [a * x + c * y, b * x + d * y]
}

/// Mᵀ v, of columns.
#[inline(always)]
fn transposed_applied<T: Real>([[a, b], [c, d]]: [[T; 2]; 2], [x, y]: [T; 2]) -> [T; 2] {
    [a * x + b * y, c * x + d * y]
}

impl<N: Ndf> Ndf for Transformed<N> {
    type Scalar = N::Scalar;

    #[inline(always)]
    fn d(&self, wm: Vec3<Self>) -> N::Scalar {
        let m = self.pulled_normal(wm);
        let inverse = N::Scalar::ONE / dot(m, m);
        let d = self.area * (inverse * inverse) * self.ndf.d_along(m.into());
        // Homogeneous forms of D may leave out what is below the horizon.
        if m[2] < N::Scalar::ZERO { N::Scalar::ZERO } else { d }
    }

    #[inline(always)]
    fn d_along(&self, h: Vec3<Self>) -> N::Scalar {
        let (m, h2): (_, [N::Scalar; 3]) = (self.pulled_normal(h), h.into());
        let ratio = dot(h2, h2) / dot(m, m);
        self.area * (ratio * ratio) * self.ndf.d_along(m.into())
    }

    #[inline(always)]
    fn sigma(&self, w: Vec3<Self>) -> N::Scalar {
        let (direction, length) = self.pulled_direction(w);
        at_least_cosine(w.into(), length * self.ndf.sigma(direction))
    }

    #[inline(always)]
    fn sigma_above(&self, w: Vec3<Self>) -> N::Scalar {
        let (direction, length) = self.pulled_direction(w);
        at_least_cosine(w.into(), length * self.ndf.sigma_above(direction))
    }

    #[inline(always)]
    fn lambda(&self, w: Vec3<Self>) -> N::Scalar {
        // Of the upper side: normalised, a height may vanish and take its sign along.
        let [x, y, z]: [N::Scalar; 3] = w.into();
        let (direction, length) = self.pulled_direction([x, y, z.abs()].into());
        let [_, _, height]: [N::Scalar; 3] = direction.into();
        // A height that is nearly subnormal may have lost its digits with the length. There σ is
        // all of z (1 + Λ).
        let lambda = if height < N::Scalar::MIN_POSITIVE / N::Scalar::EPSILON {
            length * self.ndf.sigma_above(direction) / z.abs() - N::Scalar::ONE
        } else {
            self.ndf.lambda(direction)
        };
        if z < N::Scalar::ZERO { -N::Scalar::ONE - lambda } else { lambda }
    }

    #[inline(always)]
    fn p22(&self, slope: Vec2<Self>) -> N::Scalar {
        self.area * self.ndf.p22(transposed_applied(self.matrix, slope.into()).into())
    }
}

impl<N: SampleNdf> SampleNdf for Transformed<N> {
    #[inline(always)]
    fn sample_d(&self, u: Vec2<Self>) -> Vec3<Self> {
        normalized(self.pushed_normal(self.ndf.sample_d(u))).into()
    }
}

impl<N: SampleVndf> SampleVndf for Transformed<N> {
    #[inline(always)]
    fn sample_vndf(&self, w: Vec3<Self>, u: Vec2<Self>) -> Vec3<Self> {
        normalized(self.sample_vndf_along(w, u).into()).into()
    }

    #[inline(always)]
    fn sample_vndf_along(&self, w: Vec3<Self>, u: Vec2<Self>) -> Vec3<Self> {
        let m = self.ndf.sample_vndf(self.pulled_direction(w).0, u);
        turned_into_view(w.into(), self.pushed_normal(m)).into()
    }
}

impl<N: Ndf + Forms> Forms for Transformed<N> {
    #[inline(always)]
    fn form(&self) -> usize {
        self.ndf.form()
    }

    #[inline(always)]
    fn with_form(self, form: usize) -> Self {
        Self { ndf: self.ndf.with_form(form), ..self }
    }
}

impl<N: StagedVndf> StagedVndf for Transformed<N> {
    const STRAIGHT: bool = N::STRAIGHT;
    type Solver = N::Solver;

    #[inline(always)]
    fn ask(&self, w: Vec3<Self>, u: Vec2<Self>) -> <N::Solver as Solver>::Question {
        self.ndf.ask(self.pulled_direction(w).0, u)
    }

    #[inline(always)]
    fn normal(
        &self,
        w: Vec3<Self>,
        u: Vec2<Self>,
        answer: <N::Solver as Solver>::Answer,
    ) -> (Vec3<Self>, bool) {
        let (m, usual) = self.ndf.normal(self.pulled_direction(w).0, u, answer);
        let m = self.pushed_normal(self.ndf.sample_of_along(m));
        (m.into(), usual && in_view(w.into(), m))
    }

    #[inline(always)]
    fn sample_of_along(&self, along: Vec3<Self>) -> Vec3<Self> {
        normalized(along.into()).into()
    }
}
