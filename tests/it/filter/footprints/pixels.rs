//! Pixels seen on surfaces: ray differentials and half vectors against real rays and against quads.

use microsurface::filter::Footprint;
use microsurface::filter::jacobian::{Curvature, HalfVector, InterpolatedNormals, Motion};
use microsurface::filter::quad::Quad;
use microsurface::filter::ray::{FocusPlane, RayDifferential};
use microsurface::frame::Frame;
use microsurface::glam::{DVec2, DVec3};
use rand_pcg::Pcg64Mcg;

use super::{derivative, direction, half, rotation, vector};
use crate::random::uniform;

/// A place on a surface: the point, the geometric normal, the shading frame.
struct Place {
    point: DVec3,
    normal: DVec3,
    frame: Frame<f64>,
}

/// What can be seen.
trait Surface {
    /// Where a ray of this direction, of any length, meets it.
    fn hit(&self, origin: DVec3, direction: DVec3) -> Place;
    /// How the shading frame moves with the point, by the crate.
    fn motion(&self, place: &Place, point: DVec3) -> Motion<f64>;
}

/// Seen from outside; tangents are the parallels about y.
struct Sphere {
    centre: DVec3,
    radius: f64,
}

impl Surface for Sphere {
    fn hit(&self, origin: DVec3, direction: DVec3) -> Place {
        let (o, d) = (origin - self.centre, direction.normalize());
        let half = o.dot(d);
        let t = -half - (half * half - o.length_squared() + self.radius * self.radius).sqrt();
        let normal = (o + t * d) / self.radius;
        let frame = Frame::from_normal_and_tangent(normal, DVec3::Y.cross(normal));
        Place { point: origin + t * d, normal, frame }
    }

    fn motion(&self, Place { frame, normal: n, .. }: &Place, point: DVec3) -> Motion<f64> {
        let normal = Curvature::sphere(self.radius).normal_step(frame, point);
        let still = Motion { point, normal, ..Motion::default() };
        still.with_tangent(frame, DVec3::Y.cross(*n), DVec3::Y.cross(normal))
    }
}

/// A triangle with a normal at each corner; its tangent is its first edge.
struct Mesh(InterpolatedNormals<f64>);

impl Mesh {
    fn barycentric(&self, point: DVec3) -> [f64; 3] {
        let [p, q, r] = self.0.positions;
        let area = (q - p).cross(r - p);
        let part = |a: DVec3, b: DVec3| (a - point).cross(b - point).dot(area) / area.length_squared();
        [part(q, r), part(r, p), part(p, q)]
    }
}

impl Surface for Mesh {
    fn hit(&self, origin: DVec3, direction: DVec3) -> Place {
        let [p, q, r] = self.0.positions;
        let normal = (q - p).cross(r - p);
        let point = origin + direction * ((p - origin).dot(normal) / direction.dot(normal));
        let [u, v, w] = self.barycentric(point);
        let [a, b, c] = self.0.normals;
        let shading = (u * a + v * b + w * c).normalize();
        assert!((shading - self.0.normal([u, v, w])).length() < 1e-14);
        Place { point, normal, frame: Frame::from_normal_and_tangent(shading, q - p) }
    }

    fn motion(&self, place: &Place, point: DVec3) -> Motion<f64> {
        let normal = self.0.normal_step(self.barycentric(place.point), point);
        let [p, q, _] = self.0.positions;
        Motion { point, normal, ..Motion::default() }.with_tangent(&place.frame, q - p, DVec3::ZERO)
    }
}

/// Waves in a normal map, on another surface.
struct Waves<S>(S);

