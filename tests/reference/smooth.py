#!/usr/bin/env python3
"""End states of examples/*.toml with functions of the momentum, to 20 digits, by a method the crates do not share.

    python -m venv venv && venv/bin/pip install mpmath
    venv/bin/python tests/reference/smooth.py > tests/reference/smooth.json

Solves the equations of motion, written down by hand, by mpmath's Taylor series with 30 digits.
"""
import json

import mpmath
from mpmath import exp, mpf, sqrt

mpmath.mp.dps = 30


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def exponential_spin(_, m):
    a, w, b = mpf(1), mpf("0.3"), mpf("0.25")
    slope = -a * exp(-(1 - m[2] ** 2) / w) * 2 * m[2] / w
    return cross(m, [-b, mpf(0), slope])


def screened_top(_, state):
    inertia = [mpf(1), mpf("1.4"), mpf("0.7")]
    k, d, l, s = mpf(3), mpf("1.5"), mpf("0.6"), mpf(4)
    pi, gamma = state[:3], state[3:]
    omega = [p / i for p, i in zip(pi, inertia)]
    r = sqrt(d**2 + l**2 + 2 * d * l * gamma[2])
    force = k * exp(-r / s) * (1 / (s * r) + 1 / r**2) * d * l / r
    moment = cross(gamma, [mpf(0), mpf(0), force])
    turn = cross(pi, omega)
    return [a + b for a, b in zip(turn, moment)] + cross(gamma, omega)


SYSTEMS = {
    "exponential_spin": (exponential_spin, "0.6 0 0.8", 10),
    "screened_top": (screened_top, "0.5 -0.4 1.1 0.6 0 0.8", 10),
}

found = {}
for name, (field, start, time) in SYSTEMS.items():
    solution = mpmath.odefun(field, 0, [mpf(x) for x in start.split()])
    found[name] = {"time": time, "momentum": [mpmath.nstr(x, 20) for x in solution(time)]}
print(json.dumps(found, indent=1))
