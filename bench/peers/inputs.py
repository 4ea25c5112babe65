#!/usr/bin/env python3
"""Inputs and damping in Python: gradients in the samples of inputs beside the runs, control loops, and damping beside none.

    python3 -m venv venv && venv/bin/pip install ./python
    venv/bin/python bench/peers/inputs.py

Each call is made some times first, until it runs machine code; the figures are the least wall times of some more.
"""
import math

import coadjoint as ca
import numpy as np

from derivatives import least, ready


def gradient(name, group, hamiltonian, momentum, slots, length, step, inputs="u"):
    """A run with held inputs, and the gradient of a number at its end in all their samples."""
    random = np.random.default_rng(1)
    samples = {key: list(random.normal(size=slots) / 2) for key in inputs.split()}
    held = dict(times=list(np.arange(slots) * length), hold="previous", **samples)
    system = ca.System(group, hamiltonian, inputs=held)

    def simulate():
        return system.simulate(momentum, time=slots * length, step=step, estimate=False)

    run = simulate()
    weights = np.zeros(np.shape(run.momentum))
    weights[-1, 2] = 0.5

    def backward():
        return run.vjp(momentum=weights, inputs=inputs.split())

    ready(simulate)
    ready(backward)
    alone, whole, steps = least(simulate), least(backward), slots * length / step
    print(f"{name}: {alone / steps * 1e6:.2f} µs a step, gradient {whole / alone:.1f} runs", flush=True)


def control():
    """Samples of a control loop."""
    torque = ["u - c*omega[0]", "-c*omega[1]", "-c*omega[2]"]
    parameters = {"u": 0.1, "c": 0.05}
    body = ca.System("SO3", "x^2/2 + y^2/4 + z^2/6", coordinates="x y z", torque=torque, parameters=parameters)
    loop = body.stepper([0.3, -0.2, 0.5], step=0.02, parameters=["u"])
    taken = {}
    for steps in (1, 100):

        def samples():
            for k in range(200):
                loop.advance(steps, u=0.1 * math.sin(k))

        ready(samples)
        taken[steps] = least(samples) / 200 * 1e6
    each = (taken[100] - taken[1]) / 99
    print(f"control loop: {taken[1] - each:.1f} µs a sample beyond the steps, {each:.2f} µs a step", flush=True)


def damping(name, group, hamiltonian, momentum, duration, backend):
    """The time of a damped step over that of the same step without damping."""
    alone, damped = (ca.System(group, hamiltonian, damping=rate) for rate in (None, 0.02))

    def run(system):
        return system.simulate(momentum, time=duration, step=0.1, every=round(duration / 0.1), estimate=False, backend=backend)

    for system in (alone, damped):
        run(system)
    first, second = (least(lambda: run(system), 5) for system in (alone, damped))
    print(f"damping, {name}, {backend}: {second / first:.2f} of the step without", flush=True)


def main():
    qubit = "-2*mu[2] - 2*u*mu[0]"
    gradient("a qubit, 8 amplitudes, 40 steps", "SU2", qubit, [0, 0, 1], 8, 0.625, 0.125)
    gradient("a qubit, 8 amplitudes, 4000 steps", "SU2", qubit, [0, 0, 1], 8, 62.5, 0.125)
    gradient("a qubit, 200 slots, 400 steps", "SU2", qubit, [0, 0, 1], 200, 0.25, 0.125)
    two = "mu[0] + 0.7*mu[5] + 0.3*mu[14] + u*mu[3] + v*mu[9]"
    start = np.zeros(15)
    start[[0, 4, 10]] = 1, 0.3, 0.5
    gradient("two qubits, 200 slots of two inputs, 400 steps", "SU4", two, start, 200, 0.25, 0.125, "u v")
    control()
    root = "sqrt(1 + mu[0]^2 + mu[1]^2/2 + mu[2]^2/3 + mu[3]^2/2 + mu[4]^2/3 + mu[5]^2/4)"
    damping("a root on SE(3)", "SE3", root, [0.4, 0.3, 0.9, 0.2, 0.5, -0.3], 3000, "c")
    sites = 256
    pairs = ((3 * i, 3 * ((i + 1) % sites)) for i in range(sites))
    ring = "+".join(f"sqrt(2 + {'+'.join(f'mu[{a + k}]*mu[{b + k}]/4' for k in range(3))})" for a, b in pairs)
    spins = np.random.default_rng(0).normal(size=(sites, 3))
    spins /= np.linalg.norm(spins, axis=1)[:, None]
    damping(f"a ring of {sites} sites", f"SO3^{sites}", ring, spins.ravel(), 20, "interpreter")


if __name__ == "__main__":
    main()
