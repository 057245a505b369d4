//! Surfaces as plain data, so that one test body runs over every profile and map, a failure can be
//! printed, and the linear map is known from the parameters alone, without the crate's own map
//! code.

use core::fmt;
use std::rc::Rc;

use microsurface::filter::{Covariance, gaussian};
use microsurface::map::{AxisAligned, Isotropic, Linear, Map};
use microsurface::ndf::{Ndf, SampleNdf, SampleVndf, Vec2, Vec3};
use microsurface::profile::{SampleProfile, SampleVisibleProfile};
use microsurface::transform::Transformed;
use microsurface::{Error, Ggx, Microsurface, Real, RoughnessMatrix};

use crate::rows::{Distribution, Mask, Visitor};

/// A distribution before its map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    /// One of the rows.
    Of(Distribution),
    /// GGX convolved with a Gaussian of these standard deviations along the axes, as six surfaces
    /// more or as one.
    Filtered { deviations: [f64; 2], by_two: bool },
    /// GGX of `widths` and a Beckmann surface of α, half of each, as a caller's own [`Ndf`] of two
    /// functions.
    Halves { alpha: f64 },
}

impl Shape {
    pub(crate) const GGX: Self = Self::Of(Distribution::GGX);
    pub(crate) const BECKMANN: Self = Self::Of(Distribution::BECKMANN);

    /// The distribution of the profile under its map; none of a mixture.
    pub(crate) fn distribution(&self) -> Option<Distribution> {
        if let Self::Of(distribution) = self { Some(*distribution) } else { None }
    }
}

impl From<Distribution> for Shape {
    fn from(distribution: Distribution) -> Self {
        Self::Of(distribution)
    }
}

/// The slope widths given when a surface is built; for GTR a map on top of the profile's own α.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Widths {
    Isotropic(f64),
    AxisAligned(f64, f64),
    Matrix { x: f64, y: f64, correlation: f64 },
}

/// What happens to the surface afterwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Move {
    Stay,
    /// The columns of a matrix.
    Transform([[f64; 2]; 2]),
    /// The same by [`Transformed`], which knows nothing of the surface.
    Wrap([[f64; 2]; 2]),
    Stretch(f64),
}

/// All that is needed to build a surface of either scalar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spec {
    pub(crate) shape: Shape,
    pub(crate) widths: Widths,
    pub(crate) moved: Move,
}

impl Spec {
    pub(crate) fn new(shape: impl Into<Shape>, widths: Widths, moved: Move) -> Self {
        Self { shape: shape.into(), widths, moved }
    }

    /// The distribution of the profile under the map.
    ///
    /// # Panics
    /// If it is a mixture.
    pub(crate) fn distribution(&self) -> Distribution {
        self.shape.distribution().expect("a profile under a map")
    }

    /// How near σ is to that of D.
    pub(crate) fn mask(&self) -> Mask {
        self.shape.distribution().map_or(Mask::Exact, |distribution| distribution.row.columns().mask)
    }

    /// Whether visible normals can be drawn.
    pub(crate) fn samples_visible(&self) -> bool {
        match self.shape {
            Shape::Of(distribution) => distribution.row.samples_visible(),
            Shape::Filtered { .. } => true,
            Shape::Halves { .. } => false,
        }
    }

    /// With every parameter rounded to f32, so that both scalars hold the same; widths of matrices
    /// as their entries cannot be, and are left out.
    pub(crate) fn rounded(&self) -> Self {
        let held = |x: f64| f64::from(x as f32);
        let shape = match self.shape {
            Shape::Of(Distribution { row, alpha, gamma }) => row.with(held(alpha), held(gamma)).into(),
            shape => shape,
        };
        let widths = match self.widths {
            Widths::Isotropic(x) => Widths::Isotropic(held(x)),
            Widths::AxisAligned(x, y) | Widths::Matrix { x, y, .. } => Widths::AxisAligned(held(x), held(y)),
        };
        let moved = match self.moved {
            Move::Stay => Move::Stay,
            Move::Transform(columns) => Move::Transform(columns.map(|column| column.map(held))),
            Move::Wrap(columns) => Move::Wrap(columns.map(|column| column.map(held))),
            Move::Stretch(s) => Move::Stretch(held(s)),
        };
        Self { shape, widths, moved }
    }

