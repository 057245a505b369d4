//! Filtering in the projected space of m.xy: stable where the half vector is at grazing angles.
//!
//! A step of the half vector is |dt| = |dm.xy|/m.z³ at most in slopes: near the horizon the errors
//! of its derivative, and kernels themselves, grow without bound, and A + 2Σ of slopes shows false
//! highlights there. On the disc of m.xy they stay what they are. (Filters that keep the tail of
//! GGX, [`gaussian`](super::gaussian) and [`polygon`](super::polygon), have no such highlights in
//! slopes either.)
//!
//! # Derivation
//! With m.z² = 1 − |m.xy|², GGX of roughness matrix A is m.xyᵀA⁻¹m.xy + m.z² = 1 + m.xyᵀAₚ⁻¹m.xy:
//! on the disc it is again GGX, of the matrix Aₚ = (A⁻¹ − I)⁻¹. The method adds the kernel there
//! and goes back, in three steps,
//!
//! > Aₚ = (A⁻¹ − I)⁻¹,  Aₚ' = Aₚ + 2Σ,  A' = (Aₚ'⁻¹ + I)⁻¹.
//!
//! The steps are infinite at α = 1 and lose their digits near it and near 0. Here they are one:
//! with B = I − A and 2Σ = CᵀC, Woodbury's identity gives
//!
//! > A' = A + (BCᵀ)(I + CBCᵀ)⁻¹(CB),
//!
//! a positive semidefinite update, finite for a singular Σ, for α = 1 and for α → 0, and never
//! larger than B: A' ≤ I.
//!
//! # α above 1
//! There the density on the disc grows towards its rim, and Aₚ has a negative eigenvalue. B then
//! counts as 0 in that principal direction: the kernel leaves it as it is and filters the other.
//! The result is continuous in A, and no α is ever lowered. Shaders that limit Aₚ to 1 lower every
//! α above 0.707, even for Σ = 0.
//!
//! # References
//! Tokuyoshi and Kaplanyan 2021, "Stable geometric specular antialiasing with projected-space NDF
//! filtering", JCGT 10(2), Eqs. 3–7; Tokuyoshi 2017, "Error reduction and simplification for
//! shading anti-aliasing", §3.2.

use crate::Real;
use crate::elementary::exact::difference_of_products;
use crate::error::Error;
use crate::filter::covariance::checked_variances;
use crate::filter::deferred::Kernel;
use crate::filter::{Covariance, Footprint};
use crate::ggx::Ggx;
use crate::map::{AxisAligned, Gram, Isotropic, Linear, Map, factor};
use crate::microsurface::Microsurface;
use crate::profile::ShapeInvariant;

/// The surface convolved with the footprint in projected space: A' = (((A⁻¹ − I)⁻¹ + 2Σ)⁻¹ + I)⁻¹,
/// Σ = σ²ΔᵀΔ.
///
/// # Domain
/// `footprint`: the steps of m.xy per pixel. `variance`: σ² of the pixel filter in pixels²;
/// [`covariance::variance_tokuyoshi2021`](crate::filter::covariance::variance_tokuyoshi2021) is the
/// paper's.
///
/// # Special cases
/// A footprint of 0 gives the same surface. Where a principal α is 1 or more, it stays as it is;
/// see the [module](self). Footprints of any size (in f64 up to 1e70) give A' ≤ I where A ≤ I.
///
/// # Errors
/// [`Error::Covariance`] if Σ is not finite. [`Footprint::clamped`] makes footprints finite.
///
/// # Accuracy
/// Computed in f64 without cancellation, rounded once. The largest errors found by a search over α
/// from 1e-3 to 1, footprints from 1e-7 to 1 and every shape of both: entries of A', relative to
/// √(A'ᵢᵢA'ⱼⱼ), 2.2ε for f32 and 10ε for f64; its determinant 0.6 (4 + κ)ε and 1.8 (4 + κ)ε with
/// the ratio κ of the principal α, the worst for long kernels along the wide axis, whose own
/// direction is rounded.
///
/// # Example
/// ```
/// use microsurface::{Ggx, filter::{Footprint, covariance, projected}, glam::Vec2};
/// let surface = Ggx::isotropic(0.1_f32)?;
/// let footprint = Footprint::new(Vec2::new(0.2, 0.0), Vec2::ZERO);
/// let variance = covariance::variance_tokuyoshi2021();
/// let filtered = projected::filtered(&surface, footprint, variance)?;
/// let [alpha_x, alpha_y, _] = filtered.roughness_matrix()?.principal();
/// // α² = 0.01 is 0.01/0.99 on the disc.
/// let on_the_disc = 0.01 / 0.99 + 2.0 * variance * 0.2 * 0.2;
/// assert!((alpha_x * alpha_x - on_the_disc / (1.0 + on_the_disc)).abs() < 1e-7);
/// assert!((alpha_y - 0.1).abs() < 1e-7);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Tokuyoshi and Kaplanyan 2021, Eqs. 3–7 and Listing 1.
#[inline]
pub fn filtered<M: Map>(
    surface: &Microsurface<Ggx, M>,
    footprint: Footprint<M::Scalar>,
    variance: M::Scalar,
) -> Result<Microsurface<Ggx, Linear<M::Scalar>>, Error> {
    filtered_by(surface, footprint.covariance(variance))
}

