//! The closed form of Kaplanyan, Hill, Patney and Lefohn 2016, as printed.

use microsurface::glam::Vec2;

/// The mean of P22 of GGX over the rectangle of these extents about a slope, none of which is below
/// `least`: Eq. 16 and Appendix A, from h − ½Δ to h + ½Δ as in Eq. 16; §5.2 has `least` = 1e-3.
pub(super) fn mean(alpha: f32, slope: Vec2, extents: Vec2, least: f32) -> f32 {
    let extents = extents.max(Vec2::splat(least));
    let (from, to) = (slope - 0.5 * extents, slope + 0.5 * extents);
    let phi = |x: f32, y: f32| {
        let root = (x * x + alpha * alpha).sqrt();
        x * (y / root).atan() / root
    };
    let around = |x0, x1, y0, y1| phi(x0, y0) - phi(x0, y1) + phi(x1, y1) - phi(x1, y0);
    let sum = around(from.x, to.x, from.y, to.y) + around(from.y, to.y, from.x, to.x);
    sum / (core::f32::consts::TAU * extents.x * extents.y)
}
