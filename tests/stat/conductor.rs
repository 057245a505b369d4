//! Reflection: `RoughConductor::sample` against `pdf`, the share of samples that are none, and mean
//! weights.
//!
//! Directions to the light are binned by their half vector, in the chart of the surface's normals:
//! an implicit change of variable whose Jacobian dwm/dwi = 1/(4 wo·wm) is the test's own (Walter
//! 2007, Eq. 14). Normals that reflect below the horizon have no density; the samples that are none
//! belong to them and make a cell of their own, whose expectation is what the integral of the pdf
//! lacks to 1.

use crate::chart::{Chart, Polar, Radial, Reflecting};
use crate::chi_square::{Effort, Outcome, Subject, test};
use crate::family::{Family, assert_rejected};
use crate::points::Random;
use crate::quadrature::{Mass, Quadrature, total};
use crate::rows::{Distribution, Row};
use crate::special::{count, erfc};
use crate::surfaces::{Conductor, MIRROR, MapSpec, Normals, SKEW, Scalar, Surface, conductor, surface};

/// A BRDF seen from a direction.
struct Case {
    label: String,
    brdf: Box<dyn Conductor>,
    surface: Box<dyn Surface>,
    chart: Reflecting,
    wo: [f64; 3],
}

impl Case {
    fn new<T: Scalar>(distribution: Distribution, normals: Normals, map: MapSpec, degrees: f64) -> Self {
        let (brdf, surface) = (conductor::<T>(distribution, map, normals), surface::<T>(distribution, map));
        let scalar = if surface.bits() == 24 { 32 } else { 64 };
        let label = format!("{distribution:?}, {normals:?} normals, {map:?} f{scalar} at {degrees} deg");
        let wo = Random::new(8, 24).direction(degrees);
        let polar = Polar { radial: Radial::of(distribution), inverse: map.inverse() };
        Self { label, brdf, surface, chart: Reflecting { polar, wo }, wo }
    }

    /// wo mirrored about m, and wo·m, if it comes out above the horizon.
    fn reflected(&self, m: [f64; 3]) -> Option<([f64; 3], f64)> {
        let wo = self.wo;
        let cos = wo[0] * m[0] + wo[1] * m[1] + wo[2] * m[2];
        let wi = [0, 1, 2].map(|k| 2.0 * cos * m[k] - wo[k]);
        (cos > 0.0 && wi[2] > 0.0).then_some((wi, cos))
    }

    /// A function of wi as a density of half vectors.
    fn of_half_vector(&self, m: [f64; 3], f: &dyn Fn([f64; 3]) -> f64) -> f64 {
        self.reflected(m).map_or(0.0, |(wi, cos)| 4.0 * cos * f(wi))
    }

    /// The half vector of a sampled direction.
    fn half(&self, wi: [f64; 3]) -> [f64; 3] {
        let unit = |v: [f64; 3]| v.map(|c| c / (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt());
        // Where it is short it tilts by many times what rounding to f32 has lengthened wi by.
        let wi = unit(wi);
        unit([0, 1, 2].map(|k| wi[k] + self.wo[k]))
    }

    /// χ² of the samples of this case against a pdf; the weights are collected.
    fn against(&self, pdf: &dyn Fn([f64; 3]) -> f64, why: &str, run: Run<'_>) -> Outcome {
        let Run { effort, seed, weights, warp } = run;
        let subject = Subject {
            label: format!("{}{why}", self.label),
            chart: &self.chart,
            sample: &mut |u| {
                let sample = self.brdf.sample(self.wo, warp(u));
                weights.add(sample.map_or(0.0, |(_, weight)| weight));
                sample.map(|(wi, _)| self.half(wi))
            },
            density: &|m| self.of_half_vector(m, pdf),
            misses: true,
            masking: 0.0,
            epsilon: self.surface.epsilon(),
        };
        test(subject, effort, &mut Random::new(seed, self.surface.bits()))
    }

    /// The part of white light that is reflected, ∫ f cos θi dwi, by quadrature over half vectors.
    fn albedo(&self, f: &dyn Fn([f64; 3]) -> f64) -> Mass {
        let even: Vec<f64> = (0..=16).map(|i| f64::from(i) / 16.0).collect();
        let edges = [even.clone(), even];
        let density = |m: [f64; 3]| self.of_half_vector(m, &|wi| f(wi) * wi[2].max(0.0));
        // The directions of f32 are rounded by 6e-8: the integrand is rough by that over α.
        let (tolerance, depth) = if self.surface.bits() == 24 { (1e-6, 2) } else { (2e-7, 8) };
        let albedo = total(&Quadrature::new(&self.chart, &density, depth).grid(&edges, &|_| tolerance));
        assert!(albedo.error < 3e-4, "{}: the albedo is {albedo:?}", self.label);
        albedo
    }
}

/// How to draw the samples of a case, and where their weights go.
struct Run<'a> {
    effort: Effort,
    seed: u64,
    weights: &'a mut Weights,
    warp: fn([f64; 2]) -> [f64; 2],
}

