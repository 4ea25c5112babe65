#!/usr/bin/env python3
"""Converged end states of the benchmark problems.

Taylor's method of order 40 in 256-bit arithmetic (gmpy2), with the recurrences of automatic differentiation:

    momentum' = momentum x velocity + force x translation,   force' = force x velocity,
    R' = R velocity^,                                        x' = R translation,

velocity = diag(a) momentum, translation = diag(b) force + c. Each problem is run with two step sizes; the figures
kept are those of the finer run, with the gap between the two beside them. `check` holds a shorter run, which the
project's tests compare with end states computed elsewhere by other means.

    pip install gmpy2
    python3 compute.py > end_states.json
"""
import json
import sys

import gmpy2
from gmpy2 import mpfr

gmpy2.get_context().precision = 256
ORDER = 40
DIGITS = 25

KIRCHHOFF = dict(inverse_inertia=("1", "1/2", "1/3"), inverse_mass=("1", "1/2", "1/4"),
                 momentum=("1", "1/2", "1/5"), force=("3/10", "2/5", "1/2"), step="1/4")
KOVALEVSKAYA = dict(inverse_inertia=("1/2", "1/2", "1"), linear=("1", "0", "0"),
                    momentum=("2", "3", "4"), force=("1", "0", "0"), step="1/20")

PROBLEMS = [
    dict(name="free-body-a", inverse_inertia=("2/3", "1/2", "2/5"), momentum=("2", "1/2", "1"), end="1000", step="1/4"),
    dict(name="free-body-b", inverse_inertia=("2/3", "1/2", "2/5"), momentum=("6/5", "5/2", "3/5"), end="1000", step="1/4"),
    dict(name="heavy-top", inverse_inertia=("64/975", "32/15", "64/975"), linear=("0", "2943/20", "0"),
         momentum=("0", "703125/10000", "-703124296875/10000000000"), force=("0", "0", "1"), end="10", step="1/200", check="1"),
    dict(KIRCHHOFF, name="kirchhoff", end="100", check="10"),
    dict(KOVALEVSKAYA, name="kovalevskaya", end="100", check="10"),
    # A quarter of an hour.
    dict(KIRCHHOFF, name="kirchhoff-long", end="1000"),
    dict(KOVALEVSKAYA, name="kovalevskaya-long", end="1000"),
]


def number(text):
    return mpfr(gmpy2.mpq(text))


def vector(problem, key):
    return [number(t) for t in problem.get(key, ("0", "0", "0"))]


def convolve(a, b, k):
    total = mpfr(0)
    for j in range(k + 1):
        total += a[j] * b[k - j]
    return total


def step(state, h, a, b, c):
    """One Taylor step. `state` is momentum (3), force (3), R by rows (9), position (3)."""
    y = [[v] for v in state]
    momentum, force = y[0:3], y[3:6]
    rows = [y[6:9], y[9:12], y[12:15]]
    position = y[15:18]
    moving = any(v != 0 for v in state[3:6])
    velocity = [[a[i] * momentum[i][0]] for i in range(3)]
    translation = [[b[i] * force[i][0] + c[i]] for i in range(3)]

    def cross(u, v, i, k):
        j, l = (i + 1) % 3, (i + 2) % 3
        return convolve(u[j], v[l], k) - convolve(u[l], v[j], k)

    for k in range(ORDER):
        new = []
        for i in range(3):
            new.append(cross(momentum, velocity, i, k) + (cross(force, translation, i, k) if moving else 0))
        for i in range(3):
            new.append(cross(force, velocity, i, k) if moving else mpfr(0))
        for row in rows:
            for i in range(3):
                new.append(cross(row, velocity, i, k))
        for row in rows:
            new.append(sum(convolve(row[i], translation[i], k) for i in range(3)) if moving else mpfr(0))
        for series, value in zip(y, new):
            series.append(value / (k + 1))
        for i in range(3):
            velocity[i].append(a[i] * momentum[i][-1])
            translation[i].append(b[i] * force[i][-1])
    result = []
    for series in y:
        value = mpfr(0)
        for coefficient in reversed(series):
            value = value * h + coefficient
        result.append(value)
    return result


def integrate(problem, end, h):
    a, b, c = vector(problem, "inverse_inertia"), vector(problem, "inverse_mass"), vector(problem, "linear")
    state = vector(problem, "momentum") + vector(problem, "force")
    state += [mpfr(v) for v in (1, 0, 0, 0, 1, 0, 0, 0, 1)] + [mpfr(0)] * 3
    steps = int(gmpy2.mpq(end) / gmpy2.mpq(h))
    for _ in range(steps):
        state = step(state, number(h), a, b, c)
    return state


def quaternion(rows):
    """Unit quaternion (scalar first) of a rotation matrix given by rows, by its largest component."""
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = rows
    squares = [1 + r00 + r11 + r22, 1 + r00 - r11 - r22, 1 - r00 + r11 - r22, 1 - r00 - r11 + r22]
    largest = max(range(4), key=lambda i: squares[i])
    q = [
        [squares[0], r21 - r12, r02 - r20, r10 - r01],
        [r21 - r12, squares[1], r01 + r10, r02 + r20],
        [r02 - r20, r01 + r10, squares[2], r12 + r21],
        [r10 - r01, r02 + r20, r12 + r21, squares[3]],
    ][largest]
    scale = 2 * gmpy2.sqrt(squares[largest])
    return [v / scale for v in q]


def text(value):
    return "{0:.{1}g}".format(value, DIGITS)


def describe(state):
    return dict(
        momentum=[text(v) for v in state[0:3]],
        force=[text(v) for v in state[3:6]],
        quaternion=[text(v) for v in quaternion([state[6:9], state[9:12], state[12:15]])],
        position=[text(v) for v in state[15:18]],
    )


def main():
    records = []
    for problem in PROBLEMS:
        fine = integrate(problem, problem["end"], str(gmpy2.mpq(problem["step"]) / 2))
        coarse = integrate(problem, problem["end"], problem["step"])
        gap = max(abs(u - v) for u, v in zip(fine, coarse))
        print(problem["name"], "gap between step sizes", "{0:.2g}".format(gap), file=sys.stderr)
        record = {k: problem[k] for k in ("name", "inverse_inertia", "inverse_mass", "linear", "momentum", "force", "end") if k in problem}
        record["gap"] = "{0:.2g}".format(gap)
        record["end_state"] = describe(fine)
        if "check" in problem:
            record["check"] = dict(end=problem["check"], state=describe(integrate(problem, problem["check"], problem["step"])))
        records.append(record)
    json.dump(records, sys.stdout, indent=1)
    print()


main()
