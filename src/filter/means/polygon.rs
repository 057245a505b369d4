//! Means of distributions over polygons of slopes, exactly: filtering over the parallelogram of a
//! footprint.
//!
//! The mean of P22 over the slopes that the half vectors of a pixel cover is what a box filter over
//! the pixel sees, to first order (Kaplanyan et al. 2016, Eq. 11). For GGX it has a closed form
//! over every polygon. P22 of the unit GGX, 1/(π(1 + |t|²)²), is the differential form factor
//! between a point and the plane at distance 1, t the position in that plane: so its integral over
//! a polygon is Lambert's form factor of the polygon, a sum over its edges,
//!
//! ∫ P22 = 1/(2π) Σ d/√(1+d²) Θ, Θ the angle under which an edge is seen, d its distance from the
//! origin of slopes,
//!
//! and any roughness matrix or map is a linear change of the vertices. Loubet, Zeltner, Holzschuch
//! and Jakob 2020 use the same identity for specular next-event estimation.
//!
//! The sum cancels: for a small polygon like its size, far from the highlight like the cube of the
//! distance, for a thin one like its width. [`mean_p22`] therefore has five forms; each takes over
//! where another would lose digits:
//!
//! | footprint | form | error at the switch |
//! |---|---|---|
//! | sides below 0.2 of ℓ, the distance on which P22 varies | 5 × 5 points of Gauss's product rule | 1e-11 |
//! | the shorter side below 0.03 ℓ | Gauss's rule of three lines, each in closed form | 1e-11 |
//! | thinner than 1e-5 ℓ: a line | three line integrals, weighted by the width of the parallelogram | 1e-10 |
//! | near the highlight | Lambert's formula | 1e-11 |
//! | far from it | the same of a field that vanishes at infinity instead of at the origin | 1e-11 |
//!
//! ℓ² = 1 + (distance of the parallelogram from the highlight)² in units of α. A point is a
//! footprint too: its mean is P22.
//!
//! Beckmann is integrated by error functions along the longer edge and Gauss's rule across; GTR by
//! the product rule on as many cells as its own ℓ asks for.

use crate::Ggx;
use crate::Real;
use crate::filter::MeanOverParallelogram;
use crate::filter::means::{ggx, mean_of};
use crate::map::{Map, seen_by_profile};
use crate::microsurface::Microsurface;

/// The mean of P22 over the parallelogram `slope` ± ½ `dh_du` ± ½ `dh_dv`.
///
/// In a BRDF it takes the place of P22(slope) = D(wm) wm.z⁴.
///
/// # Domain
/// Any parallelogram, degenerate ones included: a line, a point.
///
/// # Special cases
/// Edges or a slope that are not finite, as at half vectors on the horizon, or beyond 1e70 α → 0:
/// the mean over all slopes. NaN → NaN. [`Footprint::clamped`](crate::filter::Footprint::clamped)
/// gives finite edges.
///
/// # Accuracy
/// Evaluated in f64 for both scalars, for edges from 1e-8 to 1e5 α and slopes out to 1e4 α. The
/// largest relative errors found over random footprints: GGX 1.3e-11, and 5e-11 for thin
/// parallelograms whose edges have nearly one direction; Beckmann 8e-10; GTR 1e-9, for edges up to
/// 1e3. GTR over edges of nearly one direction beyond 1e4 of its width has fewer digits.
///
/// # Cost
/// GGX: four arcus tangents, or 25 points where the footprint is small against α. Beckmann: 8 to 72
/// points of two error functions each, 24 where the footprint is larger than α, none where the
/// density is 0: 5,000 to 9,000 instructions for square footprints, 5 to 9 times GGX.
/// [`Microsurface::filtered`] is the cheap way. GTR: 36 densities per cell. The number of cells
/// grows with the logarithm of the edges over α; for edges of nearly one direction it grows with
/// the edges themselves, up to a million.
///
/// # Example
/// ```
/// use microsurface::{Ggx, Ndf, filter::polygon, glam::DVec2};
/// let surface = Ggx::isotropic(0.2_f64)?;
/// let (u, v) = (DVec2::new(0.3, 0.1), DVec2::new(-0.1, 0.2));
/// let mean = polygon::mean_p22(&surface, DVec2::new(0.1, 0.0), u, v);
/// assert!(mean > 0.0 && mean < surface.p22(DVec2::ZERO));
/// // The mean over the plane of slopes times its area is 1.
/// let all = polygon::mean_p22(&surface, DVec2::ZERO, DVec2::new(1e4, 0.0), DVec2::new(0.0, 1e4));
/// assert!((all * 1e8 - 1.0).abs() < 1e-8);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Kaplanyan, Hill, Patney and Lefohn 2016, Eq. 11, who leave the parallelogram of GGX open.
#[must_use]
pub fn mean_p22<P, M>(
    surface: &Microsurface<P, M>,
    slope: <M::Scalar as Real>::Vec2,
    dh_du: <M::Scalar as Real>::Vec2,
    dh_dv: <M::Scalar as Real>::Vec2,
) -> M::Scalar
where
    P: MeanOverParallelogram<M::Scalar>,
    M: Map,
{
    mean_of(surface, slope, dh_du, dh_dv, |centre, u, v| {
        surface.profile().mean_over_parallelogram(centre, u, v)
    })
}

/// ∫ P22 over the polygon of these vertices, in order: the share of facets whose slopes are within.
///
/// # Domain
/// Three or more vertices of a simple polygon, in either direction; fewer enclose nothing. Vertices
/// within 1e70 α.
///
/// # Returns
/// A number in [0, 1].
///
/// # Accuracy
/// Absolute 1e-16 times the number of vertices, so of small or distant polygons few digits are
/// right: [`mean_p22`] is for those.
///
/// # Example
/// ```
/// use microsurface::{Ggx, filter::polygon, glam::DVec2};
/// let quad = [(0.1, 0.05), (0.5, 0.1), (0.45, 0.4), (0.0, 0.3)].map(|(x, y)| DVec2::new(x, y));
/// let share = polygon::integral_p22(&Ggx::isotropic(0.2_f64)?, &quad);
/// assert!((share - 0.0927017183376899).abs() < 1e-15);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Lambert 1760; Loubet, Zeltner, Holzschuch and Jakob 2020, "Slope-space integrals for specular
/// next event estimation".
#[must_use]
pub fn integral_p22<M: Map>(
    surface: &Microsurface<Ggx, M>,
    vertices: &[<M::Scalar as Real>::Vec2],
) -> M::Scalar {
    let seen = |i: usize| seen_by_profile(surface.map(), vertices[i]);
    let edges = (0..vertices.len()).map(|i| ggx::Edge::new(seen(i), seen((i + 1) % vertices.len())).flux());
    let share = edges.fold(0.0, |sum, flux| sum + flux).abs();
    M::Scalar::lit(if share > 1.0 { 1.0 } else { share })
}
