"""Derivatives of runs."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import coadjoint as ca
from coadjoint import InputError

MOMENTUM = np.array([2, 0.5, 1])
TURN = Rotation.from_rotvec([0.3, -0.2, 0.5])
INERTIA = np.array([1.5, 2, 2.5])


def simulate(momentum: np.ndarray, turn: Rotation, inertia: np.ndarray) -> ca.Run:
    system = ca.System(
        "SO3",
        "x^2/(2*J[0]) + y^2/(2*J[1]) + z^2/(2*J[2])",
        coordinates="x y z",
        parameters={"J": list(inertia)},
    )
    return system.simulate(momentum, group_element=turn, time=10, step=0.1, every=30)


def test_forwards_and_backwards_agree_with_differences() -> None:
    run = simulate(MOMENTUM, TURN, INERTIA)
    change = dict(momentum=[0.5, -1, 0.25], group_element=[1, 0.5, -0.5], parameters={"J": [0.25, 0.5, -1]})
    found = run.jvp(**change)  # type: ignore[arg-type]
    assert found.momentum.shape == found.group_element.shape == (5, 3)

    def at(s: float) -> ca.Run:
        turn = TURN * Rotation.from_rotvec(s * np.array(change["group_element"]))
        return simulate(MOMENTUM + s * np.array(change["momentum"]), turn, INERTIA + s * np.array(change["parameters"]["J"]))

    s = 1e-4
    ahead, behind = at(s), at(-s)
    np.testing.assert_allclose(found.momentum, (ahead.momentum - behind.momentum) / (2 * s), atol=1e-6)
    turned = np.swapaxes(behind.group_element, 1, 2) @ ahead.group_element
    np.testing.assert_allclose(found.group_element, Rotation.from_matrix(turned).as_rotvec() / (2 * s), atol=1e-6)

    weights = np.sin(np.arange(30.0)).reshape(2, 5, 3)
    gradient = run.vjp(momentum=weights[0], group_element=weights[1], parameters=["J"])
    forwards = np.sum(weights[0] * found.momentum) + np.sum(weights[1] * found.group_element)
    backwards = (
        gradient.momentum @ change["momentum"]
        + gradient.group_element @ change["group_element"]
        + gradient.parameters["J"] @ change["parameters"]["J"]
    )
    assert abs(forwards - backwards) < 1e-12 * abs(forwards)


def test_growth_is_that_of_the_middle_axis(body: ca.System) -> None:
    run = body.simulate([0, 2, 0], time=120, step=0.1)
    rate = np.sqrt(0.5 * 0.5 / (1.5 * 2.5))
    assert abs(run.largest_exponent(transient=1100) - rate) < 1e-9
    monodromy = body.simulate([0, 2, 0], time=20, step=0.1).monodromy()
    assert monodromy.shape == (6, 6)
    assert abs(np.abs(np.linalg.eigvals(monodromy)).max() / np.exp(20 * rate) - 1) < 1e-7


def test_mistakes_are_told(body: ca.System) -> None:
    run = body.simulate(MOMENTUM, time=1, step=0.1)
    for wrong in (
        lambda: run.jvp(momentum=[1, 2]),
        lambda: run.jvp(parameters={"I4": 1}),
        lambda: run.jvp(parameters={"I1": [1, 2]}),
        lambda: run.vjp(momentum=[1, 2, 3]),
        lambda: run.largest_exponent(transient=10),
        lambda: body.simulate(MOMENTUM, time=1, step=0.1, at=[0.55]).jvp(momentum=[1, 0, 0]),
    ):
        with pytest.raises(InputError):
            wrong()


def test_parameters_of_potentials_are_differentiated() -> None:
    def falling(w: float) -> ca.Run:
        energy = "sqrt(1 + x^2 + y^2/2 + z^2/3)"
        top = ca.System("SO3", energy, coordinates="x y z", potential="w*g[2][2]", parameters={"w": w})
        return top.simulate(MOMENTUM, time=1, step=0.1)

    run = falling(1)
    assert np.isfinite(run.jvp(momentum=[1, 0, 0]).momentum).all()
    slope = (falling(1.001).momentum[-1] - falling(0.999).momentum[-1]) / 0.002
    assert np.allclose(run.jvp(parameters={"w": 1}).momentum[-1], slope, atol=1e-6)
