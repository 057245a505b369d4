//! A slope profile seen through a linear map of the tangent plane.

mod edge;

pub(crate) use edge::{in_view, turned_into_view};

use crate::Real;
use crate::error::Error;
use crate::map::{AxisAligned, Isotropic, Linear, Map, RoughnessMatrix, moved};
use crate::ndf::staged::{Forms, Solver, StagedVndf};
use crate::ndf::{Ndf, SampleNdf, SampleVndf, Vec2, Vec3};
use crate::profile::staged::StagedProfile;
use crate::profile::{Profile, SampleProfile, SampleVisibleProfile};
use crate::vector::{dot, normalized};

/// A microsurface: the isotropic slope profile `P` seen through the linear map `M` of the tangent
/// plane.
///
/// Anisotropy, roughness matrices and transforms of the microsurface are all maps, so whatever a
/// profile can do it can do under each of them, and transforming a surface gives a surface again.
/// The type of the map is its cost: [`Isotropic`](crate::Isotropic) (one number),
/// [`AxisAligned`](crate::AxisAligned) (two), [`Linear`] (three).
///
/// | | |
/// |---|---|
/// | build | [`Ggx::isotropic`](crate::Ggx::isotropic), [`anisotropic`](crate::Ggx::anisotropic), [`rotated`](crate::Ggx::rotated), [`from_roughness_matrix`](crate::Ggx::from_roughness_matrix); the same of [`Beckmann`](crate::Beckmann) and [`Gtr`](crate::Gtr) |
/// | evaluate | [`d`](Ndf::d), [`g1`](Ndf::g1), [`g2`](Ndf::g2), [`vndf`](Ndf::vndf), [`sigma`](Ndf::sigma), [`lambda`](Ndf::lambda), [`p22`](Ndf::p22) |
/// | sample | [`sample_vndf`](SampleVndf::sample_vndf), [`sample_d`](SampleNdf::sample_d) |
/// | move | [`transformed`](Self::transformed), [`stretched`](Self::stretched) |
/// | filter | [`filtered`](Self::filtered), and the module [`filter`](crate::filter) |
///
/// # Example
/// ```
/// use microsurface::{Ggx, Ndf, SampleVndf, glam::{Vec2, Vec3}};
/// let surface = Ggx::anisotropic(0.1_f32, 0.4)?;
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// let wm = surface.sample_vndf(wo, Vec2::new(0.3, 0.7));
/// assert!(wo.dot(wm) > 0.0 && surface.vndf(wo, wm) > 0.0);
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Microsurface<P, M> {
    profile: P,
    map: M,
}

impl<P, M> Microsurface<P, M> {
    /// The profile under the map.
    #[inline]
    #[must_use]
    pub const fn new(profile: P, map: M) -> Self {
        Self { profile, map }
    }

    /// The profile.
    #[inline]
    #[must_use]
    pub const fn profile(&self) -> &P {
        &self.profile
    }

    /// The map.
    #[inline]
    #[must_use]
    pub const fn map(&self) -> &M {
        &self.map
    }
}

impl<P, M: Map> Microsurface<P, M> {
    /// The roughness matrix A = RᵀR of the map, R = M⁻¹, to the last bit: the surface of it has the
    /// same map.
    ///
    /// It is the roughness of the whole surface for the shape-invariant profiles (GGX, Beckmann),
    /// whose own width is 1; for GTR it is what the map does to the profile.
    ///
    /// # Errors
    /// Never at present: every map is held.
    pub fn roughness_matrix(&self) -> Result<RoughnessMatrix<M::Scalar>, Error> {
        let [[r11, r12], [_, r22]] = self.map().inverse();
        Ok(RoughnessMatrix::of_factor([r11, r12, r22]))
    }
}

/// Converts to the most general map, for tables of surfaces of one type.
impl<P, T: Real> From<Microsurface<P, Isotropic<T>>> for Microsurface<P, Linear<T>> {
    #[inline]
    fn from(surface: Microsurface<P, Isotropic<T>>) -> Self {
        Self::new(surface.profile, surface.map.into())
    }
}

/// Converts to the most general map, for tables of surfaces of one type.
impl<P, T: Real> From<Microsurface<P, AxisAligned<T>>> for Microsurface<P, Linear<T>> {
    #[inline]
    fn from(surface: Microsurface<P, AxisAligned<T>>) -> Self {
        Self::new(surface.profile, surface.map.into())
    }
}

