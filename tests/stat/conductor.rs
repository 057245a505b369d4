//! Reflection through the test kit: `RoughConductor` on every distribution, under maps, by every
//! choice of normals, with what must be rejected.

use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::fresnel::Perfect;
use microsurface::verify::{Bsdf, Kit, Report, Verdict};
use microsurface::{Real, SampleNdf, SampleVndf};

use crate::family::Family;
use crate::rows::{Distribution, Row};
use crate::surfaces::{MIRROR, MapSpec, Normals, Recipe, SKEW, Scalar, made};

/// A BRDF seen from an angle.
#[derive(Debug, Clone, Copy)]
struct Case {
    distribution: Distribution,
    normals: Normals,
    map: MapSpec,
    angles: &'static [f64],
    single: bool,
}

impl Case {
    fn new(distribution: Distribution, normals: Normals, map: MapSpec, angles: &'static [f64]) -> Self {
        Self { distribution, normals, map, angles, single: false }
    }

    fn single(self) -> Self {
        Self { single: true, ..self }
    }

    fn report(&self, kit: &Kit) -> Report {
        let against =
            Against { normals: self.normals, wrong: Wrong::None, kit: kit.clone().angles(self.angles) };
        let Self { distribution, map, .. } = *self;
        if self.single {
            made::<f32, _>(against, distribution, map)
        } else {
            made::<f64, _>(against, distribution, map)
        }
    }
}

/// A fault of the pdf or the values that a sampler is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Wrong {
    None,
    /// pdf or f times a factor.
    Pdf(f64),
    Value(f64),
    /// G2 separable in the values.
    Separable,
    /// The Jacobian of reflection without wo·wm.
    NoJacobian,
    /// The pdf of other normals.
    Normals(Normals),
    /// One of the random numbers is squared.
    Squared(usize),
}

/// The report of the BRDF on a surface.
struct Against {
    normals: Normals,
    wrong: Wrong,
    kit: Kit,
}

impl Against {
    fn report<N, S>(&self, surface: N, sampling: S) -> Report
    where
        N: SampleNdf<Scalar: Scalar>,
        S: NormalSampling<N>,
    {
        let brdf = RoughConductor::new(surface, Perfect::<N::Scalar>::new()).sampled_by(sampling);
        let half = |wi: [N::Scalar; 3], wo: [N::Scalar; 3]| -> [N::Scalar; 3] {
            let h: [N::Scalar; 3] = core::array::from_fn(|k| wi[k] + wo[k]);
            let length = (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]).sqrt();
            h.map(|c| c / length)
        };
        let l = |x: f64| N::Scalar::lit(x);
        let pdf = |wi: [N::Scalar; 3], wo: [N::Scalar; 3]| {
            let pdf = brdf.pdf(wi.into(), wo.into());
            match self.wrong {
                Wrong::Pdf(factor) => l(factor) * pdf,
                Wrong::NoJacobian => {
                    let h = half(wi, wo);
                    pdf * (h[0] * wo[0] + h[1] * wo[1] + h[2] * wo[2])
                }
                Wrong::Normals(_) => {
                    let h = half(wi, wo);
                    let cos = h[0] * wo[0] + h[1] * wo[1] + h[2] * wo[2];
                    let of_normals = if self.normals == Normals::All {
                        brdf.surface().vndf(wo.into(), h.into())
                    } else {
                        brdf.surface().pdf_d(h.into())
                    };
                    if wi[2] > l(0.0) { of_normals / (l(4.0) * cos) } else { l(0.0) }
                }
                _ => pdf,
            }
        };
        let eval = |wi: [N::Scalar; 3], wo: [N::Scalar; 3]| {
            let f = brdf.eval(wi.into(), wo.into());
            match self.wrong {
                Wrong::Value(factor) => l(factor) * f,
                Wrong::Separable if wi[2] > l(0.0) => {
                    let [i, o] = [wi, wo].map(|w| brdf.surface().lambda(w.into()));
                    f * (l(1.0) + i + o) / ((l(1.0) + i) * (l(1.0) + o))
                }
                _ => f,
            }
        };
        let sample = |wo: [N::Scalar; 3], mut u: [N::Scalar; 2]| {
            if let Wrong::Squared(k) = self.wrong {
                u[k] = u[k] * u[k];
            }
            brdf.sample(wo.into(), u.into()).map(|s| (s.wi.into(), s.weight, s.pdf))
        };
        self.kit.bsdf(&Bsdf::new(eval, pdf, sample))
    }
}

