//! A BSDF of anybody, as three closures.

use core::marker::PhantomData;

use super::float::Float;
use crate::real::Vector;

/// The sides of the surface that a BSDF is looked at from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sides {
    /// From above.
    Above,
    /// From above and from below.
    Both,
}

/// A BSDF of anybody: three closures over the vectors `V` of the renderer, glam's or arrays.
///
/// Directions are unit vectors of the shading frame, z along the normal, both away from the
/// surface: wi towards the light, wo towards the eye. Of a spectrum a closure gives one channel.
///
/// # Example
/// A BSDF of this crate:
/// ```
/// use microsurface::bsdf::RoughConductor;
/// use microsurface::glam::{Vec2, Vec3};
/// use microsurface::verify::{Bsdf, Kit};
/// use microsurface::{Ggx, fresnel::Schlick};
/// let brdf = RoughConductor::new(Ggx::isotropic(0.3)?, Schlick::new(0.9)?);
/// let tested = Bsdf::new(
///     |wi: Vec3, wo: Vec3| brdf.eval(wi, wo),
///     |wi, wo| brdf.pdf(wi, wo),
///     |wo, u: [f32; 2]| brdf.sample(wo, Vec2::from(u)).map(|s| (s.wi, s.weight, s.pdf)),
/// );
/// let report = Kit::new().samples(20_000).bsdf(&tested.isotropic());
/// assert!(report.passed(), "{report}");
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Bsdf<V, E, P, S> {
    pub(super) eval: E,
    pub(super) pdf: P,
    pub(super) sample: S,
    pub(super) about: About,
    vectors: PhantomData<V>,
}

/// The properties of a BSDF.
#[derive(Debug, Clone, Copy)]
pub(super) struct About {
    pub(super) with_cosine: bool,
    pub(super) isotropic: bool,
    pub(super) reciprocal: bool,
    /// The index below the surface relative to that above.
    pub(super) eta: Option<f64>,
    sides: Sides,
}

impl About {
    pub(super) fn both(self) -> bool {
        self.sides == Sides::Both
    }

    /// The index of the side that a direction is on.
    pub(super) fn index(self, w: [f64; 3]) -> f64 {
        if w[2] < 0.0 { self.eta.unwrap_or(1.0) } else { 1.0 }
    }

    /// f |cos| of a value of `eval`.
    pub(super) fn with_cos(self, f: f64, wi: [f64; 3]) -> f64 {
        if self.with_cosine { f } else { f * wi[2].abs() }
    }
}

impl<V, T, E, P, S> Bsdf<V, E, P, S>
where
    V: Vector<3, Scalar = T> + From<[T; 3]>,
    T: Float,
    E: Fn(V, V) -> T,
    P: Fn(V, V) -> T,
    S: Fn(V, [T; 2]) -> Option<(V, T, T)>,
{
    /// A BRDF of three closures: `eval(wi, wo)` is f without the cosine, `pdf(wi, wo)` the density of
    /// sampling wi by solid angle, `sample(wo, u)` gives wi, its weight f cos/pdf, and its pdf. A
    /// sample of weight 0 to the other side counts as none.
    ///
    /// It is taken to reflect only, to be reciprocal, and to be looked at from above.
    pub const fn new(eval: E, pdf: P, sample: S) -> Self {
        let about =
            About { with_cosine: false, isotropic: false, reciprocal: true, eta: None, sides: Sides::Above };
        Self { eval, pdf, sample, about, vectors: PhantomData }
    }

    /// Says that `eval` has the cosine |wi.z| in it.
    #[must_use]
    pub fn with_cosine(self) -> Self {
        Self { about: About { with_cosine: true, ..self.about }, ..self }
    }

    /// Says that turning both directions, and mirroring them, must change nothing.
    #[must_use]
    pub fn isotropic(self) -> Self {
        Self { about: About { isotropic: true, ..self.about }, ..self }
    }

    /// Leaves out the check f(wi, wo) = f(wo, wi).
    #[must_use]
    pub fn not_reciprocal(self) -> Self {
        Self { about: About { reciprocal: false, ..self.about }, ..self }
    }

    /// A BSDF that transmits too, looked at from both sides. `eta` is the index below the surface
    /// relative to that above, as far as f has its square in it: f(wi, wo) η(wi)² = f(wo, wi)
    /// η(wo)². 1 for importance, and for a thin sheet.
    #[must_use]
    pub fn transmits(self, eta: f64) -> Self {
        Self { about: About { eta: Some(eta), sides: Sides::Both, ..self.about }, ..self }
    }

    /// The sides that it is looked at from.
    #[must_use]
    pub fn seen_from(self, sides: Sides) -> Self {
        Self { about: About { sides, ..self.about }, ..self }
    }
}
