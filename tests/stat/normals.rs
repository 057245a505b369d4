//! All normals: `sample_d` against `pdf_d`.

use crate::chart::{Chart, Polar, Radial};
use crate::chi_square::{Effort, Outcome, Subject, test};
use crate::family::{Family, assert_impossible, assert_rejected};
use crate::ks;
use crate::points::{Points, Random};
use crate::rows::{Distribution, Row};
use crate::surfaces::{MIRROR, MapSpec, SKEW, Scalar, Surface, surface};

/// A distribution under a shape: the crate's surface and the test's own idea of it.
pub(crate) struct Case {
    pub(crate) label: String,
    pub(crate) surface: Box<dyn Surface>,
    pub(crate) polar: Polar,
}

impl Case {
    pub(crate) fn new<T: Scalar>(distribution: Distribution, map: MapSpec) -> Self {
        let surface = surface::<T>(distribution, map);
        let label = format!("{distribution:?} {map:?} f{}", if surface.bits() == 24 { 32 } else { 64 });
        Self { label, surface, polar: Polar { radial: Radial::of(distribution), inverse: map.inverse() } }
    }

    /// The sampler of this surface against the density of `other`.
    pub(crate) fn against(
        &self,
        other: &Self,
        why: &str,
        effort: Effort,
        points: &mut dyn Points,
    ) -> Outcome {
        let subject = Subject {
            label: format!("{}{why}", self.label),
            chart: &self.polar,
            sample: &mut |u| self.surface.sample_d(u),
            density: &|m| other.surface.pdf_d(m),
            masking: 0.0,
            epsilon: self.surface.epsilon(),
        };
        test(subject, effort, points)
    }

    /// The sampler against its own density.
    pub(crate) fn outcome(&self, effort: Effort, points: &mut dyn Points) -> Outcome {
        self.against(self, "", effort, points)
    }
}

/// The widths of the isotropic cases of GGX and Beckmann.
pub(crate) const WIDTHS: [f64; 7] = [1e-4, 1e-3, 0.01, 0.1, 0.5, 0.9, 2.5];

/// The other maps, for a width α.
pub(crate) fn shapes(alpha: f64) -> [MapSpec; 5] {
    [
        MapSpec::Axes(alpha, 4.0 * alpha),
        MapSpec::Axes(30.0 * alpha, alpha),
        MapSpec::Matrix(3.0 * alpha, alpha, 0.6),
        MapSpec::Moved(alpha, SKEW),
        MapSpec::Moved(alpha, MIRROR),
    ]
}

/// The distributions without a width of their own: isotropic of some widths, under maps of others.
fn plain_cases<T: Scalar>(widths: &[f64], widths_of_maps: &[f64]) -> Vec<Case> {
    let isotropic = widths.iter().map(|&alpha| MapSpec::Isotropic(alpha));
    let maps = isotropic.chain(widths_of_maps.iter().flat_map(|&alpha| shapes(alpha)));
    maps.flat_map(|map| distributions(false, 1.0).map(move |d| Case::new::<T>(d, map))).collect()
}

/// The distributions of an own width, or those without.
fn distributions(own_width: bool, alpha: f64) -> impl Iterator<Item = Distribution> {
    Row::with_own_density()
        .filter(move |row| row.columns().own_width == own_width)
        .flat_map(move |row| row.of_width(alpha))
}

const PLAIN: MapSpec = MapSpec::Isotropic(1.0);

/// The distributions with a width of their own, of two of `widths` each and under a map; all by
/// turns.
fn own_width_cases<T: Scalar>(widths: &[f64]) -> Vec<Case> {
    let maps = shapes(0.7);
    let mut cases = Vec::new();
    for (turn, distribution) in distributions(true, 1.0).enumerate() {
        let of_width = |k: usize| distribution.row.with(widths[k % widths.len()], distribution.gamma);
        cases.push(Case::new::<T>(of_width(turn), PLAIN));
        cases.push(Case::new::<T>(of_width(turn + 1), maps[turn % maps.len()]));
        if widths.len() > 2 {
            cases.push(Case::new::<T>(of_width(turn + widths.len() / 2), PLAIN));
        }
    }
    cases
}

fn run(mut family: Family, cases: &[Case], effort: Effort) {
    for (case, seed) in cases.iter().zip(1..) {
        family.add_outcome(case.outcome(effort, &mut Random::new(seed, case.surface.bits())));
    }
    family.assert_accepted();
}

#[test]
fn sample_d_of_plain_distributions_has_its_density() {
    let mut cases = plain_cases::<f64>(&WIDTHS, &[1e-4, 0.05, 0.4]);
    cases.extend(plain_cases::<f32>(&[1e-4, 0.01, 0.9], &[1e-3, 0.3]));
    run(Family::new("sample_d"), &cases, Effort::QUICK);
}

#[test]
fn sample_d_of_distributions_of_own_width_has_its_density() {
    let mut cases = own_width_cases::<f64>(&[1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0]);
    cases.extend(own_width_cases::<f32>(&[1e-4, 0.1]));
    run(Family::new("sample_d, own widths"), &cases, Effort::QUICK);
}

