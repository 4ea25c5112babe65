"""Figures for docs/measurements/python.md: `python measure.py [PATH OF THE COMMAND]`.

Each figure is the best of several repetitions, on whatever machine runs it.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import coadjoint as ca

BODY = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z", momentum=[2, 0.5, 1])
START = np.array([2.0, 0.5, 1.0])


def best(work: Callable[[], object], repeat: int = 5) -> float:
    """The least time of several, in seconds."""
    times = []
    for _ in range(repeat):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return min(times)


def single_steps() -> None:
    mu, g = BODY.step(START, step=0.1)
    count = 20_000

    def loop() -> None:
        state = mu, g
        for _ in range(count):
            state = BODY.step(*state, step=0.1)

    print(f"a warm call of one step: {1e6 * best(loop, 3) / count:.1f} µs")


def against_the_command(command: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "body.toml")
        path.write_text(BODY.text)
        many = 2_000_000
        for name, more, settings in [
            ("no records", [], {"every": 10**9}),
            ("a record every 10 steps", ["--every", "10", "--out", str(Path(folder, "out.npy"))], {"every": 10}),
        ]:
            arguments = [command, "simulate", str(path), "--time", str(many * 0.1), "--step", "0.1", *more]
            theirs = best(lambda: subprocess.run(arguments, check=True, capture_output=True), 3)
            ours = best(lambda: BODY.simulate(time=many * 0.1, step=0.1, progress=False, **settings), 3)
            print(f"simulate, 2·10⁶ steps, {name}: Python {ours:.3f} s, command {theirs:.3f} s, ratio {ours / theirs:.2f}")
        states = np.random.default_rng(1).uniform(-1, 1, (100_000, 3))
        np.save(Path(folder, "states.npy"), states)
        arguments = [command, "ensemble", str(path), "--time", "100", "--step", "0.1", "--restart"]
        arguments += ["--initial", str(Path(folder, "states.npy")), "--out", str(Path(folder, "final.npy"))]
        theirs = best(lambda: subprocess.run(arguments, check=True, capture_output=True), 3)
        ours = best(lambda: BODY.ensemble(states, time=100, step=0.1, progress=False), 3)
        print(f"ensemble, 10⁵ rows of 10³ steps: Python {ours:.2f} s, command {theirs:.2f} s, ratio {ours / theirs:.2f}")


def main() -> None:
    single_steps()
    if len(sys.argv) > 1:
        against_the_command(sys.argv[1])


if __name__ == "__main__":
    main()
