//! Samplers of visible normals: how far rounding, tolerances and fits move their normals, and what
//! they cost.
//!
//! A sampler is a map of two random numbers onto normals. Its error is the distance of its normal,
//! from the f32 numbers it was given, to that of the same map in f64, times the root of the density
//! there: a patch of normals that a share p of the random numbers falls on is about √p wide in this
//! measure, whatever the roughness and the view. Views lie between the normal and 1e-6 above the
//! horizon, and an eighth of the random numbers at the ends of their range.

use std::io::{self, Write};

use microsurface::Real;
use rand_pcg::Pcg64Mcg;

use crate::Effort;
use crate::blocks::{Arguments, Call, uniform};
use crate::measure::{Errors, Run, pairs_of_times};
use crate::report::{Row, report};

mod beckmann;
mod ggx;
mod gtr;

/// A direction and two random numbers.
pub(crate) type Input<T> = [T; 5];

/// From mirrors to rougher than anything.
pub(crate) const ALPHAS: [f64; 6] = [1e-4, 0.001, 0.01, 0.1, 0.4, 1.0];

/// Samples in a round of timing: more than branch predictors learn by heart.
const TIMED: usize = 1 << 16;

/// Directions uniform over the hemisphere.
pub(crate) fn usual(rng: &mut Pcg64Mcg) -> Input<f64> {
    let [z, phi, u1, u2] = [(); 4].map(|()| uniform(rng));
    input(z.max(1e-6), phi, [u1, u2])
}

/// Half of the directions by the logarithm of their cotangent.
pub(crate) fn extreme(rng: &mut Pcg64Mcg) -> Input<f64> {
    let [kind, z, phi, end] = [(); 4].map(|()| uniform(rng));
    let cot = 10_f64.powf(-6.0 + 9.0 * z);
    let z = if kind < 0.5 { cot / (1.0 + cot * cot).sqrt() } else { z.max(1e-6) };
    let u = [(); 2].map(|()| match (uniform(rng), uniform(rng)) {
        (kind, u) if kind < 0.0625 => u * 2_f64.powi(-20),
        (kind, u) if kind < 0.125 => 1.0 - 2_f64.powi(-24) * (1.0 + (15.0 * u).floor()),
        (_, u) => u,
    });
    // Zero itself, now and then.
    input(z, phi, if end < 0.001 { [0.0, u[1]] } else { u })
}

fn input(z: f64, phi: f64, [u1, u2]: [f64; 2]) -> Input<f64> {
    let (sin, cos) = (core::f64::consts::TAU * phi).sin_cos();
    let r = ((1.0 - z) * (1.0 + z)).sqrt();
    [r * cos, r * sin, z, u1, u2]
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The angle between two directions that are near each other.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let difference = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    let cross = [difference(0, 1), difference(1, 2), difference(2, 0)];
    dot(cross, cross).sqrt().atan2(dot(a, b))
}

/// The displacement of a normal from that of `exact`, whose density is `density`.
pub(crate) fn displacement(normal: [f64; 3], exact: [f64; 3], density: f64) -> f64 {
    angle(normal, exact) * density.sqrt()
}

/// What no caller can use.
#[derive(Default)]
struct Unusable {
    not_a_number: u32,
    below_horizon: u32,
    facing_away: u32,
    /// Displaced by more than a hundredth.
    far: u32,
    of: u32,
}

/// Samplers that are asked the same, in both scalars.
pub(crate) struct Samplers<'a> {
    effort: &'a Effort,
    errors: Arguments<f32, 5>,
    times: (Arguments<f32, 5>, Arguments<f64, 5>),
    rows: Vec<Row>,
    runs: Vec<[Run; 2]>,
    unusable: Vec<Unusable>,
}

/// α as it is in a scalar.
fn alphas<T: Real>() -> [T; 6] {
    ALPHAS.map(T::lit)
}