    pub(crate) fn build<T: Real>(&self) -> Result<Surface<T>, Error> {
        match self.shape {
            Shape::Of(distribution) => distribution.row.visit(Build(self, distribution)),
            Shape::Filtered { deviations, by_two } => {
                let [x, y] = deviations.map(|deviation| T::lit(deviation));
                let kernel = Covariance::axis_aligned(x * x, y * y);
                match self.map(Ggx)? {
                    AnyMap::Isotropic(m) => self.convolved(&Microsurface::new(Ggx, m), kernel, by_two),
                    AnyMap::AxisAligned(m) => self.convolved(&Microsurface::new(Ggx, m), kernel, by_two),
                    AnyMap::Linear(m) => self.convolved(&Microsurface::new(Ggx, m), kernel, by_two),
                }
            }
            Shape::Halves { alpha } => {
                let ggx = Spec { shape: Shape::GGX, moved: Move::Stay, ..*self }.build()?;
                let beckmann = Spec::new(Shape::BECKMANN, Widths::Isotropic(alpha), Move::Stay).build()?;
                self.all_normals(Halves(ggx, beckmann))
            }
        }
    }

    fn convolved<T: Real, M: Map<Scalar = T>>(
        &self,
        surface: &Microsurface<Ggx, M>,
        kernel: Covariance<T>,
        by_two: bool,
    ) -> Result<Surface<T>, Error> {
        if by_two {
            self.all_and_visible_normals(gaussian::filtered_by_two(surface, kernel)?)
        } else {
            self.all_and_visible_normals(gaussian::filtered(surface, kernel)?)
        }
    }

    /// A factor F of A = F Fᵀ, by columns, from the parameters as `T` holds them: slopes are t = F
    /// p with p those of the isotropic profile.
    pub(crate) fn factor<T: Real>(&self) -> [[f64; 2]; 2] {
        let held = |x: f64| T::lit(x).to_f64();
        let [[a, b], [c, d]] = match self.widths {
            Widths::Isotropic(alpha) => [[held(alpha), 0.0], [0.0, held(alpha)]],
            Widths::AxisAligned(x, y) => [[held(x), 0.0], [0.0, held(y)]],
            Widths::Matrix { .. } => {
                let [xx, xy, yy] = self.matrix_entries().map(held);
                let corner = xx.sqrt();
                // xx yy − xy² without its cancellation.
                let product = xy * xy;
                let det = xx.mul_add(yy, -product) - xy.mul_add(xy, -product);
                [[corner, xy / corner], [0.0, det.sqrt() / corner]]
            }
        };
        match self.moved {
            Move::Stay => [[a, b], [c, d]],
            Move::Transform(columns) | Move::Wrap(columns) => {
                // Slopes go with the inverse transpose of the points' matrix.
                let [[m11, m21], [m12, m22]] = columns.map(|column| column.map(held));
                let det = m11 * m22 - m12 * m21;
                let inverse_transpose =
                    |[x, y]: [f64; 2]| [(m22 * x - m21 * y) / det, (m11 * y - m12 * x) / det];
                [inverse_transpose([a, b]), inverse_transpose([c, d])]
            }
            Move::Stretch(s) => {
                let s = held(s);
                let along = if s >= 0.0 { 1.0 / (1.0 - s) } else { 1.0 + s };
                [[a / along, b * along], [c / along, d * along]]
            }
        }
    }

    fn matrix_entries(&self) -> [f64; 3] {
        match self.widths {
            Widths::Isotropic(a) => [a * a, 0.0, a * a],
            Widths::AxisAligned(x, y) => [x * x, 0.0, y * y],
            Widths::Matrix { x, y, correlation } => [x * x, correlation * (x * y), y * y],
        }
    }

