//! Sums and products with their exact rounding errors.

/// a·b − c·d to about an ulp of the result, by exact products (Dekker 1971; Kahan's algorithm).
#[inline(always)]
pub(crate) fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let (p, p_error) = two_product(a, b);
    let (q, q_error) = two_product(c, d);
    let (difference, error) = two_sum(p, -q);
    difference + (error + (p_error - q_error))
}

/// a + b as a rounded sum and its exact error (Knuth).
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// a·b as a rounded product and its exact error.
#[inline(always)]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let halves = |x: f64| {
        let t = 134217729.0 * x; // 2²⁷ + 1
        let high = t - (t - x);
        (high, x - high)
    };
    let product = a * b;
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    (product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
}
