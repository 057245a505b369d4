#!/usr/bin/env python3
"""Computes the coefficient tables of src/elementary/coefficients/ and prints each with its attained error.

Every table is a minimax fit by Remez' exchange in 200-bit arithmetic (mpmath), on a grid of Chebyshev points
fine enough that the error between its points does not matter, weighted so that the *relative* error of the
function that uses it is equalised. Coefficients are then rounded to the scalar one by one, and the error is
measured again with the rounded ones.

    python3 tests/reference/elementary_coefficients.py            all tables, as Rust
    python3 tests/reference/elementary_coefficients.py ierfcx     those whose name starts with this
"""
import sys

import numpy as np
from mpmath import mp, mpf, erf, erfc, exp, log, sqrt, pi, sin, cos, expm1, matrix, lu_solve

mp.prec = 220


def chebyshev_grid(a, b, count):
    a, b = mpf(a), mpf(b)
    return [(a + b) / 2 - (b - a) / 2 * mp.cos(mp.pi * (2 * i + 1) / (2 * count)) for i in range(count)]


def horner(c, x):
    y = mpf(0)
    for k in reversed(c):
        y = y * x + k
    return y


def signed_extrema(error, count):
    """Indices of the largest |error| of alternating sign: `count` of them."""
    runs = []
    for i, e in enumerate(error):
        if runs and (error[runs[-1]] > 0) == (e > 0):
            if abs(e) > abs(error[runs[-1]]):
                runs[-1] = i
        else:
            runs.append(i)
    while len(runs) > count:
        # dropping an end keeps the signs alternating; inside, drop the smaller neighbours as a pair
        if len(runs) == count + 1:
            runs.pop(0 if abs(error[runs[0]]) < abs(error[runs[-1]]) else -1)
        else:
            j = min(range(len(runs) - 1), key=lambda j: max(abs(error[runs[j]]), abs(error[runs[j + 1]])))
            del runs[j:j + 2]
    return runs


def solve(xs, fs, ws, n, m, points, level, alternating):
    """P, Q with P/Q - f = ±level/w at the points; the level is a further unknown where `alternating`."""
    size = n + m + 1 + alternating
    a, b = matrix(size, size), matrix(size, 1)
    for row, i in enumerate(points):
        x, f, w = xs[i], fs[i], ws[i]
        sign = 1 if row % 2 == 0 else -1
        target = f + sign * level / w
        power = mpf(1)
        for j in range(n + 1):
            a[row, j] = power
            power *= x
        power = x
        for j in range(m):
            a[row, n + 1 + j] = -target * power
            power *= x
        if alternating:
            a[row, size - 1] = -sign / w
        b[row] = f
    with mp.workprec(1800 if m else mp.prec):  # powers up to FAR^13
        s = lu_solve(a, b)
    return list(s[: n + 1]), [mpf(1)] + list(s[n + 1 : n + 1 + m]), s[size - 1]


def least_squares(xs, fs, ws, n, m, rounds=10):
    """P, Q with Σ (w (P/Q - f))² nearly smallest: linear least squares of P - f Q, reweighted by the last Q."""
    size = n + m + 1
    q = [mpf(1)]
    # points at the ends of a Chebyshev grid are dense already: no further weights
    for _ in range(rounds):
        a, b = matrix(size, size), matrix(size, 1)
        for x, f, w in zip(xs, fs, ws):
            v = w / horner(q, x)
            row, power = [], v
            for j in range(max(n, m) + 1):
                row.append(power)
                power *= x
            row = row[: n + 1] + [-f * r for r in row[1 : m + 1]]
            for i in range(size):
                b[i] += row[i] * f * v
                for j in range(i + 1):
                    a[i, j] += row[i] * row[j]
        for i in range(size):
            for j in range(i):
                a[j, i] = a[i, j]
        s = lu_solve(a, b)
        p, q = list(s[: n + 1]), [mpf(1)] + list(s[n + 1 :])
    return p, q


