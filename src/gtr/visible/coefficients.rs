//! Numbers that depend on the exponent k alone.

use crate::gtr::integer::number;

/// The largest k.
pub(super) const MAX: usize = 8;

/// βᵢ of the k in the row k − 1.
pub(super) const BETA: [[f64; MAX + 1]; MAX] = {
    let mut table = [[0.0; MAX + 1]; MAX];
    let mut k = 1;
    while k <= MAX {
        table[k - 1][0] = 1.0 / number(k + 1);
        let mut i = 1;
        while i <= k {
            table[k - 1][i] = table[k - 1][i - 1] * number(k + 1 - i) / number(k + 1 + i);
            i += 1;
        }
        k += 1;
    }
    table
};

/// κᵢ of the k in the row k − 1, i ≤ k + 1.
pub(super) const KAPPA: [[f64; MAX + 2]; MAX] = {
    let mut table = [[0.0; MAX + 2]; MAX];
    let mut k = 1;
    while k <= MAX {
        let beta = &BETA[k - 1];
        table[k - 1][0] = 1.0 / number((k + 1) * (2 * k + 1));
        let mut i = 1;
        while i <= k {
            // βᵢ₋₁ − βᵢ
            table[k - 1][i] = beta[i - 1] * number(2 * i) / number(k + 1 + i);
            i += 1;
        }
        table[k - 1][k + 1] = beta[k];
        k += 1;
    }
    table
};

/// Q = ∫₀¹(1 − x²)ᵏ dx, of the k in the row k − 1.
pub(super) const HALF_TOTAL: [f64; MAX] = {
    let mut table = [2.0 / 3.0; MAX];
    let mut k = 2;
    while k <= MAX {
        table[k - 1] = table[k - 2] * number(2 * k) / number(2 * k + 1);
        k += 1;
    }
    table
};

/// Coefficients of the guess, for k in the row k − 1, from tests/reference/gtr_visible_guess.py:
/// ν = 2 − ((2k + 2)Q)^(1/(k+1)); Q^(1/2k); and of the hyperbola the slope at a vertical v,
/// 2/((2k + 1)(k + 1)^(1/2k)).
pub(super) const GUESS: [[f64; 3]; MAX] = [
    [0.367007, 0.816497, 0.471405],
    [0.526387, 0.854574, 0.303934],
    [0.617117, 0.877692, 0.226772],
    [0.676330, 0.893537, 0.181726],
    [0.718315, 0.905213, 0.151993],
    [0.749793, 0.914244, 0.130816],
    [0.774361, 0.921477, 0.114930],
    [0.794124, 0.927424, 0.102551],
];
