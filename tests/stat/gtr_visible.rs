//! Visible normals of GTR: `sample_vndf` against `vndf`, for every way to make a surface that has
//! them.

use microsurface::Gtr;
use microsurface::gtr::table::GtrTable;

use crate::chart::{Chart, Mixed};
use crate::chi_square::{Effort, Outcome, Subject, test};
use crate::family::{Family, assert_impossible, assert_rejected};
use crate::points::{Points, Random};
use crate::rows::Row;
use crate::surfaces::{MapSpec, SKEW, Scalar, Visible, visible, visible_of_profile};
use crate::visible::Warped;

const GAMMAS: [f64; 13] = [0.3, 0.7, 1.0, 1.3, 1.5, 1.9, 2.0, 2.3, 2.5, 3.0, 3.4, 4.0, 6.0];
const WIDTHS: [f64; 5] = [1e-3, 0.01, 0.1, 0.5, 0.9];
/// Degrees from the zenith.
const ANGLES: [f64; 9] = [0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.5, 100.0, 150.0];

/// The largest relative error of σ, and with it of what vndf integrates to: below the horizon all
/// of σ is z Λ, a small difference.
fn masking(w: [f64; 3]) -> f64 {
    if w[2] < 0.0 { 1e-2 } else { 1e-4 }
}

/// Fewer columns than elsewhere, as the chart inverts the second coordinate numerically.
const QUICK: Effort = Effort { columns: 6, ..Effort::QUICK };

/// The ways to make a surface that are no rows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Row(Row),
    TwelveNodes,
    Table,
}

/// The ways to make a surface with this tail, `Gtr::isotropic` apart.
fn other_kinds(gamma: f64) -> Vec<Kind> {
    let visible = |row: &&Row| row.columns().own_width && row.samples_visible() && **row != Row::Gtr;
    let with_this_tail = |row: &&Row| row.columns().range[0] <= gamma && gamma <= row.columns().range[1];
    let rows = Row::ALL.iter().filter(visible).filter(with_this_tail);
    [Kind::TwelveNodes, Kind::Table].into_iter().chain(rows.map(|&row| Kind::Row(row))).collect()
}

fn build(kind: Kind, alpha: f64, gamma: f64, map: MapSpec) -> Box<dyn Visible> {
    match kind {
        Kind::Row(row) => visible::<f64>(row.with(alpha, gamma), map),
        Kind::TwelveNodes => {
            visible_of_profile(*Gtr::with_nodes::<12>(alpha, gamma).expect("in range").profile(), map)
        }
        Kind::Table => {
            let table = GtrTable::<f64, 8>::new(gamma, 1e-3).expect("in range");
            visible_of_profile(*table.isotropic(alpha).expect("in range").profile(), map)
        }
    }
}

/// A surface seen from a direction.
pub(crate) struct Case {
    pub(crate) label: String,
    surface: Box<dyn Visible>,
    chart: Mixed,
    w: [f64; 3],
    /// The part of the samples that is drawn.
    part: usize,
}

impl Case {
    /// The azimuth of the view is drawn from `seed`.
    fn of(
        name: &str,
        surface: Box<dyn Visible>,
        [alpha, gamma]: [f64; 2],
        shape: MapSpec,
        view: (f64, u64),
    ) -> Self {
        let (degrees, seed) = view;
        let w = Random::new(seed, 24).direction(degrees);
        let scalar = if surface.bits() == 24 { 32 } else { 64 };
        let label = format!("{name}, gamma {gamma} alpha {alpha} {shape:?} f{scalar} at {degrees} deg");
        Self { label, surface, chart: Mixed::new(alpha, gamma, shape.inverse(), w), w, part: 1 }
    }

    /// `Gtr::isotropic`.
    pub(crate) fn new<T: Scalar>(alpha: f64, gamma: f64, shape: MapSpec, degrees: f64, seed: u64) -> Self {
        Self::of(
            "Isotropic",
            visible::<T>(Row::Gtr.with(alpha, gamma), shape),
            [alpha, gamma],
            shape,
            (degrees, seed),
        )
    }

