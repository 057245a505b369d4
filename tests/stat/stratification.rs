//! Samplers keep stratified points stratified.
//!
//! A sampler that is continuous and not folded takes evenly spread points to evenly spread points
//! of its density. A cell's count then deviates only by what happens along its rim, in proportion
//! to E^{1/4} or to the logarithm of the discrepancy, where random points deviate by E^{1/2}: the
//! χ² statistic, about 1 a cell for random points, falls far below. Both sets of points begin at
//! u = (0, 0) exactly.

use microsurface::{Beckmann, Ggx, Gtr};

use crate::chart::{Radial, VisibleProfile};
use crate::chi_square::{Effort, Outcome};
use crate::gtr_visible;
use crate::normals;
use crate::points::{Hammersley, LowDiscrepancy, Points, Random};
use crate::surfaces::{SKEW, Shape};
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
    let (skew, flat) = (Shape::Moved(0.1, SKEW), Shape::Isotropic(1.0));
    let gtr = |gamma| *Gtr::spline(0.05_f64, gamma).unwrap().profile();
    let cases = [
        normals::Case::new::<f64, _>("Ggx", Ggx, Radial::Ggx, skew),
        normals::Case::new::<f32, _>("Ggx", Ggx, Radial::Ggx, Shape::Isotropic(1e-3)),
        normals::Case::new::<f64, _>("Beckmann", Beckmann, Radial::Beckmann, skew),
        normals::Case::new::<f64, _>("Gtr 0.3", gtr(0.3), Radial::gtr(0.05, 0.3), flat),
        normals::Case::new::<f64, _>("Gtr 2.7", gtr(2.7), Radial::gtr(0.05, 2.7), skew),
    ];
    for case in &cases {
        check(&case.label, LARGEST_RATIO, &|points| case.outcome(EFFORT, points));
    }
}

#[test]
fn sample_vndf_keeps_even_points_even() {
    for profile in [VisibleProfile::Ggx, VisibleProfile::Beckmann] {
        for degrees in [0.0, 60.0, 89.5, 100.0] {
            let case = visible::Case::new::<f64>(profile, Shape::Moved(0.6, SKEW), degrees, 11);
            check(&case.label, LARGEST_RATIO, &|points| case.outcome(EFFORT, points));
        }
        let case = visible::Case::new::<f32>(profile, Shape::Isotropic(0.01), 60.0, 12);
        check(&case.label, LARGEST_RATIO, &|points| case.outcome(EFFORT, points));
    }
}

/// The borders between components are more rims: χ² falls less, but falls.
#[test]
fn sample_vndf_of_gtr_keeps_even_points_even() {
    for gamma in [0.7, 1.5, 3.4] {
        for degrees in [0.0, 60.0, 89.5, 100.0] {
            let case = gtr_visible::Case::new::<f64>(0.05, gamma, Shape::Moved(0.9, SKEW), degrees, 11);
            check(&case.label, LARGEST_RATIO_OF_COMPONENTS, &|points| case.outcome(EFFORT, points));
        }
    }
}
