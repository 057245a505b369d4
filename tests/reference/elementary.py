#!/usr/bin/env python3
"""Writes tests/reference/elementary.tsv: values of the elementary functions from 50-digit arithmetic (mpmath).

    python3 tests/reference/elementary.py > tests/reference/elementary.tsv

Columns: function, argument, second argument (of pow; else 0), and the value as the sum of two doubles: the
nearest double and what it lacks, so that an error is known to far less than an ulp. All are printed so that
they read back exactly. Half of the arguments are f32 numbers, the others need all digits of a double.
"""
import math
import random

import numpy as np
from mpmath import mp, mpf

mp.dps = 50
rng = random.Random(20240917)


def f32(x):
    return float(np.float32(x))


def around(x, steps=2):
    """x and its neighbours in f32 and in f64."""
    out = [x]
    up = down = np.float32(x)
    dup = ddown = x
    for _ in range(steps):
        up, down = np.nextafter(up, np.float32(np.inf)), np.nextafter(down, np.float32(-np.inf))
        dup, ddown = math.nextafter(dup, math.inf), math.nextafter(ddown, -math.inf)
        out += [float(up), float(down), dup, ddown]
    return [v for v in out if math.isfinite(v)]


def uniform(a, b, count):
    v = [rng.uniform(a, b) for _ in range(count)]
    return [f32(x) if i % 2 == 0 else x for i, x in enumerate(v)]


def logarithmic(a, b, count, signs=False):
    v = [math.exp(rng.uniform(math.log(a), math.log(b))) for _ in range(count)]
    v = [f32(x) if i % 2 == 0 and 1e-45 < x < 3e38 else x for i, x in enumerate(v)]
    return [x * rng.choice((-1, 1)) for x in v] if signs else v


TINY = [f32(2.0**-149), f32(2.0**-140 * 3), f32(2.0**-126), 2.0**-1074, 5 * 2.0**-1070, 2.0**-1022]
SIGNED_TINY = TINY + [-x for x in TINY]


def erfcx(x):
    return mp.exp(x * x) * mp.erfc(x) if x < 30 else erfcx_far(x)


def erfcx_far(x):
    y = mpf(0)
    for k in range(120, 0, -1):
        y = mpf(k) / 2 / (x + y)
    return 1 / ((x + y) * mp.sqrt(mp.pi))


def ierfcx(x):
    if x > mpf(2) ** 40:
        return (1 - 3 / (2 * x * x)) / (2 * mp.sqrt(mp.pi) * x * x)
    with mp.workdps(120):
        y = mpf(0)
        if x < 30:
            return 1 / mp.sqrt(mp.pi) - x * erfcx(x)
        for k in range(120, 0, -1):
            y = mpf(k) / 2 / (x + y)
        # 1/√π - x/(√π (x + y)), y the rest of the continued fraction
        return y / ((x + y) * mp.sqrt(mp.pi))


def erfc_inverse(q):
    """x with erfc x = q, 0 < q < 2."""
    if q > 1:
        return -erfc_inverse(2 - q)
    if q == 1:
        return mpf(0)
    x = (1 - q) * mp.sqrt(mp.pi) / 2 if q > 0.4 else mp.sqrt(-mp.log(q) - mp.log(-4 * mp.log(q)) / 2)
    for _ in range(80):
        y = mp.erfc(x)
        step = mp.log1p((y - q) / q) * y * mp.sqrt(mp.pi) / 2 * mp.exp(x * x)
        x += step
        if abs(step) < abs(x) * mpf(10) ** -45:
            return x
    raise ArithmeticError(q)


def erf_inverse(p):
    with mp.workdps(420 if 0 < abs(p) < 1e-30 else 80):
        return mp.sign(p) * erfc_inverse(1 - abs(p)) if abs(p) > mpf(10) ** -12 else series_erf_inverse(p)


def series_erf_inverse(p):
    y = mp.sqrt(mp.pi) / 2 * p
    return y + y**3 / 3 + 7 * y**5 / 30 + 127 * y**7 / 630


def sin_turns(u):
    with mp.workdps(400):
        return mp.sinpi(2 * u)


def cos_turns(u):
    with mp.workdps(400):
        return mp.cospi(2 * u)


LN2 = math.log(2)
EXP = (uniform(-1, 1, 60) + uniform(-104, 89, 80) + uniform(-745.2, 709.7, 60) + uniform(-745.1, -708, 20)
       + uniform(-103.9, -87, 30) + logarithmic(1e-20, 1, 20, True) + SIGNED_TINY + [0.0, 1.0, -1.0]
       + around(LN2 / 2) + around(-LN2 / 2) + around(88.7) + around(-80.0) + around(709.5)
       + [f32(k * LN2) for k in range(-100, 101, 13)] + [k * LN2 for k in range(-1000, 1001, 130)])
NEAR_1 = [1 + s * 2.0**-k for k in range(1, 53) for s in (1, -1)]
LN = (around(1.0, 4) + NEAR_1 + uniform(0.5, 2, 100) + logarithmic(1e-300, 1e300, 60) + logarithmic(1e-38, 1e38, 60)
      + logarithmic(2.0**-1074, 2.0**-1022, 20) + logarithmic(2.0**-149, 2.0**-126, 20) + TINY
      + around(math.sqrt(0.5)) + around(math.sqrt(2)) + [f32(3.4e38), 1.7976931348623157e308])
