"""Hamiltonians that are no polynomials: as text, as SymPy, and as functions."""

from __future__ import annotations

import pickle
from collections.abc import Callable

import numpy as np
import pytest
import sympy

import coadjoint as ca
from coadjoint import InputError, RunError

INERTIA = np.array([1.5, 2, 2.5])
START = [2, 0.5, 1]
TEXT = "sqrt(1 + x^2/I + y^2/2 + z^2/2.5)"


def energy(t: float, mu: np.ndarray) -> float:
    return float(np.sqrt(1 + mu @ (mu / INERTIA)))


def gradient(t: float, mu: np.ndarray) -> np.ndarray:
    return mu / INERTIA / energy(t, mu)


@pytest.fixture
def text() -> ca.System:
    return ca.System("SO3", TEXT, coordinates="x y z", parameters={"I": 1.5})


@pytest.fixture
def functions() -> ca.System:
    return ca.System("SO3", energy, gradient=gradient, coordinates="x y z")


def test_text_sympy_and_functions_are_one_system(text: ca.System, functions: ca.System) -> None:
    x, y, z = sympy.symbols("x y z")
    third = ca.System("SO3", sympy.sqrt(1 + x**2 / 1.5 + y**2 / 2 + z**2 / 2.5), coordinates=[x, y, z])
    systems = [text, functions, third, pickle.loads(pickle.dumps(functions))]
    runs = [system.simulate(START, time=20, step=0.2) for system in systems]
    for run in runs:
        assert np.abs(run.momentum[-1] - runs[0].momentum[-1]).max() < 1e-13
        assert run.largest_drift.spatial_momentum < 1e-13 and run.largest_drift.energy < 1e-12
        assert run.label == "collocation, 4 nodes"
    assert text.chart is None and functions.check() and text.check()
    assert abs(float(text.hamiltonian.subs({x: 2, y: 0.5, z: 1})) - energy(0, np.array(START))) < 1e-15
    rows = np.array([START, [1, 0.2, 0.3]])
    ends = [system.ensemble(rows, time=20, step=0.2) for system in systems[:2]]
    assert np.abs(ends[0] - ends[1]).max() < 1e-13
    assert np.abs(ends[0][0] - runs[0].momentum[-1]).max() < 1e-13
    mu, g = functions.step(START, step=0.2, steps=100)
    assert np.abs(mu - runs[0].momentum[-1]).max() < 1e-12
    assert np.abs(g @ mu - START).max() < 1e-13
    assert text.simulate(START, time=20, tolerance=1e-8).estimated_error < 1e-8


def test_rows_have_parameters_of_their_own(text: ca.System) -> None:
    found = text.ensemble({"x": [2, 2], "y": [0.5, 0.5], "z": [1, 1], "I": [1.5, 3]}, time=5, step=0.1)
    other = ca.System("SO3", TEXT, coordinates="x y z", parameters={"I": 3})
    assert np.abs(found[1] - other.simulate(START, time=5, step=0.1).momentum[-1]).max() < 1e-13
    assert np.abs(found[0] - found[1]).max() > 0.1


