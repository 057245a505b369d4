//! Densities, areas, masks and Fresnel terms against the tables of 50-digit values in
//! `tests/reference`.
//!
//! The inputs of the tables are f32 numbers taken as they are, so no error of an input counts.

mod budget;
mod nodes;
pub(crate) mod search;

use microsurface::fresnel::{Conductor, Dielectric, Fresnel, Spectrum};
use microsurface::gtr::Density;
use microsurface::{Beckmann, Ggx, Gtr, Ndf, Real, glam};
use rand::Rng;

use budget::assert_within;

use crate::rows::Row;
use crate::surfaces::{Move, Spec, Surface, Widths};
use crate::worst::Worst;

const NDF: &str = include_str!("../reference/ndf.tsv");
const MASKING: &str = include_str!("../reference/masking.tsv");
const MASKING_GTR: &str = include_str!("../reference/masking_gtr.tsv");
const FRESNEL: &str = include_str!("../reference/fresnel.tsv");

/// The γ of the tables that have closed masks.
const CLOSED: [&str; 7] = ["0", "1", "2", "3", "4", "6", "10"];

/// The rows of a table, split into columns.
pub(crate) fn rows(table: &str) -> impl Iterator<Item = Vec<&str>> {
    table.lines().filter(|line| !line.starts_with('#')).map(|line| line.split('\t').collect())
}

pub(crate) fn number(column: &str) -> f64 {
    column.parse().unwrap_or_else(|_| panic!("not a number: {column}"))
}

pub(crate) fn vector<T: Real>(columns: &[&str]) -> T::Vec3 {
    [0, 1, 2].map(|i| T::lit(number(columns[i]))).into()
}

impl Worst {
    /// Takes in |value − exact| in units of `unit` ε.
    fn add<T: Real>(&mut self, value: T, exact: f64, unit: f64, input: &[&str]) {
        let error = (value.to_f64() - exact) / (unit * T::EPSILON.to_f64());
        self.see(error, || format!("{value} instead of {exact} at {}", input.join(" ")));
    }

    /// A relative error, or for results below the normal numbers of the scalar an absolute one in
    /// their ulp.
    fn add_relative<T: Real>(&mut self, value: T, exact: f64, input: &[&str]) {
        self.add(value, exact, exact.abs().max(T::MIN_POSITIVE.to_f64()), input);
    }
}

/// The names of the distributions without a width of their own, as in the tables.
fn plain() -> impl Iterator<Item = &'static str> {
    Row::with_own_density().map(Row::columns).filter(|columns| !columns.own_width).map(|columns| columns.name)
}

/// The surface of a table's first columns.
fn surface<T: Real>(columns: &[&str]) -> Surface<T> {
    let [name, exponent] = [columns[0], columns[3]];
    let of_exponent = format!("{name}-closed-{exponent}");
    let named = |row: &&Row| [name, &of_exponent].contains(&row.columns().name);
    let row = Row::ALL.iter().rev().find(named).unwrap_or_else(|| panic!("no row for {name} {exponent}"));
    let [alpha_x, alpha_y] = [1, 2].map(|i| number(columns[i]));
    let widths = if row.columns().own_width || alpha_x == alpha_y {
        Widths::Isotropic(if row.columns().own_width { 1.0 } else { alpha_x })
    } else {
        Widths::AxisAligned(alpha_x, alpha_y)
    };
    let gamma = exponent.parse().unwrap_or(f64::INFINITY);
    Spec::new(row.with(alpha_x, gamma), widths, Move::Stay).build().unwrap()
}

/// q/z² of a row of densities (`normal`) or z²/s² of a row of masks: the exponent of Beckmann.
fn exponent(columns: &[&str], normal: bool) -> f64 {
    let [alpha_x, alpha_y, _, x, y, z] = [1, 2, 2, 4, 5, 6].map(|i| number(columns[i]));
    if normal {
        ((x / alpha_x).powi(2) + (y / alpha_y).powi(2)) / (z * z)
    } else {
        z * z / ((x * alpha_x).powi(2) + (y * alpha_y).powi(2))
    }
}

