//! Any invertible map.

use crate::Real;
use crate::elementary::exact::difference_of_products;
use crate::error::Error;
use crate::map::axis_aligned::AxisAligned;
use crate::map::gram::Gram;
use crate::map::isotropic::Isotropic;
use crate::map::roughness_matrix::RoughnessMatrix;
use crate::map::{Map, scale};

/// Any invertible map, stored as the upper triangular R = M⁻¹ that has the same RᵀR.
///
/// # Accuracy
/// R is computed in f64 and rounded once; the surface of the rounded R is then as accurate as an
/// axis-aligned one, but for the difference in Mᵀm: with κ the ratio of the principal α, D of a
/// given matrix is relatively uncertain by about κ ε in the direction of the smaller α. Ratios of
/// 1/ε and more (8e6 for f32) build, and are meaningless.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// [`Error::Map`], with the determinant of M, unless R is finite and its singular values (the
    /// principal α) are within [`alpha_range`](crate::roughness::alpha_range).
    pub fn from_inverse(r: [[T; 2]; 2]) -> Result<Self, Error> {
        let [[a, b], [c, d]] = r.map(|row| row.map(T::to_f64));
        let det = difference_of_products(a, d, b, c);
        let gram = Gram { xx: a * a + c * c, xy: a * b + c * d, yy: b * b + d * d, root: det.abs() };
        Self::of_gram(gram).ok_or(Error::Map { determinant: 1.0 / det })
    }

    /// The map of this RᵀR, unless it is not finite or leaves the range of α.
    #[inline(always)]
    pub(crate) fn of_gram(gram: Gram) -> Option<Self> {
        gram.in_range::<T>().then(|| Self::triangular(gram))
    }

    /// The map of a positive definite RᵀR: Cholesky's factor.
    #[inline(always)]
    pub(crate) fn triangular(gram: Gram) -> Self {
        Self::of_factor(gram.factor().map(T::lit))
    }

    /// The map of a triangular R with a positive diagonal; what follows from it is rounded once.
    #[inline(always)]
    fn of_factor([r11, r12, r22]: [T; 3]) -> Self {
        let [a, b, d] = [r11, r12, r22].map(T::to_f64);
        let root = Real::sqrt(a * d);
        Self {
            r11,
            r12,
            r22,
            k: T::lit(d / root),
            inv_k: T::lit(a / root),
            shear: T::lit(b / root),
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
        Self::of_gram(gram).ok_or(Error::Map { determinant: det })
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
        Self::of_factor(matrix.factor())
    }
}

impl<T: Real> From<Isotropic<T>> for Linear<T> {
    #[inline]
    fn from(map: Isotropic<T>) -> Self {
        Self::of_factor([map.alpha(), T::ZERO, map.alpha()])
    }
}

impl<T: Real> From<AxisAligned<T>> for Linear<T> {
    #[inline]
    fn from(map: AxisAligned<T>) -> Self {
        let [alpha_x, alpha_y] = map.alphas();
        Self::of_factor([alpha_x, T::ZERO, alpha_y])
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

    #[inline(always)]
    fn inverse(&self) -> [[T; 2]; 2] {
        [[self.r11, self.r12], [T::ZERO, self.r22]]
    }

    #[inline]
    fn stretched(&self, scale_x: T, scale_y: T) -> Result<Self, Error> {
        Self::from_inverse([[self.r11 / scale_x, self.r12 / scale_y], [T::ZERO, self.r22 / scale_y]])
    }
}
