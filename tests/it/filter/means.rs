//! Means over parallelograms and rectangles against adaptive cubature.

use microsurface::bsdf::RoughConductor;
use microsurface::filter::Footprint;
use microsurface::filter::rectangle;
use microsurface::filter::{MeanOverParallelogram, polygon};
use microsurface::fresnel::Schlick;
use microsurface::glam::{DVec2, Vec2};
use microsurface::map::{Isotropic, Map};
use microsurface::{Beckmann, Ggx, Gtr, Microsurface, Ndf, RoughnessMatrix};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::quadrature::gauss_legendre;
use crate::worst::Worst;

/// The mean of f over centre ± ½u ± ½v by cubature that halves a cell until it agrees with its
/// parts.
fn cubature(f: &dyn Fn(DVec2) -> f64, width: f64, centre: DVec2, u: DVec2, v: DVec2) -> f64 {
    let rule = gauss_legendre(9);
    let cell = |centre: DVec2, u: DVec2, v: DVec2| -> f64 {
        let mut sum = 0.0;
        for &[x, wx] in &rule {
            for &[y, wy] in &rule {
                sum += 0.25 * wx * wy * f(centre + 0.5 * x * u + 0.5 * y * v);
            }
        }
        sum
    };
    // The total so far decides what matters.
    let mut total = 0.0;
    let mut stack = vec![(centre, u, v, 1.0, cell(centre, u, v), 0)];
    let mut largest: f64 = 0.0;
    while let Some((centre, u, v, share, coarse, depth)) = stack.pop() {
        let (longer, shorter) = if u.length() >= v.length() { (u, v) } else { (v, u) };
        let half = 0.5 * longer;
        let parts = [-0.25, 0.25].map(|x| {
            let centre = centre + x * longer;
            (centre, half, shorter, 0.5 * share, cell(centre, half, shorter), depth + 1)
        });
        let fine = 0.5 * (parts[0].4 + parts[1].4);
        // A cell much wider than its distance from the highlight may have overlooked it.
        let nearest = (centre.length() - 0.5 * (u.length() + v.length())).max(0.0);
        let seen = longer.length() < width.hypot(nearest);
        if seen {
            largest = largest.max(share * fine);
        }
        if depth >= 90 || seen && share * (fine - coarse).abs() <= 1e-14 * largest.max(total) {
            total += share * fine;
        } else {
            stack.extend(parts);
        }
    }
    total
}

impl Worst {
    /// Takes in the relative error of a mean.
    fn see_mean(&mut self, mean: f64, exact: f64, at: impl FnOnce() -> String) {
        self.see(if mean == exact { 0.0 } else { mean / exact - 1.0 }, at);
    }

    /// Within the bound, and not so far within that it is a lie.
    fn assert_within(&self, bound: f64) {
        assert!(self.error <= bound && self.error >= 0.3 * bound, "{bound:e}: {self:?}");
    }
}

/// A vector of this length in any direction.
fn turned(rng: &mut Pcg64, length: f64) -> DVec2 {
    DVec2::from_angle(rng.random_range(0.0..core::f64::consts::TAU)) * length
}

fn between(rng: &mut Pcg64, from: f64, to: f64) -> f64 {
    (rng.random_range(from.ln()..to.ln())).exp()
}

/// Of all shapes and sizes, in units of the width: the two edges and the slope.
fn footprint(rng: &mut Pcg64, kind: usize) -> [DVec2; 3] {
    let size = between(rng, 1e-8, 1e5);
    let slope = between(rng, 1e-3, 1e4);
    let slope = turned(rng, slope);
    let u = turned(rng, size);
    let v = match kind {
        // As long, much shorter, a line with and without a width, next to a line.
        0 => {
            let v = between(rng, 0.1, 1.0) * size;
            turned(rng, v)
        }
        1 => {
            let v = between(rng, 1e-9, 1.0) * size;
            turned(rng, v)
        }
        2 => DVec2::ZERO,
        3 => rng.random_range(-1.0..1.0) * u,
        _ => rng.random_range(-1.0..1.0) * u + between(rng, 1e-12, 1e-2) * u.perp(),
    };
    // Half of them beside the highlight or across it.
    if rng.random_bool(0.5) {
        let slope = rng.random_range(-0.6..0.6) * u + rng.random_range(-0.6..0.6) * v;
        let beside = between(rng, 1e-3, 10.0);
        return [slope + turned(rng, beside), u, v];
    }
    [slope, u, v]
}

