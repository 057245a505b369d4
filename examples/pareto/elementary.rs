//! Elementary functions: the crate's, those of std and of the libm crate, and the short fits of
//! renderers.
//!
//! Errors in ulp of the exact value: of f32 from f64 functions of another origin (for the inverse
//! and scaled error functions the crate's own, which tests hold against 50 digits), of f64 from the
//! 50-digit tables of the tests.

use std::io::{self, Write};

use core::marker::PhantomData;
use microsurface::elementary as e;

use crate::Effort;
use crate::blocks::call;
use crate::measure::pairs_of_times;
use crate::report::report;
use function::{Answers, Function, NONE};
use libraries::Libraries;

pub(crate) mod fits;
mod function;
mod libraries;

/// Arguments in a round of timing.
const TIMED: usize = 1 << 14;

/// A function with one result.
fn function<T>(name: &'static str, exact: fn(f64, f64) -> [f64; 1], first: (f64, f64)) -> Function<T, 1> {
    Function { name, in_table: [name], exact, domain: [first, NONE], absolute: false, scalar: PhantomData }
}

/// Asks about a function of so many results, alternative by alternative.
macro_rules! ask {
    ($answers:ident, $effort:ident, $function:expr, $out:literal;
     $($name:literal: |$x:pat_param, $g:pat_param| $call:expr;)*) => {
        let function = $function;
        let arguments = function.arguments(TIMED);
        $({
            #[inline(always)]
            fn alternative<T: Libraries>((): &(), [$x, $g]: [T; 2]) -> [T; $out] {
                $call
            }
            call!(Alternative<T: Libraries>: (()), 2 => $out, alternative);
            function.ask(&mut $answers, $effort, &arguments, $name, Alternative);
        })*
    };
}

#[rustfmt::skip]
fn powers<T: Libraries>(effort: &Effort) -> Answers {
    let mut answers = Answers::default();
    ask! { answers, effort, function::<T>("exp", |x, _| [x.exp()], (-87.0, 88.0)), 1;
        "elementary": |x, _| [e::exp(x)];
        "std": |x, _| [x.exp()];
        "libm": |x, _| [x.libm_exp()];
        "2ⁿ × a cubic": |x, _| [fits::exp_cubic(x)];
    }
    let vanishing = Function {
        name: "exp of denormal results",
        in_table: ["exp"],
        ..function::<T>("exp", |x, _| [x.exp()], if T::WIDENS { (-103.0, -87.4) } else { (-744.0, -708.5) })
    };
    ask! { answers, effort, vanishing, 1;
        "elementary": |x, _| [e::exp(x)];
        "std": |x, _| [x.exp()];
        "libm": |x, _| [x.libm_exp()];
    }
    let binary = if T::WIDENS { (-126.0, 127.0) } else { (-1022.0, 1023.0) };
    ask! { answers, effort, function::<T>("exp2", |x, _| [x.exp2()], binary), 1;
        "elementary": |x, _| [e::exp2(x)];
        "std": |x, _| [x.std_exp2()];
        "libm": |x, _| [x.libm_exp2()];
    }
    ask! { answers, effort, function::<T>("exp_m1", |x, _| [x.exp_m1()], (-2.0, 2.0)), 1;
        "elementary": |x, _| [e::exp_m1(x)];
        "std": |x, _| [x.std_exp_m1()];
        "libm": |x, _| [x.libm_exp_m1()];
    }
    ask! { answers, effort, function::<T>("ln", |x, _| [x.ln()], (0.0, 4.0)), 1;
        "elementary": |x, _| [e::ln(x)];
        "std": |x, _| [x.ln()];
        "libm": |x, _| [x.libm_ln()];
    }
    ask! { answers, effort, function::<T>("log2", |x, _| [x.log2()], (0.0, 4.0)), 1;
        "elementary": |x, _| [e::log2(x)];
        "std": |x, _| [x.std_log2()];
        "libm": |x, _| [x.libm_log2()];
    }
    ask! { answers, effort, function::<T>("ln_1p", |x, _| [x.ln_1p()], (-1.0, 2.0)), 1;
        "elementary": |x, _| [e::ln_1p(x)];
        "std": |x, _| [x.std_ln_1p()];
        "libm": |x, _| [x.libm_ln_1p()];
    }
    let pow = Function { domain: [(0.0, 4.0), (-6.0, 6.0)], ..function::<T>("pow", |x, g| [x.powf(g)], NONE) };
    ask! { answers, effort, pow, 1;
        "elementary": |x, g| [e::pow_wide(x.widen(), g)];
        "std": |x, g| [x.powf(g)];
        "libm": |x, g| [x.libm_pow(g)];
    }
    answers
}

