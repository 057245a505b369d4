//! Filters of G-buffers: published numbers, bounds, footprints of normals, and bad input.

use microsurface::Error;
use microsurface::filter::Footprint;
use microsurface::filter::deferred::{
    Bound, Kernel, isotropic, isotropic_from_normals, max_eigenvalue, quad_in_slopes, quad_projected,
    rectangle, rectangle_maximum,
};
use microsurface::frame::Frame;
use microsurface::glam::{DMat2, DVec2, DVec3, Vec2, Vec3};
use rand_pcg::Pcg64Mcg;

use crate::random::uniform;

fn random_footprint(random: &mut Pcg64Mcg, size: f64) -> Footprint<f64> {
    let mut step = || DVec2::new(uniform(random, -size, size), uniform(random, -size, size));
    let (du, dv) = (step(), step());
    Footprint::new(du, dv)
}

/// Listings 2 and 3 of 2017 and Eq. 14 of 2021, with the constants the papers give.
#[test]
fn published_numbers() {
    let (du, dv) = (DVec3::new(0.1, 0.2, -0.1), DVec3::new(0.0, 0.1, 0.05));
    let squares = 0.06 + 0.0125;
    let square = |alpha: f64| alpha * alpha;
    let old = isotropic_from_normals(0.1, du, dv, &Kernel::tokuyoshi2019(), Bound::Upper);
    assert!((square(old) - (0.01 + 2.0 * 0.25 * squares)).abs() < 1e-15);
    let new = isotropic_from_normals(0.1, du, dv, &Kernel::tokuyoshi2021(), Bound::Mean);
    assert!((square(new) - (0.01 + 0.159_154_943_091_895_34 * squares)).abs() < 1e-15);
    // min(…, 0.18)
    let far = DVec3::new(1.0, 0.0, 0.0);
    for kernel in [Kernel::tokuyoshi2019(), Kernel::tokuyoshi2021()] {
        let limited = isotropic_from_normals(0.1, far, far, &kernel, Bound::Upper);
        assert!((square(limited) - 0.19).abs() < 1e-15);
    }
    // Listing 3: abs(deltaU) + abs(deltaV), and its maximum.
    let footprint = Footprint::new(DVec2::new(0.1, -0.2), DVec2::new(-0.05, -0.1));
    let [x, y] = rectangle([0.1, 0.2], footprint, &Kernel::tokuyoshi2019());
    assert!(
        (square(x) - (0.01 + 0.5 * 0.0225)).abs() < 1e-15 && (square(y) - (0.04 + 0.5 * 0.09)).abs() < 1e-15
    );
    let maximum = rectangle_maximum(0.1, footprint, &Kernel::tokuyoshi2019());
    assert!((square(maximum) - (0.01 + 0.5 * 0.09)).abs() < 1e-15);
    // The same derivatives as a footprint: only lengths count.
    let as_footprint = Footprint::new(DVec2::new(0.06_f64.sqrt(), 0.0), DVec2::new(0.0, 0.0125_f64.sqrt()));
    assert!((isotropic(0.1, as_footprint, &Kernel::tokuyoshi2019(), Bound::Upper) - old).abs() < 1e-15);
}

/// The extents limited by λ = 1 and the kernel limited by κ = 2σ²λ² are the same filter.
#[test]
fn a_limit_of_extents_is_a_limit_of_the_kernel() {
    let mut random = Pcg64Mcg::new(1);
    let kernel = Kernel::<f64>::kaplanyan2016();
    for _ in 0..1000 {
        let footprint = random_footprint(&mut random, 1.0);
        let extents = footprint.clamped_extents(1.0);
        let [x, y] = rectangle([0.1, 0.3], footprint, &kernel);
        assert!((x * x - (0.01 + 0.5 * extents.x * extents.x)).abs() < 1e-15);
        assert!((y * y - (0.09 + 0.5 * extents.y * extents.y)).abs() < 1e-15);
    }
}

