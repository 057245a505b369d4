//! The surfaces of the crate behind one interface in f64, and the maps they are seen through, as
//! the test has them.

use microsurface::RoughnessMatrix;
use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture};
use microsurface::fresnel::{Perfect, Spectrum};
use microsurface::profile::{SampleProfile, SampleVisibleProfile};
use microsurface::{AxisAligned, Isotropic, Linear, Microsurface, Ndf, Real, SampleNdf, SampleVndf};

use crate::chart::Inverse;

/// The map of a surface, one variant for each way to make it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Shape {
    /// α.
    Isotropic(f64),
    /// αx, αy.
    Axes(f64, f64),
    /// αx and αy of the principal axes and the angle of the first, by way of a roughness matrix.
    Matrix(f64, f64, f64),
    /// An isotropic α, moved by the matrix of these rows.
    Moved(f64, [[f64; 2]; 2]),
}

/// A matrix that stretches, shears and turns, and is far from symmetric.
pub(crate) const SKEW: [[f64; 2]; 2] = [[1.2, 0.9], [-0.2, 0.5]];
/// Another, of negative determinant.
pub(crate) const MIRROR: [[f64; 2]; 2] = [[0.4, 1.1], [1.3, -0.6]];

impl Shape {
    /// R = M⁻¹, computed here from the definition of each.
    pub(crate) fn inverse(self) -> Inverse {
        Inverse(match self {
            Self::Isotropic(alpha) => [[alpha, 0.0], [0.0, alpha]],
            Self::Axes(x, y) => [[x, 0.0], [0.0, y]],
            // A = Σ α² e eᵀ = RᵀR with the rows α e of R.
            Self::Matrix(x, y, angle) => {
                let (s, c) = angle.sin_cos();
                [[x * c, x * s], [-y * s, y * c]]
            }
            Self::Moved(alpha, [[a, b], [c, d]]) => {
                let k = alpha / (a * d - b * c);
                [[k * d, -k * b], [-k * c, k * a]]
            }
        })
    }

    /// The same shape with x and y exchanged.
    pub(crate) fn swapped(self) -> Self {
        match self {
            Self::Axes(x, y) => Self::Axes(y, x),
            Self::Matrix(x, y, angle) => Self::Matrix(y, x, angle),
            other => other,
        }
    }

    /// The same with the transposed matrix.
    pub(crate) fn transposed(self) -> Self {
        match self {
            Self::Moved(alpha, [[a, b], [c, d]]) => Self::Moved(alpha, [[a, c], [b, d]]),
            other => other,
        }
    }

    /// All widths times a factor.
    pub(crate) fn scaled(self, k: f64) -> Self {
        match self {
            Self::Isotropic(alpha) => Self::Isotropic(k * alpha),
            Self::Axes(x, y) => Self::Axes(k * x, k * y),
            Self::Matrix(x, y, angle) => Self::Matrix(k * x, k * y, angle),
            Self::Moved(alpha, matrix) => Self::Moved(k * alpha, matrix),
        }
    }
}

/// Random numbers u carry the bits of the scalar: 24 for f32, 53 for f64.
fn bits<T: Real>() -> u32 {
    if T::EPSILON.to_f64() > 1e-10 { 24 } else { 53 }
}

fn vector<T: Real>(v: [f64; 3]) -> T::Vec3 {
    v.map(T::lit).into()
}

fn numbers<T: Real>(u: [f64; 2]) -> T::Vec2 {
    u.map(T::lit).into()
}

fn array<T: Real>(v: T::Vec3) -> [f64; 3] {
    let v: [T; 3] = v.into();
    v.map(T::to_f64)
}

/// A surface whose normals are drawn; arguments are rounded to its scalar.
pub(crate) trait Surface {
    fn bits(&self) -> u32;
    fn epsilon(&self) -> f64;
    fn sample_d(&self, u: [f64; 2]) -> [f64; 3];
    fn pdf_d(&self, m: [f64; 3]) -> f64;
    fn vndf(&self, w: [f64; 3], m: [f64; 3]) -> f64;
    fn g2_separable_over_g2(&self, wi: [f64; 3], wo: [f64; 3]) -> f64;
}

/// A surface whose visible normals are drawn.
pub(crate) trait Visible: Surface {
    fn sample_vndf(&self, w: [f64; 3], u: [f64; 2]) -> [f64; 3];
}

impl<N: SampleNdf> Surface for N {
    fn bits(&self) -> u32 {
        bits::<N::Scalar>()
    }
    fn epsilon(&self) -> f64 {
        N::Scalar::EPSILON.to_f64()
    }
    fn sample_d(&self, u: [f64; 2]) -> [f64; 3] {
        array::<N::Scalar>(SampleNdf::sample_d(self, numbers::<N::Scalar>(u)))
    }
    fn pdf_d(&self, m: [f64; 3]) -> f64 {
        SampleNdf::pdf_d(self, vector::<N::Scalar>(m)).to_f64()
    }
    fn vndf(&self, w: [f64; 3], m: [f64; 3]) -> f64 {
        Ndf::vndf(self, vector::<N::Scalar>(w), vector::<N::Scalar>(m)).to_f64()
    }
    fn g2_separable_over_g2(&self, wi: [f64; 3], wo: [f64; 3]) -> f64 {
        let [i, o] = [wi, wo].map(|w| self.lambda(vector::<N::Scalar>(w)).to_f64());
        (1.0 + i + o) / ((1.0 + i) * (1.0 + o))
    }
}

