//! The mean of a smooth function over a parallelogram, by a product rule on cells.

use crate::Real;
use crate::filter::MeanOverParallelogram;
use crate::gtr::{Gtr, Masking};
use crate::map::Isotropic;
use crate::profile::Profile;

/// Gauss–Legendre nodes in (0, 1), the positive ones of [−1, 1], and weights of mean 1 over all.
const NODES: [f64; 3] = [0.23861918608319690863, 0.66120938646626451366, 0.93246951420315202781];
const WEIGHTS: [f64; 3] = [0.46791393457269104739, 0.36076157304813860757, 0.17132449237917034504];

/// The longest side of a cell in units of its scale.
const SIDE: f64 = 1.0;
/// Splitting in turns needs a stack no deeper than the splits of one path: 2 × 30 for a ratio of
/// 1e9.
const DEPTH: usize = 80;
/// So that edges of one direction and of 1e6 scales and more, whose cells all lie on one line, come
/// to an end.
const MOST_SPLITS: u32 = 1 << 20;

impl<T: Real, K: Masking<T>> MeanOverParallelogram<T> for Gtr<T, K>
where
    Self: Profile<T>,
{
    /// (1 + r²)^{γ−2}/(α² + r²)^γ has its nearest singularities at r = ±iα. Far out it falls as r⁻⁴
    /// for every γ.
    fn mean_over_parallelogram(&self, centre: [f64; 2], u: [f64; 2], v: [f64; 2]) -> f64 {
        let alpha = self.alpha().to_f64();
        let steepness = 1.0 / Real::sqrt(1.0 + self.gamma().to_f64().max(2.0));
        let scale = move |r: f64| steepness * Real::sqrt(alpha * alpha + r * r);
        mean(centre, u, v, scale, p22_of::<T, _>(*self))
    }
}

/// P22 of a profile.
fn p22_of<T: Real, P: Profile<T>>(profile: P) -> impl Fn([f64; 2]) -> f64 {
    let unit = Isotropic::unit();
    move |[x, y]| profile.d(&unit, [T::lit(-x), T::lit(-y), T::ONE], T::ONE).to_f64()
}

/// A part of the parallelogram, in fractions of its edges.
#[derive(Debug, Clone, Copy)]
struct Cell {
    a: f64,
    b: f64,
    width: f64,
    height: f64,
}

/// The mean of f over `centre` ± ½u ± ½v.
///
/// `scale(r)` is the distance on which f varies at the distance r from the origin, growing with r.
/// Cells are halved until their sides are no longer than that; six points in either direction then
/// leave a relative error below 1e-9.
pub(super) fn mean(
    centre: [f64; 2],
    u: [f64; 2],
    v: [f64; 2],
    scale: impl Fn(f64) -> f64,
    f: impl Fn([f64; 2]) -> f64,
) -> f64 {
    let length = |[x, y]: [f64; 2]| crate::Real::sqrt(x * x + y * y);
    let (u_length, v_length) = (length(u), length(v));
    let mut stack = [Cell { a: 0.0, b: 0.0, width: 1.0, height: 1.0 }; DEPTH];
    let (mut count, mut splits, mut sum) = (1, 0, 0.0);
    while count > 0 {
        count -= 1;
        let cell = stack[count];
        let at = |a: f64, b: f64| [centre[0] + a * u[0] + b * v[0], centre[1] + a * u[1] + b * v[1]];
        let (wide, high) = (cell.width * u_length, cell.height * v_length);
        let nearest = length(at(cell.a, cell.b)) - 0.5 * (wide + high);
        let longest = SIDE * scale(if nearest > 0.0 { nearest } else { 0.0 });
        if wide.max(high) <= longest || count + 2 > DEPTH || splits == MOST_SPLITS {
            let mut of_cell = 0.0;
            for (x, wx) in NODES.iter().zip(WEIGHTS) {
                for (y, wy) in NODES.iter().zip(WEIGHTS) {
                    let (dx, dy) = (0.5 * cell.width * x, 0.5 * cell.height * y);
                    let corners = f(at(cell.a - dx, cell.b - dy))
                        + f(at(cell.a - dx, cell.b + dy))
                        + f(at(cell.a + dx, cell.b - dy))
                        + f(at(cell.a + dx, cell.b + dy));
                    of_cell += wx * wy * corners;
                }
            }
            sum += 0.25 * of_cell * cell.width * cell.height;
        } else {
            // Across the longer side, so that a line stays one.
            let half = |offset: f64| {
                if wide >= high {
                    Cell { a: cell.a + offset * cell.width, width: 0.5 * cell.width, ..cell }
                } else {
                    Cell { b: cell.b + offset * cell.height, height: 0.5 * cell.height, ..cell }
                }
            };
            (stack[count], stack[count + 1]) = (half(-0.25), half(0.25));
            count += 2;
            splits += 1;
        }
    }
    sum
}