    /// A distribution behind one type, wrapped if that is asked for.
    fn all_and_visible_normals<T: Real, N>(&self, ndf: N) -> Result<Surface<T>, Error>
    where
        N: SampleNdf<Scalar = T> + SampleVndf<Scalar = T> + 'static,
    {
        fn shared<T: Real, N>(spec: Spec, ndf: N) -> Surface<T>
        where
            N: SampleNdf<Scalar = T> + SampleVndf<Scalar = T> + 'static,
        {
            let ndf = Rc::new(ndf);
            Surface { spec, ndf: ndf.clone(), visible: Some(ndf) }
        }
        match self.moved {
            Move::Wrap(columns) => Ok(shared(*self, Transformed::new(ndf, matrix::<T>(columns))?)),
            _ => Ok(shared(*self, ndf)),
        }
    }

    /// The same of one whose visible normals cannot be drawn.
    fn all_normals<T: Real, N: SampleNdf<Scalar = T> + 'static>(&self, ndf: N) -> Result<Surface<T>, Error> {
        let ndf: Rc<dyn SampleNdf<Scalar = T>> = match self.moved {
            Move::Wrap(columns) => Rc::new(Transformed::new(ndf, matrix::<T>(columns))?),
            _ => Rc::new(ndf),
        };
        Ok(Surface { spec: *self, ndf, visible: None })
    }

    /// The crate's map of these parameters, by way of the surface of `profile`.
    fn map<T: Real, P: Copy>(&self, profile: P) -> Result<AnyMap<T>, Error> {
        let base = match self.widths {
            Widths::Isotropic(alpha) => AnyMap::Isotropic(Isotropic::new(T::lit(alpha))?),
            Widths::AxisAligned(x, y) => AnyMap::AxisAligned(AxisAligned::new(T::lit(x), T::lit(y))?),
            Widths::Matrix { .. } => {
                let [xx, xy, yy] = self.matrix_entries().map(T::lit);
                AnyMap::Linear(Linear::from(RoughnessMatrix::new(xx, xy, yy)?))
            }
        };
        Ok(match (self.moved, base) {
            (Move::Stay | Move::Wrap(_), base) => base,
            (Move::Transform(m), AnyMap::Isotropic(b)) => {
                AnyMap::Linear(*Microsurface::new(profile, b).transformed(matrix::<T>(m))?.map())
            }
            (Move::Transform(m), AnyMap::AxisAligned(b)) => {
                AnyMap::Linear(*Microsurface::new(profile, b).transformed(matrix::<T>(m))?.map())
            }
            (Move::Transform(m), AnyMap::Linear(b)) => {
                AnyMap::Linear(*Microsurface::new(profile, b).transformed(matrix::<T>(m))?.map())
            }
            (Move::Stretch(s), AnyMap::Isotropic(b)) => {
                AnyMap::AxisAligned(*Microsurface::new(profile, b).stretched(T::lit(s))?.map())
            }
            (Move::Stretch(s), AnyMap::AxisAligned(b)) => {
                AnyMap::AxisAligned(*Microsurface::new(profile, b).stretched(T::lit(s))?.map())
            }
            (Move::Stretch(s), AnyMap::Linear(b)) => {
                AnyMap::Linear(*Microsurface::new(profile, b).stretched(T::lit(s))?.map())
            }
        })
    }
}

/// Builds the surface of a distribution.
struct Build<'a>(&'a Spec, Distribution);

impl<T: Real> Visitor<T> for Build<'_> {
    type Output = Result<Surface<T>, Error>;

    fn visible<P: SampleVisibleProfile<T> + SampleProfile<T> + 'static>(
        self,
        profile: impl Fn(T, T) -> Result<P, Error>,
    ) -> Self::Output {
        let Self(spec, distribution) = self;
        let profile = distribution.profile(profile)?;
        match spec.map(profile)? {
            AnyMap::Isotropic(m) => spec.all_and_visible_normals(Microsurface::new(profile, m)),
            AnyMap::AxisAligned(m) => spec.all_and_visible_normals(Microsurface::new(profile, m)),
            AnyMap::Linear(m) => spec.all_and_visible_normals(Microsurface::new(profile, m)),
        }
    }

    fn all_normals<P: SampleProfile<T> + 'static>(
        self,
        profile: impl Fn(T, T) -> Result<P, Error>,
    ) -> Self::Output {
        let Self(spec, distribution) = self;
        let profile = distribution.profile(profile)?;
        match spec.map(profile)? {
            AnyMap::Isotropic(m) => spec.all_normals(Microsurface::new(profile, m)),
            AnyMap::AxisAligned(m) => spec.all_normals(Microsurface::new(profile, m)),
            AnyMap::Linear(m) => spec.all_normals(Microsurface::new(profile, m)),
        }
    }
}

