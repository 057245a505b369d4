//! Means of distributions over boxes of slopes.
//!
//! The bounding rectangle of a footprint
//! ([`Footprint::extents`](crate::filter::Footprint::extents)) covers more than the half vectors of
//! the pixel: highlights come out wider than they are, and steadier where normals are poor. The
//! mean over the parallelogram itself, [`polygon::mean_p22`](crate::filter::polygon::mean_p22),
//! costs the same.

use crate::Real;
use crate::elementary::atan2;
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

/// The α' of the GGX surface whose peak is the mean of a GGX surface over a square of slopes about
/// its own peak, `side` long.
///
/// α'² = (α² + h²) k/atan k with h = side/2 and k = h/√(α² + h²): a normal map or a quad filtered
/// to one number, with the brightness of the highlight's centre kept.
///
/// # Domain
/// α as constructors take it; any side whose square does not overflow, its sign does not matter.
///
/// # Accuracy
/// Computed in f64 and rounded once; 4 ε in f64.
///
/// # Example
/// ```
/// use microsurface::filter::rectangle::alpha_of_equal_peak;
/// assert!((alpha_of_equal_peak(0.1_f32, 0.4) - 0.2476).abs() < 1e-4);
/// ```
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, Eqs. 18–20; the first line of the last cannot be read
/// in the paper and is derived here.
#[must_use]
pub fn alpha_of_equal_peak<T: Real>(alpha: T, side: T) -> T {
    let [alpha, half] = [alpha.to_f64(), 0.5 * side.to_f64().abs()];
    let sum = alpha * alpha + half * half;
    let k = half / Real::sqrt(sum);
    // k/atan k = 1 + k²/3 + …
    let ratio = if k * k < f64::EPSILON { 1.0 } else { k / atan2(k, 1.0) };
    T::lit(Real::sqrt(sum * ratio))
}
