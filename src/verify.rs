//! A test kit for distributions and BSDFs of anybody: the identities that they must satisfy, their
//! samplers against their densities, and everything finite (feature `verify`).
//!
//! A BSDF is three closures; no trait of this crate is needed. Ten lines in a renderer's `cargo
//! test`:
//! ```
//! use microsurface::glam::Vec3;
//! use microsurface::verify::{Bsdf, Kit};
//! // A white Lambertian surface, as a renderer has it.
//! let eval = |wi: Vec3, _wo: Vec3| if wi.z > 0.0 { 1.0 / std::f32::consts::PI } else { 0.0 };
//! let pdf = |wi: Vec3, _wo: Vec3| wi.z.max(0.0) / std::f32::consts::PI;
//! let sample = |_wo: Vec3, u: [f32; 2]| {
//!     let (r, (sin, cos)) = (u[0].sqrt(), (6.2831855 * u[1]).sin_cos());
//!     let wi = Vec3::new(r * cos, r * sin, (1.0 - u[0]).max(0.0).sqrt());
//!     Some((wi, 1.0, pdf(wi, wi))) // the direction, f cos/pdf, and the pdf
//! };
//! Kit::new().samples(20_000).bsdf(&Bsdf::new(eval, pdf, sample)).assert();
//! ```
//! [How to read a report](crate::guide::testing) is a page of the guide.
//!
//! # What the kit sees
//! | of a [`Bsdf`] | by |
//! |---|---|
//! | a wrong `pdf` | ∫ pdf against the share of failed samples; χ² and Kolmogorov–Smirnov of the directions; the pdf that a sample returns |
//! | a wrong `eval` | the mean weight against ∫ f cos, by quadrature of `eval` alone; reciprocity; the furnace |
//! | a wrong weight | weight = f cos/pdf |
//! | a wrong frame | symmetry, if the surface is [`isotropic`](Bsdf::isotropic) |
//! | NaN, ∞, negative values, panics | some ten thousand arguments at horizons, poles, wi ≈ ±wo, both ends of u, and slightly too long |
//!
//! | of a distribution | by |
//! |---|---|
//! | a wrong constant of D | ∫ D cos = 1 |
//! | a wrong mask | ∫ D max(0, w·m) = σ, the weak white furnace in both forms, ∫ D_w = 1 |
//! | a wrong Λ, G1, G2, P22 | their definitions |
//! | a wrong sampler | as for a BSDF |
//!
//! # Verdicts
//! Integrals are adaptive and bound their own error. Where the bound is too large to tell right
//! from wrong the verdict is [`Undecided`](Verdict::Undecided), and [`Report::assert`] panics as it
//! does for a failure: what was not tested has not passed.
//!
//! All statistical checks of a report together reject a right subject with the probability
//! [`false_alarms`](Kit::false_alarms), 1e-4 unless changed. Seeds are fixed: a test that passes
//! does so always.

mod arguments;
mod bsdf;
mod cell_map;
mod directions;
mod distribution;
mod float;
mod integral;
mod jacobian;
mod report;
mod scattering;
mod sphere;
pub mod statistics;
#[cfg(feature = "proptest")]
pub mod strategies;

pub use arguments::Arguments;
pub use bsdf::{Bsdf, Sides};
pub use float::Float;
pub use report::{Check, Report, Verdict};

use rand_pcg::Pcg64Mcg;

/// The effort of the checks, and what they allow.
///
/// # Example
/// ```
/// use microsurface::Ggx;
/// use microsurface::verify::Kit;
/// let surface = Ggx::anisotropic(0.1_f64, 0.4)?;
/// let kit = Kit::new().samples(20_000);
/// kit.ndf(&surface).and(kit.normals(&surface)).and(kit.visible_normals(&surface)).assert();
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Kit {
    samples: usize,
    seed: u64,
    false_alarms: f64,
    tolerance: Option<f64>,
    angles: &'static [f64],
    merciless: bool,
    progress: bool,
}

impl Default for Kit {
    fn default() -> Self {
        Self::new()
    }
}

impl Kit {
    /// 100,000 samples from each angle, 20,000 arguments for what must hold at every one.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            samples: 100_000,
            seed: 1,
            false_alarms: 1e-4,
            tolerance: None,
            angles: &[0.0, 30.0, 60.0, 80.0],
            merciless: false,
            progress: false,
        }
    }

    /// The samples drawn from each angle; at least 5,000 make sense. An error that 100,000 just
    /// find is three times smaller with a million.
    ///
    /// # Panics
    /// With none.
    #[must_use]
    pub const fn samples(self, samples: usize) -> Self {
        assert!(samples > 0, "without samples nothing can be tested");
        Self { samples, ..self }
    }

    /// Other random numbers.
    #[must_use]
    pub const fn seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// The probability that a right subject fails one of the statistical checks of a report.
    ///
    /// # Panics
    /// Unless it is in (0, 1).
    #[must_use]
    pub const fn false_alarms(self, probability: f64) -> Self {
        assert!(probability > 0.0 && probability < 1.0, "a probability of false alarms in (0, 1)");
        Self { false_alarms: probability, ..self }
    }

    /// The relative deviation of an identity that is allowed: 1e-6 for f64 and 2e-5 for f32 unless
    /// changed. A distribution with a fitted mask needs more.
    #[must_use]
    pub const fn allowing(self, relative: f64) -> Self {
        Self { tolerance: Some(relative), ..self }
    }

    /// The angles of the views from the normal in degrees, of random azimuth.
    ///
    /// # Panics
    /// With none.
    #[must_use]
    pub const fn angles(self, degrees: &'static [f64]) -> Self {
        assert!(!degrees.is_empty(), "without a view nothing can be tested");
        Self { angles: degrees, ..self }
    }

    /// Arguments down to the smallest subnormal components, where the squares of renderers' code
    /// leave the range of the scalar.
    #[must_use]
    pub const fn merciless(self) -> Self {
        Self { merciless: true, ..self }
    }

    /// Says on stderr which sampler is being drawn from.
    #[must_use]
    pub const fn showing_progress(self) -> Self {
        Self { progress: true, ..self }
    }

    fn tolerance<T: Float>(&self) -> f64 {
        // For f64 what quadrature reaches at little cost. For f32 168 roundings, 2e-5: a function of
        // a rounded direction has some five to ten of them, and a weight is made of several.
        self.tolerance.unwrap_or((168.0 * T::EPSILON.to_f64()).max(1e-6))
    }

    /// The relative error that rounding gives to a dot product of this size: three products and two
    /// sums of at most 1, half an ε each.
    fn rounding_of<T: Float>(cosine: f64) -> f64 {
        2.5 * T::EPSILON.to_f64() / cosine.abs()
    }

    fn arguments(&self, stream: u64) -> Arguments<Pcg64Mcg> {
        let state = u128::from(self.seed) << 64 | u128::from(stream.wrapping_mul(2) | 1);
        let arguments = Arguments::new(Pcg64Mcg::new(state));
        if self.merciless { arguments.merciless() } else { arguments }
    }

    /// The views, rounded to the scalar.
    fn views<T: Float>(&self, arguments: &mut Arguments<Pcg64Mcg>) -> alloc::vec::Vec<[T; 3]> {
        let view = |degrees: &f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let (y, x) = arguments.within(0.0, core::f64::consts::TAU).sin_cos();
            [sin * x, sin * y, cos].map(T::lit)
        };
        self.angles.iter().map(view).collect()
    }
}

/// How many arguments the checks of single values take.
const ARGUMENTS: usize = 20_000;
