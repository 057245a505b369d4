//! Arrays that a batch reads and writes, a block at a time.
//!
//! A block is a local array, so that the compiler knows without asking at run time that nothing it
//! writes is read again, however many slices take part. The last block is filled up and computed as
//! a whole, so that there is no second, scalar loop for the rest.

use crate::batch::arrays::{Directions, DirectionsMut, Numbers, Samples};
use crate::ndf::staged::BLOCK;

/// Arrays that a batch reads. Sealed: slices, [`Directions`], [`Numbers`],
/// [`Footprints`](crate::batch::Footprints), the numbers of a [`Varied`](crate::batch::Varied)
/// material, and pairs and triples of them.
pub trait Source: Copy + sealed::Source {
    /// A slice's element, an array of components, or a tuple of such.
    type Item;
    /// A block of its own, for a last one that is not full.
    #[doc(hidden)]
    type Pad: Default;
    #[doc(hidden)]
    type Block<'b>: Copy
    where
        Self: 'b;
    /// The first length that is not `len`.
    #[doc(hidden)]
    fn uneven(self, len: usize) -> Option<usize>;
    /// The block from `start` on, which is below the length.
    #[doc(hidden)]
    fn block<'b>(self, start: usize, pad: &'b mut Self::Pad) -> Self::Block<'b>
    where
        Self: 'b;
    #[doc(hidden)]
    fn item<'b>(block: Self::Block<'b>, lane: usize) -> Self::Item
    where
        Self: 'b;
}

/// Arrays that a batch writes. Sealed: slices, [`DirectionsMut`], [`Samples`], and pairs
/// of slices.
pub trait Sink: sealed::Sink {
    /// A slice's element, or a tuple of components.
    type Item;
    #[doc(hidden)]
    type Block;
    #[doc(hidden)]
    fn count(&self) -> usize;
    /// The first length that is not `len`.
    #[doc(hidden)]
    fn uneven(&self, len: usize) -> Option<usize>;
    /// A block to begin with; `None` where there is nothing to write.
    #[doc(hidden)]
    fn first(&self) -> Option<Self::Block>;
    #[doc(hidden)]
    fn put(block: &mut Self::Block, lane: usize, item: Self::Item);
    /// Writes the block from `start` on, as far as there is room.
    #[doc(hidden)]
    fn write(&mut self, start: usize, block: &Self::Block);
}

pub(super) mod sealed {
    pub trait Source {}
    pub trait Sink {}
}

/// # Panics
/// Unless all slices are as long as the output's first.
#[inline]
pub(super) fn check<P: Source, I: Source, O: Sink>(materials: P, input: I, output: &O) {
    let len = output.count();
    if let Some(other) = output.uneven(len).or_else(|| materials.uneven(len)).or_else(|| input.uneven(len)) {
        differ(len, other);
    }
}

#[cold]
#[inline(never)]
fn differ(len: usize, other: usize) -> ! {
    panic!("slices of a batch differ in length: {len} and {other}")
}

#[inline(always)]
fn unless(len: usize, expected: usize) -> Option<usize> {
    if len == expected { None } else { Some(len) }
}

impl<S: Copy> sealed::Source for &[S] {}

impl<'a, S: Copy> Source for &'a [S] {
    type Item = S;
    type Pad = Option<[S; BLOCK]>;
    type Block<'b>
        = &'b [S; BLOCK]
    where
        Self: 'b;
    #[inline(always)]
    fn uneven(self, len: usize) -> Option<usize> {
        unless(self.len(), len)
    }
    #[inline(always)]
    fn block<'b>(self, start: usize, pad: &'b mut Self::Pad) -> &'b [S; BLOCK]
    where
        'a: 'b,
    {
        let rest = &self[start..];
        if let Some(full) = rest.first_chunk() {
            full
        } else {
            let pad = pad.insert([rest[0]; BLOCK]);
            pad[..rest.len()].copy_from_slice(rest);
            pad
        }
    }
    #[inline(always)]
    fn item<'b>(block: &'b [S; BLOCK], lane: usize) -> S
    where
        'a: 'b,
    {
        block[lane]
    }
}

impl<S: Copy> sealed::Sink for &mut [S] {}

impl<S: Copy> Sink for &mut [S] {
    type Item = S;
    type Block = [S; BLOCK];
    #[inline(always)]
    fn count(&self) -> usize {
        (**self).len()
    }
    #[inline(always)]
    fn uneven(&self, len: usize) -> Option<usize> {
        unless(Sink::count(self), len)
    }
    #[inline(always)]
    fn first(&self) -> Option<Self::Block> {
        <[S]>::first(self).map(|&first| [first; BLOCK])
    }
    #[inline(always)]
    fn put(block: &mut Self::Block, lane: usize, item: S) {
        block[lane] = item;
    }
    #[inline(always)]
    fn write(&mut self, start: usize, block: &Self::Block) {
        let rest = &mut self[start..];
        match rest.first_chunk_mut() {
            Some(full) => *full = *block,
            None => rest.copy_from_slice(&block[..rest.len()]),
        }
    }
}

