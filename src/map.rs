//! Linear maps of the tangent plane under which a profile is seen, one type for each cost.
//!
//! A map M moves the points of the microsurface; normals pull back by Mᵀ, directions by M⁻¹:
//! D(wm) = |det M| P(|Mᵀ wm_xy|², wm.z²) and σ(w) = σ_P(|M⁻¹ w_xy|², w.z). Every type stores the inverse
//! R = M⁻¹, in units of slope width: R = α for an isotropic surface, and A = RᵀR is the roughness matrix.
//! Since a profile is isotropic, only RᵀR matters and R can be kept upper triangular: three numbers.
//!
//! To save multiplications and rounding, normals are pulled back by the *unimodular* part of M: with
//! ρ² = |det R|, [`Map::normal_terms`] returns q̂ = ρ²|Mᵀ m_xy|² and ẑ² = ρ² m.z², and
//! D = ρ² P(q̂, ẑ²). For an isotropic map q̂ is x² + y², whatever α. The 1/π that every P contains is kept with ρ².

use crate::Real;
use crate::error::Error;
use crate::roughness::{RoughnessMatrix, checked};

mod sealed {
    pub trait Sealed {}
    impl<T> Sealed for super::Isotropic<T> {}
    impl<T> Sealed for super::AxisAligned<T> {}
    impl<T> Sealed for super::Linear<T> {}
}

/// A linear map of the tangent plane. Sealed: [`Isotropic`], [`AxisAligned`], [`Linear`].
pub trait Map: sealed::Sealed + Copy {
    /// f32 or f64.
    type Scalar: Real;
    /// The smallest map that holds this one stretched along the axes.
    type Stretched: Map<Scalar = Self::Scalar>;

    /// ρ²/π = 1/(π |det M|), rounded once: ρ² is the geometric mean of the principal α².
    fn scale(&self) -> Self::Scalar;

    /// (q̂, ẑ²) = ρ²·(|Mᵀ m_xy|², m.z²).
    fn normal_terms(&self, m: [Self::Scalar; 3]) -> (Self::Scalar, Self::Scalar);

    /// The same in the wide scalar, from the stored α and the components of m without any rounding to the
    /// narrow one. Where a density is steep in q̂/ẑ², the rounding of the ratio is the error of the density.
    fn normal_terms_wide(
        &self,
        m: [Self::Scalar; 3],
    ) -> (<Self::Scalar as Real>::Wide, <Self::Scalar as Real>::Wide);

    /// s² = |M⁻¹ w_xy|².
    fn direction_term(&self, w: [Self::Scalar; 3]) -> Self::Scalar;

    /// s² in the wide scalar.
    fn direction_term_wide(&self, w: [Self::Scalar; 3]) -> <Self::Scalar as Real>::Wide;

    /// M⁻¹ w: the direction as the profile sees it, not normalised.
    fn pull_direction(&self, w: [Self::Scalar; 3]) -> [Self::Scalar; 3];

    /// M⁻ᵀ m: a normal of the profile as a normal of the surface, not normalised.
    fn push_normal(&self, m: [Self::Scalar; 3]) -> [Self::Scalar; 3];

    /// M⁻¹ = R by rows, upper triangular: `[[r11, r12], [0, r22]]`.
    fn inverse(&self) -> [[Self::Scalar; 2]; 2];

    /// This map followed by diag(1/(1−s), 1−s), s ∈ (−1, 1) checked by the caller; see
    /// [`Microsurface::stretched`](crate::Microsurface::stretched).
    ///
    /// # Errors
    /// [`Error::Map`] where the result leaves the range of α.
    fn stretched(&self, scale_x: Self::Scalar, scale_y: Self::Scalar) -> Result<Self::Stretched, Error>;
}

/// M = I/α: one number. Nothing directional is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "stored::Isotropic<T>", into = "stored::Isotropic<T>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct Isotropic<T> {
    alpha: T,
    alpha2: T,
    scale: T,
}

