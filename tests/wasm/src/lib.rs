//! A hash of what six materials give, for comparison between platforms.

use microsurface::bsdf::RoughConductor;
use microsurface::filter::Covariance;
use microsurface::fresnel::{Conductor, Fresnel};
use microsurface::glam::{Mat2, Vec2, Vec3};
use microsurface::{Beckmann, Error, Ggx, Gtr, Ndf, SampleVndf};

/// Numbers of [0, 1) by a linear congruential generator, and an FNV-1a hash of results.
struct State {
    random: u64,
    hash: u64,
}

impl State {
    fn number(&mut self) -> f32 {
        self.random = self.random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.random >> 40) as f32 / 16777216.0
    }

    fn direction(&mut self) -> Vec3 {
        let (z, turn) = (self.number(), core::f32::consts::TAU * self.number());
        // Not the platform's sine.
        let x = turn - core::f32::consts::PI;
        Vec3::new(x, 1.0 - 0.1 * x * x, 2.0 * z + 0.01).normalize()
    }

    fn add(&mut self, value: f32) {
        // The payload and the sign of a NaN may differ.
        let bits = if value.is_nan() { 0x7fc0_0000 } else { value.to_bits() };
        for byte in bits.to_le_bytes() {
            self.hash = (self.hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn all<N: SampleVndf + Ndf<Scalar = f32>>(&mut self, surface: N) -> Result<(), Error> {
        let gold = Conductor::new(Vec3::new(0.19, 0.54, 1.33), Vec3::new(3.40, 2.23, 1.87))?;
        self.add(gold.reflectance(0.3).x);
        let material = RoughConductor::new(surface, gold);
        for _ in 0..2000 {
            let (wi, wo, u) = (self.direction(), self.direction(), Vec2::new(self.number(), self.number()));
            let f = material.eval(wi, wo);
            let [r, g, b] = f.to_array();
            for value in [r, g, b, material.pdf(wi, wo), material.surface().lambda(wo)] {
                self.add(value);
            }
            if let Some(sample) = material.sample(wo, u) {
                for value in [sample.wi.x, sample.wi.y, sample.wi.z, sample.weight.x, sample.pdf] {
                    self.add(value);
                }
            }
        }
        Ok(())
    }
}

fn everything() -> Result<u64, Error> {
    let mut state = State { random: 1, hash: 0xcbf2_9ce4_8422_2325 };
    state.all(Ggx::isotropic(0.2)?)?;
    state.all(Ggx::rotated(0.02, 0.4, 0.5)?.transformed(Mat2::from_cols(Vec2::new(1.5, 0.3), Vec2::Y))?)?;
    state.all(Ggx::isotropic(0.01)?.filtered(Covariance::isotropic(1e-4))?)?;
    state.all(Beckmann::anisotropic(0.1, 0.3)?)?;
    state.all(Gtr::isotropic(0.1, 1.5)?)?;
    state.all(Gtr::anisotropic(0.1, 0.3, 3.4)?)?;
    Ok(state.hash)
}

/// The hash; 0 if a material cannot be built.
#[unsafe(no_mangle)]
pub extern "C" fn hash() -> u64 {
    everything().unwrap_or(0)
}
