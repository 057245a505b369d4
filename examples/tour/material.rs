//! What a renderer asks of a material, and its two implementations.

use core::f32::consts::{FRAC_1_PI, TAU};

use microsurface::Ndf;
use microsurface::bsdf::{NormalSampling, RoughConductor, Sample};
use microsurface::fresnel::Fresnel;
use microsurface::glam::{Vec2, Vec3};

/// A reflecting material; directions are in the shading frame, z the normal, and point away from
/// the surface.
pub(crate) trait Material: Sync {
    /// f(wi, wo) without the cosine.
    fn eval(&self, wi: Vec3, wo: Vec3) -> Vec3;
    /// The density of `sample`, 1/sr.
    fn pdf(&self, wi: Vec3, wo: Vec3) -> f32;
    /// A direction to the light, or nothing.
    fn sample(&self, wo: Vec3, u: Vec2) -> Option<Sample<f32, Vec3>>;
}

impl<N, F, S> Material for RoughConductor<N, F, S>
where
    N: Ndf<Scalar = f32> + Sync,
    F: Fresnel<Output = Vec3> + Sync,
    S: NormalSampling<N> + Sync,
{
    fn eval(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        self.eval(wi, wo)
    }

    fn pdf(&self, wi: Vec3, wo: Vec3) -> f32 {
        self.pdf(wi, wo)
    }

    fn sample(&self, wo: Vec3, u: Vec2) -> Option<Sample<f32, Vec3>> {
        self.sample(wo, u)
    }
}

/// Lambert's law.
pub(crate) struct Diffuse {
    pub(crate) albedo: Vec3,
}

impl Material for Diffuse {
    fn eval(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        if wi.z > 0.0 && wo.z > 0.0 { self.albedo * FRAC_1_PI } else { Vec3::ZERO }
    }

    fn pdf(&self, wi: Vec3, _: Vec3) -> f32 {
        wi.z.max(0.0) * FRAC_1_PI
    }

    fn sample(&self, wo: Vec3, u: Vec2) -> Option<Sample<f32, Vec3>> {
        let (radius, (sin, cos)) = (u.x.sqrt(), (TAU * u.y).sin_cos());
        let wi = Vec3::new(radius * cos, radius * sin, (1.0 - u.x).sqrt());
        (wo.z > 0.0).then_some(Sample { wi, weight: self.albedo, pdf: wi.z * FRAC_1_PI })
    }
}
