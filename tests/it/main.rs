//! Accuracy, identities and properties.
#![expect(clippy::unwrap_used, reason = "a surface that cannot be built is a failed test")]

mod accuracy;
mod approximations;
mod elementary;
mod readme;
