//! The filter in projected space against 50-digit values of the paper's three steps, and its
//! limits.

use microsurface::filter::deferred::{Kernel, rectangle};
use microsurface::filter::{Covariance, Footprint, projected};
use microsurface::glam::{DMat2, DVec2, DVec3, Vec2};
use microsurface::{Beckmann, Error, Ggx, Linear, Microsurface, Ndf};
use rand_pcg::Pcg64Mcg;

use super::matrix;
use crate::accuracy::{number, rows};
use crate::random::uniform;
use crate::scalar::Scalar;

const TABLE: &str = include_str!("../../reference/filter_projected.tsv");

/// The worst errors of entries and of determinants over the table, in ε.
fn errors<T: Scalar>() -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for row in rows(TABLE) {
        let n: Vec<f64> = row.iter().map(|column| number(column)).collect();
        let t = |i: usize| T::lit(n[i]);
        let map = Linear::from_inverse([[t(0), t(1)], [T::ZERO, t(2)]]).unwrap();
        let footprint = Footprint::new([t(3), t(4)], [t(5), t(6)]);
        let filtered = projected::filtered(&Microsurface::new(Ggx, map), footprint, t(7)).unwrap();
        let ([xx, xy, yy], determinant) = matrix(filtered.map());
        let entries = [(xx - n[8]) / n[8], (xy - n[9]) / (n[8] * n[10]).sqrt(), (yy - n[10]) / n[10]];
        let epsilon = T::EPSILON.to_f64();
        for error in entries {
            worst[0] = worst[0].max(error.abs() / epsilon);
        }
        let error = (determinant / n[11] - 1.0).abs() / epsilon;
        assert!(error.is_finite() && error < 100.0, "{error} {row:?} {determinant:e}");
        worst[1] = worst[1].max(error);
    }
    worst
}

#[test]
fn the_three_steps_at_fifty_digits() {
    let ([e32, d32], [e64, d64]) = (errors::<f32>(), errors::<f64>());
    let figures =
        [("f32 A", e32, 1.5), ("f32 det A", d32, 2.0), ("f64 A", e64, 5.0), ("f64 det A", d64, 9.0)];
    // Within the bound, and the bound not twice what is reached.
    let within = |(_, worst, bound): &(&str, f64, f64)| *worst <= *bound && *worst > 0.5 * bound;
    assert!(figures.iter().all(within), "error and bound in ε: {figures:?}");
}

/// The worst error of α' over the rows along the axes, in ε.
fn error_along_axes<T: Scalar>() -> f64 {
    let mut worst = [0.0_f64; 2];
    for row in rows(TABLE) {
        let n: Vec<f64> = row.iter().map(|column| number(column)).collect();
        if n[1] != 0.0 || n[4] != 0.0 || n[5] != 0.0 {
            continue;
        }
        let t = |i: usize| T::lit(n[i]);
        let footprint = Footprint::new([t(3), t(4)], [t(5), t(6)]);
        let surface = Ggx::anisotropic(t(0), t(2)).unwrap();
        let unlimited = Kernel::new(t(7), T::lit(1e6)).unwrap();
        let filtered = projected::filtered_by_bounds(&surface, footprint, &unlimited).unwrap();
        let [x, y] = filtered.map().alphas().map(T::to_f64);
        for (alpha, square) in [(x, n[8]), (y, n[10])] {
            worst[0] = worst[0].max((alpha / square.sqrt() - 1.0).abs() / T::EPSILON.to_f64());
            worst[1] += 1.0;
        }
    }
    assert!(worst[1] > 80.0, "{} rows", worst[1]);
    worst[0]
}

#[test]
fn along_the_axes_at_fifty_digits() {
    // The root of the table's value is rounded too.
    let (narrow, wide) = (error_along_axes::<f32>(), error_along_axes::<f64>());
    assert!(narrow <= 0.51 && narrow > 0.25, "{narrow} ε");
    assert!(wide <= 1.5 && wide > 0.75, "{wide} ε");
}