#[rustfmt::skip]
fn angles<T: Libraries>(effort: &Effort) -> Answers {
    let mut answers = Answers::default();
    let turns = Function {
        name: "sin and cos of turns, ulp of 1",
        in_table: ["sin_turns", "cos_turns"],
        exact: |u, _| (core::f64::consts::TAU * u).sin_cos().into(),
        domain: [(0.0, 1.0), NONE],
        absolute: true,
        scalar: PhantomData::<T>,
    };
    ask! { answers, effort, turns, 2;
        "elementary": |u, _| e::sin_cos_turns(u).into();
        "std of 2πu": |u, _| (T::TWO * T::PI * u).std_sin_cos().into();
        "libm of 2πu": |u, _| (T::TWO * T::PI * u).libm_sin_cos().into();
    }
    let atan2 = Function { domain: [(-3.0, 3.0); 2], ..function::<T>("atan2", |y, x| [libm::atan2(y, x)], NONE) };
    ask! { answers, effort, atan2, 1;
        "elementary": |y, x| [e::atan2(y, x)];
        "std": |y, x| [y.atan2(x)];
        "libm": |y, x| [y.libm_atan2(x)];
    }
    answers
}

#[rustfmt::skip]
fn errors<T: Libraries>(effort: &Effort) -> Answers {
    let mut answers = Answers::default();
    ask! { answers, effort, function::<T>("erf", |x, _| [libm::erf(x)], (-4.0, 4.0)), 1;
        "elementary": |x, _| [e::erf(x)];
        "libm": |x, _| [x.libm_erf()];
        "Abramowitz–Stegun 7.1.26": |x, _| [fits::erf_hastings(x)];
    }
    ask! { answers, effort, function::<T>("erfc", |x, _| [libm::erfc(x)], (-4.0, 10.0)), 1;
        "elementary": |x, _| [e::erfc(x)];
        "libm": |x, _| [x.libm_erfc()];
        "1 − Abramowitz–Stegun 7.1.26": |x, _| [T::ONE - fits::erf_hastings(x)];
    }
    ask! { answers, effort, function::<T>("erfcx", |x, _| [e::erfcx(x)], (-9.0, 20.0)), 1;
        "elementary": |x, _| [e::erfcx(x)];
        "std's exp · libm's erfc": |x, _| [(x * x).exp() * x.libm_erfc()];
    }
    ask! { answers, effort, function::<T>("erf_inv", |x, _| [e::erf_inv(x)], (-1.0, 1.0)), 1;
        "elementary": |x, _| [e::erf_inv(x)];
        "Giles 2011": |x, _| [fits::erf_inv_giles(x)];
    }
    ask! { answers, effort, function::<T>("erfc_inv", |x, _| [e::erfc_inv(x)], (0.0, 2.0)), 1;
        "elementary": |x, _| [e::erfc_inv(x)];
        "Giles 2011 of 1 − q": |x, _| [fits::erf_inv_giles(T::ONE - x)];
    }
    answers
}

fn of_scalar<T: Libraries>(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let mut all = powers::<T>(effort);
    for answers in [angles::<T>(effort), errors::<T>(effort)] {
        all.rows.extend(answers.rows);
        all.runs.extend(answers.runs);
    }
    for (row, ns) in all.rows.iter_mut().zip(pairs_of_times(all.runs, effort.rounds)) {
        row.ns = ns.map(Some);
    }
    let scalar = core::any::type_name::<T>();
    report(out, effort, &format!("elementary_{scalar}"), "Elementary functions", &all.rows)
}

pub(crate) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    of_scalar::<f32>(effort, out)?;
    of_scalar::<f64>(effort, out)
}
