//! Transforms of the microsurface: of black boxes, of meshes, and their Jacobians.

use microsurface::glam::{DMat2, DMat3, DQuat, DVec2, DVec3};
use microsurface::transform::tension::{Mean, Mesh, Triangle, interpolated};
use microsurface::transform::{Transformed, jacobian_of_normals, jacobian_of_uv_map};
use microsurface::{Beckmann, Error, Ggx, Gtr, Ndf, SampleNdf, SampleVndf};
use rand_pcg::Pcg64Mcg;

use crate::random::uniform;

/// Entries within ±10, the ratio of singular values at most `condition`.
fn matrix(random: &mut Pcg64Mcg, condition: f64) -> DMat2 {
    loop {
        let m = DMat2::from_cols_array(&core::array::from_fn(|_| uniform(random, -10.0, 10.0)));
        let size = 0.5 * m.to_cols_array().iter().map(|c| c * c).sum::<f64>();
        if size / m.determinant().abs() <= 0.5 * condition {
            return m;
        }
    }
}

fn direction(random: &mut Pcg64Mcg, lowest: f64) -> DVec3 {
    let (z, phi) = (uniform(random, lowest, 1.0), uniform(random, 0.0, core::f64::consts::TAU));
    let s = (1.0 - z * z).sqrt();
    DVec3::new(s * phi.cos(), s * phi.sin(), z)
}

fn near(a: f64, b: f64, roundings: f64) -> bool {
    (a - b).abs() <= roundings * f64::EPSILON * a.abs().max(b.abs())
}

