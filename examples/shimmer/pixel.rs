//! What a renderer knows of a pixel when it shades it once: the inputs of every method.

use microsurface::filter::jacobian::{HalfVector, Motion};
use microsurface::filter::quad::Quad;
use microsurface::filter::ray::RayDifferential;
use microsurface::filter::{Footprint, deferred};
use microsurface::frame::{Frame, normal_to_slope};
use microsurface::glam::{DVec2, Vec2, Vec3};

use crate::rows::{Region, each_pixel};
use crate::scene::{Camera, Hit, Scene};

/// One shading sample, at the centre of a pixel.
#[derive(Clone, Copy)]
pub(crate) struct Pixel {
    pub(crate) wi: Vec3,
    pub(crate) wo: Vec3,
    pub(crate) irradiance: f32,
    pub(crate) diffuse: f32,
    /// The unit half vector, and its slope.
    pub(crate) m: Vec3,
    pub(crate) slope: Vec2,
    /// From the differences within 2×2 pixels, as shaders have them.
    pub(crate) quad: Steps,
    /// From the ray differential and the derivative of the normal.
    pub(crate) analytic: Steps,
}

/// What changes from one pixel to the next, along u and along v.
#[derive(Clone, Copy)]
pub(crate) struct Steps {
    /// The half vector in slopes and in the projected space of m.xy.
    pub(crate) slopes: Footprint<f32>,
    pub(crate) projected: Footprint<f32>,
    /// The normal: in world space, and as the frames of a quad see their average.
    pub(crate) normals: [Vec3; 2],
    pub(crate) normal_slopes: Footprint<f32>,
    pub(crate) normals_projected: Footprint<f32>,
}

/// What is known of a pixel alone.
struct Point {
    pixel: Pixel,
    frame: Frame<f32>,
}

/// The pixels of a region, row by row; `None` where nothing is hit.
pub(crate) fn pixels(scene: &Scene, region: Region, frame: f64) -> Vec<Option<Pixel>> {
    let camera = scene.camera(frame);
    let points = each_pixel(region, |x, y| point(scene, &camera, region, [x, y]));
    let whole = |(i, point): (usize, &Option<Point>)| {
        let point = point.as_ref()?;
        let [x, y] = [i % region.size[0], i / region.size[0]];
        // Where the others of the quad miss, nothing is known but this pixel.
        let of_quad = [[x & !1, y & !1], [x | 1, y & !1], [x & !1, y | 1], [x | 1, y | 1]]
            .map(|[x, y]| points[y * region.size[0] + x].as_ref().unwrap_or(point));
        Some(Pixel { quad: steps_of_quad(of_quad, [x, y]), ..point.pixel })
    };
    points.iter().enumerate().map(whole).collect()
}

fn point(scene: &Scene, camera: &Camera, region: Region, [x, y]: [usize; 2]) -> Option<Point> {
    let place = DVec2::from(region.place(x as f64 + 0.5, y as f64 + 0.5));
    let hit = scene.shape.hit(&camera.ray(place))?;
    let lit = scene.lit(&hit, camera.eye);
    let (wi, wo) = (lit.wi.as_vec3(), lit.wo.as_vec3());
    let m = (wi + wo).normalize();
    let analytic = analytic_steps(scene, camera, place, 1.0 / region.height as f64, &hit);
    let pixel = Pixel {
        wi,
        wo,
        irradiance: lit.irradiance as f32,
        diffuse: lit.diffuse as f32,
        m,
        slope: normal_to_slope(m),
        // Until the other pixels of the quad are known.
        quad: analytic,
        analytic,
    };
    let [x, _, z] = scene.frame(&hit).axes();
    Some(Point { pixel, frame: Frame::from_normal_and_tangent(z.as_vec3(), x.as_vec3()) })
}

/// Differences within a quad, in f32 as a shader has them.
fn steps_of_quad(points: [&Point; 4], pixel: [usize; 2]) -> Steps {
    let frames = points.map(|point| point.frame);
    Steps {
        slopes: Quad::<f32, 2>::new(points.map(|point| point.pixel.slope)).fine_footprint(pixel),
        projected: Quad::<f32, 2>::new(points.map(|point| point.pixel.m.truncate())).fine_footprint(pixel),
        normals: Quad::<f32, 3>::new(frames.map(|frame| frame.axes()[2])).fine(pixel).map(Vec3::from),
        normal_slopes: deferred::quad_in_slopes(&frames),
        normals_projected: deferred::quad_projected(&frames),
    }
}

/// Exact derivatives at the centre of a pixel of this size.
fn analytic_steps(scene: &Scene, camera: &Camera, place: DVec2, size: f64, hit: &Hit) -> Steps {
    let (direction, derivatives) = camera.direction(place);
    let [direction_du, direction_dv] = derivatives.map(|d| d * size);
    let distance = hit.position.distance(camera.eye);
    let moves = RayDifferential::pinhole(direction, direction_du, direction_dv).onto_plane(
        direction.normalize(),
        distance,
        hit.geometric_normal,
    );
    let frame = scene.frame(hit);
    let curvature = scene.normal_derivative(hit);
    let motion = moves.map(|point| Motion::<f64> { point, normal: curvature * point, ..Motion::default() });
    let half = HalfVector::<f64>::new(&frame, hit.position, camera.eye, scene.light);
    let footprint = |[du, dv]: [DVec2; 2]| Footprint::new(du.as_vec2(), dv.as_vec2());
    let local = motion.map(|motion| frame.to_local(motion.normal).truncate());
    Steps {
        slopes: footprint(motion.map(|motion| half.slope_step(&motion))),
        projected: footprint(motion.map(|motion| half.projected_step(&motion))),
        normals: motion.map(|motion| motion.normal.as_vec3()),
        normal_slopes: footprint(local),
        normals_projected: footprint(local),
    }
}