/// Beyond this exponent an error of Beckmann is stated per unit of the exponent.
const LARGE_EXPONENT: f64 = 26.0;

fn densities<T: Real>() {
    let steep = |c: &[&str]| c[0] == "beckmann" && exponent(c, true) > LARGE_EXPONENT;
    for ndf in plain().chain(["gtr"]) {
        for (near, domain) in [("1", "θ ≤ 5α"), ("0", "beyond")] {
            if (ndf, near) == ("beckmann", "0") {
                continue; // all of it has a large exponent
            }
            let mut worst = Worst::default();
            for columns in rows(NDF).filter(|c| c[0] == ndf && c[7] == near && !steep(c)) {
                let wm = vector::<T>(&columns[4..7]);
                if CLOSED.contains(&columns[3]) {
                    let closed = surface::<T>(&columns).d(wm);
                    worst.add_relative(closed, number(columns[8]), &columns);
                }
                let d = if ndf == "gtr" {
                    let [alpha, gamma] = [1, 3].map(|i| T::lit(number(columns[i])));
                    Density::new(alpha, gamma).unwrap().d(wm)
                } else {
                    surface::<T>(&columns).d(wm)
                };
                worst.add_relative(d, number(columns[8]), &columns);
            }
            assert!(worst.count > 30, "{ndf} {domain}: {}", worst.count);
            if ndf == "gtr" {
                let mut heavy = Worst::default();
                for columns in rows(NDF).filter(|c| c[0] == ndf && c[7] == near && number(c[3]) <= 2.0) {
                    let [alpha, gamma] = [1, 3].map(|i| T::lit(number(columns[i])));
                    let d = Gtr::heavy_tailed::<4>(alpha, gamma).unwrap().d(vector::<T>(&columns[4..7]));
                    heavy.add_relative(d, number(columns[8]), &columns);
                }
                assert!(heavy.count > 30, "{domain}: {}", heavy.count);
                assert_within::<T>("gtr_heavy_d", domain, heavy.error, &heavy.at);
            }
            assert_within::<T>(&format!("{ndf}_d"), domain, worst.error, &worst.at);
        }
    }
    let mut worst = Worst::default();
    for columns in rows(NDF).filter(|c| steep(c)) {
        let d = surface::<T>(&columns).d(vector::<T>(&columns[4..7]));
        let exact = number(columns[8]);
        let unit = exact.max(T::MIN_POSITIVE.to_f64()) * exponent(&columns, true);
        worst.add(d, exact, unit, &columns);
    }
    assert!(worst.count > 30);
    assert_within::<T>("beckmann_d", "exponent > 26, per unit of it", worst.error, &worst.at);
}