/// tan²θ/α² and azimuth, or v^{1−γ} of GTR, against their closed forms.
#[test]
fn marginals_of_sample_d_have_their_closed_forms() {
    let mut cases = plain_cases::<f64>(&[1e-4, 0.1, 2.5], &[0.01]);
    cases.extend(plain_cases::<f32>(&[1e-3, 0.9], &[0.2]));
    cases.extend(own_width_cases::<f64>(&[1e-4, 0.3]));
    cases.extend(own_width_cases::<f32>(&[0.02]));
    let mut family = Family::new("marginals of sample_d");
    for (case, seed) in cases.iter().zip(1_000..) {
        marginals(&mut family, case, 40_000, seed);
    }
    family.assert_accepted();
}

fn marginals(family: &mut Family, case: &Case, samples: usize, seed: u64) {
    for (axis, p) in marginal_p_values(case, &case.polar, samples, seed).into_iter().enumerate() {
        family.add(p, format!("{} axis {axis}", case.label));
    }
}

fn marginal_p_values(case: &Case, chart: &Polar, samples: usize, seed: u64) -> [f64; 2] {
    let mut random = Random::new(seed, case.surface.bits());
    let mut marginals = [Vec::with_capacity(samples), Vec::with_capacity(samples)];
    for i in 0..samples {
        let c = chart.coordinates(case.surface.sample_d(random.point(i)));
        marginals[0].push(chart.cdf(0, c[0]));
        marginals[1].push(chart.cdf(1, c[1]));
    }
    marginals.each_mut().map(|numbers| ks::p_value_of(numbers))
}

#[test]
fn wrong_densities_of_all_normals_are_rejected() {
    let effort = Effort::QUICK;
    let axes = MapSpec::Axes(0.1, 0.13);
    let skew = MapSpec::Moved(0.05, SKEW);
    for distribution in [Distribution::GGX, Distribution::BECKMANN, Row::SplineGtr.with(0.2, 1.5)] {
        let make = |map| Case::new::<f64>(distribution, map);
        for shape in [axes, skew, MapSpec::Isotropic(0.01)] {
            let (case, wider) = (make(shape), make(shape.scaled(1.03)));
            assert_rejected(&case.against(&wider, ", alpha off by 3 %", effort, &mut Random::new(1, 53)));
        }
        assert_rejected(&make(axes).against(
            &make(axes.swapped()),
            ", axes swapped",
            effort,
            &mut Random::new(2, 53),
        ));
        assert_rejected(&make(skew).against(
            &make(skew.transposed()),
            ", transposed map",
            effort,
            &mut Random::new(3, 53),
        ));
        let case = make(skew);
        let outcome = |why: &str, warp: fn([f64; 2]) -> [f64; 2], scale: f64| {
            let subject = Subject {
                label: format!("{}{why}", case.label),
                chart: &case.polar,
                sample: &mut |u| case.surface.sample_d(warp(u)),
                density: &|m| scale * case.surface.pdf_d(m),
                masking: 0.0,
                epsilon: case.surface.epsilon(),
            };
            test(subject, effort, &mut Random::new(4, 53))
        };
        assert_impossible(&outcome(", determinant off by 3 %", |u| u, 1.03));
        assert_rejected(&outcome(", u1 squared", |[a, b]| [a * a, b], 1.0));
        assert_rejected(&outcome(", u2 squared", |[a, b]| [a, b * b], 1.0));
    }
    for gamma in [0.3, 2.7, 4.0] {
        let make = |gamma| Case::new::<f64>(Row::SplineGtr.with(0.1, gamma), PLAIN);
        let (case, other) = (make(gamma), make(gamma - 0.2));
        assert_rejected(&case.against(&other, ", gamma off by 0.2", effort, &mut Random::new(5, 53)));
    }
}

#[test]
fn wrong_marginals_of_all_normals_are_rejected() {
    for distribution in [Distribution::GGX, Distribution::BECKMANN, Row::SplineGtr.with(0.2, 2.7)] {
        let make = |map| Case::new::<f64>(distribution, map);
        let case = make(MapSpec::Isotropic(0.103));
        let wrong = make(MapSpec::Isotropic(0.1)).polar;
        let [radial, azimuthal] = marginal_p_values(&case, &wrong, 100_000, 9);
        eprintln!("negative control {}, alpha off by 3 %: p = {radial:.1e}", case.label);
        assert!(radial < 1e-5 && azimuthal > 1e-5, "{}: {radial:e}, {azimuthal:e}", case.label);
    }
}

#[test]
#[ignore = "long: about a quarter of an hour; see main.rs"]
fn long_sample_d() {
    let mut cases = plain_cases::<f64>(&WIDTHS, &[1e-4, 0.05, 0.4]);
    cases.extend(plain_cases::<f32>(&WIDTHS, &[1e-3, 0.3]));
    cases.extend(own_width_cases::<f64>(&[1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0]));
    cases.extend(own_width_cases::<f32>(&[1e-3, 0.1]));
    run(Family::long("long sample_d"), &cases, Effort::LONG);
}
