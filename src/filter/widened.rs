//! A + 2Σ: the roughness matrix widened by a covariance of slopes, for each map.

use crate::Real;
use crate::error::Error;
use crate::filter::covariance::{Covariance, checked_variances};
use crate::ggx::Ggx;
use crate::map::{AxisAligned, Isotropic, Linear, Map, RoughnessMatrix, factor, seen_by_profile, sum};
use crate::microsurface::Microsurface;
use crate::ndf::Vec2;
use crate::profile::ShapeInvariant;

impl<P: ShapeInvariant, M: Map> Microsurface<P, M> {
    /// The surface whose roughness matrix is A + 2Σ.
    ///
    /// For [`Beckmann`](crate::Beckmann) it is the convolution with a Gaussian of covariance Σ,
    /// exactly. For [`Ggx`](crate::Ggx) it is the "proxy" of Kaplanyan et al. 2016: its peak is too
    /// high by up to 24 % and its tail by a factor 1 + 2σ²/α²;
    /// [`gaussian::filtered`](crate::filter::gaussian::filtered) is nearer to the convolution.
    ///
    /// # Errors
    /// [`Error::Covariance`] if Σ is not finite or makes a principal α larger than
    /// [`alpha_range`](crate::roughness::alpha_range).
    ///
    /// # Accuracy
    /// The determinant is a sum of positive terms, so a long thin Σ loses no digits. A is exact to
    /// 2ε of its entries.
    ///
    /// # Example
    /// ```
    /// use microsurface::{Beckmann, Ndf, filter::Footprint, glam::Vec2};
    /// let surface = Beckmann::isotropic(0.01_f32)?;
    /// // The half vector moves by 0.05 in slope from one pixel to the next.
    /// let footprint = Footprint::new(Vec2::new(0.05, 0.0), Vec2::new(0.0, 0.002));
    /// let filtered = surface.filtered(footprint.covariance(0.25))?;
    /// let [alpha, _, _] = filtered.roughness_matrix()?.principal();
    /// assert!((alpha - (0.01_f32 * 0.01 + 2.0 * 0.25 * 0.05 * 0.05).sqrt()).abs() < 1e-6);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    ///
    /// # References
    /// Kaplanyan, Hill, Patney and Lefohn 2016, Eqs. 13–15 and 20; Tokuyoshi 2017, Eqs. 2 and 3.
    #[inline]
    pub fn filtered(
        &self,
        covariance: Covariance<M::Scalar>,
    ) -> Result<Microsurface<P, Linear<M::Scalar>>, Error> {
        self.widened(covariance, 2.0)
    }

    /// The surface whose roughness matrix is A + factor·Σ.
    #[inline(always)]
    pub(super) fn widened(
        &self,
        covariance: Covariance<M::Scalar>,
        factor_of_sigma: f64,
    ) -> Result<Microsurface<P, Linear<M::Scalar>>, Error> {
        let gram = sum(factor(self.map()), covariance.factor(), factor_of_sigma);
        let map = Linear::of_gram(gram).ok_or_else(|| covariance.refused())?;
        Ok(Microsurface::new(*self.profile(), map))
    }

    /// [`filtered`](Self::filtered) by a Σ whose result the caller knows to be in range.
    #[inline(always)]
    pub(crate) fn filtered_in_range(
        &self,
        covariance: Covariance<M::Scalar>,
    ) -> Microsurface<P, Linear<M::Scalar>> {
        let gram = sum(factor(self.map()), covariance.factor(), 2.0);
        Microsurface::new(*self.profile(), Linear::triangular(gram))
    }

    /// How much filtering with Σ would change P22 at most, as a share of its peak: what is lost
    /// without.
    ///
    /// max |P22' − P22|/P22(0) = 1 − √(det A/det(A + 2Σ)), at slope 0. Below the error that a
    /// picture may show, filtering can be skipped; of an 8-bit picture that is about 1/256.
    ///
    /// # Returns
    /// 0 for Σ = 0, growing with Σ towards 1; NaN for a Σ that is not finite.
    ///
    /// # Accuracy
    /// Exact for Beckmann; for GGX filtered by a true Gaussian the peak falls by more, at most 2
    /// times as much.
    ///
    /// # Example
    /// ```
    /// use microsurface::{Ggx, filter::Covariance};
    /// let rough = Ggx::isotropic(0.5_f32)?;
    /// assert!(rough.change_by_filter(Covariance::isotropic(1e-4)) < 1e-3); // not worth a filter
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    #[inline]
    #[must_use]
    pub fn change_by_filter(&self, covariance: Covariance<M::Scalar>) -> M::Scalar {
        let r = factor(self.map());
        let (before, after) = (r[0] * r[2], sum(r, covariance.factor(), 2.0).root);
        // 1 − before/after without the difference of equal numbers: after² − before² is a sum.
        let [r11, r12, r22] = r;
        let [c11, c12, c22] = covariance.factor();
        let (a, b, c) = (r22 * c11, r11 * c12 - r12 * c11, r11 * c22);
        let det_c = 2.0 * (c11 * c22);
        let gained = 2.0 * (a * a + b * b + c * c) + det_c * det_c;
        M::Scalar::lit(gained / (after * (after + before)))
    }
}