impl<N: SampleNdf + SampleVndf> Visible for N {
    fn sample_vndf(&self, w: [f64; 3], u: [f64; 2]) -> [f64; 3] {
        array::<N::Scalar>(SampleVndf::sample_vndf(self, vector::<N::Scalar>(w), numbers::<N::Scalar>(u)))
    }
}

/// A sampled direction and the weight of the sample.
pub(crate) type Weighted = Option<([f64; 3], f64)>;

/// A BRDF of reflectance 1.
pub(crate) trait Conductor {
    fn sample(&self, wo: [f64; 3], u: [f64; 2]) -> Weighted;
    fn pdf(&self, wi: [f64; 3], wo: [f64; 3]) -> f64;
    fn eval(&self, wi: [f64; 3], wo: [f64; 3]) -> f64;
}

impl<N, S> Conductor for RoughConductor<N, Perfect<N::Scalar>, S>
where
    N: Ndf,
    N::Scalar: Spectrum<Scalar = N::Scalar>,
    S: NormalSampling<N>,
{
    fn sample(&self, wo: [f64; 3], u: [f64; 2]) -> Weighted {
        let sample = self.sample(vector::<N::Scalar>(wo), numbers::<N::Scalar>(u))?;
        Some((array::<N::Scalar>(sample.wi), sample.weight.to_f64()))
    }
    fn pdf(&self, wi: [f64; 3], wo: [f64; 3]) -> f64 {
        self.pdf(vector::<N::Scalar>(wi), vector::<N::Scalar>(wo)).to_f64()
    }
    fn eval(&self, wi: [f64; 3], wo: [f64; 3]) -> f64 {
        self.eval(vector::<N::Scalar>(wi), vector::<N::Scalar>(wo)).to_f64()
    }
}

/// The surface of a profile under a shape, of whichever type of map the shape is made with, in an
/// expression.
macro_rules! with_map {
    ($t:ty, $profile:expr, $shape:expr, $surface:ident => $result:expr) => {{
        let lit = <$t as Real>::lit;
        match $shape {
            Shape::Isotropic(alpha) => {
                let $surface = Microsurface::new($profile, Isotropic::new(lit(alpha)).unwrap());
                $result
            }
            Shape::Axes(x, y) => {
                let $surface = Microsurface::new($profile, AxisAligned::new(lit(x), lit(y)).unwrap());
                $result
            }
            Shape::Matrix(x, y, angle) => {
                let matrix = RoughnessMatrix::rotated(lit(x), lit(y), lit(angle)).unwrap();
                let $surface = Microsurface::new($profile, Linear::from(matrix));
                $result
            }
            Shape::Moved(alpha, [[a, b], [c, d]]) => {
                let surface = Microsurface::new($profile, Isotropic::new(lit(alpha)).unwrap());
                let columns = [[a, c], [b, d]].map(|column| column.map(lit));
                let $surface = surface.transformed(<$t as Real>::matrix(columns)).unwrap();
                $result
            }
        }
    }};
}

/// The surface of `profile` under `shape`.
pub(crate) fn surface<T: Real, P: SampleProfile<T> + 'static>(profile: P, shape: Shape) -> Box<dyn Surface> {
    with_map!(T, profile, shape, surface => Box::new(surface))
}

/// The same of a profile whose visible normals are drawn.
pub(crate) fn visible<T, P>(profile: P, shape: Shape) -> Box<dyn Visible>
where
    T: Real,
    P: SampleVisibleProfile<T> + SampleProfile<T> + 'static,
{
    with_map!(T, profile, shape, surface => Box::new(surface))
}

/// The BRDF sampled by its visible normals.
pub(crate) fn by_visible_normals<T, P>(profile: P, shape: Shape) -> Box<dyn Conductor>
where
    T: Real + Spectrum<Scalar = T>,
    P: SampleVisibleProfile<T> + 'static,
{
    with_map!(T, profile, shape, surface => Box::new(RoughConductor::new(surface, Perfect::new())))
}

/// The BRDF sampled by all normals.
pub(crate) fn by_all_normals<T, P>(profile: P, shape: Shape) -> Box<dyn Conductor>
where
    T: Real + Spectrum<Scalar = T>,
    P: SampleProfile<T> + 'static,
{
    with_map!(T, profile, shape, surface =>
        Box::new(RoughConductor::new(surface, Perfect::new()).sampled_by(AllNormals)))
}

/// The BRDF sampled by uniform directions with the given probability, and otherwise by all normals.
pub(crate) fn by_mixture<T, P>(profile: P, shape: Shape, probability: f64) -> Box<dyn Conductor>
where
    T: Real + Spectrum<Scalar = T>,
    P: SampleProfile<T> + 'static,
{
    let mixture = UniformMixture::new(AllNormals, T::lit(probability)).expect("a probability");
    with_map!(T, profile, shape, surface =>
        Box::new(RoughConductor::new(surface, Perfect::new()).sampled_by(mixture)))
}
