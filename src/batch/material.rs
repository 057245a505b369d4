//! One material for all elements, or one for each.

use core::borrow::Borrow;

use crate::batch::blocks::{Body, Maker, Sink, Source, check, each};
use crate::batch::simd::{self, Kernel};
use crate::bsdf::RoughConductor;
use crate::ndf::{Course, Ndf};

/// A material of batches: any [`Ndf`] or [`RoughConductor`] that is `Copy`.
pub trait Material: Copy {
    /// See [`Ndf::form`].
    #[doc(hidden)]
    fn form(&self) -> usize;
    /// See [`Ndf::with_form`].
    #[doc(hidden)]
    #[must_use]
    fn with_form(self, form: usize) -> Self;
}

impl<N: Ndf + Copy> Material for N {
    #[inline(always)]
    fn form(&self) -> usize {
        Ndf::form(self)
    }
    #[inline(always)]
    fn with_form(self, form: usize) -> Self {
        Ndf::with_form(self, form)
    }
}

impl<N: Ndf + Copy, F: Copy, S: Copy> Material for RoughConductor<N, F, S> {
    #[inline(always)]
    fn form(&self) -> usize {
        Ndf::form(self.surface())
    }
    #[inline(always)]
    fn with_form(self, form: usize) -> Self {
        self.with_surface_form(form)
    }
}

/// One [`Material`] for all elements, a slice with one for each, or one [`Varied`](crate::batch::Varied) by numbers of each
/// element. Sealed.
pub trait Materials: sealed::Sealed {
    /// The type of the one, or of each.
    type Material: Material;
    /// `body` of every element.
    #[doc(hidden)]
    fn each<B, I, O>(&self, body: B, input: I, output: O)
    where
        B: Body<Self::Material, I::Item, Out = O::Item>,
        I: Source,
        O: Sink;
}

mod sealed {
    pub trait Sealed {}
    impl<M: super::Material> Sealed for M {}
    impl<M: super::Material> Sealed for [M] {}
    impl<B, V> Sealed for crate::batch::Varied<'_, B, V> {}
}

impl<M: Material> Materials for M {
    type Material = M;
    #[inline]
    fn each<B, I, O>(&self, body: B, input: I, output: O)
    where
        B: Body<M, I::Item, Out = O::Item>,
        I: Source,
        O: Sink,
    {
        check((), input, &output);
        let course = body.course(self);
        run(course, Same { material: self, body, input, output });
    }
}

impl<M: Material> Materials for [M] {
    type Material = M;
    #[inline]
    fn each<B, I, O>(&self, body: B, input: I, output: O)
    where
        B: Body<M, I::Item, Out = O::Item>,
        I: Source,
        O: Sink,
    {
        each_of(self, Own, body, input, output);
    }
}

/// `body` of every element and its own material, made of the element's numbers.
#[inline(always)]
pub(super) fn each_of<P, M, B, I, O>(numbers: P, maker: M, body: B, input: I, output: O)
where
    P: Source,
    M: Maker<P::Item>,
    B: Body<M::Material, I::Item, Out = O::Item>,
    I: Source,
    O: Sink,
{
    check(numbers, input, &output);
    if output.count() == 0 {
        return;
    }
    let course = body.course(maker.made(P::item(numbers.block(0, &mut P::Pad::default()), 0)).borrow());
    run(course, Various { numbers, maker, body, input, output });
}

/// At the level in use, where there are vectors to be had.
#[inline(always)]
fn run(course: Course, kernel: impl Kernel) {
    if course == Course::Branching { kernel.run() } else { simd::run(kernel) }
}

/// An element's own material, as it is.
struct Own;
impl<M> Maker<M> for Own {
    type Material = M;
    type Made = M;
    #[inline(always)]
    fn made(&self, material: M) -> M {
        material
    }
}

/// One material, of nothing.
pub(super) struct Shared<'a, M>(pub(super) &'a M);
impl<'a, M> Maker<()> for Shared<'a, M> {
    type Material = M;
    type Made = &'a M;
    #[inline(always)]
    fn made(&self, (): ()) -> &'a M {
        self.0
    }
}

/// One material for all elements.
struct Same<'a, M, B, I, O> {
    material: &'a M,
    body: B,
    input: I,
    output: O,
}

impl<M: Material, B: Body<M, I::Item, Out = O::Item>, I: Source, O: Sink> Same<'_, M, B, I, O> {
    #[inline(always)]
    fn all(self, material: M) {
        each((), &Shared(&material), &self.body, self.input, self.output);
    }
}

impl<M: Material, B: Body<M, I::Item, Out = O::Item>, I: Source, O: Sink> Kernel for Same<'_, M, B, I, O> {
    /// A loop for each form that is worth one; most materials have form 0 alone, which the compiler sees.
    #[inline(always)]
    fn run(self) {
        let material = *self.material;
        if self.body.course(&material) == Course::Branching {
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

/// A material for each element.
struct Various<P, M, B, I, O> {
    numbers: P,
    maker: M,
    body: B,
    input: I,
    output: O,
}

impl<P, M, B, I, O> Kernel for Various<P, M, B, I, O>
where
    P: Source,
    M: Maker<P::Item>,
    B: Body<M::Material, I::Item, Out = O::Item>,
    I: Source,
    O: Sink,
{
    #[inline(always)]
    fn run(self) {
        each(self.numbers, &self.maker, &self.body, self.input, self.output);
    }
}
