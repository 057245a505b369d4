//! Many directions at once: structures of arrays, in the widest vectors of the processor.
//!
//! Every method of [`NdfBatch`](crate::batch::NdfBatch) and
//! [`ReflectionBatch`](crate::batch::ReflectionBatch) does for each element what the method without
//! `_batch` does for one, to the bit.
//!
//! | you have | take |
//! |---|---|
//! | hits sorted by material | the material itself |
//! | a material for each element | a slice of materials |
//! | one material, textured or filtered per element | [`Varied`](crate::batch::Varied) |
//! | a distribution of your own | [`Custom`](crate::batch::Custom) |
//! | any other function | [`batch::map`](crate::batch::map()) |
//! | fewer than 17 to 35 elements | scalar calls: a batch costs whole blocks of 64 |
//!
//! ```
//! use microsurface::batch::{Alphas, Directions, ReflectionBatch, Varied};
//! use microsurface::{Ggx, bsdf::RoughConductor, fresnel::Schlick, glam::Vec3};
//! let f0 = Schlick::new(Vec3::new(1.0, 0.78, 0.34))?;
//! let metal = RoughConductor::new(Ggx::isotropic(0.2_f32)?, f0);
//! let wi = Directions { x: &[-0.6, 0.0], y: &[0.0, 0.6], z: &[0.8, 0.8] };
//! let wo = Directions { x: &[0.6, 0.0], y: &[0.0, -0.6], z: &[0.8, 0.8] };
//! let mut f = [Vec3::ZERO; 2];
//! metal.eval_batch(wi, wo, &mut f);
//! // A texture of α, where a texel of 0 is a mirror.
//! Varied::new(&metal, Alphas::clamped(&[0.0, 0.3])).eval_batch(wi, wo, &mut f);
//! # Ok::<(), microsurface::Error>(())
//! ```
//! Your own loops over slices become vector code too, because every function is straight-line code;
//! compile with `-C target-cpu=native` for wider lanes. [`batch::simd`](crate::batch::simd) says
//! which vectors batches use.