/// The number of footprints: `MICROSURFACE_MEANS=100000` for more.
fn count(few: usize) -> usize {
    std::env::var("MICROSURFACE_MEANS").map_or(few, |n| n.parse().unwrap())
}

/// Means over random footprints of a surface of width 1, against cubature.
fn worst_of<P: MeanOverParallelogram<f64>, M: Map<Scalar = f64>>(
    surface: &Microsurface<P, M>,
    width: f64,
    kinds: &[usize],
    few: usize,
    reach: impl Fn([DVec2; 3]) -> bool,
) -> Worst
where
    Microsurface<P, M>: Ndf<Scalar = f64>,
{
    let mut rng = Pcg64::seed_from_u64(5);
    let mut worst = Worst::default();
    for i in 0..count(few) {
        let footprint = footprint(&mut rng, kinds[i % kinds.len()]);
        if reach(footprint) {
            let [slope, u, v] = footprint;
            let exact = cubature(&|t| surface.p22(t), width, slope, u, v);
            worst.see_mean(polygon::mean_p22(surface, slope, u, v), exact, || format!("{slope} {u} {v}"));
        }
    }
    worst
}

#[test]
fn ggx_over_parallelograms_of_all_sizes() {
    let surface = Ggx::isotropic(1.0).unwrap();
    // Parallelograms and thin ones; lines; thin ones whose edges have nearly one direction.
    worst_of(&surface, 1.0, &[0, 1], 4000, |_| true).assert_within(1.3e-11);
    worst_of(&surface, 1.0, &[2, 3], 400, |_| true).assert_within(1.3e-11);
    worst_of(&surface, 1.0, &[4], 600, |_| true).assert_within(9e-11);
}

#[test]
fn gtr_and_beckmann_over_parallelograms() {
    for gamma in [0.4, 1.5, 2.0, 3.3, 9.0] {
        for alpha in [0.05, 0.7] {
            let surface = Gtr::isotropic(alpha, gamma).unwrap();
            // As a heavier tail than GGX asks for more of the cubature.
            let worst = worst_of(&surface, alpha, &[0, 1, 2, 3, 4], 40, |[_, u, _]| u.length() < 1e3);
            assert!(worst.error < 1e-9, "{gamma} {alpha}: {worst:?}");
        }
    }
    let surface = Beckmann::isotropic(1.0).unwrap();
    // Also where next to nothing is left, and over edges of nearly one direction, whose ends are
    // pieces of their own.
    let near = |[slope, u, v]: [DVec2; 3]| slope.length() - 0.5 * (u.length() + v.length()) < 20.0;
    worst_of(&surface, 0.3, &[0, 1, 2, 3, 4], 200, near).assert_within(1e-9);
}

/// By mpmath with 40 digits: as products of error functions, and by nested quadrature.
#[test]
fn means_of_chosen_footprints() {
    let beckmann = Beckmann::isotropic(1.0).unwrap();
    let box_mean: f64 = rectangle::mean_p22(&beckmann, DVec2::ZERO, DVec2::splat(0.25));
    assert!((box_mean / 0.30542509561363483 - 1.0).abs() < 2e-14, "{box_mean}");
    // Slim and far from the highlight: the sum over its edges has seven digits.
    let (slope, u, v) = (
        DVec2::new(-977.1978560392672, 6270.022176617847),
        DVec2::new(-272.6707848835294, 2133.2482784879035),
        DVec2::new(-0.023343710803691388, 0.0022815395801901),
    );
    let mean: f64 = polygon::mean_p22(&Ggx::isotropic(1.0).unwrap(), slope, u, v);
    assert!((mean / 2.1626387136984451e-16 - 1.0).abs() < 1e-12, "{mean:e}");
    // Long edges beside a narrow highlight hold nothing.
    let narrow = Beckmann::isotropic(0.01).unwrap();
    let edges = [DVec2::new(0.1, 0.0), DVec2::new(0.0, 0.1)];
    assert_eq!(polygon::mean_p22(&narrow, DVec2::new(1.5, 0.0), edges[0], edges[1]), 0.0);
}

