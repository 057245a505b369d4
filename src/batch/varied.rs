//! Materials that differ between elements by a few numbers: textures of widths, footprints of
//! pixels.

use crate::Real;
use crate::alpha::{alpha_range, mirror_alpha, refused};
use crate::batch::arrays::Directions;
use crate::batch::blocks::{Sink, Source, composed};
use crate::batch::material::{Material, Materials, each_built};
use crate::batch::stages::{Body, Builder};
use crate::bsdf::RoughConductor;
use crate::error::Error;
use crate::map::RoughnessMatrix;
use crate::map::{AxisAligned, Isotropic, Linear, Map};
use crate::microsurface::Microsurface;
use crate::profile::ShapeInvariant;

/// One material, varied by numbers of each element: the structure of arrays of a textured or
/// filtered material.
///
/// Nothing is stored but the material and the slices: the surface of an element is made in the loop
/// that uses it, of its own numbers, and only what the loop needs of it. Every batch of the
/// material is one of the varied material too.
///
/// | varied by | the surface of an element | its map |
/// |---|---|---|
/// | [`Alphas`] | of that α | [`Isotropic`] |
/// | [`AlphaPairs`] | of that αx and αy | [`AxisAligned`] |
/// | [`RoughnessMatrices`] | of that A | [`Linear`] |
/// | [`Filtered`](crate::batch::Filtered) | filtered: A + 2Σ, with the Σ of its footprint | [`Linear`] |
/// | [`FilteredProjected`](crate::batch::FilteredProjected) | filtered in projected space (GGX) | [`Linear`] |
///
/// The first three replace whatever width the material has. They are for the profiles whose width
/// is that of the map, GGX and Beckmann; of GTR take a slice of surfaces.
///
/// # Example
/// A texture of α; [`Filtered`](crate::batch::Filtered) has an example with footprints.
/// ```
/// use microsurface::batch::{Alphas, Directions, ReflectionBatch, Varied};
/// use microsurface::{Ggx, bsdf::RoughConductor, fresnel::Schlick, glam::Vec3};
/// let metal = RoughConductor::new(Ggx::isotropic(0.2_f32)?, Schlick::new(0.9_f32)?);
/// let wi = Directions { x: &[-0.6, 0.0], y: &[0.0, 0.6], z: &[0.8, 0.8] };
/// let wo = Directions { x: &[0.6, 0.0], y: &[0.0, -0.6], z: &[0.8, 0.8] };
/// let textured = Varied::new(&metal, Alphas::new(&[0.1, 0.4])?);
/// let mut f = [0.0; 2];
/// textured.eval_batch(wi, wo, &mut f);
/// let rough = RoughConductor::new(Ggx::isotropic(0.4_f32)?, Schlick::new(0.9_f32)?);
/// assert_eq!(f[1], rough.eval(Vec3::new(0.0, 0.6, 0.8), Vec3::new(0.0, -0.6, 0.8)));
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Varied<'a, B, V> {
    material: &'a B,
    by: V,
}

impl<'a, B: OnSurface, V: Variation<B::Surface>> Varied<'a, B, V> {
    /// The material varied by numbers of each element.
    #[inline]
    #[must_use]
    pub const fn new(material: &'a B, by: V) -> Self {
        Self { material, by }
    }
}

/// A material that can be varied: a microsurface, or a BSDF on one. Sealed: [`Microsurface`],
/// [`RoughConductor`].
pub trait OnSurface: Copy + sealed::OnSurface {
    #[doc(hidden)]
    type Surface;
    #[doc(hidden)]
    type WithSurface<N>;
    #[doc(hidden)]
    fn base_surface(&self) -> &Self::Surface;
    #[doc(hidden)]
    fn on_surface<N>(self, surface: N) -> Self::WithSurface<N>;
}

mod sealed {
    pub trait OnSurface {}
    impl<P, M> OnSurface for crate::Microsurface<P, M> {}
    impl<N, F, S> OnSurface for crate::bsdf::RoughConductor<N, F, S> {}
}

impl<P: Copy, M: Copy> OnSurface for Microsurface<P, M> {
    type Surface = Self;
    type WithSurface<N> = N;
    #[inline(always)]
    fn base_surface(&self) -> &Self {
        self
    }
    #[inline(always)]
    fn on_surface<N>(self, surface: N) -> N {
        surface
    }
}

