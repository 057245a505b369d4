//! A sampler of directions against its density: χ², and the test of Kolmogorov and Smirnov.

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use rand::Rng;

use super::Kit;
use super::arguments::Arguments;
use super::cell_map::cell_map;
use super::float::{Float, dot, hex, wide, within};
use super::integral::{Integral, Precision};
use super::report::{Report, Seen, Verdict};
use super::sphere::{Cell, Cells, Chart};
use super::statistics::{Counted, Pearson, count, kolmogorov, pearson, two_sided};

/// A sampler and what it must agree with.
pub(super) struct Sampler<'a, T> {
    /// Where it is looked at from, for messages.
    pub(super) view: String,
    /// A direction and its weight, or none.
    pub(super) sample: &'a dyn Fn([T; 2]) -> Option<([T; 3], f64)>,
    /// The density by solid angle.
    pub(super) density: &'a dyn Fn([f64; 3]) -> f64,
    /// The function whose integral is the mean weight, if weights mean something.
    pub(super) integrand: Option<&'a dyn Fn([f64; 3]) -> f64>,
    /// Whether some samples may be none.
    pub(super) may_miss: bool,
    /// Whether directions may be below the horizon.
    pub(super) below: bool,
}

/// The names of the checks of one sampler.
pub(super) struct Names {
    pub(super) usable: &'static str,
    pub(super) integral: &'static str,
    pub(super) cells: &'static str,
    pub(super) near: &'static str,
    pub(super) around: &'static str,
    pub(super) weights: &'static str,
}

/// Rows and columns of a hemisphere.
const ROWS: usize = 32;
const COLUMNS: usize = 6;
/// The share of the noise of a cell that the error of its expectation may be.
const SHARE_OF_NOISE: f64 = 0.05;
/// The relative error that is asked of the integrals over a hemisphere, at most.
const ASKED: f64 = 1e-3;

/// Everything that is known of a hemisphere: its cells, and the integrals of density and integrand
/// over them.
pub(super) struct Hemisphere {
    pub(super) cells: Cells,
    pub(super) integrals: Vec<Integral<2>>,
    pub(super) counts: Vec<usize>,
}

impl Hemisphere {
    fn new<T: Float>(sampler: &Sampler<'_, T>, pilot: &[([f64; 3], f64)], upper: bool, samples: f64) -> Self {
        let in_it: Vec<[f64; 3]> = pilot.iter().map(|(d, _)| *d).filter(|d| (d[2] >= 0.0) == upper).collect();
        // The mean weight, so that both integrals are of the size of 1.
        let mean = pilot.iter().map(|(_, weight)| weight).sum::<f64>() / count(pilot.len());
        let scale = if mean.is_finite() && mean > 0.0 { mean } else { 1.0 };
        let up = [0.0, 0.0, if upper { 1.0 } else { -1.0 }];
        // The peak is where the density is largest.
        let peak = in_it.iter().copied().map(|d| ((sampler.density)(d), d)).filter(|(p, _)| p.is_finite());
        let peak = peak.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(up, |(_, d)| d);
        let (rows, columns) = if in_it.len() < 2000 { (4, 2) } else { (ROWS, COLUMNS) };
        let cells = Cells::new(Chart::new(peak, upper), &in_it, rows, columns);
        let expected = 1.0 / count(cells.len());
        let absolute = SHARE_OF_NOISE * (expected / samples).sqrt();
        let precision = Precision { absolute: absolute.min(ASKED * expected), relative: 0.0, panels: 40 };
        let integrand = |d: [f64; 3]| [(sampler.density)(d), sampler.integrand.map_or(0.0, |f| f(d) / scale)];
        let integral = |cell: Cell| {
            let mut found = cells.chart.integral(integrand, &cell, precision);
            found.value[1] *= scale;
            found.bound[1] *= scale;
            found
        };
        let integrals = cells.cells().map(|(_, cell)| integral(cell)).collect();
        let counts = vec![0; cells.len()];
        Self { cells, integrals, counts }
    }
}

/// The running mean and variance of weights (Welford 1962), and the largest.
#[derive(Default)]
struct Weights {
    n: f64,
    mean: f64,
    squares: f64,
    largest: f64,
}

impl Weights {
    fn add(&mut self, weight: f64) {
        self.n += 1.0;
        let difference = weight - self.mean;
        self.mean += difference / self.n;
        self.squares += difference * (weight - self.mean);
        self.largest = self.largest.max(weight.abs());
    }

    fn standard_error(&self) -> f64 {
        (self.squares / (self.n * (self.n - 1.0))).sqrt()
    }

    /// Whether the mean of n such weights is normal: no weight alone makes a tenth of the variance;
    /// or moves the mean by more than the integral is known to, so that it does not matter.
    fn is_normal(&self, bound: f64) -> bool {
        let largest = self.largest - self.mean;
        largest <= self.n * bound || largest * largest <= 0.1 * self.squares
    }
}

