//! Beckmann whose visible normals are drawn faster and less exactly.

use super::visible::{To1e6, VisibleSlopes};
use super::{Beckmann, cotangent, facet_from_above, sample};
use crate::Real;
use crate::map::Map;
use crate::microsurface::shape_invariant;
use crate::ndf::staged::Forms;
use crate::profile::staged::StagedProfile;
use crate::profile::{Profile, SampleProfile, SampleVisibleProfile};

/// [`Beckmann`] with another sampling of visible normals: to 1e-6 of u instead of to rounding.
///
/// Uses the inversion of [`Beckmann`] in the arithmetic of the scalar, where [`Beckmann`] in f32
/// computes part of it in f64: in batches it takes about half the time (`cargo bench --bench
/// bench -- entry_visible_normal_beckmann`). All that is evaluated is Beckmann's to the bit, and so
/// is everything in f64.
///
/// # Accuracy
/// In f32, as a difference of u, the slope along the view is right to 4.5e-7 at worst (ν = z/s =
/// 0.001, u = 0.945), to 6.3e-7 from below the horizon (ν = −3.97, u = 1 − 2⁻²⁴), with a root mean
/// square of 6e-8; relative to u to 4.7e-6 (u = 3e-8). Below ν = −2²⁰ it is ν, from which it
/// differs by less than rounding. The slope across is that of
/// [`erfc_inv`](crate::elementary::erfc_inv). Neither is monotone ulp by ulp.
///
/// # Example
/// ```
/// use microsurface::beckmann::BeckmannTo1e6;
/// use microsurface::{Beckmann, Ndf, SampleVndf, glam::{Vec2, Vec3}};
/// let (quick, exact) = (BeckmannTo1e6::isotropic(0.3_f32)?, Beckmann::isotropic(0.3_f32)?);
/// let (w, u) = (Vec3::new(0.6, 0.0, 0.8), Vec2::new(0.3, 0.7));
/// assert!(quick.sample_vndf(w, u).distance(exact.sample_vndf(w, u)) < 1e-6);
/// assert_eq!(quick.d(Vec3::Z), exact.d(Vec3::Z));
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// As [`Beckmann`]; Heitz and d'Eon 2014, §4.1, with an inversion of our own, derived in
/// `beckmann/visible.rs`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BeckmannTo1e6;

shape_invariant!(BeckmannTo1e6);

impl<T: Real> Profile<T> for BeckmannTo1e6 {
    #[inline(always)]
    fn d<M: Map<Scalar = T>>(&self, map: &M, m: [T; 3], length2: T) -> T {
        Beckmann.d(map, m, length2)
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        Beckmann.sigma_above(s2, z)
    }

    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        Beckmann.sigma_backfacing(s2, z)
    }

    #[inline(always)]
    fn lambda<M: Map<Scalar = T>>(&self, map: &M, w: [T; 3]) -> T {
        Beckmann.lambda(map, w)
    }
}

impl<T: Real> SampleProfile<T> for BeckmannTo1e6 {
    #[inline(always)]
    fn sample_d(&self, u: [T; 2]) -> [T; 3] {
        Beckmann.sample_d(u)
    }
}

impl<T: Real> SampleVisibleProfile<T> for BeckmannTo1e6 {
    #[inline(always)]
    fn sample_visible(&self, v: [T; 3], s2: T, u: [T; 2]) -> [T; 3] {
        sample::<To1e6, T>(v, s2, u)
    }
}

impl Forms for BeckmannTo1e6 {}

impl<T: Real> StagedProfile<T> for BeckmannTo1e6 {
    const STRAIGHT: bool = true;
    type Solver = VisibleSlopes<To1e6, T>;

    #[inline(always)]
    fn ask(&self, v: [T; 3], s2: T, u: [T; 2]) -> (T, [T; 2]) {
        (cotangent::<To1e6, T>(v[2], s2.sqrt()), u)
    }

    #[inline(always)]
    fn normal(&self, v: [T; 3], s2: T, u: [T; 2], slopes: [T; 2]) -> ([T; 3], bool) {
        facet_from_above(v, s2, u, slopes)
    }
}