impl<N0: Copy, F: Copy, S: Copy> OnSurface for RoughConductor<N0, F, S> {
    type Surface = N0;
    type WithSurface<N> = RoughConductor<N, F, S>;
    #[inline(always)]
    fn base_surface(&self) -> &N0 {
        self.surface()
    }
    #[inline(always)]
    fn on_surface<N>(self, surface: N) -> RoughConductor<N, F, S> {
        self.with_surface(surface)
    }
}

/// Numbers of each element that make a surface of a surface `N`. Sealed, see [`Varied`].
pub trait Variation<N>: Source {
    #[doc(hidden)]
    type Surface;
    /// Numbers that depend on the surface alone.
    #[doc(hidden)]
    type Prepared;
    #[doc(hidden)]
    fn prepared(&self, surface: &N) -> Self::Prepared;
    #[doc(hidden)]
    fn varied(prepared: &Self::Prepared, numbers: Self::Item) -> Self::Surface;
}

/// The varied material of an element.
type VariedMaterial<B, V> =
    <B as OnSurface>::WithSurface<<V as Variation<<B as OnSurface>::Surface>>::Surface>;

impl<B, V> Materials for Varied<'_, B, V>
where
    B: OnSurface,
    V: Variation<B::Surface>,
    VariedMaterial<B, V>: Material,
{
    type Material = VariedMaterial<B, V>;
    #[inline]
    fn each<C, I, O>(&self, body: C, input: I, output: O)
    where
        C: Body<Self::Material, I::Item, Out = O::Item>,
        I: Source,
        O: Sink,
    {
        let prepared = self.by.prepared(self.material.base_surface());
        each_built(self.by, OnEach::<B, V> { base: *self.material, prepared }, body, input, output);
    }
}

/// Puts the surface of an element's numbers under the base material.
struct OnEach<B: OnSurface, V: Variation<B::Surface>> {
    base: B,
    prepared: V::Prepared,
}

impl<B: OnSurface, V: Variation<B::Surface>> Builder<V::Item> for OnEach<B, V> {
    type Material = VariedMaterial<B, V>;
    type Built = VariedMaterial<B, V>;
    #[inline(always)]
    fn build(&self, numbers: V::Item) -> VariedMaterial<B, V> {
        self.base.on_surface(V::varied(&self.prepared, numbers))
    }
}

/// The first number that is not a width.
///
/// # Errors
/// [`Error::Alpha`] with it.
fn check_alphas<T: Real>(alphas: &[T]) -> Result<(), Error> {
    let (smallest, largest) = alpha_range::<T>();
    let valid = |&alpha: &T| alpha >= smallest && alpha <= largest;
    // Without an early end this is vector code; the culprit is looked for where there is one.
    if alphas.iter().fold(true, |all, alpha| all & valid(alpha)) {
        return Ok(());
    }
    alphas.iter().find(|alpha| !valid(alpha)).map_or(Ok(()), |&alpha| Err(refused(alpha)))
}

/// A width α for each element.
///
/// # Example
/// A texture that holds 0 is a mirror there.
/// ```
/// use microsurface::batch::{Alphas, Directions, NdfBatch, Varied};
/// use microsurface::{Ggx, Ndf, glam::Vec3, roughness::mirror_alpha};
/// let (surface, texels) = (Ggx::isotropic(0.2_f32)?, [0.0, 0.4]);
/// assert!(Alphas::new(&texels).is_err());
/// let mut d = [0.0; 2];
/// let up = Directions { x: &[0.0; 2], y: &[0.0; 2], z: &[1.0; 2] };
/// Varied::new(&surface, Alphas::clamped(&texels)).d_batch(up, &mut d);
/// assert_eq!(d, [mirror_alpha(), 0.4_f32].map(|alpha| Ggx::isotropic(alpha).unwrap().d(Vec3::Z)));
/// # Ok::<(), microsurface::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alphas<'a, T> {
    alpha: &'a [T],
    smallest: T,
}

/// `alpha` from `smallest` on; NaN becomes `smallest`.
#[inline(always)]
fn limited<T: Real>(alpha: T, smallest: T) -> T {
    alpha.max(smallest).min(alpha_range::<T>().1)
}

impl<'a, T: Real> Alphas<'a, T> {
    /// These widths.
    ///
    /// # Errors
    /// [`Error::Alpha`] with the first that is not within [`alpha_range`]; textures that hold 0
    /// want [`clamped`](Self::clamped).
    pub fn new(alpha: &'a [T]) -> Result<Self, Error> {
        check_alphas(alpha)?;
        Ok(Self { alpha, smallest: alpha_range().0 })
    }