impl<P: Copy, M: Map> Microsurface<P, M> {
    /// The microsurface moved by `matrix`: every point p of the tangent plane goes to `matrix`·p,
    /// heights stay.
    ///
    /// D_M(wm) = |det M|/|Mᵀwm|⁴ · D(Mᵀwm/|Mᵀwm|), with M the matrix extended by 1 for the height.
    /// `s.transformed(a)?.transformed(b)?` is `s.transformed(b * a)?`.
    ///
    /// # Errors
    /// [`Error::Map`], with the determinant of `matrix`, if it is singular or not finite or takes a
    /// principal α out of [`alpha_range`](crate::roughness::alpha_range).
    ///
    /// # Example
    /// Stretching a surface to twice its length along x makes it half as rough along x.
    /// ```
    /// use microsurface::{Ggx, Ndf, glam::{Mat2, Vec2, Vec3}};
    /// let twice = Mat2::from_diagonal(Vec2::new(2.0, 1.0));
    /// let stretched = Ggx::isotropic(0.4_f32)?.transformed(twice)?;
    /// let wm = Vec3::new(0.3, 0.4, 0.866).normalize();
    /// assert!((stretched.d(wm) / Ggx::anisotropic(0.2, 0.4)?.d(wm) - 1.0).abs() < 1e-5);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    ///
    /// # References
    /// Atanasov, Koylazov, Dimov and Wilkie 2022, Eqs. 9 and 22.
    pub fn transformed(
        &self,
        matrix: <M::Scalar as Real>::Mat2,
    ) -> Result<Microsurface<P, Linear<M::Scalar>>, Error> {
        Ok(Microsurface::new(self.profile, moved(&self.map, matrix)?))
    }

    /// The microsurface stretched along x and compressed along y for s > 0, the other way round for
    /// s < 0: moved by diag(1/(1−s), 1−s) or diag(1+s, 1/(1+s)). A ratio of 5/2 along and 2/5
    /// across is s = 0.6.
    ///
    /// # Errors
    /// [`Error::Stretch`] unless −1 < s < 1, [`Error::Map`] where a principal α leaves its range.
    ///
    /// # References
    /// Atanasov, Koylazov, Dimov and Wilkie 2022, Eq. 31.
    pub fn stretched(&self, s: M::Scalar) -> Result<Microsurface<P, M::Stretched>, Error> {
        let one = M::Scalar::ONE;
        if !(s > -one && s < one) {
            return Err(Error::Stretch { value: s.to_f64() });
        }
        let (scale_x, scale_y) =
            if s >= M::Scalar::ZERO { (one / (one - s), one - s) } else { (one + s, one / (one + s)) };
        Ok(Microsurface::new(self.profile, self.map.stretched(scale_x, scale_y)?))
    }
}

impl<P: Profile<M::Scalar>, M: Map> Ndf for Microsurface<P, M> {
    type Scalar = M::Scalar;

    #[inline(always)]
    fn d(&self, wm: Vec3<Self>) -> M::Scalar {
        let m: [M::Scalar; 3] = wm.into();
        let d = self.profile.d(&self.map, m, M::Scalar::ONE);
        if m[2] < M::Scalar::ZERO { M::Scalar::ZERO } else { d }
    }

    #[inline(always)]
    fn d_along(&self, h: Vec3<Self>) -> M::Scalar {
        let h: [M::Scalar; 3] = h.into();
        self.profile.d(&self.map, h, dot(h, h))
    }

    #[inline(always)]
    fn d_times(&self, m: Vec3<Self>, length2: M::Scalar, fraction: [M::Scalar; 2]) -> M::Scalar {
        self.profile.d_times(&self.map, m.into(), length2, fraction)
    }

    #[inline(always)]
    fn masked_cosines(&self, wi: Vec3<Self>, wo: Vec3<Self>) -> M::Scalar {
        let [i, o]: [[M::Scalar; 3]; 2] = [wi.into(), wo.into()];
        let [i, o] = [i, o].map(|w| [self.map.direction_term(w), w[2]]);
        self.profile.masked_cosines(i, o)
    }

    #[inline(always)]
    fn p22(&self, slope: Vec2<Self>) -> M::Scalar {
        let [x, y]: [M::Scalar; 2] = slope.into();
        self.profile.d(&self.map, [-x, -y, M::Scalar::ONE], M::Scalar::ONE)
    }

    #[inline(always)]
    fn sigma(&self, w: Vec3<Self>) -> M::Scalar {
        let w: [M::Scalar; 3] = w.into();
        let s2 = self.map.direction_term(w);
        // Both of |z|, so that they share what they have in common.
        let z = w[2].abs();
        if w[2] < M::Scalar::ZERO {
            self.profile.sigma_backfacing(s2, z)
        } else {
            self.profile.sigma_above(s2, z)
        }
    }

    #[inline(always)]
    fn sigma_above(&self, w: Vec3<Self>) -> M::Scalar {
        let w: [M::Scalar; 3] = w.into();
        self.profile.sigma_above(self.map.direction_term(w), w[2])
    }

    #[inline(always)]
    fn lambda(&self, w: Vec3<Self>) -> M::Scalar {
        let w: [M::Scalar; 3] = w.into();
        let [x, y, z] = w;
        let lambda = self.profile.lambda(&self.map, [x, y, z.abs()]);
        if z < M::Scalar::ZERO { -M::Scalar::ONE - lambda } else { lambda }
    }
}

impl<P: Forms, M: Copy> Forms for Microsurface<P, M> {
    #[inline(always)]
    fn form(&self) -> usize {
        self.profile.form()
    }

    #[inline(always)]
    fn with_form(self, form: usize) -> Self {
        Self { profile: self.profile.with_form(form), map: self.map }
    }
}

