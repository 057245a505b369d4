//! The integrals a normal distribution must satisfy, by quadrature, for every profile under every
//! kind of map: ∫D cos = 1, ∫D max(0, w·m) = σ(w), ∫G1 D max(0, w·m) = w.z and the same over
//! reflected directions, ∫D_w = 1, and ∫pdf of a reflection; and that the same code sees a mask 3 %
//! too wide and a forgotten determinant.
//!
//! Deviations are printed with `--nocapture`; the limits below are at most twice the worst of them.

mod random_maps;

use microsurface::bsdf::{AllNormals, RoughConductor};
use microsurface::fresnel::Perfect;
use microsurface::ndf::{Ndf, SampleNdf};

use crate::quadrature::{Estimate, Plane, over_hemisphere, over_reflected_directions, reflection};
use crate::rows::{Distribution, Mask, Row};
use crate::scalar::{Scalar, dot, unit, vec3, wide};
use crate::surfaces::{Move, Shape, Spec, Surface, Widths};
use crate::worst::Worst;

/// The limit of a relative deviation, and the largest share of it that the coarser cubature may be
/// off the finer: where both reach the rounding there is no smaller difference to be had.
#[derive(Clone, Copy)]
struct Limit {
    relative: f64,
    share: f64,
}

/// The largest deviation seen of one identity, and the largest difference of two cubatures.
#[derive(Debug, Default)]
struct Checked {
    deviation: Worst,
    bound: Worst,
}

impl Checked {
    fn see(&mut self, estimate: Estimate, exact: f64, at: &dyn Fn() -> String) {
        self.deviation.see(estimate.value / exact - 1.0, at);
        self.bound.see(estimate.bound / exact, at);
    }

    fn check(&self, name: &str, limit: &Limit) {
        let Self { deviation, bound } = self;
        println!("{name}: deviation {:.2e} at {}", deviation.error, deviation.at);
        println!("    cubature {:.2e} at {}", bound.error, bound.at);
        assert!(deviation.error <= limit.relative, "{name}: {self:?}");
        assert!(bound.error <= limit.share * limit.relative, "{name}: cubature too coarse, {self:?}");
    }
}

/// Maps of principal widths from 1e-4 up, at most a factor `spread` apart for the matrices.
fn widths_and_moves() -> Vec<(Widths, Move)> {
    let rotation = |angle: f64, x: f64, y: f64| {
        let (s, c) = angle.sin_cos();
        Move::Transform([[c * x, s * x], [-s * y, c * y]])
    };
    vec![
        (Widths::Isotropic(1e-4), Move::Stay),
        (Widths::Isotropic(0.01), Move::Stay),
        (Widths::Isotropic(0.3), Move::Stay),
        (Widths::Isotropic(2.0), Move::Stay),
        (Widths::AxisAligned(1e-4, 0.5), Move::Stay),
        (Widths::AxisAligned(0.7, 0.02), Move::Stay),
        (Widths::Matrix { x: 0.2, y: 0.4, correlation: 0.5 }, Move::Stay),
        (Widths::Matrix { x: 0.01, y: 0.3, correlation: -0.9 }, Move::Stay),
        (Widths::Matrix { x: 0.5, y: 0.1, correlation: 0.999 }, Move::Stay),
        (Widths::Matrix { x: 0.001, y: 0.001, correlation: -0.999 }, Move::Stay),
        (Widths::Isotropic(0.2), rotation(0.7, 1.5, 0.4)),
        (Widths::AxisAligned(0.1, 0.6), Move::Transform([[0.3, -1.2], [0.8, 0.5]])),
        (Widths::Matrix { x: 0.3, y: 0.05, correlation: 0.7 }, rotation(-2.1, 0.2, 3.0)),
        (Widths::Isotropic(0.1), Move::Transform([[-1.0, 0.9], [1.0, -0.8]])),
        (Widths::Isotropic(0.25), Move::Stretch(0.6)),
        (Widths::AxisAligned(0.05, 0.3), Move::Stretch(-0.75)),
        (Widths::Matrix { x: 0.2, y: 0.2, correlation: 0.8 }, Move::Stretch(0.3)),
    ]
}