    /// These widths, each [`roughness::clamped`](crate::roughness::clamped).
    #[must_use]
    pub fn clamped(alpha: &'a [T]) -> Self {
        Self { alpha, smallest: mirror_alpha() }
    }
}

impl<P: ShapeInvariant, M: Copy, T: Real> Variation<Microsurface<P, M>> for Alphas<'_, T> {
    type Surface = Microsurface<P, Isotropic<T>>;
    type Prepared = (P, T);
    #[inline(always)]
    fn prepared(&self, surface: &Microsurface<P, M>) -> Self::Prepared {
        (*surface.profile(), self.smallest)
    }
    #[inline(always)]
    fn varied(&(profile, smallest): &Self::Prepared, alpha: T) -> Self::Surface {
        Microsurface::new(profile, Isotropic::of_checked(limited(alpha, smallest)))
    }
}

/// Widths αx and αy for each element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AlphaPairs<'a, T> {
    x: &'a [T],
    y: &'a [T],
    smallest: T,
}

impl<'a, T: Real> AlphaPairs<'a, T> {
    /// These widths along x and along y, of equal number.
    ///
    /// # Errors
    /// [`Error::Alpha`] with the first that is not within [`alpha_range`].
    pub fn new(x: &'a [T], y: &'a [T]) -> Result<Self, Error> {
        check_alphas(x)?;
        check_alphas(y)?;
        Ok(Self { x, y, smallest: alpha_range().0 })
    }

    /// These widths, each [`roughness::clamped`](crate::roughness::clamped).
    #[must_use]
    pub fn clamped(x: &'a [T], y: &'a [T]) -> Self {
        Self { x, y, smallest: mirror_alpha() }
    }
}

impl<P: ShapeInvariant, M: Copy, T: Real> Variation<Microsurface<P, M>> for AlphaPairs<'_, T> {
    type Surface = Microsurface<P, AxisAligned<T>>;
    type Prepared = (P, T);
    #[inline(always)]
    fn prepared(&self, surface: &Microsurface<P, M>) -> Self::Prepared {
        (*surface.profile(), self.smallest)
    }
    #[inline(always)]
    fn varied(&(profile, smallest): &Self::Prepared, alphas: [T; 2]) -> Self::Surface {
        let [x, y] = alphas.map(|alpha| limited(alpha, smallest));
        Microsurface::new(profile, AxisAligned::of_checked(x, y))
    }
}

/// A [`RoughnessMatrix`] for each element, by entries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughnessMatrices<'a, T> {
    entries: Directions<'a, T>,
}

impl<'a, T: Real> RoughnessMatrices<'a, T> {
    /// The matrices of these entries, three slices of equal length.
    ///
    /// # Errors
    /// [`Error::RoughnessMatrix`] with the first that [`RoughnessMatrix::new`] refuses.
    ///
    /// # Panics
    /// Where the slices differ in length.
    pub fn new(xx: &'a [T], xy: &'a [T], yy: &'a [T]) -> Result<Self, Error> {
        assert!(xx.len() == xy.len() && xx.len() == yy.len(), "entries of matrices differ in number");
        for ((&xx, &xy), &yy) in xx.iter().zip(xy).zip(yy) {
            RoughnessMatrix::new(xx, xy, yy)?;
        }
        Ok(Self { entries: Directions { x: xx, y: xy, z: yy } })
    }
}

impl<P: ShapeInvariant, M: Map> Variation<Microsurface<P, M>> for RoughnessMatrices<'_, M::Scalar> {
    type Surface = Microsurface<P, Linear<M::Scalar>>;
    type Prepared = P;
    #[inline(always)]
    fn prepared(&self, surface: &Microsurface<P, M>) -> P {
        *surface.profile()
    }
    #[inline(always)]
    fn varied(&profile: &P, entries: [M::Scalar; 3]) -> Self::Surface {
        Microsurface::new(profile, RoughnessMatrix::of_checked(entries).into())
    }
}

composed!(source ['a, T: Copy] Alphas<'a, T>, T = (alpha: &'a [T] => 0), |alpha| alpha.0);
composed!(source ['a, T: Copy] AlphaPairs<'a, T>, [T; 2] = (x: &'a [T] => 0, y: &'a [T] => 1), |alphas| alphas.into());
composed!(source ['a, T: Copy] RoughnessMatrices<'a, T>, [T; 3] = (entries: Directions<'a, T> => 0), |entries| entries.0);
