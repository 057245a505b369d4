//! GGX convolved with a Gaussian, its tail kept.
//!
//! GGX is a mixture of Beckmann surfaces of all precisions: with x distributed as e^{−x}, GGX(A) is
//! the mean of Beckmann(A/x). Convolution with a Gaussian of covariance Σ adds 2Σ to each of them,
//! so that exactly
//!
//! GGX(A) ⊛ N(Σ) = ∫₀^∞ e^{−x} Beckmann(A/x + 2Σ) dx.
//!
//! Its core becomes the Gaussian, its tail stays that of GGX(A): the far slopes are too far to be
//! moved. The proxy GGX(A + 2Σ) has neither: for σ = α its peak is 24 % too high and its tail 3
//! times, for σ = 2α 9 times too bright; four tenths of the light can be at wrong slopes.
//!
//! [`filtered`] is a mixture of surfaces of its own: a GGX of weight such that the tail is right,
//! and Beckmann surfaces, each filtered exactly. Being a mixture, it has exact masks and samplers.
//! [`p22`] is the integral itself.
//!
//! | form | light at wrong slopes, ½ ∫ \|ΔP22\| | at the peak | tail |
//! |---|---|---|---|
//! | proxy, [`Microsurface::filtered`] | 20 % | +24 % | times 1 + 2σ²/α² |
//! | [`filtered_by_two`] | 3.2 %, long kernels 12.5 % | ±2.4 %, long kernels ±5 % | right, long kernels see below; on the way to it ±19 % for σ ≤ α, 33 % beyond |
//! | [`filtered`] | 0.5 %, long kernels 1.3 % | ±1.2 % | right; on the way to it ±9 % for σ ≤ α, 33 % beyond |
//!
//! Each is the largest error found over kernels up to 8000 α wide: those that are as wide in every
//! direction, and long ones of every elongation, lines too (`tests/it/filter/convolution.rs`). A
//! line is the kernel of a footprint without width. Across it, on the way to the tail, where next
//! to nothing is reflected, the three are too bright by a factor of up to 29,000, 250 and 4.7 for σ
//! up to 22 α.
//!
//! The far tail of [`filtered_by_two`] is that of its GGX, which a long kernel makes long: it is
//! too bright along the kernel by the ratio of the larger to the smaller α² of that GGX, and too
//! dark across it by the same.

use crate::Real;
use crate::beckmann::Beckmann;
use crate::elementary::exp;
use crate::error::Error;
use crate::filter::Covariance;
use crate::ggx::Ggx;
use crate::map::{Gram, Linear, Map, Sums, factor, seen_by_profile};
use crate::microsurface::Microsurface;
use crate::ndf::staged::{Forms, StagedVndf};
use crate::ndf::{Ndf, SampleNdf, SampleVndf, Vec2, Vec3};
use crate::vector::{at_least_cosine, below_one, positive_part};

/// GGX(1) as a GGX of this squared width, whose weight is its inverse, …
const TAIL: f64 = 8.0;
/// … and Beckmann surfaces of precision x and weight w: relative error of P22 at most 1.9 %.
///
/// Fitted by `tests/reference/filter_gaussian.py`.
const CORES: [[f64; 2]; 5] = [
    [2.442610401279616, 0.2552030256822747],
    [0.7412834248928926, 0.41505585742956186],
    [0.227264188159371, 0.173146990988917],
    [0.06334699511808564, 0.029525593820757555],
    [0.012838625643086753, 0.00206853207848876],
];

/// How a GGX of width 1 widens under a kernel 2Σ: the GGX that keeps its tail is that of I + k 2Σ,
/// the Gaussian of what is left that of c (I + 2Σ).
///
/// For an isotropic 2Σ = s I both are rational in √s. Others take the same of their geometric mean,
/// √det(I + 2Σ) = 1 + s, corrected by their elongation. Fitted to the convolution by
/// `tests/reference/filter_gaussian.py`.
#[inline(always)]
fn widening(kernel: &Principal) -> (f64, f64) {
    let Principal { geometric: s, larger, smaller } = *kernel;
    let r = Real::sqrt(s);
    let k =
        1.67179 * (1.0 + r * (2.14821 + r * 0.38614)) / (1.0 + r * (2.37567 + r * (2.27974 + r * 0.0741)));
    let c = 1.0 + (0.11355 + r * (0.75467 + r * 0.08572)) / (1.0 + r * (0.21039 + r * (0.6077 + r * 0.1203)));
    // 0 of isotropic kernels, 1 of a long line.
    let long = 1.0 - Real::sqrt((1.0 + smaller) / (1.0 + larger));
    let r = Real::sqrt(smaller);
    let of_lines = (0.08372 + (0.25599 * r - 0.00896) * r) / (1.0 + 0.60117 * smaller * r);
    (k * (1.0 - 0.4002 * long * long), c + long * (long * of_lines + 0.181 * (1.0 - long)))
}

