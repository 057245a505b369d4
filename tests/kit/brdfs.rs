//! BSDFs: those of the crate, others', and one fault for each check.

use core::f64::consts::{FRAC_1_PI, PI, TAU};

use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::fresnel::Perfect;
use microsurface::glam::{DVec2, DVec3, Vec2, Vec3};
use microsurface::verify::{Bsdf, Kit, Report, Sides};
use microsurface::{Beckmann, Ggx, Gtr, Linear, Microsurface};

use crate::assert_rejected;

fn of_conductor<S: NormalSampling<Microsurface<Ggx, Linear<f64>>>>(kit: &Kit, sampling: S) -> Report {
    let surface = Ggx::rotated(0.5, 0.15, 0.4).unwrap();
    let brdf = RoughConductor::new(surface, Perfect::<f64>::new()).sampled_by(sampling);
    kit.bsdf(&Bsdf::new(
        |wi: DVec3, wo: DVec3| brdf.eval(wi, wo),
        |wi, wo| brdf.pdf(wi, wo),
        |wo, u: [f64; 2]| brdf.sample(wo, DVec2::from(u)).map(|s| (s.wi, s.weight, s.pdf)),
    ))
}

#[test]
fn conductors_pass() {
    of_conductor(&Kit::new().merciless(), VisibleNormals).assert();
    // At subnormal cosines the density of reflection by all normals is documented to overflow.
    of_conductor(&Kit::new(), UniformMixture::new(AllNormals, 0.4).unwrap()).assert();
}

/// Narrow and of heavy tails, in f32.
#[test]
fn conductors_in_single_precision_pass() {
    macro_rules! passes {
        ($surface:expr) => {
            let brdf = RoughConductor::new($surface, Perfect::<f32>::new());
            let report = Kit::new().merciless().bsdf(
                &Bsdf::new(
                    |wi: Vec3, wo: Vec3| brdf.eval(wi, wo),
                    |wi, wo| brdf.pdf(wi, wo),
                    |wo, u: [f32; 2]| brdf.sample(wo, Vec2::from(u)).map(|s| (s.wi, s.weight, s.pdf)),
                )
                .isotropic(),
            );
            assert!(report.passed(), "{:?}\n{report}", $surface);
        };
    }
    passes!(Ggx::isotropic(0.3_f32).unwrap());
    passes!(Ggx::isotropic(1e-2_f32).unwrap());
    passes!(Beckmann::isotropic(0.1_f32).unwrap());
    passes!(Gtr::closed::<1>(0.1_f32).unwrap());
}

#[test]
fn precision_is_compared() {
    let (single, double) = (Ggx::isotropic(0.05_f32).unwrap(), Ggx::isotropic(f64::from(0.05_f32)).unwrap());
    let (single, double) = (
        RoughConductor::new(single, Perfect::<f32>::new()),
        RoughConductor::new(double, Perfect::<f64>::new()),
    );
    let none = |_: Vec3, _: [f32; 2]| None;
    let of_single = Bsdf::new(|wi: Vec3, wo: Vec3| single.eval(wi, wo), |wi, wo| single.pdf(wi, wo), none);
    let exact = Bsdf::new(
        |wi: DVec3, wo: DVec3| double.eval(wi, wo),
        |wi, wo| double.pdf(wi, wo),
        |_: DVec3, _: [f64; 2]| None,
    );
    Kit::new().precision(&of_single, &exact).assert();
    // D by 1 − z², as shaders have it.
    let a2 = 0.05_f32 * 0.05;
    let naive = |wi: Vec3, wo: Vec3| {
        let h = (wi + wo).normalize();
        let t = 1.0 - (1.0 - a2) * h.z * h.z;
        single.eval(wi, wo) / double.surface().d_of(h) * a2 / (core::f32::consts::PI * t * t)
    };
    let of_naive = Bsdf::new(naive, |wi: Vec3, wo: Vec3| single.pdf(wi, wo), none);
    assert_rejected("1 − z²", &Kit::new().precision(&of_naive, &exact), &["f in f32 against f64"]);
}

/// The sampler of another frame: turned by 3 degrees, and mirrored.
#[test]
fn other_frames_are_found() {
    let brdf = RoughConductor::new(Ggx::anisotropic(0.1, 0.4).unwrap(), Perfect::<f64>::new());
    let (sin, cos) = 3_f64.to_radians().sin_cos();
    let turned = move |w: DVec3| DVec3::new(cos * w.x - sin * w.y, sin * w.x + cos * w.y, w.z);
    let mirrored = |w: DVec3| DVec3::new(w.x, -w.y, w.z);
    let report = |to: &dyn Fn(DVec3) -> DVec3, back: &dyn Fn(DVec3) -> DVec3| {
        Kit::new().angles(&[60.0]).bsdf(&Bsdf::new(
            |wi: DVec3, wo: DVec3| brdf.eval(wi, wo),
            |wi, wo| brdf.pdf(wi, wo),
            |wo, u: [f64; 2]| brdf.sample(to(wo), DVec2::from(u)).map(|s| (back(s.wi), s.weight, s.pdf)),
        ))
    };
    let azimuth = "sample against pdf, azimuth, KS";
    let report_of_turned = report(&turned, &|w| {
        let (x, y) = (cos * w.x + sin * w.y, -sin * w.x + cos * w.y);
        DVec3::new(x, y, w.z)
    });
    assert_rejected("turned", &report_of_turned, &["sample against pdf, χ²", azimuth]);
    // A mirrored frame that is mirrored back is the same; that is not, is not.
    report(&mirrored, &mirrored).assert();
    assert_rejected("mirrored", &report(&mirrored, &|w| w), &["sample against pdf, χ²", azimuth]);
}

