"""How long it takes to choose truncation, step and frame for a tolerance: the first call of a new system, the same call again, and
one with another tolerance. Milliseconds on the clock, the least of five systems made anew.

    python3 bench/peers/choosing.py
"""

import time
import warnings

import coadjoint as ca

warnings.simplefilter("ignore")

BODY = {"group": "SO3", "coordinates": list("xyz"), "hamiltonian": "x^2/3 + y^2/4 + z^2/5"}
ROOT = BODY | {"hamiltonian": "sqrt(1 + x^2/3 + y^2/4 + z^2/5)"}
FLUID = {
    "group": "SE3",
    "coordinates": list("abcdef"),
    "hamiltonian": "a^2/2 + b^2/4 + c^2/6 + d^2/2 + e^2/4 + f^2/8 + a*d/10",
}
STARTS = {3: [0.5, -0.3, 1.2], 6: [0.5, -0.3, 1.2, 0.1, 0.2, 0.9]}


def call(system: ca.System, tolerance: float) -> float:
    momentum = STARTS[len(system.coordinates)]
    begun = time.perf_counter()
    system.simulate(momentum=momentum, time=100.0, tolerance=tolerance)
    return 1e3 * (time.perf_counter() - begun)


def calls(text: dict[str, object], tolerance: float) -> list[float]:
    system = ca.System(**text)
    return [call(system, tolerance), call(system, tolerance), call(system, 0.5 * tolerance)]


print("| system | tolerance | first call | again | half the tolerance |\n|---|---|---|---|---|")
for name, text in (("rigid body", BODY), ("Kirchhoff", FLUID), ("√ body", ROOT)):
    for tolerance in (1e-6, 1e-9, 1e-12):
        rows = [calls(text, tolerance) for _ in range(5)]
        print(f"| {name} | {tolerance:g} | " + " | ".join(f"{min(row):.1f}" for row in zip(*rows)) + " |")
