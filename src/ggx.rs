//! GGX, the distribution of Trowbridge and Reitz.

use crate::Real;
use crate::elementary::sin_cos_of_turn;
use crate::map::Map;
use crate::microsurface::shape_invariant;
use crate::ndf::cosine_scale;
use crate::ndf::staged::Forms;
use crate::profile::staged::StagedProfile;
use crate::profile::{Profile, SampleProfile, SampleVisibleProfile};
use crate::vector::below_one;

/// GGX (Trowbridge–Reitz) slopes: D = 1/(π αx αy (wm.x²/αx² + wm.y²/αy² + wm.z²)²).
///
/// The normals of an ellipsoid, with tails that fall as θ⁻⁴. Masking: σ(w) = ½(w.z + √(w.z² +
/// wᵀAw)).
///
/// # Numerics
/// D is formed from wm.x, wm.y and α rather than from 1 − wm.z², which in f32 is wrong by a factor
/// 47 at α = 1e-4. Λ is t/(2(1 + √(1 + t))), t = wᵀAw/w.z²: the textbook's (√(1 + t) − 1)/2 is 0 in
/// f32 for t < 1e-7.
///
/// # Accuracy
/// Relative, in units of ε of the scalar, f32 / f64, the largest found by a search over α from 1e-6
/// to 1e3, ratios of α up to 1000 and all directions: D 5.4 / 5.2, σ 2.0 / 2.0 above the horizon
/// and 2.9 / 2.9 below it, Λ 3.0 / 3.0, G1 2.3 / 2.1. In f32 that is 6.4e-7 for D. Under a
/// [`Linear`](crate::Linear) map D also loses what [`Linear`](crate::Linear) says.
///
/// # Example
/// ```
/// use microsurface::{Ggx, Ndf, glam::DVec3};
/// let surface = Ggx::anisotropic(0.1_f64, 0.8)?;
/// let (s, c) = 60_f64.to_radians().sin_cos();
/// let (x, y) = (DVec3::new(s, 0.0, c), DVec3::new(0.0, s, c));
/// assert!((surface.g2(x, x, DVec3::Z) - 0.985329).abs() < 1e-6);
/// assert!((surface.g2(x, y, DVec3::Z) - 0.734298).abs() < 1e-6);
/// assert!((surface.g2(y, y, DVec3::Z) - 0.585206).abs() < 1e-6);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # SGGX
/// GGX normals are those of the upper half of an ellipsoid. The whole one is SGGX, of volumes: D
/// at ±wm, the projected area σ(w) + σ(−w) = √(wᵀSw) with S = diag(αx², αy², 1), and visible
/// normals from either half by its share.
/// ```
/// use microsurface::{Ggx, Ndf, SampleVndf, glam::{Vec2, Vec3}};
/// let half = Ggx::anisotropic(0.3_f32, 0.7)?;
/// let w = Vec3::new(0.48, 0.6, 0.64);
/// let [above, below] = [half.sigma(w), half.sigma(-w)];
/// let scaled = Vec3::new(0.3, 0.7, 1.0) * w;
/// assert!((above + below - scaled.length()).abs() < 1e-6);
/// let u = Vec2::new(0.2, 0.9);
/// let share = above / (above + below);
/// let wm = if u.x < share {
///     half.sample_vndf(w, Vec2::new(u.x / share, u.y))
/// } else {
///     -half.sample_vndf(-w, Vec2::new((u.x - share) / (1.0 - share), u.y))
/// };
/// assert!(w.dot(wm) > 0.0);
/// # Ok::<(), microsurface::Error>(())
/// ```
/// Any other axis than z is a rotation of w and wm: Heitz, Dupuy, Crassin and Dachsbacher 2015,
/// "The SGGX microflake distribution".
///
/// # References
/// Trowbridge and Reitz 1975; Walter, Marschner, Li and Torrance 2007, Eq. 33; Heitz 2014; visible
/// normals by spherical caps: Dupuy and Benyoub 2023, doi:10.1111/cgf.14867.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[doc(alias("TrowbridgeReitz", "SGGX"))]
pub struct Ggx;

