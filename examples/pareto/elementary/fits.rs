//! The short fits that renderers use for exponentials and error functions, from their publications.

use super::libraries::Libraries;
use crate::textbook::Elementary;

/// erf within 1.5e-7: Abramowitz and Stegun 1964, 7.1.26, after Hastings; in use in pbrt-v3.
#[inline(always)]
pub(crate) fn erf_hastings<T: Elementary>(x: T) -> T {
    let l = T::lit;
    let a = x.abs();
    let t = T::ONE / (T::ONE + l(0.3275911) * a);
    let sum = t
        * (l(0.254829592)
            + t * (l(-0.284496736) + t * (l(1.421413741) + t * (l(-1.453152027) + t * l(1.061405429)))));
    (T::ONE - sum * (-a * a).exp()).copysign(x)
}

/// erf⁻¹ in single precision: M. Giles, "Approximating the erfinv function", GPU Computing Gems
/// (2011), Listing 1; in use in pbrt.
#[inline(always)]
pub(crate) fn erf_inv_giles<T: Elementary>(x: T) -> T {
    const CENTRE: [f64; 9] = [
        1.50140941,
        0.246640727,
        -0.00417768164,
        -0.00125372503,
        0.00021858087,
        -4.39150654e-06,
        -3.5233877e-06,
        3.43273939e-07,
        2.81022636e-08,
    ];
    const TAIL: [f64; 9] = [
        2.83297682,
        1.00167406,
        0.00943887047,
        -0.0076224613,
        0.00573950773,
        -0.00367342844,
        0.00134934322,
        0.000100950558,
        -0.000200214257,
    ];
    let w = -((T::ONE - x) * (T::ONE + x)).ln();
    let horner = |v: T, c: &[f64; 9]| c.iter().rev().fold(T::ZERO, |sum, &c| sum * v + T::lit(c));
    if w < T::lit(5.0) {
        horner(w - T::lit(2.5), &CENTRE) * x
    } else {
        horner(w.sqrt() - T::lit(3.0), &TAIL) * x
    }
}

/// 2ᶠ − 1 of [`exp_cubic`], within 1.2e-4.
const LINEAR: f64 = 0.695;
const SQUARE: f64 = 0.22748836;
const CUBE: f64 = 1.0 - LINEAR - SQUARE;

/// eˣ = 2ⁿ·2ᶠ with a cubic for 2ᶠ that is exact at 0 and 1, as pbrt-v4 has one; 0 or ∞ beyond the
/// normal numbers of f32.
#[inline(always)]
pub(super) fn exp_cubic<T: Libraries>(x: T) -> T {
    let scaled = x * T::lit(core::f64::consts::LOG2_E);
    let n = scaled.std_floor();
    let f = scaled - n;
    let two_to_f = T::ONE + f * (T::lit(LINEAR) + f * (T::lit(SQUARE) + f * T::lit(CUBE)));
    if n < T::lit(-126.0) {
        return T::ZERO;
    }
    if n > T::lit(127.0) {
        return T::INFINITY;
    }
    two_to_f * n.exp2_of_integer()
}