fn masks<T: Real>() {
    // GTR of γ above 4 has a longer sum.
    let of_gtr = [("gtr", "gtr", &CLOSED[..5]), ("gtr_higher", "gtr", &CLOSED[5..])];
    for (name, ndf, gammas) in plain().map(|name| (name, name, &["-"] as &[&str])).chain(of_gtr) {
        let [mut above, mut below, mut lambda, mut lambda_below, mut far, mut g1] =
            [(); 6].map(|()| Worst::default());
        let table = if ndf == "gtr" { MASKING_GTR } else { MASKING };
        let closed = |c: &Vec<&str>| c[0] == ndf && gammas.contains(&c[3]);
        for columns in rows(table).filter(closed) {
            let w = vector::<T>(&columns[4..7]);
            let [z, exact_sigma, exact_lambda] = [6, 7, 8].map(|i| number(columns[i]));
            let surface = surface::<T>(&columns);
            let [sigma, lambda_of_w, g1_of_w] = [surface.sigma(w), surface.lambda(w), surface.g1(w, w)];
            let steepness = exponent(&columns, false);
            let steep = ndf == "beckmann" && steepness > LARGE_EXPONENT;
            let representable = exact_lambda.abs() < T::MAX.to_f64();
            if z < 0.0 {
                let unit = if ndf == "beckmann" { 1.0 + steepness } else { 1.0 };
                below.add(sigma, exact_sigma, unit * exact_sigma.max(T::MIN_POSITIVE.to_f64()), &columns);
                if representable {
                    lambda_below.add_relative(lambda_of_w, exact_lambda, &columns);
                }
                continue;
            }
            above.add_relative(sigma, exact_sigma, &columns);
            if z == 0.0 {
                assert_eq!(lambda_of_w, T::INFINITY, "{columns:?}");
                assert_eq!(g1_of_w, T::ZERO, "{columns:?}");
            } else if representable {
                g1.add_relative(g1_of_w, 1.0 / (1.0 + exact_lambda), &columns);
                if steep {
                    far.add(
                        lambda_of_w,
                        exact_lambda,
                        steepness * exact_lambda.max(T::MIN_POSITIVE.to_f64()),
                        &columns,
                    );
                } else {
                    lambda.add_relative(lambda_of_w, exact_lambda, &columns);
                }
            }
        }
        let below_domain =
            if ndf == "beckmann" { "below the horizon, per 1 + a²" } else { "below the horizon" };
        for (function, domain, worst) in [
            ("sigma", "above the horizon", above),
            ("sigma", below_domain, below),
            ("lambda", "above the horizon", lambda),
            ("lambda", "below the horizon", lambda_below),
            ("g1", "above the horizon", g1),
        ] {
            assert!(worst.count > 10, "{name} {function}: {}", worst.count);
            assert_within::<T>(&format!("{name}_{function}"), domain, worst.error, &worst.at);
        }
        if ndf == "beckmann" {
            assert!(far.count > 30);
            assert_within::<T>("beckmann_lambda", "a² > 26, per unit of it", far.error, &far.at);
        }
    }
}

fn fresnel<T: Real + Spectrum<Scalar = T>>() {
    let [mut dielectric, mut conductor] = [(); 2].map(|()| Worst::default());
    for columns in rows(FRESNEL) {
        let [n, k, cos, exact] = [1, 2, 3, 6].map(|i| number(columns[i]));
        let [n, k, cos] = [n, k, cos].map(T::lit);
        if columns[0] == "dielectric" {
            dielectric.add(Dielectric::new(n).unwrap().reflectance(cos), exact, 1.0, &columns);
        }
        if let Ok(metal) = Conductor::new(n, k) {
            conductor.add(metal.reflectance(cos), exact, 1.0, &columns);
        }
    }
    for (function, worst) in [("dielectric", dielectric), ("conductor", conductor)] {
        assert!(worst.count > 100);
        assert_within::<T>(&format!("fresnel_{function}"), "absolute", worst.error, &worst.at);
    }
}

/// η² − 1 + cos² cancels here, at cosines that no f32 holds. Values by mpmath with 60 digits.
#[test]
fn fresnel_at_the_critical_angle() {
    for (eta, cos, exact) in [
        (1.0 / 1.5, 0.7453559924999301, 0.999_999_853_950_693_77),
        (1.0 / 1.5, 0.7453559924999305, 0.999_999_756_916_204_97),
        (0.9999999878593023, 1.5582488663059215e-4, 0.999_740_779_235_687_2),
    ] {
        let dielectric = Dielectric::new(eta).unwrap().reflectance(cos);
        let conductor = Conductor::new(eta, 0.0).unwrap().reflectance(cos);
        for f in [dielectric, conductor] {
            assert!((f - exact).abs() <= 4.0 * f64::EPSILON, "{eta} {cos}: {f:e} for {exact:e}");
        }
    }
}

/// Random numbers of `bits` bits in [0, 1), exact in f32.
fn uniform(rng: &mut rand_pcg::Pcg64Mcg) -> f64 {
    f64::from(rng.next_u32() >> 8) / f64::from(1 << 24)
}

