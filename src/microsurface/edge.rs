//! Facets at the edge of visibility, turned into view.

use crate::Real;
use crate::vector::{dot, positive_part};

/// A vector along m, of any length, turned towards w where rounding had turned it away.
///
/// The facets at the edge of visibility have w·m = 0; a sample there may come out behind by the
/// rounding of the sum, and would have no density. Nearly all samples are farther from the edge
/// than that, which one comparison tells.
#[inline(always)]
pub(crate) fn turned_into_view<T: Real>(w: [T; 3], m: [T; 3]) -> [T; 3] {
    if in_view(w, m) { m } else { turned_from_the_edge(w, m) }
}

/// Whether m is in view of w beyond doubt: if not, see [`turned_into_view`].
#[inline(always)]
pub(crate) fn in_view<T: Real>(w: [T; 3], m: [T; 3]) -> bool {
    let (w_m, length2) = (dot(w, m), dot(m, m));
    // 16ε|m| bounds the rounding of w·m, here and once more in the caller: 3ε Σ|terms|
    // ≤ 3√3 ε|m| each. Squares that are no normal numbers tell nothing.
    let edge = T::lit(256.0) * T::EPSILON * T::EPSILON * length2 + T::MIN_POSITIVE;
    w_m * w_m.abs() > edge
}

/// Turns a facet near the edge of visibility, whose m may be the difference of two equal
/// vectors.
///
/// It is moved towards w to w·m of 8ε of the terms of the sum, and at least 2⁻⁶⁴ (f32) or 2⁻⁵¹²
/// (f64) of the length where all terms vanish. It is long enough for its square to be a number.
#[inline(always)]
fn turned_from_the_edge<T: Real>(w: [T; 3], m: [T; 3]) -> [T; 3] {
    let sum_of_magnitudes = |v: [T; 3]| v[0].abs() + v[1].abs() + v[2].abs();
    let (short, longer, least) = if T::WIDENS {
        (9.313225746154785e-10, 1073741824.0, 5.421010862427522e-20) // 2⁻³⁰, 2³⁰, 2⁻⁶⁴
    } else {
        (6.223015277861142e-61, 1.6069380442589903e60, 7.458340731200207e-155) // 2⁻²⁰⁰, 2²⁰⁰, 2⁻⁵¹²
    };
    // So that its square is a number.
    let scale = if sum_of_magnitudes(m) < T::lit(short) { T::lit(longer) } else { T::ONE };
    let m = m.map(|c| c * scale);
    let terms = [w[0] * m[0], w[1] * m[1], w[2] * m[2]];
    let margin = T::lit(8.0) * T::EPSILON * sum_of_magnitudes(terms) + T::lit(least) * sum_of_magnitudes(m);
    let push = positive_part(margin - (terms[0] + terms[1] + terms[2]));
    // Along w, or along its horizontal part from below, so that no facet comes to look down.
    let towards = [w[0], w[1], positive_part(w[2])];
    let push = push / dot(towards, towards);
    [m[0] + push * towards[0], m[1] + push * towards[1], m[2] + push * towards[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The edge of [`in_view`] is at w·m = 16 ε|m|, and what is nearer is turned to 8 ε of its
    /// terms.
    fn facets_within_16_roundings_of_the_edge_are_turned<T: Real>() {
        let w = [T::lit(0.6), T::ZERO, T::lit(0.8)];
        for length in [1.0, 1e-6, 1e6].map(T::lit) {
            let facet = |roundings: f64| {
                // Across w, and this far towards it.
                let towards = T::lit(roundings) * T::EPSILON;
                [T::lit(-0.8) + towards * w[0], T::ZERO, T::lit(0.6) + towards * w[2]].map(|c| length * c)
            };
            for (roundings, seen, turns) in
                [(24.0, true, false), (12.0, false, false), (0.0, false, true), (-4.0, false, true)]
            {
                let m = facet(roundings);
                assert_eq!(in_view(w, m), seen, "{roundings}");
                let turned = turned_into_view(w, m);
                let facing = (dot(w, turned) / (T::EPSILON * dot(turned, turned).sqrt())).to_f64();
                assert!(facing > 4.0 && facing < 30.0, "{facing} of {roundings}");
                assert_eq!(turned != m, turns, "{roundings}");
            }
        }
    }

    #[test]
    fn facets_within_16_roundings_of_the_edge_are_turned_f32() {
        facets_within_16_roundings_of_the_edge_are_turned::<f32>();
    }

    #[test]
    fn facets_within_16_roundings_of_the_edge_are_turned_f64() {
        facets_within_16_roundings_of_the_edge_are_turned::<f64>();
    }
}
