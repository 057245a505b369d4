//! Structures of arrays: directions, random numbers, samples.

/// Unit vectors, their components in three slices of equal length.
///
/// # Example
/// ```
/// use microsurface::batch::Directions;
/// let up = Directions { x: &[0.0_f32; 4], y: &[0.0; 4], z: &[1.0; 4] };
/// assert_eq!(up.len(), 4);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Directions<'a, T> {
    /// First components.
    pub x: &'a [T],
    /// Second components.
    pub y: &'a [T],
    /// Components along the normal.
    pub z: &'a [T],
}

impl<T> Directions<'_, T> {
    /// The number of directions: the length of `x`, which the other slices must have too.
    #[inline]
    #[must_use]
    pub const fn len(&self) -> usize {
        self.x.len()
    }

    /// No directions.
    #[inline]
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.x.is_empty()
    }
}

/// Where directions are written, three slices of equal length.
///
/// # Example
/// ```
/// use microsurface::batch::{DirectionsMut, NdfBatch, Numbers};
/// use microsurface::Ggx;
/// let (mut x, mut y, mut z) = ([0.0_f32; 2], [0.0; 2], [0.0; 2]);
/// let mut wm = DirectionsMut { x: &mut x, y: &mut y, z: &mut z };
/// Ggx::isotropic(0.2)?.sample_d_batch(Numbers { x: &[0.0, 0.5], y: &[0.25, 0.5] }, wm.reborrow());
/// assert_eq!(wm.as_directions().z[0], 1.0);
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, PartialEq)]
pub struct DirectionsMut<'a, T> {
    /// First components.
    pub x: &'a mut [T],
    /// Second components.
    pub y: &'a mut [T],
    /// Components along the normal.
    pub z: &'a mut [T],
}

impl<T> DirectionsMut<'_, T> {
    /// Borrows the slices for one call.
    #[inline]
    #[must_use]
    pub const fn reborrow(&mut self) -> DirectionsMut<'_, T> {
        DirectionsMut { x: self.x, y: self.y, z: self.z }
    }

    /// The directions written so far.
    #[inline]
    #[must_use]
    pub const fn as_directions(&self) -> Directions<'_, T> {
        Directions { x: self.x, y: self.y, z: self.z }
    }
}

/// Random numbers u ∈ [0, 1)², 0 included: u.x and u.y in two slices of equal length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numbers<'a, T> {
    /// First numbers.
    pub x: &'a [T],
    /// Second numbers.
    pub y: &'a [T],
}

/// Where samples of a BSDF are written, slices of equal length: a [`Sample`](crate::bsdf::Sample)
/// each, or its absence.
///
/// Where there is no sample `weight` and `pdf` are 0, and `wi` is no direction to follow.
#[derive(Debug, PartialEq)]
pub struct Samples<'a, T, S> {
    /// Directions to the light.
    pub wi: DirectionsMut<'a, T>,
    /// f(wi, wo) wi.z / pdf.
    pub weight: &'a mut [S],
    /// Densities of `wi`, 1/sr.
    pub pdf: &'a mut [T],
}
