//! The largest error of every function, as the documentation states it.
//!
//! A test fails above the bound and also below half of it, so that neither the code nor its
//! documentation can drift. Errors are relative and in units of the scalar's ε (2⁻²³, 2⁻⁵²) unless
//! the row says absolute.

use microsurface::Real;

/// One line of the budget.
#[derive(Debug)]
pub(crate) struct Row {
    pub(crate) function: &'static str,
    pub(crate) domain: &'static str,
    /// In units of ε, for f32 and f64; 0 where a row is for f32 alone.
    pub(crate) bounds: [f64; 2],
    /// Where the worst error is attained.
    pub(crate) attained: &'static str,
}

const fn row(function: &'static str, domain: &'static str, bounds: [f64; 2], attained: &'static str) -> Row {
    Row { function, domain, bounds, attained }
}

/// Every row; `function` and `domain` together are the key.
pub(crate) const BUDGET: &[Row] = &[
    row("ggx_d", "θ ≤ 5α", [3.7, 3.4], "a ratio of α of 100 or more"),
    row("ggx_d", "beyond", [3.0, 2.5], "the horizon"),
    row("ggx_d", "θ ≤ 5α, dense", [4.9, 0.0], "θ ≈ 3α, aspect 0.1"),
    row(
        "beckmann_d",
        "θ ≤ 5α",
        [3.0, 31.0],
        "exponents of about 25; in f64 the error is that of the exponent",
    ),
    row("beckmann_d", "exponent > 26, per unit of it", [0.1, 0.9], "anywhere: the error of the exponent"),
    row("beckmann_d", "θ ≤ 5α, dense", [4.6, 0.0], "θ ≈ 4α"),
    row("gtr_d", "θ ≤ 5α", [3.2, 12.0], "f64: γ = 10, whose power is steep"),
    row("gtr_d", "beyond", [3.0, 11.0], "f64: γ = 10"),
    row("gtr_heavy_d", "θ ≤ 5α", [3.3, 9.0], "γ near 2"),
    row("gtr_heavy_d", "beyond", [2.9, 9.0], "γ near 2"),
    row("gtr_heavy_d", "θ ≤ 5α, dense", [5.0, 0.0], "γ near 2"),
    row("gtr_heavy_g1", "θ ≤ 5α, dense", [2.1, 0.0], "near the horizon"),
    row("gtr_d", "θ ≤ 5α, dense", [4.2, 0.0], "θ ≈ 4α"),
    row("ggx_sigma", "above the horizon", [1.3, 1.2], "steep slopes"),
    row("ggx_sigma", "below the horizon", [1.6, 1.2], "|z| of the order of α"),
    row("ggx_lambda", "above the horizon", [2.0, 1.8], "Λ ≈ 0.1"),
    row("ggx_lambda", "below the horizon", [1.4, 1.2], "near the horizon"),
    row("ggx_g1", "above the horizon", [1.5, 1.4], "α = 10, z = 0.01"),
    row("ggx_g1", "θ ≤ 5α, dense", [1.7, 0.0], "near the horizon"),
    row("beckmann_sigma", "above the horizon", [2.9, 2.2], "near the horizon"),
    row("beckmann_sigma", "below the horizon, per 1 + a²", [1.9, 1.9], "near the horizon"),
    row("beckmann_lambda", "above the horizon", [3.4, 22.0], "f64: a² ≈ 20, the error of the exponent"),
    row("beckmann_lambda", "below the horizon", [1.9, 2.1], "near the horizon"),
    row("beckmann_lambda", "a² > 26, per unit of it", [0.12, 1.1], "anywhere: the error of the exponent"),
    row("beckmann_g1", "above the horizon", [3.2, 2.1], "near the horizon"),
    row("beckmann_g1", "θ ≤ 5α, dense", [2.9, 0.0], "near the horizon"),
    row("gtr_sigma", "above the horizon", [2.9, 3.2], "γ = 4 near the horizon"),
    row("gtr_sigma", "below the horizon", [3.2, 2.6], "γ = 4"),
    row("gtr_lambda", "above the horizon", [4.9, 4.2], "γ = 4, Λ small"),
    row("gtr_lambda", "below the horizon", [0.9, 1.4], "γ = 1, 4"),
    row("gtr_g1", "above the horizon", [2.4, 3.5], "γ = 4 near the horizon"),
    row("gtr_higher_sigma", "above the horizon", [5.3, 5.2], "γ = 10 near the horizon"),
    row("gtr_higher_sigma", "below the horizon", [6.4, 5.4], "γ = 6, 10"),
    row("gtr_higher_lambda", "above the horizon", [11.5, 12.0], "γ = 10, Λ small"),
    row("gtr_higher_lambda", "below the horizon", [0.9, 1.4], "γ = 10"),
    row("gtr_higher_g1", "above the horizon", [5.3, 4.7], "γ = 10 near the horizon"),
    row("gtr_g1", "θ ≤ 5α, dense", [2.5, 0.0], "γ = 1 near the horizon"),
    row("fresnel_dielectric", "absolute", [4.2, 4.0], "η of a thousand and more"),
    row("fresnel_conductor", "absolute", [4.8, 4.8], "grazing angles, large n"),
    row("projected", "entries", [2.5, 11.0], "long thin kernels"),
    row("projected", "determinant", [0.6, 2.0], "kernels along the wide axis"),
    row("ggx_d", "searched", [5.7, 5.4], "tests/reference/worst.tsv"),
    row("ggx_sigma", "searched", [2.1, 2.1], "tests/reference/worst.tsv"),
    row("ggx_sigma", "searched below the horizon", [3.0, 3.1], "tests/reference/worst.tsv"),
    row("ggx_lambda", "searched", [3.1, 3.1], "tests/reference/worst.tsv"),
    row("ggx_lambda", "searched below the horizon", [2.5, 2.3], "tests/reference/worst.tsv"),
    row("ggx_g1", "searched", [2.4, 2.2], "tests/reference/worst.tsv"),
    row("beckmann_d", "searched", [3.8, 89.0], "tests/reference/worst.tsv"),
    row("beckmann_d", "searched, exponent > 26, per unit of it", [0.15, 4.0], "tests/reference/worst.tsv"),
    row("beckmann_sigma", "searched", [4.1, 4.0], "tests/reference/worst.tsv"),
    row("beckmann_sigma", "searched below the horizon, per 1 + a²", [4.0, 4.0], "tests/reference/worst.tsv"),
    row("beckmann_lambda", "searched", [6.3, 57.0], "tests/reference/worst.tsv"),
    row("beckmann_lambda", "searched below the horizon", [4.1, 4.1], "tests/reference/worst.tsv"),
    row("beckmann_lambda", "searched, a² > 26, per unit of it", [0.2, 2.7], "tests/reference/worst.tsv"),
    row("beckmann_g1", "searched", [4.1, 3.9], "tests/reference/worst.tsv"),
    row("gtr_d", "searched", [3.9, 26.0], "tests/reference/worst.tsv"),
    row("gtr_sigma", "searched", [7.4, 6.9], "tests/reference/worst.tsv"),
    row("gtr_sigma", "searched below the horizon", [11.0, 9.8], "tests/reference/worst.tsv"),
    row("gtr_lambda", "searched", [9.4, 9.5], "tests/reference/worst.tsv"),
    row("gtr_lambda", "searched below the horizon", [6.9, 6.9], "tests/reference/worst.tsv"),
    row("gtr_g1", "searched", [7.2, 6.8], "tests/reference/worst.tsv"),
    row("gtr_higher_sigma", "searched", [13.0, 13.0], "tests/reference/worst.tsv"),
    row("gtr_higher_sigma", "searched below the horizon", [31.0, 29.0], "tests/reference/worst.tsv"),
    row("gtr_higher_lambda", "searched", [30.0, 32.0], "tests/reference/worst.tsv"),
    row("gtr_higher_lambda", "searched below the horizon", [13.0, 14.0], "tests/reference/worst.tsv"),
    row("gtr_higher_g1", "searched", [13.0, 14.0], "tests/reference/worst.tsv"),
];

/// The row of a function and a domain.
pub(crate) fn bound(function: &str, domain: &str) -> &'static Row {
    let row = BUDGET.iter().find(|row| row.function == function && row.domain == domain);
    row.unwrap_or_else(|| panic!("no row {function}, {domain}"))
}

/// Compares the worst error found with the row of the budget.
pub(crate) fn assert_within<T: Real>(function: &str, domain: &str, worst: f64, input: &str) {
    let row = bound(function, domain);
    let (index, scalar) = if T::EPSILON.to_f64() > 1e-10 { (0, "f32") } else { (1, "f64") };
    let bound = row.bounds[index];
    assert!(
        worst <= bound && worst >= 0.5 * bound,
        "{function} ({scalar}, {domain}): worst error {worst:.3} ε at {input}; the budget is {bound} ε at {}",
        row.attained
    );
}
