//! What a renderer knows of a pixel when it shades it once: the inputs of every method.

use microsurface::filter::Footprint;
use microsurface::frame::normal_to_slope;
use microsurface::glam::{Vec2, Vec3};

use crate::rows::{Region, each_pixel};
use crate::scene::{Hit, Scene};

/// One shading sample, at the centre of a pixel.
#[derive(Clone, Copy)]
pub(crate) struct Pixel {
    pub(crate) wi: Vec3,
    pub(crate) wo: Vec3,
    pub(crate) irradiance: f32,
    pub(crate) diffuse: f32,
    /// The cosine of the half vector to the normal.
    pub(crate) h_z: f32,
    /// The slope of the half vector.
    pub(crate) slope: Vec2,
    /// Steps of the half vector from differences within 2×2 pixels, in slopes and in the projected space.
    pub(crate) quad: Footprint<f32>,
    pub(crate) quad_projected: Footprint<f32>,
}

/// A place with what is known of it alone.
struct Point {
    hit: Hit,
    pixel: Pixel,
    projected: Vec2,
}

/// The pixels of a region, row by row; `None` where nothing is hit.
pub(crate) fn pixels(scene: &Scene, region: Region, frame: f64) -> Vec<Option<Pixel>> {
    let camera = scene.camera(frame);
    let points = each_pixel(region, |x, y| {
        let place = region.place(x as f64 + 0.5, y as f64 + 0.5);
        let hit = scene.shape.hit(&camera.ray(place.into()))?;
        let lit = scene.lit(&hit, camera.eye);
        let (wi, wo) = (lit.wi.as_vec3(), lit.wo.as_vec3());
        let h = (wi + wo).normalize();
        let nothing = Footprint::new(Vec2::ZERO, Vec2::ZERO);
        Some(Point {
            hit,
            pixel: Pixel {
                wi,
                wo,
                irradiance: lit.irradiance as f32,
                diffuse: lit.diffuse as f32,
                h_z: h.z,
                slope: normal_to_slope::<f32>(h),
                quad: nothing,
                quad_projected: nothing,
            },
            projected: h.truncate(),
        })
    });
    let at = |x: usize, y: usize| points[y * region.size[0] + x].as_ref();
    let quad = |x: usize, y: usize, value: fn(&Point) -> Vec2| {
        // The other pixels of the quad along u and v; where they miss, no step is known.
        let step = |first: Option<&Point>, second: Option<&Point>| match (first, second) {
            (Some(first), Some(second)) => value(second) - value(first),
            _ => Vec2::ZERO,
        };
        Footprint::new(step(at(x & !1, y), at(x | 1, y)), step(at(x, y & !1), at(x, y | 1)))
    };
    let whole = |(i, point): (usize, &Option<Point>)| {
        let [x, y] = [i % region.size[0], i / region.size[0]];
        point.as_ref().map(|point| Pixel {
            quad: quad(x, y, |point| point.pixel.slope),
            quad_projected: quad(x, y, |point| point.projected),
            ..point.pixel
        })
    };
    points.iter().enumerate().map(whole).collect()
}
