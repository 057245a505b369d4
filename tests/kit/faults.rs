//! Distributions with one fault each: the check that is there for it rejects it.

use microsurface::glam::{DVec2, DVec3};
use microsurface::verify::Kit;
use microsurface::{AxisAligned, Ggx, Microsurface, Ndf, SampleNdf, SampleVndf};

use crate::assert_rejected;

/// A fault of a GGX surface.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    None,
    /// D 1 % too large.
    Constant,
    /// The mask of an α 1 % too large.
    MaskTooWide,
    /// Λ, G1 not those of σ.
    Lambda,
    G1,
    /// G2 above G1.
    G2,
    /// D of a half vector is not homogeneous.
    Along,
    NegativeBelow,
    NanAtTheHorizon,
    P22,
    Vndf,
    /// α of a sampler 5 % too large.
    Sampler,
    /// Samples are turned by 6 degrees.
    Turned,
    /// One sample in a thousand is below the horizon, or not of unit length.
    Below,
    Long,
    /// pdf_d is not D cos.
    PdfOfNormals,
}

struct Faulty(Fault);

fn surface(scale: f64) -> Microsurface<Ggx, AxisAligned<f64>> {
    Ggx::anisotropic(0.2 * scale, 0.5 * scale).unwrap()
}

impl Ndf for Faulty {
    type Scalar = f64;

    fn d(&self, wm: DVec3) -> f64 {
        match self.0 {
            Fault::Constant => 1.01 * surface(1.0).d(wm),
            Fault::NegativeBelow if wm.z < 0.0 => -1e-3,
            Fault::NanAtTheHorizon if wm.z == 0.0 => f64::NAN,
            _ => surface(1.0).d(wm),
        }
    }

    fn sigma(&self, w: DVec3) -> f64 {
        surface(if self.0 == Fault::MaskTooWide { 1.01 } else { 1.0 }).sigma(w)
    }

    fn d_along(&self, h: DVec3) -> f64 {
        if self.0 == Fault::Along { self.d(h) } else { self.d(h.normalize()) }
    }

    fn lambda(&self, w: DVec3) -> f64 {
        let lambda = self.sigma(w) / w.z - 1.0;
        if self.0 == Fault::Lambda { 1.001 * lambda } else { lambda }
    }

    fn g1(&self, w: DVec3, wm: DVec3) -> f64 {
        let g1 = if w.dot(wm) > 0.0 && w.z > 0.0 { w.z / self.sigma(w) } else { 0.0 };
        if self.0 == Fault::G1 { g1 * g1 } else { g1 }
    }

    fn g2(&self, wi: DVec3, wo: DVec3, wm: DVec3) -> f64 {
        let g2 = surface(1.0).g2(wi, wo, wm);
        if self.0 == Fault::G2 { g2.sqrt() } else { g2 }
    }

    fn p22(&self, slope: DVec2) -> f64 {
        surface(1.0).p22(if self.0 == Fault::P22 { DVec2::new(slope.y, slope.x) } else { slope })
    }

    fn vndf(&self, w: DVec3, wm: DVec3) -> f64 {
        let facing = w.dot(wm);
        let vndf = if facing > 0.0 { facing * self.d(wm) / self.sigma(w) } else { 0.0 };
        // Heitz 2014 has it with w.z for σ.
        if self.0 == Fault::Vndf { vndf * self.sigma(w) / w.z.abs().max(1e-9) } else { vndf }
    }
}

impl Faulty {
    fn scale(&self) -> f64 {
        if self.0 == Fault::Sampler { 1.05 } else { 1.0 }
    }

    fn spoiled(&self, m: DVec3, u: DVec2) -> DVec3 {
        match self.0 {
            Fault::Turned => {
                let (sin, cos) = 6_f64.to_radians().sin_cos();
                DVec3::new(cos * m.x - sin * m.y, sin * m.x + cos * m.y, m.z)
            }
            Fault::Below if u.x < 1e-3 => DVec3::new(m.x, m.y, -m.z),
            Fault::Long if u.x < 1e-3 => 1.01 * m,
            _ => m,
        }
    }
}