/// [`filtered`] by a covariance Σ of m.xy, of whatever cause: sums of footprints, the extent of a
/// lamp.
///
/// # Errors
/// [`Error::Covariance`] if Σ is not finite, or so large that det Σ is not.
#[inline(always)]
pub fn filtered_by<M: Map>(
    surface: &Microsurface<Ggx, M>,
    covariance: Covariance<M::Scalar>,
) -> Result<Microsurface<Ggx, Linear<M::Scalar>>, Error> {
    let gram = OnDisc::new(surface.map()).convolved(covariance);
    let map = Linear::of_gram(gram).ok_or_else(|| covariance.refused())?;
    Ok(Microsurface::new(*surface.profile(), map))
}

/// A surface on the disc of m.xy: R of A = RᵀR, and the positive part of B = I − A.
#[derive(Debug)]
pub struct OnDisc {
    r: [f64; 3],
    b: [f64; 3],
    det_b: f64,
}

impl OnDisc {
    #[inline]
    pub(crate) fn new<M: Map>(map: &M) -> Self {
        let r = factor(map);
        let (b, det_b) = complement(r);
        Self { r, b, det_b }
    }

    /// A + (BCᵀ)(I + CBCᵀ)⁻¹(CB) of A = RᵀR and triangular C.
    ///
    /// With LLᵀ = I + CBCᵀ the update is DᵀD, D = L⁻¹CB. Its second row is a difference as
    /// Cholesky's method has it; from BJB = det B·J, J a quarter turn, it is c22 (b₂ + c11 det
    /// B·Jc₁)/√(K11 det K), with K = I + CBCᵀ and c₁ the first row of C.
    #[inline(always)]
    pub(crate) fn convolved<T: Real>(&self, covariance: Covariance<T>) -> Gram {
        let Self { r: [r11, r12, r22], b: [xx, xy, yy], det_b } = *self;
        let [c11, c12, c22] = covariance.factor().map(|entry| core::f64::consts::SQRT_2 * entry);
        // c₁B, the first row of CB, and c₁Bc₁ᵀ.
        let first = [c11 * xx + c12 * xy, c11 * xy + c12 * yy];
        let k11 = 1.0 + (c11 * first[0] + c12 * first[1]).max(0.0);
        let det_c = c11 * c22;
        let det_k = k11 + c22 * c22 * yy + det_c * det_c * det_b;
        // Roots before products: of footprints of 1e52 the product is beyond the largest number.
        let (root_k11, root_k) = (Real::sqrt(k11), Real::sqrt(det_k));
        let d1 = first.map(|entry| entry / root_k11);
        let scale = c22 / (root_k11 * root_k);
        let d2 = [scale * (xy - c11 * c12 * det_b), scale * (yy + c11 * c11 * det_b)];
        // det(RᵀR + DᵀD) = (det R)² + |adj(R)ᵀd₁|² + |adj(R)ᵀd₂|² + (det D)².
        let mixed = |[x, y]: [f64; 2]| {
            let (a, b) = (r22 * x, r11 * y - r12 * x);
            a * a + b * b
        };
        let (det_r, det_d) = (r11 * r22, det_c * det_b / root_k);
        Gram {
            xx: r11 * r11 + (d1[0] * d1[0] + d2[0] * d2[0]),
            xy: r11 * r12 + (d1[0] * d1[1] + d2[0] * d2[1]),
            yy: r12 * r12 + r22 * r22 + (d1[1] * d1[1] + d2[1] * d2[1]),
            root: Real::sqrt(det_r * det_r + mixed(d1) + mixed(d2) + det_d * det_d),
        }
    }
}