impl<'a> Run<'a> {
    fn new(effort: Effort, seed: u64, weights: &'a mut Weights) -> Self {
        Self { effort, seed, weights, warp: |u| u }
    }
}

/// A standard error of the mean weight below which rounding and quadrature count, and a test is
/// none.
const NEGLIGIBLE: f64 = 1e-5;

/// Mean and variance of weights (Welford 1962).
#[derive(Debug, Default)]
struct Weights {
    n: usize,
    mean: f64,
    squares: f64,
}

impl Weights {
    fn add(&mut self, weight: f64) {
        self.n += 1;
        let difference = weight - self.mean;
        self.mean += difference / count(self.n);
        self.squares += difference * (weight - self.mean);
    }

    fn standard_error(&self) -> f64 {
        let n = count(self.n);
        (self.squares / (n * (n - 1.0))).sqrt()
    }

    /// The two-sided p-value that the mean is `expected`: normal by the central limit theorem. To
    /// the standard error comes that of the quadrature, far below it.
    fn p_value(&self, expected: Mass) -> f64 {
        let error = self.standard_error().hypot(expected.error);
        erfc((self.mean - expected.value).abs() / error / 2_f64.sqrt())
    }
}

/// χ² and mean weight of every case.
fn run(cases: &[Case], effort: Effort, [mut directions, mut furnace]: [Family; 2]) {
    for (case, seed) in cases.iter().zip(30_000..) {
        let mut weights = Weights::default();
        let pdf = |wi| case.brdf.pdf(wi, case.wo);
        directions.add_outcome(case.against(&pdf, "", Run::new(effort, seed, &mut weights)));
        let albedo = case.albedo(&|wi| case.brdf.eval(wi, case.wo));
        if weights.standard_error() < NEGLIGIBLE {
            // Where α is small nothing is masked, and every weight is 1 to rounding.
            let difference = (weights.mean - albedo.value).abs();
            assert!(difference <= NEGLIGIBLE + albedo.error, "{}: {weights:?}, {albedo:?}", case.label);
            continue;
        }
        furnace.add(weights.p_value(albedo), format!("{}: {:.6} and {albedo:.6?}", case.label, weights.mean));
    }
    directions.assert_accepted();
    furnace.assert_accepted();
}

/// γ = 1 with its exact mask.
fn berry(alpha: f64) -> Distribution {
    Row::Gtr1.with(alpha, 1.0)
}

/// Widths, maps and angles for both ways of sampling.
fn cases() -> Vec<Case> {
    let shapes = [
        (MapSpec::Isotropic(1e-4), [0.0, 60.0, 85.0]),
        (MapSpec::Isotropic(0.1), [30.0, 85.0, 89.5]),
        (MapSpec::Isotropic(0.9), [0.0, 60.0, 89.5]),
        (MapSpec::Axes(0.2, 0.7), [30.0, 60.0, 85.0]),
        (MapSpec::Matrix(0.5, 0.01, 0.6), [0.0, 60.0, 85.0]),
        (MapSpec::Moved(0.3, SKEW), [30.0, 60.0, 85.0]),
        (MapSpec::Moved(0.3, MIRROR), [0.0, 60.0, 89.5]),
    ];
    let mut cases = Vec::new();
    for (shape, angles) in shapes {
        for degrees in angles {
            cases.push(Case::new::<f64>(Distribution::GGX, Normals::Visible, shape, degrees));
            cases.push(Case::new::<f64>(Distribution::BECKMANN, Normals::Visible, shape, degrees));
        }
        cases.push(Case::new::<f64>(Distribution::GGX, Normals::All, shape, angles[1]));
        cases.push(Case::new::<f64>(Distribution::BECKMANN, Normals::All, shape, angles[0]));
        cases.push(Case::new::<f32>(Distribution::GGX, Normals::Visible, shape.scaled(2.0), angles[0]));
        cases.push(Case::new::<f32>(Distribution::BECKMANN, Normals::Visible, shape.scaled(2.0), angles[1]));
    }
    // Every distribution once, from the rows.
    let rows = Row::ALL.iter().flat_map(|row| row.of_width(0.2));
    for (distribution, degrees) in rows.zip([20.0, 50.0, 75.0].into_iter().cycle()) {
        let normals = if distribution.row.samples_visible() { Normals::Visible } else { Normals::All };
        cases.push(Case::new::<f64>(distribution, normals, MapSpec::Axes(0.9, 0.6), degrees));
    }
    for (alpha, shape) in [(0.05, MapSpec::Isotropic(1.0)), (0.3, MapSpec::Moved(0.8, SKEW))] {
        for degrees in [0.0, 60.0] {
            cases.push(Case::new::<f64>(berry(alpha), Normals::All, shape, degrees));
            cases.push(Case::new::<f64>(berry(alpha), Normals::Visible, shape, degrees));
        }
        for gamma in [1.5, 3.4] {
            for degrees in [0.0, 60.0, 85.0] {
                let gtr = Row::Gtr.with(alpha, gamma);
                cases.push(Case::new::<f64>(gtr, Normals::Visible, shape, degrees));
            }
            cases.push(Case::new::<f32>(Row::Gtr.with(alpha, gamma), Normals::Visible, shape, 30.0));
        }
    }
    cases
}