shape_invariant!(Ggx);

impl<T: Real> Profile<T> for Ggx {
    #[inline(always)]
    fn d<M: Map<Scalar = T>>(&self, map: &M, m: [T; 3], length2: T) -> T {
        let (q, z2) = map.normal_terms(m);
        let ratio = length2 / (q + z2);
        map.scale() * (ratio * ratio)
    }

    /// A power of two brings the sum of squares into [1, 2), so that its square in the denominator
    /// takes nothing out of range; that costs less than to divide twice.
    #[inline(always)]
    fn d_times<M: Map<Scalar = T>>(&self, map: &M, m: [T; 3], length2: T, [n, d]: [T; 2]) -> T {
        let (q, z2) = map.normal_terms(m);
        let sum = q + z2;
        let power = sum.inverse_binade();
        let (ratio, sum) = (length2 * power, sum * power);
        map.scale() * ratio * ratio * n / (sum * sum * d)
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        T::HALF * (z + (z * z + s2).sqrt())
    }

    /// With σ = ½(z + ℓ) the products of the cosines cancel: ½(zo ℓi + zi ℓo).
    #[inline(always)]
    fn masked_cosines(&self, [s2_i, z_i]: [T; 2], [s2_o, z_o]: [T; 2]) -> T {
        let scale = T::HALF * cosine_scale::<T>();
        (scale * z_o) * (z_i * z_i + s2_i).sqrt() + (scale * z_i) * (z_o * z_o + s2_o).sqrt()
    }

    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        T::HALF * s2 / (z + (z * z + s2).sqrt())
    }
}

impl<T: Real> SampleProfile<T> for Ggx {
    /// tan²θ = u.x/(1 − u.x), azimuth 2π u.y: Walter 2007, Eqs. 35–36.
    #[inline(always)]
    fn sample_d(&self, [u1, u2]: [T; 2]) -> [T; 3] {
        let (sin, cos) = sin_cos_of_turn(u2);
        let u1 = below_one(u1);
        let radius = u1.sqrt();
        [radius * cos, radius * sin, (T::ONE - u1).sqrt()]
    }
}

impl<T: Real> SampleVisibleProfile<T> for Ggx {
    /// A point c uniform on the spherical cap c.z ≥ −v.z of the normalised v, azimuth 2π u.x and
    /// height by u.y; the normal is c + v.
    ///
    /// Written for |v| (c + v), nothing is divided and nothing cancels: with ℓ = |v| and p = ℓ +
    /// v.z, its height is (1 − u.y) p and the radius of ℓ c is √(u.y ((1 − u.y) p² + v.x² + v.y²)).
    #[inline(always)]
    fn sample_visible(&self, v: [T; 3], s2: T, u: [T; 2]) -> [T; 3] {
        // From below p = s²/(ℓ − v.z).
        let larger = (v[2] * v[2] + s2).sqrt() + v[2].abs();
        on_cap(v, s2, u, if v[2] < T::ZERO { s2 / larger } else { larger })
    }
}

impl Forms for Ggx {}

impl<T: Real> StagedProfile<T> for Ggx {
    const STRAIGHT: bool = true;
    type Solver = ();

    #[inline(always)]
    fn ask(&self, _: [T; 3], _: T, _: [T; 2]) {}

    /// The common path is a view from above.
    #[inline(always)]
    fn normal(&self, v: [T; 3], s2: T, u: [T; 2], (): ()) -> ([T; 3], bool) {
        let p = (v[2] * v[2] + s2).sqrt() + v[2];
        (on_cap(v, s2, u, p), v[2] >= T::ZERO)
    }
}

/// The normal on the cap of height p.
#[inline(always)]
fn on_cap<T: Real>([x, y, _]: [T; 3], s2: T, [u1, u2]: [T; 2], p: T) -> [T; 3] {
    let u2 = below_one(u2);
    let height = (T::ONE - u2) * p;
    let radius = (u2 * (p * height + s2)).sqrt();
    let (sin, cos) = sin_cos_of_turn(u1);
    [radius * cos + x, radius * sin + y, height]
}
