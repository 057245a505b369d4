//! GTR of any exponent as a mixture of distributions whose masks and visible normals are known.
//!
//! The mask is that of a few [`nodes`](super::nodes), visible normals are drawn from many
//! [`components`](super::components), and D is GTR's own formula: each is the mixture to the
//! accuracy its use needs.

use crate::Real;
use crate::alpha::checked;
use crate::error::Error;
use crate::gtr::components::Components;
use crate::gtr::nodes::Nodes;
use crate::gtr::{Gtr, Masking, VisibleMasking};
use crate::map::RoughnessMatrix;
use crate::map::{AxisAligned, Isotropic, Linear};
use crate::microsurface::Microsurface;
use crate::ndf::staged::Forms;

/// The mask of `N` nodes, and the components that visible normals are drawn from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mixture<T, const N: usize> {
    nodes: Nodes<T, N>,
    components: Components<T>,
}

impl<T, const N: usize> Mixture<T, N> {
    /// The nodes of the mask.
    #[inline]
    #[must_use]
    pub const fn nodes(&self) -> &Nodes<T, N> {
        &self.nodes
    }

    /// The components.
    #[inline]
    #[must_use]
    pub const fn components(&self) -> &Components<T> {
        &self.components
    }
}

impl<T: Real, const N: usize> Masking<T> for Mixture<T, N> {
    fn new(alpha: T, gamma: T) -> Result<Self, Error> {
        Ok(Self { nodes: Nodes::new(alpha, gamma)?, components: Components::new(alpha, gamma)? })
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        self.nodes.sigma_above(s2, z)
    }

    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        self.nodes.sigma_backfacing(s2, z)
    }
}

impl<T: Real, const N: usize> Forms for Mixture<T, N> {
    #[inline(always)]
    fn form(&self) -> usize {
        self.nodes.form()
    }

    #[inline(always)]
    fn with_form(self, form: usize) -> Self {
        Self { nodes: self.nodes.with_form(form), components: self.components }
    }
}

impl<T: Real, const N: usize> VisibleMasking<T> for Mixture<T, N> {
    #[inline(always)]
    fn sample_visible(&self, _: T, _: T, v: [T; 3], u: [T; 2]) -> [T; 3] {
        self.components.sample_visible(v, u)
    }
}

impl<T: Real> Gtr<T, Mixture<T, 8>> {
    /// GTR of any exponent 0 ≤ γ ≤ 10: exact density, a mask within 1e-5 of the exact one, and
    /// exact visible normals.
    ///
    /// Made in about 8 µs, for a material, not for every hit: see
    /// [`GtrTable`](super::table::GtrTable) for textures. For the integers [`Gtr::closed`] is
    /// smaller and exact to rounding.
    ///
    /// # Errors
    /// [`Error::Alpha`] or [`Error::AlphaAboveOne`] unless 0 < α ≤ 1.
    /// [`Error::Gamma`] unless 0 ≤ γ ≤ 10 and |γ − 1| |ln α²| ≤ 700: in f64, below α = 1.3e-17, the
    /// largest γ is less than 10.
    ///
    /// # Accuracy
    /// max |ΔG1| = 8e-6 for α ≥ 0.001, 3.8e-7 for α ≥ 0.01 (see [`nodes`](super::nodes)),
    /// continuous in γ to 1.7e-6 (γ = 2, α = 0.001) and in α up to 1. σ and Λ below the horizon
    /// have fewer digits where γ is above 3 or α is small: see the table of
    /// [`nodes`](super::nodes).
    ///
    /// # Example
    /// ```
    /// use microsurface::{Gtr, Ndf, SampleVndf, glam::{DVec2, DVec3}};
    /// let surface = Gtr::isotropic(0.05_f64, 1.5)?;
    /// let (s, c) = 80_f64.to_radians().sin_cos();
    /// let w = DVec3::new(s, 0.0, c);
    /// assert!((surface.g1(w, w) - 1.0 / (1.0 + 0.128452250742034)).abs() < 1e-7);
    /// let wm = surface.sample_vndf(w, DVec2::new(0.3, 0.7));
    /// assert!(w.dot(wm) > 0.0);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    pub fn isotropic(alpha: T, gamma: T) -> Result<Microsurface<Self, Isotropic<T>>, Error> {
        Self::surface(alpha, gamma)
    }

    /// GTR of widths αx along x and αy along y: the isotropic one of width √(αx αy), stretched to
    /// them.
    ///
    /// At γ = 2 it is [`Ggx::anisotropic`](crate::Ggx::anisotropic).
    ///
    /// # Errors
    /// [`Error::Alpha`] for either α, [`Error::AlphaAboveOne`] unless αx αy ≤ 1, [`Error::Gamma`]
    /// unless 0 ≤ γ ≤ 10, and as [`isotropic`](Self::isotropic).
    ///
    /// # Example
    /// ```
    /// use microsurface::{Ggx, Gtr, Ndf, glam::Vec3};
    /// let (gtr, ggx) = (Gtr::anisotropic(0.1_f32, 0.4, 2.0)?, Ggx::anisotropic(0.1_f32, 0.4)?);
    /// let wm = Vec3::new(0.1, 0.3, 0.9).normalize();
    /// assert!((gtr.d(wm) / ggx.d(wm) - 1.0).abs() < 2e-6);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    pub fn anisotropic(
        alpha_x: T,
        alpha_y: T,
        gamma: T,
    ) -> Result<Microsurface<Self, AxisAligned<T>>, Error> {
        let (alpha, [x, y]) = mean_and_aspects(alpha_x, alpha_y)?;
        Ok(Microsurface::new(Self::new(alpha, gamma)?, AxisAligned::new(x, y)?))
    }

    /// GTR of width αx along the direction at `angle` radians from x, and αy across it: see
    /// [`anisotropic`](Self::anisotropic).
    ///
    /// # Errors
    /// As [`anisotropic`](Self::anisotropic), and [`Error::Parameter`] if the angle is not finite.
    pub fn rotated(
        alpha_x: T,
        alpha_y: T,
        angle: T,
        gamma: T,
    ) -> Result<Microsurface<Self, Linear<T>>, Error> {
        let (alpha, [x, y]) = mean_and_aspects(alpha_x, alpha_y)?;
        let map = Linear::from(RoughnessMatrix::rotated(x, y, angle)?);
        Ok(Microsurface::new(Self::new(alpha, gamma)?, map))
    }
}

/// The geometric mean of two widths, and both over it.
fn mean_and_aspects<T: Real>(alpha_x: T, alpha_y: T) -> Result<(T, [T; 2]), Error> {
    let [x, y] = [checked(alpha_x)?, checked(alpha_y)?].map(T::to_f64);
    let mean = Real::sqrt(x) * Real::sqrt(y);
    Ok((T::lit(mean), [x / mean, y / mean].map(T::lit)))
}

impl<T: Real> Gtr<T, ()> {
    /// [`isotropic`](Self::isotropic) with a mask of `N` nodes, 1 to 16: see
    /// [`nodes`](super::nodes) for the errors.
    ///
    /// # Errors
    /// As [`Gtr::isotropic`].
    #[expect(clippy::type_complexity, reason = "the type names the distribution, its masking and its map")]
    pub fn with_nodes<const N: usize>(
        alpha: T,
        gamma: T,
    ) -> Result<Microsurface<Gtr<T, Mixture<T, N>>, Isotropic<T>>, Error> {
        Gtr::surface(alpha, gamma)
    }
}
