//! The masks of GTR by few nodes, their tables, and the components, against 50-digit values and
//! each other.

use microsurface::glam::DVec3;
use microsurface::gtr::Density;
use microsurface::gtr::components::Components;
use microsurface::gtr::table::GtrTable;
use microsurface::{Gtr, Ndf, Real, SampleVndf};

use super::{MASKING_GTR, number, rows, vector};
use crate::worst::Worst;

/// max |ΔG1| of a mask of `nodes` for α of at least `alpha`, whatever γ and the direction.
struct Bound {
    nodes: usize,
    alpha: f64,
    g1: f64,
}

const fn bound(nodes: usize, alpha: f64, g1: f64) -> Bound {
    Bound { nodes, alpha, g1 }
}

/// The errors that `gtr::nodes` states.
const BOUNDS: &[Bound] = &[
    bound(4, 1e-3, 1.1e-3),
    bound(4, 0.01, 3.2e-4),
    bound(4, 0.1, 2.8e-5),
    bound(4, 0.5, 3.5e-7),
    bound(6, 1e-3, 7e-5),
    bound(6, 0.01, 9e-6),
    bound(6, 0.1, 2.1e-7),
    bound(6, 0.5, 1e-9),
    bound(8, 1e-3, 8e-6),
    bound(8, 0.01, 3.8e-7),
    bound(8, 0.1, 4.5e-9),
    bound(8, 0.5, 4.5e-12),
    bound(12, 1e-3, 1.3e-7),
    bound(12, 0.01, 1.2e-9),
    bound(12, 0.1, 1.8e-12),
];

fn surface<T: Real, const N: usize>(alpha: f64, gamma: f64) -> impl Ndf<Scalar = T> {
    Gtr::with_nodes::<N>(T::lit(alpha), T::lit(gamma)).unwrap()
}

/// The worst error of `N` nodes on the table, for α ≥ `smallest`.
fn on_the_table<T: Real, const N: usize>(smallest: f64) -> Worst {
    let mut worst = Worst::default();
    for columns in rows(MASKING_GTR) {
        let [alpha, gamma, z, lambda] = [1, 3, 6, 8].map(|i| number(columns[i]));
        if z > 0.0 && alpha >= 0.999 * smallest {
            let w = vector::<T>(&columns[4..7]);
            let g1 = surface::<T, N>(alpha, gamma).g1(w, w).to_f64();
            worst.see(g1 - 1.0 / (1.0 + lambda), || columns.join(" "));
        }
    }
    worst
}

/// Directions of cot θ = 1e-5 … 1e3.
fn directions() -> impl Iterator<Item = [f64; 3]> {
    (0..160).map(|i| {
        let cot = 10_f64.powf(-5.0 + 0.05 * f64::from(i));
        let sin = 1.0 / cot.hypot(1.0);
        [sin, 0.0, sin * cot]
    })
}

/// Exponents densest about the integers, where the rules begin and end.
fn gammas() -> Vec<f64> {
    let mut gammas: Vec<f64> = (0..=100).map(|i| 0.1 * f64::from(i)).collect();
    for integer in 0..10 {
        for offset in [1e-9, 1e-4, 0.02, 0.05] {
            gammas.extend([f64::from(integer) + offset, f64::from(integer + 1) - offset]);
        }
    }
    gammas
}

/// The worst difference from 16 nodes, on a dense grid.
fn densely<const N: usize>(alphas: &[f64]) -> Worst {
    let mut worst = Worst::default();
    for &alpha in alphas {
        for gamma in gammas() {
            let (few, many) = (surface::<f64, N>(alpha, gamma), surface::<f64, 16>(alpha, gamma));
            for w in directions() {
                let w = DVec3::from(w);
                worst.see(few.g1(w, w) - many.g1(w, w), || format!("α {alpha} γ {gamma} {w}"));
            }
        }
    }
    worst
}

fn check<const N: usize>() {
    for &Bound { alpha, g1, .. } in BOUNDS.iter().filter(|bound| bound.nodes == N) {
        let table = on_the_table::<f64, N>(alpha);
        let alphas: Vec<f64> = [1.0, 1.3, 2.0, 4.0, 10.0, 30.0, 100.0, 400.0]
            .map(|k| alpha * k)
            .into_iter()
            .filter(|&a| a < 1.0)
            .collect();
        let dense = densely::<N>(&alphas);
        println!("{N} nodes, α ≥ {alpha}: {:.2e} at {}; table {:.2e}", dense.error, dense.at, table.error);
        assert!(table.error <= g1, "{N} nodes, α ≥ {alpha}: {:e} at {}", table.error, table.at);
        assert!(
            dense.error <= g1 && dense.error >= 0.5 * g1,
            "{N} nodes, α ≥ {alpha}: {:e} at {}",
            dense.error,
            dense.at
        );
    }
}

