//! A width along each axis.

use crate::Real;
use crate::alpha::checked;
use crate::error::Error;
use crate::map::{Map, scale};

/// M = diag(1/αx, 1/αy): two numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
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
        Ok(Self::of_checked(checked(alpha_x)?, checked(alpha_y)?))
    }

    /// The map diag(1/αx, 1/αy) of widths that have been checked.
    #[inline(always)]
    pub(crate) fn of_checked(alpha_x: T, alpha_y: T) -> Self {
        Self {
            alpha_x,
            alpha_y,
            aspect: [alpha_y / alpha_x, alpha_x / alpha_y],
            area: alpha_x * alpha_y,
            scale: scale(alpha_x, alpha_y),
        }
    }

    pub(super) fn of_map(alpha_x: T, alpha_y: T) -> Result<Self, Error> {
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

    #[inline(always)]
    fn inverse(&self) -> [[T; 2]; 2] {
        [[self.alpha_x, T::ZERO], [T::ZERO, self.alpha_y]]
    }

    #[inline]
    fn stretched(&self, scale_x: T, scale_y: T) -> Result<Self, Error> {
        Self::of_map(self.alpha_x / scale_x, self.alpha_y / scale_y)
    }
}