impl<T: Real> Isotropic<T> {
    /// The map I/α.
    ///
    /// # Errors
    /// [`Error::Alpha`] unless α is within [`alpha_range`](crate::roughness::alpha_range).
    #[inline]
    pub fn new(alpha: T) -> Result<Self, Error> {
        let alpha = checked(alpha)?;
        Ok(Self { alpha, alpha2: alpha * alpha, scale: scale(alpha, alpha) })
    }

    /// α.
    #[inline]
    #[must_use]
    pub fn alpha(&self) -> T {
        self.alpha
    }
}

impl<T: Real> Map for Isotropic<T> {
    type Scalar = T;
    type Stretched = AxisAligned<T>;

    #[inline(always)]
    fn scale(&self) -> T {
        self.scale
    }

    #[inline(always)]
    fn normal_terms(&self, [x, y, z]: [T; 3]) -> (T, T) {
        (x * x + y * y, self.alpha2 * (z * z))
    }

    #[inline(always)]
    fn normal_terms_wide(&self, m: [T; 3]) -> (T::Wide, T::Wide) {
        let [x, y, z] = m.map(T::widen);
        let alpha = self.alpha.widen();
        (x * x + y * y, (alpha * alpha) * (z * z))
    }

    #[inline(always)]
    fn direction_term(&self, [x, y, _]: [T; 3]) -> T {
        self.alpha2 * (x * x + y * y)
    }

    #[inline(always)]
    fn direction_term_wide(&self, w: [T; 3]) -> T::Wide {
        let [x, y, _] = w.map(T::widen);
        let alpha = self.alpha.widen();
        (alpha * alpha) * (x * x + y * y)
    }

    #[inline(always)]
    fn pull_direction(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        [self.alpha * x, self.alpha * y, z]
    }

    #[inline(always)]
    fn push_normal(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        [self.alpha * x, self.alpha * y, z]
    }

    #[inline]
    fn inverse(&self) -> [[T; 2]; 2] {
        [[self.alpha, T::ZERO], [T::ZERO, self.alpha]]
    }

    #[inline]
    fn stretched(&self, scale_x: T, scale_y: T) -> Result<AxisAligned<T>, Error> {
        AxisAligned::of_map(self.alpha / scale_x, self.alpha / scale_y)
    }
}

/// M = diag(1/αx, 1/αy): two numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "stored::AxisAligned<T>", into = "stored::AxisAligned<T>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct AxisAligned<T> {
    alpha_x: T,
    alpha_y: T,
    /// αy/αx and αx/αy, the squares of the unimodular part.
    aspect: [T; 2],
    area: T,
    scale: T,
}

impl<T: Real> AxisAligned<T> {
    /// The map diag(1/αx, 1/αy).
    ///
    /// # Errors
    /// [`Error::Alpha`] unless both are within [`alpha_range`](crate::roughness::alpha_range).
    #[inline]
    pub fn new(alpha_x: T, alpha_y: T) -> Result<Self, Error> {
        let (alpha_x, alpha_y) = (checked(alpha_x)?, checked(alpha_y)?);
        Ok(Self {
            alpha_x,
            alpha_y,
            aspect: [alpha_y / alpha_x, alpha_x / alpha_y],
            area: alpha_x * alpha_y,
            scale: scale(alpha_x, alpha_y),
        })
    }

    fn of_map(alpha_x: T, alpha_y: T) -> Result<Self, Error> {
        let determinant = T::ONE / (alpha_x * alpha_y);
        Self::new(alpha_x, alpha_y).map_err(|_| Error::Map { determinant: determinant.to_f64() })
    }

    /// αx and αy.
    #[inline]
    #[must_use]
    pub fn alphas(&self) -> [T; 2] {
        [self.alpha_x, self.alpha_y]
    }
}

impl<T: Real> Map for AxisAligned<T> {
    type Scalar = T;
    type Stretched = Self;

    #[inline(always)]
    fn scale(&self) -> T {
        self.scale
    }

    #[inline(always)]
    fn normal_terms(&self, [x, y, z]: [T; 3]) -> (T, T) {
        (self.aspect[0] * (x * x) + self.aspect[1] * (y * y), self.area * (z * z))
    }