impl Kit {
    /// Checks one sampler: χ², Kolmogorov–Smirnov, integral of the density, mean weight. Gives the
    /// integral of the integrand over each hemisphere, with its bound.
    pub(super) fn sampler<T: Float>(
        &self,
        report: &mut Report,
        sampler: &Sampler<'_, T>,
        names: &Names,
        arguments: &mut Arguments<impl Rng>,
    ) -> Vec<(bool, [f64; 2])> {
        if self.progress {
            std::eprintln!("{} samples, {}", self.samples, sampler.view);
        }
        let pilot: Vec<([f64; 3], f64)> = (0..(self.samples / 4).clamp(2000, 20_000))
            .filter_map(|_| (sampler.sample)(arguments.point()))
            .map(|(d, weight)| (wide(d), weight))
            .filter(|(d, _)| d.iter().all(|c| c.is_finite()))
            .collect();
        let n = count(self.samples);
        let sides: &[bool] = if sampler.below { &[true, false] } else { &[true] };
        let mut hemispheres: Vec<Hemisphere> =
            sides.iter().map(|&upper| Hemisphere::new(sampler, &pilot, upper, n)).collect();

        let (mut unusable, mut missed, mut weights) = (None, 0, Weights::default());
        for _ in 0..self.samples {
            let u = arguments.point::<T>();
            let Some((direction, weight)) = (sampler.sample)(u) else {
                missed += 1;
                weights.add(0.0);
                continue;
            };
            weights.add(weight);
            let d = wide(direction);
            if let Some(fault) = fault(sampler, d, weight) {
                unusable.get_or_insert_with(|| format!("{fault}: {} of u {}", hex(&direction), hex(&u)));
            }
            let side = usize::from(sampler.below && d[2] < 0.0);
            if d.iter().all(|c| c.is_finite()) {
                let index = hemispheres[side].cells.index(d);
                hemispheres[side].counts[index] += 1;
            }
        }
        if missed > 0 && !sampler.may_miss {
            unusable.get_or_insert_with(|| format!("{missed} of {} samples are none", self.samples));
        }
        let verdict = if unusable.is_some() { Verdict::Failed } else { Verdict::Passed };
        report.push_verdict(names.usable, verdict, unusable.unwrap_or_else(|| sampler.view.clone()));
        self.integral_of_density(report, sampler, names, &hemispheres, missed);
        self.counts::<T>(report, sampler, names, &hemispheres, missed);
        if sampler.integrand.is_some() {
            mean_weight(report, sampler, names, &hemispheres, &weights);
        }
        let integrals = |h: &Hemisphere| (h.cells.chart.upper, total(core::slice::from_ref(h)).pair(1));
        hemispheres.iter().map(integrals).collect()
    }

    /// ∫ density is 1, or what the samples that are none leave.
    fn integral_of_density<T: Float>(
        &self,
        report: &mut Report,
        sampler: &Sampler<'_, T>,
        names: &Names,
        hemispheres: &[Hemisphere],
        missed: usize,
    ) {
        let total = total(hemispheres);
        let [value, bound] = total.pair(0);
        let n = count(self.samples);
        let expected = 1.0 - count(missed) / n;
        let at = format!("∫ = {value:.6} ± {bound:.0e}, {expected:.6} of the samples, {}", sampler.view);
        // Twice what was asked of each of two hemispheres: beyond it the quadrature has failed.
        if !within(bound, 4.0 * ASKED) {
            report.push_verdict(names.integral, Verdict::Undecided, at);
        } else if missed == 0 && !sampler.may_miss || value - bound > 1.0 + self.tolerance::<T>() {
            let off = ((value - 1.0).abs() - bound).max(0.0);
            let mut seen = Seen::default();
            seen.see(off, || at);
            report.push(names.integral, seen, self.tolerance::<T>());
        } else {
            // The share of none is binomial; one more sample keeps the error of none from 0.
            let share = (value.clamp(0.0, 1.0) * (1.0 - value).clamp(0.0, 1.0)).max(1.0 / n);
            let error = (share / n).sqrt().hypot(bound).hypot(self.tolerance::<T>());
            report.push_p_value(names.integral, two_sided((value - expected) / error), at, String::new());
        }
    }

