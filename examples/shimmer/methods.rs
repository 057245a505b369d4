//! The methods under test: each makes radiance of what is known of a pixel.

use microsurface::bsdf::RoughConductor;
use microsurface::filter::MeanOverParallelogram;
use microsurface::filter::covariance::{
    largest_kernel, variance_kaplanyan2016, variance_of_box, variance_tokuyoshi2021,
};
use microsurface::filter::deferred::{self, Bound, Kernel};
use microsurface::filter::{Covariance, Footprint, gaussian, projected, rectangle};
use microsurface::fresnel::Fresnel;
use microsurface::profile::{Profile, ShapeInvariant};
use microsurface::{AxisAligned, Beckmann, Error, Ggx, Isotropic, Microsurface, Ndf};

use crate::materials::{ALPHA, Surface, fresnel};
use crate::pixel::{Pixel, Steps};

/// Writes the radiance of each pixel.
type Shade = Box<dyn Fn(&[Pixel], &mut [f32])>;

/// A way to shade pixels, all in one loop.
pub(crate) struct Method {
    pub(crate) name: &'static str,
    pub(crate) shade: Shade,
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

pub(crate) const UNFILTERED: &str = "unfiltered";
pub(crate) const SLOPES: &str = "slopes, 1/4";
pub(crate) const BOX: &str = "slopes, 1/12";
pub(crate) const PROJECTED: &str = "projected 2017, 1/4";
pub(crate) const PROJECTED_2021: &str = "projected 2021, 1/(2π)";
pub(crate) const DEFERRED: &str = "deferred, isotropic 2017";
pub(crate) const RECTANGLE: &str = "rectangle";
pub(crate) const PARALLELOGRAM: &str = "parallelogram";
pub(crate) const ANALYTIC_SLOPES: &str = "analytic: slopes, 1/4";
pub(crate) const ANALYTIC_BOX: &str = "analytic: slopes, 1/12";
pub(crate) const GAUSSIAN: &str = "GGX * Gaussian, 1/12";
pub(crate) const ANALYTIC_GAUSSIAN: &str = "analytic: GGX * Gaussian, 1/12";
pub(crate) const ANALYTIC_PARALLELOGRAM: &str = "analytic: parallelogram";

/// For a picture of few: what goes wrong, and what cures it.
pub(crate) const SELECTED: [&str; 5] =
    [UNFILTERED, SLOPES, PROJECTED_2021, ANALYTIC_GAUSSIAN, ANALYTIC_PARALLELOGRAM];

/// The methods for each of the materials.
pub(crate) fn methods() -> Result<[Vec<Method>; 2], Error> {
    let (beckmann, ggx) = (Beckmann::isotropic(ALPHA)?, Ggx::isotropic(ALPHA)?);
    let of_beckmann = [forward(beckmann), deferred(beckmann), analytic(beckmann)];
    let of_ggx = [forward(ggx), only_ggx(ggx), deferred(ggx), analytic(ggx)];
    Ok([of_beckmann.into_iter().flatten().collect(), of_ggx.into_iter().flatten().collect()])
}

/// Filters while shading, from the differences of quads, for every profile.
fn forward<P: MeanOverParallelogram<f32> + ShapeInvariant + 'static>(surface: Surface<P>) -> Vec<Method> {
    let unfiltered = RoughConductor::new(surface, fresnel());
    vec![
        method(UNFILTERED, move |p| unfiltered.eval(p.wi, p.wo)),
        filtered(SLOPES, surface, |p| slopes(&p.quad).covariance(variance_kaplanyan2016())),
        filtered(BOX, surface, |p| slopes(&p.quad).covariance(variance_of_box())),
        filtered("slopes, bounds, 1/4", surface, |p| {
            slopes(&p.quad)
                .covariance_of_bounds(variance_kaplanyan2016())
                .clamped(0.5 * largest_kernel::<f32>())
        }),
        method(RECTANGLE, move |p| {
            let half_extents = p.quad.slopes.clamped_extents(1.0) * 0.5;
            averaged(&surface, rectangle::mean_p22(&surface, p.slope, half_extents), p)
        }),
        parallelogram(PARALLELOGRAM, surface, |p| slopes(&p.quad)),
        filtered(PROJECTED, surface, |p| p.quad.projected.covariance(variance_kaplanyan2016())),
    ]
}

/// Filters that only GGX has or needs: the filter of projected space, and the Gaussian one that
/// keeps its tail.
fn only_ggx(surface: Surface<Ggx>) -> Vec<Method> {
    let variance = variance_tokuyoshi2021::<f32>();
    vec![
        method(PROJECTED_2021, move |p| {
            reflected(projected::filtered(&surface, p.quad.projected, variance), p)
        }),
        parallelogram("parallelogram of m.xy", surface, |p| p.quad.projected),
        method("GGX * Gaussian of two, 1/12", move |p| {
            let kernel = slopes(&p.quad).covariance(variance_of_box());
            reflected(gaussian::filtered_by_two(&surface, kernel), p)
        }),
        method(GAUSSIAN, move |p| {
            let kernel = slopes(&p.quad).covariance(variance_of_box());
            reflected(gaussian::filtered(&surface, kernel), p)
        }),
        method(ANALYTIC_GAUSSIAN, move |p| {
            let kernel = slopes(&p.analytic).covariance(variance_of_box());
            reflected(gaussian::filtered(&surface, kernel), p)
        }),
    ]
}