#[test]
fn maps_carry_parallelograms_to_parallelograms() {
    let mut rng = Pcg64::seed_from_u64(6);
    let matrix = RoughnessMatrix::rotated(0.02, 0.6, 0.7).unwrap();
    let surface = Ggx::from_roughness_matrix(matrix);
    // A slope of the surface from one of the unit profile: means are the same.
    let moved = |t: DVec2| DVec2::from_angle(0.7).rotate(DVec2::new(0.02 * t.x, 0.6 * t.y));
    let mut worst = Worst::default();
    for i in 0..300 {
        let footprint = footprint(&mut rng, i % 5);
        let [slope, u, v] = footprint;
        let exact = cubature(&|t| surface.p22(moved(t)), 1.0, slope, u, v);
        let [slope, u, v] = footprint.map(moved);
        worst.see_mean(polygon::mean_p22(&surface, slope, u, v), exact, || format!("{slope} {u} {v}"));
    }
    worst.assert_within(1.3e-11);
}

#[test]
fn rectangles_are_parallelograms_along_the_axes() {
    let mut rng = Pcg64::seed_from_u64(7);
    let (ggx, beckmann) = (Ggx::anisotropic(0.5, 2.0).unwrap(), Beckmann::anisotropic(0.5, 2.0).unwrap());
    let scale = DVec2::new(0.5, 2.0);
    let tilted = Ggx::from_roughness_matrix(RoughnessMatrix::new(0.25, 0.3, 4.0).unwrap());
    let mut worst: [Worst; 3] = Default::default();
    for _ in 0..300 {
        let half = DVec2::new(between(&mut rng, 1e-8, 1e2), between(&mut rng, 1e-8, 1e2));
        let distance = between(&mut rng, 1e-3, 5.0);
        let slope = turned(&mut rng, distance);
        let (u, v) = (DVec2::new(2.0 * half.x, 0.0), DVec2::new(0.0, 2.0 * half.y));
        let exact = |p22: &dyn Fn(DVec2) -> f64| cubature(p22, 0.5, slope, u, v);
        let at = || format!("{slope} {half}");
        let mean = |surface: &dyn Fn(DVec2, DVec2) -> f64| surface(scale * slope, scale * half);
        let of_ggx = mean(&|slope, half| rectangle::mean_p22(&ggx, slope, half));
        worst[0].see_mean(of_ggx, exact(&|t| ggx.p22(scale * t)), at);
        let of_tilted = mean(&|slope, half| rectangle::mean_p22(&tilted, slope, half));
        worst[1].see_mean(of_tilted, exact(&|t| tilted.p22(scale * t)), at);
        let of_beckmann = mean(&|slope, half| rectangle::mean_p22(&beckmann, slope, half));
        worst[2].see_mean(of_beckmann, exact(&|t| beckmann.p22(scale * t)), at);
    }
    worst[0].assert_within(4e-12);
    worst[1].assert_within(4e-12);
    worst[2].assert_within(3e-14);
}

#[test]
fn a_point_a_line_and_everything() {
    let surface = Ggx::anisotropic(0.1_f64, 0.3).unwrap();
    let (slope, zero) = (DVec2::new(0.2, -0.1), DVec2::ZERO);
    assert!((polygon::mean_p22(&surface, slope, zero, zero) / surface.p22(slope) - 1.0).abs() < 1e-15);
    assert!((rectangle::mean_p22(&surface, slope, zero) / surface.p22(slope) - 1.0).abs() < 1e-15);
    for (width, share) in [(1e3, 1e-6), (1e6, 1e-12)] {
        let (u, v) = (DVec2::new(width, 0.0), DVec2::new(0.3 * width, width));
        let all = polygon::mean_p22(&surface, slope, u, v) * width * width;
        assert!((all - 1.0).abs() < share, "{all}");
    }
    // Not finite.
    let infinite = DVec2::new(f64::INFINITY, 0.0);
    assert_eq!(polygon::mean_p22(&surface, slope, infinite, zero), 0.0);
    assert_eq!(polygon::mean_p22(&surface, infinite, zero, zero), 0.0);
    assert_eq!(rectangle::mean_p22(&surface, slope, infinite), 0.0);
    assert_eq!(rectangle::mean_p22(&surface, infinite, slope), 0.0);
    assert!(rectangle::mean_p22(&surface, DVec2::NAN, slope).is_nan());
    assert!(polygon::mean_p22(&surface, DVec2::NAN, zero, zero).is_nan());
    assert!(polygon::mean_p22(&surface, slope, DVec2::NAN, zero).is_nan());
}

