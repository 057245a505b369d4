//! Many directions at once, as structure of arrays: the entry points of wavefront renderers.
//!
//! Every method takes slices and does for each element what the method of the same name without
//! `_batch` does for one: the same body, inlined into a loop over blocks that the compiler turns
//! into vector code. A renderer that has sorted its hits by material calls the methods on the
//! material; one whose material changes from element to element calls the same methods on a slice
//! of materials of one type, `[N]`, one for each element; one whose material is textured, or
//! filtered over the footprint of each pixel, calls them on that material [`Varied`] by slices of
//! numbers, which is faster than a slice of materials: the numbers need no turning into lanes.
//!
//! | | |
//! |---|---|
//! | [`NdfBatch`] | D, σ, Λ, G1, G2, D_w, all and visible normals, of any distribution; [`Custom`] for your own |
//! | [`ReflectionBatch`] | f, density, both together, and samples of a [`RoughConductor`](crate::bsdf::RoughConductor) |
//! | [`map()`] | any function: mixtures of BSDFs, means over footprints, elementary functions; [`map_inlined`] |
//!
//! # Domain
//! Any length, 0 included; a length that is no multiple of the block is filled up with copies of
//! one of its elements, so that the rest takes the same path: a batch costs whole blocks of 64, so
//! that scalar calls are cheaper for fewer than 17 (GGX's reflection) to 35 elements (Beckmann's
//! visible normals). An element never depends on its neighbours: NaN stays in its lane. Materials
//! are `Copy`; a distribution of your own that is not enters as `Custom(&distribution)`. A block of
//! samples with a view from below the horizon, a NaN, or a facet at the very edge of visibility
//! takes twice the time of others.
//!
//! # Panics
//! Where slices differ in length, at entry: nothing has been written then. There is no other panic.
//!
//! # Dispatch
//! With the feature `std`, on x86 and x86-64, the loops are compiled three times (but those that
//! are scalar anyhow, as of GTR's visible normals) and the widest vectors that the processor has
//! are chosen at run time: those of the build's own target, AVX2, or AVX-512. Without `std` and
//! elsewhere the build's target decides; NEON is part of every AArch64. The first entry asks the
//! processor, later ones read one atomic byte. A build for the processor itself (`-C
//! target-cpu=native`) needs no choice and loses nothing by it.
//!
//! # Accuracy
//! The results are those of the scalar calls to the bit, at every level: the operations and their
//! order are the same, and nothing is contracted to fused multiply-adds. Only the payload and sign
//! of a NaN may differ.
//!
//! # Example
//! ```
//! use microsurface::batch::{Directions, NdfBatch};
//! use microsurface::{Ggx, Ndf, glam::Vec3};
//! let surface = Ggx::isotropic(0.2_f32)?;
//! let wm = Directions { x: &[0.0, 0.6, 0.0], y: &[0.0, 0.0, 0.6], z: &[1.0, 0.8, 0.8] };
//! let mut d = [0.0; 3];
//! surface.d_batch(wm, &mut d);
//! assert_eq!(d[1], surface.d(Vec3::new(0.6, 0.0, 0.8)));
//! // A width for each element.
//! let surfaces = [Ggx::isotropic(0.2)?, Ggx::isotropic(0.3)?, Ggx::isotropic(0.4)?];
//! surfaces.d_batch(wm, &mut d);
//! assert_eq!(d[2], surfaces[2].d(Vec3::new(0.0, 0.6, 0.8)));
//! # Ok::<(), microsurface::Error>(())
//! ```

mod arrays;
mod blocks;
mod custom;
mod filtered;
mod map;
mod material;
mod ndf;
mod reflection;
pub mod simd;
mod stages;
mod varied;

pub use arrays::{Directions, DirectionsMut, Numbers, Samples};
pub use blocks::{Sink, Source};
pub use custom::Custom;
pub use filtered::{Filtered, FilteredProjected, Footprints};
pub use map::{Function, map, map_inlined};
pub use material::{Material, Materials};
pub use ndf::NdfBatch;
pub use reflection::{Reflection, ReflectionBatch};
pub use varied::{AlphaPairs, Alphas, OnSurface, RoughnessMatrices, Variation, Varied};

pub use crate::ndf::staged::StagedVndf;
