//! A mixture of two distributions on one surface.

use crate::Real;
use crate::error::Error;
use crate::ndf::staged::{Forms, Solver, StagedVndf};
use crate::ndf::{Ndf, SampleNdf, SampleVndf, Vec2, Vec3};
use crate::vector::{below_one, normalized};

/// A surface a share of which has the distribution `B` and the rest `A`: D = (1 − t) D_A + t D_B.
///
/// The patches are mixed below the size that a viewer resolves, and at all heights alike. Then area
/// is added: σ and Λ are the same mixture as D, and so are visible normals, with the probabilities
/// (1 − t) σ_A(w) and t σ_B(w). Interpolating G1 or two finished BRDFs instead is not the same: see
/// the reference.
///
/// Blends nest to any depth. A narrow lobe over a wide one is haze.
///
/// # Example
/// A polished metal with a haze of a tenth about its highlight.
/// ```
/// use microsurface::{Blend, Ggx, Ndf, bsdf::RoughConductor, fresnel::Schlick, glam::{Vec2, Vec3}};
/// let surface = Blend::new(Ggx::isotropic(0.05_f32)?, Ggx::isotropic(0.4)?, 0.1)?;
/// let material = RoughConductor::new(surface, Schlick::new(0.9_f32)?);
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// assert!(material.sample(wo, Vec2::new(0.3, 0.7)).is_some());
/// let [narrow, wide] = [surface.first(), surface.second()].map(|part| part.sigma(wo));
/// assert!((surface.sigma(wo) - (0.9 * narrow + 0.1 * wide)).abs() < 1e-6);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # Numerics
/// Rounding adds 2 ε to the errors of the parts, relatively, since nothing is subtracted.
///
/// # References
/// d'Eon, Bitterli, Weidlich and Zeltner 2023, "Microfacet theory for non-uniform heightfields".
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("mixture", "haze"))]
pub struct Blend<A: Ndf, B> {
    first: A,
    second: B,
    /// 1 − t and t, which add up to 1 exactly.
    shares: [A::Scalar; 2],
}

impl<A: Ndf, B: Ndf<Scalar = A::Scalar>> Blend<A, B> {
    /// The mixture of a share t of `second` and 1 − t of `first`.
    ///
    /// t is rounded to a multiple of ε/2.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless 0 ≤ t ≤ 1.
    #[inline]
    pub fn new(first: A, second: B, share_of_second: A::Scalar) -> Result<Self, Error> {
        let one = A::Scalar::ONE;
        if !(share_of_second >= A::Scalar::ZERO && share_of_second <= one) {
            let value = share_of_second.to_f64();
            return Err(Error::Parameter { name: "share_of_second", value, smallest: 0.0, largest: 1.0 });
        }
        // The second difference is exact (Sterbenz).
        let rest = one - share_of_second;
        Ok(Self { first, second, shares: [rest, one - rest] })
    }

    /// The first distribution.
    #[inline]
    #[must_use]
    pub const fn first(&self) -> &A {
        &self.first
    }

    /// The second distribution.
    #[inline]
    #[must_use]
    pub const fn second(&self) -> &B {
        &self.second
    }

    /// t, the share of the second.
    #[inline]
    #[must_use]
    pub fn share_of_second(&self) -> A::Scalar {
        self.shares[1]
    }

    /// The mixture of two numbers.
    #[inline(always)]
    fn mixed(&self, first: A::Scalar, second: A::Scalar) -> A::Scalar {
        self.shares[0] * first + self.shares[1] * second
    }

    /// Whether u.y falls on the first of two parts, and the random numbers that are left.
    ///
    /// A part whose share is lost in the rounding of both is not chosen, nor by a u below ε/4,
    /// which counts as ε/4: its normals would have no density.
    #[inline(always)]
    fn choose(parts: [A::Scalar; 2], u: Vec2<Self>) -> (bool, Vec2<Self>) {
        let [u1, u2]: [A::Scalar; 2] = u.into();
        let least = A::Scalar::lit(0.25) * A::Scalar::EPSILON;
        let [first, second] = parts;
        let target = below_one(u2).max(least) * (first + second);
        let is_first = target < first;
        let left = if is_first { target / first } else { (target - first) / second };
        // Seen from straight below both parts are 0.
        let left = if left >= A::Scalar::ZERO { below_one(left) } else { u2 };
        (is_first, [u1, left].into())
    }