/// Mixtures, of widths at which a uniform direction has a place in the chart of the normals.
fn mixtures() -> Vec<Case> {
    let mut cases = Vec::new();
    for (shape, p) in
        [(MapSpec::Isotropic(0.9), 0.64), (MapSpec::Axes(0.4, 0.7), 0.25), (MapSpec::Moved(0.8, SKEW), 0.05)]
    {
        for degrees in [0.0, 60.0, 85.0] {
            cases.push(Case::new::<f64>(Distribution::GGX, Normals::Mixed(p), shape, degrees));
            cases.push(Case::new::<f32>(Distribution::GGX, Normals::Mixed(1.0 - p), shape, degrees));
            cases.push(Case::new::<f64>(berry(0.3), Normals::Mixed(p), shape, degrees));
        }
        cases.push(Case::new::<f64>(Distribution::BECKMANN, Normals::Mixed(p), shape, 30.0));
    }
    cases
}

#[test]
fn sampled_mixtures_have_their_pdf_and_weights_the_albedo() {
    run(&mixtures(), Effort::QUICK, [Family::new("UniformMixture"), Family::new("mean weights of mixtures")]);
}

#[test]
fn wrong_mixtures_are_rejected() {
    let (p, shape) = (0.2, MapSpec::Axes(0.4, 0.7));
    for distribution in [Distribution::GGX, berry(0.3)] {
        let make = |normals, shape| Case::new::<f64>(distribution, normals, shape, 60.0);
        let case = make(Normals::Mixed(p), shape);
        let wrong = [
            ("the uniform part left out", make(Normals::Mixed(0.0), shape), 1.0 - p),
            ("the normals left out", make(Normals::Mixed(1.0 - f64::EPSILON), shape), p),
            ("the pdf of all normals", make(Normals::All, shape), 1.0),
            ("1 - p for p", make(Normals::Mixed(1.0 - p), shape), 1.0),
            ("p off by 10 %", make(Normals::Mixed(1.1 * p), shape), 1.0),
            ("axes swapped", make(Normals::Mixed(p), shape.swapped()), 1.0),
        ];
        for (why, other, factor) in wrong {
            let mut weights = Weights::default();
            let pdf = |wi| factor * other.brdf.pdf(wi, case.wo);
            let outcome = case.against(&pdf, &format!(", {why}"), Run::new(Effort::QUICK, 1, &mut weights));
            assert_rejected(&outcome);
        }
        let mut weights = Weights::default();
        let warped = Run { warp: |[a, b]| [a, b * b], ..Run::new(Effort::QUICK, 2, &mut weights) };
        assert_rejected(&case.against(&|wi| case.brdf.pdf(wi, case.wo), ", u2 squared", warped));
        let share = make(Normals::Mixed(p), MapSpec::Isotropic(0.9));
        wrong_albedos(&share, &make(Normals::Mixed(p), MapSpec::Isotropic(0.927)));
    }
}

#[test]
fn sampled_directions_have_their_pdf_and_weights_the_albedo() {
    run(&cases(), Effort::QUICK, [Family::new("RoughConductor::sample"), Family::new("mean weights")]);
}

