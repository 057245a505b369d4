//! The materials: smooth conductors, whose highlights are smaller than pixels.

use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Schlick;
use microsurface::glam::Vec3;
use microsurface::{Beckmann, Error, Ggx, Isotropic, Microsurface};

/// The roughness of both.
pub(crate) const ALPHA: f32 = 0.01;

/// The Fresnel term of the conductor.
pub(crate) fn fresnel() -> Schlick<f32> {
    Schlick::new(0.8).expect("a share")
}

/// A surface before it is filtered.
pub(crate) type Surface<P> = Microsurface<P, Isotropic<f32>>;

pub(crate) struct Materials {
    beckmann: RoughConductor<Surface<Beckmann>, Schlick<f32>>,
    ggx: RoughConductor<Surface<Ggx>, Schlick<f32>>,
}

impl Materials {
    pub(crate) const NAMES: [&str; 2] = ["Beckmann", "GGX"];

    pub(crate) fn new() -> Result<Self, Error> {
        Ok(Self {
            beckmann: RoughConductor::new(Beckmann::isotropic(ALPHA)?, fresnel()),
            ggx: RoughConductor::new(Ggx::isotropic(ALPHA)?, fresnel()),
        })
    }

    /// The BRDF of each.
    pub(crate) fn eval(&self, wi: Vec3, wo: Vec3) -> [f32; 2] {
        [self.beckmann.eval(wi, wo), self.ggx.eval(wi, wo)]
    }
}
