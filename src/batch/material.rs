//! One material for all elements, or one for each.

use crate::batch::blocks::{Sink, Source, check};
use crate::batch::custom::Custom;
use crate::batch::simd::{self, Vectorized};
use crate::batch::stages::{Body, Builder, each};
use crate::blend::Blend;
use crate::bsdf::RoughConductor;
use crate::filter::gaussian::FilteredGgx;
use crate::map::Map;
use crate::microsurface::Microsurface;
use crate::ndf::Ndf;
use crate::ndf::staged::Forms;
use crate::transform::Transformed;

/// A material of batches. Sealed: the distributions of the crate, [`Custom`] for others,
/// [`RoughConductor`] on any of these, and references to them.
///
/// # Example
/// Code that is generic over a distribution and its batches asks for `Material<Local = N>`, and for
/// [`StagedVndf`](crate::batch::StagedVndf) where it samples visible normals.
/// ```
/// use microsurface::batch::{Directions, Material, NdfBatch, ReflectionBatch, StagedVndf};
/// use microsurface::{bsdf::RoughConductor, fresnel::Schlick};
/// fn shade<N>(surface: N, wo: Directions<f32>, wi: Directions<f32>, f: &mut [f32], d: &mut [f32])
/// where
///     N: StagedVndf<Scalar = f32> + Material<Local = N>,
/// {
///     surface.d_batch(wo, d);
///     RoughConductor::new(surface, Schlick::new(0.9_f32).unwrap()).eval_batch(wi, wo, f);
/// }
/// ```
pub trait Material: Copy + sealed::Material {
    /// The material itself, without references.
    type Local: Forms;
    #[doc(hidden)]
    fn local(&self) -> Self::Local;
}

macro_rules! by_value {
    ($([$($generics:tt)*] $material:ty;)*) => {
        $(impl<$($generics)*> sealed::Material for $material {}

        impl<$($generics)*> Material for $material {
            type Local = Self;
            #[inline(always)]
            fn local(&self) -> Self {
                *self
            }
        })*
    };
}
by_value! {
    [P: Forms, M: Map] Microsurface<P, M>;
    [N: Ndf + Forms] Transformed<N>;
    [A: Ndf + Copy, B: Copy] Blend<A, B>;
    [T: crate::Real, const N: usize] FilteredGgx<T, N>;
    [N: Ndf + Copy] Custom<N>;
}

impl<N: Material, F: Copy, S: Copy> sealed::Material for RoughConductor<N, F, S> {}

impl<N: Material, F: Copy, S: Copy> Material for RoughConductor<N, F, S> {
    type Local = RoughConductor<N::Local, F, S>;
    #[inline(always)]
    fn local(&self) -> Self::Local {
        self.with_surface(self.surface().local())
    }
}

impl<M: Material> sealed::Material for &M {}

impl<M: Material> Material for &M {
    type Local = M::Local;
    #[inline(always)]
    fn local(&self) -> M::Local {
        (**self).local()
    }
}

/// One [`Material`] for all elements, a slice with one for each, or one
/// [`Varied`](crate::batch::Varied) by numbers of each element. Sealed.
pub trait Materials: sealed::Materials {
    /// The type of the one, or of each; never a reference.
    type Material: Copy;
    /// Computes `body` for every element.
    #[doc(hidden)]
    fn each<B, I, O>(&self, body: B, input: I, output: O)
    where
        B: Body<Self::Material, I::Item, Out = O::Item>,
        I: Source,
        O: Sink;
}

mod sealed {
    pub trait Material {}
    pub trait Materials {}
    impl<M: super::Material> Materials for M {}
    impl<M: super::Material> Materials for [M] {}
    impl<B, V> Materials for crate::batch::Varied<'_, B, V> {}
}

impl<M: Material> Materials for M {
    type Material = M::Local;
    #[inline]
    fn each<B, I, O>(&self, body: B, input: I, output: O)
    where
        B: Body<M::Local, I::Item, Out = O::Item>,
        I: Source,
        O: Sink,
    {
        check((), input, &output);
        run::<_, _, B>(One { material: self, body, input, output });
    }
}

impl<M: Material> Materials for [M] {
    type Material = M::Local;
    #[inline]
    fn each<B, I, O>(&self, body: B, input: I, output: O)
    where
        B: Body<M::Local, I::Item, Out = O::Item>,
        I: Source,
        O: Sink,
    {
        each_built(self, Stored, body, input, output);
    }
}

/// Computes `body` for every element and its own material, built from the element's numbers.
#[inline(always)]
pub(super) fn each_built<P, M, B, I, O>(numbers: P, builder: M, body: B, input: I, output: O)
where
    P: Source,
    M: Builder<P::Item>,
    B: Body<M::Material, I::Item, Out = O::Item>,
    I: Source,
    O: Sink,
{
    check(numbers, input, &output);
    run::<_, _, B>(Many { numbers, builder, body, input, output });
}

/// Runs at the chosen vector level, or directly if the body has branches.
#[inline(always)]
fn run<M, I, B: Body<M, I>>(batch: impl Vectorized) {
    if B::STRAIGHT { simd::run(batch) } else { batch.run() }
}

/// Takes an element's own material as it is.
struct Stored;

impl<M: Material> Builder<M> for Stored {
    type Material = M::Local;
    type Built = M::Local;
    #[inline(always)]
    fn build(&self, material: M) -> M::Local {
        material.local()
    }
}

/// One material for every element; needs no input.
pub(super) struct Shared<'a, M>(pub(super) &'a M);

impl<'a, M> Builder<()> for Shared<'a, M> {
    type Material = M;
    type Built = &'a M;
    #[inline(always)]
    fn build(&self, (): ()) -> &'a M {
        self.0
    }
}

/// A batch of one material.
struct One<'a, M, B, I, O> {
    material: &'a M,
    body: B,
    input: I,
    output: O,
}

impl<M, B, I, O> One<'_, M, B, I, O>
where
    M: Material,
    B: Body<M::Local, I::Item, Out = O::Item>,
    I: Source,
    O: Sink,
{
    #[inline(always)]
    fn all(self, material: M::Local) {
        each((), &Shared(&material), &self.body, self.input, self.output);
    }
}

impl<M, B, I, O> Vectorized for One<'_, M, B, I, O>
where
    M: Material,
    B: Body<M::Local, I::Item, Out = O::Item>,
    I: Source,
    O: Sink,
{
    /// A loop for each form that is worth one; most materials have form 0 alone, which the compiler
    /// sees.
    #[inline(always)]
    fn run(self) {
        let material = self.material.local();
        if !B::STRAIGHT {
            return self.all(material);
        }
        match material.form() {
            0 => self.all(material.with_form(0)),
            1 => self.all(material.with_form(1)),
            2 => self.all(material.with_form(2)),
            _ => self.all(material),
        }
    }
}

/// A batch of a material for each element.
struct Many<P, M, B, I, O> {
    numbers: P,
    builder: M,
    body: B,
    input: I,
    output: O,
}

impl<P, M, B, I, O> Vectorized for Many<P, M, B, I, O>
where
    P: Source,
    M: Builder<P::Item>,
    B: Body<M::Material, I::Item, Out = O::Item>,
    I: Source,
    O: Sink,
{
    #[inline(always)]
    fn run(self) {
        each(self.numbers, &self.builder, &self.body, self.input, self.output);
    }
}