/// The profiles without a width of their own under every map, and the others of several α and γ
/// under what moves the unit map.
fn specs() -> Vec<Spec> {
    let (own_widths, plain): (Vec<Row>, Vec<Row>) =
        Row::with_own_density().partition(|row| row.columns().own_width);
    let mut specs = Vec::new();
    for (widths, moved) in widths_and_moves() {
        let distributions = plain.iter().flat_map(|row| row.of_width(1.0));
        specs.extend(distributions.map(|distribution| Spec::new(distribution, widths, moved)));
    }
    let moves = [
        Move::Stay,
        Move::Stretch(-0.5),
        Move::Transform([[0.3, -1.2], [0.8, 0.5]]),
        Move::Transform([[2.0, 0.0], [0.0, 0.01]]),
    ];
    for (i, alpha) in [1e-4, 0.01, 0.2, 0.9, 1.0].into_iter().enumerate() {
        for moved in [moves[0], moves[1 + i % 3]] {
            let distributions = own_widths.iter().flat_map(|row| row.of_width(alpha));
            specs.extend(distributions.map(|d| Spec::new(d, Widths::Isotropic(1.0), moved)));
        }
    }
    specs
}

fn plane<T: Scalar>(spec: &Spec) -> Plane {
    let (factor, Distribution { alpha, gamma, .. }) = (spec.factor::<T>(), spec.distribution());
    if gamma == f64::INFINITY { Plane::gaussian(factor) } else { Plane::heavy(factor, alpha) }
}

/// Directions from the pole to far below the horizon, as the scalar holds them.
fn directions<T: Scalar>() -> Vec<[f64; 3]> {
    [
        [0.0, 0.0, 1.0],
        [3e-4, -2e-4, 1.0],
        [0.3, 0.4, 0.8],
        [-0.9, 0.2, 0.2],
        [0.5, -0.9, 1e-3],
        [-0.3, -0.8, 1e-9],
        [0.28, 0.96, 0.0],
        [0.8, 0.6, -1e-5],
        [-0.6, 0.7, -0.1],
        [0.3, -0.2, -0.9],
    ]
    .map(|w| unit(w).map(|c| T::lit(c).to_f64()))
    .to_vec()
}

/// D and what follows from it over normals, one evaluation of each; the last two for masks of eight
/// nodes.
fn over_normals<T: Scalar>(limits: &[Limit; 6]) {
    let mut worst: [Checked; 6] = Default::default();
    let mut integrals = 0;
    // Every third in f32: what differs is the rounding.
    for spec in specs().into_iter().step_by(if T::NAME == "f32" { 3 } else { 1 }) {
        let surface: Surface<T> = spec.build().expect("within the domain");
        let plane = plane::<T>(&spec);
        for w in directions::<T>() {
            let at = || format!("{surface:?} {w:?}");
            let direction = vec3::<T>(w);
            let Distribution { alpha, gamma, .. } = spec.distribution();
            if spec.mask() == Mask::Spline && w[2] < 1.0 {
                // Only D is exact: its normalisation is all there is.
                continue;
            }
            let sigma = surface.sigma(direction).to_f64();
            let light = if gamma == f64::INFINITY { 1e-6 } else { 0.1 };
            if gamma > 4.0 && sigma < light * alpha * plane.factor[0][0].abs() {
                // The tail that is seen from far below has a scale of its own.
                continue;
            }
            let [area, vndf, masked] = plane.over_visible_normals(w, |m| {
                let normal = vec3::<T>(m);
                let facing = surface.d(normal).to_f64() * dot(w, m);
                let visible = surface.vndf(direction, normal).to_f64();
                [facing, visible, facing * surface.g1(direction, normal).to_f64()]
            });
            integrals += 1;
            if w[0] == 0.0 && w[1] == 0.0 {
                worst[0].see(area, 1.0, &at);
            }
            if spec.mask() == Mask::Exact {
                worst[1].see(area, sigma, &at);
                worst[2].see(vndf, 1.0, &at);
                if w[2] > 0.0 {
                    worst[3].see(masked, w[2], &at);
                }
            } else if spec.mask() == Mask::Nodes && w[2] >= 0.0 {
                let narrow = alpha < 1e-3;
                worst[if narrow { 4 } else { 5 }].see(area, sigma, &at);
            }
        }
    }
    println!("{}: {integrals} cubatures", T::NAME);
    let names = [
        "∫D cos = 1",
        "∫D max(0, w·m) = σ",
        "∫D_w = 1",
        "∫G1 D max(0, w·m) = w.z",
        "∫D max(0, w·m) = σ of 8 nodes, α = 1e-4",
        "∫D max(0, w·m) = σ of 8 nodes, α ≥ 0.01",
    ];
    for ((worst, limit), name) in worst.iter().zip(limits).zip(names) {
        worst.check(name, limit);
    }
}