/// One α' or two per pixel, from the normals alone, as a G-buffer keeps it.
fn deferred<P: Profile<f32> + 'static>(surface: Surface<P>) -> Vec<Method> {
    let (of_2016, of_2019, of_2021) =
        (Kernel::kaplanyan2016(), Kernel::tokuyoshi2019(), Kernel::tokuyoshi2021());
    let profile = *surface.profile();
    vec![
        method("deferred, rectangle, two channels", move |p| {
            let [x, y] = deferred::rectangle([ALPHA; 2], p.quad.normal_slopes, &of_2016);
            reflected(AxisAligned::new(x, y).map(|map| Microsurface::new(profile, map)), p)
        }),
        isotropic("deferred, rectangle, one channel", profile, move |p| {
            deferred::rectangle_maximum(ALPHA, p.quad.normal_slopes, &of_2016)
        }),
        isotropic("deferred, largest eigenvalue", profile, move |p| {
            deferred::max_eigenvalue(ALPHA, p.quad.normals_projected, &of_2019)
        }),
        isotropic(DEFERRED, profile, move |p| {
            let [du, dv] = p.quad.normals;
            deferred::isotropic_from_normals(ALPHA, du, dv, &of_2019, Bound::Upper)
        }),
        isotropic("deferred, isotropic 2021", profile, move |p| {
            let [du, dv] = p.quad.normals;
            deferred::isotropic_from_normals(ALPHA, du, dv, &of_2021, Bound::Mean)
        }),
    ]
}

/// The same filters from analytic derivatives.
fn analytic<P: MeanOverParallelogram<f32> + ShapeInvariant + 'static>(surface: Surface<P>) -> Vec<Method> {
    vec![
        filtered(ANALYTIC_SLOPES, surface, |p| slopes(&p.analytic).covariance(variance_kaplanyan2016())),
        filtered(ANALYTIC_BOX, surface, |p| slopes(&p.analytic).covariance(variance_of_box())),
        filtered("analytic: projected 2017, 1/12", surface, |p| {
            p.analytic.projected.covariance(variance_of_box())
        }),
        parallelogram(ANALYTIC_PARALLELOGRAM, surface, |p| slopes(&p.analytic)),
    ]
}

/// A footprint in slopes within the papers' limit λ.
fn slopes(steps: &Steps) -> Footprint<f32> {
    steps.slopes.clamped(1.0)
}

/// A + 2Σ, with a Σ of each pixel.
fn filtered<P: Profile<f32> + ShapeInvariant + 'static>(
    name: &'static str,
    surface: Surface<P>,
    covariance: impl Fn(&Pixel) -> Covariance<f32> + 'static,
) -> Method {
    method(name, move |p| reflected(surface.filtered(covariance(p)), p))
}

/// The BRDF over a footprint of each pixel.
fn parallelogram<P: MeanOverParallelogram<f32> + 'static>(
    name: &'static str,
    surface: Surface<P>,
    footprint: impl Fn(&Pixel) -> Footprint<f32> + 'static,
) -> Method {
    let material = RoughConductor::new(surface, fresnel());
    method(name, move |p| material.eval_over(p.wi, p.wo, footprint(p)))
}

/// The BRDF F D̃ G2/(4 zi zo), where D̃ = P̃22/m.z⁴ has the mean of P22 over the pixel.
fn averaged(surface: &impl Ndf<Scalar = f32>, mean_p22: f32, p: &Pixel) -> f32 {
    if p.wi.z <= 0.0 || p.wo.z <= 0.0 {
        return 0.0;
    }
    let z2 = p.m.z * p.m.z;
    let masked = surface.g2(p.wi, p.wo, p.m) / (4.0 * p.wi.z * p.wo.z);
    fresnel().reflectance(p.wo.dot(p.m)) * (mean_p22 / (z2 * z2)) * masked
}

/// An isotropic surface of an α of each pixel.
fn isotropic<P: Profile<f32> + 'static>(
    name: &'static str,
    profile: P,
    alpha: impl Fn(&Pixel) -> f32 + 'static,
) -> Method {
    method(name, move |p| reflected(Isotropic::new(alpha(p)).map(|map| Microsurface::new(profile, map)), p))
}

/// The BRDF of a surface made for this pixel. NaN, which the claims find, if it was refused.
fn reflected<N: Ndf<Scalar = f32>>(surface: Result<N, Error>, p: &Pixel) -> f32 {
    surface.map_or(f32::NAN, |surface| RoughConductor::new(surface, fresnel()).eval(p.wi, p.wo))
}