/// f32 surfaces are averaged in f64, of their own rounded numbers.
#[test]
fn f32_is_f64_rounded() {
    let mut rng = Pcg64::seed_from_u64(8);
    for i in 0..2000 {
        let [slope, u, v] = footprint(&mut rng, i % 5).map(|t| (0.01 * t).as_vec2());
        let (single, double) =
            (Ggx::isotropic(0.01_f32).unwrap(), Ggx::isotropic(f64::from(0.01_f32)).unwrap());
        let mean = polygon::mean_p22(&single, slope, u, v);
        let exact = polygon::mean_p22(&double, slope.as_dvec2(), u.as_dvec2(), v.as_dvec2());
        assert!((f64::from(mean) - exact).abs() <= 0.51 * f64::from(f32::EPSILON) * exact, "{slope} {u} {v}");
    }
}

#[test]
fn shares_of_polygons_add_up() {
    let mut rng = Pcg64::seed_from_u64(9);
    let surface = Ggx::from_roughness_matrix(RoughnessMatrix::rotated(0.1, 0.5, 0.4).unwrap());
    for _ in 0..100 {
        let vertices: [DVec2; 4] = core::array::from_fn(|i| {
            DVec2::from_angle(core::f64::consts::FRAC_PI_2 * i as f64) * between(&mut rng, 0.01, 3.0)
        });
        let [a, b, c, d] = vertices;
        let whole: f64 = polygon::integral_p22(&surface, &vertices);
        let parts = polygon::integral_p22(&surface, &[a, b, c]) + polygon::integral_p22(&surface, &[d, c, a]);
        // The quadrilateral about the origin may be concave at a or c, not beyond the diagonal.
        let concave = (b - a).perp_dot(c - a) * (c - a).perp_dot(d - a) < 0.0;
        if !concave {
            assert!((whole - parts).abs() < 1e-15, "{whole} {parts}");
        }
        assert!(whole > 0.0 && whole < 1.0);
    }
    assert_eq!(polygon::integral_p22(&surface, &[]), 0.0);
    assert_eq!(polygon::integral_p22(&surface, &[DVec2::X]), 0.0);
    let nothing: f64 = polygon::integral_p22(&surface, &[DVec2::X, DVec2::Y]);
    assert!(nothing.abs() < 1e-16);
}

/// The BRDF over a footprint is the mean of BRDFs with the half vector moved, masks and Fresnel
/// kept.
#[test]
fn the_brdf_over_a_footprint() {
    let mut rng = Pcg64::seed_from_u64(10);
    for i in 0..300 {
        let surface = Ggx::from_roughness_matrix(RoughnessMatrix::rotated(0.02, 0.1, 0.3).unwrap());
        let material = RoughConductor::new(surface, Schlick::new(0.5).unwrap());
        let [wi, wo] = [(); 2].map(|()| {
            let z = between(&mut rng, 1e-3, 1.0);
            turned(&mut rng, (1.0 - z * z).sqrt()).extend(z)
        });
        let [_, u, v] = footprint(&mut rng, i % 5).map(|t| 0.02 * t);
        let wm = (wi + wo).normalize();
        let slope = -wm.truncate() / wm.z;
        let over = material.eval_over(wi, wo, Footprint::<f64>::new(u, v));
        let ratio = polygon::mean_p22(&surface, slope, u, v) / surface.p22(slope);
        let expected = material.eval(wi, wo) * ratio;
        assert!((over / expected - 1.0).abs() < 1e-10, "{wi} {wo} {over} {expected}");
        let point = Footprint::<f64>::new(DVec2::ZERO, DVec2::ZERO);
        assert!((material.eval_over(wi, wo, point) / material.eval(wi, wo) - 1.0).abs() < 1e-11);
        // Symmetric, and dark below the horizon.
        let swapped = material.eval_over(wo, wi, Footprint::<f64>::new(v, u));
        assert!((over / swapped - 1.0).abs() < 1e-10);
        assert_eq!(material.eval_over(-wi, wo, point), 0.0);
    }
}

