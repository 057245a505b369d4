//! Nanoseconds per call, one file per question.
//!
//! ```text
//! cargo bench --bench bench                        # everything, about a quarter of an hour
//! cargo bench --bench bench -- --quick reflection  # one question, roughly
//! RUSTFLAGS="-C target-cpu=native" cargo bench --bench bench -- batch
//! ```
//!
//! Every group holds one scalar type and compares within itself: profiles, maps, and the textbook's
//! forms ([`textbook`]) beside the crate's. Only ratios within one run mean anything.
//!
//! Outside [`batch`] and [`scaling`] a *scalar call* is measured: the function is inlined into a
//! loop over 4096 arguments held as vectors, the material changes from call to call so that nothing
//! of it is hoisted, and every result goes through `black_box` by itself, so that no call can be
//! merged with its neighbour into vector code. Neighbouring calls still overlap in the processor,
//! as they do in a renderer.

use criterion::{criterion_group, criterion_main};

mod batch;
mod distribution;
mod filter;
mod input;
mod mask;
mod reflection;
#[path = "../../tests/surfaces/mod.rs"]
#[expect(dead_code, reason = "not every crate reads every column")]
mod rows;
mod scaling;
mod textbook;
mod visible_normals;

criterion_group! {
    name = questions;
    config = criterion::Criterion::default()
        .warm_up_time(core::time::Duration::from_millis(300))
        .measurement_time(core::time::Duration::from_secs(1));
    targets = distribution::bench, mask::bench, visible_normals::bench, reflection::bench, batch::bench,
            filter::bench, scaling::bench
}
criterion_main!(questions);
