//! Reflection by a rough conductor.

use crate::Real;
use crate::bsdf::Sample;
use crate::bsdf::sampling::{NormalSampling, VisibleNormals};
use crate::filter::{Footprint, MeanOverParallelogram, polygon};
use crate::fresnel::{Fresnel, Spectrum};
use crate::map::Map;
use crate::microsurface::Microsurface;
use crate::ndf::staged::Forms;
use crate::ndf::{Ndf, Vec2, Vec3, cosine_scale};
use crate::vector::dot;

/// Single reflection off a rough surface of any distribution and Fresnel term, with
/// height-correlated masking.
///
/// f = F D G2/(4 zi zo), evaluated as F D/(4 (zo σ(wi) + zi σ(wo) − zi zo)), which has no cosine in
/// a denominator, with D of the half vector wi + wo, which is not normalised (see
/// [`Ndf::d_along`]).
///
/// # Domain
/// Unit vectors. The cosine between either direction and the half vector is ½|wi + wo| for those
/// alone: the cosines of wi and of wo differ by 2 (|wi|² − |wo|²)/|wi + wo|² of it otherwise, which
/// matters where wi ≈ −wo.
///
/// # Special cases
/// A direction at or below the horizon → f = pdf = 0 and no sample. Where |wi + wo|² < 2⁻⁶⁴ (f32)
/// or 2⁻⁵¹² (f64), which unit vectors above the horizon reach only within 3e-10 (f32) of it and
/// opposite to each other → 0. f itself grows without bound as both directions approach the
/// horizon. It is held at the largest number of the scalar once 4 zi zo/G2 is smaller than D over
/// that; f wi.z does not overflow.
///
/// # Example
/// ```
/// use microsurface::{Ggx, bsdf::RoughConductor, fresnel::Schlick, glam::{Vec2, Vec3}};
/// let f0 = Schlick::new(Vec3::new(1.0, 0.78, 0.34))?;
/// let gold = RoughConductor::new(Ggx::isotropic(0.2_f32)?, f0);
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// let sample = gold.sample(wo, Vec2::new(0.4, 0.6)).expect("above the horizon");
/// let f = gold.eval(sample.wi, wo);
/// assert!((f * sample.wi.z / sample.pdf - sample.weight).length() < 1e-5);
/// assert!((gold.pdf(sample.wi, wo) / sample.pdf - 1.0).abs() < 1e-4);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Torrance and Sparrow 1967; Walter, Marschner, Li and Torrance 2007, Eq. 20; Heitz 2014.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("bsdf", "brdf", "CookTorrance", "reflection", "metal"))]
pub struct RoughConductor<N, F, S = VisibleNormals> {
    surface: N,
    fresnel: F,
    sampling: S,
}

impl<N, F> RoughConductor<N, F> {
    /// The surface with a Fresnel term, sampled by its visible normals.
    #[inline]
    #[must_use]
    pub const fn new(surface: N, fresnel: F) -> Self {
        Self { surface, fresnel, sampling: VisibleNormals }
    }
}

impl<N, F, S> RoughConductor<N, F, S> {
    /// This BRDF with another choice of normals to sample.
    #[inline]
    #[must_use]
    pub fn sampled_by<R>(self, sampling: R) -> RoughConductor<N, F, R> {
        RoughConductor { surface: self.surface, fresnel: self.fresnel, sampling }
    }

    /// This BRDF with another Fresnel term:
    /// [`Perfect`](crate::fresnel::Perfect) for a furnace.
    #[inline]
    #[must_use]
    pub fn with_fresnel<G>(self, fresnel: G) -> RoughConductor<N, G, S> {
        RoughConductor { surface: self.surface, fresnel, sampling: self.sampling }
    }

    /// The microsurface.
    #[inline]
    #[must_use]
    pub const fn surface(&self) -> &N {
        &self.surface
    }

    /// This BRDF on another microsurface.
    #[inline(always)]
    pub(crate) fn with_surface<R>(self, surface: R) -> RoughConductor<R, F, S> {
        RoughConductor { surface, fresnel: self.fresnel, sampling: self.sampling }
    }

    /// The choice of normals.
    #[inline(always)]
    pub(crate) const fn sampling(&self) -> &S {
        &self.sampling
    }

    /// The Fresnel term.
    #[inline]
    #[must_use]
    pub const fn fresnel(&self) -> &F {
        &self.fresnel
    }
}

impl<N: Forms, F: Copy, S: Copy> Forms for RoughConductor<N, F, S> {
    #[inline(always)]
    fn form(&self) -> usize {
        self.surface.form()
    }

    #[inline(always)]
    fn with_form(self, form: usize) -> Self {
        Self { surface: self.surface.with_form(form), ..self }
    }
}