/// However large or far, every profile ends with a number that is neither negative nor above the
/// peak.
#[test]
fn footprints_without_measure() {
    fn bounded<P: MeanOverParallelogram<f64>>(
        surface: &Microsurface<P, Isotropic<f64>>,
        peak: f64,
        rounds: u32,
    ) where
        Microsurface<P, Isotropic<f64>>: Ndf<Scalar = f64>,
    {
        let mut rng = Pcg64::seed_from_u64(12);
        let sizes = [0.0, 1e-300, 1e-30, 1.0, 1e8, 1e13, 1e30, 1e60, 1e69, 1e100, 1e200, f64::MAX];
        for _ in 0..rounds {
            let [slope, u, v] = [(); 3].map(|()| {
                let size = sizes[rng.random_range(0..sizes.len())];
                turned(&mut rng, 1.0) * size
            });
            let means = [
                polygon::mean_p22(surface, slope, u, v),
                polygon::mean_p22(surface, slope, u, 0.5 * u),
                polygon::mean_p22(surface, 0.3 * u, u, v),
                rectangle::mean_p22(surface, slope, u),
            ];
            assert!(means.iter().all(|m| (0.0..=peak).contains(m)), "{slope} {u} {v}: {means:?}");
        }
    }
    let peak = |surface: &dyn Ndf<Scalar = f64>| surface.p22(DVec2::ZERO) * (1.0 + 1e-9);
    let surface = Ggx::isotropic(0.1).unwrap();
    bounded(&surface, peak(&surface), 400);
    let surface = Beckmann::isotropic(0.1).unwrap();
    bounded(&surface, peak(&surface), 400);
    let surface = Gtr::isotropic(0.1, 3.3).unwrap();
    bounded(&surface, peak(&surface), 12);
}

#[test]
fn the_brdf_over_any_footprint_is_a_number() {
    let mut rng = Pcg64::seed_from_u64(11);
    for i in 0..20_000 {
        let alpha = between(&mut rng, 1e-6, 1.0) as f32;
        let material = RoughConductor::new(Ggx::isotropic(alpha).unwrap(), Schlick::new(0.5_f32).unwrap());
        let [wi, wo] = [(); 2].map(|()| {
            let z = between(&mut rng, 1e-30, 1.0);
            turned(&mut rng, (1.0 - z * z).sqrt()).extend(z).as_vec3()
        });
        let [_, u, v] = footprint(&mut rng, i % 5);
        let bad = [u.as_vec2(), Vec2::new(f32::INFINITY, 0.0), Vec2::new(f32::MAX, f32::MAX), Vec2::ZERO];
        let footprint = Footprint::<f32>::new(bad[rng.random_range(0..4)], v.as_vec2());
        for footprint in [footprint, footprint.clamped(1.0)] {
            let f = material.eval_over(wi, wo, footprint);
            assert!(f >= 0.0, "{f} of alpha {alpha}, {wi} {wo} {footprint:?}");
        }
        let nan = Footprint::<f32>::new(Vec2::NAN, v.as_vec2());
        assert_eq!(material.eval_over(wi, wo, nan), 0.0);
        assert_eq!(material.eval_over(wi, wo, Footprint::new(Vec2::Y, Vec2::new(0.0, f32::INFINITY))), 0.0);
        assert!(material.eval_over(wi, wo, nan.clamped(1.0)) >= 0.0);
    }
}

/// The peak of the surface of α' is the mean about the peak, and the values recovered from Eq. 20 of
/// Kaplanyan et al. 2016.
#[test]
fn alpha_of_equal_peak_keeps_the_peak() {
    for (alpha, side, expected) in [(0.1_f64, 0.1, 0.1153), (0.1, 0.4, 0.2476), (0.01, 0.4, 0.2259)] {
        assert!((rectangle::alpha_of_equal_peak(alpha, side) - expected).abs() < 5e-5);
    }
    for alpha in [1e-6, 0.02, 0.7, 30.0] {
        assert_eq!(rectangle::alpha_of_equal_peak(alpha, 0.0), alpha);
        let mut last = alpha;
        for i in -60..60 {
            let side = alpha * 2.0_f64.powi(i).sqrt();
            let widened = rectangle::alpha_of_equal_peak(alpha, -side);
            let half = DVec2::splat(0.5 * side);
            let mean = rectangle::mean_p22(&Ggx::isotropic(alpha).unwrap(), DVec2::ZERO, half);
            let peak = Ggx::isotropic(widened).unwrap().p22(DVec2::ZERO);
            // The mean's own accuracy.
            assert!((peak / mean - 1.0).abs() < 1.3e-11, "{alpha} {side}: {peak} {mean}");
            assert!(widened >= last);
            last = widened;
        }
    }
    assert!(rectangle::alpha_of_equal_peak(f32::NAN, 0.1).is_nan());
    assert!(rectangle::alpha_of_equal_peak(0.1, f32::NAN).is_nan());
}