const fn limit(relative: f64, share: f64) -> Limit {
    Limit { relative, share }
}

#[test]
fn integrals_over_normals_f64() {
    let [one, others] = [4e-14, 8e-14].map(|relative| limit(relative, 1.0));
    over_normals::<f64>(&[one, others, others, others, limit(1.5e-5, 0.01), limit(1.3e-6, 0.01)]);
}

#[test]
fn integrals_over_normals_f32() {
    let others = limit(2e-6, 0.5);
    over_normals::<f32>(&[limit(2e-7, 1.0), others, others, others, limit(1.5e-5, 0.1), limit(1.1e-6, 0.5)]);
}

/// The reflection's furnace ∫D(h) G1/(4 |w.z|) dwi = 1 over all wi, at every width: the area that
/// wi sweeps is the derivative of the mirror direction by the slope.
#[test]
fn furnace_over_reflected_directions() {
    let mut worst = Checked::default();
    for spec in specs().into_iter().filter(|spec| spec.mask() == Mask::Exact).step_by(2) {
        let surface: Surface<f64> = spec.build().expect("within the domain");
        for w in directions::<f64>().into_iter().filter(|w| w[2] > 0.01) {
            let direction = vec3::<f64>(w);
            let [furnace] = plane::<f64>(&spec).over_visible_normals(w, |m| {
                let (wi, swept) = reflection(w, m);
                let h = vec3::<f64>(unit([wi[0] + w[0], wi[1] + w[1], wi[2] + w[2]]));
                let value = surface.d(h) * surface.g1(direction, h) / (4.0 * w[2]);
                // From slopes, which are integrated with m.z³, to directions.
                [value * swept / (m[2] * m[2] * m[2])]
            });
            worst.see(furnace, 1.0, &|| format!("{surface:?} {w:?}"));
        }
    }
    worst.check("∫D G1/(4 w.z) dwi = 1", &limit(3e-13, 1.0));
}

/// Rough surfaces, for the integrals over directions themselves.
fn rough() -> Vec<Spec> {
    let mut specs = Vec::new();
    for widths in [
        Widths::Isotropic(0.4),
        Widths::Isotropic(1.5),
        Widths::AxisAligned(0.3, 0.8),
        Widths::Matrix { x: 0.5, y: 0.6, correlation: 0.6 },
    ] {
        specs.push(Spec::new(Shape::GGX, widths, Move::Stay));
        specs.push(Spec::new(Shape::BECKMANN, widths, Move::Stay));
    }
    let moved = Move::Transform([[1.2, 0.3], [-0.1, 0.9]]);
    for row in Row::ALL.iter().filter(|row| row.columns().own_width && row.columns().mask == Mask::Exact) {
        specs.extend(row.of_width(0.5).map(|d| Spec::new(d, Widths::Isotropic(1.0), moved)));
    }
    specs
}

/// The same furnace with nothing but directions: polar coordinates of wi about w.
#[test]
fn furnace_over_the_sphere_of_directions() {
    let mut worst = Checked::default();
    for spec in rough() {
        let surface: Surface<f64> = spec.build().expect("within the domain");
        for w in [[0.0, 0.0, 1.0], [0.3, 0.4, 0.8], [-0.8, 0.3, 0.4]].map(unit) {
            let direction = vec3::<f64>(w);
            let furnace = over_reflected_directions(w, |wi| {
                let h = vec3::<f64>(unit([wi[0] + w[0], wi[1] + w[1], wi[2] + w[2]]));
                surface.d(h) * surface.g1(direction, h) / (4.0 * w[2])
            });
            worst.see(furnace, 1.0, &|| format!("{surface:?} {w:?}"));
        }
    }
    worst.check("∫D G1/(4 w.z) dwi = 1 over wi", &limit(1e-11, 0.5));
}