/// Mean ≤ larger eigenvalue ≤ sum, and the rectangle between half and twice the eigenvalue, both of
/// which are reached.
#[test]
fn bounds_are_ordered() {
    let mut random = Pcg64Mcg::new(2);
    let kernel = Kernel::new(0.25, 1e9).unwrap();
    let gain = |alpha: f64| alpha * alpha - 0.01;
    let slack = 1.0 + 1e-12;
    for _ in 0..10_000 {
        let footprint = random_footprint(&mut random, 1.0);
        let eigenvalue = gain(max_eigenvalue(0.1, footprint, &kernel));
        let mean = gain(isotropic(0.1, footprint, &kernel, Bound::Mean));
        let sum = gain(isotropic(0.1, footprint, &kernel, Bound::Upper));
        assert!(mean <= eigenvalue * slack && eigenvalue <= sum * slack && (sum - 2.0 * mean).abs() < 1e-14);
        let longer = gain(rectangle_maximum(0.1, footprint, &kernel));
        assert!(0.5 * eigenvalue <= longer * slack && longer <= 2.0 * eigenvalue * slack);
        // The eigenvalue as the largest variance of any direction.
        let [du, dv] = footprint.steps();
        let largest = (0..2000).fold(0.0_f64, |largest, i| {
            let direction = DVec2::from_angle(f64::from(i) * core::f64::consts::PI / 2000.0);
            largest.max(du.dot(direction).powi(2) + dv.dot(direction).powi(2))
        });
        assert!((0.5 * largest / eigenvalue - 1.0).abs() < 1e-5, "{largest} {eigenvalue}");
    }
    let diagonal = Footprint::new(DVec2::new(0.3, 0.3), DVec2::ZERO);
    let ratio =
        gain(rectangle_maximum(0.1, diagonal, &kernel)) / gain(max_eigenvalue(0.1, diagonal, &kernel));
    assert!((ratio - 0.5).abs() < 1e-12, "{ratio}");
    let square = Footprint::new(DVec2::new(0.3, 0.3), DVec2::new(0.3, -0.3));
    let ratio = gain(rectangle_maximum(0.1, square, &kernel)) / gain(max_eigenvalue(0.1, square, &kernel));
    assert!((ratio - 2.0).abs() < 1e-12, "{ratio}");
}

/// The normal of an ellipsoid x²/a² + y²/b² + z²/c² = 1 above (x, y).
fn ellipsoid(x: f64, y: f64) -> (DVec3, DVec3) {
    let (a, b, c) = (3.0, 2.0, 1.5);
    let z = c * (1.0 - x * x / (a * a) - y * y / (b * b)).sqrt();
    (DVec3::new(x, y, z), DVec3::new(x / (a * a), y / (b * b), z / (c * c)).normalize())
}

/// Derivatives of normals by the shape operator, from differences along the tangents, are those
/// across pixels.
#[test]
fn curvature_moves_normals() {
    let (x, y, h) = (0.8, -0.5, 1e-4);
    let (_, n) = ellipsoid(x, y);
    let [s, t, _] = Frame::<f64>::from_normal(n).axes();
    let local = |v: DVec3| DVec2::new(v.dot(s), v.dot(t));
    let difference = |dx: f64, dy: f64| {
        let ((p, m), (q, k)) = (ellipsoid(x + h * dx, y + h * dy), ellipsoid(x - h * dx, y - h * dy));
        ((p - q) / (2.0 * h), (m - k) / (2.0 * h))
    };
    // The shape operator from steps along the axes of the map.
    let ((p0, n0), (p1, n1)) = (difference(1.0, 0.0), difference(0.0, 1.0));
    let shape = DMat2::from_cols(local(n0), local(n1)) * DMat2::from_cols(local(p0), local(p1)).inverse();
    // Pixels, askew.
    let ((pu, nu), (pv, nv)) = (difference(0.3, 0.1), difference(-0.2, 0.4));
    let footprint = Footprint::<f64>::new(local(pu), local(pv)).transformed(shape);
    let [du, dv] = footprint.steps();
    assert!((du - local(nu)).length() < 1e-7 && (dv - local(nv)).length() < 1e-7);
    for bound in [Bound::Upper, Bound::Mean] {
        let kernel = Kernel::<f64>::tokuyoshi2021();
        let a = isotropic(0.1, footprint, &kernel, bound);
        assert!((a - isotropic_from_normals(0.1, nu, nv, &kernel, bound)).abs() < 1e-8);
    }
}