#[test]
fn four_nodes() {
    check::<4>();
}

#[test]
fn six_nodes() {
    check::<6>();
}

#[test]
fn eight_nodes() {
    check::<8>();
}

#[test]
fn twelve_nodes() {
    check::<12>();
}

/// What the dense grids are compared with.
#[test]
fn sixteen_nodes_are_those_of_the_table() {
    for (alpha, bound) in [(1e-3, 4e-9), (0.01, 1e-11), (0.1, 3e-13)] {
        let worst = on_the_table::<f64, 16>(alpha);
        println!("16 nodes, α ≥ {alpha}: {:.2e} at {}", worst.error, worst.at);
        assert!(worst.error <= bound, "α ≥ {alpha}: {:e} at {}", worst.error, worst.at);
    }
    // f32: the rounding on top of eight nodes.
    let worst = on_the_table::<f32, 8>(0.01);
    println!("8 nodes, f32: {:.2e} at {}", worst.error, worst.at);
    assert!(worst.error <= 4.8e-7, "f32: {:e} at {}", worst.error, worst.at);
}

/// (n + 1) Σₖ C(n,k)/(k + 1) (1−t)ᵏ t^{−k−1}, from the definition: what normalises (x + 1)ⁿ/(x +
/// t)^{n+2} over the plane.
fn integer_slope_density(gamma: f64, alpha: f64, x: f64) -> f64 {
    let (n, t) = (gamma - 2.0, alpha * alpha);
    let (mut sum, mut binomial) = (0.0, 1.0);
    for k in 0..=(n as i32) {
        sum += binomial * (1.0 - t).powi(k) / (f64::from(k + 1) * t.powi(k + 1));
        binomial *= (n - f64::from(k)) / f64::from(k + 1);
    }
    (x + 1.0).powf(n) / (x + t).powf(gamma) / sum
}

/// The components against D itself, from the pole to where tan θ = 100.
#[test]
fn components_are_the_density() {
    for (smallest, bound) in [(1e-3, 1.1e-6), (0.01, 1.6e-7), (0.1, 1e-7)] {
        let mut worst = Worst::default();
        for alpha in
            [1.0, 3.0, 10.0, 50.0, 300.0, 990.0].map(|k| k * smallest).into_iter().filter(|&a| a < 1.0)
        {
            for gamma in gammas().into_iter().step_by(2) {
                let (components, density) =
                    (Components::new(alpha, gamma).unwrap(), Density::new(alpha, gamma).unwrap());
                let total: f64 = components.iter().map(|c| c.weight).sum();
                assert!((total - 1.0).abs() < 1e-14, "α {alpha} γ {gamma}: {total}");
                for i in 0..60 {
                    let tan2 = (1e-3 * alpha * alpha) * (1e7 / (alpha * alpha)).powf(f64::from(i) / 59.0);
                    let z2 = 1.0 / (1.0 + tan2);
                    let exact = density.d(DVec3::new((tan2 * z2).sqrt(), 0.0, z2.sqrt())) * z2 * z2;
                    let sum: f64 = components
                        .iter()
                        .map(|c| c.weight * integer_slope_density(c.gamma, c.alpha, tan2))
                        .sum();
                    worst.see(sum / (f64::PI * exact) - 1.0, || format!("α {alpha} γ {gamma} tan² {tan2:e}"));
                }
            }
        }
        println!("components, α ≥ {smallest}: {:.2e} at {}", worst.error, worst.at);
        assert!(
            worst.error <= bound && worst.error >= 0.5 * bound,
            "{smallest}: {:e} {}",
            worst.error,
            worst.at
        );
    }
}

