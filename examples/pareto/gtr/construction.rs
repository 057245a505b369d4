//! What a GTR material costs before it is evaluated: time to make, and bytes to hold.

use core::hint::black_box;
use std::io::{self, Write};

use microsurface::gtr::components::Components;
use microsurface::gtr::table::GtrTable;
use microsurface::{Gtr, Real};

use crate::measure::{Run, times};
use crate::{ALPHAS, Effort};

/// A constructor at one γ.
struct Kind {
    name: &'static str,
    gamma: f64,
    bytes: usize,
    run: Run,
}

/// How often a constructor is called in a round; a table's, in which 80 rules are made, less often.
const CALLS: u32 = 256;
const CALLS_OF_TABLE: u32 = 4;

fn kind<T: Real, N: 'static>(
    name: &'static str,
    gamma: f64,
    calls: u32,
    make: impl Fn(T, T) -> Option<N> + 'static,
) -> Kind {
    let widths = ALPHAS.map(T::lit);
    let run = Run::new(calls, move || {
        for &alpha in widths.iter().cycle().take(calls as usize) {
            black_box(make(black_box(alpha), black_box(T::lit(gamma))));
        }
    });
    Kind { name, gamma, bytes: size_of::<N>(), run }
}

fn kinds<T: Real>() -> Vec<Kind> {
    let mut kinds = Vec::new();
    for gamma in [1.5, 2.5, 8.5] {
        kinds.push(kind::<T, _>("`Gtr::isotropic`", gamma, CALLS, |a, g| Gtr::isotropic(a, g).ok()));
    }
    for gamma in [1.5, 2.5, 8.5] {
        kinds.push(kind::<T, _>("`Components::new`", gamma, CALLS, |a, g| Components::new(a, g).ok()));
    }
    kinds.extend([
        kind::<T, _>("`Gtr::with_nodes::<4>`", 1.5, CALLS, |a, g| Gtr::with_nodes::<4>(a, g).ok()),
        kind::<T, _>("`Gtr::with_nodes::<8>`", 1.5, CALLS, |a, g| Gtr::with_nodes::<8>(a, g).ok()),
        kind::<T, _>("`Gtr::with_nodes::<12>`", 1.5, CALLS, |a, g| Gtr::with_nodes::<12>(a, g).ok()),
        kind::<T, _>("`Gtr::heavy_tailed::<8>`", 1.5, CALLS, |a, g| Gtr::heavy_tailed::<8>(a, g).ok()),
        kind::<T, _>("`Gtr::closed::<3>`", 3.0, CALLS, |a, _| Gtr::closed::<3>(a).ok()),
        kind::<T, _>("`Gtr::spline`", 1.5, CALLS, |a, g| Gtr::spline(a, g).ok()),
        kind::<T, _>("`GtrTable::<_, 8>::new`", 1.5, CALLS_OF_TABLE, |a, g| GtrTable::<T, 8>::new(g, a).ok()),
    ]);
    for gamma in [1.5, 2.5, 8.5] {
        if let Ok(table) = GtrTable::<T, 8>::new(T::lit(gamma), T::lit(ALPHAS[0])) {
            kinds.push(kind::<T, _>("`table.isotropic`", gamma, CALLS, move |a, _| table.isotropic(a).ok()));
        }
    }
    if let Ok(table) = GtrTable::<T, 8>::new(T::lit(1.5), T::lit(ALPHAS[0])) {
        kinds.push(kind::<T, _>("`table.heavy_tailed`", 1.5, CALLS, move |a, _| table.heavy_tailed(a).ok()));
    }
    kinds
}

pub(crate) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let (single, double) = (kinds::<f32>(), kinds::<f64>());
    let (mut labels, mut runs) = (Vec::new(), Vec::new());
    for (single, double) in single.into_iter().zip(double) {
        labels.push((single.name, single.gamma, single.bytes, double.bytes));
        runs.extend([single.run, double.run]);
    }
    let times = times(&mut runs, effort.rounds);
    writeln!(out, "## GTR: construction\n")?;
    writeln!(out, "| | γ | bytes, f32 | ns, f32 | bytes, f64 | ns, f64 |\n|---|---|---|---|---|---|")?;
    for ((name, gamma, bytes32, bytes64), ns) in labels.into_iter().zip(times.chunks_exact(2)) {
        writeln!(out, "| {name} | {gamma} | {bytes32} | {:.0} | {bytes64} | {:.0} |", ns[0], ns[1])?;
    }
    writeln!(out)
}