    fn against(
        &self,
        sample: &dyn Fn([f64; 2]) -> [f64; 3],
        density: &dyn Fn([f64; 3]) -> f64,
        why: &str,
        effort: Effort,
        points: &mut dyn Points,
    ) -> Outcome {
        let subject = Subject {
            label: format!("{}{why}", self.label),
            chart: &self.chart,
            sample: &mut |u| sample(u),
            density,
            masking: masking(self.w),
            epsilon: self.surface.epsilon(),
        };
        test(subject, effort, points)
    }

    /// The sampler against its own density.
    pub(crate) fn outcome(&self, effort: Effort, points: &mut dyn Points) -> Outcome {
        let sample = |u| self.surface.sample_vndf(self.w, u);
        self.against(&sample, &|m| self.surface.vndf(self.w, m), "", effort, points)
    }
}

/// A map of one of four kinds: none, along the axes, any matrix, and a turned and sheared one.
fn map(kind: usize, random: &mut Random) -> MapSpec {
    let mut entry = || 2.0 * random.uniform() - 1.0;
    match kind % 4 {
        0 => MapSpec::Isotropic(1.0),
        1 => MapSpec::Axes(10_f64.powf(entry()), 10_f64.powf(entry())),
        2 => MapSpec::Moved(1.0, [[entry(), entry()], [entry(), entry()]]),
        _ => {
            MapSpec::Moved(10_f64.powf(0.5 * entry()), [[1.0 + 0.5 * entry(), 2.0 * entry()], [entry(), 1.0]])
        }
    }
}

/// Every γ with every α: `Gtr::isotropic` from one angle under one map, another kind from another,
/// and every fourth in f32.
fn cases_in_turn() -> Vec<Case> {
    let mut random = Random::new(2026, 53);
    let pairs = GAMMAS.iter().flat_map(|&gamma| WIDTHS.map(|alpha| (alpha, gamma)));
    let mut cases = Vec::new();
    for ((turn, (alpha, gamma)), seed) in pairs.enumerate().zip((1..).step_by(10)) {
        let angle = |shift: usize| ANGLES[(2 * turn + shift) % ANGLES.len()];
        let shape = map(turn, &mut random);
        cases.push(Case::new::<f64>(alpha, gamma, shape, angle(0), seed));
        let kinds = other_kinds(gamma);
        let kind = kinds[turn % kinds.len()];
        let shape = map(turn / 4 + 1, &mut random);
        let surface = build(kind, alpha, gamma, shape);
        let case = Case::of(&format!("{kind:?}"), surface, [alpha, gamma], shape, (angle(4), seed + 1));
        // But for this kind components are made for every sample, which takes ten times as long.
        cases.push(Case { part: if kind == Kind::TwelveNodes { 1 } else { 5 }, ..case });
        if turn % 4 == 0 {
            let shape = map(turn / 4, &mut random);
            cases.push(Case::new::<f32>(alpha, gamma, shape, angle(7), seed + 2));
        }
    }
    cases
}

fn run(mut family: Family, cases: &[Case], effort: Effort) {
    let mut largest = (0.0, "");
    for (case, seed) in cases.iter().zip(40_000..) {
        let effort = Effort { samples: effort.samples / case.part, ..effort };
        let outcome = case.outcome(effort, &mut Random::new(seed, case.surface.bits()));
        let error = (outcome.mass.value - 1.0).abs();
        if error > largest.0 {
            largest = (error, &case.label);
        }
        family.add_outcome(outcome);
    }
    eprintln!("vndf integrates to 1 but for {:.1e} at most, at {}", largest.0, largest.1);
    family.assert_accepted();
}

#[test]
fn sample_vndf_of_gtr_has_its_density() {
    run(Family::new("sample_vndf of GTR"), &cases_in_turn(), QUICK);
}

