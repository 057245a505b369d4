//! The cost of a scene: it pays for what it uses.
//!
//! The map is a type, so an isotropic surface has no operation of an anisotropic one. A surface
//! that was transformed or filtered by A + 2Σ costs what its map costs, to the instruction.
//! Instructions of one call, f32, x86-64, Schlick's Fresnel term of one channel (`cargo
//! run --release --example cost`):
//!
//! | | bytes: isotropic, axis-aligned, linear | eval | sample |
//! |---|---|---|---|
//! | GGX | 12, 24, 32 | 90, 98, 122 | 200, 197, 223 |
//! | Beckmann | 12, 24, 32 | 229, 234, 248 | 973, 970, 1000 |
//! | GTR, γ = 1.5, 8 nodes | 800, 808, 816 | 305, 314, 331 | 1026, 1016, 1053 |
//!
//! - Schlick takes 17 of these instructions, the exact conductor 84, and 254 in RGB.
//! - Constructors do what a material fixes: a GTR of real γ takes about 8 µs to build, GGX nothing.
//!   For textures of GTR take [`GtrTable`](crate::gtr::table::GtrTable).
//! - Batches are compiled for three levels of vectors, for each type of material, into the caller's
//!   crate; a program that uses two of each of fifteen types spends most of its code on them.
//!
#![doc = include_str!("../../docs/batch.svg")]
//!
//! `cargo run --release --example pareto` sets time against error for every choice there is.
