//! Serialised surfaces: what comes back is the same bits, and what is read is checked.
#![cfg(feature = "serde")]

use microsurface::beckmann::BeckmannTo1e6;
use microsurface::bsdf::{AllNormals, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::fresnel::{Conductor, Dielectric, Schlick};
use microsurface::glam::DMat2;
use microsurface::gtr::closed::Closed;
use microsurface::gtr::mixture::Mixture;
use microsurface::gtr::spline::Spline;
use microsurface::{AxisAligned, Beckmann, Ggx, Gtr, Isotropic, Linear, Microsurface, RoughnessMatrix};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// JSON, TOML and a binary format give back the same bits.
fn comes_back<S: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(value: &S) {
    let json = serde_json::to_string(value).unwrap();
    let toml = toml::to_string(value).unwrap();
    let bytes = postcard::to_stdvec(value).unwrap();
    let again: [S; 3] = [
        serde_json::from_str(&json).unwrap(),
        toml::from_str(&toml).unwrap(),
        postcard::from_bytes(&bytes).unwrap(),
    ];
    for again in again {
        assert_eq!(&again, value, "{json}\n{toml}");
        assert_eq!(format!("{again:?}"), format!("{value:?}"), "{json}\n{toml}");
    }
}

#[test]
fn surfaces_come_back_unchanged() {
    for alpha in [0.1_f64, 1.0 / 3.0, 1e-6, 0.7] {
        let (ggx, beckmann) = (Ggx::isotropic(alpha).unwrap(), Beckmann::anisotropic(alpha, 0.3).unwrap());
        comes_back(&ggx);
        comes_back(&beckmann);
        comes_back(&BeckmannTo1e6::isotropic(alpha).unwrap());
        let moved = beckmann.transformed(DMat2::from_cols_array(&[0.3, -1.2, 0.7, 0.9])).unwrap();
        comes_back(&moved);
        comes_back(&moved.stretched(0.3).unwrap());
        comes_back(&Ggx::from_roughness_matrix(RoughnessMatrix::rotated(1.0, alpha * 1e-8, 0.7).unwrap()));
        comes_back(&Gtr::closed::<1>(alpha).unwrap());
        comes_back(&Gtr::isotropic(alpha, 2.7).unwrap());
        comes_back(&Gtr::heavy_tailed::<6>(alpha, 1.2).unwrap());
        comes_back(&Gtr::spline(alpha, 1.7).unwrap().stretched(-0.2).unwrap());
        comes_back(&RoughConductor::new(ggx, Conductor::new(0.2, 3.7).unwrap()));
        comes_back(&RoughConductor::new(moved, Schlick::new(0.04).unwrap()));
        let mixture = UniformMixture::new(AllNormals, alpha).unwrap();
        comes_back(&RoughConductor::new(ggx, Schlick::new(0.04).unwrap()).sampled_by(mixture));
        comes_back(&UniformMixture::new(UniformMixture::new(VisibleNormals, 0.3_f32).unwrap(), 0.7).unwrap());
        comes_back(&Ggx::isotropic(alpha as f32).unwrap());
        let narrow = RoughnessMatrix::rotated(1.0_f32, 1e-3 * alpha as f32, 1.0225885).unwrap();
        comes_back(&Beckmann::from_roughness_matrix(narrow));
    }
}

/// Matrices are tables of one entry, which a bare value of TOML cannot be.
#[test]
fn matrices_come_back_unchanged() {
    for matrix in [RoughnessMatrix::new(0.1, 0.01, 0.2), RoughnessMatrix::rotated(3.0, 1e-9, 2.0)] {
        comes_back(&matrix.unwrap());
    }
}

fn read<S: DeserializeOwned>(text: &str) -> Result<S, String> {
    toml::from_str(text).map_err(|error| error.to_string())
}

/// Every way in which the documentation says that a map may be written.
#[test]
fn maps_are_authored_by_their_widths() {
    let surface = |map: &str| {
        read::<Microsurface<Ggx, Linear<f64>>>(&format!("profile.name = \"ggx\"\n[map]\n{map}")).unwrap()
    };
    let rotated = |x, y, angle| Ggx::from_roughness_matrix(RoughnessMatrix::rotated(x, y, angle).unwrap());
    assert_eq!(surface("alpha = 0.2"), rotated(0.2, 0.2, 0.0));
    assert_eq!(surface("alphas = [0.2, 0.5]"), rotated(0.2, 0.5, 0.0));
    assert_eq!(surface("alphas = [0.2, 0.5]\nangle = 0.7"), rotated(0.2, 0.5, 0.7));
    let of_entries = Ggx::from_roughness_matrix(RoughnessMatrix::new(0.25, 0.125, 1.0).unwrap());
    assert_eq!(surface("matrix = [0.25, 0.125, 1.0]"), of_entries);
    // Both signs of a row give the same RᵀR.
    for factor in ["[0.5, 0.25, 0.75]", "[-0.5, -0.25, 0.75]", "[0.5, 0.25, -0.75]"] {
        let [xx, xy, yy] = surface(&format!("factor = {factor}")).roughness_matrix().unwrap().entries();
        assert_eq!([xx, xy, yy], [0.25, 0.125, 0.625], "{factor}");
    }
    let aligned: Microsurface<Beckmann, AxisAligned<f32>> =
        read("version = 1\nprofile = { name = \"beckmann\" }\nmap = { alpha = 0.25 }").unwrap();
    assert_eq!(aligned, Beckmann::anisotropic(0.25, 0.25).unwrap());
    let gtr: Microsurface<Gtr<f32, Mixture<f32, 8>>, Isotropic<f32>> =
        read("profile = { name = \"gtr\", mask = \"mixture\", alpha = 0.25, gamma = 1.5 }\nmap.alpha = 1.0")
            .unwrap();
    assert_eq!(gtr, Gtr::isotropic(0.25, 1.5).unwrap());
    let brdf: RoughConductor<Microsurface<Ggx, Isotropic<f32>>, Schlick<f32>> = read(
        "surface = { profile.name = \"ggx\", map.alpha = 0.2 }\nfresnel = { name = \"schlick\", f0 = 0.04 }",
    )
    .unwrap();
    assert_eq!(brdf, RoughConductor::new(Ggx::isotropic(0.2).unwrap(), Schlick::new(0.04).unwrap()));
}

/// The file of one distribution is not read as another, nor one that says more or less than it may.
#[test]
fn other_materials_are_refused() {
    type Surface<P> = Microsurface<P, Linear<f64>>;
    fn says<S: DeserializeOwned + core::fmt::Debug>(text: &str, expected: &str) {
        let error = read::<S>(text).unwrap_err();
        assert!(error.contains(expected), "{error}\n{text}");
    }
    let json = serde_json::to_string(&Ggx::isotropic(0.2).unwrap()).unwrap();
    for error in [
        serde_json::from_str::<Microsurface<Beckmann, Isotropic<f64>>>(&json).unwrap_err(),
        serde_json::from_str::<Microsurface<BeckmannTo1e6, Isotropic<f64>>>(&json).unwrap_err(),
    ] {
        assert!(error.to_string().contains("\"ggx\", expected beckmann"), "{error}");
    }
    let bytes = postcard::to_stdvec(&Ggx::isotropic(0.2).unwrap()).unwrap();
    assert!(postcard::from_bytes::<Microsurface<Beckmann, Isotropic<f64>>>(&bytes).is_err());
    let aligned = postcard::to_stdvec(&Ggx::anisotropic(0.2, 0.3).unwrap()).unwrap();
    assert!(postcard::from_bytes::<Microsurface<Ggx, Isotropic<f64>>>(&aligned).is_err());

    let ggx = "profile.name = \"ggx\"\n";
    says::<Surface<Ggx>>(&format!("{ggx}[map]"), "exactly one of");
    says::<Surface<Ggx>>(&format!("{ggx}map = {{ angle = 0.1 }}"), "exactly one of");
    says::<Surface<Ggx>>(&format!("{ggx}map = {{ alpha = 0.1, alphas = [0.1, 0.2] }}"), "exactly one of");
    says::<Surface<Ggx>>(&format!("{ggx}map = {{ alfa = 0.1 }}"), "unknown field `alfa`");
    says::<Surface<Ggx>>(
        "version = 2\nprofile.name = \"ggx\"\nmap.alpha = 0.1",
        "of version 2; this release reads version 1",
    );
    says::<Microsurface<Ggx, Isotropic<f64>>>(
        &format!("{ggx}map.alphas = [0.1, 0.1]"),
        "an isotropic map has alpha",
    );
    says::<Microsurface<Ggx, AxisAligned<f64>>>(
        &format!("{ggx}map = {{ alphas = [0.1, 0.1], angle = 0.0 }}"),
        "has alphas",
    );
    says::<Surface<Gtr<f64, Spline<f64>>>>(
        "profile = { name = \"gtr\", mask = \"mixture\", alpha = 0.25, gamma = 1.5 }\nmap.alpha = 1.0",
        "expected spline",
    );
    says::<RoughConductor<Surface<Ggx>, Schlick<f64>>>(
        "surface = { profile.name = \"ggx\", map.alpha = 0.2 }\nfresnel = { name = \"schlick\", f0 = 0.04 }\n\
         sampling = { name = \"all_normals\" }",
        "visible_normals",
    );
    says::<Schlick<f64>>("name = \"schlick\"\nf0 = 7.5", "reflectance = 7.5 is not");
    says::<Dielectric<f64>>("name = \"schlick\"\neta = 1.5", "expected dielectric");
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
        "0.5",
        "1e300",
        "matrix",
    );
    let authored = "profile.name = \"ggx\"\nmap.matrix = [0.25, 0.75, 1.0]";
    assert!(read::<Surface<Ggx, Linear<f64>>>(authored).unwrap_err().contains("determinant"));
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
