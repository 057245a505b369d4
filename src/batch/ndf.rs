//! Distributions over many directions.

use crate::batch::arrays::{Directions, DirectionsMut, Numbers};
use crate::batch::material::Materials;
use crate::batch::stages::{Body, without_normals};
use crate::ndf::staged::{Solver, StagedVndf};
use crate::ndf::{Ndf, SampleNdf};
use crate::real::Real;

/// A body of a batch: what is computed of a material and an element's arguments.
macro_rules! body {
    ($name:ident: $($bound:path),+; $input:ty => $out:ty, |$surface:ident, $arguments:pat_param| $body:expr) => {
        struct $name;
        impl<N: $($bound +)+> Body<N, $input> for $name {
            type Out = $out;
            without_normals!(N, $input, N::Scalar);
            #[inline(always)]
            fn result(&self, $surface: &N, $arguments: $input, _: [N::Scalar; 3]) -> Self::Out {
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

/// A direction and two random numbers.
type Sampled<N> = ([<N as Ndf>::Scalar; 3], [<N as Ndf>::Scalar; 2]);

struct VisibleNormal;
impl<N: StagedVndf> Body<N, Sampled<N>> for VisibleNormal {
    type Number = N::Scalar;
    type Out = (N::Scalar, N::Scalar, N::Scalar);
    const STRAIGHT: bool = N::STRAIGHT;
    type Solver = N::Solver;
    #[inline(always)]
    fn ask(&self, surface: &N, (w, u): Sampled<N>) -> <N::Solver as Solver>::Question {
        surface.ask(w.into(), u.into())
    }
    #[inline(always)]
    fn normal(
        &self,
        surface: &N,
        (w, u): Sampled<N>,
        answer: <N::Solver as Solver>::Answer,
    ) -> ([N::Scalar; 3], bool) {
        let (m, usual) = surface.normal(w.into(), u.into(), answer);
        (m.into(), usual)
    }
    #[inline(always)]
    fn normal_in_full(&self, surface: &N, (w, u): Sampled<N>) -> [N::Scalar; 3] {
        surface.sample_vndf_along(w.into(), u.into()).into()
    }
    #[inline(always)]
    fn result(&self, surface: &N, _: Sampled<N>, along: [N::Scalar; 3]) -> Self::Out {
        let normal: [N::Scalar; 3] = surface.sample_of_along(along.into()).into();
        normal.into()
    }
}

/// [`Ndf`] and its sampling over many directions: on a distribution, or on a slice with one for
/// each element.
///
/// Domains and special cases are those of the method without `_batch`, element by element; a batch
/// of visible normals is vector code for GGX and Beckmann, of which
/// [`BeckmannTo1e6`](crate::beckmann::BeckmannTo1e6) takes half the time; of a GTR mixture it is a
/// scalar loop, no faster than the calls.
///
/// # Panics
/// Every method where slices, that of distributions included, differ in length; nothing has been
/// written then.
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
/// let one = surface.sample_vndf(Vec3::new(0.6, 0.0, 0.8), Vec2::new(0.3, 0.7));
/// assert_eq!(Vec3::new(x[0], y[0], z[0]), one);
/// # Ok::<(), microsurface::Error>(())
/// ```
pub trait NdfBatch: Materials {
    /// f32 or f64.
    type Scalar: Real;

    /// D(wm), see [`Ndf::d`].
    fn d_batch(&self, wm: Directions<'_, Self::Scalar>, out: &mut [Self::Scalar]);

    /// σ(w) on the whole sphere, see [`Ndf::sigma`].
    fn sigma_batch(&self, w: Directions<'_, Self::Scalar>, out: &mut [Self::Scalar]);

    /// Λ(w), see [`Ndf::lambda`].
    fn lambda_batch(&self, w: Directions<'_, Self::Scalar>, out: &mut [Self::Scalar]);

    /// G1(w, wm), see [`Ndf::g1`].
    fn g1_batch(
        &self,
        w: Directions<'_, Self::Scalar>,
        wm: Directions<'_, Self::Scalar>,
        out: &mut [Self::Scalar],
    );

    /// G2(wi, wo, wm), see [`Ndf::g2`].
    fn g2_batch(
        &self,
        wi: Directions<'_, Self::Scalar>,
        wo: Directions<'_, Self::Scalar>,
        wm: Directions<'_, Self::Scalar>,
        out: &mut [Self::Scalar],
    );

    /// D_w(wm), see [`Ndf::vndf`].
    fn vndf_batch(
        &self,
        w: Directions<'_, Self::Scalar>,
        wm: Directions<'_, Self::Scalar>,
        out: &mut [Self::Scalar],
    );

    /// Normals of density D(wm) wm.z, see [`SampleNdf::sample_d`].
    fn sample_d_batch(&self, u: Numbers<'_, Self::Scalar>, out: DirectionsMut<'_, Self::Scalar>)
    where
        Self::Material: SampleNdf;

    /// Normals visible from w, see [`SampleVndf::sample_vndf`](crate::SampleVndf::sample_vndf).
    fn sample_vndf_batch(
        &self,
        w: Directions<'_, Self::Scalar>,
        u: Numbers<'_, Self::Scalar>,
        out: DirectionsMut<'_, Self::Scalar>,
    ) where
        Self::Material: StagedVndf;
}

impl<M: Materials<Material: Ndf> + ?Sized> NdfBatch for M {
    type Scalar = <M::Material as Ndf>::Scalar;

    #[inline]
    fn d_batch(&self, wm: Directions<'_, Self::Scalar>, out: &mut [Self::Scalar]) {
        self.each(D, wm, out);
    }

    #[inline]
    fn sigma_batch(&self, w: Directions<'_, Self::Scalar>, out: &mut [Self::Scalar]) {
        self.each(Sigma, w, out);
    }

    #[inline]
    fn lambda_batch(&self, w: Directions<'_, Self::Scalar>, out: &mut [Self::Scalar]) {
        self.each(Lambda, w, out);
    }

    #[inline]
    fn g1_batch(
        &self,
        w: Directions<'_, Self::Scalar>,
        wm: Directions<'_, Self::Scalar>,
        out: &mut [Self::Scalar],
    ) {
        self.each(G1, (w, wm), out);
    }

    #[inline]
    fn g2_batch(
        &self,
        wi: Directions<'_, Self::Scalar>,
        wo: Directions<'_, Self::Scalar>,
        wm: Directions<'_, Self::Scalar>,
        out: &mut [Self::Scalar],
    ) {
        self.each(G2, (wi, wo, wm), out);
    }

    #[inline]
    fn vndf_batch(
        &self,
        w: Directions<'_, Self::Scalar>,
        wm: Directions<'_, Self::Scalar>,
        out: &mut [Self::Scalar],
    ) {
        self.each(Vndf, (w, wm), out);
    }

    #[inline]
    fn sample_d_batch(&self, u: Numbers<'_, Self::Scalar>, out: DirectionsMut<'_, Self::Scalar>)
    where
        Self::Material: SampleNdf,
    {
        self.each(Normal, u, out);
    }

    #[inline]
    fn sample_vndf_batch(
        &self,
        w: Directions<'_, Self::Scalar>,
        u: Numbers<'_, Self::Scalar>,
        out: DirectionsMut<'_, Self::Scalar>,
    ) where
        Self::Material: StagedVndf,
    {
        self.each(VisibleNormal, (w, u), out);
    }
}