/// The chart owes nothing to the crate: that vndf is flat in it to what its few components leave
/// tests vndf, point by point.
#[test]
fn vndf_of_gtr_is_flat_in_its_chart() {
    let mut largest = (0.0, String::new());
    let mut random = Random::new(12, 53);
    for case in cases_in_turn().iter().filter(|case| case.surface.bits() == 53) {
        for _ in 0..200 {
            let [u1, u2] = random.point(0);
            let (m, solid_angle) = case.chart.point([case.chart.quantile(0, u1), u2]);
            let error = (case.surface.vndf(case.w, m) * solid_angle - 1.0).abs();
            if error > largest.0 {
                largest = (error, format!("{} at u = {u1}, {u2}", case.label));
            }
        }
    }
    eprintln!("vndf of GTR in its chart: 1 but for {:.1e}, {}", largest.0, largest.1);
    assert!(largest.0 < 1e-2, "{largest:?}");
}

#[test]
fn wrong_densities_of_visible_normals_of_gtr_are_rejected() {
    let (fine, effort) = (Effort { samples: 300_000, ..QUICK }, QUICK);
    for (alpha, gamma) in [(0.5, 0.7), (0.1, 1.5), (0.05, 2.0), (0.2, 2.5), (0.05, 3.4), (0.4, 6.0)] {
        let make = |alpha, gamma, shape| Case::new::<f64>(alpha, gamma, shape, 60.0, 3);
        let axes = MapSpec::Axes(0.8, 1.1);
        let skew = MapSpec::Moved(0.9, SKEW);
        let case = make(alpha, gamma, skew);
        let reject = |case: &Case, wrong: &Case, why: &str| {
            let sample = |u| case.surface.sample_vndf(case.w, u);
            let density = |m| wrong.surface.vndf(case.w, m);
            assert_rejected(&case.against(&sample, &density, why, fine, &mut Random::new(1, 53)));
        };
        // Most of the slopes of a heavy tail are far from the peak and do not depend on its width.
        let percent = if gamma < 1.0 { 6.0 } else { 3.0 };
        let wider = make((1.0 + 0.01 * percent) * alpha, gamma, skew);
        reject(&case, &wider, &format!(", alpha off by {percent} %"));
        reject(&case, &make(alpha, gamma + 0.1, skew), ", gamma off by 0.1");
        reject(&make(alpha, gamma, axes), &make(alpha, gamma, axes.swapped()), ", axes swapped");
        reject(&case, &make(alpha, gamma, skew.transposed()), ", transposed map");
        let own = |m| case.surface.vndf(case.w, m);
        let sample = |u| case.surface.sample_vndf(case.w, u);
        for warp in [|[a, b]: [f64; 2]| [a * a, b], |[a, b]: [f64; 2]| [a, b * b]] {
            let mut warped = Warped(Random::new(4, 53), warp);
            assert_rejected(&case.against(&sample, &own, ", u squared", effort, &mut warped));
        }
        let brighter = |m| 1.03 * own(m);
        let points = &mut Random::new(5, 53);
        assert_impossible(&case.against(&sample, &brighter, ", 3 % too much", effort, points));
        for degrees in [60.0, 85.0] {
            let case = Case::new::<f64>(alpha, gamma, skew, degrees, 3);
            let all = |u| case.surface.sample_d(u);
            let own = |m| case.surface.vndf(case.w, m);
            assert_rejected(&case.against(&all, &own, ", all normals", effort, &mut Random::new(6, 53)));
        }
    }
}

#[test]
#[ignore = "long: about an hour; see main.rs"]
fn long_sample_vndf_of_gtr() {
    let mut random = Random::new(2027, 53);
    let mut cases = cases_in_turn();
    for (turn, gamma) in GAMMAS.into_iter().enumerate() {
        for alpha in WIDTHS {
            for (degrees, seed) in ANGLES.into_iter().zip(100..) {
                for kind in 0..4 {
                    let shape = map(kind, &mut random);
                    cases.push(Case::new::<f64>(alpha, gamma, shape, degrees, seed));
                }
                let shape = map(turn, &mut random);
                cases.push(Case::new::<f32>(alpha, gamma, shape, degrees, seed));
            }
        }
    }
    let effort = Effort { samples: 1_000_000, rows: 24, columns: 20, depth: 6 };
    run(Family::long("long sample_vndf of GTR"), &cases, effort);
}
