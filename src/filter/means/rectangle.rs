//! Means of distributions over boxes of slopes.
//!
//! The bounding rectangle of a footprint
//! ([`Footprint::extents`](crate::filter::Footprint::extents)) covers more than the half vectors of
//! the pixel: highlights come out wider than they are, and steadier where normals are poor. The
//! mean over the parallelogram itself, [`polygon::mean_p22`](crate::filter::polygon::mean_p22),
//! costs the same.

use crate::Real;
use crate::filter::MeanOverParallelogram;
use crate::filter::means::mean_of;
use crate::map::{Map, factor};
use crate::microsurface::Microsurface;

/// The mean of P22 over the box `slope` ± `half_extents`, along the axes of the frame.
///
/// Equals [`polygon::mean_p22`](crate::filter::polygon::mean_p22); for Beckmann surfaces along the
/// axes a product of differences of error functions.
///
/// # Domain
/// Any box, a line or a point too; the signs of the extents do not matter.
///
/// # Special cases
/// As of [`polygon::mean_p22`](crate::filter::polygon::mean_p22).
///
/// # Accuracy
/// Evaluated in f64 for both scalars. GGX and GTR: that of
/// [`polygon::mean_p22`](crate::filter::polygon::mean_p22); Beckmann: relative 2e-14 (1 + t²) of a
/// slope t in units of α.
///
/// # Example
/// ```
/// use microsurface::{Ggx, filter::rectangle, glam::DVec2};
/// // x from 0.1 to 0.5, y from −0.05 to 0.3.
/// let (slope, half) = (DVec2::new(0.3, 0.125), DVec2::new(0.2, 0.175));
/// let mean = rectangle::mean_p22(&Ggx::isotropic(0.2_f64)?, slope, half);
/// assert!((mean * 4.0 * half.x * half.y - 0.124474031492067).abs() < 1e-14);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, Eq. 16 and Appendix A, whose integral from h − Δ to h +
/// Δ is divided by a quarter of that area: as printed it is 4 times the mean.
#[must_use]
pub fn mean_p22<P, M>(
    surface: &Microsurface<P, M>,
    slope: <M::Scalar as Real>::Vec2,
    half_extents: <M::Scalar as Real>::Vec2,
) -> M::Scalar
where
    P: MeanOverParallelogram<M::Scalar>,
    M: Map,
{
    let [x, y]: [M::Scalar; 2] = half_extents.into();
    let (zero, two) = (M::Scalar::ZERO, M::Scalar::TWO);
    let [_, r12, _] = factor(surface.map());
    mean_of(surface, slope, [two * x, zero].into(), [zero, two * y].into(), |centre, u, v| {
        if r12 == 0.0 {
            surface.profile().mean_over_box(centre, [0.5 * u[0], 0.5 * v[1]])
        } else {
            surface.profile().mean_over_parallelogram(centre, u, v)
        }
    })
}
