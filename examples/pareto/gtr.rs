//! GTR's mask: the papers' spline over γ, and the exact closed forms of integer γ.

use std::io::{self, Write};

use microsurface::profile::gtr::closed::Closed;
use microsurface::profile::gtr::spline::Spline;
use microsurface::profile::gtr::{Gtr, Masking};
use microsurface::{Isotropic, Microsurface, Ndf, Real};

use crate::measure::{Errors, Run, calls, degrees, directions, exactly, times};
use crate::reference::Mixture;
use crate::report::{Row, report};
use crate::{ALPHAS, Effort};

type Surface<T, K> = Microsurface<Gtr<T, K>, Isotropic<T>>;

/// G1 of the surface, towards facets that face w.
fn limited<T: Real, K: Masking<T>>(surface: &Surface<T, K>, w: T::Vec3) -> T {
    surface.g1(w, w)
}

/// The spline's G1 as the papers have it.
fn raw<T: Real>(surface: &Surface<T, Spline<T>>, w: T::Vec3) -> T {
    let [x, y, z] = w.into();
    surface.profile().masking().g1(x * x + y * y, z)
}

/// A material, the mixture that is its reference, and the γ and α both have.
struct Case<T: Real, K> {
    surface: Surface<T, K>,
    reference: Mixture,
}

fn splines<T: Real>(alphas: &[f64], gammas: u32) -> Vec<Case<T, Spline<T>>> {
    let gammas = (0..=4 * gammas).map(|i| f64::from(i) / f64::from(gammas));
    let pairs = gammas.flat_map(|gamma| alphas.iter().map(move |&alpha| (alpha, gamma)));
    pairs.filter_map(|(alpha, gamma)| case(Gtr::spline(T::lit(alpha), T::lit(gamma)).ok()?)).collect()
}

fn closed<T: Real, const G: u8>() -> Vec<Case<T, Closed<T, G>>> {
    ALPHAS.iter().filter_map(|&alpha| case(Gtr::closed::<G>(T::lit(alpha)).ok()?)).collect()
}

#[expect(clippy::unnecessary_wraps, reason = "ends a chain of options")]
fn case<T: Real, K>(surface: Surface<T, K>) -> Option<Case<T, K>> {
    let profile = surface.profile();
    let reference = Mixture::new(profile.alpha().to_f64(), profile.gamma().to_f64());
    Some(Case { surface, reference })
}

fn errors<T: Real, K>(
    angles: u32,
    cases: &[Case<T, K>],
    g1: impl Fn(&Surface<T, K>, T::Vec3) -> T,
) -> Errors {
    let mut errors = Errors::default();
    for Case { surface, reference } in cases {
        for w in directions::<T>(angles) {
            let (s2, z) = exactly::<T>(w);
            let exact = 1.0 / (1.0 + reference.lambda(s2, z));
            errors.add(g1(surface, w).to_f64() - exact, || {
                let (alpha, gamma) = (surface.profile().alpha(), surface.profile().gamma());
                format!("α = {alpha}, γ = {gamma}, θ = {:.3}°", degrees((s2, z)))
            });
        }
    }
    errors
}

/// What is timed and compared: a name, its errors, its run.
type Alternative = (String, Errors, Run);

fn alternative<T: Real, K: 'static>(
    name: &str,
    angles: u32,
    cases: Vec<Case<T, K>>,
    g1: impl Fn(&Surface<T, K>, T::Vec3) -> T + Copy + 'static,
) -> Alternative {
    let scalar = core::any::type_name::<T>();
    let errors = errors(angles, &cases, g1);
    // As many materials as stay in the first-level cache.
    let stride = cases.len().div_ceil(28);
    let surfaces: Vec<_> = cases.into_iter().map(|case| case.surface).step_by(stride).collect();
    (format!("{name}, {scalar}"), errors, calls::<T, _>(surfaces, g1))
}

fn alternatives<T: Real>(Effort { angles, gammas, .. }: Effort) -> Vec<Alternative> {
    vec![
        alternative::<T, _>("spline, 0 ≤ γ ≤ 4", angles, splines(&ALPHAS, gammas), limited),
        alternative::<T, _>("spline as in the papers", angles, splines(&ALPHAS, gammas), raw),
        alternative::<T, _>("closed, γ = 0", angles, closed::<T, 0>(), limited),
        alternative::<T, _>("closed, γ = 1", angles, closed::<T, 1>(), limited),
        alternative::<T, _>("closed, γ = 2", angles, closed::<T, 2>(), limited),
        alternative::<T, _>("closed, γ = 3", angles, closed::<T, 3>(), limited),
        alternative::<T, _>("closed, γ = 4", angles, closed::<T, 4>(), limited),
    ]
}

pub(crate) fn run(effort: Effort, out: &mut impl Write) -> io::Result<()> {
    let mut alternatives_of_both = alternatives::<f32>(effort);
    alternatives_of_both.extend(alternatives::<f64>(effort));
    let mut names_and_errors = Vec::new();
    let mut runs = Vec::new();
    for (name, errors, run) in alternatives_of_both {
        names_and_errors.push((name, errors));
        runs.push(run);
    }
    let times = times(&mut runs, effort.rounds);
    let rows: Vec<Row> =
        names_and_errors.into_iter().zip(times).map(|((name, e), ns)| Row::new(&name, ns, e)).collect();
    report(out, "gtr_mask", "GTR: G1", &rows)?;

    writeln!(out, "The spline as in the papers, by width, f64:\n")?;
    writeln!(out, "| α | worst error | at | RMS |\n|---|---|---|---|")?;
    for alpha in ALPHAS {
        let errors = errors::<f64, _>(effort.angles, &splines(&[alpha], effort.gammas), raw);
        writeln!(out, "| {alpha} | {:.2e} | {} | {:.1e} |", errors.worst, errors.at, errors.rms())?;
    }
    writeln!(out)
}