/// A black box is moved as a profile under a map is.
fn agrees<N: SampleVndf<Scalar = f64> + SampleNdf, R: SampleVndf<Scalar = f64> + SampleNdf>(
    black_box: &N,
    surface: &R,
    random: &mut Pcg64Mcg,
    roundings: f64,
) {
    for _ in 0..20 {
        let (w, m) = (direction(random, -1.0), direction(random, 1e-3));
        let u = DVec2::new(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
        let slope = DVec2::new(-m.x / m.z, -m.y / m.z);
        let h = 1.7 * m;
        for (name, a, b) in [
            ("d", black_box.d(m), surface.d(m)),
            ("d_along", black_box.d_along(h), surface.d_along(h)),
            ("p22", black_box.p22(slope), surface.p22(slope)),
            ("sigma", black_box.sigma(w), surface.sigma(w)),
            ("lambda", black_box.lambda(w), surface.lambda(w)),
            ("vndf", black_box.vndf(w, m), surface.vndf(w, m)),
            ("g1", black_box.g1(w, m), surface.g1(w, m)),
        ] {
            assert!(near(a, b, roundings), "{name} {a:e} {b:e} at {w} {m}");
        }
        assert_eq!(black_box.d(-m), 0.0);
        let normal = black_box.sample_vndf(w, u);
        assert!(normal.dot(w) > 0.0 && normal.z >= 0.0 && (normal.length() - 1.0).abs() < 1e-14);
        let all = black_box.sample_d(u);
        assert!(all.z >= 0.0 && (all.length() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn black_boxes_are_moved_as_profiles_are() {
    let mut random = Pcg64Mcg::new(1);
    for _ in 0..300 {
        let m = matrix(&mut random, 100.0);
        // Of the pulled vectors, multiplied by the ratio of the singular values; 64 are reached.
        let roundings = 127.0;
        let ggx = Ggx::anisotropic(0.3, 0.7).unwrap();
        agrees(&Transformed::new(ggx, m).unwrap(), &ggx.transformed(m).unwrap(), &mut random, roundings);
        let gtr = Gtr::isotropic(0.2, 1.4).unwrap();
        agrees(&Transformed::new(gtr, m).unwrap(), &gtr.transformed(m).unwrap(), &mut random, roundings);
        let light = Gtr::closed::<3>(0.4).unwrap();
        agrees(&Transformed::new(light, m).unwrap(), &light.transformed(m).unwrap(), &mut random, roundings);
    }
}

/// `transformed(a)` then `transformed(b)` is `transformed(b * a)`, and not `a * b`.
#[test]
fn transforms_compose_in_their_order() {
    let mut random = Pcg64Mcg::new(2);
    for _ in 0..2000 {
        let (a, b) = (matrix(&mut random, 30.0), matrix(&mut random, 30.0));
        let beckmann = Beckmann::anisotropic(0.4_f64, 0.9).unwrap();
        let twice = beckmann.transformed(a).unwrap().transformed(b).unwrap();
        let once = beckmann.transformed(b * a).unwrap();
        let [p, q] = [twice, once].map(|surface| surface.roughness_matrix().unwrap().entries());
        let size = q[0].abs().max(q[2].abs());
        assert!((0..3).all(|i| (p[i] - q[i]).abs() < 1e-11 * size), "{p:?} {q:?}");
        let boxed = Transformed::new(beckmann, a).unwrap().transformed(b).unwrap();
        assert!((boxed.matrix() - b * a).abs_diff_eq(DMat2::ZERO, 1e-12));
        let wrong = beckmann.transformed(a * b).unwrap().roughness_matrix().unwrap().entries();
        assert!((0..3).any(|i| (p[i] - wrong[i]).abs() > 1e-6 * size), "{p:?} {wrong:?}");
        // And back to where it was.
        let [xx, xy, yy] =
            twice.transformed((b * a).inverse()).unwrap().roughness_matrix().unwrap().entries();
        assert!((xx - 0.16).abs() < 1e-9 && xy.abs() < 1e-9 && (yy - 0.81).abs() < 1e-9, "{xx} {xy} {yy}");
    }
}

/// Eqs. 17–20 as the paper prints them, with M = [[a, c], [b, d]]; the columns of the Jacobian.
fn printed(m: DMat2, n: DVec3) -> [f64; 4] {
    let [a, b, c, d] = m.to_cols_array();
    let (x, y) = (n.x, n.y);
    let length = DVec3::new(a * x + b * y, c * x + d * y, n.z).length();
    let cube = length * length * length;
    [
        (y * y * (a * d * d - b * c * d - a) + x * y * (a * c * d + b - b * c * c) + a) / cube,
        (y * y * (c * b * b - a * b * d - c) + x * y * (a * b * c + d - d * a * a) + c) / cube,
        (x * x * (b * c * c - a * c * d - b) + x * y * (b * c * d + a - a * d * d) + b) / cube,
        (x * x * (d * a * a - a * b * c - d) + x * y * (a * b * d + c - c * b * b) + d) / cube,
    ]
}

#[test]
fn jacobians_of_normals_are_those_of_the_paper_and_of_differences() {
    let mut random = Pcg64Mcg::new(3);
    for _ in 0..2000 {
        let (m, n) = (matrix(&mut random, 100.0), direction(&mut random, 0.1));
        let jacobian = jacobian_of_normals::<f64>(m, n);
        let moved = |x: f64, y: f64| {
            let u = m.transpose() * DVec2::new(x, y);
            let v = DVec3::new(u.x, u.y, (1.0 - x * x - y * y).sqrt()).normalize();
            DVec2::new(v.x, v.y)
        };
        let h = 1e-5 * n.z * n.z;
        let difference = DMat2::from_cols(
            (moved(n.x + h, n.y) - moved(n.x - h, n.y)) / (2.0 * h),
            (moved(n.x, n.y + h) - moved(n.x, n.y - h)) / (2.0 * h),
        );
        let size = jacobian.to_cols_array().iter().fold(0.0_f64, |s, c| s.max(c.abs()));
        let paper = printed(m, n);
        for (i, ((j, d), p)) in
            jacobian.to_cols_array().into_iter().zip(difference.to_cols_array()).zip(paper).enumerate()
        {
            assert!((j - d).abs() < 1e-6 * size + 1e-8, "{i}: {j} {d}");
            assert!((j - p).abs() < 1e-11 * size, "{i}: {j} {p}");
        }
        let length = DVec3::new(
            (m.transpose() * DVec2::new(n.x, n.y)).x,
            (m.transpose() * DVec2::new(n.x, n.y)).y,
            n.z,
        )
        .length();
        let exact = m.determinant() / length.powi(4);
        assert!(
            (jacobian.determinant() - exact).abs() < 1e-10 * size * size,
            "{} {exact}",
            jacobian.determinant()
        );
    }
}

#[test]
fn anisotropy_is_a_transform_of_shape_invariant_profiles_only() {
    let (from, x, y) = (0.3, 0.12, 0.6);
    let m = DMat2::from_diagonal(DVec2::new(from / x, from / y));
    let mut random = Pcg64Mcg::new(4);
    let mut shape_variant = 0.0_f64;
    for _ in 0..500 {
        let n = direction(&mut random, 0.05);
        let moved = Ggx::isotropic(from).unwrap().transformed(m).unwrap().d(n);
        assert!(near(moved, Ggx::anisotropic(x, y).unwrap().d(n), 100.0));
        let moved = Beckmann::isotropic(from).unwrap().transformed(m).unwrap().d(n);
        let classical = Beckmann::anisotropic(x, y).unwrap().d(n);
        assert!((moved / classical - 1.0).abs() < 1e-10 || classical < 1e-60);
        // GTR of width x, seen along x, is not the GTR of width 0.3 moved by 0.3/x: the tails
        // differ.
        let along = DVec3::new(n.x.hypot(n.y), 0.0, n.z);
        let squeezed = DMat2::from_diagonal(DVec2::splat(from / x));
        let gtr = Gtr::isotropic(from, 1.4).unwrap().transformed(squeezed).unwrap().d(along);
        shape_variant = shape_variant.max((gtr / Gtr::isotropic(x, 1.4).unwrap().d(along) - 1.0).abs());
    }
    assert!(shape_variant > 0.2, "{shape_variant}");
}

/// A triangle of the plane z = 0 whose tangent u is x, moved by M in the plane and then rigidly.
fn moved_triangle(random: &mut Pcg64Mcg, m: DMat2) -> Triangle<f64> {
    let corners: [DVec2; 3] =
        core::array::from_fn(|_| DVec2::new(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)));
    let axis = direction(random, -1.0);
    let rotation = DMat3::from_quat(DQuat::from_axis_angle(axis, uniform(random, 0.0, 6.0)));
    let shift = DVec3::new(3.0, -1.0, 0.5);
    let scale = uniform(random, 0.1, 10.0);
    Triangle {
        rest: corners.map(|p| p.extend(0.0)),
        deformed: corners.map(|p| rotation * (m * p).extend(0.0) + shift),
        uv: corners.map(|p| scale * p + DVec2::new(0.3, 0.4)),
    }
}

#[test]
fn tension_is_the_deformation_in_the_frame_of_u() {
    let mut random = Pcg64Mcg::new(5);
    let mut seen = 0;
    while seen < 1000 {
        let m = matrix(&mut random, 50.0);
        let triangle = moved_triangle(&mut random, m);
        let [p, q, r] = triangle.rest;
        let facing = (q - p).cross(r - p);
        if m.determinant() < 0.0 || facing.z < 1e-2 {
            continue;
        }
        seen += 1;
        let tension = triangle.tension().unwrap();
        // M up to the rotation that takes the image of the u axis back to x: what is left is upper
        // triangular.
        let rotated = m * DVec2::X;
        let back = DMat2::from_angle(-rotated.y.atan2(rotated.x)) * m;
        assert!((tension - back).to_cols_array().iter().all(|c| c.abs() < 1.5e-12), "{tension} {back}");
        assert!((tension.determinant() - m.determinant()).abs() < 1e-9);
        // Its frame is that of the deformed triangle.
        let [x, y, z] = triangle.frame().unwrap().axes();
        let [p, q, r] = triangle.deformed;
        assert!(z.dot(q - p).abs() < 1e-9 && z.dot(r - p).abs() < 1e-9 && z.dot((q - p).cross(r - p)) > 0.0);
        assert!(x.dot(y).abs() < 1e-12 && (x.cross(y) - z).length() < 1e-12);
    }
}

/// Texture coordinates that run the other way round turn the tangent, not the normal.
#[test]
fn a_mirrored_texture_has_a_frame_along_its_u() {
    let corners = [DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0), DVec3::new(0.5, 1.0, 0.0)];
    for (u, v) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
        // u grows by ±1 along x and is constant along y.
        let uv = corners.map(|p| DVec2::new(u * p.x, v * p.y));
        let triangle = Triangle::<f64> { rest: corners, deformed: corners, uv };
        let [x, y, z] = triangle.frame().unwrap().axes();
        assert!((x - u * DVec3::X).length() < 1e-15 && (y - u * DVec3::Y).length() < 1e-15, "{x} {y}");
        assert!((z - DVec3::Z).length() < 1e-15, "{z}");
    }
}

#[test]
fn tension_of_what_stays_is_the_identity_and_of_a_balloon_its_scale() {
    let mut random = Pcg64Mcg::new(6);
    for scale in [1.0, 1.5, 0.25] {
        let triangle = moved_triangle(&mut random, DMat2::from_diagonal(DVec2::splat(scale)));
        let tension = triangle.tension().unwrap();
        assert!(
            (tension - DMat2::from_diagonal(DVec2::splat(scale))).abs_diff_eq(DMat2::ZERO, 1e-9),
            "{tension}"
        );
        // Inflated, a surface is smoother: α is divided by the scale.
        let inflated = Ggx::isotropic(0.3_f64).unwrap().transformed(tension).unwrap();
        let [largest, smallest, _] = inflated.roughness_matrix().unwrap().principal();
        assert!((largest - 0.3 / scale).abs() < 1e-8 && (smallest - 0.3 / scale).abs() < 1e-8);
    }
}

#[test]
fn triangles_without_area_have_no_tension() {
    let (rest, uv) = ([DVec3::ZERO, DVec3::X, DVec3::Y], [DVec2::ZERO, DVec2::X, DVec2::Y]);
    let flat = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X];
    let nan = [DVec3::ZERO, DVec3::X, DVec3::NAN];
    let no_uv = [DVec2::ONE; 3];
    for triangle in [
        Triangle::<f64> { rest: flat, deformed: rest, uv },
        Triangle { rest, deformed: flat, uv },
        Triangle { rest, deformed: rest, uv: no_uv },
        Triangle { rest: nan, deformed: rest, uv },
        Triangle { rest, deformed: nan, uv },
        Triangle { rest: [DVec3::ZERO; 3], deformed: rest, uv },
    ] {
        let error = triangle.tension().unwrap_err();
        assert!(matches!(error, Error::Map { .. }) && error.to_string().contains("determinant"), "{error}");
    }
    assert!(Triangle::<f64> { rest, deformed: flat, uv }.frame().is_err());
    // Crushed beyond what a surface can be.
    let crushed = [DVec3::ZERO, DVec3::X, 1e-120 * DVec3::Y];
    assert!(Triangle::<f64> { rest, deformed: crushed, uv }.tension().is_err());
}

#[test]
fn vertices_have_the_mean_of_their_triangles() {
    // A strip: the left square is stretched along x, the right one stays, and one triangle has no
    // area.
    let rest: Vec<DVec3> = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)]
        .map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0))
        .to_vec();
    let deformed: Vec<DVec3> =
        rest.iter().map(|p| DVec3::new(if p.x > 0.5 { p.x + 1.0 } else { p.x }, p.y, 0.0)).collect();
    let uv: Vec<DVec2> = rest.iter().map(|p| p.truncate()).collect();
    let triangles = [[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4], [0, 0, 3]];
    let mesh = Mesh { rest: &rest, deformed: &deformed, uv: &uv, triangles: &triangles };
    let mut means = vec![Mean::<f64>::default(); 7];
    assert_eq!(mesh.add_tension_of_vertices(&mut means).unwrap(), 1);
    let along: Vec<f64> = means.iter().map(|mean| mean.matrix().x_axis.x).collect();
    assert!(
        (along[0] - 2.0).abs() < 1e-12 && (along[2] - 1.0).abs() < 1e-12 && (along[3] - 2.0).abs() < 1e-12
    );
    // Vertex 1 has two stretched triangles and one at rest; nothing belongs to the last.
    assert!((along[1] - 5.0 / 3.0).abs() < 1e-12, "{along:?}");
    assert_eq!(means[6].matrix(), DMat2::IDENTITY);
    let middle =
        interpolated::<f64>([means[0], means[1], means[3]].map(|mean| mean.matrix()), [0.2, 0.3, 0.5]);
    assert!((middle.x_axis.x - (0.2 * 2.0 + 0.3 * 5.0 / 3.0 + 0.5 * 2.0)).abs() < 1e-12);
    // A vertex that does not exist is refused before anything is written.
    let wrong = [[0, 1, 3], [0, 1, 6]];
    let mut means = vec![Mean::<f64>::default(); 6];
    let mesh = Mesh { triangles: &wrong, ..mesh };
    assert_eq!(mesh.add_tension_of_vertices(&mut means), Err(Error::Mesh { triangle: 1 }));
    assert!(means.iter().all(|mean| *mean == Mean::default()) && mesh.triangle(1).is_none());
    assert!(mesh.add_tension_of_vertices(&mut [Mean::default(); 2]).is_err());
}

