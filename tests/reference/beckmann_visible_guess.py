"""Coefficients of src/beckmann/visible.rs, whose text defines every symbol used here.

python tests/reference/beckmann_visible_guess.py     (mpmath, numpy, scipy; about a minute)

Prints the rational fits of h = ierfc/erfc (minimax by Lawson's weights, in 45 digits), the logarithm and the three
formulas of the guess (the same weights around a nonlinear least-squares fit), each with the largest error it attains.
"""
import mpmath as mp
import numpy as np
from scipy.optimize import least_squares
from scipy.special import erfc, erfcx

mp.mp.dps = 45
SQRT_PI = np.sqrt(np.pi)


def ratio(t):
    """h(t), by its continued fraction where the difference would cancel."""
    if t < 6:
        e = mp.exp(t * t) * mp.erfc(t)
        return (1 / mp.sqrt(mp.pi) - t * e) / e
    f = t
    for k in range(400, 1, -1):
        f = t + mp.mpf(k) / 2 / f
    return 1 / (2 * f)


def fit_ratio(n, count=160):
    """P of degree n−1, Q of degree n with Q(0) = 1 and the exact limit P/Q → 1/(2t)."""
    ys = [mp.cos(mp.pi * (2 * i + 1) / (2 * count)) for i in range(count)]
    ts = [mp.mpf("1.2") * (1 + y) / (1 - y) for y in ys]
    hs = [ratio(t) for t in ts]
    q_before, weight, best = [(1 + t) ** n for t in ts], [mp.mpf(1)] * count, None
    for iteration in range(14):
        a, b = mp.matrix(count, 2 * n - 1), mp.matrix(count, 1)
        for i, t in enumerate(ts):
            s = mp.sqrt(weight[i]) / (hs[i] * q_before[i])
            row = [t**k for k in range(n - 1)] + [-hs[i] * t**k for k in range(1, n)]
            for k, value in enumerate(row + [t ** (n - 1) / 2 - hs[i] * t**n]):
                a[i, k] = s * value
            b[i] = s * hs[i]
        x = list(mp.lu_solve(a.T * a, a.T * b))
        p, q = x[: n - 1] + [x[-1] / 2], [mp.mpf(1)] + x[n - 1 :]
        q_before = [mp.polyval(q[::-1], t) for t in ts]
        error = [abs(mp.polyval(p[::-1], t) / v / h - 1) for t, v, h in zip(ts, q_before, hs)]
        if best is None or max(error) < best[0]:
            best = max(error), p, q
        if iteration >= 2:
            weight = [w * (e / max(error) + mp.mpf("0.02")) for w, e in zip(weight, error)]
            weight = [w / max(weight) for w in weight]
    return best


def minimax(residual, start):
    """The parameters of least largest |residual|."""
    x = least_squares(residual, start, method="lm", max_nfev=4000).x
    best, weight = (np.abs(residual(x)).max(), x), np.ones_like(residual(x))
    for _ in range(15):
        e = np.abs(residual(x))
        weight = weight * (e / e.max() + 0.03)
        weight /= weight.max()
        x = least_squares(lambda x: residual(x) * np.sqrt(weight), x, method="lm", max_nfev=600).x
        if np.abs(residual(x)).max() < best[0]:
            best = np.abs(residual(x)).max(), x
    return best


LAGUERRE = np.polynomial.laguerre.laggauss(60)
LEGENDRE = np.polynomial.legendre.leggauss(60)


def ierfcx(t):
    """e^(t²)·ierfc t = 2/√π ∫ s e^(−s² − 2st) ds."""
    far = np.maximum(t, 1.5)[..., None]
    y, weight = LAGUERRE
    sums = np.sum(weight * y * np.exp(-((y / (2 * far)) ** 2)), -1) / (2 * SQRT_PI * far[..., 0] ** 2)
    return np.where(t < 1.5, 1 / SQRT_PI - t * erfcx(np.minimum(t, 1.5)), sums)


def upper(nu, w):
    """F(ν) − F(ν − w), times e^(ν²) for ν < 0."""
    s = w[..., None] * (LEGENDRE[0] + 1) / 2
    n = np.maximum(-nu, 0)[..., None]
    return np.sum(LEGENDRE[1] * s * np.exp(n * n - (nu[..., None] - s) ** 2), -1) * w / (2 * SQRT_PI)


