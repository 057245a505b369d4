//! The surfaces of the crate behind one interface in f64, and the maps they are seen through, as
//! the test has them.

use microsurface::RoughnessMatrix;
use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture};
use microsurface::fresnel::{Perfect, Spectrum};
use microsurface::profile::{SampleProfile, SampleVisibleProfile};
use microsurface::verify::Float;
use microsurface::{AxisAligned, Error, Isotropic, Linear, Microsurface, Ndf, Real, SampleNdf, SampleVndf};

use crate::chart::Inverse;
use crate::rows::{Distribution, Visitor};

/// The map of a surface, one variant for each way to make it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum MapSpec {
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

impl MapSpec {
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
            MapSpec::Isotropic(alpha) => {
                let $surface = Microsurface::new($profile, Isotropic::new(lit(alpha)).unwrap());
                $result
            }
            MapSpec::Axes(x, y) => {
                let $surface = Microsurface::new($profile, AxisAligned::new(lit(x), lit(y)).unwrap());
                $result
            }
            MapSpec::Matrix(x, y, angle) => {
                let matrix = RoughnessMatrix::rotated(lit(x), lit(y), lit(angle)).unwrap();
                let $surface = Microsurface::new($profile, Linear::from(matrix));
                $result
            }
            MapSpec::Moved(alpha, [[a, b], [c, d]]) => {
                let surface = Microsurface::new($profile, Isotropic::new(lit(alpha)).unwrap());
                let columns = [[a, c], [b, d]].map(|column| column.map(lit));
                let $surface = surface.transformed(<$t as Real>::matrix(columns)).unwrap();
                $result
            }
        }
    }};
}

/// A recipe for the surface of a distribution under a map.
struct Made<R: Recipe>(R, Distribution, MapSpec);

/// A use of a surface: the surface itself, a BRDF on it, or a report.
pub(crate) trait Recipe {
    type Made;
    fn make<N: SampleNdf<Scalar: Scalar> + 'static>(self, surface: N) -> Self::Made;
    /// The same of one whose visible normals can be drawn.
    fn make_visible<N: SampleNdf<Scalar: Scalar> + SampleVndf + 'static>(self, surface: N) -> Self::Made;
}

impl<T: Scalar, R: Recipe> Visitor<T> for Made<R> {
    type Output = R::Made;

    fn visible<P: SampleVisibleProfile<T> + SampleProfile<T> + 'static>(
        self,
        profile: impl Fn(T, T) -> Result<P, Error>,
    ) -> R::Made {
        let Self(recipe, distribution, map) = self;
        let profile = distribution.profile(profile).expect("within the range");
        with_map!(T, profile, map, surface => recipe.make_visible(surface))
    }

    fn all_normals<P: SampleProfile<T> + 'static>(
        self,
        profile: impl Fn(T, T) -> Result<P, Error>,
    ) -> R::Made {
        let Self(recipe, distribution, map) = self;
        let profile = distribution.profile(profile).expect("within the range");
        with_map!(T, profile, map, surface => recipe.make(surface))
    }
}

/// The surface, if all its normals are drawn.
struct Itself;

impl Recipe for Itself {
    type Made = Box<dyn Surface>;
    fn make<N: SampleNdf<Scalar: Scalar> + 'static>(self, surface: N) -> Self::Made {
        Box::new(surface)
    }
    fn make_visible<N: SampleNdf<Scalar: Scalar> + SampleVndf + 'static>(self, surface: N) -> Self::Made {
        Box::new(surface)
    }
}

/// The surface, if its visible normals are drawn.
struct ItselfVisible;

impl Recipe for ItselfVisible {
    type Made = Option<Box<dyn Visible>>;
    fn make<N: SampleNdf<Scalar: Scalar> + 'static>(self, _: N) -> Self::Made {
        None
    }
    fn make_visible<N: SampleNdf<Scalar: Scalar> + SampleVndf + 'static>(self, surface: N) -> Self::Made {
        Some(Box::new(surface))
    }
}

/// Which normals a BRDF samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Normals {
    Visible,
    All,
    /// Uniform directions with this probability, else all normals.
    Mixed(f64),
}

impl Recipe for Normals {
    type Made = Option<Box<dyn Conductor>>;
    fn make<N: SampleNdf<Scalar: Scalar> + 'static>(self, surface: N) -> Self::Made {
        let brdf = RoughConductor::new(surface, Perfect::new());
        Some(match self {
            Self::Visible => return None,
            Self::All => Box::new(brdf.sampled_by(AllNormals)),
            Self::Mixed(p) => {
                let p = N::Scalar::lit(p);
                Box::new(brdf.sampled_by(UniformMixture::new(AllNormals, p).expect("a probability")))
            }
        })
    }
    fn make_visible<N: SampleNdf<Scalar: Scalar> + SampleVndf + 'static>(self, surface: N) -> Self::Made {
        if self == Self::Visible {
            Some(Box::new(RoughConductor::new(surface, Perfect::new())))
        } else {
            self.make(surface)
        }
    }
}

/// f32 and f64, which are their own spectra.
pub(crate) trait Scalar: Float + Spectrum<Scalar = Self> {}
impl<T: Float + Spectrum<Scalar = T>> Scalar for T {}

/// Makes of the surface of a distribution under a map what the recipe says.
pub(crate) fn made<T: Scalar, R: Recipe>(recipe: R, distribution: Distribution, map: MapSpec) -> R::Made {
    distribution.row.visit::<T, _>(Made(recipe, distribution, map))
}

/// The surface of a distribution under a map.
pub(crate) fn surface<T: Scalar>(distribution: Distribution, map: MapSpec) -> Box<dyn Surface> {
    made::<T, _>(Itself, distribution, map)
}

/// The same of one whose visible normals are drawn.
pub(crate) fn visible<T: Scalar>(distribution: Distribution, map: MapSpec) -> Box<dyn Visible> {
    let surface = made::<T, _>(ItselfVisible, distribution, map);
    surface.expect("a distribution whose visible normals can be drawn")
}

/// The BRDF of reflectance 1, sampled by these normals.
pub(crate) fn conductor<T: Scalar>(
    distribution: Distribution,
    map: MapSpec,
    normals: Normals,
) -> Box<dyn Conductor> {
    let brdf = made::<T, _>(normals, distribution, map);
    brdf.expect("a distribution whose normals can be drawn so")
}

/// The surface of a profile that is none of the rows.
pub(crate) fn visible_of_profile<P>(profile: P, map: MapSpec) -> Box<dyn Visible>
where
    P: SampleVisibleProfile<f64> + SampleProfile<f64> + 'static,
{
    with_map!(f64, profile, map, surface => Box::new(surface))
}