#[test]
fn quads() {
    // Two columns of normals an angle θ apart: the steps of the average are |n − n'| = 2 sin(θ/2)
    // on the disc.
    for theta in [1e-4_f64, 0.3, 1.4] {
        let right = DVec3::new(theta.sin(), 0.0, theta.cos());
        let [a, b] = [DVec3::Z, right].map(|n| Frame::<f64>::from_normal_and_tangent(n, DVec3::X));
        let [du, dv] = quad_projected(&[a, b, a, b]).steps();
        assert!((du.length() - right.distance(DVec3::Z)).abs() < 1e-15 && dv.length() < 1e-15, "{du}");
        let [du, dv] = quad_in_slopes(&[a, b, a, b]).steps();
        assert!((du.length() - 2.0 * (0.5 * theta).tan()).abs() < 1e-14 && dv.length() < 1e-14, "{du}");
        // Rows instead of columns.
        let [du, dv] = quad_projected(&[a, a, b, b]).steps();
        assert!((dv.length() - right.distance(DVec3::Z)).abs() < 1e-15 && du.length() < 1e-15, "{dv}");
    }
    // On a curved surface, the derivatives of the normals.
    let h = 1e-3;
    let at = |i: f64, j: f64| ellipsoid(0.8 + h * i, -0.5 + h * j).1;
    let normals = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
    let frames = normals.map(|n| Frame::<f64>::from_normal_and_tangent(n, DVec3::X));
    let (nu, nv) = (normals[1] - normals[0], normals[2] - normals[0]);
    let (u, v) = (frames[0].to_local(nu).truncate(), frames[0].to_local(nv).truncate());
    // The frame turns where the normal steps: the average seems to move the other way, and slopes
    // once more.
    for (sign, footprint) in [(-1.0, quad_projected(&frames)), (1.0, quad_in_slopes(&frames))] {
        let [du, dv] = footprint.steps().map(|step| sign * step);
        assert!((du - u).length() < 2e-3 * u.length() && (dv - v).length() < 2e-3 * v.length(), "{du} {u}");
    }
    // No average at all.
    let opposite = [DVec3::X, -DVec3::X].map(Frame::<f64>::from_normal);
    let none = quad_in_slopes(&[opposite[0], opposite[1], opposite[1], opposite[0]]);
    assert!(!none.is_finite());
    assert!((rectangle_maximum(0.1, none, &Kernel::tokuyoshi2019()) - 0.19_f64.sqrt()).abs() < 1e-15);
}

/// Never below α, never NaN; what is not finite is the largest kernel.
#[test]
fn bad_derivatives_give_the_largest_kernel() {
    let kernel = Kernel::<f32>::tokuyoshi2019();
    let largest = 0.19_f32.sqrt();
    let near = |alpha: f32| (alpha - largest).abs() < 1e-6;
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
        for i in 0..4 {
            let mut steps = [[0.0_f32; 2]; 2];
            steps[i / 2][i % 2] = bad;
            let footprint = Footprint::<f32>::new(steps[0], steps[1]);
            assert!(near(max_eigenvalue(0.1, footprint, &kernel)), "{steps:?}");
            assert!(near(rectangle_maximum(0.1, footprint, &kernel)));
            let [x, y] = rectangle([0.1, 0.1], footprint, &kernel);
            // A finite footprint is known across too.
            assert!(if bad == f32::MAX { near(x.max(y)) && x.min(y) == 0.1 } else { near(x) && near(y) });
            for bound in [Bound::Upper, Bound::Mean] {
                assert!(near(isotropic(0.1, footprint, &kernel, bound)));
                let normal = Vec3::new(0.0, bad, 0.0);
                assert!(near(isotropic_from_normals(0.1, Vec3::ZERO, normal, &kernel, bound)));
                assert!(near(isotropic_from_normals(0.1, normal, Vec3::ZERO, &kernel, bound)));
            }
        }
    }
    let none = Footprint::<f32>::new(Vec2::ZERO, Vec2::ZERO);
    let tiny = Footprint::<f32>::new(Vec2::new(1e-30, 1e-9), Vec2::new(1e-38, 0.0));
    for alpha in [4.7e-10_f32, 1e-6, 0.123, 0.71, 1.0, 2e9] {
        assert_eq!(max_eigenvalue(alpha, none, &kernel), alpha);
        assert_eq!(rectangle([alpha, alpha], none, &kernel), [alpha, alpha]);
        assert_eq!(isotropic(alpha, none, &kernel, Bound::Upper), alpha);
        assert!(max_eigenvalue(alpha, tiny, &kernel) >= alpha);
        assert!(isotropic(alpha, tiny, &kernel, Bound::Mean) >= alpha);
    }
    assert!(isotropic(f32::NAN, none, &kernel, Bound::Mean).is_nan());
    for (variance, limit, wrong) in
        [(-0.1, 0.1, "variance"), (f64::NAN, 0.1, "variance"), (0.1, f64::INFINITY, "limit")]
    {
        assert!(matches!(Kernel::new(variance, limit), Err(Error::Parameter { name, .. }) if name == wrong));
    }
}
