//! The normals that the elements of a block sample, before all else.

use core::borrow::Borrow;

use crate::Real;
use crate::batch::blocks::{BLOCK, Body, Maker, Source};
use crate::beckmann::visible::{Inversion, To1e6, ToRounding, slopes_from_above};
use crate::ndf::{Course, Slopes};
use crate::real::converted;

/// The normals of a block, by components.
pub(super) struct Normals<T>([[T; BLOCK]; 3]);

impl<T: Copy> Normals<T> {
    #[inline(always)]
    fn put(&mut self, lane: usize, normal: [T; 3]) {
        let [x, y, z] = &mut self.0;
        [x[lane], y[lane], z[lane]] = normal;
    }

    #[inline(always)]
    pub(super) fn at(&self, lane: usize) -> [T; 3] {
        let [x, y, z] = &self.0;
        [x[lane], y[lane], z[lane]]
    }
}

/// The normals that the elements of a block sample.
///
/// As a pass of its own, so that a processor need not look as far ahead as from the start of a sample to its end.
#[inline(always)]
pub(super) fn normals<P, M, B, I>(
    of: P::Block<'_>,
    maker: &M,
    body: &B,
    arguments: I::Block<'_>,
) -> Normals<B::Number>
where
    P: Source,
    M: Maker<P::Item>,
    B: Body<M::Material, I::Item>,
    I: Source,
{
    let found = match course::<P, M, B, I>(of, maker, body) {
        Course::Branching | Course::Straight => None,
        Course::Solving => Some(slopes::<ToRounding, P, M, B, I>(of, maker, body, arguments)),
        Course::SolvingTo1e6 => Some(slopes::<To1e6, P, M, B, I>(of, maker, body, arguments)),
    };
    let mut normals = Normals([[B::Number::ZERO; BLOCK]; 3]);
    let mut all_usual = true;
    for lane in 0..BLOCK {
        let material = maker.made(P::item(of, lane));
        let slopes = match &found {
            None => Slopes::Solved,
            Some([along, across]) => Slopes::Found([along[lane], across[lane]]),
        };
        let (normal, usual) = body.usual_normal(material.borrow(), I::item(arguments, lane), slopes);
        all_usual &= usual;
        normals.put(lane, normal);
    }
    if !all_usual {
        for lane in 0..BLOCK {
            let material = maker.made(P::item(of, lane));
            normals.put(lane, body.normal(material.borrow(), I::item(arguments, lane)));
        }
    }
    normals
}

/// How a block goes about its normals: as all of its elements do. The compiler knows it, but of
/// elements that are known at run time alone.
#[inline(always)]
fn course<P, M, B, I>(of: P::Block<'_>, maker: &M, body: &B) -> Course
where
    P: Source,
    M: Maker<P::Item>,
    B: Body<M::Material, I::Item>,
    I: Source,
{
    let of_lane = |lane| body.course(maker.made(P::item(of, lane)).borrow());
    let first = of_lane(0);
    if (1..BLOCK).all(|lane| of_lane(lane) == first) { first } else { Course::Straight }
}

/// The slopes that the normals of a block are made of.
#[inline(always)]
fn slopes<V, P, M, B, I>(
    of: P::Block<'_>,
    maker: &M,
    body: &B,
    arguments: I::Block<'_>,
) -> [[B::Number; BLOCK]; 2]
where
    V: Inversion<B::Number>,
    P: Source,
    M: Maker<P::Item>,
    B: Body<M::Material, I::Item>,
    I: Source,
{
    let mut nu = [V::Wide::ZERO; BLOCK];
    let mut slopes = [[B::Number::ZERO; BLOCK]; 2];
    let [along, across] = &mut slopes;
    for (lane, ((nu, u1), u2)) in nu.iter_mut().zip(along).zip(across).enumerate() {
        let material = maker.made(P::item(of, lane));
        let mut equation = Default::default();
        body.usual_normal(material.borrow(), I::item(arguments, lane), Slopes::Asked(&mut equation));
        (*nu, [*u1, *u2]) = (converted(equation.0), equation.1);
    }
    slopes_from_above::<V, _, BLOCK>(&nu, &mut slopes);
    slopes
}
