//! Beckmann's mask: exact, and Walter's rational approximation.

use std::io::{self, Write};

use microsurface::{Beckmann, Isotropic, Microsurface, Ndf, Real};

use crate::measure::{Errors, both, degrees, directions, exactly, pairs_of_times};
use crate::reference::lambda_beckmann;
use crate::report::{Row, report};
use crate::{ALPHAS, Effort};

type Surface<T> = Microsurface<Beckmann, Isotropic<T>>;

fn surfaces<T: Real>() -> Vec<Surface<T>> {
    ALPHAS.iter().filter_map(|&alpha| Beckmann::isotropic(T::lit(alpha)).ok()).collect()
}

/// G1 towards facets that face w.
#[inline(always)]
fn exact<T: Real>(surface: &Surface<T>, w: T::Vec3) -> T {
    surface.g1(w, w)
}

#[inline(always)]
fn walter<T: Real>(surface: &Surface<T>, w: T::Vec3) -> T {
    surface.g1_walter2007(w)
}

fn errors<T: Real>(angles: u32, g1: impl Fn(&Surface<T>, T::Vec3) -> T) -> Errors {
    let mut errors = Errors::default();
    for surface in surfaces::<T>() {
        let alpha = surface.map().alpha().to_f64();
        for w in directions::<T>(angles) {
            let (s2, z) = exactly::<T>(w);
            let reference = 1.0 / (1.0 + lambda_beckmann(z / (alpha * s2.sqrt())));
            errors.add(g1(&surface, w).to_f64() - reference, || {
                let a = z / (alpha * s2.sqrt());
                format!("α = {alpha:.3}, θ = {:.3}°, a = {a:.3}", degrees((s2, z)))
            });
        }
    }
    errors
}

pub(crate) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let angles = effort.angles * 4;
    let runs = [
        both::<f32, _>(surfaces(), exact::<f32>),
        both::<f32, _>(surfaces(), walter::<f32>),
        both::<f64, _>(surfaces(), exact::<f64>),
        both::<f64, _>(surfaces(), walter::<f64>),
    ];
    let times = pairs_of_times(runs, effort.rounds);
    let errors = [
        ("exact", "f32", errors::<f32>(angles, exact)),
        ("Walter 2007", "f32", errors::<f32>(angles, walter)),
        ("exact", "f64", errors::<f64>(angles, exact)),
        ("Walter 2007", "f64", errors::<f64>(angles, walter)),
    ];
    let rows: Vec<Row> = errors
        .into_iter()
        .zip(times)
        .map(|((name, scalar, errors), ns)| Row {
            name: name.into(),
            scalar,
            ns: ns.map(Some),
            errors,
            ..Row::default()
        })
        .collect();
    report(out, effort, "beckmann_mask", "Beckmann: G1", &rows)
}
