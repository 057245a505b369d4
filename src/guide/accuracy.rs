//! How many digits, and what happens at the ends of the domain.
//!
//! Largest relative errors found by a search over α from 1e-6 to 1e3, ratios of α up to 1000 and
//! all directions, against 160-bit arithmetic, in units of ε, f32 / f64 (`cargo
//! test --release --test it search -- --ignored --nocapture`):
//!
//! | | D | σ above | Λ | G1 |
//! |---|---|---|---|---|
//! | GGX | 5.4 / 5.2 | 2.0 / 2.0 | 3.0 / 3.0 | 2.3 / 2.1 |
//! | Beckmann, exponents up to 26 | 4.6 / 85 | 4.0 / 3.8 | 6.0 / 54 | 4.0 / 3.7 |
//! | GTR, closed, γ ≤ 4 | 4.2 / 24 | 7 / 7 | 9 / 9 | 7 / 7 |
//! | GTR, closed, γ ≤ 10 | 4.2 / 24 | 12 / 12 | 28 / 30 | 12 / 13 |
//!
//! The mask of GTR of real γ is within 8e-6 of the exact one ([`gtr::nodes`](crate::gtr::nodes)).
//! Its error against its time, beside the spline of the paper:
#![doc = include_str!("../../docs/gtr_mask.svg")]
//!
//! - **Constructors refuse**: NaN, infinities, singular matrices, α out of
//!   [`alpha_range`](crate::roughness::alpha_range). The [`Error`](crate::Error) names parameter,
//!   value and range. [`clamped`](crate::roughness::clamped) is for those who want a mirror
//!   instead.
//! - **Evaluation never fails**: no panic, no allocation. NaN gives NaN; below the horizon D, G1, f
//!   and pdf are 0.
//! - **No value is negative, no G1 above 1, no sample without a density**, tested by 10⁹
//!   evaluations at horizons, poles, subnormal numbers and both ends of u.
//! - **Below α = 1e-3 in f32** a direction rounded to f32 has another density than before
//!   ([`Sample`](crate::bsdf::Sample) has the table). Take f64, or a mirror.