impl Recipe for Against {
    type Made = Report;

    fn make<N: SampleNdf<Scalar: Scalar> + 'static>(self, surface: N) -> Report {
        match self.normals {
            Normals::Visible => panic!("no visible normals can be drawn"),
            Normals::All => self.report(surface, AllNormals),
            Normals::Mixed(p) => {
                let p = N::Scalar::lit(p);
                self.report(surface, UniformMixture::new(AllNormals, p).expect("a probability"))
            }
        }
    }

    fn make_visible<N: SampleNdf<Scalar: Scalar> + SampleVndf + 'static>(self, surface: N) -> Report {
        if self.normals == Normals::Visible {
            self.report(surface, VisibleNormals)
        } else {
            self.make(surface)
        }
    }
}

/// Every case passes, and its p-values are uniform together.
fn run(cases: &[Case], kit: &Kit, mut family: Family) {
    for (case, seed) in cases.iter().zip(1..) {
        let report = case.report(&kit.clone().seed(seed));
        assert!(report.passed(), "{case:?}\n{report}");
        // The azimuth's is a few points of a distribution function: not uniform, but too large.
        let tests = ["sample against pdf, χ²", "mean weight = ∫ f |cos|"];
        for check in report.checks.iter().filter(|check| tests.contains(&check.name)) {
            // Where every weight is the same there is no test.
            let p = check.p_value.expect("a test");
            if p < 1.0 - 1e-9 {
                family.add(p, format!("{case:?} {}", check.name));
            }
        }
    }
    family.assert_accepted();
}

/// γ = 1 with its exact mask.
fn berry(alpha: f64) -> Distribution {
    Row::Gtr1.with(alpha, 1.0)
}