    /// The areas of both parts seen from w.
    #[inline(always)]
    fn areas(&self, w: Vec3<Self>) -> [A::Scalar; 2] {
        [self.shares[0] * self.first.sigma(w), self.shares[1] * self.second.sigma(w)]
    }
}

impl<A: Ndf, B: Ndf<Scalar = A::Scalar>> Ndf for Blend<A, B> {
    type Scalar = A::Scalar;

    #[inline(always)]
    fn d(&self, wm: Vec3<A>) -> A::Scalar {
        self.mixed(self.first.d(wm), self.second.d(wm))
    }

    #[inline(always)]
    fn sigma(&self, w: Vec3<A>) -> A::Scalar {
        self.mixed(self.first.sigma(w), self.second.sigma(w))
    }

    /// −1 − Λ(−w) below the horizon as above it, since the shares add up to 1.
    #[inline(always)]
    fn lambda(&self, w: Vec3<A>) -> A::Scalar {
        self.mixed(self.first.lambda(w), self.second.lambda(w))
    }

    #[inline(always)]
    fn sigma_above(&self, w: Vec3<A>) -> A::Scalar {
        self.mixed(self.first.sigma_above(w), self.second.sigma_above(w))
    }

    #[inline(always)]
    fn d_along(&self, h: Vec3<A>) -> A::Scalar {
        self.mixed(self.first.d_along(h), self.second.d_along(h))
    }

    #[inline(always)]
    fn d_times(&self, m: Vec3<A>, length2: A::Scalar, fraction: [A::Scalar; 2]) -> A::Scalar {
        self.mixed(self.first.d_times(m, length2, fraction), self.second.d_times(m, length2, fraction))
    }

    /// Linear in σ, so that the parts keep their own forms.
    #[inline(always)]
    fn masked_cosines(&self, wi: Vec3<A>, wo: Vec3<A>) -> A::Scalar {
        self.mixed(self.first.masked_cosines(wi, wo), self.second.masked_cosines(wi, wo))
    }

    #[inline(always)]
    fn p22(&self, slope: Vec2<A>) -> A::Scalar {
        self.mixed(self.first.p22(slope), self.second.p22(slope))
    }
}

impl<A: SampleNdf, B: SampleNdf<Scalar = A::Scalar>> SampleNdf for Blend<A, B> {
    /// u.y chooses the part, and what is left of it draws from it.
    #[inline(always)]
    fn sample_d(&self, u: Vec2<A>) -> Vec3<A> {
        let (is_first, u) = Self::choose(self.shares, u);
        if is_first { self.first.sample_d(u) } else { self.second.sample_d(u) }
    }
}

impl<A: SampleVndf, B: SampleVndf<Scalar = A::Scalar>> SampleVndf for Blend<A, B> {
    #[inline(always)]
    fn sample_vndf(&self, w: Vec3<A>, u: Vec2<A>) -> Vec3<A> {
        normalized(self.sample_vndf_along(w, u).into()).into()
    }

    /// u.y chooses the part by its share of what is seen, and what is left of it draws from it.
    #[inline(always)]
    fn sample_vndf_along(&self, w: Vec3<A>, u: Vec2<A>) -> Vec3<A> {
        let (is_first, u) = Self::choose(self.areas(w), u);
        if is_first { self.first.sample_vndf_along(w, u) } else { self.second.sample_vndf_along(w, u) }
    }
}

impl<A: Ndf + Copy, B: Copy> Forms for Blend<A, B> {}

impl<A, B> StagedVndf for Blend<A, B>
where
    A: SampleVndf + Copy,
    B: SampleVndf<Scalar = A::Scalar> + Copy,
{
    /// The choice of a part branches.
    const STRAIGHT: bool = false;
    type Solver = ();

    #[inline(always)]
    fn ask(&self, _: Vec3<A>, _: Vec2<A>) {}

    #[inline(always)]
    fn normal(&self, w: Vec3<A>, u: Vec2<A>, (): <() as Solver>::Answer) -> (Vec3<A>, bool) {
        (self.sample_vndf_along(w, u), true)
    }

    #[inline(always)]
    fn sample_of_along(&self, along: Vec3<A>) -> Vec3<A> {
        normalized(along.into()).into()
    }
}