fn determinant(m: DMat2) -> f64 {
    m.determinant()
}

/// Σ of a footprint as a full matrix.
fn sigma(footprint: Footprint<f64>, variance: f64) -> DMat2 {
    let [u, v] = footprint.steps();
    variance * (DMat2::from_cols(u * u.x, u * u.y) + DMat2::from_cols(v * v.x, v * v.y))
}

fn footprint(random: &mut Pcg64Mcg, size: f64) -> Footprint<f64> {
    let mut step = || DVec2::new(uniform(random, -size, size), uniform(random, -size, size));
    let (du, dv) = (step(), step());
    Footprint::new(du, dv)
}

/// How far the entries of a surface's A are from a matrix.
fn distance<M: microsurface::map::Map>(surface: &Microsurface<Ggx, M>, m: DMat2) -> f64 {
    let ([xx, xy, yy], _) = matrix(surface.map());
    (xx - m.x_axis.x).abs().max((xy - m.x_axis.y).abs()).max((yy - m.y_axis.y).abs())
}

/// Listing 1 and the form of the author's repository, as shaders have them, in f64 where they lose
/// little. With the two diagonal entries of the kernel exchanged in the determinant, which goes
/// unnoticed for αx = αy, they differ.
#[test]
fn shaders_agree_where_they_are_right() {
    let mut random = Pcg64Mcg::new(1);
    for _ in 0..1000 {
        let (ax, ay) = (uniform(&mut random, 0.05, 0.3), uniform(&mut random, 0.4, 0.9));
        let footprint = footprint(&mut random, 0.5);
        let surface = Ggx::anisotropic(ax, ay).unwrap();
        let filtered = projected::filtered(&surface, footprint, 0.25).unwrap();
        let kernel = 2.0 * sigma(footprint, 0.25);
        let p = DVec2::new(ax * ax / (1.0 - ax * ax), ay * ay / (1.0 - ay * ay));
        let ap = DMat2::from_diagonal(p) + kernel;
        // M = A_p'/d + I, A' = M/det M.
        let m = ap * (1.0 / determinant(ap)) + DMat2::IDENTITY;
        assert!(distance(&filtered, m * (1.0 / determinant(m))) < 1e-11);
        let back = |det: f64| (ap + det * DMat2::IDENTITY) * (1.0 / (1.0 + ap.x_axis.x + ap.y_axis.y + det));
        let det = |a: f64, b: f64| p.x * p.y + p.x * a + p.y * b + determinant(kernel);
        let (mxx, myy) = (kernel.x_axis.x, kernel.y_axis.y);
        assert!(distance(&filtered, back(det(myy, mxx))) < 1e-12);
        let swapped = back(det(mxx, myy));
        let error = (p.x - p.y) * (mxx - myy);
        assert!(distance(&filtered, swapped) > 1e-3 * error.abs(), "{error}");
    }
}

/// On the disc of m.xy, D of a filtered surface is the D of A_p + 2Σ: D(m)/D(0) = (1 + m.xyᵀ(A_p +
/// 2Σ)⁻¹m.xy)⁻².
#[test]
fn on_the_disc_the_kernel_is_added() {
    let mut random = Pcg64Mcg::new(2);
    for _ in 0..200 {
        let (ax, ay) = (uniform(&mut random, 0.05, 0.95), uniform(&mut random, 0.05, 0.95));
        let footprint = footprint(&mut random, 0.5);
        let kernel = 2.0 * sigma(footprint, 0.25);
        let on_disc = DMat2::from_diagonal(DVec2::new(ax * ax / (1.0 - ax * ax), ay * ay / (1.0 - ay * ay)));
        let surface = Ggx::anisotropic(ax, ay).unwrap();
        let filtered = projected::filtered(&surface, footprint, 0.25).unwrap();
        for _ in 0..20 {
            let (r, phi) = (uniform(&mut random, 0.0, 1.0), uniform(&mut random, 0.0, 6.3));
            let m = DVec3::new(r * phi.cos(), r * phi.sin(), (1.0 - r * r).sqrt());
            let expected = |matrix: DMat2| {
                let q = 1.0 + m.truncate().dot(matrix.inverse() * m.truncate());
                1.0 / (q * q)
            };
            let ratio = |d: f64, d0: f64| d / d0;
            let before = ratio(surface.d(m), surface.d(DVec3::Z));
            let after = ratio(filtered.d(m), filtered.d(DVec3::Z));
            assert!((before / expected(on_disc) - 1.0).abs() < 1e-11);
            assert!((after / expected(on_disc + kernel) - 1.0).abs() < 1e-11, "{after}");
        }
    }
}

