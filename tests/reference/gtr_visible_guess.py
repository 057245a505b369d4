"""Coefficients of src/gtr/visible.rs and visible/aside.rs, whose texts define every symbol used here.

python tests/reference/gtr_visible_guess.py     (numpy, scipy; a few seconds)

Prints the exponents of the guess of η, each with the largest relative error of 1 − N/½π (a polynomial fit with Lawson's
weights), and for the guess of d the three constants of each k.
"""
import numpy as np
from numpy.polynomial import chebyshev, polynomial
from scipy.special import beta, betaincinv

DEGREE, SHIFT, END = 6, 16.0, 37.0


def exponents(n):
    tail = np.concatenate([1 - np.linspace(1e-4, 0.99, 300), 10.0 ** np.arange(-2.05, -16.3, -0.05)])
    cos2, sin2 = betaincinv(n + 0.5, 0.5, tail), betaincinv(0.5, n + 0.5, 1 - tail)
    middle = cos2 > 0.5
    sin = np.where(middle, np.sqrt(sin2), np.sqrt(1 - cos2))
    cos = np.where(middle, np.sqrt(1 - sin2), np.sqrt(cos2))
    eta, rest = np.arctan2(sin, cos), 2 / np.pi * np.arctan2(cos, sin)
    x = -np.log(tail * (2 - tail))
    y = -np.log(rest * (2 - rest))
    # d ln(tail)/dy, so that errors of the exponent y/x become those of the tail
    slope = cos ** (2 * n) / (beta(0.5, n + 0.5) / 2) / tail * (np.pi / 2) ** 2 * rest * (2 - rest) / (2 * eta)
    last = END / (END + SHIFT)
    t = 2 * x / (x + SHIFT) / last - 1
    weight, best = slope * x, (np.inf, None)
    for _ in range(150):
        c = chebyshev.chebfit(t, y / x, DEGREE, w=weight)
        error = np.abs((chebyshev.chebval(t, c) - y / x) * slope * x)
        best = min(best, (error.max(), c), key=lambda pair: pair[0])
        weight = weight * np.sqrt(0.1 + error / error.max())
        weight /= weight.max()
    total, power = np.zeros(1), np.ones(1)
    for a in chebyshev.cheb2poly(best[1]):
        total, power = polynomial.polyadd(total, a * power), polynomial.polymul(power, [-1, 2 / last])
    return best[0], total


for k in range(1, 9):
    error, c = exponents(k + 1)
    print("    [" + ", ".join(f"{a:.10f}" for a in c) + f"], // {error:.1e}")
for k in range(1, 9):
    half_total = beta(0.5, k + 1) / 2
    nu = 2 - ((2 * k + 2) * half_total) ** (1 / (k + 1))
    print(f"    [{nu:.6f}, {half_total ** (0.5 / k):.6f}, {2 / ((2 * k + 1) * (k + 1) ** (0.5 / k)):.6f}],")
