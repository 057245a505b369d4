//! One material for all elements, or one for each.

use crate::batch::blocks::{Body, Sink, Source, check, each};
use crate::batch::dispatch::{Kernel, run};
use crate::bsdf::RoughConductor;
use crate::ndf::Ndf;

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

/// One [`Material`] for all elements, or a slice with one for each. Sealed.
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
        run(Same { material: self, body, input, output });
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
        check(self, input, &output);
        run(Various { materials: self, body, input, output });
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
        each((), |()| &material, &self.body, self.input, self.output);
    }
}

impl<M: Material, B: Body<M, I::Item, Out = O::Item>, I: Source, O: Sink> Kernel for Same<'_, M, B, I, O> {
    /// A loop for each form that is worth one; most materials have form 0 alone, which the compiler sees.
    #[inline(always)]
    fn run(self) {
        let material = *self.material;
        match material.form() {
            0 => self.all(material.with_form(0)),
            1 => self.all(material.with_form(1)),
            2 => self.all(material.with_form(2)),
            _ => self.all(material),
        }
    }
}

/// A material for each element.
struct Various<'a, M, B, I, O> {
    materials: &'a [M],
    body: B,
    input: I,
    output: O,
}

impl<M: Material, B: Body<M, I::Item, Out = O::Item>, I: Source, O: Sink> Kernel for Various<'_, M, B, I, O> {
    #[inline(always)]
    fn run(self) {
        each(self.materials, |material| material, &self.body, self.input, self.output);
    }
}
