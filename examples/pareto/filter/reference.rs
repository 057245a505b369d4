//! Filtered GGX by adaptive quadrature in f64, independent of the crate.

use std::io::{self, Write};

use microsurface::glam::DVec2;

/// Gauss–Legendre's eight points on [−1, 1]: the positive nodes, and their weights.
const NODES: [f64; 4] =
    [0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_2];
const WEIGHTS: [f64; 4] =
    [0.362_683_783_378_362, 0.313_706_645_877_887_3, 0.222_381_034_453_374_48, 0.101_228_536_290_376_26];
/// Of the largest part, what its halves may differ from a part by.
const TOLERANCE: f64 = 1e-12;

/// P22 of the unit GGX.
fn p22(t: DVec2) -> f64 {
    let sum = 1.0 + t.length_squared();
    core::f64::consts::FRAC_1_PI / (sum * sum)
}

/// The mean of f over [−1, 1].
fn rule(mut f: impl FnMut(f64) -> f64) -> f64 {
    NODES.iter().zip(WEIGHTS).fold(0.0, |sum, (x, w)| sum + 0.5 * w * (f(*x) + f(-x)))
}

/// The mean of the unit GGX over the parallelogram centre ± ½u ± ½v: parts are halved until they
/// agree with their halves.
pub(super) fn mean(centre: DVec2, u: DVec2, v: DVec2) -> f64 {
    let part = |centre: DVec2, u: DVec2, v: DVec2| rule(|x| rule(|y| p22(centre + 0.5 * (x * u + y * v))));
    let mut total = 0.0_f64;
    let mut stack = vec![(centre, u, v, 1.0, part(centre, u, v), 0)];
    while let Some((centre, u, v, share, coarse, depth)) = stack.pop() {
        let (long, short) = if u.length() >= v.length() { (u, v) } else { (v, u) };
        let half = 0.5 * long;
        let halves = [-0.5, 0.5].map(|side| {
            let centre = centre + side * half;
            (centre, half, short, 0.5 * share, part(centre, half, short), depth + 1)
        });
        let fine = 0.5 * (halves[0].4 + halves[1].4);
        // Where it is much wider than its distance from the highlight it may have overlooked it.
        let nearest = (centre.length() - 0.5 * (u.length() + v.length())).max(0.0);
        let agrees = long.length() < 2.0 + nearest
            && share * (fine - coarse).abs() <= TOLERANCE * total.max(share * fine);
        if agrees || depth > 60 {
            total += share * fine;
        } else {
            stack.extend(halves);
        }
    }
    total
}

/// ∫ f over [from, to], of one sign, in parts that begin and end at `ends` and are then halved.
fn integral(f: impl Fn(f64) -> f64, ends: &mut Vec<f64>, from: f64, to: f64) -> f64 {
    ends.retain(|&x| x > from && x < to);
    ends.extend([from, to]);
    ends.sort_by(f64::total_cmp);
    let part = |a: f64, b: f64| (b - a) * rule(|x| f(0.5 * (a + b) + 0.5 * (b - a) * x));
    let mut stack: Vec<_> =
        ends.windows(2).map(|pair| (pair[0], pair[1], part(pair[0], pair[1]), 0)).collect();
    let estimate: f64 = stack.iter().map(|&(_, _, coarse, _)| coarse).sum();
    let mut total = 0.0_f64;
    while let Some((a, b, coarse, depth)) = stack.pop() {
        let middle = 0.5 * (a + b);
        let halves = [(a, middle), (middle, b)].map(|(a, b)| (a, b, part(a, b), depth + 1));
        let fine = halves[0].2 + halves[1].2;
        if (fine - coarse).abs() <= TOLERANCE * estimate.max(total) || depth > 60 {
            total += fine;
        } else {
            stack.extend(halves);
        }
    }
    total
}

/// Standard deviations to which a Gaussian is followed: beyond, 1e-18 of it is left.
const REACH: f64 = 9.0;