    #[inline(always)]
    fn normal_terms_wide(&self, m: [T; 3]) -> (T::Wide, T::Wide) {
        let [x, y, z] = m.map(T::widen);
        let (alpha_x, alpha_y) = (self.alpha_x.widen(), self.alpha_y.widen());
        let area = alpha_x * alpha_y;
        let (a, b) = (alpha_y * x, alpha_x * y);
        ((a * a + b * b) / area, area * (z * z))
    }

    #[inline(always)]
    fn direction_term(&self, [x, y, _]: [T; 3]) -> T {
        let (a, b) = (self.alpha_x * x, self.alpha_y * y);
        a * a + b * b
    }

    #[inline(always)]
    fn direction_term_wide(&self, w: [T; 3]) -> T::Wide {
        let [x, y, _] = w.map(T::widen);
        let (a, b) = (self.alpha_x.widen() * x, self.alpha_y.widen() * y);
        a * a + b * b
    }

    #[inline(always)]
    fn pull_direction(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        [self.alpha_x * x, self.alpha_y * y, z]
    }

    #[inline(always)]
    fn push_normal(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        [self.alpha_x * x, self.alpha_y * y, z]
    }

    #[inline]
    fn inverse(&self) -> [[T; 2]; 2] {
        [[self.alpha_x, T::ZERO], [T::ZERO, self.alpha_y]]
    }

    #[inline]
    fn stretched(&self, scale_x: T, scale_y: T) -> Result<Self, Error> {
        Self::of_map(self.alpha_x / scale_x, self.alpha_y / scale_y)
    }
}

/// Any invertible map, stored as the upper triangular R = M⁻¹ that has the same RᵀR.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "stored::Linear<T>", into = "stored::Linear<T>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct Linear<T> {
    r11: T,
    r12: T,
    r22: T,
    /// √(r22/r11), its inverse and r12/ρ: the unimodular part of Mᵀ is [[k, 0], [−shear, 1/k]].
    k: T,
    inv_k: T,
    shear: T,
    area: T,
    scale: T,
}

impl<T: Real> Linear<T> {
    /// The map whose inverse has the rows `r`: M = R⁻¹.
    ///
    /// # Errors
    /// [`Error::Map`], with the determinant of M, unless R is finite and its singular values (the principal α)
    /// are within [`alpha_range`](crate::roughness::alpha_range).
    pub fn from_inverse(r: [[T; 2]; 2]) -> Result<Self, Error> {
        let [[a, b], [c, d]] = r.map(|row| row.map(T::to_f64));
        let det = difference_of_products(a, d, b, c);
        let gram = Gram { xx: a * a + c * c, xy: a * b + c * d, yy: b * b + d * d, root: det.abs() };
        if !gram.in_range::<T>() {
            return Err(Error::Map { determinant: 1.0 / det });
        }
        Ok(Self::triangular(gram))
    }

    /// The map of a positive definite RᵀR: Cholesky's factor.
    fn triangular(Gram { xx, xy, root, .. }: Gram) -> Self {
        let r11 = Real::sqrt(xx);
        let [r11, r12, r22] = [r11, xy / r11, root / r11].map(T::lit);
        Self::stored(r11, r12, r22)
    }

    /// What follows from the three stored numbers, rounded once.
    fn stored(r11: T, r12: T, r22: T) -> Self {
        let [a, b, d] = [r11, r12, r22].map(T::to_f64);
        let k = Real::sqrt(d / a);
        Self {
            r11,
            r12,
            r22,
            k: T::lit(k),
            inv_k: T::lit(1.0 / k),
            shear: T::lit(b / Real::sqrt(a * d)),
            area: T::lit(a * d),
            scale: scale(r11, r22),
        }
    }

