//! Samplers keep stratified points stratified.
//!
//! A sampler that is continuous and not folded takes evenly spread points to evenly spread points
//! of its density. A cell's count then deviates only by what happens along its rim, in proportion
//! to E^{1/4} or to the logarithm of the discrepancy, where random points deviate by E^{1/2}: the
//! χ² statistic, about 1 a cell for random points, falls far below. Both sets of points begin at
//! u = (0, 0) exactly.

use crate::chi_square::{Effort, Outcome};
use crate::gtr_visible;
use crate::normals;
use crate::points::{Hammersley, LowDiscrepancy, Points, Random};
use crate::rows::{Distribution, Row};
use crate::surfaces::{MapSpec, SKEW};
use crate::visible;

const LOG2_SAMPLES: u32 = 17;
const EFFORT: Effort = Effort { samples: 1 << LOG2_SAMPLES, rows: 12, columns: 10, depth: 5 };

/// χ² of even points for a degree of freedom, at most. The worst here is about a third of it.
const LARGEST_RATIO: f64 = 0.25;

/// The test for GTR, whose components and exponents are chosen by a coordinate too: every border
/// between two is a rim that some cells have inside.
const LARGEST_RATIO_OF_COMPONENTS: f64 = 0.5;

fn ratio(outcome: &Outcome) -> f64 {
    let rejection = outcome.rejection(0.0);
    assert!(rejection.is_none(), "{}", rejection.unwrap_or_default());
    outcome.statistic / crate::special::count(outcome.dof)
}

/// Both kinds of even points stay even; random points do not pass for even.
fn check(label: &str, largest: f64, run: &dyn Fn(&mut dyn Points) -> Outcome) {
    let net = ratio(&run(&mut Hammersley(LOG2_SAMPLES)));
    let sequence = ratio(&run(&mut LowDiscrepancy));
    let random = ratio(&run(&mut Random::new(5, 24)));
    eprintln!(
        "stratification: chi2/dof = {net:.3} (Hammersley), {sequence:.3} (R2), {random:.3} (random)  {label}"
    );
    assert!(net < largest && sequence < largest, "{label}: {net}, {sequence}");
    assert!(random > 1.5 * largest, "random points pass for even ones: {label}: {random}");
}

#[test]
fn sample_d_keeps_even_points_even() {
    let (skew, flat) = (MapSpec::Moved(0.1, SKEW), MapSpec::Isotropic(1.0));
    let gtr = |gamma| Row::SplineGtr.with(0.05, gamma);
    let cases = [
        normals::Case::new::<f64>(Distribution::GGX, skew),
        normals::Case::new::<f32>(Distribution::GGX, MapSpec::Isotropic(1e-3)),
        normals::Case::new::<f64>(Distribution::BECKMANN, skew),
        normals::Case::new::<f64>(gtr(0.3), flat),
        normals::Case::new::<f64>(gtr(2.7), skew),
    ];
    for case in &cases {
        check(&case.label, LARGEST_RATIO, &|points| case.outcome(EFFORT, points));
    }
}

#[test]
fn sample_vndf_keeps_even_points_even() {
    for profile in [Distribution::GGX, Distribution::BECKMANN] {
        for degrees in [0.0, 60.0, 89.5, 100.0] {
            let case = visible::Case::new::<f64>(profile, MapSpec::Moved(0.6, SKEW), degrees, 11);
            check(&case.label, LARGEST_RATIO, &|points| case.outcome(EFFORT, points));
        }
        let case = visible::Case::new::<f32>(profile, MapSpec::Isotropic(0.01), 60.0, 12);
        check(&case.label, LARGEST_RATIO, &|points| case.outcome(EFFORT, points));
    }
}

/// The borders between components are more rims: χ² falls less, but falls.
#[test]
fn sample_vndf_of_gtr_keeps_even_points_even() {
    for gamma in [0.7, 1.5, 3.4] {
        for degrees in [0.0, 60.0, 89.5, 100.0] {
            let case = gtr_visible::Case::new::<f64>(0.05, gamma, MapSpec::Moved(0.9, SKEW), degrees, 11);
            check(&case.label, LARGEST_RATIO_OF_COMPONENTS, &|points| case.outcome(EFFORT, points));
        }
    }
}
