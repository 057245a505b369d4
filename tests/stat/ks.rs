//! The Kolmogorov–Smirnov test of marginals whose distribution functions are known in closed form.
//!
//! The largest distance D between the empirical and the given distribution function has, for a
//! correct sampler and n → ∞, the distribution of Kolmogorov. Needs neither cells nor the crate's density,
//! and is sensitive to smooth shifts that cells average out.

use microsurface::verify::statistics::kolmogorov;

use crate::special::count;

/// The p-value that numbers in [0, 1] are uniform; sorts them.
pub(crate) fn p_value_of(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let n = count(numbers.len());
    let distance = numbers.iter().enumerate().map(|(i, &u)| {
        let (below, above) = (count(i) / n, count(i + 1) / n);
        (u - below).max(above - u)
    });
    let d = distance.fold(0.0, f64::max);
    let inside = numbers.iter().all(|u| (-1e-6..=1.0 + 1e-6).contains(u));
    if inside { kolmogorov(n, d) } else { 0.0 }
}

#[test]
fn evenly_spread_numbers_pass_and_bunched_ones_do_not() {
    let numbers =
        |f: fn(f64) -> f64| -> Vec<f64> { (0..1000).map(|i| f((f64::from(i) + 0.5) / 1000.0)).collect() };
    assert!(p_value_of(&mut numbers(|u| u)) > 0.999_999);
    assert!(p_value_of(&mut numbers(|u| u * u)) < 1e-20);
    assert!(p_value_of(&mut numbers(|u| u + 0.5)) < 1e-300);
    // The last of the n numbers is 0.95 (1 − 1/2n), which is D below 1.
    let distance: f64 = 1.0 - 0.95 * (1.0 - 0.5 / 1000.0);
    let p = p_value_of(&mut numbers(|u| 0.95 * u));
    assert!((p - kolmogorov(1000.0, distance)).abs() < 1e-12);
}
