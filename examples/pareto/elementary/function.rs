//! One function: its arguments, its exact values, and the errors and times of its alternatives.

use microsurface::Real;

use crate::Effort;
use crate::blocks::{Arguments, Call, uniform};
use crate::measure::{Errors, Run};
use crate::report::{Row, epsilon};

/// The domain of an argument that there is not.
pub(super) const NONE: (f64, f64) = (0.0, 0.0);

/// 50-digit values as sums of two f64.
const TABLE: &str = include_str!("../../../tests/reference/elementary.tsv");

/// What is asked about a function of one or two arguments.
pub(super) struct Function<T, const OUT: usize> {
    pub(super) name: &'static str,
    /// Its names in the table, one for each result.
    pub(super) in_table: [&'static str; OUT],
    /// For f32.
    pub(super) exact: fn(f64, f64) -> [f64; OUT],
    /// Where arguments are drawn: half of them uniformly, and of half of them the first's
    /// logarithm, from 1e-6 times the end that is farther from 0, of either sign.
    pub(super) domain: [(f64, f64); 2],
    /// The results count their errors in ulp of 1.
    pub(super) absolute: bool,
    pub(super) scalar: core::marker::PhantomData<T>,
}

/// Arguments, and each result as a sum.
type Known<const OUT: usize> = ([f64; 2], [(f64, f64); OUT]);

/// What has been asked.
#[derive(Default)]
pub(super) struct Answers {
    pub(super) rows: Vec<Row>,
    pub(super) runs: Vec<[Run; 2]>,
}

/// An ulp of a value.
fn ulp(scalar: &str, value: f64, absolute: bool) -> f64 {
    let least = if scalar == "f64" { f64::MIN_POSITIVE } else { f32::MIN_POSITIVE.into() };
    let magnitude = if absolute { 1.0 } else { value.abs().max(least) };
    // The power of two below it.
    f64::from_bits(magnitude.to_bits() & 0x7ff0_0000_0000_0000) * epsilon(scalar)
}

impl<T: Real, const OUT: usize> Function<T, OUT> {
    pub(super) fn arguments(&self, count: usize) -> Arguments<T, 2> {
        Arguments::draw(count, |rng| {
            let [kind, sign, a, b] = [(); 4].map(|()| uniform(rng));
            let of = |u: f64, (from, to): (f64, f64)| from + (to - from) * u;
            let (from, to) = self.domain[0];
            let farther = from.abs().max(to.abs());
            let magnitude = farther * 10_f64.powf(-6.0 * a);
            let small = if sign < 0.5 { magnitude } else { -magnitude };
            let x = if kind < 0.5 || small < from || small > to { of(a, (from, to)) } else { small };
            [x, of(b, self.domain[1])]
        })
    }

    fn add(&self, errors: &mut Errors, [x, g]: [T; 2], got: [T; OUT], exact: [(f64, f64); OUT]) {
        let scalar = core::any::type_name::<T>();
        for (got, (high, low)) in got.into_iter().zip(exact) {
            let got = got.to_f64();
            // Both may be infinite.
            #[expect(clippy::float_cmp, reason = "the same number, or the same infinity")]
            let same = got == high || T::lit(high) == T::lit(got) && !got.is_finite();
            let difference = if same { -low } else { (got - high) - low };
            errors.add(difference / ulp(scalar, high, self.absolute), || match self.domain[1] {
                NONE => format!("{:.6e}", x.to_f64()),
                _ => format!("{:.6e}, {:.6e}", x.to_f64(), g.to_f64()),
            });
        }
    }

    /// The rows of the table: arguments, and each result as a sum.
    fn table(&self) -> Vec<Known<OUT>> {
        let mut table: Vec<Known<OUT>> = Vec::new();
        for (result, name) in self.in_table.iter().enumerate() {
            let lines = TABLE.lines().filter(|line| line.split('\t').next() == Some(name));
            for (i, line) in lines.enumerate() {
                let mut numbers = line.split('\t').skip(1).map(|field| field.parse().unwrap_or(f64::NAN));
                let mut number = || numbers.next().unwrap_or(f64::NAN);
                let (x, g, high, low) = (number(), number(), number(), number());
                if result == 0 {
                    table.push(([x, g], [(high, low); OUT]));
                } else {
                    table[i].1[result] = (high, low);
                }
            }
        }
        table
    }

    /// Answers for one alternative.
    pub(super) fn ask(
        &self,
        answers: &mut Answers,
        effort: &Effort,
        arguments: &Arguments<T, 2>,
        name: &str,
        call: impl Call<(), T, 2, OUT>,
    ) {
        let (mut errors, scalar) = (Errors::default(), core::any::type_name::<T>());
        if scalar == "f64" {
            // Angles of many turns are another question.
            for (at, exact) in self.table().into_iter().filter(|(at, _)| !self.absolute || at[0].abs() <= 1.0)
            {
                let at = at.map(T::lit);
                self.add(&mut errors, at, call.call(&(), at), exact);
            }
        } else {
            self.arguments(effort.samples).each(&[()], call, |_, at, got| {
                let exact = (self.exact)(at[0].to_f64(), at[1].to_f64()).map(|value| (value, 0.0));
                self.add(&mut errors, at, got, exact);
            });
        }
        let (group, name) = (self.name.into(), name.into());
        answers.rows.push(Row { group, name, scalar, errors, in_ulp: true, ..Row::default() });
        answers.runs.push(arguments.timed(&[()], call));
    }
}
