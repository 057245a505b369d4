//! Testing a BRDF of your own, and reading what the kit says.
//!
//! The module `verify` (feature `verify`) tests distributions and BSDFs of anybody. In a renderer:
//! ```toml
//! [dev-dependencies]
//! microsurface = { version = "0.1", features = ["verify"] }
//! ```
//! A BSDF is three closures, over glam's vectors or arrays of f32 or f64: `eval` is f without the
//! cosine, `pdf` is by solid angle, and `sample` gives a direction, its weight f cos/pdf and its
//! pdf. Here a Phong lobe, as a test of a renderer would have it:
//! ```
//! use microsurface::glam::DVec3;
//! use microsurface::verify::{Bsdf, Kit};
//! const N: f64 = 20.0;
//! const TAU: f64 = std::f64::consts::TAU;
//! let lobe = |wi: DVec3, wo: DVec3| wi.dot(DVec3::new(-wo.x, -wo.y, wo.z)).max(0.0).powf(N);
//! let pdf = |wi: DVec3, wo: DVec3| if wi.z > 0.0 { (N + 1.0) / TAU * lobe(wi, wo) } else { 0.0 };
//! let eval = |wi: DVec3, wo: DVec3| if wi.z > 0.0 { (N + 2.0) / TAU * lobe(wi, wo) } else { 0.0 };
//! let sample = |wo: DVec3, u: [f64; 2]| {
//!     let mirror = DVec3::new(-wo.x, -wo.y, wo.z);
//!     let (x, y) = mirror.any_orthonormal_pair();
//!     let cos = u[0].powf(1.0 / (N + 1.0));
//!     let (r, (s, c)) = ((1.0 - cos * cos).sqrt(), (TAU * u[1]).sin_cos());
//!     let wi = r * c * x + r * s * y + cos * mirror;
//!     let pdf = pdf(wi, wo);
//!     (pdf > 0.0).then(|| (wi, eval(wi, wo) * wi.z / pdf, pdf))
//! };
//! let report = Kit::new().bsdf(&Bsdf::new(eval, pdf, sample).isotropic());
//! report.assert();
//! ```
//!
//! # Reading a report
//! [`Report::assert`](crate::verify::Report::assert) panics with a table: a line for each check,
//! with the worst that was seen, what is allowed, and where. Of several views it shows the worst.
//!
//! | what fails | look at |
//! |---|---|
//! | χ² and both KS, ∫ pdf does not | the sampler draws from another distribution than `pdf`: another α, another frame |
//! | KS of the azimuth, hardly that of the distance | a turned or mirrored frame, axes exchanged |
//! | ∫ pdf | a constant or a Jacobian: 1/(4 wo·h), 1/π, α for α² |
//! | ∫ pdf, only from grazing views | samples below the horizon that are kept, or a pdf that misses G1 |
//! | mean weight and weight, not χ² | `eval`: another G, another D, separable against correlated |
//! | mean weight alone | weight, `eval` and `pdf` agree where samples fall; `eval` has light where none fall |
//! | the furnace | `eval` reflects more than it gets |
//! | reciprocity | G or F of one direction; η inverted |
//! | turned and mirrored | a half vector or tangent of the wrong sign |
//! | finite, or every sample usable | the input that is printed, in decimal and in bits: paste it into a test |
//!
//! Below the table a χ² that failed has a map of its cells: rows from the peak of the lobe
//! outwards, columns around it, `+` and `#` where there are too many samples, `-` and `=` where there are too
//! few. Too many in the last rows are a tail; alternating columns are a turned lobe.
//!
//! "Undecided" means that the kit could not integrate the function to the precision it needs: a
//! noisy or discontinuous `pdf`, or that a few samples make the mean weight. It is no pass. In f32
//! the pdf of a lobe narrower than some 0.003 is noise at grazing angles, because directions are
//! rounded: test the same code in f64, and f32 against it by
//! [`Kit::precision`](crate::verify::Kit::precision).
//!
//! # How small an error is found
//! The smallest error of a GGX of α = (0.1, 0.4) from 60° that each check finds, with 10⁵, 10⁶ and
//! 10⁷ samples (`cargo run --release --features verify --example check_brdf -- --sensitivity`, five
//! minutes):
//!
//! | | χ² | KS, distance | KS, azimuth | ∫ pdf | mean weight |
//! |---|---|---|---|---|---|
//! | α off, % | 3.5, 0.9, 0.3 | 1.3, 0.4, 0.2 | 5, 1.8, 0.6 | 3.5, 1.3, 0.6 | 2.5, 0.6, 0.3 |
//! | `eval` and `pdf` times a constant, % | 1.3, 0.4, 0.08 | 1.3, 0.3, 0.08 | 1.3, 0.3, 0.08 | 0.6, 0.2, 0.06 | 0.6, 0.2, 0.06 |
//! | the frame turned, degrees | 0.7, 0.25, 0.06 | 1.4, 0.5, 0.25 | 0.5, 0.13, 0.04 | –, 16, 4 | –, 8, 4 |
//! | a share of G1 left out, % | 20, 5, 1.3 | 14, 5, 1.3 | 14, 5, 1.3 | 7, 2.5, 0.6 | 10, 2.5, 0.6 |
//!
//! The same surface without an error is rejected from 37 of 1000 seeds at a stated rate of 5 %.
//!
//! `cargo run --release --features verify --example check_brdf` shows the kit on eleven mistakes of
//! practice.