trait D {
    fn d_of(&self, h: Vec3) -> f32;
}

impl D for Microsurface<Ggx, microsurface::Isotropic<f64>> {
    #[expect(clippy::cast_possible_truncation, reason = "to the scalar that is compared")]
    fn d_of(&self, h: Vec3) -> f32 {
        microsurface::Ndf::d(self, h.as_dvec3()) as f32
    }
}

/// A direction of density cos/π.
fn cosine(u: [f64; 2]) -> DVec3 {
    let (r, (sin, cos)) = (u[0].sqrt(), (TAU * u[1]).sin_cos());
    DVec3::new(r * cos, r * sin, (1.0 - u[0]).sqrt())
}

fn cosine_pdf(wi: DVec3) -> f64 {
    wi.z.max(0.0) * FRAC_1_PI
}

/// A fault of a grey Lambertian surface.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    None,
    Brighter,
    Pdf,
    ReturnedPdf,
    Weight,
    NotReciprocal,
    Turned,
    AboveOne,
    Negative,
    NanWhenLong,
    Below,
    Fails,
}

fn lambertian(fault: Fault) -> Report {
    let eval = move |wi: DVec3, wo: DVec3| {
        let f = if wi.z > 0.0 && wo.z > 0.0 { 0.5 * FRAC_1_PI } else { 0.0 };
        match fault {
            Fault::Brighter => 1.02 * f,
            Fault::AboveOne => 2.1 * f,
            Fault::NotReciprocal => f * (0.5 + wi.z),
            Fault::Turned => f * (1.0 + 0.1 * (wi.x * wo.y - wi.y * wo.x)),
            Fault::Negative if wi.z < 1e-4 => -f,
            // √(1 − z²) of what is longer than 1.
            Fault::NanWhenLong => f * (1.0 + 0.0 * (1.0 - wi.length_squared() + 2e-16).sqrt()),
            _ => f,
        }
    };
    let pdf = move |wi: DVec3, _: DVec3| match fault {
        Fault::Pdf if wi.z > 0.0 => 0.5 / PI,
        _ => cosine_pdf(wi),
    };
    let sample = move |wo: DVec3, u: [f64; 2]| {
        let mut wi = cosine(u);
        if wo.z <= 0.0 || wi.z <= 0.0 || fault == Fault::Fails && u[0] < 0.02 {
            return None;
        }
        if fault == Fault::Below && u[0] > 0.99 {
            wi.z = -wi.z;
        }
        let returned = pdf(wi, wo) * if fault == Fault::ReturnedPdf { wi.z } else { 1.0 };
        let weight = eval(wi, wo) * wi.z / pdf(wi, wo) * if fault == Fault::Weight { 1.01 } else { 1.0 };
        Some((wi, weight, returned))
    };
    Kit::new().bsdf(&Bsdf::new(eval, pdf, sample).isotropic())
}

#[test]
fn every_check_has_a_fault_that_it_finds() {
    let cases: [(Fault, &[&str]); 11] = [
        // The weight is that of this eval: nothing is inconsistent.
        (Fault::AboveOne, &["∫ f |cos| ≤ 1 (furnace)"]),
        (Fault::Pdf, &["sample against pdf, χ²", "sample against pdf, distance from the peak, KS"]),
        (Fault::ReturnedPdf, &["the pdf of a sample is pdf at it"]),
        (Fault::Weight, &["the weight of a sample is f cos/pdf", "mean weight = ∫ f |cos|"]),
        (Fault::NotReciprocal, &["f(wi, wo) = f(wo, wi), with η² if transmitted"]),
        (Fault::Turned, &["f turned and mirrored is f"]),
        (Fault::Negative, &["f and pdf finite and not negative"]),
        (Fault::NanWhenLong, &["the same of vectors 3 ε too long or short"]),
        (Fault::Below, &["samples: unit vectors with a pdf"]),
        (Fault::Fails, &["∫ pdf = the share of samples that are", "mean weight = ∫ f |cos|"]),
        (Fault::None, &[]),
    ];
    for (fault, names) in cases {
        let report = lambertian(fault);
        assert_rejected(&format!("{fault:?}"), &report, names);
        assert_eq!(report.passed(), fault == Fault::None, "{fault:?}\n{report}");
    }
    lambertian(Fault::Brighter).assert();
}

/// As a measured BRDF comes: a table over the angle of the half vector, sampled by cosines.
#[test]
fn a_table_passes() {
    let table = [4.0, 3.0, 1.2, 0.5, 0.2, 0.1, 0.06, 0.05, 0.05, 0.05];
    let eval = move |wi: DVec3, wo: DVec3| {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let h = (wi + wo).normalize();
        let at = 9.0 * h.z.clamp(0.0, 1.0).acos() / (0.5 * PI);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
        let i = (at as usize).min(8);
        let t = at - f64::from(u8::try_from(i).unwrap());
        0.2 * (table[i] * (1.0 - t) + table[i + 1] * t)
    };
    let report = Kit::new().bsdf(
        &Bsdf::new(
            eval,
            |wi: DVec3, _: DVec3| cosine_pdf(wi),
            |wo: DVec3, u: [f64; 2]| {
                let wi = cosine(u);
                (wi.z > 0.0 && wo.z > 0.0).then(|| (wi, eval(wi, wo) * PI, cosine_pdf(wi)))
            },
        )
        .isotropic()
        .seen_from(Sides::Above),
    );
    report.assert();
}
