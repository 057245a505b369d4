//! GTR's mask: closed forms at integer γ, mixtures of few nodes, and interpolations over γ.

use core::ops::RangeInclusive;
use std::io::{self, Write};

use microsurface::gtr::spline::Spline;
use microsurface::gtr::table::GtrTable;
use microsurface::gtr::{Gtr, Masking};
use microsurface::{Isotropic, Microsurface, Ndf, Real};

use crate::measure::{Errors, Run, both, pairs_of_times};
use crate::report::{Row, report};
use crate::{ALPHAS, Effort};
use grid::Grid;
use log_spline::LogSpline;

mod construction;
mod grid;
mod log_spline;

/// G1 of the surface, towards facets that face w.
#[inline(always)]
fn g1<T: Real, K: Masking<T>>(surface: &Microsurface<Gtr<T, K>, Isotropic<T>>, w: T::Vec3) -> T {
    surface.g1(w, w)
}

/// The spline's G1 as the papers have it.
#[inline(always)]
fn raw<T: Real>(surface: &Microsurface<Gtr<T, Spline<T>>, Isotropic<T>>, w: T::Vec3) -> T {
    let [x, y, z] = w.into();
    surface.profile().masking().g1(x * x + y * y, z)
}

/// Takes the runs of a question.
type Choose = fn(&mut Alternative) -> Option<[Run; 2]>;

/// The exponents of a question.
const UP_TO_4: RangeInclusive<f64> = 0.0..=4.0;
const ABOVE_4: RangeInclusive<f64> = 4.01..=10.0;

/// A mask: its errors at the points of the grid where it exists, and its times.
struct Alternative {
    name: String,
    scalar: &'static str,
    errors: Vec<AtPoint>,
    up_to_4: Option<[Run; 2]>,
    above_4: Option<[Run; 2]>,
}

struct AtPoint {
    gamma: f64,
    width: usize,
    errors: Errors,
}

impl Alternative {
    /// What `make` makes of α and γ, and its G1.
    fn new<T: Real, N: Clone + 'static>(
        name: &str,
        grid: &Grid<T>,
        mut make: impl FnMut(T, T) -> Option<N>,
        g1: impl Fn(&N, T::Vec3) -> T + Copy + 'static,
    ) -> Self {
        let (mut errors, mut surfaces) = (Vec::new(), Vec::new());
        for point in &grid.points {
            if let Some(surface) = make(point.alpha, point.gamma) {
                let gamma = point.gamma.to_f64();
                let of_point = grid.errors(point, |w| g1(&surface, w));
                errors.push(AtPoint { gamma, width: point.width, errors: of_point });
                surfaces.push((gamma, surface));
            }
        }
        let runs = |gammas: &RangeInclusive<f64>| {
            let within = surfaces.iter().filter(|(gamma, _)| gammas.contains(gamma));
            let surfaces = few(&within.map(|(_, surface)| surface.clone()).collect::<Vec<N>>());
            (!surfaces.is_empty()).then(|| both::<T, _>(surfaces, g1))
        };
        let (up_to_4, above_4) = (runs(&UP_TO_4), runs(&ABOVE_4));
        Self { name: name.into(), scalar: core::any::type_name::<T>(), errors, up_to_4, above_4 }
    }

    fn closed<T: Real, const G: u8>(grid: &Grid<T>) -> Self {
        let make = |alpha, gamma| if gamma == T::lit(G.into()) { Gtr::closed::<G>(alpha).ok() } else { None };
        Self::new(&format!("closed γ={G}"), grid, make, g1)
    }

    fn nodes<T: Real, const N: usize>(grid: &Grid<T>) -> Self {
        let make = |alpha, gamma| Gtr::with_nodes::<N>(alpha, gamma).ok();
        Self::new(&format!("{N} nodes"), grid, make, g1)
    }

    /// Surfaces of a table for each γ.
    fn table<T: Real>(grid: &Grid<T>) -> Self {
        let mut table: Option<GtrTable<T, 8>> = None;
        let make = |alpha, gamma| {
            if table.is_none_or(|table| table.gamma() != gamma) {
                table = GtrTable::new(gamma, T::lit(ALPHAS[0])).ok();
            }
            table?.isotropic(alpha).ok()
        };
        Self::new("8 nodes of a table", grid, make, g1)
    }

    /// The range of γ it covers within `gammas`, and its errors there.
    fn within(&self, gammas: &RangeInclusive<f64>) -> Option<((f64, f64), Errors)> {
        let mut domain: Option<(f64, f64)> = None;
        let mut errors = Errors::default();
        for point in self.errors.iter().filter(|point| gammas.contains(&point.gamma)) {
            let (first, _) = domain.unwrap_or((point.gamma, point.gamma));
            domain = Some((first, point.gamma));
            errors.merge(&point.errors);
        }
        Some((domain?, errors))
    }
}

