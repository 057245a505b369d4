//! Accuracy, identities and properties.
#![expect(clippy::unwrap_used, reason = "a surface that cannot be built is a failed test")]
#![expect(clippy::float_cmp, reason = "what is documented as exact is compared exactly")]
#![expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts and random bits become numbers"
)]
#![expect(clippy::std_instead_of_alloc, reason = "tests have std")]

mod accuracy;
mod approximations;
mod bad_input;
mod blend;
mod elementary;
mod ends;
mod filter;
mod floors;
mod hammer;
mod identities;
mod properties;
mod quadrature;
#[path = "../random/mod.rs"]
#[expect(dead_code, reason = "not every crate draws everything")]
mod random;
mod readme;
mod reflection;
mod roughness;
#[path = "../surfaces/mod.rs"]
#[expect(dead_code, reason = "not every crate reads every column")]
mod rows;
mod scalar;
mod stored;
mod strategies;
mod student_t;
mod surfaces;
mod transform;
mod worst;