/// f32 against f64 on many random inputs, which the tables cannot have: the f64 values have been
/// compared with the tables.
#[test]
fn f32_agrees_with_f64_densely() {
    let mut rng = rand_pcg::Pcg64Mcg::new(7);
    let names = ["ggx", "beckmann", "gtr", "gtr_heavy"];
    let mut density = names.map(|_| Worst::default());
    let mut mask = names.map(|_| Worst::default());
    for _ in 0..400_000 {
        let alpha = f32::lit(10_f64.powf(-6.0 * uniform(&mut rng)));
        let aspect = f32::lit(10_f64.powf(-uniform(&mut rng)));
        let gamma = f32::lit(10.0 * uniform(&mut rng));
        let theta = (5.0 * f64::from(alpha)).min(1.57) * uniform(&mut rng);
        let phi = core::f64::consts::TAU * uniform(&mut rng);
        let (sin, cos) = theta.sin_cos();
        let m = [sin * phi.cos(), sin * phi.sin(), cos].map(f32::lit);
        let narrow = glam::Vec3::from(m);
        let wide = narrow.as_dvec3();
        let pair = |i: usize| -> [f64; 4] {
            let [a, b] = [alpha, alpha * aspect];
            let [aw, bw] = [f64::from(a), f64::from(b)];
            let ([s, l], [sw, lw]) = match i {
                0 => {
                    let (s, w) = (Ggx::anisotropic(a, b).unwrap(), Ggx::anisotropic(aw, bw).unwrap());
                    ([s.d(narrow), s.g1(narrow, narrow)], [w.d(wide), w.g1(wide, wide)])
                }
                1 => {
                    let (s, w) = (Beckmann::isotropic(a).unwrap(), Beckmann::isotropic(aw).unwrap());
                    ([s.d(narrow), s.g1(narrow, narrow)], [w.d(wide), w.g1(wide, wide)])
                }
                3 => {
                    // Four nodes: only the rounding is compared.
                    let g = f32::lit(0.2 * f64::from(gamma));
                    let heavy = Gtr::heavy_tailed::<4>(a, g).unwrap();
                    let exact = Gtr::heavy_tailed::<4>(aw, f64::from(g)).unwrap();
                    ([heavy.d(narrow), heavy.g1(narrow, narrow)], [exact.d(wide), exact.g1(wide, wide)])
                }
                _ => {
                    let (s, w) = (Gtr::closed::<1>(a).unwrap(), Gtr::closed::<1>(aw).unwrap());
                    let (d, dw) =
                        (Density::new(a, gamma).unwrap(), Density::new(aw, f64::from(gamma)).unwrap());
                    ([d.d(narrow), s.g1(narrow, narrow)], [dw.d(wide), w.g1(wide, wide)])
                }
            };
            [f64::from(s), f64::from(l), sw, lw]
        };
        let input = format!("α {alpha} aspect {aspect} γ {gamma} m {m:?}");
        for i in 0..names.len() {
            let [d, g1, d_wide, g1_wide] = pair(i);
            if d_wide > f64::from(f32::MIN_POSITIVE) {
                density[i].add(f32::lit(d), d_wide, d_wide, &[&input]);
            }
            mask[i].add(f32::lit(g1), g1_wide, g1_wide, &[&input]);
        }
    }
    for (i, name) in names.iter().enumerate() {
        // The promise: 6e-7 for θ ≤ 5α.
        assert!(density[i].error * f64::from(f32::EPSILON) <= 6e-7, "{name}: {}", density[i].error);
        assert_within::<f32>(&format!("{name}_d"), "θ ≤ 5α, dense", density[i].error, &density[i].at);
        assert_within::<f32>(&format!("{name}_g1"), "θ ≤ 5α, dense", mask[i].error, &mask[i].at);
    }
}

#[test]
fn densities_f32() {
    densities::<f32>();
}

#[test]
fn densities_f64() {
    densities::<f64>();
}

#[test]
fn masks_f32() {
    masks::<f32>();
}

#[test]
fn masks_f64() {
    masks::<f64>();
}

#[test]
fn fresnel_f32() {
    fresnel::<f32>();
}

#[test]
fn fresnel_f64() {
    fresnel::<f64>();
}
