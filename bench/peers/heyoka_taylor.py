#!/usr/bin/env python3
"""heyoka (Taylor's method, compiled at run time) on the benchmark's problems, as rows of the same table.

    python3 -m venv venv && venv/bin/pip install heyoka numpy
    venv/bin/python bench/peers/heyoka_taylor.py [--problem NAME] [--rounds N] [--ensemble wide|near]

Equations, initial states and references come from ../reference/end_states.json: y = (momentum, force, quaternion,
position), the free bodies without force and position. An error is the largest difference of a component of the end
state, twice that for the quaternion (the Rust program compares rotation matrices), and momenta and positions of the heavy top in units of 100.
Runs are interleaved over the tolerances; the figures are medians. `--ensemble` runs 4096 free bodies, with norms from 1.5
to 3 or near one start, by the package coadjoint with `tolerance=1e-10` and nothing else, and in heyoka's batch mode at
tolerances around it, with batches of 8: the least processor time of interleaved rounds, in which both have compiled
before. Compile times of heyoka are not counted.
"""
import argparse
import json
import math
import pathlib
import statistics
import time
from fractions import Fraction

import heyoka
import numpy

TARGETS = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12]
FILE = pathlib.Path(__file__).parent.parent / "reference" / "end_states.json"


class Problem:
    def __init__(self, record):
        vector = lambda key: [float(Fraction(t)) for t in record.get(key, ("0", "0", "0"))]
        self.name, self.end = record["name"], float(record["end"])
        self.a, self.b, self.c = vector("inverse_inertia"), vector("inverse_mass"), vector("linear")
        self.moving = "force" in record
        self.scale = 100.0 if self.name == "heavy-top" else 1.0
        end = record["end_state"]
        figures = lambda key: [float(t) for t in end[key]]
        identity = [1.0, 0.0, 0.0, 0.0]
        if self.moving:
            self.initial = vector("momentum") + vector("force") + identity + [0.0] * 3
            self.reference = figures("momentum") + figures("force") + figures("quaternion") + figures("position")
            units = [1 / self.scale] * 3 + [1.0] * 3 + [2.0] * 4 + [1 / self.scale] * 3
        else:
            self.initial = vector("momentum") + identity
            self.reference = figures("momentum") + figures("quaternion")
            units = [1.0] * 3 + [2.0] * 4
        self.initial, self.reference = numpy.array(self.initial), numpy.array(self.reference)
        self.units = numpy.array(units)

    def error(self, state):
        opposite = self.reference.copy()
        start = 6 if self.moving else 3
        opposite[start:start + 4] *= -1
        return min(float(numpy.max(numpy.abs(state - r) * self.units)) for r in (self.reference, opposite))

    def rates(self, y):
        """The right-hand side, for numbers and for heyoka's expressions; vanishing terms are left out."""
        a, b, c = self.a, self.b, self.c
        m = y[0:3]
        w = [a[i] * m[i] for i in range(3)]
        cross = lambda u, v: [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        turn = [(a[2] - a[1]) * m[1] * m[2], (a[0] - a[2]) * m[2] * m[0], (a[1] - a[0]) * m[0] * m[1]]
        q = y[6:10] if self.moving else y[3:7]
        attitude = [
            -0.5 * (q[1] * w[0] + q[2] * w[1] + q[3] * w[2]),
            0.5 * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]),
            0.5 * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]),
            0.5 * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]),
        ]
        if not self.moving:
            return turn + attitude
        f = y[3:6]
        s, x, yy, z = q
        columns = [
            [1 - 2 * (yy * yy + z * z), 2 * (x * yy + s * z), 2 * (x * z - s * yy)],
            [2 * (x * yy - s * z), 1 - 2 * (x * x + z * z), 2 * (yy * z + s * x)],
            [2 * (x * z + s * yy), 2 * (yy * z - s * x), 1 - 2 * (x * x + yy * yy)],
        ]
        if any(b):
            v = [b[i] * f[i] for i in range(3)]
            torque = [(b[2] - b[1]) * f[1] * f[2], (b[0] - b[2]) * f[2] * f[0], (b[1] - b[0]) * f[0] * f[1]]
            moved = [sum(columns[i][row] * v[i] for i in range(3)) for row in range(3)]
        else:
            axis = next(i for i in range(3) if c[i])
            following, last, weight = (axis + 1) % 3, (axis + 2) % 3, c[axis]
            torque = [0, 0, 0]
            torque[following], torque[last] = weight * f[last], -weight * f[following]
            moved = [weight * columns[axis][row] for row in range(3)]
        return [turn[i] + torque[i] for i in range(3)] + cross(f, w) + attitude + moved


def heyoka_system(problem):
    names = heyoka.make_vars(*[f"y{i}" for i in range(len(problem.initial))])
    return list(zip(names, problem.rates(list(names))))


