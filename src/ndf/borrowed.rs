//! The traits of references.

use crate::ndf::{Course, Ndf, SampleNdf, SampleVndf, Slopes, Vec2, Vec3};

/// A borrowed distribution is one: for materials that share a large one, and for batches of one that is not `Copy`.
///
/// In a [`batch`](crate::batch) it takes as long as the distribution itself. Masks of GTR of a real
/// γ above 2 alone take longer, since which of their forms they have is asked for each element:
/// pass those by value.
impl<N: Ndf + ?Sized> Ndf for &N {
    type Scalar = N::Scalar;
    #[inline(always)]
    fn d(&self, wm: Vec3<N>) -> N::Scalar {
        (**self).d(wm)
    }
    #[inline(always)]
    fn sigma(&self, w: Vec3<N>) -> N::Scalar {
        (**self).sigma(w)
    }
    #[inline(always)]
    fn lambda(&self, w: Vec3<N>) -> N::Scalar {
        (**self).lambda(w)
    }
    #[inline(always)]
    fn sigma_above(&self, w: Vec3<N>) -> N::Scalar {
        (**self).sigma_above(w)
    }
    #[inline(always)]
    fn d_along(&self, h: Vec3<N>) -> N::Scalar {
        (**self).d_along(h)
    }
    #[inline(always)]
    fn d_times(&self, wm: Vec3<N>, fraction: [N::Scalar; 2]) -> N::Scalar {
        (**self).d_times(wm, fraction)
    }
    #[inline(always)]
    fn d_along_times(&self, h: Vec3<N>, fraction: [N::Scalar; 2]) -> N::Scalar {
        (**self).d_along_times(h, fraction)
    }
    #[inline(always)]
    fn masked_cosines(&self, wi: Vec3<N>, wo: Vec3<N>) -> N::Scalar {
        (**self).masked_cosines(wi, wo)
    }
    #[inline(always)]
    fn p22(&self, slope: Vec2<N>) -> N::Scalar {
        (**self).p22(slope)
    }
    #[inline(always)]
    fn g1(&self, w: Vec3<N>, wm: Vec3<N>) -> N::Scalar {
        (**self).g1(w, wm)
    }
    #[inline(always)]
    fn g2(&self, wi: Vec3<N>, wo: Vec3<N>, wm: Vec3<N>) -> N::Scalar {
        (**self).g2(wi, wo, wm)
    }
    #[inline(always)]
    fn g2_separable(&self, wi: Vec3<N>, wo: Vec3<N>, wm: Vec3<N>) -> N::Scalar {
        (**self).g2_separable(wi, wo, wm)
    }
    #[inline(always)]
    fn vndf(&self, w: Vec3<N>, wm: Vec3<N>) -> N::Scalar {
        (**self).vndf(w, wm)
    }
}

impl<N: SampleNdf + ?Sized> SampleNdf for &N {
    #[inline(always)]
    fn sample_d(&self, u: Vec2<N>) -> Vec3<N> {
        (**self).sample_d(u)
    }
    #[inline(always)]
    fn pdf_d(&self, wm: Vec3<N>) -> N::Scalar {
        (**self).pdf_d(wm)
    }
}

impl<N: SampleVndf + ?Sized> SampleVndf for &N {
    #[inline(always)]
    fn course(&self) -> Course {
        (**self).course()
    }
    #[inline(always)]
    fn sample_vndf(&self, w: Vec3<N>, u: Vec2<N>) -> Vec3<N> {
        (**self).sample_vndf(w, u)
    }
    #[inline(always)]
    fn sample_along(&self, w: Vec3<N>, u: Vec2<N>) -> Vec3<N> {
        (**self).sample_along(w, u)
    }
    #[inline(always)]
    fn usual_sample_along(&self, w: Vec3<N>, u: Vec2<N>, slopes: Slopes<'_, N::Scalar>) -> (Vec3<N>, bool) {
        (**self).usual_sample_along(w, u, slopes)
    }
    #[inline(always)]
    fn sample_of_along(&self, along: Vec3<N>) -> Vec3<N> {
        (**self).sample_of_along(along)
    }
}