    /// R⁻¹ applied first, then `matrix` given by columns: the map `matrix`·M.
    fn followed_by(r: [[T; 2]; 2], columns: [[T; 2]; 2]) -> Result<Self, Error> {
        let [[m11, m21], [m12, m22]] = columns.map(|column| column.map(T::to_f64));
        let [[a, b], [c, d]] = r.map(|row| row.map(T::to_f64));
        let det = difference_of_products(m11, m22, m12, m21);
        // R M⁻¹ = R adj(M)/det M. Its Gram matrix is formed in f64 before anything is rounded.
        let row = |p: f64, q: f64| {
            [difference_of_products(p, m22, q, m21) / det, difference_of_products(q, m11, p, m12) / det]
        };
        let ([a, b], [c, d]) = (row(a, b), row(c, d));
        let gram = Gram {
            xx: a * a + c * c,
            xy: a * b + c * d,
            yy: b * b + d * d,
            root: (determinant(r) / det).abs(),
        };
        if !gram.in_range::<T>() {
            return Err(Error::Map { determinant: det });
        }
        Ok(Self::triangular(gram))
    }
}

/// The determinant of an upper triangular matrix.
fn determinant<T: Real>(r: [[T; 2]; 2]) -> f64 {
    r[0][0].to_f64() * r[1][1].to_f64()
}

/// `matrix`·M for any map M: the microsurface of M, moved by `matrix`.
pub(crate) fn moved<M: Map>(map: &M, matrix: <M::Scalar as Real>::Mat2) -> Result<Linear<M::Scalar>, Error> {
    Linear::followed_by(map.inverse(), <M::Scalar as Real>::columns(matrix))
}

impl<T: Real> From<RoughnessMatrix<T>> for Linear<T> {
    #[inline]
    fn from(matrix: RoughnessMatrix<T>) -> Self {
        Self::triangular(matrix.gram())
    }
}

impl<T: Real> Map for Linear<T> {
    type Scalar = T;
    type Stretched = Self;

    #[inline(always)]
    fn scale(&self) -> T {
        self.scale
    }

    #[inline(always)]
    fn normal_terms(&self, [x, y, z]: [T; 3]) -> (T, T) {
        let (a, b) = (self.k * x, self.inv_k * y - self.shear * x);
        (a * a + b * b, self.area * (z * z))
    }

    #[inline(always)]
    fn normal_terms_wide(&self, m: [T; 3]) -> (T::Wide, T::Wide) {
        let [x, y, z] = m.map(T::widen);
        let (r11, r12, r22) = (self.r11.widen(), self.r12.widen(), self.r22.widen());
        let area = r11 * r22;
        let (a, b) = (r22 * x, r11 * y - r12 * x);
        ((a * a + b * b) / area, area * (z * z))
    }

    #[inline(always)]
    fn direction_term(&self, [x, y, _]: [T; 3]) -> T {
        let (a, b) = (self.r11 * x + self.r12 * y, self.r22 * y);
        a * a + b * b
    }

    #[inline(always)]
    fn direction_term_wide(&self, w: [T; 3]) -> T::Wide {
        let [x, y, _] = w.map(T::widen);
        let (a, b) = (self.r11.widen() * x + self.r12.widen() * y, self.r22.widen() * y);
        a * a + b * b
    }

    #[inline(always)]
    fn pull_direction(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        [self.r11 * x + self.r12 * y, self.r22 * y, z]
    }

    #[inline(always)]
    fn push_normal(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        [self.r11 * x, self.r12 * x + self.r22 * y, z]
    }

    #[inline]
    fn inverse(&self) -> [[T; 2]; 2] {
        [[self.r11, self.r12], [T::ZERO, self.r22]]
    }

    #[inline]
    fn stretched(&self, scale_x: T, scale_y: T) -> Result<Self, Error> {
        Self::from_inverse([[self.r11 / scale_x, self.r12 / scale_y], [T::ZERO, self.r22 / scale_y]])
    }
}

/// |det R|/π of a triangular R of this diagonal.
fn scale<T: Real>(r11: T, r22: T) -> T {
    T::lit(r11.to_f64() * r22.to_f64() * core::f64::consts::FRAC_1_PI)
}

/// A symmetric positive definite matrix RᵀR with |det R|, the root of its determinant, known more precisely
/// than from its entries.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gram {
    pub(crate) xx: f64,
    pub(crate) xy: f64,
    pub(crate) yy: f64,
    pub(crate) root: f64,
}