def below():
    """(n, w, a) and the formula for ν < 0."""
    ns = [0, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1, 1.4, 2, 3, 4.5, 7, 12, 30, 1000]
    y = np.exp(np.linspace(np.log(0.01), np.log(44), 45))
    n = np.repeat(ns, len(y)).astype(float)
    y = np.tile(y, len(ns))
    w = np.where(n < 3, np.sqrt(n * n + 36 * (y / 42) ** 1.2) - n, y / np.maximum(2 * n, 1))
    k = ierfcx(n)
    scaled = (w * erfcx(n + w) + ierfcx(n + w)) / k
    a = w * (w + 2 * n) - np.log(scaled)
    used = (a > 1e-6) & (a < 38)
    n, w, a, k = n[used], w[used], a[used], np.sqrt(SQRT_PI * k[used])
    root = np.sqrt(a)

    def residual(c):
        rise = a + root * 2 * n * k / (1 + root * (c[0] + k * (c[1] + k * c[2])))
        return (rise / (n + np.sqrt(n * n + rise)) - w) / np.minimum(1 / (1 + n), w)

    return residual, [0.2, 0.5, 0.3]


def by_gamma(c, a, s):
    """X of the formula with γ."""
    root = np.sqrt(a)
    gamma = 1 + s * (c[0] + s * (c[1] + s * c[2])) / (1 + root * (c[3] + s * c[4]))
    centre = s * gamma / SQRT_PI
    return np.sqrt(centre * centre + gamma * a) - centre


def left():
    """The formula for ν ≥ 0, x ≤ 0."""
    nus = [0, 0.01, 0.03, 0.1, 0.2, 0.35, 0.6, 1, 1.5, 2, 3, 4, 6, 9, 15, 40, 1e6]
    x = np.tile(np.linspace(0.01, 6.2, 50), len(nus))
    nu = np.repeat(nus, 50)
    a = x * x - np.log((nu * erfcx(x) + 1 / SQRT_PI) / (nu + 1 / SQRT_PI))
    s = nu * SQRT_PI / (1 + nu * SQRT_PI)
    return (lambda c: by_gamma(c, a, s) - x), [1.0, 0.0, -0.7, 0.5, 0.0]


def right(gamma):
    """The excess of the formula for x > 0; toward u = 1 a larger error does no harm."""
    xs, x1s, ws, tolerances = [], [], [], []
    nus = [0.05, 0.1, 0.2, 0.35, 0.6, 0.8, 1, 1.25, 1.5, 1.75, 2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6, 7, 8, 10, 14, 20, 50, 1e3]
    for nu in map(float, nus):
        x = min(nu, 6.1) * (0.5 - 0.5 * np.cos(np.pi * np.linspace(0.02, 0.98, 70)))
        total = 0.5 * (nu * erfc(-nu) + np.exp(-nu * nu) / SQRT_PI)
        if nu > 8:
            part, rest = 0.5 * (nu * erfc(x) - np.exp(-x * x) / SQRT_PI), 0.5 * (nu - 1 / SQRT_PI)
        else:
            part, rest = upper(np.full_like(x, nu), nu - x), upper(np.array([nu]), np.array([nu]))[0]
        b, end = part / rest, erfc(nu)
        eta = 8 * np.exp(-nu * nu) / SQRT_PI * rest / (1 - end) ** 2
        e = 0.5 * ((1 - eta) * b + np.sqrt((1 - eta) ** 2 * b * b + 4 * eta * b))
        x1 = np.minimum(by_gamma(gamma, -np.log(end + (1 - end) * e), 1.0), nu)
        used = part / total > 1e-17
        xs.append(x[used]), x1s.append(x1[used]), ws.append((nu - x1)[used])
        tolerances.append(np.maximum(1, (1e-2 / (part / total)[used]) ** 0.12))
    x, x1, w, tolerance = map(np.concatenate, (xs, x1s, ws, tolerances))
    print("without the excess:", np.abs(x1 - x).max())
    excess = lambda c: x1 * w * w / (c[0] + c[1] * w**3 + c[2] * x1 * w * w)
    return (lambda c: (x1 - excess(c) - x) / tolerance), [2.6, 2.7, 3.5]


def rough_ln():
    """ln(1 + f)/f for √½ ≤ 1 + f < √2."""
    f = (3 + np.cos(np.pi * (np.arange(400) + 0.5) / 400)) / np.sqrt(8) - 1
    return minimax(lambda c: np.polyval(c[::-1], f) * f / np.log1p(f) - 1, [1, -1 / 2, 1 / 3, -1 / 4, 1 / 5])


for degree in (5, 7, 11):
    error, p, q = fit_ratio(degree)
    print("h: relative error", mp.nstr(error, 3))
    print("  P", [float(c) for c in p], "\n  Q", [float(c) for c in q])
error, c = rough_ln()
print("LN error %.2g" % error, np.round(c, 9).tolist())
for name, problem in (("BELOW", below()), ("GAMMA", left())):
    error, c = minimax(*problem)
    print(name, "error %.2g" % error, np.round(c, 6).tolist())
error, c = minimax(*right(np.round(c, 6)))
print("EXCESS error %.2g" % error, np.round(c, 6).tolist())