#[test]
fn tables_are_near_their_nodes() {
    for (gammas, bound) in
        [([0.1, 1.09, 1.7, 2.0], 8e-6), ([2.3, 3.1, 3.6, 4.0], 1.2e-5), ([5.5, 8.01, 9.001, 10.0], 1.6e-4)]
    {
        let mut worst = Worst::default();
        for gamma in gammas {
            let table = GtrTable::<f64, 8>::new(gamma, 1e-3).unwrap();
            let narrow = GtrTable::<f32, 8>::new(gamma as f32, 1e-3).unwrap();
            for i in 0..=300 {
                let alpha = 10_f64.powf(-0.01 * f64::from(i)).max(1e-3);
                let (exact, hit) = (surface::<f64, 16>(alpha, gamma), table.isotropic(alpha).unwrap());
                let narrow_hit = narrow.isotropic((alpha as f32).max(1e-3)).unwrap();
                for w in directions() {
                    let w = DVec3::from(w);
                    let g1 = exact.g1(w, w);
                    worst.see(hit.g1(w, w) - g1, || format!("α {alpha} γ {gamma} {w}"));
                    let w = w.as_vec3();
                    worst.see(f64::from(narrow_hit.g1(w, w)) - g1, || format!("f32 α {alpha} γ {gamma} {w}"));
                }
                if gamma <= 2.0 {
                    let (w, heavy) = (DVec3::new(0.8, 0.0, 0.6), table.heavy_tailed(alpha).unwrap());
                    assert!((heavy.g1(w, w) - hit.g1(w, w)).abs() < 1e-14);
                    let u = microsurface::glam::DVec2::new(0.3, 0.6);
                    assert!(heavy.sample_vndf(w, u).distance(hit.sample_vndf(w, u)) < 1e-14);
                }
            }
        }
        println!("table: {:.2e} at {}", worst.error, worst.at);
        assert!(worst.error <= bound && worst.error >= 0.5 * bound, "{:e} {}", worst.error, worst.at);
    }
}

/// z Λ at cot θ = `cot`, sin θ = 1, of GTR at the integer γ = n + 2.
fn backfacing_of_integer(gamma: f64, alpha: f64, cot: f64) -> f64 {
    macro_rules! closed {
        ($($integer:literal)*) => {
            match gamma {
                $(g if g == f64::from($integer) => {
                    Gtr::closed::<$integer>(alpha).unwrap().sigma(DVec3::new(1.0, 0.0, -cot))
                })*
                _ => unreachable!("{gamma} is no integer"),
            }
        };
    }
    closed!(2 3 4 5 6 7 8 9 10)
}

/// The largest relative error of σ below the horizon, where it is the area of a share of the tail,
/// for γ ∈ `gammas`.
fn below_the_horizon<const N: usize>(smallest: f64, gammas: core::ops::Range<f64>) -> Worst {
    let mut worst = Worst::default();
    for alpha in [1.0, 3.0, 10.0, 100.0].map(|k| k * smallest).into_iter().filter(|&a| a < 1.0) {
        for i in 0..=40 {
            let gamma = gammas.start + (gammas.end - gammas.start) * f64::from(i) / 40.0;
            let few = surface::<f64, N>(alpha, gamma);
            let components = Components::new(alpha, gamma).unwrap();
            for i in 0..40 {
                let cot = 10_f64.powf(-5.0 + 0.2 * f64::from(i));
                let exact: f64 =
                    components.iter().map(|c| c.weight * backfacing_of_integer(c.gamma, c.alpha, cot)).sum();
                let sigma = few.sigma(DVec3::new(1.0, 0.0, -cot));
                worst.see(sigma / exact - 1.0, || format!("α {alpha} γ {gamma} cot {cot:e}"));
            }
        }
    }
    worst
}

/// The table that `gtr::nodes` states for σ and Λ where little is seen.
#[test]
fn light_tails_below_the_horizon() {
    for (smallest, gammas, bound) in [
        (1e-3, 0.0..2.0, 3e-4),
        (1e-3, 2.0..3.0, 0.03),
        (1e-3, 3.0..4.0, 0.7),
        (1e-3, 4.0..10.0, 1.0),
        (0.01, 0.0..2.0, 6e-6),
        (0.01, 2.0..3.0, 5e-4),
        (0.01, 3.0..4.0, 0.015),
        (0.01, 4.0..10.0, 1.0),
        (0.1, 0.0..2.0, 2e-8),
        (0.1, 2.0..3.0, 1e-7),
        (0.1, 3.0..4.0, 8e-6),
        (0.1, 4.0..10.0, 0.15),
    ] {
        let worst = below_the_horizon::<8>(smallest, gammas.clone());
        println!("α ≥ {smallest}, γ in {gammas:?}: {:.2e} at {}", worst.error, worst.at);
        assert!(worst.error <= bound && worst.error >= 0.5 * bound, "{:e} at {}", worst.error, worst.at);
    }
}

