#!/usr/bin/env python3
"""The Python package with nothing but a tolerance, beside heyoka and QuTiP at equal measured error.

    python3 -m venv venv && venv/bin/pip install ./python heyoka qutip scipy
    venv/bin/python bench/peers/defaults.py [--only body|rows|kirchhoff|top|spin] [--calls N]

Each way is tuned to the loosest of its tolerances with an error below the goal: the larger of the relative errors of the
momentum and of the attitude at the end. It is then called N times (10), in turns with the others, as a user calls it, with
`backend="auto"`; the figures are the least processor time of a call and its ratio to the peer's, and the wall time of the
very first call of a new system. References are the package's own at a higher order, or DOP853 at 1e-13. Compile times of heyoka
are not counted.
"""
import argparse
import os
import time
import warnings

import coadjoint as ca
import heyoka as hy
import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

TOLERANCES = [10 ** (-k / 2) for k in range(8, 32)]


def attitude(q):
    return Rotation.from_quat((q / np.linalg.norm(q))[[1, 2, 3, 0]]).as_matrix()


def relative(a, b):
    return np.linalg.norm(a - b) / np.linalg.norm(b)


def tuned(run, error, goal, tolerances=TOLERANCES):
    """The loosest tolerance that meets the goal."""
    return next(t for t in tolerances if error(run(t)) <= goal)


def race(name, ways, calls):
    """Calls each way in turns; the last one is the peer."""
    spent = {way: [] for way in ways}
    for _ in range(calls):
        for way, call in ways.items():
            start = time.process_time()
            call()
            spent[way].append(time.process_time() - start)
    *_, peer = ways
    for way, times in spent.items():
        print(f"| {name} | {way} | {min(times) * 1e3:.3f} | {min(times) / min(spent[peer]):.2f} |", flush=True)


def first(make, name, **run):
    """The wall time of the first run of a new system."""
    start = time.perf_counter()
    make().simulate(**run)
    print(f"| {name} | first call | {(time.perf_counter() - start) * 1e3:.0f} | – |")


class Taylor:
    """heyoka's integrators of one system, by their tolerances."""

    def __init__(self, system, start, end):
        self.system, self.start, self.end, self.made = system, np.array(start, float), end, {}

    def __call__(self, tolerance):
        if tolerance not in self.made:
            self.made[tolerance] = hy.taylor_adaptive(self.system, self.start.copy(), tol=tolerance)
        own = self.made[tolerance]
        own.time, own.state[:] = 0.0, self.start
        own.propagate_until(self.end)
        return own.state.copy()