impl<'a> Samplers<'a> {
    fn new(effort: &'a Effort, of_errors: fn(&mut Pcg64Mcg) -> Input<f64>) -> Self {
        Self {
            effort,
            errors: Arguments::draw(effort.samples / 4, of_errors),
            times: (Arguments::draw(TIMED, usual), Arguments::draw(TIMED, usual)),
            rows: Vec::new(),
            runs: Vec::new(),
            unusable: Vec::new(),
        }
    }

    /// Adds a sampler in f32, one material for each of [`ALPHAS`]; `exact` is its map in f64 and
    /// the density there.
    fn single<M: Clone + 'static>(
        &mut self,
        name: &str,
        domain: (f64, f64),
        materials: &[M],
        sample: impl Call<M, f32, 5, 3>,
        exact: impl Fn(f64, Input<f64>) -> ([f64; 3], f64),
    ) {
        let (mut errors, mut unusable) = (Errors::default(), Unusable::default());
        self.errors.each(materials, sample, |which, input, normal| {
            let (input, normal, alpha) = (input.map(f64::from), normal.map(f64::from), ALPHAS[which]);
            let w = [input[0], input[1], input[2]];
            unusable.of += 1;
            if normal.iter().any(|c| c.is_nan()) {
                unusable.not_a_number += 1;
                return;
            }
            unusable.below_horizon += u32::from(normal[2] < 0.0);
            unusable.facing_away += u32::from(dot(w, normal) <= 0.0);
            let (exact, density) = exact(f64::from(alphas::<f32>()[which]), input);
            let error = displacement(normal, exact, density);
            unusable.far += u32::from(error > 0.01);
            errors.add(error, || {
                let elevation = w[2].atan2(w[0].hypot(w[1])).to_degrees();
                format!("α = {alpha}, {elevation:.2e}° high, u = {:.3e}, {:.3e}", input[3], input[4])
            });
        });
        self.rows.push(Row { name: name.into(), scalar: "f32", domain, errors, ..Row::default() });
        self.runs.push(self.times.0.timed(materials, sample));
        self.unusable.push(unusable);
    }

    /// Adds the time of a sampler in f64, to which there is no reference.
    fn double<M: Clone + 'static>(&mut self, name: &str, materials: &[M], sample: impl Call<M, f64, 5, 3>) {
        self.rows.push(Row { name: name.into(), scalar: "f64", ..Row::default() });
        self.runs.push(self.times.1.timed(materials, sample));
    }

    fn report(mut self, out: &mut impl Write, file: &str, title: &str) -> io::Result<()> {
        for (row, ns) in self.rows.iter_mut().zip(pairs_of_times(self.runs, self.effort.rounds / 10 + 1)) {
            row.ns = ns.map(Some);
        }
        report(out, self.effort, file, title, &self.rows)?;
        writeln!(
            out,
            "| of every million, f32 | NaN | below the horizon | facing away | displaced by more than 0.01 |"
        )?;
        writeln!(out, "|---|---|---|---|---|")?;
        for (row, unusable) in self.rows.iter().filter(|row| row.scalar == "f32").zip(&self.unusable) {
            let share = |count: u32| 1e6 * f64::from(count) / f64::from(unusable.of);
            let Unusable { not_a_number, below_horizon, facing_away, far, .. } = *unusable;
            let [nan, below, away, far] = [not_a_number, below_horizon, facing_away, far].map(share);
            writeln!(out, "| {} | {nan:.0} | {below:.0} | {away:.0} | {far:.0} |", row.name)?;
        }
        writeln!(out)
    }
}

/// What all alternatives give, and what is green beside them: other normals than the visible ones.
const VISIBLE: (f64, f64) = (0.0, 1.0);
const ALL: (f64, f64) = (0.0, 0.0);

pub(crate) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    ggx::run(effort, out)?;
    beckmann::run(effort, out)?;
    gtr::run(effort, out)
}
