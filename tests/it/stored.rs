//! Serialised surfaces: what comes back is the same bits, and what is read is checked.
#![cfg(feature = "serde")]

use microsurface::bsdf::{AllNormals, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::fresnel::{Conductor, Dielectric, Schlick};
use microsurface::glam::DMat2;
use microsurface::profile::gtr::closed::Closed;
use microsurface::profile::gtr::mixture::Mixture;
use microsurface::profile::gtr::spline::Spline;
use microsurface::{AxisAligned, Beckmann, Ggx, Gtr, Isotropic, Linear, Microsurface, RoughnessMatrix};
use serde::Serialize;
use serde::de::DeserializeOwned;

fn comes_back<S: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(value: &S) {
    let text = serde_json::to_string(value).unwrap();
    let again: S = serde_json::from_str(&text).unwrap();
    assert_eq!(&again, value, "{text}");
    assert_eq!(format!("{again:?}"), format!("{value:?}"), "{text}");
}

#[test]
fn surfaces_come_back_unchanged() {
    for alpha in [0.1_f64, 1.0 / 3.0, 1e-6, 0.7] {
        let (ggx, beckmann) = (Ggx::isotropic(alpha).unwrap(), Beckmann::anisotropic(alpha, 0.3).unwrap());
        comes_back(&ggx);
        comes_back(&beckmann);
        let moved = beckmann.transformed(DMat2::from_cols_array(&[0.3, -1.2, 0.7, 0.9])).unwrap();
        comes_back(&moved);
        comes_back(&moved.stretched(0.3).unwrap());
        comes_back(&Gtr::closed::<1>(alpha).unwrap());
        comes_back(&Gtr::isotropic(alpha, 2.7).unwrap());
        comes_back(&Gtr::heavy_tailed::<6>(alpha, 1.2).unwrap());
        comes_back(&Gtr::spline(alpha, 1.7).unwrap().stretched(-0.2).unwrap());
        comes_back(&RoughConductor::new(ggx, Conductor::new(0.2, 3.7).unwrap()));
        comes_back(&RoughConductor::new(moved, Schlick::new(0.04)));
        let mixture = UniformMixture::new(AllNormals, alpha).unwrap();
        comes_back(&RoughConductor::new(ggx, Schlick::new(0.04)).sampled_by(mixture));
        comes_back(&UniformMixture::new(UniformMixture::new(VisibleNormals, 0.3_f32).unwrap(), 0.7).unwrap());
        comes_back(&Ggx::isotropic(alpha as f32).unwrap());
        comes_back(&RoughnessMatrix::new(alpha, 0.01 * alpha, 0.2).unwrap());
    }
}

/// Every number replaced by one that a constructor refuses.
#[test]
fn invalid_surfaces_are_refused() {
    fn refused<S: DeserializeOwned + core::fmt::Debug>(
        valid: &impl Serialize,
        from: &str,
        to: &str,
        says: &str,
    ) {
        let text = serde_json::to_string(valid).unwrap();
        assert!(text.contains(from), "{text}");
        let error = serde_json::from_str::<S>(&text.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
    type Surface<P, M> = Microsurface<P, M>;
    let ggx = Ggx::isotropic(0.25).unwrap();
    for bad in ["0.0", "-0.25", "1e300"] {
        refused::<Surface<Ggx, Isotropic<f64>>>(&ggx, "0.25", bad, "alpha = ");
    }
    let aligned = Ggx::anisotropic(0.5, 0.25).unwrap();
    refused::<Surface<Ggx, AxisAligned<f64>>>(&aligned, "0.25", "0.0", "alpha = 0");
    let linear = Ggx::from_roughness_matrix(RoughnessMatrix::new(0.25, 0.0, 1.0).unwrap());
    refused::<Surface<Ggx, Linear<f64>>>(&linear, "0.5", "0.0", "determinant");
    refused::<RoughnessMatrix<f64>>(
        &RoughnessMatrix::new(0.25, 0.125, 1.0).unwrap(),
        "0.125",
        "0.75",
        "matrix",
    );
    let spline = Gtr::spline(0.25, 1.5).unwrap();
    refused::<Surface<Gtr<f64, Spline<f64>>, Isotropic<f64>>>(&spline, "1.5", "4.5", "gamma = 4.5");
    refused::<Surface<Gtr<f64, Spline<f64>>, Isotropic<f64>>>(&spline, "0.25", "1.25", "alpha = 1.25");
    let mixture = Gtr::isotropic(0.25, 1.5).unwrap();
    refused::<Surface<Gtr<f64, Mixture<f64, 8>>, Isotropic<f64>>>(&mixture, "1.5", "10.5", "gamma = 10.5");
    let closed = Gtr::closed::<3>(0.25).unwrap();
    refused::<Surface<Gtr<f64, Closed<f64, 3>>, Isotropic<f64>>>(&closed, "3.0", "2.0", "gamma = 2");
    refused::<Dielectric<f64>>(&Dielectric::new(1.5).unwrap(), "1.5", "-1.5", "refractive index = -1.5");
    let mixture = UniformMixture::new(AllNormals, 0.25).unwrap();
    for bad in ["1.0", "-0.25", "1e300"] {
        refused::<UniformMixture<AllNormals, f64>>(&mixture, "0.25", bad, "probability = ");
    }
    refused::<Conductor<f64>>(
        &Conductor::new(0.25, 3.5).unwrap(),
        "3.5",
        "-3.5",
        "extinction coefficient = -3.5",
    );
}
