//! Visible normals: `sample_vndf` against `vndf`, above and below the horizon.

use crate::chart::{Cap, Chart, Inverse, View, VisibleProfile};
use crate::chi_square::{Effort, Outcome, Subject, test};
use crate::family::{Family, assert_impossible, assert_rejected};
use crate::ks;
use crate::normals::{WIDTHS, shapes};
use crate::points::{Points, Random};
use crate::rows::{Distribution, Row};
use crate::surfaces::{MapSpec, SKEW, Scalar, Visible, visible};

/// Degrees from the zenith; from below the horizon the steep facets are seen.
pub(crate) const ANGLES: [f64; 7] = [0.0, 30.0, 60.0, 85.0, 89.5, 100.0, 150.0];

/// A distribution under a shape seen from a direction.
pub(crate) struct Case {
    pub(crate) label: String,
    pub(crate) surface: Box<dyn Visible>,
    pub(crate) profile: VisibleProfile,
    pub(crate) inverse: Inverse,
    pub(crate) w: [f64; 3],
}

impl Case {
    /// The azimuth of the view is drawn from `seed`.
    pub(crate) fn new<T: Scalar>(distribution: Distribution, map: MapSpec, degrees: f64, seed: u64) -> Self {
        let surface = visible::<T>(distribution, map);
        let scalar = if surface.bits() == 24 { 32 } else { 64 };
        let label = format!("{distribution:?} {map:?} f{scalar} at {degrees} deg");
        let w = Random::new(seed, 24).direction(degrees);
        Self { label, surface, profile: VisibleProfile::of(distribution), inverse: map.inverse(), w }
    }

    pub(crate) fn view(&self) -> View {
        View::new(self.profile, self.inverse, self.w)
    }

    /// Whether anything is visible in the scalar: σ of Beckmann below the horizon falls like
    /// e^{−ν²}.
    pub(crate) fn is_representable(&self) -> bool {
        let largest = if self.surface.bits() == 24 { -8.0 } else { -24.0 };
        self.profile == VisibleProfile::Ggx || self.view().nu() > largest
    }

    /// The sampler of this case against a density.
    pub(crate) fn against(
        &self,
        density: &dyn Fn([f64; 3]) -> f64,
        why: &str,
        effort: Effort,
        points: &mut dyn Points,
    ) -> Outcome {
        let subject = Subject {
            label: format!("{}{why}", self.label),
            chart: &self.view(),
            sample: &mut |u| self.surface.sample_vndf(self.w, u),
            density,
            masking: 0.0,
            epsilon: self.surface.epsilon(),
        };
        test(subject, effort, points)
    }

    /// The sampler against its own density.
    pub(crate) fn outcome(&self, effort: Effort, points: &mut dyn Points) -> Outcome {
        self.against(&|m| self.surface.vndf(self.w, m), "", effort, points)
    }
}

/// The distributions without a width of their own, but for other samplings of them.
fn distributions() -> impl Iterator<Item = Distribution> {
    Row::with_own_density().filter(|row| !row.columns().own_width).flat_map(|row| row.of_width(1.0))
}

/// Every distribution under these maps at every angle.
fn cases<T: Scalar>(shapes: impl Iterator<Item = MapSpec>, angles: &[f64]) -> Vec<Case> {
    cases_in_turn::<T>(shapes, angles, 1)
}

/// The same with every `stride`-th angle, another one first for each shape.
fn cases_in_turn<T: Scalar>(
    shapes: impl Iterator<Item = MapSpec>,
    angles: &[f64],
    stride: usize,
) -> Vec<Case> {
    let mut result = Vec::new();
    for ((shape, seed), turn) in shapes.zip((1..).step_by(100)).zip((0..stride).cycle()) {
        for (&degrees, seed) in angles[turn..].iter().step_by(stride).zip(seed..) {
            result.extend(distributions().map(|d| Case::new::<T>(d, shape, degrees, seed)));
        }
    }
    result.retain(Case::is_representable);
    result
}

fn isotropic(widths: &[f64]) -> impl Iterator<Item = MapSpec> {
    widths.iter().map(|&alpha| MapSpec::Isotropic(alpha))
}

fn other_shapes(widths: &[f64]) -> impl Iterator<Item = MapSpec> {
    widths.iter().flat_map(|&alpha| shapes(alpha))
}

