"""Time is a part of the state: every call takes the time that it belongs to."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import coadjoint as ca
from coadjoint import InputError

BODY = "x^2/3 + y^2/4 + z^2/5"
START = [2, 0.5, 1]
TABLE = dict(times=[0, 1, 2, 3, 4, 5], u=[0, 0.4, -0.2, 0.6, 0.2, 0.4])
#: Systems that depend on time in each of the ways that there are.
DRIVEN: list[dict[str, Any]] = [
    dict(hamiltonian=BODY + " + 3*sin(t)*x"),
    dict(hamiltonian=BODY, torque=["sin(t)", "0", "0"]),
    dict(hamiltonian=BODY + " + u*z", inputs=dict(u=np.sin)),
    dict(hamiltonian=BODY + " + u*z", inputs=TABLE),
    dict(hamiltonian=BODY, torque=["u", "0", "-z/5"], inputs=TABLE),
    dict(hamiltonian=BODY + " + 3*sin(t)*x", potential="g[2][2]"),
    dict(hamiltonian=BODY + " + 3*sin(t)*x", damping=0.2),
]


def driven(given: dict[str, Any]) -> ca.System:
    return ca.System("SO3", coordinates="x y z", **given)


@pytest.mark.parametrize("given", DRIVEN, ids=lambda given: str(given)[:60])
def test_a_loop_of_steps_ends_where_a_run_does(given: dict[str, Any]) -> None:
    system = driven(given)
    right = system.simulate(START, time=5, step=0.1)
    mu, g = np.array(START, dtype=float), None
    for n in range(50):
        mu, g = system.step(mu, g, step=0.1, t0=0.1 * n)
    assert np.abs(mu - right.momentum[-1]).max() < 1e-12
    # In one call more than 64 are made piece by piece.
    many = system.step(START, step=0.05, steps=100, t0=0)[0]
    assert np.abs(many - system.simulate(START, time=5, step=0.05).momentum[-1]).max() < 1e-12
    half = system.simulate(START, time=2, step=0.1)
    rest = system.simulate(half.final_momentum, group_element=half.final_group_element, t0=2, time=3, step=0.1)
    assert np.abs(rest.momentum[-1] - right.momentum[-1]).max() < 1e-12
    assert (rest.t0, rest.time[0], rest.time[-1]) == (2, 2, 5)
    row = np.concatenate([half.final_momentum, half.final_group_element.ravel()])[np.newaxis]
    ends = system.ensemble(row, t0=2, time=3, step=0.1)
    assert ends.t0 == 2 and np.abs(ends[0, :3] - right.momentum[-1]).max() < 1e-12
    with pytest.raises(InputError, match="t0 is missing: the system depends on time"):
        system.step(START, step=0.1)


def test_a_system_that_does_not_move_needs_no_time() -> None:
    body = driven(dict(hamiltonian=BODY))
    later = body.step(START, step=0.1, t0=3)[0]
    assert (later == body.step(START, step=0.1)[0]).all()
    assert body.simulate(START, t0=-3, time=1, step=0.1, at=[-2.5, -2]).time.tolist() == [-2.5, -2]
    again = ca.System("SO3", BODY, coordinates="x y z", t0=np.float64(4), momentum=START)
    assert again.simulate(time=1, step=0.1).time[0] == 4 and "t0=4.0" in repr(again)


@pytest.mark.parametrize(
    "given",
    [*DRIVEN[:4], DRIVEN[6], dict(hamiltonian=BODY, damping=0.3), dict(hamiltonian=BODY, damping=0.3, potential="g[2][2]")],
    ids=lambda given: str(given)[:60],
)
def test_the_angular_velocity_is_that_of_the_attitudes(given: dict[str, Any]) -> None:
    system = driven(given)
    middle = system.simulate(START, time=2, step=1e-3, at=[1.999, 2]).angular_velocity.mean(axis=0)
    turn = system.simulate(START, time=2, step=1e-3, at=[1.999, 2]).group_element
    measured = Rotation.from_matrix(turn[0].T @ turn[1]).as_rotvec() / 1e-3
    assert np.abs(middle - measured).max() < 1e-5


def test_derivatives_and_verdicts_are_of_the_time_of_the_run() -> None:
    for given in (DRIVEN[0], DRIVEN[3], DRIVEN[5]):
        system = driven(given)
        run = system.simulate(START, t0=1, time=3, step=0.1)
        found = run.jvp(momentum=[0.5, -1, 0.25]).momentum[-1]
        ends = [
            system.simulate(np.array(START) + s * np.array([0.5, -1, 0.25]), t0=1, time=3, step=0.1).momentum[-1]
            for s in (1e-4, -1e-4)
        ]
        assert np.abs(found - (ends[0] - ends[1]) / 2e-4).max() < 1e-6
    system = driven(DRIVEN[0])
    assert system.verify(system.simulate(START, t0=1, time=1, step=0.1))
    rows = np.array([START])
    ends = system.ensemble(rows, t0=1, time=1, step=0.1)
    assert system.verify(ends, rows)
    ends.t0 = 0
    assert not system.verify(ends, rows)
    assert system.check(t0=3)["symmetric"].holds


def test_messages_say_what_there_is() -> None:
    with pytest.raises(InputError, match=r"steps=1.5: a whole number"):
        driven(dict(hamiltonian=BODY)).step(START, step=0.1, steps=np.float64(1.5))
    with pytest.raises(InputError, match="a rotation or a quaternion is an element of SO3 alone"):
        ca.System("SU2", "mu[0]^2").simulate([1, 0, 0], time=1, step=0.1, group_element=[1, 0, 0, 0])

    def event(t: float, g: Any, mu: Any) -> float:
        raise ZeroDivisionError("at all times")

    with pytest.raises(ca.RunError, match="at all times$") as raised:
        driven(dict(hamiltonian=BODY)).simulate(START, time=1, step=0.1, events=event)
    assert isinstance(raised.value.__cause__, ZeroDivisionError)


def test_functions_that_sympy_has_and_a_system_has_not() -> None:
    sympy = pytest.importorskip("sympy")
    x, y, z, t = sympy.symbols("x y z t")
    for energy, said in [
        (sympy.gamma(t + 1) * z, "a function of the time alone may be an input"),
        (sympy.Heaviside(t - 1) * z, "`sign`, `min` or `max` of the time has a kink"),
        (sympy.Abs(t - 1) * z + x**2, "`abs` of the time has a kink"),
        (sympy.gamma(x + 3), "has a function that is not known here"),
    ]:
        with pytest.raises(InputError, match=said):
            ca.System("SU2", energy, coordinates=[x, y, z]).simulate([0, 0, 1], time=2, step=0.1)
    known = {
        sympy.sech(t) * z + sympy.cosh(x / 4): "z/cosh(t) + cosh(x/4)",
        sympy.atan2(y, x + 9): "atan2(y, x + 9)",
        sympy.Max(-3, sympy.Min(z, 5, 9)) * 0 + sympy.asin(x / 9): "asin(x/9)",
    }
    for energy, text in known.items():
        found, right = (
            ca.System("SU2", either, coordinates="x y z").simulate([0.3, 0.2, 1], time=1, step=0.1).final_momentum for either in (energy, text)
        )
        assert abs(found - right).max() < 1e-13
