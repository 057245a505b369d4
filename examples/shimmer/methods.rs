//! The methods under test: each makes radiance of what is known of a pixel.

use microsurface::bsdf::RoughConductor;
use microsurface::filter::covariance::{
    LARGEST_KERNEL, VARIANCE_KAPLANYAN2016, VARIANCE_OF_BOX,
};
use microsurface::filter::{Covariance, Footprint};
use microsurface::profile::{Profile, ShapeInvariant};
use microsurface::{Beckmann, Error, Ggx};

use crate::materials::{ALPHA, FRESNEL, Surface};
use crate::pixel::Pixel;

/// A way to shade pixels, all in one loop.
pub(crate) struct Method {
    pub(crate) name: &'static str,
    /// Radiance of each pixel.
    pub(crate) shade: Box<dyn Fn(&[Pixel], &mut [f32])>,
}

/// The method that evaluates this BRDF at each pixel.
fn method(name: &'static str, brdf: impl Fn(&Pixel) -> f32 + 'static) -> Method {
    let shade = move |pixels: &[Pixel], radiance: &mut [f32]| {
        for (radiance, pixel) in radiance.iter_mut().zip(pixels) {
            *radiance = pixel.diffuse + pixel.irradiance * brdf(pixel);
        }
    };
    Method { name, shade: Box::new(shade) }
}

/// The methods for each of the materials.
pub(crate) fn methods() -> Result<[Vec<Method>; 2], Error> {
    let (beckmann, ggx) = (Beckmann::isotropic(ALPHA)?, Ggx::isotropic(ALPHA)?);
    Ok([of_any(beckmann), of_any(ggx)])
}

/// What works for every profile.
fn of_any<P: Profile<f32> + ShapeInvariant + 'static>(surface: Surface<P>) -> Vec<Method> {
    let unfiltered = RoughConductor::new(surface, FRESNEL);
    vec![
        method("unfiltered", move |p| unfiltered.eval(p.wi, p.wo)),
        filtered("slopes, 1/4", surface, |p| within(p.quad).covariance(VARIANCE_KAPLANYAN2016 as f32)),
        filtered("slopes, 1/12", surface, |p| within(p.quad).covariance(VARIANCE_OF_BOX as f32)),
        filtered("slopes, bounds, 1/4", surface, |p| {
            within(p.quad)
                .covariance_of_bounds(VARIANCE_KAPLANYAN2016 as f32)
                .clamped(0.5 * LARGEST_KERNEL as f32)
        }),
        filtered("projected 2017, 1/4", surface, |p| {
            p.quad_projected.covariance(VARIANCE_KAPLANYAN2016 as f32)
        }),
    ]
}

/// The papers' limit λ of a footprint in slopes.
fn within(footprint: Footprint<f32>) -> Footprint<f32> {
    footprint.clamped(1.0)
}

/// The surface filtered with a Σ of each pixel. NaN if the library refuses it, which the checks find.
fn filtered<P: Profile<f32> + ShapeInvariant + 'static>(
    name: &'static str,
    surface: Surface<P>,
    covariance: impl Fn(&Pixel) -> Covariance<f32> + 'static,
) -> Method {
    method(name, move |p| match surface.filtered(covariance(p)) {
        Ok(filtered) => RoughConductor::new(filtered, FRESNEL).eval(p.wi, p.wo),
        Err(_) => f32::NAN,
    })
}
