//! Densities, areas and masks, over widths from 1e-6 to 1e3, their ratios up to 1e3, and all
//! directions.

use microsurface::gtr::Density;
use microsurface::{Beckmann, Ggx, Gtr, Ndf, Real};

use super::climb::{Effort, worst};
use super::oracle::{Given, Kind};
use crate::accuracy::budget::bound;
use crate::accuracy::{number, rows};
use crate::worst::Worst;

/// A function of a distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Function {
    D,
    Sigma,
    Lambda,
    G1,
}
use Function::{D, G1, Lambda, Sigma};

/// Where a function is searched.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Above,
    Below,
    /// Above the horizon, beyond Beckmann's exponent of 26.
    Steep,
}
use Part::{Above, Below, Steep};

/// One search: the key of its budget.
struct Search {
    name: &'static str,
    family: Family,
    function: Function,
    part: Part,
}

/// The kinds that share a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Family {
    Ggx,
    Beckmann,
    /// γ from 0 to 10.
    Gtr,
    /// γ = 0 … 4.
    Closed,
    /// γ = 5 … 10.
    Higher,
}

const fn search(name: &'static str, family: Family, function: Function, part: Part) -> Search {
    Search { name, family, function, part }
}

const SEARCHES: &[Search] = &[
    search("ggx_d", Family::Ggx, D, Above),
    search("ggx_sigma", Family::Ggx, Sigma, Above),
    search("ggx_sigma", Family::Ggx, Sigma, Below),
    search("ggx_lambda", Family::Ggx, Lambda, Above),
    search("ggx_lambda", Family::Ggx, Lambda, Below),
    search("ggx_g1", Family::Ggx, G1, Above),
    search("beckmann_d", Family::Beckmann, D, Above),
    search("beckmann_d", Family::Beckmann, D, Steep),
    search("beckmann_sigma", Family::Beckmann, Sigma, Above),
    search("beckmann_sigma", Family::Beckmann, Sigma, Below),
    search("beckmann_lambda", Family::Beckmann, Lambda, Above),
    search("beckmann_lambda", Family::Beckmann, Lambda, Steep),
    search("beckmann_lambda", Family::Beckmann, Lambda, Below),
    search("beckmann_g1", Family::Beckmann, G1, Above),
    search("gtr_d", Family::Gtr, D, Above),
    search("gtr_sigma", Family::Closed, Sigma, Above),
    search("gtr_sigma", Family::Closed, Sigma, Below),
    search("gtr_lambda", Family::Closed, Lambda, Above),
    search("gtr_lambda", Family::Closed, Lambda, Below),
    search("gtr_g1", Family::Closed, G1, Above),
    search("gtr_higher_sigma", Family::Higher, Sigma, Above),
    search("gtr_higher_sigma", Family::Higher, Sigma, Below),
    search("gtr_higher_lambda", Family::Higher, Lambda, Above),
    search("gtr_higher_lambda", Family::Higher, Lambda, Below),
    search("gtr_higher_g1", Family::Higher, G1, Above),
];