/// The smaller eigenvalue of the difference of two matrices.
fn least_gain([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> f64 {
    let (xx, xy, yy) = (d - a, e - b, f - c);
    0.5 * (xx + yy) - (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt()
}

#[test]
fn wider_kernels_make_wider_surfaces() {
    let mut random = Pcg64Mcg::new(3);
    for _ in 0..2000 {
        let surface =
            Ggx::anisotropic(uniform(&mut random, 0.01, 1.5), uniform(&mut random, 0.01, 1.5)).unwrap();
        let turn = DMat2::from_angle(uniform(&mut random, 0.0, 3.0));
        let surface = surface.transformed(turn).unwrap();
        let (a, b) = (footprint(&mut random, 0.7), footprint(&mut random, 0.2));
        let (small, large) = (a.covariance(0.25), a.covariance(0.25) + b.covariance(0.25));
        let of = |s| matrix(projected::filtered_by(&surface, s).unwrap().map());
        let ((before, det0), (first, det1), (second, det2)) = (matrix(surface.map()), of(small), of(large));
        assert!(least_gain(before, first) > -2e-15, "{before:?} {first:?}");
        assert!(least_gain(first, second) > -2e-15, "{first:?} {second:?}");
        assert!(det0 * (1.0 - 1e-14) <= det1 && det1 * (1.0 - 1e-14) <= det2);
        // Not beyond α = 1.
        let largest = |[xx, xy, yy]: [f64; 3]| -least_gain([xx, xy, yy], [0.0; 3]);
        assert!(largest(first) <= largest(before).max(1.0) + 1e-14, "{before:?} {first:?}");
        // The sum of slopes gains more in all; not in every direction, since A' − A is along BCᵀ
        // and not along Cᵀ.
        let slopes = matrix(surface.filtered(small).unwrap().map()).0;
        assert!(first[0] + first[2] <= slopes[0] + slopes[2] + 1e-14);
    }
}

fn nothing_is_added_by_nothing<T: Scalar>() {
    for alpha in [1e-6, 0.03, 0.5, 0.71, 0.999, 1.0, 1.001, 30.0] {
        let zero = Footprint::new([T::ZERO; 2], [T::ZERO; 2]);
        let surface = Ggx::anisotropic(T::lit(alpha), T::lit(0.3)).unwrap();
        let filtered = projected::filtered(&surface, zero, T::lit(0.25)).unwrap();
        let ((before, det0), (after, det1)) = (matrix(surface.map()), matrix(filtered.map()));
        let roundings = 3.0 * T::EPSILON.to_f64();
        assert!(
            (0..3).all(|i| (after[i] - before[i]).abs() <= roundings * before[i]),
            "{before:?} {after:?}"
        );
        assert!((det1 - det0).abs() <= roundings * det0);
        let isotropic = Ggx::isotropic(T::lit(alpha)).unwrap();
        assert_eq!(projected::filtered_isotropic(&isotropic, T::ZERO).unwrap(), isotropic);
        assert_eq!(projected::filtered_axis_aligned(&surface, [T::ZERO; 2]).unwrap(), surface);
        assert_eq!(isotropic.filtered_isotropic(T::ZERO).unwrap(), isotropic);
        assert_eq!(surface.filtered_axis_aligned([T::ZERO; 2]).unwrap(), surface);
    }
}

#[test]
fn without_a_footprint_nothing_changes() {
    nothing_is_added_by_nothing::<f32>();
    nothing_is_added_by_nothing::<f64>();
}

/// From α = 1 on a direction stays as it is, the other is filtered, and nothing jumps.
#[test]
fn above_one() {
    let wide = Footprint::new(DVec2::new(0.3, 0.0), DVec2::new(0.0, 0.3));
    for alpha in [0.75, 0.9, 1.0, 1.0 + 1e-12, 1.5, 100.0] {
        let filtered = projected::filtered(&Ggx::isotropic(alpha).unwrap(), wide, 0.25).unwrap();
        let ([xx, xy, yy], _) = matrix(filtered.map());
        assert!(xx >= alpha * alpha * (1.0 - 1e-15) && (xx - yy).abs() < 1e-14 * xx && xy == 0.0);
        assert!(alpha < 1.0 || (xx - alpha * alpha).abs() < 1e-14 * xx);
    }
    let turn = DMat2::from_angle(0.7);
    let of = |alpha: f64| {
        let turned = Ggx::anisotropic(alpha, 0.2).unwrap().transformed(turn).unwrap();
        let filtered = projected::filtered(&turned, wide, 0.25).unwrap();
        matrix(filtered.transformed(turn.transpose()).unwrap().map()).0
    };
    for alpha in [1.5, 40.0] {
        let [xx, xy, yy] = of(alpha);
        let along = projected::filtered_isotropic(&Ggx::isotropic(0.2).unwrap(), 0.25 * 0.09).unwrap();
        let expected = along.map().alpha() * along.map().alpha();
        assert!((xx / (alpha * alpha) - 1.0).abs() < 1e-12 && xy.abs() < 1e-12 * xx, "{xx} {xy}");
        assert!((yy - expected).abs() < 1e-11, "{yy} {expected}");
    }
    let (below, at, above) = (of(1.0 - 1e-9), of(1.0), of(1.0 + 1e-9));
    assert!((0..3).all(|i| (below[i] - at[i]).abs() < 1e-8 && (above[i] - at[i]).abs() < 1e-8));
}

#[test]
fn types_agree_where_they_coincide() {
    let mut random = Pcg64Mcg::new(4);
    for _ in 0..500 {
        let [ax, ay] = [0, 1].map(|_| 10.0_f64.powf(uniform(&mut random, -4.0, 0.2)));
        let [bx, by] = [0, 1].map(|_| uniform(&mut random, 0.0, 0.8));
        let (isotropic, aligned) = (Ggx::isotropic(ax).unwrap(), Ggx::anisotropic(ax, ay).unwrap());
        let footprint = Footprint::new(DVec2::new(bx, 0.0), DVec2::new(0.0, by));
        let variances = [0.25 * bx * bx, 0.25 * by * by];
        let near =
            |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() <= 1e-14 * (a[i] + b[i]).abs());
        let general = matrix(projected::filtered(&aligned, footprint, 0.25).unwrap().map()).0;
        let typed = projected::filtered_axis_aligned(&aligned, variances).unwrap();
        assert!(near(general, matrix(typed.map()).0), "{ax} {ay} {bx} {by}");
        let unlimited = Kernel::new(0.25, 10.0).unwrap();
        let bounds = projected::filtered_by_bounds(&aligned, footprint, &unlimited).unwrap();
        assert!(near(general, matrix(bounds.map()).0));
        let round = projected::filtered_by(&isotropic, Covariance::isotropic(variances[0])).unwrap();
        let typed = projected::filtered_isotropic(&isotropic, variances[0]).unwrap();
        assert!(near(matrix(round.map()).0, matrix(typed.map()).0));
        // Slopes.
        let slopes = matrix(aligned.filtered(footprint.covariance(0.25)).unwrap().map()).0;
        assert!(near(slopes, matrix(aligned.filtered_axis_aligned(variances).unwrap().map()).0));
        let round = matrix(isotropic.filtered(Covariance::isotropic(variances[0])).unwrap().map()).0;
        assert!(near(round, matrix(isotropic.filtered_isotropic(variances[0]).unwrap().map()).0));
        let kept = projected::filtered_tokuyoshi2017(&aligned, footprint, 0.25).unwrap();
        assert!(near(slopes, matrix(kept.map()).0));
        // The practical Listing 3 adds the same kernel to α² and is never narrower.
        let stored = rectangle([ax, ay], footprint, &unlimited);
        let [x, y] = bounds.map().alphas();
        assert!((stored[0] * stored[0] - slopes[0]).abs() < 1e-14 * slopes[0]);
        assert!(stored[0] >= x * (1.0 - 1e-15) && stored[1] >= y * (1.0 - 1e-15));
    }
}

#[test]
fn bounds_are_limited() {
    let kernel = Kernel::<f64>::tokuyoshi2021();
    let surface = Ggx::anisotropic(0.1, 0.2).unwrap();
    let limited = |alpha: f64| projected::filtered_isotropic(&Ggx::isotropic(alpha).unwrap(), 0.09).unwrap();
    for far in [1e9, f64::MAX, f64::INFINITY, f64::NAN] {
        let footprint = Footprint::new(DVec2::new(far, far), DVec2::new(-far, far));
        let [x, y] = projected::filtered_by_bounds(&surface, footprint, &kernel).unwrap().map().alphas();
        assert!(
            (x - limited(0.1).map().alpha()).abs() < 1e-15 && (y - limited(0.2).map().alpha()).abs() < 1e-15
        );
    }
}

/// A smooth mirror under a long thin footprint, in f32: the determinant by entries has no digit
/// left.
#[test]
fn thin_kernels_keep_their_digits() {
    let (du, dv) = (Vec2::new(0.3, 0.4), Vec2::new(-0.8e-5, 0.6e-5));
    let surface = Ggx::isotropic(1e-5_f32).unwrap();
    let filtered = projected::filtered(&surface, Footprint::<f32>::new(du, dv), 0.25).unwrap();
    let wide = Ggx::isotropic(f64::from(1e-5_f32)).unwrap();
    let footprint = Footprint::new(du.as_dvec2(), dv.as_dvec2());
    let exact = matrix(projected::filtered(&wide, footprint, 0.25).unwrap().map()).1;
    let det = matrix(filtered.map()).1;
    assert!((det / exact - 1.0).abs() < 3.0 * f64::from(f32::EPSILON), "{det:e} {exact:e}");
    let [xx, xy, yy] = filtered
        .roughness_matrix()
        .map_or_else(|_| matrix(filtered.map()).0.map(|x| x as f32), |a| a.entries());
    assert!((f64::from(xx * yy - xy * xy) / exact - 1.0).abs() > 0.5, "by entries it would do as well");
}

#[test]
fn limits() {
    // α → 0: what is left is the kernel, s/(1 + s).
    let footprint = Footprint::<f32>::new(Vec2::new(2.0, 0.0), Vec2::new(0.0, 2.0));
    for alpha in [4.7e-10_f32, 1e-6, 1e-3] {
        let ([xx, _, yy], _) =
            matrix(projected::filtered(&Ggx::isotropic(alpha).unwrap(), footprint, 0.25).unwrap().map());
        assert!((xx - 2.0 / 3.0).abs() < 1e-6 && (yy - 2.0 / 3.0).abs() < 1e-6, "{xx} {yy}");
    }
    // Footprints without bound: α → 1.
    for size in [1e6_f32, 1e15, 1e30] {
        let footprint = Footprint::<f32>::new(Vec2::new(size, 0.3 * size), Vec2::new(-size, size));
        let surface = Ggx::anisotropic(0.01_f32, 0.8).unwrap();
        let ([xx, xy, yy], det) = matrix(projected::filtered(&surface, footprint, 0.25).unwrap().map());
        assert!((xx - 1.0).abs() < 1e-6 && xy.abs() < 1e-6 && (yy - 1.0).abs() < 1e-6, "{xx} {xy} {yy}");
        assert!((det - 1.0).abs() < 1e-6, "{det}");
    }
}

#[test]
fn bad_input_is_refused() {
    fn refused<S: core::fmt::Debug>(result: &Result<S, Error>) -> bool {
        matches!(result, Err(Error::Covariance { .. }))
    }
    let surface = Ggx::anisotropic(0.1_f64, 0.2).unwrap();
    let isotropic = Ggx::isotropic(0.1_f64).unwrap();
    let fine = DVec2::new(0.1, 0.0);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for i in 0..4 {
            let mut steps = [[0.1, 0.2], [0.0, -0.1]];
            steps[i / 2][i % 2] = bad;
            let footprint = Footprint::new(steps[0], steps[1]);
            assert!(refused(&projected::filtered(&surface, footprint, 0.25)), "{steps:?}");
            assert!(refused(&projected::filtered_tokuyoshi2017(&surface, footprint, 0.25)));
        }
    }
    for bad in [f64::NAN, f64::INFINITY, -0.1] {
        assert!(refused(&projected::filtered(&surface, Footprint::new(fine, fine), bad)));
        assert!(refused(&projected::filtered_isotropic(&isotropic, bad)));
        assert!(refused(&projected::filtered_axis_aligned(&surface, [0.0, bad])));
        assert!(refused(&isotropic.filtered_isotropic(bad)));
        assert!(refused(&surface.filtered_axis_aligned([bad, 0.0])));
    }
    let beckmann = Beckmann::isotropic(1.0_f32).unwrap();
    assert!(matches!(beckmann.filtered_isotropic(1e30), Err(Error::Alpha { .. })));
}

/// Footprints out to the largest that a covariance can be of: any direction, thin ones too.
fn no_footprint_is_beyond_the_rim<T: Scalar>(largest_exponent: f64) {
    let mut random = Pcg64Mcg::new(9);
    let rounding = 4.0 * T::EPSILON.to_f64();
    for _ in 0..20_000 {
        let alphas = [(); 2].map(|()| T::lit(10.0_f64.powf(uniform(&mut random, -4.0, 0.0))));
        let turn = DMat2::from_angle(uniform(&mut random, 0.0, 3.2));
        let turn = T::matrix([turn.x_axis, turn.y_axis].map(|column| column.to_array().map(T::lit)));
        let surface = Ggx::anisotropic(alphas[0], alphas[1]).unwrap().transformed(turn).unwrap();
        let mut step = || -> T::Vec2 {
            let length = 10.0_f64.powf(uniform(&mut random, -5.0, largest_exponent));
            let angle = uniform(&mut random, 0.0, 6.3);
            [length * angle.cos(), length * angle.sin()].map(T::lit).into()
        };
        let footprint = Footprint::<T>::new(step(), step());
        let filtered = projected::filtered(&surface, footprint, T::lit(0.25)).unwrap();
        let [alpha_max, alpha_min, _] = filtered.roughness_matrix().unwrap().principal().map(T::to_f64);
        assert!(alpha_max <= 1.0 + rounding, "{alpha_max} by {footprint:?}");
        let least = alphas[0].to_f64().min(alphas[1].to_f64());
        assert!(alpha_min >= least * (1.0 - rounding), "{alpha_min} of {alphas:?} by {footprint:?}");
    }
}

#[test]
fn the_largest_footprints_leave_alpha_at_most_one() {
    no_footprint_is_beyond_the_rim::<f32>(18.0);
    no_footprint_is_beyond_the_rim::<f64>(70.0);
}
