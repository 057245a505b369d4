//! Every distribution under every map, and the filters: by scalar calls, and with the feature
//! `batches` in batches too.

use std::hint::black_box;

#[cfg(feature = "batches")]
use microsurface::batch::{Directions, DirectionsMut, Numbers, ReflectionBatch, Samples};
use microsurface::bsdf::RoughConductor;
use microsurface::filter::{Footprint, gaussian, projected};
use microsurface::fresnel::Conductor;
use microsurface::glam::{Mat2, Vec2, Vec3};
use microsurface::{Beckmann, Error, Ggx, Gtr};

/// Reflection off a surface.
macro_rules! reflect {
    ($surface:expr) => {{
        let (n, k) = black_box((Vec3::new(0.19, 0.54, 1.33), Vec3::new(3.40, 2.23, 1.87)));
        let brdf = RoughConductor::new(black_box($surface), Conductor::new(n, k)?);
        let (wi, wo, u) = black_box((Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec2::new(0.3, 0.7)));
        black_box(brdf.eval(wi, wo));
        black_box(brdf.pdf(wi, wo));
        black_box(brdf.sample(wo, u));
        #[cfg(feature = "batches")]
        {
            let numbers = black_box([0.6_f32; 256]);
            let w = Directions { x: &numbers, y: &numbers, z: &numbers };
            let (mut f, mut pdf, mut wi) = ([Vec3::ZERO; 256], [0.0_f32; 256], [[0.0_f32; 256]; 3]);
            brdf.eval_and_pdf_batch(w, w, &mut f, &mut pdf);
            black_box((&f, &pdf));
            let [x, y, z] = &mut wi;
            let (wi, u) = (DirectionsMut { x, y, z }, Numbers { x: &numbers, y: &numbers });
            brdf.sample_batch(w, u, Samples { wi, weight: &mut f, pdf: &mut pdf });
            black_box((&f, &pdf, &x, &y, &z));
        }
    }};
}

/// A surface under each map.
macro_rules! under_maps {
    ($surface:expr) => {{
        let surface = $surface;
        reflect!(surface);
        reflect!(surface.stretched(black_box(0.2))?);
        reflect!(surface.transformed(black_box(Mat2::from_cols_array(&[0.8, 0.3, -0.4, 1.1])))?);
    }};
}

fn all() -> Result<(), Error> {
    let (alpha, gamma) = black_box((0.3_f32, 1.5));
    under_maps!(Ggx::isotropic(alpha)?);
    under_maps!(Beckmann::isotropic(alpha)?);
    under_maps!(Gtr::isotropic(alpha, gamma)?);
    under_maps!(Gtr::closed::<1>(alpha)?);

    let footprint = Footprint::new(black_box(Vec2::new(0.1, 0.02)), black_box(Vec2::new(0.0, 0.06)));
    let surface = Ggx::isotropic(alpha)?;
    reflect!(surface.filtered(footprint.covariance(0.25))?);
    reflect!(projected::filtered(&surface, footprint, 0.25)?);
    reflect!(gaussian::filtered(&surface, footprint.covariance(0.25))?);
    let brdf = RoughConductor::new(surface, Conductor::new(0.2_f32, 3.9)?);
    black_box(brdf.eval_over(black_box(Vec3::Z), black_box(Vec3::Z), footprint));
    Ok(())
}

fn main() {
    let _ = black_box(all());
}