#[test]
fn wrong_pdfs_and_weights_are_rejected() {
    let effort = Effort::QUICK;
    let (axes, skew) = (MapSpec::Axes(0.2, 0.3), MapSpec::Moved(0.2, SKEW));
    for distribution in [Distribution::GGX, Distribution::BECKMANN] {
        for normals in [Normals::Visible, Normals::All] {
            let make = |shape| Case::new::<f64>(distribution, normals, shape, 60.0);
            let reject = |case: &Case, pdf: &dyn Fn([f64; 3]) -> f64, why: &str| {
                let mut weights = Weights::default();
                assert_rejected(&case.against(pdf, why, Run::new(effort, 1, &mut weights)));
            };
            for shape in [MapSpec::Isotropic(0.01), axes] {
                let (case, wider) = (make(shape), make(shape.scaled(1.03)));
                reject(&case, &|wi| wider.brdf.pdf(wi, case.wo), ", alpha off by 3 %");
            }
            let (case, swapped) = (make(axes), make(axes.swapped()));
            reject(&case, &|wi| swapped.brdf.pdf(wi, case.wo), ", axes swapped");
            reject(&case, &|wi| 0.97 * case.brdf.pdf(wi, case.wo), ", determinant off by 3 %");
            let (case, transposed) = (make(skew), make(skew.transposed()));
            reject(&case, &|wi| transposed.brdf.pdf(wi, case.wo), ", transposed map");
            let other = if normals == Normals::All { Normals::Visible } else { Normals::All };
            let other = Case::new::<f64>(distribution, other, skew, 60.0);
            reject(&case, &|wi| other.brdf.pdf(wi, case.wo), ", the pdf of the other normals");
            // The Jacobian of reflection without wo·wm.
            reject(
                &case,
                &|wi| {
                    let (h, wo) = (case.half(wi), case.wo);
                    case.brdf.pdf(wi, wo) * (h[0] * wo[0] + h[1] * wo[1] + h[2] * wo[2])
                },
                ", Jacobian left out",
            );
            let mut weights = Weights::default();
            let warped = Run { warp: |[a, b]| [a * a, b], ..Run::new(effort, 2, &mut weights) };
            let pdf = |wi| case.brdf.pdf(wi, case.wo);
            assert_rejected(&case.against(&pdf, ", u1 squared", warped));
            wrong_albedos(&make(MapSpec::Isotropic(0.9)), &make(MapSpec::Isotropic(0.927)));
        }
    }
}

/// The mean weight of a case is not the albedo of a wider surface, of separable masking, or 1 %
/// more than its own.
fn wrong_albedos(case: &Case, wider: &Case) {
    let mut weights = Weights::default();
    let pdf = |wi| case.brdf.pdf(wi, case.wo);
    let effort = Effort { samples: 400_000, ..Effort::QUICK };
    let outcome = case.against(&pdf, "", Run::new(effort, 3, &mut weights));
    assert!(outcome.rejection(1e-5).is_none());
    let eval = |wi| case.brdf.eval(wi, case.wo);
    let right = case.albedo(&eval);
    let wrong = [
        ("alpha off by 3 %", case.albedo(&|wi| wider.brdf.eval(wi, case.wo))),
        ("separable masking", case.albedo(&|wi| eval(wi) * case.surface.g2_separable_over_g2(wi, case.wo))),
        ("1 % brighter", Mass { value: 1.01 * right.value, ..right }),
    ];
    assert!(weights.p_value(right) > 1e-5, "{}: {} and {right:?}", case.label, weights.mean);
    for (why, albedo) in wrong {
        let p = weights.p_value(albedo);
        eprintln!(
            "negative control {}, weights, {why}: {:.5} and {:.5}, p = {p:.1e}",
            case.label, weights.mean, albedo.value
        );
        assert!(p < 1e-5, "accepted: {}, {why}: {} and {albedo:?}", case.label, weights.mean);
    }
}

/// Every wi drawn has its half vector in the chart: the chart's coordinates go back to the
/// direction they came from.
#[test]
fn half_vectors_reflect_back() {
    let case = Case::new::<f64>(Distribution::GGX, Normals::Visible, MapSpec::Moved(0.3, SKEW), 60.0);
    let mut random = Random::new(4, 53);
    for _ in 0..1000 {
        let u = [random.uniform(), random.uniform()];
        let Some((wi, _)) = case.brdf.sample(case.wo, u) else { continue };
        let (m, solid_angle) = case.chart.point(case.chart.coordinates(case.half(wi)));
        let (back, _) = case.reflected(m).expect("above the horizon");
        let distance = (0..3).map(|k| (back[k] - wi[k]).abs()).fold(0.0, f64::max);
        assert!(distance < 1e-13 && solid_angle > 0.0, "{wi:?} comes back as {back:?}");
    }
}

#[test]
#[ignore = "long: about a quarter of an hour; see main.rs"]
fn long_conductor() {
    let families = [Family::long("long RoughConductor::sample"), Family::long("long mean weights")];
    let cases: Vec<_> = cases().into_iter().chain(mixtures()).collect();
    run(&cases, Effort::LONG, families);
}