def turning(q, w):
    return [-(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2, (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2,
            (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2, (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


BODY = "x^2/3 + y^2/4 + z^2/5"


def body(calls):
    make = lambda: ca.System("SO3", BODY, coordinates="x y z")
    system, start, end = make(), [2, 0.5, 1], 1000.0
    first(make, "body", momentum=start, time=end, tolerance=1e-9)
    reference = system.simulate(start, time=end, step=0.07, truncation=15, every=10**6)
    error = lambda m, g: max(relative(m, reference.momentum[-1]), relative(g, reference.group_element[-1]))
    v = hy.make_vars(*"xyz", "qw", "qx", "qy", "qz")
    w = [v[0] / 1.5, v[1] / 2, v[2] / 2.5]
    peer = Taylor(list(zip(v, cross(v[:3], w) + turning(v[3:], w))), start + [1, 0, 0, 0], end)
    ours = lambda t, **k: system.simulate(start, time=end, tolerance=t, **k)
    own = tuned(lambda t: ours(t, every=10**9), lambda r: error(r.momentum[-1], r.group_element[-1]), 1e-9)
    its = tuned(peer, lambda y: error(y[:3], attitude(y[3:])), 1e-9)
    race("free body with attitude, T = 1000, 1e-9",
         {"the end": lambda: ours(own, every=10**9), "all records": lambda: ours(own), "heyoka": lambda: peer(its)}, calls)


def rows(calls):
    count, end = 100_000, 10.0
    starts = np.random.default_rng(5).normal([2, 0.5, 1], 0.3, size=(count, 3))
    system = ca.System("SO3", BODY, coordinates="x y z")
    reference = np.asarray(system.ensemble(starts, time=end, step=0.05, truncation=13))
    wide = hy.recommended_simd_size()
    blocks = starts.reshape(-1, wide, 3)
    v = hy.make_vars(*"xyz")
    equations = list(zip(v, cross(v, [v[0] / 1.5, v[1] / 2, v[2] / 2.5])))
    made = {}

    def peer(t, blocks=blocks):
        own = made.setdefault(t, hy.taylor_adaptive_batch(equations, np.zeros((3, wide)), tol=t))
        ends = np.empty_like(blocks)
        for block, found in zip(blocks, ends):
            own.set_time(0.0)
            own.state[:] = block.T
            own.propagate_until(np.full(wide, end))
            found[:] = own.state.T
        return ends.reshape(-1, 3)

    error = lambda found: max(np.linalg.norm(found - reference[:len(found)], axis=1) / np.linalg.norm(reference[:len(found)], axis=1))
    ours = lambda t: np.asarray(system.ensemble(starts, time=end, tolerance=t, threads=1))
    for goal in (1e-6, 1e-9):
        own = tuned(ours, error, goal, [goal * f for f in (30, 10, 3, 1, 0.3, 0.1, 0.03)])
        its = tuned(lambda t: peer(t, blocks[:25]), error, goal)
        race(f"10⁵ free bodies, T = 10, one thread, {goal:g}", {"ensemble": lambda: ours(own), "heyoka": lambda: peer(its)}, calls)


def moving(name, coefficients, linear, start, calls):
    """A body on SE(3) with H = μᵀ A μ/2 + b·μ, T = 100."""
    end, letters = 100.0, "xyzuvw"
    terms = [f"{coefficients[i, j]:.17g}*{a}*{b}/2" for i, a in enumerate(letters) for j, b in enumerate(letters) if coefficients[i, j]]
    text = " + ".join(terms + [f"{b:.17g}*{a}" for a, b in zip(letters, linear) if b])
    make = lambda: ca.System("SE3", text, coordinates=" ".join(letters))
    first(make, name, momentum=start, time=end, tolerance=1e-9, every=10**9)
    system = make()
    v, q, x = hy.make_vars(*letters), hy.make_vars("qw", "qx", "qy", "qz"), hy.make_vars("X", "Y", "Z")
    rate = [sum((float(a) * m for a, m in zip(row, v) if a), hy.expression(float(b))) for row, b in zip(coefficients, linear)]
    w, u, (s, a, b, c) = rate[:3], rate[3:], q
    matrix = [[1 - 2 * (b * b + c * c), 2 * (a * b - s * c), 2 * (a * c + s * b)], [2 * (a * b + s * c), 1 - 2 * (a * a + c * c), 2 * (b * c - s * a)],
              [2 * (a * c - s * b), 2 * (b * c + s * a), 1 - 2 * (a * a + b * b)]]
    turn = [m + f for m, f in zip(cross(v[:3], w), cross(v[3:], u))]
    moved = [sum((row[i] * u[i] for i in range(3)), hy.expression(0.0)) for row in matrix]
    peer = Taylor(list(zip(v + q + x, turn + cross(v[3:], w) + turning(q, w) + moved)), list(start) + [1] + [0] * 6, end)
    place = lambda y: np.block([[attitude(y[6:10]), y[10:, None]], [np.zeros((1, 3)), np.ones((1, 1))]])
    reference = peer(1e-18)
    error = lambda m, g: max(relative(m, reference[:6]), relative(g, place(reference)))
    ours = lambda t: system.simulate(start, time=end, tolerance=t, every=10**9)
    for goal in (1e-6, 1e-9):
        own = tuned(ours, lambda r: error(r.momentum[-1], r.group_element[-1]), goal, [goal * f for f in (30, 10, 3, 1, 0.3, 0.1, 0.03)])
        its = tuned(peer, lambda y: error(y[:6], place(y)), goal)
        run = ours(own)
        race(f"{name}, T = 100, {goal:g} ({run.label}, h = {run.step:.3g})", {"the end": lambda: ours(own), "heyoka": lambda: peer(its)}, calls)


def kirchhoff(calls):
    matrix = np.random.default_rng(0).normal(size=(6, 6))
    moving("Kirchhoff, full tensor", np.round(matrix @ matrix.T / 12 + np.eye(6), 4), [0] * 6, [0.5, -0.3, 0.8, 0.4, 0.2, -0.6], calls)


def top(calls):
    moving("asymmetric heavy top", np.diag([1, 1 / 1.6, 1 / 0.7, 0, 0, 0]), [0, 0, 0, 0.2, 0.4, 1.0], [0.3, -0.2, 1.5, 0.1, 0.6, 0.8], calls)


def spin(calls):
    import qutip as qt
    d, o, w, end = 1.0, 0.3, 1.1, 200.0
    system = ca.System("SU2", "-(D*z + 2*O*cos(w*t)*x)", coordinates="x y z", parameters=dict(D=d, O=o, w=w))
    reference = solve_ivp(lambda t, b: np.cross([2 * o * np.cos(w * t), 0, d], b), (0, end), [0, 0, 1.0],
                          method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    energy = qt.QobjEvo([d / 2 * qt.sigmaz(), [o * qt.sigmax(), "cos(w*t)"]], args=dict(w=w))
    watched = [qt.sigmax(), qt.sigmay(), qt.sigmaz()]

    def peer(t):
        options = dict(rtol=t, atol=t, nsteps=10**7, method="vern9", progress_bar="")
        found = qt.sesolve(energy, qt.basis(2, 0), [0, end], e_ops=watched, options=options)
        return np.array([own[-1] for own in found.expect])

    ours = lambda t: system.simulate([0, 0, 1], time=end, tolerance=t, every=10**9).momentum[-1]
    error = lambda m: max(abs(m - reference))
    ways = {}
    for goal in (1e-6, 1e-9):
        own, its = tuned(ours, error, goal, [goal * f for f in (30, 10, 3, 1, 0.3)]), tuned(peer, error, goal)
        race(f"driven spin, T = 200, {goal:g}", {"the end": lambda: ours(own), "QuTiP vern9": lambda: peer(its)}, calls)
        ways[f"tolerance {own:g}"] = lambda own=own: ours(own)
    race("driven spin, the two in turns, and QuTiP at 1e-9", ways | {"QuTiP vern9": lambda: peer(its)}, calls)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parts = dict(body=body, rows=rows, kirchhoff=kirchhoff, top=top, spin=spin)
    parser.add_argument("--only", choices=parts)
    parser.add_argument("--calls", type=int, default=10)
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    print(f"coadjoint {ca.__version__}, heyoka {hy.__version__}, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}\n")
    print("| system | way | ms | of the peer's |\n|---|---|---|---|")
    for part, run in parts.items():
        if asked.only in (None, part):
            run(asked.calls)