impl SampleNdf for Faulty {
    fn sample_d(&self, u: DVec2) -> DVec3 {
        self.spoiled(surface(self.scale()).sample_d(u), u)
    }

    fn pdf_d(&self, wm: DVec3) -> f64 {
        if self.0 == Fault::PdfOfNormals { self.d(wm) } else { self.d(wm) * wm.z }
    }
}

impl SampleVndf for Faulty {
    fn sample_vndf(&self, w: DVec3, u: DVec2) -> DVec3 {
        self.spoiled(surface(self.scale()).sample_vndf(w, u), u)
    }
}

const NORMALISED: &str = "∫ D cos = 1";
const AREA: &str = "∫ D max(0, w·m) = σ(w)";
const FURNACE: &str = "∫ G1 D max(0, w·m) = w.z (weak white furnace)";
const REFLECTED: &str = "∫ D(h) G1/(4 w.z) dwi = 1 (the same, over wi)";
const VISIBLE: &str = "∫ D_w = 1";
const FINITE: &str = "D, σ, P22, D_w finite, not negative, 0 below";
const RANGE: &str = "0 ≤ G2 ≤ G1 ≤ 1, G2 reciprocal, σ ≥ w.z";
const DEFINITIONS: &str = "Λ, G1, G2, D_w by σ, D along h";

#[test]
fn faults_of_functions_are_found() {
    let kit = Kit::new();
    let cases: [(Fault, &[&str]); 11] = [
        (Fault::Constant, &[NORMALISED, AREA, FURNACE, REFLECTED, VISIBLE]),
        (Fault::MaskTooWide, &[AREA, FURNACE, REFLECTED, VISIBLE]),
        (Fault::Lambda, &[DEFINITIONS]),
        (Fault::G1, &[FURNACE, REFLECTED, DEFINITIONS]),
        (Fault::G2, &[RANGE, DEFINITIONS]),
        (Fault::Along, &[DEFINITIONS]),
        (Fault::NegativeBelow, &[FINITE]),
        (Fault::NanAtTheHorizon, &[FINITE]),
        (Fault::P22, &["P22 = D wm.z⁴"]),
        (Fault::Vndf, &[VISIBLE, DEFINITIONS]),
        (Fault::None, &[]),
    ];
    for (fault, names) in cases {
        let report = kit.ndf(&Faulty(fault));
        assert_rejected(&format!("{fault:?}"), &report, names);
        assert_eq!(report.passed(), fault == Fault::None, "{fault:?}\n{report}");
    }
}

#[test]
fn faults_of_samplers_are_found() {
    let kit = Kit::new().samples(50_000);
    let all = [
        "sample_d: unit vectors with a density",
        "sample_d against pdf_d, χ²",
        "sample_d, distance from the peak, KS",
        "sample_d, azimuth, KS",
        "∫ pdf_d = 1",
    ];
    let visible = [
        "sample_vndf: unit vectors with a density",
        "sample_vndf against vndf, χ²",
        "sample_vndf, distance from the peak, KS",
        "sample_vndf, azimuth, KS",
        "∫ vndf = 1",
    ];
    let cases: [(Fault, &[usize]); 5] = [
        (Fault::Sampler, &[1, 2]),
        (Fault::Turned, &[1, 3]),
        (Fault::Below, &[0]),
        (Fault::Long, &[0]),
        (Fault::Constant, &[4]),
    ];
    for (fault, indices) in cases {
        let (of_all, of_visible) = (kit.normals(&Faulty(fault)), kit.visible_normals(&Faulty(fault)));
        let names = |list: &[&'static str]| indices.iter().map(|&i| list[i]).collect::<Vec<_>>();
        assert_rejected(&format!("{fault:?}"), &of_all, &names(&all));
        // What is seen of the constant of D is the same with every σ but the right one.
        assert_rejected(&format!("{fault:?}"), &of_visible, &names(&visible));
    }
    assert_rejected("pdf", &kit.normals(&Faulty(Fault::PdfOfNormals)), &["pdf_d = D wm.z", "∫ pdf_d = 1"]);
    kit.normals(&Faulty(Fault::None)).and(kit.visible_normals(&Faulty(Fault::None))).assert();
}