/// As many materials as stay in half a first-level cache, of unlike widths.
fn few<N: Clone>(materials: &[N]) -> Vec<N> {
    let most = (24 * 1024 / size_of::<N>()).clamp(1, 28);
    let mut stride = materials.len().div_ceil(most).max(1);
    if stride.is_multiple_of(ALPHAS.len()) {
        stride += 1;
    }
    let stride = if materials.len() <= most { 1 } else { stride };
    materials.iter().step_by(stride).cloned().collect()
}

fn alternatives<T: Real>(effort: &Effort) -> Vec<Alternative> {
    let grid = &Grid::<T>::new(effort);
    vec![
        Alternative::new("spline", grid, |alpha, gamma| Gtr::spline(alpha, gamma).ok(), g1),
        Alternative::new("spline of the papers", grid, |alpha, gamma| Gtr::spline(alpha, gamma).ok(), raw),
        Alternative::new("spline of ln Λ", grid, LogSpline::new, LogSpline::g1),
        Alternative::nodes::<T, 4>(grid),
        Alternative::nodes::<T, 6>(grid),
        Alternative::nodes::<T, 8>(grid),
        Alternative::nodes::<T, 12>(grid),
        Alternative::table(grid),
        Alternative::new("8 nodes γ≤2", grid, |alpha, gamma| Gtr::heavy_tailed::<8>(alpha, gamma).ok(), g1),
        Alternative::closed::<T, 0>(grid),
        Alternative::closed::<T, 1>(grid),
        Alternative::closed::<T, 2>(grid),
        Alternative::closed::<T, 3>(grid),
        Alternative::closed::<T, 4>(grid),
        Alternative::closed::<T, 6>(grid),
        Alternative::closed::<T, 10>(grid),
    ]
}

pub(crate) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let mut alternatives_of_both = alternatives::<f32>(effort);
    alternatives_of_both.extend(alternatives::<f64>(effort));

    let questions: [(&str, &str, _, Choose); 2] = [
        ("gtr_mask", "GTR: G1, γ from 0 to 4", UP_TO_4, |alternative| alternative.up_to_4.take()),
        ("gtr_mask_above_4", "GTR: G1, γ above 4, to 10", ABOVE_4, |alternative| alternative.above_4.take()),
    ];
    for (file, title, gammas, choose) in questions {
        let (mut rows, mut runs) = (Vec::new(), Vec::new());
        for alternative in &mut alternatives_of_both {
            let Some((domain, errors)) = alternative.within(&gammas) else { continue };
            let (name, scalar) = (alternative.name.clone(), alternative.scalar);
            runs.extend(choose(alternative));
            rows.push(Row { name, scalar, domain, errors, ..Row::default() });
        }
        for (row, ns) in rows.iter_mut().zip(pairs_of_times(runs, effort.rounds)) {
            row.ns = ns.map(Some);
        }
        report(out, effort, file, title, &rows)?;
    }
    by_width(out, &alternatives_of_both)?;
    construction::run(effort, out)
}

/// The worst errors of each width.
fn by_width(out: &mut impl Write, alternatives: &[Alternative]) -> io::Result<()> {
    let columns = || alternatives.iter().filter(|a| a.scalar == "f64" && !a.name.starts_with("closed"));
    writeln!(out, "Worst errors by width and the γ they are at, γ from 0 to 4, f64:\n")?;
    let names: Vec<_> = columns().map(|alternative| alternative.name.as_str()).collect();
    writeln!(out, "| α | {} |\n|---{}|", names.join(" | "), "|---".repeat(names.len()))?;
    for (width, alpha) in ALPHAS.iter().enumerate() {
        write!(out, "| {alpha} |")?;
        for alternative in columns() {
            let at_width = alternative
                .errors
                .iter()
                .filter(|point| point.width == width && UP_TO_4.contains(&point.gamma));
            if let Some(worst) = at_width.max_by(|a, b| a.errors.worst.total_cmp(&b.errors.worst)) {
                write!(out, " {:.1e} ({:.2}) |", worst.errors.worst, worst.gamma)?;
            }
        }
        writeln!(out)?;
    }
    writeln!(out)
}
