//! All normals: `sample_d` against `pdf_d`.

use microsurface::profile::SampleProfile;
use microsurface::{Beckmann, Ggx, Gtr, Real};

use crate::chart::{Chart, Polar, Radial};
use crate::chi_square::{Effort, Outcome, Subject, test};
use crate::family::{Family, assert_impossible, assert_rejected};
use crate::ks;
use crate::points::{Points, Random};
use crate::surfaces::{MIRROR, SKEW, Shape, Surface, surface};

/// A distribution under a shape: the crate's surface and the test's own idea of it.
pub(crate) struct Case {
    pub(crate) label: String,
    pub(crate) surface: Box<dyn Surface>,
    pub(crate) polar: Polar,
}

impl Case {
    pub(crate) fn new<T: Real, P: SampleProfile<T> + core::fmt::Debug + 'static>(
        name: &str,
        profile: P,
        radial: Radial,
        shape: Shape,
    ) -> Self {
        let surface = surface::<T, P>(profile, shape);
        let label = format!("{name} {shape:?} f{}", if surface.bits() == 24 { 32 } else { 64 });
        Self { label, surface, polar: Polar { radial, inverse: shape.inverse() } }
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
            sample: &mut |u| Some(self.surface.sample_d(u)),
            density: &|m| other.surface.pdf_d(m),
            misses: false,
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

fn ggx<T: Real>(shape: Shape) -> Case {
    Case::new::<T, _>("Ggx", Ggx, Radial::Ggx, shape)
}

fn beckmann<T: Real>(shape: Shape) -> Case {
    Case::new::<T, _>("Beckmann", Beckmann, Radial::Beckmann, shape)
}

fn spline<T: Real>(alpha: f64, gamma: f64, shape: Shape) -> Case {
    let profile = *Gtr::spline(T::lit(alpha), T::lit(gamma)).expect("a width and a tail").profile();
    let name = format!("Gtr alpha {alpha} gamma {gamma}");
    Case::new::<T, _>(&name, profile, Radial::gtr(alpha, gamma), shape)
}

fn closed<T: Real, const G: u8>(alpha: f64, shape: Shape) -> Case {
    let profile = *Gtr::closed::<G>(T::lit(alpha)).expect("a width").profile();
    let name = format!("Gtr closed {G} alpha {alpha}");
    Case::new::<T, _>(&name, profile, Radial::gtr(alpha, f64::from(G)), shape)
}

/// The widths of the isotropic cases of GGX and Beckmann.
pub(crate) const WIDTHS: [f64; 7] = [1e-4, 1e-3, 0.01, 0.1, 0.5, 0.9, 2.5];

/// The other maps, for a width α.
pub(crate) fn shapes(alpha: f64) -> [Shape; 5] {
    [
        Shape::Axes(alpha, 4.0 * alpha),
        Shape::Axes(30.0 * alpha, alpha),
        Shape::Matrix(3.0 * alpha, alpha, 0.6),
        Shape::Moved(alpha, SKEW),
        Shape::Moved(alpha, MIRROR),
    ]
}

fn shape_invariant_cases<T: Real>(widths: &[f64], widths_of_shapes: &[f64]) -> Vec<Case> {
    let isotropic = widths.iter().map(|&alpha| Shape::Isotropic(alpha));
    let others = widths_of_shapes.iter().flat_map(|&alpha| shapes(alpha));
    isotropic.chain(others).flat_map(|shape| [ggx::<T>(shape), beckmann::<T>(shape)]).collect()
}

const PLAIN: Shape = Shape::Isotropic(1.0);

/// Every γ with every width, and the closed forms with some; under other maps in turn.
fn gtr_cases<T: Real>(widths: &[f64]) -> Vec<Case> {
    let mut cases = Vec::new();
    let maps = shapes(0.7);
    for (turn, gamma) in [0.3, 1.0, 1.5, 2.0, 2.7, 4.0].into_iter().enumerate() {
        for &alpha in widths {
            cases.push(spline::<T>(alpha, gamma, PLAIN));
        }
        cases.push(spline::<T>(widths[turn % widths.len()], gamma, maps[turn % maps.len()]));
    }
    for (alpha, shape) in [(0.003, PLAIN), (0.2, PLAIN), (0.05, Shape::Moved(1.0, SKEW))] {
        cases.push(closed::<T, 0>(alpha, shape));
        cases.push(closed::<T, 1>(alpha, shape));
        cases.push(closed::<T, 2>(alpha, shape));
        cases.push(closed::<T, 3>(alpha, shape));
        cases.push(closed::<T, 4>(alpha, shape));
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
fn sample_d_of_ggx_and_beckmann_has_its_density() {
    let mut cases = shape_invariant_cases::<f64>(&WIDTHS, &[1e-4, 0.05, 0.4]);
    cases.extend(shape_invariant_cases::<f32>(&[1e-4, 0.01, 0.9], &[1e-3, 0.3]));
    run(Family::new("sample_d"), &cases, Effort::QUICK);
}

#[test]
fn sample_d_of_gtr_has_its_density() {
    let mut cases = gtr_cases::<f64>(&[1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0]);
    cases.extend(gtr_cases::<f32>(&[1e-4, 0.1]));
    run(Family::new("sample_d of GTR"), &cases, Effort::QUICK);
}

/// tan²θ/α² and azimuth, or v^{1−γ} of GTR, against their closed forms.
#[test]
fn marginals_of_sample_d_have_their_closed_forms() {
    let mut cases = shape_invariant_cases::<f64>(&[1e-4, 0.1, 2.5], &[0.01]);
    cases.extend(shape_invariant_cases::<f32>(&[1e-3, 0.9], &[0.2]));
    cases.extend(gtr_cases::<f64>(&[1e-4, 0.3]));
    cases.extend(gtr_cases::<f32>(&[0.02]));
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
    let axes = Shape::Axes(0.1, 0.13);
    let skew = Shape::Moved(0.05, SKEW);
    for make in [ggx::<f64>, beckmann::<f64>, |shape| spline::<f64>(0.2, 1.5, shape)] {
        for shape in [axes, skew, Shape::Isotropic(0.01)] {
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
                sample: &mut |u| Some(case.surface.sample_d(warp(u))),
                density: &|m| scale * case.surface.pdf_d(m),
                misses: false,
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
        let (case, other) = (spline::<f64>(0.1, gamma, PLAIN), spline::<f64>(0.1, gamma - 0.2, PLAIN));
        assert_rejected(&case.against(&other, ", gamma off by 0.2", effort, &mut Random::new(5, 53)));
    }
}

#[test]
fn wrong_marginals_of_all_normals_are_rejected() {
    for make in [ggx::<f64>, beckmann::<f64>, |shape| spline::<f64>(0.2, 2.7, shape)] {
        let case = make(Shape::Isotropic(0.103));
        let wrong = make(Shape::Isotropic(0.1)).polar;
        let [radial, azimuthal] = marginal_p_values(&case, &wrong, 100_000, 9);
        eprintln!("negative control {}, alpha off by 3 %: p = {radial:.1e}", case.label);
        assert!(radial < 1e-5 && azimuthal > 1e-5, "{}: {radial:e}, {azimuthal:e}", case.label);
    }
}

#[test]
#[ignore = "long: about a quarter of an hour; see main.rs"]
fn long_sample_d() {
    let mut cases = shape_invariant_cases::<f64>(&WIDTHS, &[1e-4, 0.05, 0.4]);
    cases.extend(shape_invariant_cases::<f32>(&WIDTHS, &[1e-3, 0.3]));
    cases.extend(gtr_cases::<f64>(&[1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0]));
    cases.extend(gtr_cases::<f32>(&[1e-3, 0.1]));
    run(Family::long("long sample_d"), &cases, Effort::LONG);
}