ROWS = {
    "exp": (mp.exp, EXP),
    "exp_neg_square": (lambda x: mp.exp(-x * x), uniform(0, 1, 40) + uniform(-10.2, 10.2, 100) + uniform(0, 27.2, 80)
                       + uniform(26.5, 27.2, 20) + uniform(9.3, 10.2, 20) + [0.0, 1.0, 5.0] + TINY[:3]),
    "exp_m1": (mp.expm1, EXP),
    "ln": (mp.log, LN),
    "ln_1p": (mp.log1p, uniform(-0.999, 1, 100) + logarithmic(1e-300, 1, 60, True) + logarithmic(1e-12, 0.5, 100, True)
              + logarithmic(1, 1e300, 40) + logarithmic(1, 1e38, 40) + SIGNED_TINY + [0.0]
              + around(math.sqrt(0.5) - 1) + around(math.sqrt(2) - 1) + around(f32(-0.999999)) + around(-0.5)),
    "sin_turns": (sin_turns, uniform(-1, 1, 100) + uniform(-100, 100, 40) + uniform(-4e6, 4e6, 40)
                  + logarithmic(1e-300, 0.3, 40, True) + [k / 8 for k in range(-16, 17)] + SIGNED_TINY
                  + around(0.125) + around(0.25) + around(0.5) + around(1.0) + around(-0.75)),
    "erf": (mp.erf, uniform(-1, 1, 80) + uniform(-4, 4, 100) + uniform(-6, 6, 60) + logarithmic(1e-300, 1, 40, True)
            + SIGNED_TINY + [0.0, 7.0, -7.0, 100.0] + around(3.93) + around(5.93)),
    "erfc": (mp.erfc, uniform(-1, 1, 80) + uniform(-6, 10, 100) + uniform(0, 27.2, 80) + uniform(26.5, 27.2, 20)
             + logarithmic(1e-300, 1, 20, True) + SIGNED_TINY + [0.0] + uniform(9.1, 10.05, 30)),
    "erfcx": (erfcx, uniform(-1, 1, 60) + uniform(-9.3, 10, 80) + uniform(-26.6, 50, 60)
              + logarithmic(1e-300, 1e300, 40) + logarithmic(1e-6, 1e9, 100) + SIGNED_TINY + [0.0]
              + around(16384.0) + around(2.0**28)),
    "ierfcx": (ierfcx, uniform(0, 1, 60) + uniform(0, 10, 80) + uniform(0, 100, 40) + logarithmic(1e-300, 1e153, 40)
               + logarithmic(1e-6, 1e9, 140) + logarithmic(1e-6, 1e19, 40) + TINY + [0.0]
               + around(16384.0) + around(2.0**28)),
    "erf_inv": (erf_inverse, uniform(-1, 1, 140) + uniform(0.85, 0.95, 40) + logarithmic(1e-300, 1, 60, True)
                + [1 - 2.0**-k for k in range(2, 53)] + SIGNED_TINY + [0.0] + around(0.9) + around(-0.9)),
    "erfc_inv": (erfc_inverse, uniform(1e-6, 2, 140) + uniform(0.05, 0.15, 40) + logarithmic(1e-307, 1, 100)
                 + logarithmic(1.2e-38, 1, 80) + [2 - 2.0**-k for k in range(2, 52)] + around(0.1) + around(1.0)
                 + around(math.exp(-25)) + [2.0**-126, 2.0**-1022]),
}
ROWS["cos_turns"] = (cos_turns, ROWS["sin_turns"][1])


def row(name, x, g, y):
    high = float(y)
    low = float(y - mpf(high)) if math.isfinite(high) else 0.0
    print(f"{name}\t{x!r}\t{g!r}\t{high!r}\t{low!r}")


print("# written by elementary.py: function, argument, second argument, value as a sum of two doubles")
for name, (function, arguments) in ROWS.items():
    for x in dict.fromkeys(arguments):
        row(name, x, 0.0, function(mpf(x)))
for x in uniform(0, 1, 120) + uniform(1, 100, 30) + logarithmic(1e-300, 1e300, 60) + around(1.0) + [0.5, 2.0, 1.5]:
    ln = mp.log(mpf(x)) if x != 1 else mpf(1)
    for span in 5, 87, 700:
        g = float(rng.uniform(-1, 1) * span / ln)
        g = f32(g) if abs(g) < 1e38 else g
        if abs(g * ln) < span:
            row("pow", x, g, mp.power(mpf(x), mpf(g)))
for y, x in ([(0.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (3e38, -3e38), (3e38, 1e-38), (1e300, -1e308)]
             + list(zip(uniform(-1, 1, 400), uniform(-1, 1, 400))) + list(zip(uniform(-5, 5, 300), uniform(0, 3, 300)))
             + list(zip(logarithmic(1e-30, 1e30, 100, True), logarithmic(1e-7, 1e7, 100, True)))
             + [(y, 1.0) for y in around(math.sqrt(2) - 1, 4) + around(1.0, 4)]):
    row("atan2", y, x, mp.atan2(mpf(y), mpf(x)))
EXP2 = (uniform(-1, 1, 60) + uniform(-150, 128, 80) + uniform(-1074, 1024, 60) + uniform(-1074.9, -1022, 20)
        + uniform(-149.9, -126, 30) + logarithmic(1e-20, 1, 20, True) + SIGNED_TINY + [0.0, 1.0, -1.0, -149.0, -1074.0]
        + around(0.5) + around(-0.5) + around(127.5) + around(-80.0))
for name, function, arguments in ("exp2", lambda x: mp.power(2, x), EXP2), ("log2", lambda x: mp.log(x, 2), LN):
    for x in dict.fromkeys(arguments):
        row(name, x, 0.0, function(mpf(x)))