def remez(xs, fs, ws, n, m=0, rounds=30):
    """Coefficients p (degree n), q (degree m, q0 = 1) of P/Q minimising max |w (P/Q - f)| over the grid.

    Starts from the interpolant at Chebyshev nodes, or from least squares where there is a denominator: their
    errors nearly alternate already.
    """
    size, count = n + m + 2, len(xs)
    if m == 0:
        nodes = [min(count - 1, int((i + 0.5) * count / (size - 1))) for i in range(size - 1)]  # a Chebyshev grid
        p, q, _ = solve(xs, fs, ws, n, m, nodes, mpf(0), False)
    else:
        stride = max(1, count // (4 * size))
        with mp.workprec(1800):
            p, q = least_squares(xs[::stride], fs[::stride], ws[::stride], n, m)
    best, level = None, mpf(0)
    for _ in range(rounds):
        error = [w * (horner(p, x) / horner(q, x) - f) for x, f, w in zip(xs, fs, ws)]
        worst = max(abs(e) for e in error)
        if best is None or worst < best[2]:
            best = (p, q, worst)
        reference = signed_extrema(error, size)
        if len(reference) < size or (level != 0 and worst < abs(level) * mpf("1.002")):
            break
        level = min(abs(error[i]) for i in reference) * (1 if error[reference[0]] > 0 else -1)
        for _ in range(1 if m == 0 else 12):
            p, q, new = solve(xs, fs, ws, n, m, reference, level, True)
            done = abs(new - level) <= abs(new) * mpf(10) ** -6
            level = new
            if done:
                break
    return best


def rounded(c, scalar):
    if scalar == "f64":
        return [mpf(float(k)) for k in c]
    return [mpf(float(np.float32(float(k)))) for k in c]


def scaled(p, q, scalar):
    """P and Q times a number of the scalar near 1 that leaves p0 nearly a number of the scalar too."""
    if rounded(p[:1], scalar)[0] == 1:
        return p, q
    ulp = mpf(2) ** (-23 if scalar == "f32" else -52)
    scales = [1 + 37 * i * ulp for i in range(2000)]
    scale = min(scales, key=lambda s: abs(rounded([p[0] * s], scalar)[0] / (p[0] * s) - 1))
    return [v * scale for v in p], [v * scale for v in q]


def descended(p, q, xs, fs, ws):
    """f32 coefficients near these that do better: one or two units in the last place, while it helps.

    The first coefficient of each stays, since it fixes the value at 0.
    """
    x, f, w = (np.array([float(v) for v in column]) for column in (xs, fs, ws))
    c = [np.float32(float(v)) for v in p + q]
    n = len(p)

    def worst(c):
        values = [float(v) for v in c]
        return np.max(np.abs(w * (np.polyval(values[:n][::-1], x) / np.polyval(values[n:][::-1], x) - f)))

    free = [i for i in range(len(c)) if i not in (0, n)]
    best, improved = worst(c), True
    while improved:
        improved = False
        moves = [[(i, a)] for i in free for a in (1, -1)]
        moves += [[(i, a), (j, b)] for i in free for j in free if i < j for a in (1, -1) for b in (1, -1)]
        for move in moves:
            trial = list(c)
            for i, direction in move:
                trial[i] = np.nextafter(trial[i], np.float32(direction * np.inf))
            e = worst(trial)
            if e < best:
                best, c, improved = e, trial, True
    return [mpf(float(v)) for v in c[:n]], [mpf(float(v)) for v in c[n:]]


def bits(x):
    return "0" if x == 0 else f"2^{float(mp.log(x, 2)):.2f}"


def measured(p, q, xs, fs, ws):
    return max(abs(w * (horner(p, x) / horner(q, x) - f)) for x, f, w in zip(xs, fs, ws))


WANTED = sys.argv[1] if len(sys.argv) > 1 else ""


def literal(k, scalar):
    return repr(float(k)) if scalar == "f64" else repr(float(str(np.float32(float(k)))))


def table(name, scalar, doc, samples, n, m=0):
    """`samples` is a list of (x, f, w)."""
    if not name.lower().startswith(WANTED.lower()):
        return
    if callable(samples):
        samples = samples()
    xs, fs, ws = zip(*samples)
    p, q, error = remez(xs, fs, ws, n, m)
    if m:
        p, q = scaled(p, q, scalar)
    pr, qr = rounded(p, scalar), rounded(q, scalar)
    if scalar == "f32" and (m or name == "EXP"):
        pr, qr = descended(pr, qr, xs, fs, ws)
    print(f"// {scalar} {name}: {doc}; minimax {bits(error)}, rounded {bits(measured(pr, qr, xs, fs, ws))}")
    print(f"const {name}{'_NUM' if m else ''}: &'static [f64] = &[{', '.join(literal(k, scalar) for k in pr)}];")
    if m:
        print(f"const {name}_DEN: &'static [f64] = &[{', '.join(literal(k, scalar) for k in qr)}];")
    sys.stdout.flush()


def erfcx(x):
    if x > 12:
        y = mpf(0)
        for k in range(400, 0, -1):
            y = mpf(k) / 2 / (x + y)
        return 1 / ((x + y) * sqrt(pi))
    return exp(x * x) * erfc(x)


def ierfcx(x):
    with mp.workprec(500):
        y = 1 / sqrt(pi) - x * erfcx(x)
    return +y


def half_line(f, end, count=400):
    """f on [0, end], the grid dense as t = 1/(1 + x/2) is."""
    out = []
    for t in chebyshev_grid(1 / (1 + mpf(end) / 2), 1, count):
        x = 2 / t - 2
        y = f(x)
        out.append((x, y, 1 / y))
    return out


def relative(f, a, b, weight=None, count=300):
    return [(x, f(x), (weight or (lambda x: 1 / f(x)))(x)) for x in chebyshev_grid(a, b, count)]


def erfc_inv(q):
    """x with erfc(x) = q."""
    x = (1 - q) * sqrt(pi) / 2 if q > mpf("0.4") else sqrt(-log(q) - log(-4 * log(q)) / 2)
    for _ in range(60):
        y = erfc(x)
        # Newton in the logarithm, which is nearly a parabola
        step = log(y / q) * y * sqrt(pi) / 2 * exp(x * x)
        x += step
        if abs(step) < abs(x) * mpf(2) ** -130:
            return x
    raise ArithmeticError(q)


def erf_inv_centre(p_end):
    """x/p in w = -ln(1 - p²), p = erf(x) up to p_end."""
    out = []
    for w in chebyshev_grid(0, -log(1 - mpf(p_end) ** 2), 200):
        p = sqrt(-expm1(-w))
        x = erfc_inv(1 - p)
        out.append((w, x / p, p / x))
    return out


def erf_inv_tail(r1, r2, shift):
    """x in r - shift, r = sqrt(-ln erfc(x))."""
    out = []
    for r in chebyshev_grid(r1, r2, 200):
        x = erfc_inv(exp(-r * r))
        out.append((r - mpf(shift), x, 1 / x))
    return out


L = log(mpf(2)) / 2 * mpf("1.0001")
Z = ((sqrt(mpf(2)) - 1) / (sqrt(mpf(2)) + 1)) ** 2 * mpf("1.0001")


def exp_tail(r):
    return (exp(r) - 1 - r) / r**2


def ln_tail(z):  # ln((1+s)/(1-s)) = 2 s + s z P(z), z = s²
    s = sqrt(z)
    return (log((1 + s) / (1 - s)) / s - 2) / z


def ln_tail_pow(z):  # ln((1+s)/(1-s)) / (2 s) = 1 + z/3 + z² P(z)
    s = sqrt(z)
    return (log((1 + s) / (1 - s)) / (2 * s) - 1 - z / 3) / z**2


def sin_tail(z):  # sin(2πr) = r (2π + z P(z)), z = r²
    r = sqrt(z)
    return (sin(2 * pi * r) / r - 2 * pi) / z


def cos_tail(z):  # cos(2πr) = 1 + z P(z)
    return (cos(2 * pi * sqrt(z)) - 1) / z


def sin_of_turn(z):  # sin(2πt) = t P(z), z = t²
    return sin(2 * pi * sqrt(z)) / sqrt(z)


def cos_of_turn(z):  # cos(2πt) = (1 - 16 z) P(z)
    return cos(2 * pi * sqrt(z)) / (1 - 16 * z)


ATAN_END = (sqrt(mpf(2)) - 1) ** 2 * mpf("1.0001")


def atan_tail(z):  # atan(r) = r + r z P(z), z = r²
    r = sqrt(z)
    return (mp.atan(r) / r - 1) / z


def erf_ratio(z):  # erf(x) = x P(z), z = x²
    return erf(sqrt(z)) / sqrt(z)


for scalar in "f32", "f64":
    single = scalar == "f32"
    table("EXP", scalar, "(e^r - 1 - r)/r² in r, |r| ≤ ½ ln 2, relative to e^r - 1",
          lambda: relative(exp_tail, -L, L, lambda r: r**2 / abs(expm1(r))), 4 if single else 9)
    table("LN", scalar, "(ln((1+s)/(1-s))/s - 2)/s² in s², relative to the logarithm",
          lambda: relative(ln_tail, 0, Z, lambda z: z / 2), 2 if single else 6)
    table("LN_WIDE", "f64", "the same for ln_wide",
          lambda: relative(ln_tail, 0, Z, lambda z: z / 2), 3 if single else 6)
    if not single:
        table("LN_POW", scalar, "(ln((1+s)/(1-s))/(2s) - 1 - s²/3)/s⁴ in s², relative to the logarithm",
              lambda: relative(ln_tail_pow, 0, Z, lambda z: z**2), 7)
    table("SIN", scalar, "(sin(2πr)/r - 2π)/r² in r², |r| ≤ 1/8, relative to the sine",
          lambda: relative(sin_tail, 0, mpf(1) / 64, lambda z: z / (2 * pi)), 2 if single else 5)
    table("COS", scalar, "(cos(2πr) - 1)/r² in r², absolute",
          lambda: relative(cos_tail, 0, mpf(1) / 64, lambda z: z), 3 if single else 6)
    table("SIN_OF_TURN", scalar, "sin(2πt)/t in t², |t| ≤ ¼, relative",
          lambda: relative(sin_of_turn, 0, mpf(1) / 16), 4 if single else 8)
    table("ATAN", scalar, "(atan(r)/r - 1)/r² in r², |r| ≤ tan(π/8), relative to the arcus tangent",
          lambda: relative(atan_tail, mpf(10) ** -30, ATAN_END, lambda z: z), 4 if single else 9)
    table("COS_OF_TURN", scalar, "cos(2πt)/(1 - 16t²) in t², relative",
          lambda: relative(cos_of_turn, 0, mpf(1) / 16), 4 if single else 8)
    table("ERF", scalar, "erf(x)/x in x², relative",
          lambda: relative(erf_ratio, 0, mpf("3.93" if single else "5.93") ** 2), *((6, 5) if single else (12, 12)))
    end = 2**14 if single else 2**28
    table("ERFCX", scalar, "erfcx(x) in x up to FAR, relative", lambda: half_line(erfcx, end),
          *((5, 6) if single else (11, 12)))
    table("IERFCX", scalar, "ierfcx(x) in x up to FAR, relative", lambda: half_line(ierfcx, end),
          *((5, 7) if single else (11, 13)))
    # tails: q down to the smallest denormal
    table("ERF_INV_A", scalar, "erf_inv(p)/p in -ln(1 - p²), |p| ≤ 0.9, relative", lambda: erf_inv_centre("0.9001"),
          *((4, 3) if single else (7, 7)))
    if single:
        table("ERF_INV_B", scalar, "erfc_inv(q) in √(-ln q) - 1.5, q ≤ 0.1, relative",
              lambda: erf_inv_tail(mpf("1.517"), mpf("10.2"), "1.5"), 4, 3)
    else:
        table("ERF_INV_B", scalar, "erfc_inv(q) in √(-ln q) - 1.5, 0.1 ≥ q, √(-ln q) ≤ 5, relative",
              lambda: erf_inv_tail(mpf("1.517"), 5, "1.5"), 7, 7)
        table("ERF_INV_C", scalar, "erfc_inv(q) in √(-ln q) - 5, beyond, relative",
              lambda: erf_inv_tail(5, mpf("27.3"), 5), 7, 7)
