//! Derivatives by differences of neighbouring pixels, as shaders take them.

use crate::filter::Footprint;
use crate::real::{Real, Vector};

/// The values of some vector in four neighbouring pixels, two by two.
///
/// For what has no derivatives in closed form, or none that are cheaper: the vector is computed for
/// four pixels and subtracted. N = 2 for half vectors, in slopes or projected, which make a
/// [`Footprint`]; N = 3 for normals.
///
/// The error is of the first order in the size of a pixel. It is half the second derivative for a
/// pixel of the quad: seldom small where a footprint is large, hence the
/// [limits](Footprint::clamped), and the biased but steadier
/// [bounds](Footprint::covariance_of_bounds). Where pixels of a quad see different surfaces the
/// differences are wrong altogether.
///
/// # Example
/// ```
/// use microsurface::{filter::quad::Quad, glam::Vec2};
/// // Of the half vectors (u², v) at the pixels u, v = 0, 1.
/// let slopes = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];
/// let quad = Quad::new(slopes);
/// assert_eq!(quad.coarse_footprint().steps(), [Vec2::X, Vec2::Y]);
/// assert_eq!(quad.mean(), [0.5, 0.5]);
/// ```
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, §5.1; Tokuyoshi 2017, Listings 1–3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quad<T, const N: usize> {
    /// Rows, u running faster than v.
    values: [[T; N]; 4],
}

impl<T: Real, const N: usize> Quad<T, N> {
    /// The values at (0, 0), (1, 0), (0, 1), (1, 1): u first, then v. Vectors of glam or arrays.
    #[inline]
    #[must_use]
    pub fn new(values: [impl Vector<N, Scalar = T>; 4]) -> Self {
        Self { values: values.map(Vector::components) }
    }

    #[inline]
    fn difference(&self, to: usize, from: usize) -> [T; N] {
        core::array::from_fn(|i| self.values[to][i] - self.values[from][i])
    }

    /// The steps per pixel along u and v, one pair for the quad, taken at (0, 0): `ddx_coarse`,
    /// `ddy_coarse`.
    #[inline]
    #[must_use]
    pub fn coarse(&self) -> [[T; N]; 2] {
        [self.difference(1, 0), self.difference(2, 0)]
    }

    /// The steps per pixel along u and v at a pixel, along its row and its column: `ddx_fine`,
    /// `ddy_fine`.
    ///
    /// Only the parity of the pixel's coordinates counts, so those of the picture will do where
    /// quads begin at even ones.
    #[inline]
    #[must_use]
    pub fn fine(&self, [u, v]: [usize; 2]) -> [[T; N]; 2] {
        let (column, row) = (u & 1, 2 * (v & 1));
        [self.difference(row + 1, row), self.difference(column + 2, column)]
    }

    /// The mean of the four.
    #[inline]
    #[must_use]
    pub fn mean(&self) -> [T; N] {
        let [a, b, c, d] = self.values;
        let quarter = T::HALF * T::HALF;
        core::array::from_fn(|i| (a[i] + b[i] + (c[i] + d[i])) * quarter)
    }
}

impl<T: Real> Quad<T, 2> {
    /// The footprint of the [`coarse`](Self::coarse) steps.
    #[inline]
    #[must_use]
    pub fn coarse_footprint(&self) -> Footprint<T> {
        let [du, dv] = self.coarse();
        Footprint::of_rows([du, dv])
    }

    /// The footprint of the [`fine`](Self::fine) steps at a pixel.
    #[inline]
    #[must_use]
    pub fn fine_footprint(&self, pixel: [usize; 2]) -> Footprint<T> {
        let [du, dv] = self.fine(pixel);
        Footprint::of_rows([du, dv])
    }
}