    fn counts<T: Float>(
        &self,
        report: &mut Report,
        sampler: &Sampler<'_, T>,
        names: &Names,
        hemispheres: &[Hemisphere],
        missed: usize,
    ) {
        let n = count(self.samples);
        let mass = total(hemispheres).value[0];
        let mut cells: Vec<Counted> = Vec::new();
        let mut unresolved = 0;
        for hemisphere in hemispheres {
            for (integral, &observed) in hemisphere.integrals.iter().zip(&hemisphere.counts) {
                let [p, bound] = integral.pair(0);
                let expected = n * p;
                unresolved += usize::from(!within(n * bound, 0.5 * expected.max(5.0).sqrt()));
                cells.push(Counted { observed: count(observed), expected });
            }
        }
        if sampler.may_miss {
            cells.push(Counted { observed: count(missed), expected: (n * (1.0 - mass)).max(0.0) });
        }
        let Pearson { statistic, freedom, p_value } = pearson(&cells);
        let at = format!("χ² = {statistic:.0} of {freedom} degrees of freedom, {}", sampler.view);
        let none = sampler.may_miss.then(|| (missed, (n * (1.0 - mass)).max(0.0)));
        let details = cell_map(hemispheres, n, none);
        let undecided = unresolved > 0;
        report.push_p_value(names.cells, p_value, at, details);
        let judged = |report: &mut Report| {
            if let (true, Some(check)) = (undecided, report.checks.last_mut()) {
                check.verdict = Verdict::Undecided;
                check.at = format!("no quadrature of {unresolved} cells, {}", check.at);
            }
        };
        judged(report);
        let (near, around) = marginals(hemispheres, n);
        for (name, distance) in [(names.near, near), (names.around, around)] {
            let at = format!("largest distance {distance:.5}, {}", sampler.view);
            report.push_p_value(name, kolmogorov(n, distance), at, String::new());
            judged(report);
        }
    }
}

/// The fault of a sample by itself, if it has one.
fn fault<T: Float>(sampler: &Sampler<'_, T>, d: [f64; 3], weight: f64) -> Option<&'static str> {
    let density = (sampler.density)(d);
    if d.iter().any(|c| !c.is_finite()) {
        Some("not finite")
    } else if (dot(d, d) - 1.0).abs() > 64.0 * T::EPSILON.to_f64() {
        Some("not of unit length")
    } else if d[2] < 0.0 && !sampler.below {
        Some("below the horizon")
    } else if !weight.is_finite() || weight < 0.0 {
        Some("its weight is negative or not finite")
    } else if density.is_nan() || density <= 0.0 {
        Some("its density is 0 or not a number")
    } else {
        None
    }
}

/// The integrals over all cells.
fn total(hemispheres: &[Hemisphere]) -> Integral<2> {
    let mut total = Integral::ZERO;
    hemispheres.iter().flat_map(|h| &h.integrals).for_each(|integral| total.add(integral));
    total
}

/// The largest distances of the distribution functions at the edges of the rows, and of the columns
/// of all rows together. The distance at some points is at most that of all: the p-value is not too
/// small.
fn marginals(hemispheres: &[Hemisphere], n: f64) -> (f64, f64) {
    let (mut near, mut around) = (0.0_f64, 0.0_f64);
    for hemisphere in hemispheres {
        let cells: Vec<_> = hemisphere.cells.cells().collect();
        let differences: Vec<f64> = hemisphere
            .integrals
            .iter()
            .zip(&hemisphere.counts)
            .map(|(integral, &observed)| count(observed) / n - integral.value[0])
            .collect();
        let (mut sum, mut row) = (0.0, 0);
        for ((at, _), difference) in cells.iter().zip(&differences) {
            if *at != row {
                (near, row) = (near.max(f64::abs(sum)), *at);
            }
            sum += difference;
        }
        // Columns are cut at other azimuths in every row: by rank they are the same share.
        let mut by_column = [0.0; COLUMNS];
        let mut column = 0;
        let mut last = usize::MAX;
        for ((row, _), difference) in cells.iter().zip(&differences) {
            column = if *row == last { column + 1 } else { 0 };
            last = *row;
            by_column[column.min(COLUMNS - 1)] += difference;
        }
        let mut sum = 0.0;
        for difference in &by_column[..COLUMNS - 1] {
            sum += difference;
            around = around.max(f64::abs(sum));
        }
    }
    (near, around)
}

/// E[weight] = ∫ f |cos|.
fn mean_weight<T>(
    report: &mut Report,
    sampler: &Sampler<'_, T>,
    names: &Names,
    hemispheres: &[Hemisphere],
    weights: &Weights,
) {
    let [value, bound] = total(hemispheres).pair(1);
    let standard = weights.standard_error();
    let error = standard.hypot(bound).max(f64::MIN_POSITIVE);
    let at = format!(
        "mean weight {:.6} ± {standard:.0e}, ∫ f cos = {value:.6} ± {bound:.0e}, {}",
        weights.mean, sampler.view
    );
    report.push_p_value(names.weights, two_sided((weights.mean - value) / error), at, String::new());
    // The integral is known to what was asked of it, or better than the mean weight is.
    let known = within(bound, (4.0 * ASKED * value.abs()).max(standard));
    let unknown = !known || !weights.is_normal(bound);
    if let (true, Some(check)) = (unknown, report.checks.last_mut()) {
        check.verdict = Verdict::Undecided;
    }
}