#[test]
fn jacobians_of_uv_maps() {
    let curved = |uv: DVec2| DVec2::new(uv.x, uv.y + 2.0 * uv.x.powi(5));
    for u in [0.0, 0.3, 0.9] {
        let m = jacobian_of_uv_map::<f64>(curved, DVec2::new(u, 0.4), 1e-5);
        let exact = DMat2::from_cols(DVec2::new(1.0, 10.0 * u.powi(4)), DVec2::Y);
        assert!((m - exact).to_cols_array().iter().all(|c| c.abs() < 1e-8), "{m} {exact}");
    }
}

#[test]
fn singular_matrices_are_refused() {
    let ggx = Ggx::isotropic(0.3).unwrap();
    for columns in [
        [0.0; 4],
        [1.0, 2.0, 2.0, 4.0],
        [f64::NAN, 0.0, 0.0, 1.0],
        [f64::INFINITY, 0.0, 0.0, 1.0],
        [1e-200, 0.0, 0.0, 1e200],
    ] {
        let m = DMat2::from_cols_array(&columns);
        for error in [Transformed::new(ggx, m).err(), ggx.transformed(m).err()] {
            assert!(matches!(error, Some(Error::Map { .. })), "{m} {error:?}");
            assert!(error.unwrap().to_string().contains("determinant"));
        }
    }
}
