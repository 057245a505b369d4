//! Hill climbing: the largest value of an objective over a domain, from many random starts.
//!
//! The domain is a function from the unit cube to inputs. A coordinate that chooses between
//! families of inputs, and coordinates that count ulps, make the climber reach edges which no
//! uniform coordinate would meet.
//!
//! Rounding errors are rough functions: two neighbouring inputs have unrelated last bits. The
//! climber therefore does not follow gradients. It keeps the best input seen and tries random moves
//! of all sizes, from the whole cube down to one ulp.

use rand::Rng as _;
use rand_pcg::Pcg64Mcg;

use crate::worst::Worst;

/// How long to search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// Random points to begin with.
    pub(crate) starts: usize,
    /// Moves tried from each of them.
    pub(crate) moves: usize,
    /// The best points, which are climbed again with sixteen times the moves.
    pub(crate) finalists: usize,
}

/// The largest `objective` found over the inputs that `domain` makes of the points of [0, 1)ᴷ.
///
/// A NaN of the objective counts as +∞, so that it cannot hide. The same seed finds the same input.
///
/// # Panics
/// With no starts.
pub(crate) fn worst<const K: usize, I>(
    effort: Effort,
    seed: u64,
    domain: impl Fn([f64; K]) -> I,
    objective: impl Fn(&I) -> f64,
) -> Worst<I> {
    let mut rng = Pcg64Mcg::new(u128::from(seed) << 64 | 0x6d69_6372_6f73);
    let value = |point: [f64; K]| {
        let value = objective(&domain(point));
        if value.is_nan() { f64::INFINITY } else { value }
    };
    let mut points: Vec<(f64, [f64; K])> = (0..effort.starts)
        .map(|_| {
            let point = core::array::from_fn(|_| unit(&mut rng));
            climbed(&mut rng, (value(point), point), effort.moves, value)
        })
        .collect();
    points.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut best = points[0];
    for &finalist in points.iter().take(effort.finalists) {
        let last = climbed(&mut rng, finalist, 16 * effort.moves, value);
        if last.0 > best.0 {
            best = last;
        }
    }
    Worst { error: best.0, at: domain(best.1), count: 1 }
}

/// The best of a point and of what random moves reach from it.
fn climbed<const K: usize>(
    rng: &mut Pcg64Mcg,
    mut best: (f64, [f64; K]),
    moves: usize,
    value: impl Fn([f64; K]) -> f64,
) -> (f64, [f64; K]) {
    for _ in 0..moves {
        let mut point = best.1;
        // One coordinate moves surely, each other one every second time; the sizes are log-uniform
        // down to 2⁻⁵³.
        let sure = (unit(rng) * K as f64) as usize;
        for (k, coordinate) in point.iter_mut().enumerate() {
            if k == sure || unit(rng) < 0.5 {
                let size = (-53.0 * unit(rng)).exp2();
                *coordinate = (*coordinate + size * (2.0 * unit(rng) - 1.0)).rem_euclid(1.0).min(BELOW_ONE);
            }
        }
        let reached = value(point);
        if reached >= best.0 {
            best = (reached, point);
        }
    }
    best
}

/// The largest number below 1: `rem_euclid` may round to 1.
const BELOW_ONE: f64 = 1.0 - 0.5 * f64::EPSILON;

/// Uniform in [0, 1).
fn unit(rng: &mut Pcg64Mcg) -> f64 {
    (rng.next_u64() >> 11) as f64 * (0.5 * f64::EPSILON)
}

#[test]
fn narrow_peaks_are_found() {
    // Of height 3 and a width of 1e-9 in each coordinate, with slopes that lead there.
    let objective = |x: &[f64; 3]| {
        let distance = (0..3).map(|k| (x[k] - 0.3).abs()).fold(0.0, f64::max);
        if distance < 1e-9 { 3.0 } else { -distance }
    };
    let effort = Effort { starts: 20, moves: 200, finalists: 4 };
    let found = worst(effort, 1, |x: [f64; 3]| x, objective);
    assert!(found.error >= 3.0, "{found:?}");
    // Moves alone, without a start close by, are not enough for a plateau: the test above can fail.
    let lost = worst(Effort { starts: 20, moves: 2, finalists: 0 }, 1, |x: [f64; 3]| x, objective);
    assert!(lost.error < 0.0, "{lost:?}");
}

#[test]
fn no_number_is_the_worst() {
    let objective = |&x: &f64| if x > 0.25 && x < 0.26 { f64::NAN } else { x };
    let found = worst(Effort { starts: 50, moves: 20, finalists: 2 }, 1, |[x]: [f64; 1]| x, objective);
    assert!(found.error == f64::INFINITY && (0.25..0.26).contains(&found.at), "{found:?}");
}