/// Widths, maps and angles for both ways of sampling.
fn cases() -> Vec<Case> {
    let maps: [(MapSpec, &'static [f64]); 7] = [
        (MapSpec::Isotropic(1e-4), &[0.0, 60.0, 85.0]),
        (MapSpec::Isotropic(0.1), &[30.0, 85.0, 89.5]),
        (MapSpec::Isotropic(0.9), &[0.0, 60.0, 89.5]),
        (MapSpec::Axes(0.2, 0.7), &[30.0, 60.0, 85.0]),
        (MapSpec::Matrix(0.5, 0.01, 0.6), &[0.0, 60.0, 85.0]),
        (MapSpec::Moved(0.3, SKEW), &[30.0, 60.0, 85.0]),
        (MapSpec::Moved(0.3, MIRROR), &[0.0, 60.0, 89.5]),
    ];
    let mut cases = Vec::new();
    for (map, angles) in maps {
        for distribution in [Distribution::GGX, Distribution::BECKMANN] {
            cases.push(Case::new(distribution, Normals::Visible, map, angles));
            // Of a few large weights the mean is not known.
            cases.push(Case::new(distribution, Normals::All, map, &[20.0]));
        }
        if map.inverse().determinant() > 1e-4 {
            let wider = map.scaled(2.0);
            cases.push(Case::new(Distribution::GGX, Normals::Visible, wider, &angles[..1]).single());
            cases.push(Case::new(Distribution::BECKMANN, Normals::Visible, wider, &angles[..2]).single());
        }
    }
    // Every distribution once, from the rows.
    let angles: [&'static [f64]; 3] = [&[20.0], &[50.0], &[75.0]];
    let rows = Row::ALL.iter().flat_map(|row| row.of_width(0.2));
    for (distribution, angles) in rows.zip(angles.into_iter().cycle()) {
        let visible = distribution.row.samples_visible();
        let (normals, angles): (_, &'static [f64]) =
            if visible { (Normals::Visible, angles) } else { (Normals::All, &[20.0]) };
        cases.push(Case::new(distribution, normals, MapSpec::Axes(0.9, 0.6), angles));
    }
    for (alpha, map) in [(0.05, MapSpec::Isotropic(1.0)), (0.3, MapSpec::Moved(0.8, SKEW))] {
        cases.push(Case::new(berry(alpha), Normals::All, map, &[0.0, 30.0]));
        cases.push(Case::new(berry(alpha), Normals::Visible, map, &[0.0, 60.0]));
        for gamma in [1.5, 3.4] {
            let gtr = Row::Gtr.with(alpha, gamma);
            cases.push(Case::new(gtr, Normals::Visible, map, &[0.0, 60.0, 85.0]));
            cases.push(Case::new(gtr, Normals::Visible, map, &[30.0]).single());
        }
    }
    cases
}

/// Mixtures of uniform directions and normals.
fn mixtures() -> Vec<Case> {
    let mut cases = Vec::new();
    for (map, p) in
        [(MapSpec::Isotropic(0.9), 0.64), (MapSpec::Axes(0.4, 0.7), 0.25), (MapSpec::Moved(0.8, SKEW), 0.05)]
    {
        let angles = &[0.0, 60.0];
        cases.push(Case::new(Distribution::GGX, Normals::Mixed(p), map, angles));
        cases.push(Case::new(Distribution::GGX, Normals::Mixed(1.0 - p), map, angles).single());
        cases.push(Case::new(berry(0.3), Normals::Mixed(p), map, angles));
        cases.push(Case::new(Distribution::BECKMANN, Normals::Mixed(p), map, &[30.0]));
    }
    cases
}

fn kit(samples: usize) -> Kit {
    Kit::new().samples(samples)
}

#[test]
fn sampled_mixtures_have_their_pdf_and_weights_the_albedo() {
    run(&mixtures(), &kit(100_000), Family::new("UniformMixture"));
}

#[test]
fn sampled_directions_have_their_pdf_and_weights_the_albedo() {
    run(&cases(), &kit(100_000), Family::new("RoughConductor"));
}

const CELLS: &str = "sample against pdf, χ²";
const WEIGHTS: &str = "mean weight = ∫ f |cos|";
const INTEGRAL: &str = "∫ pdf = the share of samples that are";

fn rejected(distribution: Distribution, normals: Normals, map: MapSpec, wrong: Wrong, check: &str) {
    let kit = kit(400_000).angles(&[60.0]);
    let report = made::<f64, _>(Against { normals, wrong, kit }, distribution, map);
    let found = report.check(check).expect("a check of this name");
    assert_eq!(found.verdict, Verdict::Failed, "{distribution:?} {normals:?} {map:?} {wrong:?}\n{report}");
}

#[test]
fn wrong_pdfs_and_weights_are_rejected() {
    let rough = MapSpec::Isotropic(0.9);
    for distribution in [Distribution::GGX, Distribution::BECKMANN] {
        for normals in [Normals::Visible, Normals::All] {
            for map in [MapSpec::Isotropic(0.01), MapSpec::Axes(0.2, 0.3), MapSpec::Moved(0.2, SKEW)] {
                rejected(distribution, normals, map, Wrong::Pdf(0.97), INTEGRAL);
                rejected(distribution, normals, map, Wrong::Squared(0), CELLS);
                rejected(distribution, normals, map, Wrong::NoJacobian, INTEGRAL);
            }
            let other = if normals == Normals::All { Normals::Visible } else { Normals::All };
            rejected(distribution, normals, MapSpec::Moved(0.2, SKEW), Wrong::Normals(other), CELLS);
        }
        rejected(distribution, Normals::Visible, rough, Wrong::Separable, WEIGHTS);
        rejected(distribution, Normals::Visible, rough, Wrong::Value(1.01), WEIGHTS);
    }
}

#[test]
fn wrong_mixtures_are_rejected() {
    let (p, map) = (0.2, MapSpec::Axes(0.4, 0.7));
    for distribution in [Distribution::GGX, berry(0.3)] {
        rejected(distribution, Normals::Mixed(p), map, Wrong::Pdf(0.98), INTEGRAL);
        rejected(distribution, Normals::Mixed(p), map, Wrong::Squared(1), CELLS);
        rejected(distribution, Normals::Mixed(p), map, Wrong::Value(1.02), WEIGHTS);
        rejected(distribution, Normals::Mixed(p), map, Wrong::Separable, WEIGHTS);
    }
}

#[test]
#[ignore = "long: about a quarter of an hour; see main.rs"]
fn long_conductor() {
    let cases: Vec<_> = cases().into_iter().chain(mixtures()).collect();
    run(&cases, &kit(10_000_000).showing_progress(), Family::long("long RoughConductor"));
}
