//! A dyed dielectric.

use microsurface::SampleVndf;
use microsurface::bsdf::{RoughConductor, Sample};
use microsurface::fresnel::{Dielectric, Fresnel};
use microsurface::glam::{Vec2, Vec3};

use crate::material::{Diffuse, Material};

/// A rough boundary, and below it a base that scatters what the boundary lets in and out again.
pub(crate) struct Rubber<N> {
    boundary: RoughConductor<N, Dielectric<Vec3>>,
    base: Diffuse,
}

impl<N> Rubber<N> {
    pub(crate) const fn new(surface: N, fresnel: Dielectric<Vec3>, dye: Vec3) -> Self {
        Self { boundary: RoughConductor::new(surface, fresnel), base: Diffuse { albedo: dye } }
    }
}

impl<N: SampleVndf<Scalar = f32> + Sync> Material for Rubber<N> {
    fn eval(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        let passed = |cos: f32| Vec3::ONE - self.boundary.fresnel().reflectance(cos.max(0.0));
        self.boundary.eval(wi, wo) + self.base.eval(wi, wo) * passed(wi.z) * passed(wo.z)
    }

    fn pdf(&self, wi: Vec3, wo: Vec3) -> f32 {
        0.5 * (self.boundary.pdf(wi, wo) + self.base.pdf(wi, wo))
    }

    fn sample(&self, wo: Vec3, u: Vec2) -> Option<Sample<f32, Vec3>> {
        let stretched = |x: f32| Vec2::new(x.min(1.0 - f32::EPSILON), u.y);
        let wi = if u.x < 0.5 {
            self.boundary.sample(wo, stretched(2.0 * u.x))?.wi
        } else {
            self.base.sample(wo, stretched(2.0 * u.x - 1.0))?.wi
        };
        let pdf = self.pdf(wi, wo);
        (pdf > 0.0).then(|| Sample { wi, weight: self.eval(wi, wo) * (wi.z / pdf), pdf })
    }
}
