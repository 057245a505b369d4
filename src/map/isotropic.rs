//! The same width in every direction.

use crate::Real;
use crate::alpha::checked;
use crate::error::Error;
use crate::map::axis_aligned::AxisAligned;
use crate::map::{Map, scale};

/// M = I/α: one number. Nothing directional is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
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
        Ok(Self::of_checked(checked(alpha)?))
    }

    /// The map I/α of an α that has been checked.
    #[inline(always)]
    pub(crate) fn of_checked(alpha: T) -> Self {
        Self { alpha, alpha2: alpha * alpha, scale: scale(alpha, alpha) }
    }

    /// I: the profile as it is.
    #[inline]
    pub(crate) fn unit() -> Self {
        Self::of_checked(T::ONE)
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

    #[inline(always)]
    fn inverse(&self) -> [[T; 2]; 2] {
        [[self.alpha, T::ZERO], [T::ZERO, self.alpha]]
    }

    #[inline]
    fn stretched(&self, scale_x: T, scale_y: T) -> Result<AxisAligned<T>, Error> {
        AxisAligned::of_map(self.alpha / scale_x, self.alpha / scale_y)
    }
}
