//! Statistical tests: every sampler against its density, by χ² and Kolmogorov–Smirnov, with
//! negative controls.
//!
//! Seeds are fixed, so that a run repeats to the last bit on one platform. Plain `cargo test` draws
//! 1e5 samples a case, which resolves 3 % of α. The long forms, of 1e7 samples, all widths at all
//! angles and random maps, are run by `cargo test --test
//! stat -- --ignored --nocapture --test-threads 1`, and say on stderr how far they are.

mod chart;
mod chi_square;
mod conductor;
mod family;
mod gtr_rejection;
mod gtr_visible;
mod ks;
mod mixture;
mod normals;
mod points;
mod quadrature;
#[path = "../surfaces/mod.rs"]
#[expect(dead_code, reason = "not every crate reads every column")]
mod rows;
mod special;
mod stratification;
mod surfaces;
mod transformed;
mod visible;
