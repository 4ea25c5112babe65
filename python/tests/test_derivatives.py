"""Derivatives of runs."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm, expm_frechet
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


def test_a_jacobian_has_the_columns_of_its_changes() -> None:
    pulses = dict(times=[0, 3, 6], u=[0.5, -0.25, 0.75], hold="previous")
    hamiltonian, parameters = "x^2/(2*J[0]) + y^2/(2*J[1]) + z^2/5 + u*a*x", {"a": 0.5, "J": [1.5, 2]}
    body = ca.System("SO3", hamiltonian, coordinates="x y z", parameters=parameters, inputs=pulses)
    run = body.simulate(MOMENTUM, time=10, step=0.1, every=20)
    found = run.jacobian(parameters=["J", "a"], inputs="u")
    columns = [
        (found.start, 0, dict(group_element=[1, 0, 0])),
        (found.start, 4, dict(momentum=[0, 1, 0])),
        (found.parameters["J"], 1, dict(parameters={"J": [0, 1]})),
        (found.parameters["a"], (), dict(parameters={"a": 1})),
        (found.inputs["u"], 2, dict(inputs={"u": [0, 0, 1]})),
    ]
    for tangent, at, change in columns:
        for whole, column in zip(tangent, run.jvp(**change), strict=True):  # type: ignore[arg-type]
            np.testing.assert_allclose(whole[(..., at) if at != () else ...], column, atol=1e-13)
    assert np.abs(found.inputs["u"].momentum[-1]).min() > 1e-3
    np.testing.assert_allclose(np.hstack([*found.start[:2]])[-1], run.monodromy(), atol=1e-13)
    assert body.simulate(MOMENTUM, time=1, step=0.1).jacobian().parameters == {}


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


def test_samples_have_the_exact_gradient_of_a_pulse() -> None:
    """The population of a qubit after eight held amplitudes, against Fréchet derivatives of the matrix exponentials."""
    amplitudes = np.array([0.5, -0.7, 0.9, 0.3, -0.2, 0.8, -0.9, 0.4])
    x, z, slot = np.array([[0, 1], [1, 0]], complex), np.diag([1, -1]).astype(complex), 5 / 8
    pulses = dict(times=list(np.arange(8) * slot), u=list(amplitudes), hold="previous")
    qubit = ca.System("SU2", "-2*z - 2*u*x", coordinates="x y z", inputs=pulses)
    gates = [expm(-1j * slot * (z + u * x)) for u in amplitudes]
    slopes = [expm_frechet(-1j * slot * (z + u * x), -1j * slot * x, compute_expm=False) for u in amplitudes]
    whole = np.linalg.multi_dot(gates[::-1])
    right = []
    for k in range(8):
        changed = np.linalg.multi_dot([slopes[k] if j == k else gates[j] for j in range(8)][::-1])
        right.append(2 * (np.conj(whole[0, 0]) * changed[0, 0]).real)
    # Steps that end at the slots, and steps that the slots divide.
    for step in (0.125, 0.3):
        run = qubit.simulate([0, 0, 1], time=5, step=step)
        weights = np.zeros_like(run.momentum)
        weights[-1, 2] = 0.5
        gradient = run.vjp(momentum=weights, inputs=["u"]).inputs["u"]
        assert abs(gradient - right).max() < 1e-13
        assert abs(run.jvp(inputs={"u": amplitudes}).momentum[-1, 2] / 2 - right @ amplitudes) < 1e-13
    for wrong in (dict(inputs=["v"]), dict(inputs=["t"])):
        with pytest.raises(InputError, match="is no input of the system"):
            run.vjp(momentum=weights, **wrong)
    with pytest.raises(InputError, match="8 numbers|8"):
        run.jvp(inputs={"u": [1, 2]})
    called = ca.System("SU2", "-2*z - 2*u*x", coordinates="x y z", inputs=dict(u=np.sin))
    with pytest.raises(InputError, match="is a function, which has no samples"):
        called.simulate([0, 0, 1], time=1, step=0.1).jvp(inputs={"u": [1]})


def test_torques_and_damping_have_derivatives() -> None:
    def vehicle(c: float, start: np.ndarray) -> ca.Run:
        torque = ["-c*omega[0]", "c*g[2][0]*sin(t)", "-z*sqrt(1 + z^2)/5"]
        system = ca.System(
            "SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z", torque=torque, damping=0.1, parameters=dict(c=c)
        )
        return system.simulate(start, time=3, step=0.1)

    run, change = vehicle(0.2, MOMENTUM), np.array([0.5, -1, 0.25])
    found = run.jvp(momentum=change, parameters=dict(c=1)).momentum
    ahead, behind = vehicle(0.2 + 1e-4, MOMENTUM + 1e-4 * change), vehicle(0.2 - 1e-4, MOMENTUM - 1e-4 * change)
    np.testing.assert_allclose(found, (ahead.momentum - behind.momentum) / 2e-4, atol=1e-6)


def test_a_control_loop_keeps_its_state() -> None:
    """A law of attitude and rate every 0.1, its torque held in between, against DOP853."""
    body = ca.System("SO3", "x^2/6 + y^2/4 + z^2/2", coordinates="x y z", torque=["u[0]", "u[1]", "u[2]"], parameters=dict(u=[0, 0, 0]))
    loop = body.stepper([0.3, -0.2, 0.5], step=0.02, parameters=["u"])
    for _ in range(50):
        g, mu = loop.group_element, loop.momentum
        error = np.array([g[2, 1] - g[1, 2], g[0, 2] - g[2, 0], g[1, 0] - g[0, 1]]) / 2
        loop.advance(5, u=-error - 0.8 * mu / [3, 2, 1])
    assert abs(loop.time - 5) < 1e-12
    assert abs(loop.momentum - [-0.17446254, 0.06184369, 0.025306]).max() < 1e-7
    with pytest.raises(InputError, match="advance takes the parameters"):
        loop.advance(1)
    with pytest.raises(InputError, match="has 2 numbers"):
        loop.advance(1, u=[1, 2])
    before = loop.momentum
    with pytest.raises(ca.RunError):
        loop.advance(1, u=[1e9, 0, 0])
    assert (loop.momentum == before).all()


def test_events_that_end_runs_have_derivatives() -> None:
    def low(t: float, g: np.ndarray, mu: np.ndarray) -> float:
        return float(mu[2] - 0.6 + 0.1 * g[0, 0])

    low.terminal = True  # type: ignore[attr-defined]

    def run(start: np.ndarray, c: float) -> ca.Run:
        torque = ["0", "c*g[2][0]", "-z/5"]
        system = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z", torque=torque, parameters=dict(c=c))
        return system.simulate(start, time=20, step=0.05, events=low)

    start, change = np.array([0.2, 0.5, 1.0]), np.array([0.5, -1, 0.25])
    here = run(start, 0.3)
    ahead, behind = run(start + 1e-4 * change, 0.3 + 1e-4), run(start - 1e-4 * change, 0.3 - 1e-4)
    found = here.jvp(momentum=change, parameters=dict(c=1))
    end = len(here) - 1
    assert abs(found.time[end] - (ahead.time[-1] - behind.time[-1]) / 2e-4) < 1e-6 and not found.time[:end].any()
    difference = (ahead.final_momentum - behind.final_momentum) / 2e-4
    np.testing.assert_allclose(found.momentum[end], difference, atol=1e-6)
    weights, times = np.zeros((len(here), 3)), np.zeros(len(here))
    weights[-1], times[-1] = [0.5, 2, -1], 0.75
    gradient = here.vjp(momentum=weights, time=times, parameters=["c"])
    both = gradient.momentum @ change + gradient.parameters["c"]
    assert abs(both - found.momentum[end] @ weights[-1] - 0.75 * found.time[end]) < 1e-11
    whole = here.jacobian(parameters="c")
    sums = [own @ np.array([0, 0, 0, *change]) + by for own, by in zip(whole.start, whole.parameters["c"], strict=True)]
    for own, column in zip(sums, found, strict=True):
        np.testing.assert_allclose(own, column, atol=1e-11)
    assert here.monodromy().shape == (6, 6)
