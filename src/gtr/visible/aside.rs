//! The angle η out of the plane, density cos^(2n) η on |η| < ½π, n = k + 1.
//!
//! Its integral N(η) = η + sin η·cos η·Σⱼ δⱼ cos^(2j) η, j < n, δⱼ = Π_{i≤j} 2i/(2i + 1), has the
//! derivative cos^(2n) η/cₙ, cₙ = Π_{i≤n} (2i − 1)/(2i), and N(½π) = ½π; the δ do not depend on n.
//!
//! The guess: were n = 0 1 − (2η/π)² would be 4u(1 − u); it is a power of that, of which the
//! exponent drifts from its value at η = 0 to 1/(2n + 1). A polynomial in x/(x + 16), x = −ln 4u(1
//! − u), gives the exponent. One step follows, the Taylor series of η in N to the third power.

use super::{MAX, power};
use crate::elementary::polynomial::polynomial;
use crate::elementary::{exp_m1, ln, sin_cos_of_turn};
use crate::gtr::integer::number;
use crate::real::{Real, select};

/// The exponent of the guess, of the k in the row k − 1, constant term first, and the relative
/// error of the tail 1 − N/½π at the guess: see tests/reference/gtr_visible_guess.py.
const EXPONENT: [[f64; 7]; MAX] = [
    [0.1406858643, 0.0714532908, 0.0987239030, -0.2642118485, 0.3133356563, -0.2728144816, 0.1158336212], // 7.7e-05
    [0.0977379477, 0.0447067720, 0.0828758872, -0.2694496998, 0.4610357460, -0.4209649333, 0.1461587930], // 1.6e-04
    [0.0748245333, 0.0328182760, 0.0577217943, -0.1838768533, 0.2851618251, -0.1980946861, 0.0394235673], // 1.4e-04
    [0.0605916932, 0.0262518902, 0.0386595747, -0.1145784507, 0.1416736506, -0.0424411457, -0.0219984702], // 9.0e-05
    [0.0509075161, 0.0217357470, 0.0289678230, -0.0833769041, 0.0862254488, 0.0042382729, -0.0330936167], // 6.5e-05
    [0.0438942047, 0.0183971444, 0.0242807900, -0.0721619325, 0.0757709481, -0.0006984413, -0.0227440469], // 6.3e-05
    [0.0385796928, 0.0158873448, 0.0214315205, -0.0668431823, 0.0763001049, -0.0154550195, -0.0101160890], // 6.6e-05
    [0.0344132554, 0.0139484427, 0.0194390101, -0.0635104734, 0.0787900795, -0.0294014428, 0.0003667150], // 7.3e-05
];

/// δⱼ.
const DELTA: [f64; MAX + 1] = {
    let mut table = [1.0; MAX + 1];
    let mut j = 1;
    while j <= MAX {
        table[j] = table[j - 1] * number(2 * j) / number(2 * j + 1);
        j += 1;
    }
    table
};

/// cₙ of n = k + 1 in the row k − 1.
const CENTRE: [f64; MAX] = {
    let mut table = [0.375; MAX];
    let mut k = 2;
    while k <= MAX {
        table[k - 1] = table[k - 2] * number(2 * k + 1) / number(2 * k + 2);
        k += 1;
    }
    table
};

/// The step is no larger than this part of cot η. The guess is off by 2⁻¹²/2n; what exceeds that is
/// the rounding of N in the last few u.
const LONGEST: f64 = 0.00390625; // 2⁻⁸

/// (sin η, cos η), both by the same factor, of the fraction u of the distribution, 0 < u < 1.
#[inline(always)]
pub(super) fn angle<T: Real>(k: usize, u: T) -> (T::Wide, T::Wide) {
    let x = -ln((T::lit(4.0) * u * (T::ONE - u)).min(T::ONE));
    let exponent = polynomial(x / (x + T::lit(16.0)), &EXPONENT[k - 1]);
    let fraction = (-exp_m1(-(x * exponent))).sqrt().widen();

    let l = T::Wide::lit;
    let one = T::Wide::ONE;
    let from_half = u.widen() - T::Wide::HALF;
    let (sin, cos) = sin_cos_of_turn(l(0.25) * fraction);
    let n = l(number(k + 1));
    let cos2 = cos * cos;
    let half_pi = T::Wide::HALF * T::Wide::PI;
    // by what N is too small
    let missing =
        half_pi * (from_half.abs() * T::Wide::TWO - fraction) - sin * cos * polynomial(cos2, &DELTA[..=k]);
    let falloff = power(cos2, k);
    let inverse = one / (falloff * cos2);
    let tan = sin * cos * (inverse * falloff);
    let step = missing * l(CENTRE[k - 1]) * inverse;
    // where sin η is 0, so is the step
    let limit = l(LONGEST) * cos;
    let step = select(step.abs() * sin > limit, (limit / sin).copysign(step), step);
    let bend = n * tan;
    let third = n * l(1.0 / 3.0) * (one + (one + l(4.0) * n) * tan * tan);
    let angle = step * (one + step * (bend + step * third));
    // tan of the small angle
    let turn = angle * (one + l(1.0 / 3.0) * angle * angle);
    ((sin + cos * turn).copysign(from_half), cos - sin * turn)
}
