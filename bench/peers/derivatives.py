#!/usr/bin/env python3
"""Derivatives of runs in Python: their time a step, and how many runs they take.

    python3 -m venv venv && venv/bin/pip install ./python
    venv/bin/python bench/peers/derivatives.py [--steps N]

Each call is made some times first, until it runs machine code; the figures are the least wall times of some more.
"""
import argparse
import time

import coadjoint as ca
import numpy as np

SYSTEMS = {
    "free body": ("SO3", "x^2/(2*J[0]) + y^2/(2*J[1]) + z^2/(2*J[2]) + c*x", "x y z", [1, 0.5, 2.0]),
    "heavy top": ("SE3", "x^2/(2*J[0]) + y^2/(2*J[1]) + z^2/(2*J[2]) + c*w", "x y z u v w", [0.3, 0.2, 2.0, 0.1, 0.2, 0.9]),
    "a root": ("SO3", "sqrt(1 + x^2/J[0] + y^2/J[1] + z^2/J[2] + c*x*y)", "x y z", [1, 0.5, 2.0]),
}


def least(call, calls=10):
    times = []
    for _ in range(calls):
        begun = time.perf_counter()
        call()
        times.append(time.perf_counter() - begun)
    return min(times)


def ready(call):
    for _ in range(12):
        call()
    time.sleep(1)
    for _ in range(3):
        call()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=4000)
    steps = parser.parse_args().steps
    for name, (group, hamiltonian, coordinates, momentum) in SYSTEMS.items():
        parameters = {"J": [1.5, 2, 2.5], "c": 0.1}
        system = ca.System(group, hamiltonian, coordinates=coordinates, parameters=parameters)

        def simulate():
            return system.simulate(momentum, time=steps * 0.05, step=0.05, every=steps, estimate=False)

        run = simulate()
        weights = np.zeros(np.shape(run.momentum))
        weights[-1] = 1
        calls = {
            "run": simulate,
            "jvp, one change": lambda: run.jvp(parameters={"J": [1, 0, 0]}),
            "vjp": lambda: run.vjp(momentum=weights, parameters=["J", "c"]),
            "largest exponent": run.largest_exponent,
            "monodromy": run.monodromy,
        }
        for call in calls.values():
            ready(call)
        found = {what: least(call) for what, call in calls.items()}
        for what, taken in found.items():
            print(f"{name}, {what}: {taken / steps * 1e6:.2f} µs a step, {taken / found['run']:.1f} runs", flush=True)


if __name__ == "__main__":
    main()
