//! Searches for the worst error over a whole domain, where a table has chosen points only.
//!
//! The short form runs with the other tests. The long form prints what it finds:
//! `cargo test --release --test it search -- --ignored --nocapture`

pub(crate) mod climb;
mod distributions;
mod exact;
mod fresnel;
mod oracle;
mod projected;

use climb::Effort;

/// The effort of every `cargo test`.
pub(crate) const SHORT: Effort = Effort { starts: 1_000, moves: 30, finalists: 20 };
/// The effort behind the bounds of the documentation.
pub(crate) const LONG: Effort = Effort { starts: 40_000, moves: 60, finalists: 400 };
