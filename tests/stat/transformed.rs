//! Black boxes moved by skewed, mirrored and nearly singular matrices: both samplers against their
//! densities.

use microsurface::transform::Transformed;
use microsurface::{Beckmann, Ggx, Real};

use crate::chart::{Inverse, Polar, Radial, VisibleProfile};
use crate::chi_square::Effort;
use crate::family::{Family, assert_impossible, assert_rejected};
use crate::normals;
use crate::points::Random;
use crate::surfaces::{MIRROR, SKEW, Surface, Visible};
use crate::visible;

/// The widths of the distributions at rest, which are anisotropic.
const WIDTHS: [f64; 2] = [0.35, 0.12];

/// Singular values 2.2 and 5e-4, neither along the axes.
const NEARLY_SINGULAR: [[f64; 2]; 2] = [[1.1, 1.3], [0.9, 1.0645454545454545]];

const MATRICES: [[[f64; 2]; 2]; 3] = [SKEW, MIRROR, NEARLY_SINGULAR];

/// R M⁻¹: the map of the moved distribution, by rows of `matrix`.
fn inverse([[a, b], [c, d]]: [[f64; 2]; 2]) -> Inverse {
    let det = a * d - b * c;
    let [x, y] = WIDTHS;
    Inverse([[x * d / det, -x * b / det], [-y * c / det, y * a / det]])
}

fn columns<T: Real>([[a, b], [c, d]]: [[f64; 2]; 2]) -> T::Mat2 {
    T::matrix([[a, c], [b, d]].map(|column| column.map(T::lit)))
}

/// The moved GGX or Beckmann, behind a trait.
macro_rules! moved {
    ($t:ty, $profile:expr, $matrix:expr, $trait:path) => {{
        let ([x, y], matrix) = (WIDTHS.map(<$t>::lit), columns::<$t>($matrix));
        let surface: Box<dyn $trait> = match $profile {
            VisibleProfile::Ggx => {
                Box::new(Transformed::new(Ggx::anisotropic(x, y).unwrap(), matrix).unwrap())
            }
            VisibleProfile::Beckmann => {
                Box::new(Transformed::new(Beckmann::anisotropic(x, y).unwrap(), matrix).unwrap())
            }
        };
        surface
    }};
}

const PROFILES: [VisibleProfile; 2] = [VisibleProfile::Ggx, VisibleProfile::Beckmann];

fn all_normals(profile: VisibleProfile, matrix: [[f64; 2]; 2], single: bool) -> normals::Case {
    let surface: Box<dyn Surface> =
        if single { moved!(f32, profile, matrix, Surface) } else { moved!(f64, profile, matrix, Surface) };
    let radial = if profile == VisibleProfile::Ggx { Radial::Ggx } else { Radial::Beckmann };
    let label = format!("{profile:?} moved by {matrix:?}");
    normals::Case { label, surface, polar: Polar { radial, inverse: inverse(matrix) } }
}

fn visible_normals(
    profile: VisibleProfile,
    matrix: [[f64; 2]; 2],
    degrees: f64,
    single: bool,
) -> visible::Case {
    let surface =
        if single { moved!(f32, profile, matrix, Visible) } else { moved!(f64, profile, matrix, Visible) };
    let label = format!("{profile:?} moved by {matrix:?} at {degrees} deg");
    let w = Random::new(5, 24).direction(degrees);
    visible::Case { label, surface, profile, inverse: inverse(matrix), w }
}

#[test]
fn samples_of_moved_black_boxes_have_their_density() {
    let mut family = Family::new("moved black boxes");
    // In flat charts the same points would give the same p-value.
    let mut seeds = 40_000..;
    let mut points = |bits| Random::new(seeds.next().expect("no end"), bits);
    for matrix in MATRICES {
        for profile in PROFILES {
            // The nearly singular map has no digits to spare for f32.
            for single in [false, matrix != NEARLY_SINGULAR] {
                let case = all_normals(profile, matrix, single);
                family.add_outcome(case.outcome(Effort::QUICK, &mut points(case.surface.bits())));
                for degrees in [20.0, 75.0, 89.0, 110.0] {
                    let case = visible_normals(profile, matrix, degrees, single);
                    if case.is_representable() {
                        family.add_outcome(case.outcome(Effort::QUICK, &mut points(case.surface.bits())));
                    }
                }
            }
        }
    }
    family.assert_accepted();
}

#[test]
fn transposed_matrices_and_missing_determinants_are_rejected() {
    let transposed = |[[a, b], [c, d]]: [[f64; 2]; 2]| [[a, c], [b, d]];
    let effort = Effort::QUICK;
    for profile in PROFILES {
        let (case, wrong) =
            (all_normals(profile, SKEW, false), all_normals(profile, transposed(SKEW), false));
        assert_rejected(&case.against(&wrong, ", transposed", effort, &mut Random::new(1, 53)));
        let case = visible_normals(profile, SKEW, 60.0, false);
        let wrong = visible_normals(profile, transposed(SKEW), 60.0, false);
        let density = |m| wrong.surface.vndf(case.w, m);
        assert_rejected(&case.against(&density, ", transposed", effort, &mut Random::new(2, 53)));
        let [[a, b], [c, d]] = SKEW;
        let area = (a * d - b * c).abs();
        let density = |m| case.surface.vndf(case.w, m) / area;
        assert_impossible(&case.against(&density, ", |det M| left out", effort, &mut Random::new(3, 53)));
    }
}
