//! The slopes of a block of visible normals, solved together.

use super::guess::Outset;
use super::view::View;
use super::{Inversion, slope_at, steps, within};
use crate::ndf::staged::{BLOCK, Solver};
use crate::real::{Real, converted};

/// The slopes along and across the view of a block of samples; they take longer than all else.
#[derive(Debug)]
pub struct VisibleSlopes<I: Inversion<T>, T: Real> {
    nu: [I::Wide; BLOCK],
    /// u, then the slopes.
    slopes: [[T; BLOCK]; 2],
}

impl<I: Inversion<T>, T: Real> Solver for VisibleSlopes<I, T> {
    /// ν and u.
    type Question = (I::Wide, [T; 2]);
    /// The slopes along the view and across it.
    type Answer = [T; 2];
    type Block = Self;

    #[inline(always)]
    fn block() -> Self {
        Self { nu: [I::Wide::ZERO; BLOCK], slopes: [[T::ZERO; BLOCK]; 2] }
    }

    #[inline(always)]
    fn ask(block: &mut Self, lane: usize, (nu, [u1, u2]): Self::Question) {
        block.nu[lane] = nu;
        (block.slopes[0][lane], block.slopes[1][lane]) = (u1, u2);
    }

    #[inline(always)]
    fn solve(block: &mut Self) {
        slopes_from_above::<I, T, BLOCK>(&block.nu, &mut block.slopes);
    }

    #[inline(always)]
    fn answer(block: &Self, lane: usize) -> [T; 2] {
        [block.slopes[0][lane], block.slopes[1][lane]]
    }
}

/// [`slopes`](super::slopes) of many ν ≥ 0 at once, instead of u; where ν is negative or NaN,
/// meaningless numbers.
///
/// Each is one long chain of operations, longer than a processor looks ahead, so that a loop over
/// the whole chain waits for it. Loops over its parts overlap those of several elements. The
/// operations are those of [`slopes`](super::slopes), to the bit.
#[inline(always)]
pub(super) fn slopes_from_above<I: Inversion<T>, T: Real, const N: usize>(
    nu: &[I::Wide; N],
    [u, across]: &mut [[T; N]; 2],
) {
    let (narrow, wide) = ([T::ZERO; N], [I::Wide::ZERO; N]);
    let mut views = Views { nu, b: wide, total: wide };
    let mut outsets = Outsets { unit: narrow, b: narrow, bv: narrow, e: narrow, erfc: narrow, total: narrow };
    for (i, &nu) in nu.iter().enumerate() {
        let (view, outset) = View::from_above(nu, I::FIT);
        views.put(i, &view);
        outsets.put(i, &outset);
    }
    let (mut gap, mut a) = (narrow, narrow);
    for i in 0..N {
        (gap[i], a[i]) = outsets.at(i).mass(within(u[i]));
    }
    for i in 0..N {
        a[i] = outsets.at(i).distance(within(u[i]), a[i]);
    }
    let (mut xi, mut f) = (wide, wide);
    for i in 0..N {
        (xi[i], f[i]) = views.at(i).at(outsets.at(i).without_excess(within(u[i]), gap[i], a[i]));
    }
    let (mut sum, mut density) = (wide, wide);
    for _ in 0..steps::<T>() {
        for i in 0..N {
            (sum[i], density[i]) = views.at(i).distribution((xi[i], f[i]), I::FIT);
        }
        for i in 0..N {
            let u = converted(within(u[i]));
            (xi[i], f[i]) = views.at(i).step((xi[i], f[i]), u, (sum[i], density[i]));
        }
    }
    for i in 0..N {
        u[i] = converted(slope_at(&views.at(i), nu[i], xi[i]));
    }
    for u in across {
        *u = I::slope_across(within(*u));
    }
}

/// Views from above, number by number.
struct Views<'a, W, const N: usize> {
    nu: &'a [W; N],
    b: [W; N],
    total: [W; N],
}

impl<W: Real, const N: usize> Views<'_, W, N> {
    #[inline(always)]
    fn put(&mut self, i: usize, view: &View<W>) {
        (self.b[i], self.total[i]) = (view.b, view.total);
    }

    #[inline(always)]
    fn at(&self, i: usize) -> View<W> {
        View::again(self.nu[i], self.b[i], self.total[i])
    }
}

/// Parameters of the guesses.
struct Outsets<G, const N: usize> {
    unit: [G; N],
    b: [G; N],
    bv: [G; N],
    e: [G; N],
    erfc: [G; N],
    total: [G; N],
}

impl<G: Real, const N: usize> Outsets<G, N> {
    #[inline(always)]
    fn put(&mut self, i: usize, outset: &Outset<G>) {
        (self.unit[i], self.b[i], self.bv[i]) = (outset.unit, outset.b, outset.bv);
        (self.e[i], self.erfc[i], self.total[i]) = (outset.e, outset.erfc, outset.total);
    }

    #[inline(always)]
    fn at(&self, i: usize) -> Outset<G> {
        let (unit, b, bv) = (self.unit[i], self.b[i], self.bv[i]);
        let (e, erfc, total) = (self.e[i], self.erfc[i], self.total[i]);
        Outset { below: false, n: G::ZERO, unit, b, bv, e, k: G::ZERO, erfc, total }
    }
}
