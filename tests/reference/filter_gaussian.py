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


def fit_long(widening, least_squares, np):
    """What elongation adds to the widening of isotropic kernels; isotropic ones stay as they are."""
    t = np.linspace(-5.0, 6.0, 300)
    x = np.exp(t - np.exp(-t))
    w = (t[1] - t[0]) * x * (1 + np.exp(-t)) * np.exp(-x)
    angles = (np.arange(16) + 0.5) * np.pi / 32
    radii = np.exp(np.linspace(-7, 7, 120))[:, None]
    isotropic = [1.67179, 2.14821, 0.38614, 2.37567, 2.27974, 0.0741, 0.11355, 0.75467, 0.08572, 0.21039, 0.6077, 0.1203]

    def exact(s1, s2, u, v):
        a, b = 1 / x + s1, 1 / x + s2
        return (w / np.sqrt(a * b) * np.exp(-u[..., None] ** 2 / a - v[..., None] ** 2 / b)).sum(-1) / np.pi

    data = []
    for s1 in 0.1, 0.3, 1, 3, 10, 30, 100, 300, 1e3, 3e3, 1e4, 1e5, 1e6, 1e8:
        for ratio in 0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.4, 0.7:
            s2 = s1 * ratio
            if s2 == 0 or s2 >= 3e-3:
                u, v = np.sqrt(1 + s1) * radii * np.cos(angles), np.sqrt(1 + s2) * radii * np.sin(angles)
                area = np.sqrt((1 + s1) * (1 + s2)) * radii**2 * 14 / 119 * np.pi / 8
                data.append((s1, s2, u, v, area, exact(s1, s2, u, v), exact(s1, s2, np.zeros(1), np.zeros(1))[0]))

    def two(p, s1, s2, u, v):
        k, c = widening(isotropic, np.sqrt((1 + s1) * (1 + s2)) - 1)
        e, r = 1 - np.sqrt((1 + s2) / (1 + s1)), np.sqrt(s2)
        c += e * (e * (p[0] + p[1] * r + p[2] * s2) / (1 + abs(p[3]) * s2 * r) + p[4] * (1 - e))
        k *= 1 + p[5] * e * e
        a1, a2, b1, b2 = 1 + k * s1, 1 + k * s2, c * (1 + s1), c * (1 + s2)
        a = np.sqrt(a1 * a2)
        tail = 1 / (np.pi * a * a) / (1 + u * u / a1 + v * v / a2) ** 2
        return tail + (1 - 1 / a) / np.pi / np.sqrt(b1 * b2) * np.exp(-u * u / b1 - v * v / b2)

    def error(p):  # light at wrong slopes, and the peak to a high power
        rows = []
        for s1, s2, u, v, area, f, peak in data:
            moved = 0.5 * (area * abs(two(p, s1, s2, u, v) - f)).sum()
            at_peak = two(p, s1, s2, np.zeros(1), np.zeros(1))[0] / peak - 1
            rows += [10 * moved**2, (abs(at_peak) / 0.028) ** 6]
        return np.array(rows)

    start = [0.075, -0.14, 0.78, 1.5, 0.14, -0.39]
    print("long kernels:", list(np.round(least_squares(error, start, max_nfev=100).x, 5)))


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

    fit_long(widening, least_squares, np)

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
