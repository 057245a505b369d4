//! Elementary functions, branch-free.
//!
//! Each function is straight-line arithmetic with selects in place of branches: no calls but the
//! square root, no table lookups. A plain loop over a slice therefore becomes vector code, and the
//! result of a lane does not depend on its neighbours. One generic body serves f32 and f64; only
//! the coefficients differ (`coefficients/`), and beside each table stands the error of the
//! approximant.
//!
//! Errors are stated in ulp of the exact result (f64) or of the result of the same function in f64
//! (f32), as measured by the crate's tests, which fail when a statement becomes wrong or twice too
//! pessimistic. NaN gives NaN everywhere.
//!
//! # Cost
//! A function costs the sum of everything it may need, whatever its argument:
//!
//! | function | divisions | square roots | contains |
//! |---|---|---|---|
//! | [`exp`], [`exp2`], [`exp_m1`], [`exp_neg_square`], [`sin_cos_turns`] | 0 | 0 | |
//! | [`exp_wide`] | 0 | 0 | range reduction in f64 |
//! | [`ln`], [`log2`], [`ln_1p`], [`ln_wide`] | 1 | 0 | |
//! | [`pow_wide`] | 1 | 0 | a logarithm and an exponential |
//! | [`erf`], [`ierfcx`], [`atan2`] | 1 | 0 | |
//! | [`erfc`], [`erfcx`] | 1 | 0 | an exponential |
//! | [`erf_inv`], [`erfc_inv`] | 2 | 1 | a logarithm |

pub(crate) mod bits;
pub(crate) mod chebyshev;
mod coefficients;
mod erf;
mod erf_inv;
mod erfcx;
pub(crate) mod exact;
mod exp;
mod log;
pub(crate) mod polynomial;
mod trig;

pub use erf::{erf, erfc};
pub use erf_inv::{erf_inv, erfc_inv};
pub(crate) use erf_inv::{erfc_inv_inside, erfc_inv_inside_wide};
pub(crate) use erfcx::ierfcx_near;
pub use erfcx::{erfcx, ierfcx};
pub use exp::{exp, exp_m1, exp_neg_square, exp_wide, exp2};
pub(crate) use exp::{exp_normal, exp_normal_wide};
pub(crate) use log::{inverse_power_of_ratio, inverse_root, ln_normal};
pub use log::{ln, ln_1p, ln_wide, log2, pow_wide};
pub(crate) use trig::sin_cos_of_turn;
pub use trig::{atan2, sin_cos_turns};