impl<M: Map> Microsurface<Ggx, M> {
    /// How much convolution with a Gaussian of covariance Σ changes P22 at this slope, as a share
    /// of P22 there: an upper bound.
    ///
    /// 12 tr(A⁻¹Σ)/(1 + tᵀA⁻¹t): far from the highlight the tail is smooth on the scale of the
    /// slope itself, and a pixel there needs no filter even where the highlight needs one.
    ///
    /// It bounds the exact convolution ([`gaussian::p22`](crate::filter::gaussian::p22)), not
    /// [`filtered`](Self::filtered): A + 2Σ makes the tail brighter by a share that does not fall
    /// with the slope, tr(A⁻¹Σ) where Σ is a multiple of A and up to 3 tr(A⁻¹Σ) along a line.
    ///
    /// # Returns
    /// 0 for Σ = 0. The second derivative bounds the change by 10 in place of 12, and what follows
    /// it by less than the rest as long as the result is below 0.1; above it, filter. The largest
    /// change found is 0.91 of the bound.
    ///
    /// # Example
    /// ```
    /// use microsurface::{Ggx, filter::Covariance, glam::Vec2};
    /// let (surface, kernel) = (Ggx::isotropic(0.01_f32)?, Covariance::isotropic(1e-5));
    /// assert!(surface.change_by_filter_at(Vec2::ZERO, kernel) > 0.1); // in the highlight
    /// assert!(surface.change_by_filter_at(Vec2::new(0.3, 0.0), kernel) < 0.01); // beside it
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    #[inline]
    #[must_use]
    pub fn change_by_filter_at(&self, slope: Vec2<Self>, covariance: Covariance<M::Scalar>) -> M::Scalar {
        let [r11, r12, r22] = factor(self.map());
        let [c11, c12, c22] = covariance.factor();
        // C R⁻¹, whose rows are the rows of C as the profile sees them.
        let (a, c) = (c11 / r11, c22 / r22);
        let b = (c12 - r12 * a) / r22;
        let [x, y] = seen_by_profile(self.map(), slope);
        M::Scalar::lit(12.0 * (a * a + b * b + c * c) / (1.0 + x * x + y * y))
    }
}

impl<P: ShapeInvariant, T: Real> Microsurface<P, Isotropic<T>> {
    /// [`filtered`](Self::filtered) by slopes of the same variance v in every direction: α'² = α² +
    /// 2v.
    ///
    /// # Special cases
    /// v = 0 gives the same α, exactly.
    ///
    /// # Errors
    /// [`Error::Covariance`] unless v is finite and not negative, [`Error::Alpha`] where α' is
    /// above [`alpha_range`](crate::roughness::alpha_range).
    ///
    /// # Example
    /// ```
    /// use microsurface::Ggx;
    /// let filtered = Ggx::isotropic(0.3_f32)?.filtered_isotropic(0.08)?;
    /// assert!((filtered.map().alpha() - 0.5).abs() < 1e-6);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    #[inline]
    pub fn filtered_isotropic(&self, variance: T) -> Result<Self, Error> {
        let [v, _] = checked_variances([variance, variance])?;
        Ok(Self::new(*self.profile(), Isotropic::new(widened_alpha(self.map().alpha(), v))?))
    }
}

impl<P: ShapeInvariant, T: Real> Microsurface<P, AxisAligned<T>> {
    /// [`filtered`](Self::filtered) by slopes of these variances along x and y, uncorrelated:
    /// αx'² = αx² + 2v_x, αy'² = αy² + 2v_y.
    ///
    /// # Errors
    /// [`Error::Covariance`] unless both are finite and not negative, [`Error::Alpha`] where an α'
    /// is above [`alpha_range`](crate::roughness::alpha_range).
    ///
    /// # Example
    /// ```
    /// use microsurface::Beckmann;
    /// let filtered = Beckmann::anisotropic(0.3_f32, 0.1)?.filtered_axis_aligned([0.08, 0.0])?;
    /// let [alpha_x, alpha_y] = filtered.map().alphas();
    /// assert!((alpha_x - 0.5).abs() < 1e-6 && alpha_y == 0.1);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    #[inline]
    pub fn filtered_axis_aligned(&self, variances: [T; 2]) -> Result<Self, Error> {
        let [x, y] = self.map().alphas();
        let [v_x, v_y] = checked_variances(variances)?;
        Ok(Self::new(*self.profile(), AxisAligned::new(widened_alpha(x, v_x), widened_alpha(y, v_y))?))
    }
}

/// √(α² + 2v).
#[inline]
fn widened_alpha<T: Real>(alpha: T, variance: f64) -> T {
    let alpha = alpha.to_f64();
    T::lit(Real::sqrt(alpha * alpha + 2.0 * variance))
}

/// det(A + 2Σ) as a shader computes it: from the entries of the sum, and not below αx²αy² of the
/// surface itself.
///
/// The difference of products loses all digits for long thin kernels, which the limit hides;
/// [`Microsurface::filtered`] adds positive terms instead. Here for comparison.
///
/// # References
/// Tokuyoshi and Kaplanyan 2019, supplement, §1, "Practical implementation" (τ).
#[inline]
#[must_use]
pub fn determinant_tokuyoshi2019<T: Real>(matrix: &RoughnessMatrix<T>, covariance: Covariance<T>) -> T {
    let ([axx, axy, ayy], [sxx, sxy, syy]) = (matrix.entries(), covariance.entries());
    let (xx, xy, yy) = (axx + T::TWO * sxx, axy + T::TWO * sxy, ayy + T::TWO * syy);
    let least = axx * ayy - axy * axy;
    (xx * yy - xy * xy).max(least)
}
