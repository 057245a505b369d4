//! Pearson's χ² test of a sampler against the density the crate gives for it.
//!
//! Samples are counted in a grid of cells of a [`Chart`]; the expectation of a cell is N ∫ density,
//! integrated numerically with an error far below the Poisson noise √E. Under the hypothesis that
//! the sampler has this density, Σ (O − E)²/E follows the χ² distribution with one degree of
//! freedom less than there are cells (the total is fixed), provided that no E is small: cells of E
//! < 5 are pooled. Three things reject without statistics: a sample where the density is 0, a
//! density that does not integrate to 1, and a sample that is no unit vector.

use core::fmt::Write;

use microsurface::verify::statistics::{Counted, Pearson, pearson};

use crate::chart::Chart;
use crate::points::Points;
use crate::quadrature::{Mass, Quadrature, total};
use crate::special::count;

/// The smallest expectation for which Poisson counts are close enough to normal (Cochran 1954).
const SMALLEST_EXPECTATION: f64 = 5.0;

/// The share of the Poisson noise √E of a cell the error of its expectation may be. A systematic
/// error of that share in every cell raises χ² by 4e-4 of its degrees of freedom.
const SHARE_OF_NOISE: f64 = 0.02;

/// A sampler and the density to compare it with.
pub(crate) struct Subject<'a> {
    pub(crate) label: String,
    pub(crate) chart: &'a dyn Chart,
    /// A normal.
    pub(crate) sample: &'a mut dyn FnMut([f64; 2]) -> [f64; 3],
    /// The density of the normal, 1/sr.
    pub(crate) density: &'a dyn Fn([f64; 3]) -> f64,
    /// By how much the integral may be off because the mask is approximate; expectations are then
    /// shares of it.
    pub(crate) masking: f64,
    /// The unit roundoff of the scalar under test.
    pub(crate) epsilon: f64,
}

/// The numbers of a test.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    pub(crate) samples: usize,
    pub(crate) rows: u32,
    pub(crate) columns: u32,
    /// How often a cell is quartered for the quadrature, at most.
    pub(crate) depth: u32,
}

impl Effort {
    /// 16 × 10 cells, of about 800 samples each but for the tails: 3 % of α shift the GGX statistic
    /// by 7 σ.
    pub(crate) const QUICK: Self = Self { samples: 100_000, rows: 12, columns: 10, depth: 3 };
    /// Resolves errors ten times smaller.
    pub(crate) const LONG: Self = Self { samples: 10_000_000, rows: 24, columns: 24, depth: 8 };

    /// The edges of the cells in (u₁, u₂): even, with thinner cells for both tails of the first
    /// axis.
    fn edges(self) -> [Vec<f64>; 2] {
        let even = |n: u32| (0..=n).map(move |i| f64::from(i) / f64::from(n));
        let mut first: Vec<f64> = even(self.rows).chain([0.001, 0.01, 0.99, 0.999]).collect();
        first.sort_by(f64::total_cmp);
        [first, even(self.columns).collect()]
    }
}

/// A cell of the table: where it is, what was seen and what was expected.
#[derive(Debug, Clone)]
struct Cell {
    place: String,
    counted: Counted,
}

/// The result of a test.
pub(crate) struct Outcome {
    pub(crate) label: String,
    pub(crate) statistic: f64,
    pub(crate) dof: usize,
    pub(crate) p_value: f64,
    /// ∫ density.
    pub(crate) mass: Mass,
    /// Why the test fails whatever p is.
    pub(crate) impossible: Option<String>,
    cells: Vec<Cell>,
}

impl Outcome {
    /// The reason for rejection at this significance, with the cells that deviate most.
    pub(crate) fn rejection(&self, significance: f64) -> Option<String> {
        let unlikely = self.p_value < significance || self.p_value.is_nan();
        let reason = match &self.impossible {
            Some(reason) => reason.clone(),
            None if unlikely => format!("p = {:.3e} < {significance:.3e}", self.p_value),
            None => return None,
        };
        let mut cells: Vec<&Cell> = self.cells.iter().collect();
        cells.sort_by(|a, b| b.counted.contribution().total_cmp(&a.counted.contribution()));
        let mut text = format!(
            "{}: {reason}\n  chi2 = {:.1} with {} degrees of freedom, mass = {:.9} ± {:.1e}\n",
            self.label, self.statistic, self.dof, self.mass.value, self.mass.error
        );
        for cell in cells.iter().take(8) {
            writeln!(
                text,
                "  {:>46}  observed {:>9}  expected {:>12.2}  {:>+8.1} sigma",
                cell.place,
                cell.counted.observed,
                cell.counted.expected,
                (cell.counted.observed - cell.counted.expected) / cell.counted.expected.sqrt()
            )
            .expect("writing to a string");
        }
        Some(text)
    }
}