def heyoka_runs(problem):
    """(tolerance, function that returns the end state) for the scalar integrator."""
    system = heyoka_system(problem)
    for k in range(8, 33):
        tolerance = 10 ** (-k / 2)
        integrator = heyoka.taylor_adaptive(system, problem.initial, tol=tolerance, high_accuracy=False)

        def run(integrator=integrator):
            integrator.time = 0.0
            integrator.state[:] = problem.initial
            integrator.propagate_until(problem.end)
            return integrator.state.copy()

        yield tolerance, run


def measure(problem, runs, rounds):
    """[(error, nanoseconds per unit of time, tolerance)], timed round robin."""
    candidates = [(tolerance, run, problem.error(run())) for tolerance, run in runs]
    times = [[] for _ in candidates]
    for _ in range(rounds):
        for samples, (_, run, _) in zip(times, candidates):
            start = time.perf_counter_ns()
            run()
            samples.append(time.perf_counter_ns() - start)
    return [(error, statistics.median(s) / problem.end, tolerance) for (tolerance, _, error), s in zip(candidates, times)]


def row(name, rows):
    cells = []
    for target in TARGETS:
        costs = [cost for error, cost, _ in rows if error <= target]
        cells.append(f"{min(costs):.0f}" if costs else "–")
    print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


def batches(system, initial, end, batch=8):
    """A function of a tolerance that makes one from the initial states to those at the end."""
    first = numpy.ascontiguousarray(initial[:batch].T)

    def of(tolerance):
        integrator = heyoka.taylor_adaptive_batch(system, first.copy(), tol=tolerance)

        def run():
            ends = numpy.empty_like(initial)
            for row in range(0, len(initial), batch):
                integrator.set_time(0.0)
                integrator.state[:] = initial[row:row + batch].T
                integrator.propagate_until(end)
                ends[row:row + batch] = integrator.state.T
            return ends

        return run

    return of


def ensemble(problem, rounds, wide, end=100.0, count=4096):
    import coadjoint

    random = numpy.random.default_rng(1)
    momenta = random.normal([2, 0.5, 1], 0.1, size=(count, 3))
    if wide:
        directions = random.normal(size=(count, 3))
        momenta = directions / numpy.linalg.norm(directions, axis=1, keepdims=True) * random.uniform(1.5, 3, (count, 1))
    initial = numpy.hstack([momenta, numpy.tile([1.0, 0.0, 0.0, 0.0], (count, 1))])
    a, b, c = problem.a
    body = coadjoint.System("SO3", f"{a / 2}*x^2 + {b / 2}*y^2 + {c / 2}*z^2", coordinates="x y z")
    of = batches(heyoka_system(problem), initial, end)
    runs = {"coadjoint, tolerance=1e-10": lambda: body.ensemble(initial, time=end, tolerance=1e-10, threads=1)}
    runs |= {f"heyoka, {tolerance:.0e}": of(tolerance) for tolerance in (1e-9, 1e-10, 1e-11, 1e-12)}
    reference, found = of(1e-17)(), {name: (math.inf, 0.0) for name in runs}
    for _ in range(rounds):
        for name, run in runs.items():
            begun = time.process_time()
            ends = numpy.asarray(run())
            took = (time.process_time() - begun) * 1e9 / (count * end)
            ends[:, 3:] *= numpy.sign((ends[:, 3:] * reference[:, 3:]).sum(axis=1))[:, None]
            error = (numpy.abs(ends - reference) * problem.units).max()
            found[name] = min(found[name], (took, error))
    (took, error), *others = found.values()
    costs = sorted((numpy.log(other), cost) for cost, other in others)
    same = numpy.interp(numpy.log(error), *zip(*costs))
    print(f"\n{count} free bodies {'of norms from 1.5 to 3' if wide else 'near one start'}, T = {end:g}, one core\n")
    print("| | largest error | ns per trajectory and unit of time |\n|---|---:|---:|")
    for name, (cost, error) in found.items():
        print(f"| {name} | {error:.1e} | {cost:.0f} |")
    print(f"\nheyoka takes {same:.0f} ns at the error of coadjoint, whose time is {took / same:.2f} of that.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--problem", action="append", help="only this problem; may be repeated")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--ensemble", choices=("wide", "near"), help="heyoka's batches beside coadjoint with a tolerance alone")
    arguments = parser.parse_args()
    problems = [Problem(record) for record in json.loads(FILE.read_text())]
    if arguments.ensemble:
        ensemble(problems[0], arguments.rounds, arguments.ensemble == "wide")
        return
    for problem in problems:
        if arguments.problem and problem.name not in arguments.problem:
            continue
        print(f"\n## {problem.name}, T = {problem.end:g} (heyoka {heyoka.__version__}, SIMD {heyoka.recommended_simd_size()})\n")
        print("| method | " + " | ".join(f"{t:.0e}" for t in TARGETS) + " |\n|---|" + "---:|" * len(TARGETS))
        row("heyoka (scalar)", measure(problem, heyoka_runs(problem), arguments.rounds))


main()