/// A reflection's pdf over the hemisphere is the share of normals that reflect above the horizon.
#[test]
fn pdf_over_the_hemisphere_of_directions() {
    let (mut visible, mut all) = (Checked::default(), Checked::default());
    for spec in rough() {
        let surface: Surface<f64> = spec.build().expect("within the domain");
        let plane = plane::<f64>(&spec);
        let reflection = RoughConductor::new(surface.clone(), Perfect::<f64>::new());
        let by_all = reflection.clone().sampled_by(AllNormals);
        for w in [[0.0, 0.0, 1.0], [0.3, 0.4, 0.8], [-0.7, 0.3, 0.6]].map(unit) {
            let wo = vec3::<f64>(w);
            let at = || format!("{surface:?} {w:?}");
            if surface.samples_visible() {
                let normals = plane.over_reflecting_normals(w, |m| surface.vndf(wo, vec3::<f64>(m)));
                let directions = over_hemisphere(|wi| reflection.pdf(vec3::<f64>(wi), wo));
                visible.see(joined(directions, normals), normals.value, &at);
            }
            let normals = plane.over_reflecting_normals(w, |m| surface.pdf_d(vec3::<f64>(m)));
            let directions = over_hemisphere(|wi| by_all.pdf(vec3::<f64>(wi), wo));
            all.see(joined(directions, normals), normals.value, &at);
        }
    }
    visible.check("∫pdf dwi, visible normals", &limit(3e-13, 1.0));
    all.check("∫pdf dwi, all normals", &limit(3e-13, 1.0));
}

/// `value` with the uncertainty of both.
fn joined(value: Estimate, other: Estimate) -> Estimate {
    Estimate { value: value.value, bound: value.bound + other.bound }
}

/// The deviations of ∫D cos, of σ and of the furnace for a density and a mask that need not belong
/// together.
fn deviations(density: &Surface<f64>, factor: f64, mask: &Surface<f64>, w: [f64; 3]) -> [f64; 3] {
    let plane = plane::<f64>(&density.spec);
    let direction = vec3::<f64>(w);
    let d = |m: [f64; 3]| factor * density.d(vec3::<f64>(m));
    let [normalised] = plane.over_visible_normals([0.0, 0.0, 1.0], |m| [d(m) * m[2]]);
    let [area, furnace] = plane.over_visible_normals(w, |m| {
        [d(m) * dot(w, m), mask.g1(direction, vec3::<f64>(m)) * d(m) * dot(w, m)]
    });
    let deviation = |e: Estimate, exact: f64| (e.value / exact - 1.0).abs() - e.bound / exact;
    [deviation(normalised, 1.0), deviation(area, mask.sigma(direction)), deviation(furnace, w[2])]
}

/// Mistakes that must be seen: a mask of α 3 % too large, a mask with its axes swapped, and a
/// determinant left out.
#[test]
fn wrong_masks_and_determinants_are_seen() {
    let build = |spec: Spec| spec.build::<f64>().expect("within the domain");
    let w = wide(<[f64; 3]>::from(vec3::<f64>(unit([0.8, 0.3, 0.25]))));
    for alpha in [1e-4, 0.01, 0.2, 1.0] {
        for shape in [Shape::GGX, Shape::BECKMANN] {
            let surface = |x: f64, y: f64| build(Spec::new(shape, Widths::AxisAligned(x, y), Move::Stay));
            let right = surface(alpha, 2.0 * alpha);
            let none = deviations(&right, 1.0, &right, w);
            assert!(none.iter().all(|&d| d < 1e-9), "{right:?} {none:?}");
            // Below these widths the masks themselves differ by less than 1e-9 at this angle.
            let visible_mask = shape == Shape::GGX || alpha >= 0.2;
            if visible_mask {
                let wider = deviations(&right, 1.0, &surface(1.03 * alpha, 2.06 * alpha), w);
                let swapped = deviations(&right, 1.0, &surface(2.0 * alpha, alpha), w);
                let least = if alpha < 1e-3 { 1e-9 } else { 2e-6 };
                assert!(wider[0] < 1e-9 && wider[1] > least && wider[2] > least, "{right:?} {wider:?}");
                assert!(swapped[1] > 10.0 * least && swapped[2] > 10.0 * least, "{right:?} {swapped:?}");
            }
        }
    }
    let matrix = Move::Transform([[0.3, -1.2], [0.8, 0.5]]);
    let determinant: f64 = 0.3 * 0.5 + 1.2 * 0.8;
    for row in [Row::Gtr0, Row::Gtr1, Row::Gtr2, Row::Gtr3, Row::Gtr4] {
        let of_width = |alpha| row.with(alpha, 0.0);
        let right = build(Spec::new(of_width(0.2), Widths::Isotropic(1.0), matrix));
        let missing = deviations(&right, 1.0 / determinant, &right, w);
        assert!(missing.iter().all(|&d| d > 0.05), "{right:?} {missing:?}");
        let wider = build(Spec::new(of_width(0.206), Widths::Isotropic(1.0), matrix));
        let wider = deviations(&right, 1.0, &wider, w);
        assert!(row == Row::Gtr0 || (wider[1] > 1e-4 && wider[2] > 1e-4), "{right:?} {wider:?}");
    }
}
