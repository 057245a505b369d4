//! The cost of a map and of a scalar: the same isotropic surfaces under each type of map, in f32
//! and f64, against 50-digit values.
//!
//! Errors are relative: of D within 5 α of the normal, of σ above the horizon; GTR's σ by 8 nodes.

use std::io::{self, Write};

use microsurface::profile::Profile;
use microsurface::{Beckmann, Ggx, Gtr, Isotropic, Microsurface, Ndf, Real};

use crate::Effort;
use crate::blocks::{Arguments, Call};
use crate::measure::{Errors, Run, pairs_of_times};
use crate::report::{Row, report};
use crate::vndf::usual;

const NORMALS: &str = include_str!("../../tests/reference/ndf.tsv");
const MASKS: &str = include_str!("../../tests/reference/masking.tsv");
const MASKS_OF_GTR: &str = include_str!("../../tests/reference/masking_gtr.tsv");

/// Arguments in a round of timing.
const TIMED: usize = 1 << 12;
/// The widths that are timed.
const ALPHAS: [f64; 4] = [0.05, 0.1, 0.3, 1.0];
/// A γ that the tables have.
const GAMMA: f64 = 1.5;

#[derive(Clone, Copy)]
struct D;
impl<N: Ndf> Call<N, N::Scalar, 3, 1> for D {
    #[inline(always)]
    fn call(self, surface: &N, wm: [N::Scalar; 3]) -> [N::Scalar; 1] {
        [surface.d(wm.into())]
    }
}

#[derive(Clone, Copy)]
struct Sigma;
impl<N: Ndf> Call<N, N::Scalar, 3, 1> for Sigma {
    #[inline(always)]
    fn call(self, surface: &N, w: [N::Scalar; 3]) -> [N::Scalar; 1] {
        [surface.sigma_above(w.into())]
    }
}

/// A value of a table.
struct Exact {
    alpha: f64,
    direction: [f64; 3],
    value: f64,
}

/// The rows of an isotropic distribution, in the upper hemisphere and, of D, near the normal.
fn rows(table: &str, family: &str) -> Vec<Exact> {
    let of_d = table == NORMALS;
    let rows = table.lines().filter_map(|line| {
        let mut fields = line.split('\t');
        let name = fields.next()?;
        let [alpha, alpha_y, gamma, x, y, z, a, b] =
            [(); 8].map(|()| fields.next().and_then(|x| x.parse().ok()));
        let value: f64 = if of_d { b? } else { a? };
        let wanted =
            name == family && alpha == alpha_y && gamma.is_none_or(|gamma: f64| (gamma - GAMMA).abs() < 1e-9);
        let near = !of_d || a? > 0.0;
        let row = Exact { alpha: alpha?, direction: [x?, y?, z?], value };
        (wanted && near && row.direction[2] > 0.0 && value > 1e-30).then_some(row)
    });
    rows.collect()
}

/// The rows and the times of a scalar.
#[derive(Default)]
struct Answers {
    rows: Vec<Row>,
    runs: Vec<[Run; 2]>,
}

impl Answers {
    /// One function of surfaces under one map.
    fn ask<N: Ndf + Clone + 'static>(
        &mut self,
        (group, map): (String, &str),
        exact: &[Exact],
        surface: impl Fn(f64) -> N,
        call: impl Call<N, N::Scalar, 3, 1>,
    ) {
        let (mut errors, lit) = (Errors::default(), <N::Scalar as Real>::lit);
        for Exact { alpha, direction, value } in exact {
            let [got] = call.call(&surface(*alpha), direction.map(lit));
            errors.add(got.to_f64() / value - 1.0, || format!("α = {alpha:.2e}, z = {:.4}", direction[2]));
        }
        let arguments = Arguments::<N::Scalar, 3>::draw(TIMED, |rng| {
            let [x, y, z, ..] = usual(rng);
            [x, y, z]
        });
        let scalar = core::any::type_name::<N::Scalar>();
        self.rows.push(Row { group, name: map.into(), scalar, errors, ..Row::default() });
        self.runs.push(arguments.timed(&ALPHAS.map(surface), call));
    }

    /// A family under each map.
    fn family<T: Real, P: Profile<T> + 'static>(
        &mut self,
        (name, in_table, masks): (&str, &str, &str),
        surface: impl Fn(T) -> Option<Microsurface<P, Isotropic<T>>>,
    ) {
        let isotropic = |alpha| surface(T::lit(alpha)).expect("a width");
        let aligned = |alpha| isotropic(alpha).stretched(T::ZERO).expect("the same");
        let identity = [[T::ONE, T::ZERO], [T::ZERO, T::ONE]];
        let linear = |alpha| isotropic(alpha).transformed(T::matrix(identity)).expect("the same");
        let group = |function: &str| format!("{name}, {function}");
        let exact = rows(NORMALS, in_table);
        self.ask((group("D"), "Isotropic"), &exact, isotropic, D);
        self.ask((group("D"), "AxisAligned"), &exact, aligned, D);
        self.ask((group("D"), "Linear"), &exact, linear, D);
        let exact = rows(masks, in_table);
        self.ask((group("σ"), "Isotropic"), &exact, isotropic, Sigma);
        self.ask((group("σ"), "AxisAligned"), &exact, aligned, Sigma);
        self.ask((group("σ"), "Linear"), &exact, linear, Sigma);
    }

    fn all<T: Real>(&mut self) {
        self.family::<T, _>(("GGX", "ggx", MASKS), |alpha| Ggx::isotropic(alpha).ok());
        self.family::<T, _>(("Beckmann", "beckmann", MASKS), |alpha| Beckmann::isotropic(alpha).ok());
        let gtr = ("GTR, γ = 1.5", "gtr", MASKS_OF_GTR);
        self.family::<T, _>(gtr, |alpha| Gtr::heavy_tailed::<8>(alpha, T::lit(GAMMA)).ok());
    }
}

pub(crate) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let mut answers = Answers::default();
    answers.all::<f32>();
    answers.all::<f64>();
    let Answers { rows, runs } = answers;
    let times = pairs_of_times(runs, effort.rounds);
    let mut rows: Vec<Row> =
        rows.into_iter().zip(times).map(|(row, ns)| Row { ns: ns.map(Some), ..row }).collect();
    // Each function in both scalars, side by side.
    let order: Vec<String> = rows.iter().map(|row| row.group.clone()).collect();
    rows.sort_by_key(|row| order.iter().position(|group| *group == row.group));
    report(out, effort, "maps", "Maps and scalars", &rows)
}