impl Gram {
    /// The larger and the smaller principal α: the roots of the eigenvalues.
    pub(crate) fn principal(&self) -> [f64; 2] {
        let half_difference = 0.5 * (self.xx - self.yy);
        let radius = Real::sqrt(half_difference * half_difference + self.xy * self.xy);
        let largest = Real::sqrt(0.5 * (self.xx + self.yy) + radius);
        [largest, self.root / largest]
    }

    /// Both principal α are finite and within the range of the scalar. False for NaN.
    pub(crate) fn in_range<T: Real>(&self) -> bool {
        let (smallest, largest) = crate::roughness::alpha_range::<T>();
        let [alpha_max, alpha_min] = self.principal();
        // A relative slack of a few ε: an α at the very end of the range stays accepted after a rotation.
        let slack = 1.0 + 8.0 * T::EPSILON.to_f64();
        alpha_max <= largest.to_f64() * slack && alpha_min * slack >= smallest.to_f64()
    }
}

/// a·b − c·d to about an ulp of the result, by exact products (Dekker 1971; Kahan's algorithm).
pub(crate) fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let (p, p_error) = two_product(a, b);
    let (q, q_error) = two_product(c, d);
    let difference = p - q;
    // The rounding error of p − q, exactly (Knuth's two-sum), then those of the products.
    let virtual_q = p - difference;
    let error = (p - (difference + virtual_q)) + (virtual_q - q);
    difference + (error + (p_error - q_error))
}

/// a·b as a rounded product and its exact error.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let halves = |x: f64| {
        let t = 134217729.0 * x; // 2²⁷ + 1
        let high = t - (t - x);
        (high, x - high)
    };
    let product = a * b;
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    (product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
}

#[cfg(feature = "serde")]
mod stored {
    //! What is serialised: the numbers given, so that deserialising checks them again.
    use super::Real;
    use crate::error::Error;

    #[derive(serde::Serialize, serde::Deserialize)]
    pub(super) struct Isotropic<T> {
        alpha: T,
    }
    impl<T: Real> From<super::Isotropic<T>> for Isotropic<T> {
        fn from(map: super::Isotropic<T>) -> Self {
            Self { alpha: map.alpha }
        }
    }
    impl<T: Real> TryFrom<Isotropic<T>> for super::Isotropic<T> {
        type Error = Error;
        fn try_from(map: Isotropic<T>) -> Result<Self, Error> {
            Self::new(map.alpha)
        }
    }

    #[derive(serde::Serialize, serde::Deserialize)]
    pub(super) struct AxisAligned<T> {
        alpha_x: T,
        alpha_y: T,
    }
    impl<T: Real> From<super::AxisAligned<T>> for AxisAligned<T> {
        fn from(map: super::AxisAligned<T>) -> Self {
            Self { alpha_x: map.alpha_x, alpha_y: map.alpha_y }
        }
    }
    impl<T: Real> TryFrom<AxisAligned<T>> for super::AxisAligned<T> {
        type Error = Error;
        fn try_from(map: AxisAligned<T>) -> Result<Self, Error> {
            Self::new(map.alpha_x, map.alpha_y)
        }
    }

    #[derive(serde::Serialize, serde::Deserialize)]
    pub(super) struct Linear<T> {
        r11: T,
        r12: T,
        r22: T,
    }
    impl<T: Real> From<super::Linear<T>> for Linear<T> {
        fn from(map: super::Linear<T>) -> Self {
            Self { r11: map.r11, r12: map.r12, r22: map.r22 }
        }
    }
    impl<T: Real> TryFrom<Linear<T>> for super::Linear<T> {
        type Error = Error;
        fn try_from(map: Linear<T>) -> Result<Self, Error> {
            // Checks, then keeps the three numbers as they were: a round trip changes no bit.
            Self::from_inverse([[map.r11, map.r12], [T::ZERO, map.r22]])?;
            Ok(Self::stored(map.r11.abs(), map.r12, map.r22.abs()))
        }
    }
}