def test_a_polynomial_by_either_method() -> None:
    body = dict(coordinates="x y z", truncation=11)
    series, nodes = (ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", method=m, **body) for m in ("series", "collocation"))
    ends = [system.simulate(START, time=10, step=0.1).momentum[-1] for system in (series, nodes)]
    assert np.abs(ends[0] - ends[1]).max() < 1e-12
    with pytest.raises(InputError, match="no series"):
        nodes.series(1)
    with pytest.raises(InputError, match="polynomial"):
        ca.System("SO3", TEXT, coordinates="x y z", parameters={"I": 1}, method="series")


def test_functions_that_fail_are_told_with_the_time() -> None:
    def raising(t: float, mu: np.ndarray) -> np.ndarray:
        if t > 3:
            raise ZeroDivisionError("at last")
        return gradient(t, mu)

    with pytest.raises(RunError, match="the gradient raised ZeroDivisionError: at last") as caught:
        ca.System("SO3", energy, gradient=raising).simulate(START, time=20, step=0.2)
    assert caught.value.time is not None and caught.value.time > 0
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
    for wrong, message in [
        (lambda t, mu: gradient(t, mu) * [1, 1, 1.01], "not that of the energy"),
        (lambda t, mu: gradient(t, mu)[:2], "has 2 numbers; 3 are needed"),
        (lambda t, mu: gradient(t, mu) * np.nan, "the gradient is NaN"),
        (lambda t, mu: "one", "the gradient raised"),
    ]:
        with pytest.raises(RunError, match=message):
            ca.System("SO3", energy, gradient=wrong).simulate(START, time=20, step=0.2)
        with pytest.raises(RunError, match=message):
            ca.System("SO3", energy, gradient=wrong).step(START, step=0.2)
    with pytest.raises(RunError, match="depends on the time"):
        moving = ca.System("SO3", lambda t, mu: energy(t, mu) + t, gradient=gradient)
        moving.simulate(START, time=20, step=0.2)


def test_what_functions_have_not_is_refused(functions: ca.System) -> None:
    with pytest.raises(InputError, match="needs its gradient"):
        ca.System("SO3", energy)
    with pytest.raises(InputError, match="gradient is a function"):
        ca.System("SO3", "x^2", coordinates="x y z", gradient=gradient)
    with pytest.raises(InputError, match="no series"):
        ca.System("SO3", energy, gradient=gradient, method="series")
    with pytest.raises(InputError, match="has its own"):
        ca.System("SO3", energy, gradient=gradient, parameters={"a": 1})
    for ask in (lambda: functions.emit("rust"), lambda: functions.hamiltonian, lambda: functions.identity):
        with pytest.raises(InputError):
            ask()


def test_inputs_are_arrays() -> None:
    times = np.linspace(0, 4, 9)
    system = ca.System(
        "SO3", "z^2 + u*z", coordinates="x y z", inputs={"times": times, "u": 1 + times}, step=0.1, momentum=START, time=4
    )
    # z is kept, and μ turns backwards about it by the integral of 2z + u.
    angle = 2 * 4 + 4 + 8
    cosine, sine = np.cos(angle), np.sin(angle)
    expected = [2 * cosine + 0.5 * sine, 0.5 * cosine - 2 * sine, 1]
    assert np.abs(system.simulate().momentum[-1] - expected).max() < 1e-12
    with pytest.raises(InputError, match="the input `u` goes from time 0 to 4"):
        system.simulate(time=5)


def test_damping_is_a_number_or_one_for_each_coordinate() -> None:
    body = {"coordinates": "x y z", "step": 0.1, "momentum": START, "time": 5}
    runs = [ca.System("SO3", "x^2/2 + y^2/4 + z^2/6", damping=own, **body).simulate() for own in ("1/10", [0.1, 0.1, 0.1])]
    assert (runs[0].momentum == runs[1].momentum).all()
    assert (np.diff(runs[0].energy) < 0).all()
    assert runs[0].largest_drift.spatial_momentum < 1e-13
    with pytest.raises(TypeError, match="damping acts"):
        bool(runs[0].largest_drift.energy < 1)
    with pytest.raises(InputError, match="must not be negative"):
        ca.System("SO3", "x^2/2 + y^2/4", damping=-1, **body)


def test_inputs_are_functions() -> None:
    def system(u: Callable[[float], float]) -> ca.System:
        given = dict(coordinates="x y z", step=0.1, momentum=START, time=4)
        return ca.System("SO3", "z^2 + u*z", inputs={"u": u}, **given)

    followed = system(lambda t: 1 + t)
    run = followed.simulate()
    angle = 2 * 4 + 4 + 8
    cosine, sine = np.cos(angle), np.sin(angle)
    assert np.abs(run.momentum[-1] - [2 * cosine + 0.5 * sine, 0.5 * cosine - 2 * sine, 1]).max() < 1e-12
    assert np.abs(followed.ensemble([START])[0] - run.momentum[-1]).max() < 1e-12
    assert run.jvp(momentum=[0, 0, 1]).momentum.shape == run.momentum.shape
    with pytest.raises(RunError, match="the input u is NaN, at time 2"):
        system(lambda t: 1 if t < 2 else np.nan).simulate()
    with pytest.raises(RunError, match="the input u raised ZeroDivisionError: division by zero, at time 0") as raised:
        system(lambda t: 1 / 0).simulate()
    assert isinstance(raised.value.__cause__, ZeroDivisionError)
    with pytest.raises(InputError, match="function u as an input has no hash"):
        followed.identity


def test_torques_are_lists_of_expressions() -> None:
    x, y, z, c = sympy.symbols("x y z c")
    system = ca.System(
        "SO3", "(x^2 + y^2 + z^2)/4", coordinates="x y z", torque=[-c * x, "-c*y", -c * z], parameters={"c": 0.3},
        step=0.1, momentum=START, time=2,
    )
    run = system.simulate()
    assert np.abs(run.momentum[-1] - np.exp(-0.6) * np.array(START)).max() < 1e-13
    with pytest.raises(TypeError, match="a torque acts"):
        bool(run.largest_drift.energy < 1)


def test_velocities_move_states_along_their_orbits() -> None:
    x, y, z, t = sympy.symbols("x y z t")
    turning = ca.System("SO3", velocity=["0", "0", sympy.cos(t)], coordinates="x y z", momentum=START, time=2)
    run = turning.simulate(tolerance=1e-10)
    angle = np.sin(run.time)
    plane = START[0] + 1j * START[1]
    assert np.abs(run.momentum @ [1, 1j, 0] - plane * np.exp(-1j * angle)).max() < 1e-9
    assert np.abs(run.angular_velocity[:, 2] - np.cos(run.time)).max() < 1e-14
    assert run.largest_drift.spatial_momentum < 1e-13
    body = ca.System("SO3", x**2 / 2 + y**2 / 4 + z**2 / 6, coordinates="x y z", damping=0.2)
    same = ca.System(
        "SO3", x**2 / 2 + y**2 / 4 + z**2 / 6, coordinates="x y z",
        velocity=["(y*omega[2] - z*omega[1])/5", "(z*omega[0] - x*omega[2])/5", "(x*omega[1] - y*omega[0])/5"],
    )
    ends = [own.simulate(START, time=5, step=0.1).momentum[-1] for own in (body, same)]
    assert np.abs(ends[0] - ends[1]).max() < 1e-14