/// The eigenvalues of 2Σ where A is I, and the s of √det(I + 2Σ) = 1 + s.
struct Principal {
    geometric: f64,
    larger: f64,
    smaller: f64,
}

/// A mixture of one GGX and N Beckmann surfaces: a GGX convolved with a Gaussian.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilteredGgx<T, const N: usize> {
    tail: Tail<T>,
    cores: [Core<T>; N],
}

/// A surface and its weight.
type Tail<T> = (T, Microsurface<Ggx, Linear<T>>);
type Core<T> = (T, Microsurface<Beckmann, Linear<T>>);

/// GGX(A) ⊛ N(Σ) as a GGX and six Beckmann surfaces.
///
/// # Errors
/// [`Error::Covariance`] if Σ is not finite, or with A leaves
/// [`alpha_range`](crate::roughness::alpha_range).
///
/// # Accuracy
/// See the table of the [module](self); at Σ = 0 P22 is GGX to a relative 1.9 %, so for σ below 0.1
/// α nothing is nearer than no filter. [`Microsurface::change_by_filter`] tells; it is 0.02 there.
///
/// # Example
/// ```
/// use microsurface::{Ggx, Ndf, filter::{Footprint, gaussian}, glam::Vec2};
/// let surface = Ggx::isotropic(0.02_f32)?;
/// let kernel = Footprint::new(Vec2::new(0.1, 0.0), Vec2::new(0.0, 0.06)).covariance(0.25);
/// let filtered = gaussian::filtered(&surface, kernel)?;
/// // Far out it is the unfiltered surface, and the proxy is not.
/// let far = Vec2::new(3.0, 0.0);
/// assert!((filtered.p22(far) / surface.p22(far) - 1.0).abs() < 0.02);
/// assert!(surface.filtered(kernel)?.p22(far) > 5.0 * surface.p22(far));
/// # Ok::<(), microsurface::Error>(())
/// ```
#[inline]
pub fn filtered<M: Map>(
    surface: &Microsurface<Ggx, M>,
    covariance: Covariance<M::Scalar>,
) -> Result<FilteredGgx<M::Scalar, 6>, Error> {
    let of_seven = || {
        let mixture = Mixture::new(surface, covariance);
        let (tail, rest) = mixture.tail(TAIL, false)?;
        let mut cores = [rest; 6];
        for (core, [x, w]) in cores.iter_mut().zip(CORES) {
            *core = mixture.core(w, 1.0 / x, 1.0)?;
        }
        Some(FilteredGgx { tail, cores })
    };
    of_seven().ok_or_else(|| covariance.refused())
}

/// GGX(A) ⊛ N(Σ) as a GGX and one Beckmann surface: cheaper, exact at Σ = 0, best for kernels that
/// are about as wide in every direction. Across a long kernel GGX has a tail that no Gaussian has.
///
/// # Errors
/// As [`filtered`].
///
/// # Accuracy
/// See the table of the [module](self).
#[inline(always)]
pub fn filtered_by_two<M: Map>(
    surface: &Microsurface<Ggx, M>,
    covariance: Covariance<M::Scalar>,
) -> Result<FilteredGgx<M::Scalar, 1>, Error> {
    match Mixture::new(surface, covariance).tail(1.0, true) {
        Some((tail, rest)) => Ok(FilteredGgx { tail, cores: [rest] }),
        None => Err(covariance.refused()),
    }
}

/// The matrices that components are made of.
struct Mixture {
    /// a A + b Σ.
    sums: Sums,
    /// √det A.
    area: f64,
}

impl Mixture {
    #[inline(always)]
    fn new<M: Map>(surface: &Microsurface<Ggx, M>, covariance: Covariance<M::Scalar>) -> Self {
        let roughness = factor(surface.map());
        Self { sums: Sums::new(roughness, covariance.factor()), area: roughness[0] * roughness[2] }
    }

    /// a A + b 2Σ.
    #[inline(always)]
    fn matrix(&self, a: f64, b: f64) -> Gram {
        self.sums.of(a, 2.0 * b)
    }

    /// The principal widths of 2Σ as a surface a A sees them.
    #[inline(always)]
    fn kernel(&self, a: f64) -> Principal {
        let [sum, product] = self.sums.trace_and_determinant(2.0 / a);
        let larger = 0.5 * (sum + Real::sqrt((sum * sum - 4.0 * product).max(0.0)));
        // The product over the larger: nothing cancels.
        let smaller = if larger > 0.0 { product / larger } else { larger };
        Principal { geometric: self.matrix(a, 1.0).root / (a * self.area) - 1.0, larger, smaller }
    }

