//! Distributions over many directions.

use crate::batch::blocks::Body;
use crate::batch::{Directions, DirectionsMut, Materials, Numbers};
use crate::ndf::{Course, Ndf, SampleNdf, SampleVndf, Slopes};

/// The scalar of the distributions of a batch.
type Scalar<B> = <<B as Materials>::Material as Ndf>::Scalar;

/// A body of a batch: what is computed of a material and an element's arguments.
macro_rules! body {
    ($name:ident: $($bound:path),+; $input:ty => $out:ty, |$surface:ident, $arguments:pat_param| $body:expr) => {
        struct $name;
        impl<N: $($bound +)+> Body<N, $input> for $name {
            type Number = N::Scalar;
            type Out = $out;
            #[inline(always)]
            fn of(&self, $surface: &N, $arguments: $input, _: [N::Scalar; 3]) -> Self::Out {
                $body
            }
        }
    };
}
body!(D: Ndf; [N::Scalar; 3] => N::Scalar, |surface, wm| surface.d(wm.into()));
body!(Sigma: Ndf; [N::Scalar; 3] => N::Scalar, |surface, w| surface.sigma(w.into()));
body!(Lambda: Ndf; [N::Scalar; 3] => N::Scalar, |surface, w| surface.lambda(w.into()));
body!(G1: Ndf; ([N::Scalar; 3], [N::Scalar; 3]) => N::Scalar, |surface, (w, wm)| surface.g1(w.into(), wm.into()));
body!(G2: Ndf; ([N::Scalar; 3], [N::Scalar; 3], [N::Scalar; 3]) => N::Scalar, |surface, (wi, wo, wm)| {
    surface.g2(wi.into(), wo.into(), wm.into())
});
body!(Vndf: Ndf; ([N::Scalar; 3], [N::Scalar; 3]) => N::Scalar, |surface, (w, wm)| surface.vndf(w.into(), wm.into()));
body!(Normal: SampleNdf; [N::Scalar; 2] => (N::Scalar, N::Scalar, N::Scalar), |surface, u| {
    let m: [N::Scalar; 3] = surface.sample_d(u.into()).into();
    m.into()
});

struct VisibleNormal;
impl<N: SampleVndf> Body<N, ([N::Scalar; 3], [N::Scalar; 2])> for VisibleNormal {
    type Number = N::Scalar;
    type Out = (N::Scalar, N::Scalar, N::Scalar);
    #[inline(always)]
    fn course(&self, surface: &N) -> Course {
        surface.course()
    }
    #[inline(always)]
    fn normal(&self, surface: &N, (w, u): ([N::Scalar; 3], [N::Scalar; 2])) -> [N::Scalar; 3] {
        surface.sample_along(w.into(), u.into()).into()
    }
    #[inline(always)]
    fn usual_normal(
        &self,
        surface: &N,
        (w, u): ([N::Scalar; 3], [N::Scalar; 2]),
        slopes: Slopes<'_, N::Scalar>,
    ) -> ([N::Scalar; 3], bool) {
        let (m, usual) = surface.usual_sample_along(w.into(), u.into(), slopes);
        (m.into(), usual)
    }
    #[inline(always)]
    fn of(&self, surface: &N, _: ([N::Scalar; 3], [N::Scalar; 2]), along: [N::Scalar; 3]) -> Self::Out {
        let normal: [N::Scalar; 3] = surface.sample_of_along(along.into()).into();
        normal.into()
    }
}

/// [`Ndf`] and its sampling over many directions: on a distribution, or on a slice with one for each element.
///
/// Domains and special cases are those of the method without `_batch`, element by element; a batch of visible normals is
/// vector code for GGX and Beckmann, of which [`BeckmannTo1e6`](crate::beckmann::BeckmannTo1e6) takes half the time; of
/// a GTR mixture it is a scalar loop, no faster than the calls.
///
/// # Panics
/// Every method where slices, that of distributions included, differ in length; nothing has been written then.
///
/// # Example
/// ```
/// use microsurface::batch::{Directions, DirectionsMut, NdfBatch, Numbers};
/// use microsurface::{Beckmann, SampleVndf, glam::{Vec2, Vec3}};
/// let surface = Beckmann::anisotropic(0.1_f32, 0.3)?;
/// let wo = Directions { x: &[0.6, 0.0], y: &[0.0, -0.6], z: &[0.8, 0.8] };
/// let u = Numbers { x: &[0.3, 0.5], y: &[0.7, 0.1] };
/// let (mut x, mut y, mut z) = ([0.0; 2], [0.0; 2], [0.0; 2]);
/// surface.sample_vndf_batch(wo, u, DirectionsMut { x: &mut x, y: &mut y, z: &mut z });
/// assert_eq!(Vec3::new(x[0], y[0], z[0]), surface.sample_vndf(Vec3::new(0.6, 0.0, 0.8), Vec2::new(0.3, 0.7)));
/// # Ok::<(), microsurface::Error>(())
/// ```
pub trait NdfBatch: Materials<Material: Ndf> {
    /// D(wm), see [`Ndf::d`].
    #[inline]
    fn d_batch(&self, wm: Directions<'_, Scalar<Self>>, out: &mut [Scalar<Self>]) {
        self.each(D, wm, out);
    }

    /// σ(w) on the whole sphere, see [`Ndf::sigma`].
    #[inline]
    fn sigma_batch(&self, w: Directions<'_, Scalar<Self>>, out: &mut [Scalar<Self>]) {
        self.each(Sigma, w, out);
    }

    /// Λ(w), see [`Ndf::lambda`].
    #[inline]
    fn lambda_batch(&self, w: Directions<'_, Scalar<Self>>, out: &mut [Scalar<Self>]) {
        self.each(Lambda, w, out);
    }

    /// G1(w, wm), see [`Ndf::g1`].
    #[inline]
    fn g1_batch(
        &self,
        w: Directions<'_, Scalar<Self>>,
        wm: Directions<'_, Scalar<Self>>,
        out: &mut [Scalar<Self>],
    ) {
        self.each(G1, (w, wm), out);
    }

    /// G2(wi, wo, wm), see [`Ndf::g2`].
    #[inline]
    fn g2_batch(
        &self,
        wi: Directions<'_, Scalar<Self>>,
        wo: Directions<'_, Scalar<Self>>,
        wm: Directions<'_, Scalar<Self>>,
        out: &mut [Scalar<Self>],
    ) {
        self.each(G2, (wi, wo, wm), out);
    }

    /// D_w(wm), see [`Ndf::vndf`].
    #[inline]
    fn vndf_batch(
        &self,
        w: Directions<'_, Scalar<Self>>,
        wm: Directions<'_, Scalar<Self>>,
        out: &mut [Scalar<Self>],
    ) {
        self.each(Vndf, (w, wm), out);
    }

    /// Normals of density D(wm) wm.z, see [`SampleNdf::sample_d`].
    #[inline]
    fn sample_d_batch(&self, u: Numbers<'_, Scalar<Self>>, out: DirectionsMut<'_, Scalar<Self>>)
    where
        Self::Material: SampleNdf,
    {
        self.each(Normal, u, out);
    }

    /// Normals visible from w, see [`SampleVndf::sample_vndf`].
    #[inline]
    fn sample_vndf_batch(
        &self,
        w: Directions<'_, Scalar<Self>>,
        u: Numbers<'_, Scalar<Self>>,
        out: DirectionsMut<'_, Scalar<Self>>,
    ) where
        Self::Material: SampleVndf,
    {
        self.each(VisibleNormal, (w, u), out);
    }
}

impl<M: Materials<Material: Ndf> + ?Sized> NdfBatch for M {}
