"""filter_projected.tsv: GGX filtered in projected space, at 50 digits.

    python tests/reference/filter_projected.py    (seconds; deterministic)

The three steps of Tokuyoshi and Kaplanyan 2021, A_p = (A^-1 - I)^-1, A_p' = A_p + 2 Sigma, A' = (A_p'^-1 + I)^-1, for
A = R^T R, Sigma = variance (du^T du + dv^T dv). Inputs are f32 numbers. A' is given by its entries and its determinant,
from which nothing cancels. Where a principal alpha is 1 or more the steps are taken in the other principal direction alone.
"""
import random
import struct
from pathlib import Path
from mpmath import mp, mpf, matrix, eye, inverse, det, sqrt, cos, sin, cholesky, nstr, eigsy

mp.dps = 120


def f32(x):
    return mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def three_steps(a, kernel):
    return inverse(inverse(inverse(inverse(a) - eye(2)) + kernel) + eye(2))


def filtered(a, kernel):
    values, vectors = eigsy(a)
    if values[1] < 1:
        return three_steps(a, kernel)
    if values[0] >= 1:
        return a
    v = vectors[:, 0]
    p = values[0] / (1 - values[0]) + (v.T * kernel * v)[0]
    return a + v * v.T * (p / (1 + p) - values[0])


def rotation(t):
    return matrix([[cos(t), -sin(t)], [sin(t), cos(t)]])


def rows():
    rng = random.Random(2021)
    below_one = [mpf("1e-6"), mpf("1e-3"), mpf("0.05"), mpf("0.5"), mpf("0.9"), 1 - mpf(2) ** -10, 1 - mpf(2) ** -22]
    for count in range(300):
        alphas = [rng.choice(below_one), rng.choice(below_one)]
        if count % 8 == 7:
            alphas[count // 8 % 2] = mpf(rng.choice([1.5, 30, 1000]))
        turn = rotation(mpf(rng.uniform(0, 3)) if count % 3 else 0)
        a = turn * matrix([[alphas[0] ** 2, 0], [0, alphas[1] ** 2]]) * turn.T
        r = cholesky(a).T
        r = matrix([[f32(r[0, 0]), f32(r[0, 1])], [0, f32(r[1, 1])]])
        size = 10 ** rng.uniform(-5, 0.5)
        angle = rng.uniform(0, 6)
        # Long thin, degenerate and round footprints.
        thin = rng.choice([0, 1e-6, 1e-3, 0.3, 1])
        axes = rotation(mpf(angle)) * matrix([[size, 0], [0, size * thin]]) * rotation(mpf(rng.uniform(0, 6))).T
        du, dv = [[f32(axes[0, i]), f32(axes[1, i])] for i in (0, 1)]
        if count >= 240:
            # Along the axes, for the forms that keep the type of the map.
            r[0, 1], du[1], dv[0] = mpf(0), mpf(0), mpf(0)
        elif thin == 0:
            dv = [2 * x for x in du] if count % 2 else [mpf(0), mpf(0)]
        steps = matrix([du, dv])
        variance = f32(rng.choice([0.25, 0.15915494309189535, 0.08333333333333333]))
        result = filtered(r.T * r, 2 * variance * steps.T * steps)
        numbers = [r[0, 0], r[0, 1], r[1, 1], *du, *dv, variance]
        yield [repr(float(x)) for x in numbers] + [
            nstr(x, 25) for x in (result[0, 0], result[0, 1], result[1, 1], det(result))
        ]


lines = ["# " + __doc__.splitlines()[0], "# r11\tr12\tr22\tdu_x\tdu_y\tdv_x\tdv_y\tvariance\txx\txy\tyy\tdeterminant"]
lines += ["\t".join(row) for row in rows()]
Path(__file__).with_suffix(".tsv").write_text("\n".join(lines) + "\n")
