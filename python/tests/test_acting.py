"""A velocity and a torque as functions of Python."""

import pickle

import coadjoint as ca
import numpy as np
import pytest

BODY = dict(group="SO3", hamiltonian="x^2/3 + y^2/4 + z^2/5", coordinates="x y z", truncation=7)
INERTIA = np.array([1.5, 2, 2.5])
START = dict(momentum=[0.3, -0.2, 0.9], time=4, step=0.1)


def drag(t, g, mu):
    return -0.1 * mu + g.T @ [0.2 * np.cos(t), 0, 0]


def turn(t, g, mu):
    return np.cross(mu, mu / INERTIA) * 0.05


def test_functions_are_their_formulas() -> None:
    """Right: the same system by its formulas, to rounding."""
    texts = dict(
        torque=[f"-0.1*{own} + 0.2*cos(t)*g[0][{i}]" for i, own in enumerate("xyz")],
        velocity=["0.05*(y*omega[2] - z*omega[1])", "0.05*(z*omega[0] - x*omega[2])", "0.05*(x*omega[1] - y*omega[0])"],
    )
    by_text = ca.System(**BODY, **texts).simulate(**START)
    system = ca.System(**BODY, torque=drag, velocity=turn)
    run = system.simulate(**START)
    assert np.abs(run.momentum - by_text.momentum).max() < 1e-13
    assert np.abs(run.group_element - by_text.group_element).max() < 1e-13
    drift = run.largest_drift
    assert "none" in str(drift.casimirs) and "not conserved" in str(drift.spatial_momentum)
    assert run.estimated_error < 1e-6
    again = pickle.loads(pickle.dumps(system))
    assert again == system and np.array_equal(again.simulate(**START).momentum, run.momentum)


def test_a_velocity_keeps_momentum_and_casimirs() -> None:
    run = ca.System(**BODY, velocity=turn).simulate(**START)
    assert run.largest_drift.spatial_momentum < 1e-13 and run.largest_drift.casimirs < 1e-13
    alone = ca.System("SO3", velocity=lambda t, g, mu: [0, 0, np.cos(t)]).simulate([1, 0, 0], time=2, step=0.1)
    angle = np.sin(2)
    assert np.abs(alone.momentum[-1] - [np.cos(angle), -np.sin(angle), 0]).max() < 1e-12


def test_mistakes_of_functions_are_raised() -> None:
    with pytest.raises(ca.Error, match="the torque has 2 numbers; 3 are needed"):
        ca.System(**BODY, torque=lambda t, g, mu: [0, 0]).simulate(**START)
    with pytest.raises(ca.Error, match="the velocity is NaN"):
        ca.System(**BODY, velocity=lambda t, g, mu: mu * np.nan).simulate(**START)
    with pytest.raises(ca.RunError, match="the torque raised ZeroDivisionError") as raised:
        ca.System(**BODY, torque=lambda t, g, mu: [1 / 0] * 3).simulate(**START)
    assert isinstance(raised.value.__cause__, ZeroDivisionError)
    system = ca.System(**BODY, torque=drag)
    for call in (lambda: system.emit("c"), lambda: system.simulate(**START).jvp(momentum=[1, 0, 0])):
        with pytest.raises(ca.InputError, match="torque"):
            call()


def test_the_work_of_a_torque_is_the_change_of_the_energy() -> None:
    wheel = ca.System("R1", "l^2/2", coordinates="l", torque=["-l/10"])
    run = wheel.simulate([1], time=10, step=0.1)
    assert run.work == pytest.approx((np.exp(-2) - 1) / 2, abs=1e-13)
    assert ca.System("R1", "l^2/2", coordinates="l").simulate([1], time=1, step=0.1).work is None