/// The map's normal at a point, and its derivative where the point moves.
fn waves(p: DVec3, step: DVec3) -> [DVec3; 2] {
    let (a, b) = (3.0 * p.x + p.z, 2.0 * p.y - p.x);
    let (da, db) = (3.0 * step.x + step.z, 2.0 * step.y - step.x);
    [
        DVec3::new(0.3 * a.sin(), 0.2 * b.cos(), 0.9 + 0.1 * a.cos()),
        DVec3::new(0.3 * a.cos() * da, -0.2 * b.sin() * db, -0.1 * a.sin() * da),
    ]
}

impl<S: Surface> Surface for Waves<S> {
    fn hit(&self, origin: DVec3, direction: DVec3) -> Place {
        let place = self.0.hit(origin, direction);
        let [m, _] = waves(place.point, DVec3::ZERO);
        let [x, ..] = place.frame.axes();
        let frame = Frame::from_normal_and_tangent(place.frame.to_world(m).normalize(), x);
        Place { frame, ..place }
    }

    fn motion(&self, place: &Place, point: DVec3) -> Motion<f64> {
        let [m, step] = waves(place.point, point);
        // The frame below the map, seen along its own normal.
        let below = self.0.hit(place.point + 0.01 * place.normal, -place.normal);
        self.0.motion(&below, point).perturbed(&below.frame, m, step)
    }
}

/// A camera about a surface at the origin, and a light.
struct Scene {
    surface: Box<dyn Surface>,
    eye: DVec3,
    light: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    focus: FocusPlane<f64>,
}

/// Any of the surfaces, seen and lit from where m.z is above 0.3.
fn scene(random: &mut Pcg64Mcg, kind: usize) -> Scene {
    let mesh = |random: &mut Pcg64Mcg| {
        let normals = core::array::from_fn(|_| direction(random, 0.7));
        let mut corner =
            |x: f64, y: f64| 3.0 * DVec3::new(x, y, 0.0) + vector(random, 0.3) * DVec3::new(1.0, 1.0, 0.3);
        let positions = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)];
        Mesh(InterpolatedNormals { positions, normals })
    };
    let sphere = Sphere { centre: -1.5 * DVec3::Z, radius: 1.5 };
    let flat = Mesh(InterpolatedNormals {
        positions: [DVec3::new(-3.0, -3.0, 0.0), DVec3::new(3.0, -2.0, 0.0), DVec3::new(0.0, 3.0, 0.0)],
        normals: [DVec3::Z; 3],
    });
    loop {
        let surface: Box<dyn Surface> = match kind {
            0 => Box::new(Sphere { ..sphere }),
            1 => Box::new(mesh(random)),
            2 => Box::new(Waves(Mesh(flat.0))),
            _ => Box::new(Waves(Sphere { ..sphere })),
        };
        let eye = uniform(random, 2.0, 6.0) * direction(random, 0.4);
        let light = uniform(random, 2.0, 6.0) * direction(random, 0.3);
        let forward = (vector(random, 0.2) - eye).normalize() * uniform(random, 0.5, 2.0);
        let turn = rotation(random);
        let (right, up) = (turn * DVec3::X * 0.3, turn * DVec3::new(0.3, 0.2, 0.1));
        let axis = (forward + vector(random, 0.1)).normalize();
        let focus = FocusPlane { axis, distance: uniform(random, 1.0, 5.0) };
        let scene = Scene { surface, eye, light, forward, right, up, focus };
        let place = scene.see(DVec2::ZERO, DVec3::ZERO);
        let m = scene.half_vector(&place).wm();
        let facing = place.normal.normalize().dot((eye - place.point).normalize());
        if m.z > 0.5 && facing.abs() > 0.3 && place.point.is_finite() {
            return scene;
        }
    }
}

impl Scene {
    fn direction(&self, pixel: DVec2) -> DVec3 {
        self.forward + pixel.x * self.right + pixel.y * self.up
    }

    /// The place seen in a pixel through a point of the lens.
    fn see(&self, pixel: DVec2, lens: DVec3) -> Place {
        let direction = self.direction(pixel);
        let focus = self.eye + direction * (self.focus.distance / direction.dot(self.focus.axis));
        let from = self.eye + lens;
        let towards = focus - from;
        assert!((self.focus.direction(lens, direction) - towards.normalize()).length() < 1e-14);
        self.surface.hit(from, towards)
    }

