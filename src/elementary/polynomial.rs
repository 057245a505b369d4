//! Polynomials of short tables.

use crate::real::Real;

/// c₀ + c₁x + c₂x² + …, as two polynomials in x² so that both are evaluated at once.
#[inline(always)]
pub(crate) fn polynomial<T: Real>(x: T, c: &[f64]) -> T {
    polynomial_of(x, c.len(), |i| T::lit(c[i]))
}

/// The polynomial whose coefficients depend on the argument.
#[inline(always)]
pub(super) fn polynomial_of<T: Real>(x: T, len: usize, c: impl Fn(usize) -> T) -> T {
    let y = x * x;
    let (mut even, mut odd) = (c(len - 1), c(len - 2));
    if len.is_multiple_of(2) {
        (even, odd) = (odd, even);
    }
    for i in (0..len - 2).rev() {
        if i % 2 == 0 {
            even = even * y + c(i);
        } else {
            odd = odd * y + c(i);
        }
    }
    even + x * odd
}
