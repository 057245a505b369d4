//! Microfacet BSDF mathematics.
#![no_std]
#[cfg(feature = "std")]
extern crate std;

pub mod elementary;
pub mod real;
pub use real::Real;