    /// Slope and m.xy there.
    fn half_at(&self, pixel: DVec2, lens: DVec3) -> [DVec2; 2] {
        let Place { point, frame, .. } = self.see(pixel, lens);
        half(&frame, (self.light - point).normalize(), (self.eye + lens - point).normalize())
    }

    fn half_vector(&self, place: &Place) -> HalfVector<f64> {
        HalfVector::new(&place.frame, place.point, self.eye, self.light)
    }

    /// The footprints in slopes and on the disk of a pixel of this size, in closed form.
    fn analytic(&self, size: f64) -> [Footprint<f64>; 2] {
        let rays = RayDifferential::pinhole(self.forward, size * self.right, size * self.up);
        let place = self.see(DVec2::ZERO, DVec3::ZERO);
        let distance = (place.point - self.eye).length();
        let steps = rays.onto_plane(self.forward.normalize(), distance, place.normal);
        let [du, dv] = steps.map(|point| self.surface.motion(&place, point));
        let half = self.half_vector(&place);
        [half.slope_footprint(&du, &dv), half.projected_footprint(&du, &dv)]
    }
}

const KINDS: usize = 4;

#[test]
fn footprints_are_those_of_rays() {
    let mut random = Pcg64Mcg::new(1);
    for i in 0..100 * KINDS {
        let scene = scene(&mut random, i % KINDS);
        for (space, analytic) in scene.analytic(1.0).into_iter().enumerate() {
            let [du, dv] = analytic.steps();
            let seen = |axis: DVec2| derivative(|t| scene.half_at(t * axis, DVec3::ZERO)[space]);
            let [u, v] = [DVec2::X, DVec2::Y].map(seen);
            let size = du.length() + dv.length();
            assert!((du - u).length() < 1e-7 * size, "{i}: {du} {u}");
            assert!((dv - v).length() < 1e-7 * size, "{i}: {dv} {v}");
        }
    }
}

#[test]
fn footprints_of_a_lens_are_those_of_rays() {
    let mut random = Pcg64Mcg::new(2);
    let mut seen = 0;
    for i in 0..100 * KINDS {
        let scene = scene(&mut random, i % KINDS);
        let (a, b) = scene.focus.axis.any_orthonormal_pair();
        let lens = 0.1 * (uniform(&mut random, -1.0, 1.0) * a + uniform(&mut random, -1.0, 1.0) * b);
        let place = scene.see(DVec2::ZERO, lens);
        let direction = scene.focus.direction(lens, scene.forward);
        let distance = (place.point - scene.eye - lens).length();
        let half = HalfVector::new(&place.frame, place.point, scene.eye + lens, scene.light);
        // Some rays miss, others graze.
        if !(place.normal.normalize().dot(direction).abs() > 0.3 && half.wm().z > 0.4) {
            continue;
        }
        seen += 1;
        let per_pixel = RayDifferential::thin_lens(scene.focus, lens, scene.forward, scene.right, scene.up);
        let per_lens = RayDifferential::across_lens(scene.focus, lens, a, b, scene.forward);
        for (rays, lens_steps, pixel_steps) in
            [(per_pixel, [DVec3::ZERO; 2], [DVec2::X, DVec2::Y]), (per_lens, [a, b], [DVec2::ZERO; 2])]
        {
            let steps = rays.onto_plane(direction, distance, place.normal);
            // In two stages it is the same.
            let staged = rays.transferred(0.3 * distance).onto_plane(direction, 0.7 * distance, place.normal);
            for k in 0..2 {
                let see = |t: f64| scene.see(t * pixel_steps[k], lens + t * lens_steps[k]).point;
                let exact = derivative(see);
                assert!((steps[k] - exact).length() < 1e-7 * (1.0 + exact.length()), "{} {exact}", steps[k]);
                assert!((steps[k] - staged[k]).length() < 1e-12 * (1.0 + exact.length()));
                let motion = Motion { eye: lens_steps[k], ..scene.surface.motion(&place, steps[k]) };
                let exact = derivative(|t| scene.half_at(t * pixel_steps[k], lens + t * lens_steps[k])[0]);
                let step = half.slope_step(&motion);
                assert!((step - exact).length() < 1e-6 * (0.1 + exact.length()), "{i} {step} {exact}");
            }
        }
    }
    assert!(seen > 50 * KINDS, "{seen}");
}

