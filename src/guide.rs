//! The guide: pages to read, with examples that are compiled and tested.
//!
//! | page | for |
//! |---|---|
//! | [`conventions`] | signs, frames, units; what pbrt, Mitsuba and the papers call things |
//! | [`choosing`] | which distribution, which map, which function |
//! | [`path_tracer`] | a material in a path tracer: frames, MIS, textures, two sides |
//! | [`shimmer`] | highlights smaller than a pixel |
//! | [`deforming`] | stretched, sheared and skinned surfaces |
//! | [`batches`] | many directions at once |
//! | [`your_own`] | a distribution of your own |
//! | `testing` (feature `verify`) | a BRDF of your own under the test kit |
//! | [`accuracy`] | how many digits, and what happens at the ends of the domain |
//! | [`costs`] | what a scene pays |

pub mod accuracy;
pub mod batches;
pub mod choosing;
pub mod conventions;
pub mod costs;
pub mod deforming;
pub mod path_tracer;
pub mod shimmer;
#[cfg(feature = "verify")]
pub mod testing;
pub mod your_own;