/// Runs the test on the numbers of `points`.
pub(crate) fn test(mut subject: Subject<'_>, effort: Effort, points: &mut dyn Points) -> Outcome {
    let n = count(effort.samples);
    let edges = effort.edges();
    let tolerance = |mass: f64| SHARE_OF_NOISE * (mass / n).max(SMALLEST_EXPECTATION / (n * n)).sqrt();
    let masses = Quadrature::new(subject.chart, subject.density, effort.depth).grid(&edges, &tolerance);
    let mass = total(&masses);
    // The integrals are sums of numbers that carry a rounding of the density, up to some 10 ε,
    // each.
    let allowance = mass.error + 64.0 * subject.epsilon + 1e-9 + subject.masking;
    let excess = (mass.value - 1.0).abs();
    let mut impossible =
        (excess > allowance).then(|| format!("the density integrates to {} ± {allowance:.1e}", mass.value));
    for (mass, place) in masses.iter().zip(places(&edges)) {
        // Ten times the tolerance: what the depth of refinement left of a discontinuity.
        if mass.error > 10.0 * tolerance(mass.value) && impossible.is_none() {
            impossible = Some(format!("no quadrature of {place}: {} ± {:.1e}", mass.value, mass.error));
        }
    }
    let counts = histogram(&mut subject, effort.samples, &edges, points, &mut impossible);
    let scale = if subject.masking > 0.0 { n / mass.value } else { n };
    let cells: Vec<Cell> = masses
        .iter()
        .zip(counts)
        .zip(places(&edges))
        .map(|((mass, observed), place)| Cell {
            place,
            counted: Counted { observed: count(observed), expected: scale * mass.value },
        })
        .collect();
    let counted: Vec<Counted> = cells.iter().map(|cell| cell.counted).collect();
    let Pearson { statistic, freedom, p_value } = pearson(&counted);
    Outcome { label: subject.label, statistic, dof: freedom, p_value, mass, impossible, cells }
}

/// The counts of the cells; the first impossible sample is reported.
fn histogram(
    subject: &mut Subject<'_>,
    samples: usize,
    edges: &[Vec<f64>; 2],
    points: &mut dyn Points,
    impossible: &mut Option<String>,
) -> Vec<usize> {
    // The inner edges, as coordinates: a sample is binned without evaluating a distribution
    // function.
    let cuts = [0, 1].map(|axis: usize| -> Vec<f64> {
        let inner = &edges[axis][1..edges[axis].len() - 1];
        inner.iter().map(|&u| subject.chart.quantile(axis, u)).collect()
    });
    let columns = cuts[1].len() + 1;
    let mut counts = vec![0; (cuts[0].len() + 1) * columns];
    for i in 0..samples {
        let u = points.point(i);
        let m = (subject.sample)(u);
        let length2 = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
        let unit = (length2 - 1.0).abs() <= 16.0 * subject.epsilon;
        let possible = (subject.density)(m) > 0.0;
        if !(unit && possible && m[2] >= 0.0) {
            let what = if unit { "of density 0" } else { "not a unit vector" };
            impossible.get_or_insert_with(|| format!("u = {u:?} gives {m:?}, {what}"));
        }
        let c = subject.chart.coordinates(m);
        let [row, column] = [0, 1].map(|axis| cuts[axis].partition_point(|&cut| cut <= c[axis]));
        counts[row * columns + column] += 1;
    }
    counts
}

/// The ranges of (u₁, u₂) of the cells, in the order of the masses.
fn places(edges: &[Vec<f64>; 2]) -> impl Iterator<Item = String> {
    let rows = edges[0].windows(2).map(|e| [e[0], e[1]]);
    rows.flat_map(move |[a, b]| {
        let columns = edges[1].windows(2).map(|e| [e[0], e[1]]);
        columns.map(move |[c, d]| format!("u1 {a:.4}..{b:.4}, u2 {c:.4}..{d:.4}"))
    })
}