/// Differences of quads tend to the derivatives as the first power of the size of a pixel.
#[test]
fn quads_tend_to_footprints() {
    let mut random = Pcg64Mcg::new(3);
    for i in 0..50 * KINDS {
        let scene = scene(&mut random, i % KINDS);
        for space in 0..2 {
            // Of the coarse differences and of the fine ones of each pixel, relative.
            let errors = |size: f64| {
                let at = |u: f64, v: f64| scene.half_at(size * DVec2::new(u, v), DVec3::ZERO)[space];
                let quad = Quad::<f64, 2>::new([at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)]);
                let [du, dv] = scene.analytic(size)[space].steps();
                let error = |footprint: Footprint<f64>| {
                    let [u, v] = footprint.steps();
                    ((u - du).length() + (v - dv).length()) / (du.length() + dv.length())
                };
                let fine = |u, v| error(quad.fine_footprint([u, v]));
                [error(quad.coarse_footprint()), fine(0, 0), fine(1, 0), fine(0, 1), fine(1, 1)]
            };
            let [large, small] = [2e-4, 1e-4].map(errors);
            for (large, small) in large.into_iter().zip(small) {
                assert!(small < 2e-3 && (large / small - 2.0).abs() < 0.05, "{i}: {large} {small}");
            }
        }
    }
}

/// Normals in a quad are those of the closed form, too.
#[test]
fn quads_of_normals_are_motions() {
    let mut random = Pcg64Mcg::new(4);
    for i in 0..20 * KINDS {
        let scene = scene(&mut random, i % KINDS);
        let size = 1e-5;
        let at = |u: f64, v: f64| {
            let [_, _, n] = scene.see(size * DVec2::new(u, v), DVec3::ZERO).frame.axes();
            n
        };
        let quad = Quad::<f64, 3>::new([at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)]);
        let rays = RayDifferential::pinhole(scene.forward, size * scene.right, size * scene.up);
        let place = scene.see(DVec2::ZERO, DVec3::ZERO);
        let distance = (place.point - scene.eye).length();
        let steps = rays.onto_plane(scene.forward.normalize(), distance, place.normal);
        for (difference, point) in quad.coarse().into_iter().zip(steps) {
            let normal = scene.surface.motion(&place, point).normal;
            assert!((DVec3::from_array(difference) - normal).length() <= 1e-3 * point.length());
        }
        assert!((DVec3::from_array(quad.mean()) - at(0.5, 0.5)).length() < 1e-8);
    }
}

#[test]
fn quads_know_their_rows_and_columns() {
    let quad = Quad::<f32, 1>::new([[1.0], [3.0], [10.0], [17.0]]);
    assert_eq!(quad.coarse(), [[2.0], [9.0]]);
    for (pixel, du, dv) in [([0, 0], 2.0, 9.0), ([1, 0], 2.0, 14.0), ([0, 1], 7.0, 9.0), ([1, 1], 7.0, 14.0)]
    {
        assert_eq!(quad.fine(pixel), [[du], [dv]]);
        assert_eq!(quad.fine(pixel.map(|c| c + 640)), [[du], [dv]]);
    }
    assert_eq!(quad.mean(), [7.75]);
}