/// Limits ∞ to the largest number, so that a reflectance of 0 times it is 0; NaN stays NaN.
#[inline(always)]
fn finite<T: Real>(f: T) -> T {
    if f > T::MAX { T::MAX } else { f }
}

/// The half vector wi + wo, not normalised, and whether anything is reflected.
struct Half<T> {
    h: [T; 3],
    length2: T,
    /// Neither direction is at or below the horizon.
    above: bool,
    /// Above, and the half vector has not vanished.
    reflects: bool,
}

impl<T: Real> Half<T> {
    #[inline(always)]
    fn new([ix, iy, iz]: [T; 3], [ox, oy, oz]: [T; 3]) -> Self {
        let h = [ix + ox, iy + oy, iz + oz];
        let length2 = dot(h, h);
        // α²|h|² of the smallest α must keep its digits: the root of the smallest normal number.
        let shortest2 = T::lit(if T::WIDENS { 5.421010862427522e-20 } else { 7.458340731200207e-155 });
        let below = iz <= T::ZERO || oz <= T::ZERO;
        let dark = below || length2 < shortest2;
        Self { h, length2, above: !below, reflects: !dark }
    }

    /// The cosine between either direction and the normal between them, ½|wi + wo|.
    #[inline(always)]
    fn cosine(&self) -> T {
        T::HALF * self.length2.sqrt()
    }

    /// The value where light is reflected, 0 elsewhere.
    #[inline(always)]
    fn select(&self, value: T) -> T {
        if self.reflects { value } else { T::ZERO }
    }
}

impl<N, F, S> RoughConductor<N, F, S>
where
    N: Ndf,
    F: Fresnel,
    F::Output: Spectrum<Scalar = N::Scalar>,
{
    /// f(wi, wo), 1/sr, without the cosine; symmetric in wi and wo.
    #[inline(always)]
    #[must_use]
    pub fn eval(&self, wi: Vec3<N>, wo: Vec3<N>) -> F::Output {
        let half = Half::<N::Scalar>::new(wi.into(), wo.into());
        let per_d = [Self::quarter(), self.surface.masked_cosines(wi, wo)];
        let f = self.surface.d_times(half.h.into(), half.length2, per_d);
        self.fresnel.reflectance(half.cosine()).scaled(half.select(finite(f)))
    }

    /// ¼ in the scale of the masked cosines.
    #[inline(always)]
    fn quarter() -> N::Scalar {
        N::Scalar::lit(0.25) * cosine_scale::<N::Scalar>()
    }
}

impl<P, M, F, S> RoughConductor<Microsurface<P, M>, F, S>
where
    P: MeanOverParallelogram<M::Scalar>,
    M: Map,
    F: Fresnel,
    F::Output: Spectrum<Scalar = M::Scalar>,
{
    /// f(wi, wo) for a pixel whose half vectors cover a footprint in slopes: D is averaged over it,
    /// Fresnel and masking are those of its centre.
    ///
    /// The mean of P22 over the parallelogram ([`polygon::mean_p22`]) over wm.z⁴ in the place of D.
    ///
    /// # Domain
    /// Footprints of up to 1 in slopes: [`clamped(1.0)`](Footprint::clamped) makes them so. Where
    /// the half vector is near the horizon, a parallelogram of first order may reach the highlight
    /// from there, and wm.z⁻⁴ of its centre makes a pixel of it that is thousands of times too
    /// bright.
    ///
    /// # Special cases
    /// A footprint of a point → [`eval`](Self::eval); one that is not finite, NaN too → 0, unless
    /// it is [`clamped`](Footprint::clamped).
    ///
    /// # Example
    /// ```
    /// use microsurface::bsdf::RoughConductor;
    /// use microsurface::{Ggx, filter::Footprint, fresnel::Schlick, glam::{Vec2, Vec3}};
    /// let chrome = RoughConductor::new(Ggx::isotropic(0.01_f32)?, Schlick::new(0.6_f32)?);
    /// let (wi, wo) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.535, 0.0, 0.8448521));
    /// // The highlight is beside the centre of the pixel, and within it.
    /// let pixel = Footprint::new(Vec2::new(0.1, 0.0), Vec2::new(0.0, 0.1));
    /// assert!(chrome.eval_over(wi, wo, pixel) > 3.0 * chrome.eval(wi, wo));
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    ///
    /// # References
    /// Kaplanyan, Hill, Patney and Lefohn 2016, Eqs. 9–11.
    #[must_use]
    pub fn eval_over(
        &self,
        wi: <M::Scalar as Real>::Vec3,
        wo: <M::Scalar as Real>::Vec3,
        footprint: Footprint<M::Scalar>,
    ) -> F::Output {
        let half = Half::<M::Scalar>::new(wi.into(), wo.into());
        let [x, y, z] = half.h;
        let [du, dv] = footprint.steps();
        let mean = polygon::mean_p22(&self.surface, [-x / z, -y / z].into(), du, dv);
        let secant2 = half.length2 / (z * z);
        let f = Self::quarter() * (mean * secant2 * secant2) / self.surface.masked_cosines(wi, wo);
        // At the very horizon the mean is 0 and the secant may be infinite.
        let f = if mean == M::Scalar::ZERO || !footprint.is_finite() { M::Scalar::ZERO } else { f };
        self.fresnel.reflectance(half.cosine()).scaled(half.select(finite(f)))
    }
}