    /// Beckmann(a A + b 2Σ) of this weight.
    #[inline(always)]
    fn core<T: Real>(&self, weight: f64, a: f64, b: f64) -> Option<Core<T>> {
        Some((T::lit(weight), Microsurface::new(Beckmann, Linear::of_gram(self.matrix(a, b))?)))
    }

    /// GGX(a A), of weight 1/a, filtered: what of it is still GGX, and the rest.
    ///
    /// The part that is still GGX is either widened as the kernel is, aA + k 2Σ, with the tail of
    /// GGX(A) where the kernel is as wide in every direction; or a multiple of A, with its tail in
    /// every direction, but less like what is seen near the highlight.
    #[inline(always)]
    fn tail<T: Real>(&self, a: f64, widened_by_kernel: bool) -> Option<(Tail<T>, Core<T>)> {
        let (k, c) = widening(&self.kernel(a));
        let widened = self.matrix(a, k);
        let scale = widened.root / self.area;
        let matrix = if widened_by_kernel { widened } else { self.matrix(scale, 0.0) };
        let weight = 1.0 / scale;
        let tail = (T::lit(weight), Microsurface::new(Ggx, Linear::of_gram(matrix)?));
        // Of a Σ of 0 nothing is left, up to rounding.
        Some((tail, self.core((1.0 / a - weight).max(0.0), c * a, c)?))
    }
}

impl<T: Real, const N: usize> FilteredGgx<T, N> {
    /// The GGX that carries the tail, and its weight.
    #[inline]
    #[must_use]
    pub const fn tail(&self) -> &(T, Microsurface<Ggx, Linear<T>>) {
        &self.tail
    }

    /// The Beckmann surfaces and their weights.
    #[inline]
    #[must_use]
    pub const fn cores(&self) -> &[(T, Microsurface<Beckmann, Linear<T>>); N] {
        &self.cores
    }

    /// Σ w f of all components.
    #[inline(always)]
    fn weighted(
        &self,
        of_tail: impl Fn(&Microsurface<Ggx, Linear<T>>) -> T,
        of_core: impl Fn(&Microsurface<Beckmann, Linear<T>>) -> T,
    ) -> T {
        // A kernel too narrow to matter leaves cores of weight 0: nothing, also where Λ is
        // infinite.
        let part = |weight: T, value: T| if weight > T::ZERO { weight * value } else { T::ZERO };
        let tail = self.tail.0 * of_tail(&self.tail.1);
        self.cores.iter().fold(tail, |sum, (weight, core)| sum + part(*weight, of_core(core)))
    }

    /// The component that u falls on by these shares, and how far it falls into it; N is the tail.
    #[inline]
    fn choose(
        &self,
        u: T,
        of_tail: T,
        of_core: impl Fn(&Microsurface<Beckmann, Linear<T>>) -> T,
    ) -> (usize, T) {
        let shares = self.cores.map(|(weight, core)| weight * of_core(&core));
        let of_tail = self.tail.0 * of_tail;
        let total = shares.iter().fold(of_tail, |sum, &share| sum + share);
        let mut rest = below_one(u) * total;
        for (i, &share) in shares.iter().enumerate() {
            if rest < share {
                return (i, below_one(rest / share));
            }
            rest -= share;
        }
        (N, below_one(positive_part(rest / of_tail)))
    }
}

impl<T: Real, const N: usize> Ndf for FilteredGgx<T, N> {
    type Scalar = T;

    #[inline(always)]
    fn d(&self, wm: Vec3<Self>) -> T {
        self.weighted(|tail| tail.d(wm), |core| core.d(wm))
    }

    #[inline(always)]
    fn d_along(&self, h: Vec3<Self>) -> T {
        self.weighted(|tail| tail.d_along(h), |core| core.d_along(h))
    }

    #[inline(always)]
    fn p22(&self, slope: Vec2<Self>) -> T {
        self.weighted(|tail| tail.p22(slope), |core| core.p22(slope))
    }

    #[inline(always)]
    fn sigma(&self, w: Vec3<Self>) -> T {
        let sigma = self.weighted(|tail| tail.sigma(w), |core| core.sigma(w));
        at_least_cosine(w.into(), sigma)
    }

    #[inline(always)]
    fn sigma_above(&self, w: Vec3<Self>) -> T {
        let sigma = self.weighted(|tail| tail.sigma_above(w), |core| core.sigma_above(w));
        at_least_cosine(w.into(), sigma)
    }

