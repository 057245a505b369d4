//! Functions of a few numbers of a material and a few arguments, timed as scalar calls and as loops
//! over slices.

extern crate alloc;

use alloc::rc::Rc;
use core::array::from_fn;
use core::hint::black_box;

use microsurface::Real;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::measure::Run;

/// Elements of a slice.
const BLOCK: usize = 64;

/// A structure of arrays.
type Block<T, const N: usize> = [[T; BLOCK]; N];

/// Arguments of `N` numbers each, shared by everything that is timed with them.
#[derive(Clone)]
pub(crate) struct Arguments<T, const N: usize>(Rc<[Block<T, N>]>);

/// A call of a material with arguments. No closure: that is inlined into only one of its
/// callers, and a loop over calls is no vector code.
pub(crate) trait Call<M, T, const N: usize, const OUT: usize>: Copy + 'static {
    fn call(self, material: &M, arguments: [T; N]) -> [T; OUT];
}

/// A [`Call`] of any scalar `T`, as a type.
macro_rules! call {
    ($name:ident<T: $bound:path $(, $p:ident: $other:path)*>: ($material:ty), $n:literal => $out:literal, $body:expr) => {
        #[derive(Clone, Copy)]
        struct $name;
        impl<T: $bound $(, $p: $other)*> $crate::blocks::Call<$material, T, $n, $out> for $name {
            #[inline(always)]
            fn call(self, material: &$material, arguments: [T; $n]) -> [T; $out] {
                $body(material, arguments)
            }
        }
    };
}
pub(crate) use call;

pub(crate) fn generator() -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(0x7061_7265_746f)
}

/// A number in [0, 1) of 24 bits, exact in f32.
pub(crate) fn uniform(rng: &mut Pcg64Mcg) -> f64 {
    f64::from(rng.random::<u32>() >> 8) * 2_f64.powi(-24)
}

impl<T: Real, const N: usize> Arguments<T, N> {
    /// At least `count` arguments, rounded to the scalar.
    pub(crate) fn draw(count: usize, mut draw: impl FnMut(&mut Pcg64Mcg) -> [f64; N]) -> Self {
        let mut rng = generator();
        let block = |_| {
            let mut block = [[T::ZERO; BLOCK]; N];
            for i in 0..BLOCK {
                for (numbers, number) in block.iter_mut().zip(draw(&mut rng)) {
                    numbers[i] = T::lit(number);
                }
            }
            block
        };
        Self((0..count.div_ceil(BLOCK)).map(block).collect())
    }

    /// The same as one array for each number.
    pub(crate) fn arrays(&self) -> [Vec<T>; N] {
        from_fn(|k| self.0.iter().flat_map(|block| block[k]).collect())
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len() * BLOCK
    }

    /// `see` of every material, argument and result.
    pub(crate) fn each<M, const OUT: usize>(
        &self,
        materials: &[M],
        call: impl Call<M, T, N, OUT>,
        mut see: impl FnMut(usize, [T; N], [T; OUT]),
    ) {
        let mut results = [[T::ZERO; BLOCK]; OUT];
        for (which, material) in materials.iter().enumerate() {
            for block in self.0.iter() {
                of_block(material, block, &mut results, call);
                for i in 0..BLOCK {
                    see(which, from_fn(|k| block[k][i]), from_fn(|k| results[k][i]));
                }
            }
        }
    }

    /// Scalar calls, whose results are opaque and whose materials take turns, and loops over slices
    /// of a material each.
    pub(crate) fn timed<M: Clone + 'static, const OUT: usize>(
        &self,
        materials: &[M],
        call: impl Call<M, T, N, OUT>,
    ) -> [Run; 2] {
        let calls = u32::try_from(self.len()).expect("fewer arguments");
        let (blocks, own) = (self.0.clone(), materials.to_vec());
        let scalar = Run::new(calls, move || {
            let mut turns = own.iter().cycle();
            for block in black_box(&blocks).iter() {
                #[expect(clippy::needless_range_loop, reason = "an element of each array")]
                for i in 0..BLOCK {
                    let Some(material) = turns.next() else { return };
                    black_box(call.call(material, from_fn(|k| block[k][i])));
                }
            }
        });
        let (blocks, own) = (self.0.clone(), materials.to_vec());
        let mut results = vec![[[T::ZERO; BLOCK]; OUT]; blocks.len()];
        let looped = Run::new(calls, move || {
            let slices = black_box(&blocks).iter().zip(&mut results);
            for ((block, results), material) in slices.zip(own.iter().cycle()) {
                of_block(material, block, results, call);
            }
            black_box(&mut results);
        });
        [scalar, looped]
    }
}

/// The loop over slices, which the compiler may make vector code of.
#[inline(never)]
fn of_block<M, T: Real, const N: usize, const OUT: usize>(
    material: &M,
    arguments: &Block<T, N>,
    results: &mut Block<T, OUT>,
    call: impl Call<M, T, N, OUT>,
) {
    for i in 0..BLOCK {
        let result = call.call(material, from_fn(|k| arguments[k][i]));
        for (results, result) in results.iter_mut().zip(result) {
            results[i] = result;
        }
    }
}
