//! Optical constants of metals.

use microsurface::fresnel::Conductor;
use microsurface::glam::Vec3;

/// n and k at 630, 532 and 465 nm, interpolated linearly between the wavelengths of the published
/// tables.
pub(crate) struct Metal {
    pub(crate) name: &'static str,
    n: Vec3,
    k: Vec3,
}

/// Johnson and Christy 1972, "Optical constants of the noble metals", Phys. Rev. B 6, 4370, table
/// I.
pub(crate) const GOLD: Metal =
    Metal { name: "gold", n: Vec3::new(0.188, 0.544, 1.332), k: Vec3::new(3.403, 2.231, 1.869) };

/// Johnson and Christy 1972, as for gold.
pub(crate) const COPPER: Metal =
    Metal { name: "copper", n: Vec3::new(0.275, 1.116, 1.247), k: Vec3::new(3.373, 2.596, 2.456) };

/// Rakić 1995, "Algorithm for the determination of intrinsic optical constants of metal films:
/// application to aluminum", Appl. Opt. 34, 4755, table 1.
pub(crate) const ALUMINIUM: Metal =
    Metal { name: "aluminium", n: Vec3::new(1.430, 0.939, 0.686), k: Vec3::new(7.508, 6.420, 5.635) };

impl Metal {
    /// The exact Fresnel reflectance.
    pub(crate) fn fresnel(&self) -> Result<Conductor<Vec3>, microsurface::Error> {
        Conductor::new(self.n, self.k)
    }
}