impl sealed::Source for () {}

/// Nothing that differs between elements.
impl Source for () {
    type Item = ();
    type Pad = ();
    type Block<'b> = ();
    #[inline(always)]
    fn uneven(self, _: usize) -> Option<usize> {
        None
    }
    #[inline(always)]
    fn block<'b>(self, _: usize, (): &'b mut ())
    where
        Self: 'b,
    {
    }
    #[inline(always)]
    fn item<'b>((): (), _: usize)
    where
        Self: 'b,
    {
    }
}

/// Sources and sinks that consist of several.
macro_rules! composed {
    (
        source [$($generics:tt)*] $source:ty, $item:ty = ($($field:tt: $part:ty => $index:tt),*), |$parts:ident| $make:expr
    ) => {
        impl<$($generics)*> crate::batch::blocks::sealed::Source for $source {}

        impl<$($generics)*> Source for $source {
            type Item = $item;
            type Pad = ($(<$part as Source>::Pad,)*);
            type Block<'b> = ($(<$part as Source>::Block<'b>,)*) where Self: 'b;
            #[inline(always)]
            fn uneven(self, len: usize) -> Option<usize> {
                None$(.or_else(|| self.$field.uneven(len)))*
            }
            #[inline(always)]
            fn block<'b>(self, start: usize, pad: &'b mut Self::Pad) -> Self::Block<'b>
            where
                Self: 'b,
            {
                ($(self.$field.block(start, &mut pad.$index),)*)
            }
            #[inline(always)]
            fn item<'b>(block: Self::Block<'b>, lane: usize) -> Self::Item
            where
                Self: 'b,
            {
                let $parts = ($(<$part as Source>::item(block.$index, lane),)*);
                $make
            }
        }
    };
    (sink [$($generics:tt)*] $sink:ty, $item:ty = ($first:tt, $($field:tt: $part:ty => $index:tt),*)) => {
        impl<$($generics)*> crate::batch::blocks::sealed::Sink for $sink {}

        impl<$($generics)*> Sink for $sink {
            type Item = $item;
            type Block = ($(<$part as Sink>::Block,)*);
            #[inline(always)]
            fn count(&self) -> usize {
                Sink::count(&self.$first)
            }
            #[inline(always)]
            fn uneven(&self, len: usize) -> Option<usize> {
                None$(.or_else(|| Sink::uneven(&self.$field, len)))*
            }
            #[inline(always)]
            fn first(&self) -> Option<Self::Block> {
                Some(($(Sink::first(&self.$field)?,)*))
            }
            #[inline(always)]
            fn put(block: &mut Self::Block, lane: usize, item: Self::Item) {
                $(<$part as Sink>::put(&mut block.$index, lane, item.$index);)*
            }
            #[inline(always)]
            fn write(&mut self, start: usize, block: &Self::Block) {
                $(Sink::write(&mut self.$field, start, &block.$index);)*
            }
        }
    };
}
pub(super) use composed;

composed!(source ['a, T: Copy] Directions<'a, T>, [T; 3] = (x: &'a [T] => 0, y: &'a [T] => 1, z: &'a [T] => 2), |v| v.into());
composed!(source ['a, T: Copy] Numbers<'a, T>, [T; 2] = (x: &'a [T] => 0, y: &'a [T] => 1), |u| u.into());
composed!(source [A: Source, B: Source] (A, B), (A::Item, B::Item) = (0: A => 0, 1: B => 1), |ab| ab);
composed!(source [A: Source, B: Source, C: Source] (A, B, C), (A::Item, B::Item, C::Item) = (0: A => 0, 1: B => 1, 2: C => 2), |abc| abc);
composed!(sink ['a, T: Copy] DirectionsMut<'a, T>, (T, T, T) = (x, x: &'a mut [T] => 0, y: &'a mut [T] => 1, z: &'a mut [T] => 2));
composed!(sink ['a, T: Copy, S: Copy] Samples<'a, T, S>, ((T, T, T), S, T) = (wi, wi: DirectionsMut<'a, T> => 0, weight: &'a mut [S] => 1, pdf: &'a mut [T] => 2));
composed!(sink ['a, S: Copy, T: Copy] (&'a mut [S], &'a mut [T]), (S, T) = (0, 0: &'a mut [S] => 0, 1: &'a mut [T] => 1));