fn run(mut family: Family, cases: &[Case], effort: Effort) {
    for (case, seed) in cases.iter().zip(10_000..) {
        family.add_outcome(case.outcome(effort, &mut Random::new(seed, case.surface.bits())));
    }
    family.assert_accepted();
}

#[test]
fn sample_vndf_of_isotropic_surfaces_has_its_density() {
    let cases = cases_in_turn::<f64>(isotropic(&WIDTHS), &ANGLES, 2);
    run(Family::new("sample_vndf"), &cases, Effort::QUICK);
}

#[test]
fn sample_vndf_under_maps_has_its_density() {
    let cases = cases_in_turn::<f64>(other_shapes(&[1e-3, 0.4]), &ANGLES, 2);
    run(Family::new("sample_vndf under maps"), &cases, Effort::QUICK);
}

#[test]
fn sample_vndf_in_single_precision_has_its_density() {
    let mut all = cases_in_turn::<f32>(isotropic(&[1e-4, 0.01, 0.5, 2.5]), &ANGLES, 2);
    all.extend(cases_in_turn::<f32>(other_shapes(&[0.2]), &[30.0, 85.0, 100.0], 2));
    run(Family::new("sample_vndf, f32"), &all, Effort::QUICK);
}

/// Other samplings of a distribution, in f32.
fn other_samplings() -> Vec<Case> {
    let mut result = Vec::new();
    let rows = Row::ALL.iter().filter(|row| row.columns().sampling_of.is_some());
    for distribution in rows.flat_map(|row| row.of_width(1.0)) {
        let maps = isotropic(&[1e-4, 0.01, 0.5, 2.5]).chain(other_shapes(&[0.2]));
        for (map, seed) in maps.zip((7..).step_by(100)) {
            for (&degrees, seed) in ANGLES.iter().zip(seed..).skip((seed / 100 % 2) as usize).step_by(2) {
                result.push(Case::new::<f32>(distribution, map, degrees, seed));
            }
        }
    }
    result.retain(Case::is_representable);
    result
}

#[test]
fn other_samplings_of_visible_normals_have_their_density() {
    run(Family::new("other samplings of visible normals"), &other_samplings(), Effort::QUICK);
}

/// The slopes along and across the view against their closed forms; for GGX height and azimuth on
/// the cap.
#[test]
fn marginals_of_sample_vndf_have_their_closed_forms() {
    let mut all = cases::<f64>(isotropic(&[1e-4, 0.1, 0.9]), &ANGLES);
    all.extend(cases::<f64>(other_shapes(&[0.3]), &[60.0, 89.5, 100.0]));
    all.extend(cases::<f32>(other_shapes(&[0.1]), &[30.0, 85.0]));
    all.extend(other_samplings());
    let mut family = Family::new("marginals of sample_vndf");
    for (case, seed) in all.iter().zip(20_000..) {
        let names = ["along the view", "across it", "height on the cap", "azimuth on the cap"];
        for (p, name) in marginal_p_values(case, case.inverse, 20_000, seed).into_iter().zip(names) {
            family.add(p, format!("{} {name}", case.label));
        }
    }
    family.assert_accepted();
}

/// Two p-values for Beckmann, four for GGX.
fn marginal_p_values(case: &Case, inverse: Inverse, samples: usize, seed: u64) -> Vec<f64> {
    let view = View::new(case.profile, inverse, case.w);
    let cap = (case.profile == VisibleProfile::Ggx).then(|| Cap::new(inverse, case.w));
    let mut random = Random::new(seed, case.surface.bits());
    let mut marginals = vec![Vec::with_capacity(samples); if cap.is_some() { 4 } else { 2 }];
    for i in 0..samples {
        let m = case.surface.sample_vndf(case.w, random.point(i));
        let c = view.coordinates(m);
        let on_cap = cap.map_or([0.0; 2], |cap| cap.uniform(m));
        let uniform = [view.cdf(0, c[0]), view.cdf(1, c[1]), on_cap[0], on_cap[1]];
        marginals.iter_mut().zip(uniform).for_each(|(numbers, u)| numbers.push(u));
    }
    marginals.iter_mut().map(|numbers| ks::p_value_of(numbers)).collect()
}

