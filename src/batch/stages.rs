//! The loop over blocks: ask, solve, draw the normals, compute.

use core::borrow::Borrow;

use crate::Real;
use crate::batch::blocks::{Sink, Source};
use crate::ndf::staged::{BLOCK, Solver};

/// A computation for each element of a batch: first the normal that it samples, if any, then the
/// rest.
pub trait Body<M, I> {
    /// The scalar of normals.
    type Number: Real;
    type Out;
    /// Whether all of it is straight-line code; if not, it is compiled for the build's own vectors
    /// alone.
    const STRAIGHT: bool;
    /// The equation that normals depend on.
    type Solver: Solver;
    fn ask(&self, material: &M, input: I) -> <Self::Solver as Solver>::Question;
    /// The normal by the common path, and whether that path applies.
    fn normal(
        &self,
        material: &M,
        input: I,
        answer: <Self::Solver as Solver>::Answer,
    ) -> ([Self::Number; 3], bool);
    /// The normal by the path that always applies.
    fn normal_in_full(&self, material: &M, input: I) -> [Self::Number; 3];
    /// The results, from the normal among others.
    fn result(&self, material: &M, input: I, normal: [Self::Number; 3]) -> Self::Out;
}

/// The stages of a [`Body`] that samples no normals.
macro_rules! without_normals {
    ($material:ty, $input:ty, $number:ty) => {
        type Number = $number;
        const STRAIGHT: bool = true;
        type Solver = ();
        #[inline(always)]
        fn ask(&self, _: &$material, _: $input) {}
        #[inline(always)]
        fn normal(&self, material: &$material, input: $input, (): ()) -> ([$number; 3], bool) {
            (self.normal_in_full(material, input), true)
        }
        #[inline(always)]
        fn normal_in_full(&self, _: &$material, _: $input) -> [$number; 3] {
            [<$number as $crate::Real>::ZERO; 3]
        }
    };
}
pub(super) use without_normals;

/// Builds the material of an element from its numbers. A trait, because large closures are not
/// reliably inlined.
pub(super) trait Builder<I> {
    type Material;
    type Built: Borrow<Self::Material>;
    fn build(&self, numbers: I) -> Self::Built;
}

/// Computes `body` for every element.
#[inline(always)]
pub(super) fn each<P, M, B, I, O>(numbers: P, builder: &M, body: &B, input: I, mut output: O)
where
    P: Source,
    M: Builder<P::Item>,
    B: Body<M::Material, I::Item, Out = O::Item>,
    I: Source,
    O: Sink,
{
    let Some(mut results) = output.first() else { return };
    let len = output.count();
    let (mut numbers_pad, mut pad) = (P::Pad::default(), I::Pad::default());
    let mut start = 0;
    while start < len {
        let numbers = numbers.block(start, &mut numbers_pad);
        let arguments = input.block(start, &mut pad);
        let normals = normals::<P, M, B, I>(numbers, builder, body, arguments);
        for lane in 0..BLOCK {
            let material = builder.build(P::item(numbers, lane));
            let argument = I::item(arguments, lane);
            O::put(&mut results, lane, body.result(material.borrow(), argument, normals.at(lane)));
        }
        output.write(start, &results);
        start += BLOCK;
    }
}

/// The normals of a block, by components.
struct Normals<T>([[T; BLOCK]; 3]);

impl<T: Copy> Normals<T> {
    #[inline(always)]
    fn put(&mut self, lane: usize, normal: [T; 3]) {
        let [x, y, z] = &mut self.0;
        [x[lane], y[lane], z[lane]] = normal;
    }

    #[inline(always)]
    fn at(&self, lane: usize) -> [T; 3] {
        let [x, y, z] = &self.0;
        [x[lane], y[lane], z[lane]]
    }
}

/// The normals that the elements of a block sample.
///
/// Separate passes, so that each dependency chain fits the out-of-order window of a processor.
#[inline(always)]
fn normals<P, M, B, I>(
    numbers: P::Block<'_>,
    builder: &M,
    body: &B,
    arguments: I::Block<'_>,
) -> Normals<B::Number>
where
    P: Source,
    M: Builder<P::Item>,
    B: Body<M::Material, I::Item>,
    I: Source,
{
    let mut equations = B::Solver::block();
    for lane in 0..BLOCK {
        let material = builder.build(P::item(numbers, lane));
        B::Solver::ask(&mut equations, lane, body.ask(material.borrow(), I::item(arguments, lane)));
    }
    B::Solver::solve(&mut equations);
    let mut normals = Normals([[B::Number::ZERO; BLOCK]; 3]);
    let mut all_usual = true;
    for lane in 0..BLOCK {
        let material = builder.build(P::item(numbers, lane));
        let answer = B::Solver::answer(&equations, lane);
        let (normal, usual) = body.normal(material.borrow(), I::item(arguments, lane), answer);
        all_usual &= usual;
        normals.put(lane, normal);
    }
    if !all_usual {
        for lane in 0..BLOCK {
            let material = builder.build(P::item(numbers, lane));
            normals.put(lane, body.normal_in_full(material.borrow(), I::item(arguments, lane)));
        }
    }
    normals
}