/// The positive part of B = I − RᵀR, entries and determinant.
#[inline]
fn complement([r11, r12, r22]: [f64; 3]) -> ([f64; 3], f64) {
    let one_minus_square = |x: f64| (1.0 - x) * (1.0 + x);
    let (xx, xy, yy) = (one_minus_square(r11), -(r11 * r12), one_minus_square(r22) - r12 * r12);
    // The eigenvalues of A: mean ± radius.
    let half_difference = 0.5 * (r11 * r11 - r12 * r12 - r22 * r22);
    let radius = Real::sqrt(half_difference * half_difference + xy * xy);
    let largest = 0.5 * (r11 * r11 + r12 * r12 + r22 * r22) + radius;
    if largest <= 1.0 {
        return ([xx, xy, yy], difference_of_products(xx, yy, xy, xy).max(0.0));
    }
    let root = r11 * r22;
    let smallest = root * (root / largest);
    if smallest >= 1.0 {
        return ([0.0; 3], 0.0);
    }
    // (1 − smallest)·vvᵀ, v the direction of the smaller: vvᵀ = (largest·I − A)/(2 radius), whose
    // diagonal is (1 ∓ half_difference/radius)/2; the smaller of the two by their product
    // (xy/radius)²/4.
    let larger = 0.5 * (1.0 + half_difference.abs() / radius);
    let off_diagonal = 0.5 * (xy / radius);
    let smaller = off_diagonal * (off_diagonal / larger);
    let (p, q) = if half_difference > 0.0 { (smaller, larger) } else { (larger, smaller) };
    let b = 1.0 - smallest;
    ([b * p, b * off_diagonal, b * q], 0.0)
}

/// [`filtered`] of an isotropic surface by an isotropic Σ of m.xy: α'² = α² + 2v b²/(1 + 2v b), b =
/// max(0, 1 − α²).
///
/// # Special cases
/// v = 0 gives the same α, exactly; so does every v where α ≥ 1.
///
/// # Errors
/// [`Error::Covariance`] unless v is finite and not negative.
///
/// # Accuracy
/// α' to 0.51ε for f32, 1.5ε for f64.
///
/// # Example
/// ```
/// use microsurface::{Ggx, filter::projected};
/// let filtered = projected::filtered_isotropic(&Ggx::isotropic(0.6_f32)?, 0.5)?;
/// let (surface, kernel) = (0.36 / 0.64, 2.0 * 0.5); // on the disc
/// let sum: f32 = surface + kernel;
/// assert!((filtered.map().alpha() - (sum / (1.0 + sum)).sqrt()).abs() < 1e-6);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Tokuyoshi and Kaplanyan 2021, Eqs. 4–7.
#[inline]
pub fn filtered_isotropic<T: Real>(
    surface: &Microsurface<Ggx, Isotropic<T>>,
    variance: T,
) -> Result<Microsurface<Ggx, Isotropic<T>>, Error> {
    let kernel = T::TWO.to_f64() * checked_variances([variance, variance])?[0];
    let alpha = T::lit(convolved_along_axis(surface.map().alpha().to_f64(), kernel));
    Ok(Microsurface::new(*surface.profile(), Isotropic::new(alpha)?))
}

/// [`filtered`] of an axis-aligned surface by the variances of m.x and m.y: [`filtered_isotropic`]
/// along each axis.
///
/// # Errors
/// [`Error::Covariance`] unless both are finite and not negative.
///
/// # Example
/// ```
/// use microsurface::{Ggx, filter::projected};
/// let filtered = projected::filtered_axis_aligned(&Ggx::anisotropic(0.1_f32, 0.9)?, [0.02, 0.0])?;
/// let [alpha_x, alpha_y] = filtered.map().alphas();
/// assert!(alpha_x > 0.2 && alpha_y == 0.9);
/// # Ok::<(), microsurface::Error>(())
/// ```
#[inline]
pub fn filtered_axis_aligned<T: Real>(
    surface: &Microsurface<Ggx, AxisAligned<T>>,
    variances: [T; 2],
) -> Result<Microsurface<Ggx, AxisAligned<T>>, Error> {
    let [x, y] = checked_variances(variances)?;
    along_axes(surface, [2.0 * x, 2.0 * y])
}

