#!/usr/bin/env python3
"""The satellite of examples/satellite.toml at T = 20, to 25 digits, by a method the crates do not
share: Taylor series of order 40 in decimal arithmetic of 50 digits, for the equations

    Pi' = Pi x W + 3 n^2 r x I r,  W = I^-1 Pi,  R' = R W^,  r = R^T (cos nt, sin nt, 0),
    l' = -3 n^2 (I r).(R^T (-sin nt, cos nt, 0))

with the time in them; no group, no splitting, no potential. Standard library only.

    python3 tests/reference/satellite.py > tests/reference/satellite.json
"""
import json
from decimal import Decimal as D
from decimal import getcontext

getcontext().prec = 50
I = [D(1), D("1.25"), D("1.5")]
T = D(20)


def dot(x, y, k):
    """Coefficient k of the product of two series."""
    return sum(x[j] * y[k - j] for j in range(k + 1))


def cross(u, v, k):
    return [dot(u[(i + 1) % 3], v[(i + 2) % 3], k) - dot(u[(i + 2) % 3], v[(i + 1) % 3], k)
            for i in range(3)]


def step(state, h, order):
    a, b, c, pi = ([[x] for x in state[3 * i:3 * i + 3]] for i in range(4))
    co, si, l = ([x] for x in state[12:])
    w, r, s, ir = ([[] for _ in range(3)] for _ in range(4))
    for k in range(order):
        for i in range(3):
            w[i].append(pi[i][k] / I[i])
            r[i].append(dot(co, a[i], k) + dot(si, b[i], k))
            s[i].append(dot(co, b[i], k) - dot(si, a[i], k))
            ir[i].append(I[i] * r[i][k])
        gyro, torque = cross(pi, w, k), cross(r, ir, k)
        turned = [cross(row, w, k) for row in (a, b, c)]
        power = sum(dot(ir[i], s[i], k) for i in range(3))
        for i in range(3):
            pi[i].append((gyro[i] + 3 * torque[i]) / (k + 1))
            for row, rate in zip((a, b, c), turned):
                row[i].append(rate[i] / (k + 1))
        co.append(-si[k] / (k + 1))
        si.append(co[k] / (k + 1))
        l.append(-3 * power / (k + 1))
    series = [x for v in (a, b, c, pi) for x in v] + [co, si, l]
    result = []
    for x in series:
        value = D(0)
        for coefficient in reversed(x):
            value = value * h + coefficient
        result.append(value)
    return result


def run(steps, order):
    state = [D(n) / 21 for n in (16, -4, 13, 8, 19, -4, -11, 8, 16)]
    state += [D("0.1"), D("-0.2"), D("1.6"), D(1), D(0), D(0)]
    for _ in range(steps):
        state = step(state, T / steps, order)
    return state


end, again = run(160, 40), run(200, 36)
assert max(abs(x - y) for x, y in zip(end, again)) < D("1e-28")
text = [f"{x:.25f}" for x in end]
print(json.dumps({
    "system": "satellite", "T": "20",
    "momentum": text[9:12] + [text[14]],
    "attitude": [text[0:3], text[3:6], text[6:9]],
    "orbit": text[12:14],
}, indent=1))
