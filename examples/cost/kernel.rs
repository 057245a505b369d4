//! Calls to be counted, and tables of them.

use alloc::rc::Rc;
use core::hint::black_box;

use microsurface::Real;

/// What calls take; each takes what it needs.
#[derive(Clone, Copy)]
pub(crate) struct Arguments<T: Real> {
    pub(crate) wi: T::Vec3,
    pub(crate) wo: T::Vec3,
    pub(crate) wm: T::Vec3,
    pub(crate) u: T::Vec2,
}

impl<T: Real> Arguments<T> {
    /// `n` of them: directions and normals uniform over the upper hemisphere, by multiples of
    /// irrational numbers.
    pub(crate) fn many(n: u32) -> Rc<[Self]> {
        let direction = |u: f64, v: f64| {
            let (sin, cos) = (core::f64::consts::TAU * u).sin_cos();
            let z = 1e-3 + 0.999 * v;
            let r = ((1.0 - z) * (1.0 + z)).sqrt();
            [r * cos, r * sin, z].map(T::lit).into()
        };
        (1..=n)
            .map(|i| {
                let [a, b, c, d, e, f, g, h] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0_f64]
                    .map(|x| (f64::from(i) * x.sqrt()).fract());
                let (wi, wo, wm) = (direction(a, b), direction(c, d), direction(e, f));
                Self { wi, wo, wm, u: [g, h].map(T::lit).into() }
            })
            .collect()
    }
}

/// Calls of one function.
pub(crate) struct Kernel {
    run: Box<dyn Fn(usize)>,
    /// Calls, or elements of a batch, in a pass.
    pub(crate) elements: u32,
}

impl Kernel {
    /// A pass of `run` is of this many elements.
    pub(crate) fn new(elements: u32, run: impl Fn(usize) + 'static) -> Self {
        Self { run: Box::new(run), elements }
    }

    /// `call` of each of the arguments, with nothing known of the material: what of a call depends
    /// on the material alone is not moved out of the loop, and calls are not merged to vectors.
    pub(crate) fn of_calls<N: 'static, A: 'static, R>(
        material: N,
        arguments: &Rc<[A]>,
        call: impl Fn(&N, &A) -> R + 'static,
    ) -> Self {
        let elements = u32::try_from(arguments.len()).expect("as many as were asked for");
        let arguments = Rc::clone(arguments);
        Self::new(elements, move |passes| {
            for _ in 0..passes {
                for argument in black_box(&*arguments) {
                    black_box(call(black_box(&material), argument));
                }
            }
        })
    }

    /// Runs it; out of line, because its name is where Valgrind begins and ends to count.
    #[inline(never)]
    pub(crate) fn counted_passes(&self, passes: usize) {
        (self.run)(passes);
        // So that the call returns here.
        black_box(());
    }
}

/// What the numbers of a table should show.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Claim {
    /// No number of a row is smaller than the one before it.
    Rising,
    /// All rows whose name ends with "linear" are the same.
    LinearAlike,
    Nothing,
}

pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) kernels: Vec<Kernel>,
}

pub(crate) struct Table {
    pub(crate) head: &'static str,
    pub(crate) columns: &'static [&'static str],
    pub(crate) rows: Vec<Row>,
    pub(crate) claim: Claim,
}