/// The area seen along the normal is 1 for every γ, however near to 0 and to the integers.
#[test]
fn the_area_along_the_normal_is_one() {
    for power in [-320, -300, -200, -100, -60, -20, -19, -18, -17, -10, -3] {
        let step = 10_f64.powi(power);
        for gamma in [step, 1.0 - step, 1.0 + step, 2.0 - step, 2.0 + step, 5.0 + step] {
            for alpha in [1e-6, 1e-3, 0.1, 0.9, 1.0] {
                let sigma = surface::<f64, 8>(alpha, gamma).sigma(DVec3::Z);
                assert!((sigma - 1.0).abs() < 1e-15, "α {alpha} γ {gamma:e}: {sigma}");
                let w = DVec3::new(1.0, 0.0, 1e-3).normalize();
                let (g1, whole) = (
                    surface::<f64, 16>(alpha, gamma).g1(w, w),
                    surface::<f64, 16>(alpha, gamma.round()).g1(w, w),
                );
                let nearest = (gamma - gamma.round()).abs();
                assert!((g1 - whole).abs() < 30.0 * nearest + 1e-6, "α {alpha} γ {gamma:e}: {g1} {whole}");
            }
        }
    }
}

/// Interpolated weights too: a negative one, which counts as 0, would leave more than 1.
#[test]
fn the_area_along_the_normal_is_one_in_tables() {
    let tiny = (1..=320).step_by(3).map(|power| 10_f64.powi(-power));
    for gamma in tiny.chain(gammas()) {
        let table = GtrTable::<f64, 8>::new(gamma, 1e-3).unwrap();
        let narrow = GtrTable::<f32, 8>::new(gamma as f32, 1e-3).unwrap();
        for i in 0..60 {
            let alpha = 10_f64.powf(-0.05 * f64::from(i));
            let sigma = table.isotropic(alpha).unwrap().sigma(DVec3::Z);
            assert!((sigma - 1.0).abs() < 1e-15, "α {alpha} γ {gamma:e}: {sigma}");
            let sigma = narrow.isotropic(alpha as f32).unwrap().sigma(microsurface::glam::Vec3::Z);
            assert!((sigma - 1.0).abs() < 5e-7, "f32 α {alpha} γ {gamma:e}: {sigma}");
        }
    }
}

/// Across every integer, where one rule ends and the next begins, and towards α = 1.
#[test]
fn masks_are_continuous() {
    let g1 = |alpha: f64, gamma: f64, w: DVec3| surface::<f64, 8>(alpha, gamma).g1(w, w);
    for (alpha, jump) in [(1e-3, 2e-6), (0.01, 4e-7), (0.1, 4e-9), (0.5, 2.5e-11), (0.9, 6e-12)] {
        let mut worst = Worst::default();
        for integer in 0..=10_u8 {
            let gamma = f64::from(integer);
            for w in directions().step_by(3) {
                let w = DVec3::from(w);
                let middle = g1(alpha, gamma, w);
                for step in [1e-10, 4e-15, f64::MIN_POSITIVE] {
                    for gamma in [gamma - step, gamma + step] {
                        if (0.0..=10.0).contains(&gamma) {
                            worst.see(g1(alpha, gamma, w) - middle, || format!("γ {gamma} {w}"));
                        }
                    }
                }
            }
        }
        println!("jump at α = {alpha}: {:.2e} at {}", worst.error, worst.at);
        assert!(worst.error <= jump, "α {alpha}: {:e} at {}", worst.error, worst.at);
    }
    for gamma in [0.0, 1e-9, 0.7, 1.0, 2.0, 2.4, 3.9, 7.3, 10.0] {
        for w in directions().step_by(7) {
            let w = DVec3::from(w);
            let uniform = Gtr::closed::<0>(1.0).unwrap().g1(w, w);
            for below_one in [0.0, 1e-16, 1e-12, 1e-8, 1e-4] {
                let difference = (g1(1.0 - below_one, gamma, w) - uniform).abs();
                assert!(
                    difference <= 4.0 * below_one * (1.0 + gamma) + 1e-9,
                    "γ {gamma} 1 − {below_one:e} {w}: {difference:e}"
                );
            }
        }
    }
}