    #[inline(always)]
    fn lambda(&self, w: Vec3<Self>) -> T {
        // On the side above nothing cancels, and Λ(−w) = −1 − Λ(w) holds to the last bit.
        let [x, y, z]: [T; 3] = w.into();
        let up = [x, y, z.abs()].into();
        let lambda = self.weighted(|tail| tail.lambda(up), |core| core.lambda(up));
        if z < T::ZERO { -T::ONE - lambda } else { lambda }
    }
}

impl<T: Real, const N: usize> SampleNdf for FilteredGgx<T, N> {
    fn sample_d(&self, u: Vec2<Self>) -> Vec3<Self> {
        let [u1, u2]: [T; 2] = u.into();
        let (i, u2) = self.choose(u2, T::ONE, |_| T::ONE);
        self.cores
            .get(i)
            .map_or_else(|| self.tail.1.sample_d([u1, u2].into()), |(_, core)| core.sample_d([u1, u2].into()))
    }
}

impl<T: Real, const N: usize> SampleVndf for FilteredGgx<T, N> {
    /// u.y chooses a component by what is seen of it, and is used again for the choice within.
    fn sample_vndf(&self, w: Vec3<Self>, u: Vec2<Self>) -> Vec3<Self> {
        let [u1, u2]: [T; 2] = u.into();
        let (i, u2) = self.choose(u2, self.tail.1.sigma(w), |core| core.sigma(w));
        self.cores.get(i).map_or_else(
            || self.tail.1.sample_vndf(w, [u1, u2].into()),
            |(_, core)| core.sample_vndf(w, [u1, u2].into()),
        )
    }
}

impl<T: Real, const N: usize> Forms for FilteredGgx<T, N> {}

impl<T: Real, const N: usize> StagedVndf for FilteredGgx<T, N> {
    const STRAIGHT: bool = true;
    type Solver = ();

    #[inline(always)]
    fn ask(&self, _: Vec3<Self>, _: Vec2<Self>) {}

    #[inline(always)]
    fn normal(&self, w: Vec3<Self>, u: Vec2<Self>, (): ()) -> (Vec3<Self>, bool) {
        (self.sample_vndf(w, u), true)
    }

    #[inline(always)]
    fn sample_of_along(&self, along: Vec3<Self>) -> Vec3<Self> {
        along
    }
}

/// P22 of GGX(A) ⊛ N(Σ) at a slope, by quadrature of the integral over Beckmann surfaces.
///
/// The trapezoid rule in ln x with steps of ¼: about 120 Gaussians. A reference for the other
/// forms.
///
/// # Returns
/// 1/slope². NaN for a Σ or a slope that is not finite.
///
/// # Accuracy
/// Relative 2e-13, evaluated in f64.
///
/// # Example
/// ```
/// use microsurface::{Ggx, filter::{Covariance, gaussian}, glam::DVec2};
/// let peak = gaussian::p22(&Ggx::isotropic(1.0_f64)?, DVec2::ZERO, Covariance::isotropic(1.0));
/// assert!((peak / 0.0857120484959665 - 1.0).abs() < 2e-13);
/// # Ok::<(), microsurface::Error>(())
/// ```
#[must_use]
pub fn p22<M: Map>(
    surface: &Microsurface<Ggx, M>,
    slope: Vec2<Microsurface<Ggx, M>>,
    covariance: Covariance<M::Scalar>,
) -> M::Scalar {
    const STEP: f64 = 0.25;
    /// e^STEP.
    const RATIO: f64 = 1.2840254166877414841;
    // Where A is I: C R⁻¹ for C.
    let ([r11, r12, r22], [c11, c12, c22]) = (factor(surface.map()), covariance.factor());
    let (a, d) = (c11 / r11, c22 / r22);
    let b = (c12 - r12 * a) / r22;
    let [x, y] = seen_by_profile(surface.map(), slope);
    // 2Σ has this trace and determinant; tᵀ adj(2Σ) t is a sum of squares.
    let (trace, determinant) = (2.0 * (a * a + b * b + d * d), 4.0 * (a * d) * (a * d));
    let adjoint = 2.0 * ((a * y - b * x) * (a * y - b * x) + (d * x) * (d * x));
    let t2 = x * x + y * y;
    // The integrand falls as x² below 1/(1 + t²) and as e^{−x} above 1.
    let mut x = exp(-20.0) / (1.0 + t2);
    let mut sum = 0.0;
    while x < 45.0 {
        // det(1/x + 2Σ) and the exponent, both times x².
        let det = 1.0 + x * (trace + x * determinant);
        sum += x * x * exp(-x - (t2 + x * adjoint) * x / det) / Real::sqrt(det);
        x *= RATIO;
    }
    if !(t2.is_finite() && trace.is_finite()) {
        return M::Scalar::lit(0.0 * (t2 * trace));
    }
    M::Scalar::lit(STEP * core::f64::consts::FRAC_1_PI * sum / (r11 * r22))
}