impl Search {
    const fn domain(&self) -> &'static str {
        match (self.family, self.function, self.part) {
            (_, _, Above) => "searched",
            (_, D, Steep) => "searched, exponent > 26, per unit of it",
            (_, _, Steep) => "searched, a² > 26, per unit of it",
            (Family::Beckmann, Sigma, Below) => "searched below the horizon, per 1 + a²",
            (_, _, Below) => "searched below the horizon",
        }
    }

    /// A surface and a direction, of any size and at the edges where much happens.
    fn input<T: Real>(&self, point: [f64; 8]) -> Input<T> {
        let [wide, aspect, ratio, kind, height, turn, gamma, choice] = point;
        let is_gtr = !matches!(self.family, Family::Ggx | Family::Beckmann);
        let alpha_x = decades(wide, -6.0, if is_gtr { 0.0 } else { 3.0 });
        let alpha_y = if aspect < 0.5 || is_gtr {
            alpha_x
        } else {
            (alpha_x * decades(ratio, -3.0, 3.0)).clamp(1e-6, 1e3)
        };
        let step = |count: u8, x: f64| (f64::from(count) * x) as u8;
        let kind_of_surface = match self.family {
            Family::Ggx => Kind::Ggx,
            Family::Beckmann => Kind::Beckmann,
            Family::Gtr if choice < 0.3 => Kind::Gtr(f64::from(step(11, gamma))),
            Family::Gtr => Kind::Gtr(T::lit(10.0 * gamma).to_f64()),
            Family::Closed => Kind::Closed(step(5, gamma)),
            Family::Higher => Kind::Closed(5 + step(6, gamma)),
        };
        // Angles of the order of the width are where everything happens.
        let cot = match (kind * 4.0) as u32 {
            0 => decades(height, -9.0, 6.0),
            1 => height / (1.0 - height * height).max(1e-20).sqrt(),
            2 => decades(height, -2.0, 2.0) / alpha_x,
            _ => decades(height, -2.0, 2.0) * if self.function == D { 1.0 / alpha_y } else { alpha_y },
        };
        let angle = match (choice * 7.0) as u32 {
            0 => 0.0,
            1 => core::f64::consts::FRAC_PI_2,
            _ => core::f64::consts::TAU * turn,
        };
        let (sin, up) = (1.0 / cot.hypot(1.0), cot / cot.hypot(1.0));
        let z = if self.part == Below { -up } else { up };
        Input {
            kind: kind_of_surface,
            alphas: [alpha_x, alpha_y].map(T::lit),
            at: [sin * angle.cos(), sin * angle.sin(), z].map(T::lit),
        }
    }

    /// The error in units of ε.
    fn error<T: Real>(&self, input: &Input<T>) -> f64 {
        let [x, y, z] = input.at;
        if z == T::ZERO || (x == T::ZERO && y == T::ZERO) {
            return 0.0;
        }
        let given = Given::new(input.alphas.map(T::to_f64), input.at.map(T::to_f64));
        let exponent = match (self.family, self.function) {
            (Family::Beckmann, D) => given.exponent_of_normal().to_f64(),
            (Family::Beckmann, _) => given.exponent_of_direction().to_f64(),
            _ => 0.0,
        };
        let unit = match (self.part, self.function) {
            // G1 is 1 to every digit there.
            (Above, D | Lambda) if exponent > 26.0 => return 0.0,
            (Steep, _) if exponent <= 26.0 => return 0.0,
            (Steep, _) => exponent,
            (Below, Sigma) => 1.0 + exponent,
            _ => 1.0,
        };
        if exponent > 600.0 {
            // Nothing is left in f64.
            return 0.0;
        }
        let exact = match self.function {
            D => given.d(input.kind),
            Sigma => given.sigma(input.kind),
            Lambda => given.lambda(input.kind),
            G1 => given.g1(input.kind),
        };
        let size = exact.abs().to_f64();
        // Subnormal results have fewer digits, and some functions none.
        if size < 2.0 * T::MIN_POSITIVE.to_f64() / T::EPSILON.to_f64() || size > T::MAX.to_f64() {
            return 0.0;
        }
        let value = input.value(self.function).to_f64();
        (&exact - value).abs().to_f64() / (size * unit * T::EPSILON.to_f64())
    }
}

/// A surface and a direction.
#[derive(Clone, Debug)]
struct Input<T> {
    kind: Kind,
    alphas: [T; 2],
    at: [T; 3],
}

impl<T: Real> Input<T> {
    fn value(&self, function: Function) -> T {
        let [alpha_x, alpha_y] = self.alphas;
        let isotropic = alpha_x == alpha_y;
        match self.kind {
            Kind::Ggx if isotropic => self.of(&Ggx::isotropic(alpha_x).unwrap(), function),
            Kind::Ggx => self.of(&Ggx::anisotropic(alpha_x, alpha_y).unwrap(), function),
            Kind::Beckmann if isotropic => self.of(&Beckmann::isotropic(alpha_x).unwrap(), function),
            Kind::Beckmann => self.of(&Beckmann::anisotropic(alpha_x, alpha_y).unwrap(), function),
            Kind::Gtr(gamma) => Density::new(alpha_x, T::lit(gamma)).unwrap().d(self.at.into()),
            Kind::Closed(gamma) => self.of_closed(gamma, function),
        }
    }

    fn of_closed(&self, gamma: u8, function: Function) -> T {
        macro_rules! closed {
            ($($integer:literal)*) => {
                match gamma {
                    $($integer => self.of(&Gtr::closed::<$integer>(self.alphas[0]).unwrap(), function),)*
                    _ => unreachable!("{gamma}"),
                }
            };
        }
        closed!(0 1 2 3 4 5 6 7 8 9 10)
    }