enum AnyMap<T> {
    Isotropic(Isotropic<T>),
    AxisAligned(AxisAligned<T>),
    Linear(Linear<T>),
}

fn matrix<T: Real>(columns: [[f64; 2]; 2]) -> T::Mat2 {
    T::matrix(columns.map(|column| column.map(T::lit)))
}

/// Half of one surface and half of another: what a caller's own distribution is, of the functions
/// that [`Ndf`] asks for and no other.
struct Halves<T: Real>(Surface<T>, Surface<T>);

impl<T: Real> Ndf for Halves<T> {
    type Scalar = T;
    fn d(&self, wm: Vec3<Self>) -> T {
        T::HALF * (self.0.d(wm) + self.1.d(wm))
    }
    fn sigma(&self, w: Vec3<Self>) -> T {
        T::HALF * (self.0.sigma(w) + self.1.sigma(w))
    }
}

impl<T: Real> SampleNdf for Halves<T> {
    fn sample_d(&self, u: Vec2<Self>) -> Vec3<Self> {
        let [x, y]: [T; 2] = u.into();
        if x < T::HALF {
            self.0.sample_d([x + x, y].into())
        } else {
            self.1.sample_d([x + x - T::ONE, y].into())
        }
    }
}

/// A surface of the crate behind one type. Every method is the crate's own.
#[derive(Clone)]
pub(crate) struct Surface<T: Real> {
    pub(crate) spec: Spec,
    ndf: Rc<dyn SampleNdf<Scalar = T>>,
    visible: Option<Rc<dyn SampleVndf<Scalar = T>>>,
}

impl<T: Real> Surface<T> {
    /// Whether visible normals can be drawn.
    pub(crate) fn samples_visible(&self) -> bool {
        self.visible.is_some()
    }
}

impl<T: Real> fmt::Debug for Surface<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} {:?} {:?}", self.spec.shape, self.spec.widths, self.spec.moved)
    }
}

impl<T: Real> Ndf for Surface<T> {
    type Scalar = T;
    fn d(&self, wm: Vec3<Self>) -> T {
        self.ndf.d(wm)
    }
    fn sigma(&self, w: Vec3<Self>) -> T {
        self.ndf.sigma(w)
    }
    fn lambda(&self, w: Vec3<Self>) -> T {
        self.ndf.lambda(w)
    }
    fn sigma_above(&self, w: Vec3<Self>) -> T {
        self.ndf.sigma_above(w)
    }
    fn d_along(&self, h: Vec3<Self>) -> T {
        self.ndf.d_along(h)
    }
    fn p22(&self, slope: Vec2<Self>) -> T {
        self.ndf.p22(slope)
    }
    fn g1(&self, w: Vec3<Self>, wm: Vec3<Self>) -> T {
        self.ndf.g1(w, wm)
    }
    fn g2(&self, wi: Vec3<Self>, wo: Vec3<Self>, wm: Vec3<Self>) -> T {
        self.ndf.g2(wi, wo, wm)
    }
    fn g2_separable(&self, wi: Vec3<Self>, wo: Vec3<Self>, wm: Vec3<Self>) -> T {
        self.ndf.g2_separable(wi, wo, wm)
    }
    fn vndf(&self, w: Vec3<Self>, wm: Vec3<Self>) -> T {
        self.ndf.vndf(w, wm)
    }
}

impl<T: Real> SampleNdf for Surface<T> {
    fn sample_d(&self, u: Vec2<Self>) -> Vec3<Self> {
        self.ndf.sample_d(u)
    }
    fn pdf_d(&self, wm: Vec3<Self>) -> T {
        self.ndf.pdf_d(wm)
    }
}

impl<T: Real> SampleVndf for Surface<T> {
    fn sample_vndf(&self, w: Vec3<Self>, u: Vec2<Self>) -> Vec3<Self> {
        self.visible.as_ref().expect("a profile whose visible normals can be drawn").sample_vndf(w, u)
    }
}
