#!/usr/bin/env python3
"""GGX convolved with a Gaussian: values, and the fits of src/filter/gaussian.rs.

    python3 tests/reference/filter_gaussian.py > tests/reference/filter_gaussian.tsv
    python3 tests/reference/filter_gaussian.py fit        prints the coefficients (a minute; needs scipy)

For the unit GGX and an isotropic kernel 2σ² = s, at |t|² = q, by polar coordinates about the kernel's centre in 30-digit
arithmetic, a route of its own: ∫ r e^{-r²/s}/(s/2) g(r) dr, g the mean of P22 on the circle of radius r about t, which is
(1 + q + r²)/((1 + q + r²)² - 4 q r²)^{3/2}/π.
"""
import sys

from mpmath import mp, mpf

mp.dps = 30


def convolved(s, q):
    s, q = mpf(s), mpf(q)

    def integrand(r):
        b = 1 + q + r * r
        # (b² - 4qr²) as a product that does not cancel
        d = (1 + (mp.sqrt(q) - r) ** 2) * (1 + (mp.sqrt(q) + r) ** 2)
        return 2 * r / s * mp.exp(-r * r / s) * b / mp.sqrt(d) ** 3 / mp.pi

    ends = [mpf(0)]
    root, width = mp.sqrt(q), mp.sqrt(s)
    ends += [width * x for x in (0.1, 0.3, 1, 2, 3, 5, 9, 13)]
    ends += [x for x in (root * 0.5, root - 10, root - 3, root - 1, root, root + 1, root + 3, root + 10, root * 2)]
    ends += [mpf(x) for x in (0.3, 1, 3)]
    ends = sorted({e for e in ends if 0 <= e <= 13 * width})
    return mp.quad(integrand, ends, maxdegree=9)


def table():
    print("# written by filter_gaussian.py: s = 2σ²/A, q = tᵀA⁻¹t, P22 of the unit GGX convolved")
    for s in 1e-6, 0.01, 0.3, 1.0, 5.0, 40.0, 1e3, 1e5:
        for q in 0.0, 0.1, 1.0, 7.0, 100.0, 3e3, 1e6:
            print(f"{s!r}\t{q!r}\t{mp.nstr(convolved(s, q), 20)}")


def fit():
    import numpy as np
    from scipy.optimize import least_squares

    t = np.linspace(-5.0, 6.0, 400)
    x = np.exp(t - np.exp(-t))
    w = (t[1] - t[0]) * x * (1 + np.exp(-t))

    def exact(q, s):
        p = x / (1 + s * x)
        return ((w * np.exp(-x) * p)[None, :] * np.exp(-q[:, None] * p[None, :])).sum(1) / np.pi

    relative = np.concatenate([[0], np.logspace(-4, 4.5, 160)])
    data = [(s, relative * (1 + s), exact(relative * (1 + s), s)) for s in np.logspace(-3, 4, 29)]

    def widening(p, s):
        r = np.sqrt(s)
        k = p[0] * (1 + p[1] * r + p[2] * s) / (1 + p[3] * r + p[4] * s + p[5] * r**3)
        return k, 1 + (p[6] + p[7] * r + p[8] * s) / (1 + p[9] * r + p[10] * s + p[11] * s * r)

    def two(p, q, s):
        k, c = widening(p, s)
        a, b = 1 + k * s, c * (1 + s)
        return 1 / np.pi / (q + a) ** 2 + (1 - 1 / a) * np.exp(-q / b) / np.pi / b

    def error(p):
        return np.concatenate([np.log(np.maximum(two(p, q, s), 1e-300) / f) / min(1, 0.05 + s) ** 0.5 for s, q, f in data])

    start = [1.6, 0.1, 0.01, 0.5, 0.1, 0.01, 0.22, 0.5, 0.3, 0.5, 0.5, 0.1]
    print("widening:", list(np.round(least_squares(error, start, max_nfev=3000).x, 5)))

    q = np.concatenate([[0], np.logspace(-3, 6, 900)])
    ggx = 1 / np.pi / (1 + q) ** 2
    tail, n = 8.0, 5

    def components(p):
        weights = np.exp(p[n:])
        return np.exp(p[:n]), weights / weights.sum() * (1 - 1 / tail)

    def ratio(p):
        xs, weights = components(p)
        mixture = 1 / np.pi / (q + tail) ** 2 + sum(v * y / np.pi * np.exp(-q * y) for y, v in zip(xs, weights))
        return np.log(mixture / ggx)

    best = None
    for h in 1.0, 1.2, 1.4:
        xs = 2.5 * np.exp(-h * np.arange(n))
        r = least_squares(ratio, np.concatenate([np.log(xs), np.log(xs * np.exp(-xs) * h)]), max_nfev=800)
        for power in 2, 4:  # towards the smallest largest error
            r = least_squares(lambda p: np.sign(ratio(p)) * abs(30 * ratio(p)) ** power, r.x, max_nfev=600)
        worst = abs(ratio(r.x)).max()
        if best is None or worst < best[0]:
            best = worst, r.x
    xs, weights = components(best[1])
    print(f"cores: relative error {best[0]:.4f}", [[float(a), float(b)] for a, b in zip(xs, weights)])


if __name__ == "__main__":
    fit() if "fit" in sys.argv[1:] else table()