impl<N, F, S> RoughConductor<N, F, S>
where
    N: Ndf,
    F: Fresnel,
    F::Output: Spectrum<Scalar = N::Scalar>,
    S: NormalSampling<N>,
{
    /// The density with which [`sample`](Self::sample) draws `wi`, 1/sr.
    ///
    /// Its integral over the upper hemisphere is below 1 by the share of normals that reflect below
    /// the horizon.
    ///
    /// # Special cases
    /// No half vector, but both directions above the horizon → the constant part of the density
    /// alone.
    #[inline(always)]
    #[must_use]
    pub fn pdf(&self, wi: Vec3<N>, wo: Vec3<N>) -> N::Scalar {
        let half = Half::<N::Scalar>::new(wi.into(), wo.into());
        let wo_h = N::Scalar::HALF * half.length2;
        let per_d =
            self.sampling.density_over_d(&self.surface, wo, self.surface.sigma_above(wo), wo_h, half.h[2]);
        let of_normals = half.select(self.surface.d_times(half.h.into(), half.length2, per_d));
        match self.sampling.constant_density() {
            None => of_normals,
            Some(constant) => of_normals + if half.above { constant } else { N::Scalar::ZERO },
        }
    }

    /// A direction to the light for the viewer `wo`, from two random numbers.
    ///
    /// The weight F zi σ(wo)/(zo σ(wi) + zi σ(wo) − zi zo) of visible normals contains neither D
    /// nor a division by a cosine. It is at most F, to a rounding: (1 + 2ε) F is the largest found.
    ///
    /// # Returns
    /// `None` where nothing is reflected: `wo` at or below the horizon, or a normal that reflects
    /// below it, whose energy further bounces would carry.
    #[inline(always)]
    #[must_use]
    pub fn sample(&self, wo: Vec3<N>, u: Vec2<N>) -> Option<Sample<N::Scalar, F::Output>> {
        let (up, sample) = self.reflected_by(wo, self.sampling.sample_along(&self.surface, wo, u));
        if up { Some(sample) } else { None }
    }

    /// The sample of a normal, given by a vector along it, with weight and density 0 in place of
    /// `None`, and a wi of no meaning.
    #[inline(always)]
    pub(crate) fn reflected_or_nothing(&self, wo: Vec3<N>, m: Vec3<N>) -> Sample<N::Scalar, F::Output> {
        let (up, Sample { wi, weight, pdf }) = self.reflected_by(wo, m);
        let select = |value| if up { value } else { N::Scalar::ZERO };
        Sample { wi, weight: weight.map(select), pdf: select(pdf) }
    }

    /// Whether the normal along m reflects anything, and the sample, which is meaningless where it
    /// does not.
    ///
    /// The mirror image is 2 (wo·m)/|m|² m − wo: a normalised m would be waited for.
    #[inline(always)]
    fn reflected_by(&self, wo: Vec3<N>, along: Vec3<N>) -> (bool, Sample<N::Scalar, F::Output>) {
        let o: [N::Scalar; 3] = wo.into();
        let m: [N::Scalar; 3] = along.into();
        let wo_m = dot(o, m);
        let length2 = dot(m, m);
        let factor = (wo_m + wo_m) / length2;
        let i = [factor * m[0] - o[0], factor * m[1] - o[1], factor * m[2] - o[2]];
        let up = o[2] > N::Scalar::ZERO && i[2] > N::Scalar::ZERO && wo_m > N::Scalar::ZERO;
        let per_d = self.sampling.density_over_d(&self.surface, wo, self.surface.sigma_above(wo), wo_m, m[2]);
        let masked = self.surface.masked_cosines(i.into(), wo);
        let (pdf, weight) = match self.sampling.constant_density() {
            None => (
                self.surface.d_times(along, length2, per_d),
                Self::quarter() * i[2] * per_d[1] / (per_d[0] * masked),
            ),
            Some(constant) => {
                let d = self.surface.d_along(along);
                let pdf = d * per_d[0] / per_d[1] + constant;
                // D/pdf first: neither it nor what it multiplies leaves the range of the scalar.
                (pdf, Self::quarter() * i[2] * (d / pdf) / masked)
            }
        };
        let cos = (N::Scalar::HALF * factor * wo_m).sqrt();
        (up, Sample { wi: i.into(), weight: self.fresnel.reflectance(cos).scaled(weight), pdf })
    }
}