    fn of(&self, surface: &impl Ndf<Scalar = T>, function: Function) -> T {
        let at: T::Vec3 = self.at.into();
        match function {
            D => surface.d(at),
            Sigma => surface.sigma(at),
            Lambda => surface.lambda(at),
            G1 => surface.g1(at, at),
        }
    }
}

fn decades(x: f64, low: f64, high: f64) -> f64 {
    10_f64.powf(low + (high - low) * x)
}

/// The worst inputs that the long search has found: name, domain, scalar, γ or "-", αx, αy, x, y, z
/// and error in ε.
///
/// Written by `cargo test --release --test it the_worst_distributions -- --ignored --nocapture`,
/// lines of "worst".
const WORST: &str = include_str!("../../../reference/worst.tsv");

const fn scalar<T: Real>() -> &'static str {
    if T::WIDENS { "f32" } else { "f64" }
}

/// Searches, and holds what is found below the bounds of the budget.
fn no_worse<T: Real>(effort: Effort) {
    for (seed, search) in SEARCHES.iter().enumerate() {
        let found =
            worst(effort, 100 + seed as u64, |point| search.input::<T>(point), |input| search.error(input));
        let row = bound(search.name, search.domain());
        let bound = row.bounds[usize::from(!T::WIDENS)];
        let input = &found.at;
        assert!(
            found.error <= bound && found.error > 0.25 * bound,
            "{} {}: {} ε at {input:?}; the budget is {bound}",
            search.name,
            search.domain(),
            found.error,
        );
    }
}

fn print_worst<T: Real>() {
    println!();
    for (seed, search) in SEARCHES.iter().enumerate() {
        let Worst { error: value, at: Input { kind, alphas: [a, b], at: [x, y, z] }, .. } =
            worst(LONG, 100 + seed as u64, |point| search.input::<T>(point), |input| search.error(input));
        let gamma = match kind {
            Kind::Gtr(gamma) => format!("{gamma}"),
            Kind::Closed(gamma) => format!("{gamma}"),
            _ => "-".to_owned(),
        };
        let (name, domain, scalar) = (search.name, search.domain(), scalar::<T>());
        let [a, b, x, y, z] = [a, b, x, y, z].map(T::to_f64);
        println!("worst\t{name}\t{domain}\t{scalar}\t{gamma}\t{a:e}\t{b:e}\t{x:e}\t{y:e}\t{z:e}\t{value:.2}");
    }
}

/// The worst inputs have the errors that the budget states.
fn worst_inputs<T: Real>() {
    for search in SEARCHES {
        let mut count = 0;
        let mut reached = 0.0_f64;
        for columns in rows(WORST) {
            if columns[1] != search.name || columns[2] != search.domain() || columns[3] != scalar::<T>() {
                continue;
            }
            let n = |i: usize| T::lit(number(columns[i]));
            let kind = match search.family {
                Family::Ggx => Kind::Ggx,
                Family::Beckmann => Kind::Beckmann,
                Family::Gtr => Kind::Gtr(number(columns[4])),
                Family::Closed | Family::Higher => Kind::Closed(columns[4].parse().unwrap()),
            };
            let input = Input { kind, alphas: [n(5), n(6)], at: [n(7), n(8), n(9)] };
            reached = reached.max(search.error(&input));
            count += 1;
        }
        assert!(count > 0, "{} {}", search.name, search.domain());
        let bound = bound(search.name, search.domain()).bounds[usize::from(!T::WIDENS)];
        assert!(
            reached <= bound && reached > 0.8 * bound,
            "{} {} {}: {reached} ε; the budget is {bound}",
            search.name,
            search.domain(),
            scalar::<T>()
        );
    }
}

/// A part of the usual effort: the oracle takes longer than that of the other searches.
const SHORT: Effort = Effort { starts: 60, moves: 20, finalists: 4 };
const LONG: Effort = Effort { starts: 2_000, moves: 40, finalists: 60 };

#[test]
fn no_worse_distributions_f32() {
    no_worse::<f32>(SHORT);
}

#[test]
fn no_worse_distributions_f64() {
    no_worse::<f64>(SHORT);
}

#[test]
fn the_worst_inputs_of_distributions() {
    worst_inputs::<f32>();
    worst_inputs::<f64>();
}

#[test]
#[ignore = "minutes: prints the table of the worst inputs"]
fn the_worst_distributions_f32() {
    print_worst::<f32>();
}

#[test]
#[ignore = "minutes: prints the table of the worst inputs"]
fn the_worst_distributions_f64() {
    print_worst::<f64>();
}