/// The unit GGX convolved with a Gaussian of variance σ² in every direction, by polar coordinates
/// about its centre: ∫ r e^{−r²/2σ²}/σ² g(r) dr, g the mean of P22 on the circle of radius r about
/// the slope.
pub(super) fn isotropic(slope: f64, sigma: f64) -> f64 {
    let on_circle = |r: f64| {
        // (1 + t² + r²)² − 4 t² r², as a product that does not cancel.
        let product = (1.0 + (slope - r) * (slope - r)) * (1.0 + (slope + r) * (slope + r));
        core::f64::consts::FRAC_1_PI * (1.0 + slope * slope + r * r) / (product * product.sqrt())
    };
    let integrand = |r: f64| {
        let x = r / sigma;
        x / sigma * (-0.5 * x * x).exp() * on_circle(r)
    };
    let mut ends: Vec<f64> = [-3.0, -1.0, 0.0, 1.0, 3.0].iter().map(|x| slope + x).collect();
    ends.extend([0.3, 1.0, 2.0, 4.0].map(|x| sigma * x));
    ends.extend([0.3, 1.0, 3.0]);
    integral(integrand, &mut ends, 0.0, REACH * sigma)
}

/// The unit GGX convolved with a Gaussian along a line, of the standard deviation |σ| in the
/// direction of σ.
pub(super) fn line(slope: DVec2, sigma: DVec2) -> f64 {
    let root = core::f64::consts::TAU.sqrt();
    let integrand = |x: f64| (-0.5 * x * x).exp() / root * p22(slope - x * sigma);
    let length = sigma.length();
    // Where the line passes the highlight.
    let nearest = slope.dot(sigma) / (length * length);
    let mut ends: Vec<f64> =
        [-10.0, -3.0, -1.0, 0.0, 1.0, 3.0, 10.0].iter().map(|x| nearest + x / length).collect();
    ends.extend([-4.0, -2.0, 0.0, 2.0, 4.0]);
    integral(integrand, &mut ends, -REACH, REACH)
}

/// 30-digit values of isotropic kernels: s = 2σ², |t|², P22.
const TABLE: &str = include_str!("../../../tests/reference/filter_gaussian.tsv");

/// Compares the quadratures with what is known otherwise, and prints the largest relative
/// differences.
pub(super) fn validate(out: &mut impl Write) -> io::Result<()> {
    // The share of facets within a rectangle, Kaplanyan et al. 2016, Appendix A, in 30 digits: x
    // from 0.5 to 2.5, y from −0.25 to 1.5; and everything.
    let rectangle = 3.5 * mean(DVec2::new(1.5, 0.625), 2.0 * DVec2::X, 1.75 * DVec2::Y);
    let rectangle = (rectangle / 0.124_474_031_492_067 - 1.0).abs();
    let all = (1e12 * mean(DVec2::ONE, 1e6 * DVec2::X, 1e6 * DVec2::Y) - 1.0).abs();
    let mut worst = 0.0_f64;
    for line in TABLE.lines().filter(|line| !line.starts_with('#')) {
        let row: Vec<f64> = line.split('\t').map(|field| field.parse().unwrap_or(f64::NAN)).collect();
        let [s, q, exact] = row[..] else { continue };
        worst = worst.max((isotropic(q.sqrt(), (0.5 * s).sqrt()) / exact - 1.0).abs());
    }
    // A kernel along x of a line and the same again along y are one in every direction.
    let sigma = 0.7_f64;
    let slope = DVec2::new(1.2, 0.4);
    let again = |y: f64| {
        (-0.5 * y * y).exp() / core::f64::consts::TAU.sqrt()
            * line(slope - y * sigma * DVec2::Y, sigma * DVec2::X)
    };
    let twice = integral(again, &mut vec![-2.0, 0.0, 2.0], -REACH, REACH);
    let lines = (twice / isotropic(slope.length(), sigma) - 1.0).abs();
    writeln!(
        out,
        "Reference quadratures of filters, largest relative difference: a rectangle {rectangle:.1e}, "
    )?;
    writeln!(
        out,
        "everything {all:.1e}; isotropic kernels from 30-digit values {worst:.1e}, lines across lines "
    )?;
    writeln!(out, "from them {lines:.1e}.\n")
}