#[test]
fn wrong_densities_of_visible_normals_are_rejected() {
    let effort = Effort::QUICK;
    for profile in [Distribution::GGX, Distribution::BECKMANN] {
        let make = |shape| Case::new::<f64>(profile, shape, 60.0, 3);
        let reject = |shape: MapSpec, wrong: MapSpec, why: &str| {
            let (case, other) = (make(shape), make(wrong));
            let density = |m| other.surface.vndf(case.w, m);
            assert_rejected(&case.against(&density, why, effort, &mut Random::new(1, 53)));
        };
        let (axes, skew) = (MapSpec::Axes(0.3, 0.4), MapSpec::Moved(0.2, SKEW));
        for shape in [MapSpec::Isotropic(0.01), axes, skew] {
            reject(shape, shape.scaled(1.03), ", alpha off by 3 %");
        }
        reject(axes, axes.swapped(), ", axes swapped");
        reject(skew, skew.transposed(), ", transposed map");
        let case = make(skew);
        let without_g1 = |m: [f64; 3]| case.surface.pdf_d(m);
        assert_rejected(&case.against(&without_g1, ", G1 left out", effort, &mut Random::new(2, 53)));
        let scaled = |m: [f64; 3]| 1.03 * case.surface.vndf(case.w, m);
        assert_impossible(&case.against(
            &scaled,
            ", determinant off by 3 %",
            effort,
            &mut Random::new(3, 53),
        ));
        let density = |m: [f64; 3]| case.surface.vndf(case.w, m);
        for warp in [|[a, b]: [f64; 2]| [a * a, b], |[a, b]: [f64; 2]| [a, b * b]] {
            let mut warped = Warped(Random::new(4, 53), warp);
            assert_rejected(&case.against(&density, ", u squared", effort, &mut warped));
        }
        // Another view by 10 degrees.
        let other = |m: [f64; 3]| case.surface.vndf(Random::new(3, 24).direction(50.0), m);
        assert_rejected(&case.against(&other, ", view off by 10 degrees", effort, &mut Random::new(5, 53)));
    }
}

/// Points mapped wrongly.
pub(crate) struct Warped(pub(crate) Random, pub(crate) fn([f64; 2]) -> [f64; 2]);

impl Points for Warped {
    fn point(&mut self, i: usize) -> [f64; 2] {
        (self.1)(self.0.point(i))
    }
}

#[test]
fn wrong_marginals_of_visible_normals_are_rejected() {
    for distribution in [Distribution::GGX, Distribution::BECKMANN] {
        let map = MapSpec::Isotropic(0.515);
        let mut cases = vec![Case::new::<f64>(distribution, map, 60.0, 3)];
        if distribution == Distribution::BECKMANN {
            cases.push(Case::new::<f32>(Row::BeckmannTo1e6.with(1.0, f64::INFINITY), map, 60.0, 4));
        }
        for case in cases {
            let p = marginal_p_values(&case, MapSpec::Isotropic(0.5).inverse(), 300_000, 1);
            eprintln!("negative control {}, alpha off by 3 %: p = {p:?}", case.label);
            // The cap of a wrong α is tilted: its height and azimuth are not uniform either.
            assert!(p.iter().all(|&p| p < 1e-5), "{}: {p:?}", case.label);
        }
    }
}

#[test]
#[ignore = "long: about an hour; see main.rs"]
fn long_sample_vndf() {
    let mut random = Random::new(77, 53);
    // 24 maps at random: entries of M in (−1, 1), widths over four decades.
    let maps: Vec<MapSpec> = (0..24)
        .map(|_| {
            let mut entry = || 2.0 * random.uniform() - 1.0;
            let matrix = [[entry(), entry()], [entry(), entry()]];
            MapSpec::Moved(10_f64.powf(-2.0 - 2.0 * entry()), matrix)
        })
        .collect();
    let mut all = cases::<f64>(maps.iter().copied(), &ANGLES);
    all.extend(cases::<f64>(isotropic(&WIDTHS), &ANGLES));
    all.extend(cases::<f32>(isotropic(&[1e-3, 0.1, 0.9]), &ANGLES));
    run(Family::long("long sample_vndf"), &all, Effort::LONG);
}

#[test]
#[ignore = "long: minutes; see main.rs"]
fn long_other_samplings_of_visible_normals() {
    run(Family::long("long other samplings of visible normals"), &other_samplings(), Effort::LONG);
}