impl<P: SampleProfile<M::Scalar>, M: Map> SampleNdf for Microsurface<P, M> {
    #[inline(always)]
    fn sample_d(&self, u: Vec2<Self>) -> Vec3<Self> {
        normalized(self.map.push_normal(self.profile.sample_d(u.into()))).into()
    }
}

impl<P: SampleVisibleProfile<M::Scalar>, M: Map> SampleVndf for Microsurface<P, M> {
    #[inline(always)]
    fn sample_vndf(&self, w: Vec3<Self>, u: Vec2<Self>) -> Vec3<Self> {
        normalized(self.sample_vndf_along(w, u).into()).into()
    }

    #[inline(always)]
    fn sample_vndf_along(&self, w: Vec3<Self>, u: Vec2<Self>) -> Vec3<Self> {
        let w: [M::Scalar; 3] = w.into();
        let (v, s2) = (self.map.pull_direction(w), self.map.direction_term(w));
        let m = self.profile.sample_visible(v, s2, u.into());
        turned_into_view(w, self.map.push_normal(m)).into()
    }
}

impl<P: StagedProfile<M::Scalar>, M: Map> StagedVndf for Microsurface<P, M> {
    const STRAIGHT: bool = P::STRAIGHT;
    type Solver = P::Solver;

    #[inline(always)]
    fn ask(&self, w: Vec3<Self>, u: Vec2<Self>) -> <P::Solver as Solver>::Question {
        let w: [M::Scalar; 3] = w.into();
        self.profile.ask(self.map.pull_direction(w), self.map.direction_term(w), u.into())
    }

    #[inline(always)]
    fn normal(
        &self,
        w: Vec3<Self>,
        u: Vec2<Self>,
        answer: <P::Solver as Solver>::Answer,
    ) -> (Vec3<Self>, bool) {
        let w: [M::Scalar; 3] = w.into();
        let (v, s2) = (self.map.pull_direction(w), self.map.direction_term(w));
        let (m, usual) = self.profile.normal(v, s2, u.into(), answer);
        let m = self.map.push_normal(m);
        (m.into(), usual && in_view(w, m))
    }

    #[inline(always)]
    fn sample_of_along(&self, along: Vec3<Self>) -> Vec3<Self> {
        normalized(along.into()).into()
    }
}

/// The constructors of a profile without parameters of its own, whose width is the map's.
macro_rules! shape_invariant {
    ($profile:ident) => {
        impl crate::profile::ShapeInvariant for $profile {}

        impl $profile {
            /// The distribution of slope width α in every direction.
            ///
            /// # Errors
            /// [`Error::Alpha`](crate::Error::Alpha) unless α is within
            /// [`alpha_range`](crate::roughness::alpha_range).
            #[inline]
            pub fn isotropic<T: crate::Real>(
                alpha: T,
            ) -> Result<crate::Microsurface<Self, crate::Isotropic<T>>, crate::Error> {
                Ok(crate::Microsurface::new(Self, crate::Isotropic::new(alpha)?))
            }

            /// The distribution of slope widths αx along x and αy along y.
            ///
            /// # Errors
            /// [`Error::Alpha`](crate::Error::Alpha) unless both are within
            /// [`alpha_range`](crate::roughness::alpha_range).
            #[inline]
            pub fn anisotropic<T: crate::Real>(
                alpha_x: T,
                alpha_y: T,
            ) -> Result<crate::Microsurface<Self, crate::map::AxisAligned<T>>, crate::Error> {
                Ok(crate::Microsurface::new(Self, crate::map::AxisAligned::new(alpha_x, alpha_y)?))
            }

            /// The distribution of slope widths α = `alpha_x` along the direction at `angle`
            /// radians from x, and `alpha_y` across it.
            ///
            /// No α is squared, so every ratio of the widths is held; see
            /// [`RoughnessMatrix::rotated`](crate::RoughnessMatrix::rotated).
            ///
            /// # Errors
            /// [`Error::Alpha`](crate::Error::Alpha) unless both are within
            /// [`alpha_range`](crate::roughness::alpha_range),
            /// [`Error::Parameter`](crate::Error::Parameter) if the angle is not finite.
            #[inline]
            pub fn rotated<T: crate::Real>(
                alpha_x: T,
                alpha_y: T,
                angle: T,
            ) -> Result<crate::Microsurface<Self, crate::map::Linear<T>>, crate::Error> {
                Ok(Self::from_roughness_matrix(crate::RoughnessMatrix::rotated(alpha_x, alpha_y, angle)?))
            }

            /// The distribution of a roughness matrix A: slope widths that differ along any two
            /// directions.
            #[inline]
            #[must_use]
            pub fn from_roughness_matrix<T: crate::Real>(
                matrix: crate::RoughnessMatrix<T>,
            ) -> crate::Microsurface<Self, crate::map::Linear<T>> {
                crate::Microsurface::new(Self, crate::map::Linear::from(matrix))
            }
        }
    };
}
pub(crate) use shape_invariant;