/// An axis-aligned surface filtered by the bounding rectangle of the footprint, min(2σ²b², κ) along
/// each axis: no matrix is needed, and it depends less on the quality of the derivatives.
///
/// The kernel is added on the disc. [`deferred::rectangle`](crate::filter::deferred::rectangle)
/// adds the same kernel to α² itself, the paper's practical form, which widens more.
///
/// # Special cases
/// A footprint that is not finite gives the largest kernel, κ along both axes.
///
/// # Errors
/// Never for a κ that leaves α' in its range; α' ≤ max(α, 1).
///
/// # Example
/// ```
/// use microsurface::{Ggx, filter::{Footprint, deferred::Kernel, projected}, glam::Vec2};
/// let footprint = Footprint::new(Vec2::new(0.1, 0.0), Vec2::new(0.1, 0.0));
/// let surface = Ggx::anisotropic(0.05, 0.05)?;
/// let filtered =
///     projected::filtered_by_bounds(&surface, footprint, &Kernel::tokuyoshi2021())?;
/// let [alpha_x, alpha_y] = filtered.map().alphas();
/// assert!(alpha_x > 0.11 && alpha_y == 0.05); // 2σ²(0.1 + 0.1)² = 0.0127
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Tokuyoshi and Kaplanyan 2021, Listing 3.
#[inline]
pub fn filtered_by_bounds<T: Real>(
    surface: &Microsurface<Ggx, AxisAligned<T>>,
    footprint: Footprint<T>,
    kernel: &Kernel<T>,
) -> Result<Microsurface<Ggx, AxisAligned<T>>, Error> {
    along_axes(surface, kernel.of_bounds(footprint))
}

/// The surface whose roughness matrix is A + 2Σ, with Σ from steps of m.xy in place of slopes.
///
/// It is [`Microsurface::filtered`] of a kernel that is narrower by h.z² to h.z³: exact in the
/// highlight, and a filter that fades where derivatives are noise. The "practical" form of 2021,
/// cheaper than [`filtered`] in a shader alone, since it needs no way back; it widens beyond α = 1.
///
/// # Errors
/// As [`Microsurface::filtered`].
///
/// # Example
/// ```
/// use microsurface::{Beckmann, filter::{Footprint, projected}, glam::Vec2};
/// let surface = Beckmann::isotropic(0.1_f32)?;
/// let footprint = Footprint::new(Vec2::new(0.2, 0.0), Vec2::ZERO);
/// let filtered = projected::filtered_tokuyoshi2017(&surface, footprint, 0.25)?;
/// let [alpha_x, _, _] = filtered.roughness_matrix()?.principal();
/// assert!((alpha_x * alpha_x - 0.03).abs() < 1e-7);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Tokuyoshi 2017, Eqs. 3 and 7; Tokuyoshi and Kaplanyan 2021, Eq. 9 and Listing 2.
#[inline]
pub fn filtered_tokuyoshi2017<P: ShapeInvariant, M: Map>(
    surface: &Microsurface<P, M>,
    footprint: Footprint<M::Scalar>,
    variance: M::Scalar,
) -> Result<Microsurface<P, Linear<M::Scalar>>, Error> {
    surface.filtered(footprint.covariance(variance))
}

/// α' after a kernel 2Σ along a principal axis.
#[inline]
fn convolved_along_axis(alpha: f64, kernel: f64) -> f64 {
    let b = ((1.0 - alpha) * (1.0 + alpha)).max(0.0);
    Real::sqrt(alpha * alpha + kernel * b * b / (1.0 + kernel * b))
}

#[inline]
fn along_axes<T: Real>(
    surface: &Microsurface<Ggx, AxisAligned<T>>,
    kernels: [f64; 2],
) -> Result<Microsurface<Ggx, AxisAligned<T>>, Error> {
    let [x, y] = surface.map().alphas().map(T::to_f64);
    let alphas = [convolved_along_axis(x, kernels[0]), convolved_along_axis(y, kernels[1])].map(T::lit);
    Ok(Microsurface::new(*surface.profile(), AxisAligned::new(alphas[0], alphas[1])?))
}
