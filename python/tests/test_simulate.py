"""Trajectories: their arrays, their accuracy, and the settings of runs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import coadjoint as ca
from coadjoint import InputError, RunError

START = [2, 0.5, 1]


def reference(time: float) -> np.ndarray:
    """The free body's momentum, by SciPy's method of order 8."""
    inertia = np.array([1.5, 2, 2.5])
    found = solve_ivp(
        lambda _, mu: np.cross(mu, mu / inertia), (0, time), START, "DOP853", rtol=1e-12, atol=1e-13
    )
    return found.y[:, -1]


def test_a_run_has_its_arrays(body: ca.System) -> None:
    run = body.simulate(momentum=START, time=100, step=0.1)
    assert run.time.shape == (1001,) and run.momentum.shape == (1001, 3)
    assert run.group_element.shape == (1001, 3, 3) and run.energy.shape == (1001,)
    assert run.time[0] == 0 and run.time[-1] == 100
    for array in [run.time, run.momentum, run.group_element, run.energy, *run.drift]:
        assert array.dtype == np.float64 and np.isfinite(array).all()
    np.testing.assert_array_equal(run.momentum[0], START)
    np.testing.assert_array_equal(run.final_momentum, run.momentum[-1])
    np.testing.assert_array_equal(run.final_group_element, run.group_element[-1])
    off = np.linalg.norm(run.momentum[-1] - reference(100)) / np.linalg.norm(START)
    assert off < 1e-6 and off / 10 < run.estimated_error < 1e-6
    # g carries the momentum back to where it was in space.
    back = np.einsum("nij,nj->ni", run.group_element, run.momentum)
    assert np.abs(back - START).max() < 1e-13 and np.abs(run.spatial_momentum - START).max() < 1e-13
    assert run.largest_drift.spatial_momentum < 1e-13 and run.largest_drift.casimirs < 1e-13
    assert 0 < run.largest_drift.energy < 1e-6


def test_every_backend_has_the_same_bits(body: ca.System) -> None:
    runs = [body.simulate(START, time=20, step=0.1, backend=b) for b in ["interpreter", "jit", "auto"]]
    for run in runs[1:]:
        np.testing.assert_array_equal(run.momentum, runs[0].momentum)
        np.testing.assert_array_equal(run.group_element, runs[0].group_element)
    assert "Cranelift" in runs[1].backend and runs[0].backend == "interpreter"


def test_a_system_that_is_run_again_and_again_is_compiled() -> None:
    system = ca.System("SO3", "x^2/3+y^2/4+z^2/5", coordinates="x y z", truncation=9)
    backends = (system.simulate(START, time=20, step=0.1, estimate=False).backend for _ in range(10_000))
    first = next(backends)
    assert first == "interpreter" and any("Cranelift" in backend for backend in backends)


def test_records_are_chosen(body: ca.System) -> None:
    every = body.simulate(START, time=10, step=0.1, every=30)
    np.testing.assert_allclose(every.time, [0, 3, 6, 9, 10])
    at = body.simulate(START, time=10, step=0.1, at=[0.55, 2, 10])
    np.testing.assert_allclose(at.time, [0.55, 2, 10])
    for order in ([10, 0.55, 2], [2, 2], [[1], [2]]):
        with pytest.raises(InputError, match="in the order of the run, each once"):
            body.simulate(START, time=10, step=0.1, at=order)
    both = body.simulate(START, time=10, step=0.1, every=50, at=[2])
    np.testing.assert_allclose(both.time, [0, 2, 5, 10])
    assert np.abs(body.simulate(START, time=0.55, step=0.11).final_momentum - at.momentum[0]).max() < 1e-7


def test_a_tolerance_is_met_from_each_start(body: ca.System) -> None:
    slow, fast = [0.2, 0.05, 0.1], [4, 1, 2]
    runs = [body.simulate(start, time=50, tolerance=1e-9) for start in (slow, fast, slow)]
    assert runs[0].step > 4 * runs[1].step and runs[2].step == runs[0].step
    for start, run in zip((slow, fast), runs, strict=False):
        frame = "comoving" if "comoving" in run.label else "fixed"
        same = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z", truncation=run.truncation, frame=frame)
        again = same.simulate(start, time=50, step=run.step)
        assert run.estimated_error == pytest.approx(again.estimated_error, rel=1e-2) and run.estimated_error < 1e-9


def test_a_tolerance_picks_the_step(body: ca.System) -> None:
    run = body.simulate(START, time=50, tolerance=1e-10)
    assert np.abs(run.final_momentum - reference(50)).max() < 1e-9
    assert run.notes and run.truncation and run.truncation % 2 == 1


def test_steps_end_at_the_time(body: ca.System) -> None:
    run = body.simulate(START, time=1, step=0.3)
    assert run.steps == 4 and run.time[-1] == 1 and "0.25" in " ".join(run.notes)
    backwards = body.simulate(run.final_momentum, time=1, step=-0.25, group_element=run.final_group_element)
    assert backwards.time[-1] == -1
    assert np.abs(backwards.final_momentum - START).max() < 1e-12
    assert np.abs(backwards.final_group_element - np.eye(3)).max() < 1e-12


def test_files_say_what_arguments_leave_out() -> None:
    path = Path(__file__).parents[2] / "examples" / "rigid_body.toml"
    system = ca.System.from_file(path)
    run = system.simulate()
    assert run.momentum.shape[1] == 3 and run.largest_drift.spatial_momentum < 1e-12
    assert ca.System.from_text(system.text).simulate().final_momentum.tolist() == run.final_momentum.tolist()


def test_a_comoving_frame_takes_out_the_spin() -> None:
    body = dict(group="SO3", hamiltonian="x^2/2 + y^2/2 + z^2/3 + x^4/50", coordinates="x y z")
    fixed, moving = ca.System(**body), ca.System(**body, frame="comoving")
    found = [s.simulate([0.3, 0.2, 0.9], time=20, step=0.5).final_momentum for s in (fixed, moving)]
    fine = fixed.simulate([0.3, 0.2, 0.9], time=20, step=0.05).final_momentum
    errors = [np.abs(f - fine).max() for f in found]
    assert errors[1] < 0.3 * errors[0]


def test_a_potential_kicks() -> None:
    top = ca.System(
        "SO3",
        "x^2/2 + y^2/2 + z^2/1.2",
        coordinates="x y z",
        potential="2*g[2][2]",
        splitting="rkn4",
    )
    run = top.simulate([0.1, 0.2, 3], time=10, step=0.02)
    # The vertical component of the spatial momentum stays; the others do not.
    assert np.ptp(run.spatial_momentum[:, 2]) < 1e-12 < np.ptp(run.spatial_momentum[:, 0])
    energy = np.einsum("ni,i->n", run.momentum**2, [0.5, 0.5, 1 / 1.2]) + 2 * run.group_element[:, 2, 2]
    np.testing.assert_allclose(run.energy, energy, rtol=1e-12)
    assert run.largest_drift.energy < 1e-6
    many = top.ensemble([[0.1, 0.2, 3], [0.3, 0.2, 1]], time=10, step=0.02)
    np.testing.assert_allclose(many[0], run.final_momentum, rtol=1e-11, atol=1e-11)


def test_groups_by_basis_and_by_brackets() -> None:
    basis = [[[1, 0], [0, -1]], [[0, 1], [0, 0]], [[0, 0], [1, 0]]]
    sl2 = ca.System({"basis": basis, "generators": "h x y"}, "h^2/4 + (x + y)^2/3 + (x - y)^2/10")
    run = sl2.simulate([0.3, 0.2, 0.4], time=5, step=0.05)
    assert run.group_element.shape == (101, 2, 2) and run.largest_drift.spatial_momentum < 1e-12
    brackets = ["[a, b] = -c", "[b, c] = a", "[c, a] = b"]
    so21 = ca.System({"generators": ["a", "b", "c"], "brackets": brackets}, "a^2/2 + b^2/4 - c^2/6")
    assert so21.simulate([0.3, 0.2, 0.4], time=2, step=0.05).largest_drift.casimirs < 1e-12
    with pytest.raises(InputError, match="Jacobi|closed|identity"):
        ca.System({"generators": "a b c", "brackets": ["[a, b] = a", "[b, c] = b", "[a, c] = c"]}, "a^2")


def test_products_have_block_matrices() -> None:
    pair = ca.System("SO3^2", "sum(i, 0..2, x[i]^2/2 + y[i]^2/3) + x[0]*x[1]/5", coordinates="x y z")
    run = pair.simulate([0.3, 0.2, 0.4, 0.1, 0.6, 0.2], time=2, step=0.1)
    assert run.group_element.shape == (21, 6, 6) and not run.group_element[:, :3, 3:].any()
    back = np.einsum("nij,nj->ni", run.group_element, run.momentum)
    assert np.abs(back - run.momentum[0]).max() < 1e-13


def test_single_steps_are_those_of_runs(body: ca.System) -> None:
    run = body.simulate(START, time=1, step=0.1, backend="jit")
    mu, g = np.array(START, float), None
    for n in range(1, 11):
        mu, g = body.step(mu, g, step=0.1)
        assert np.abs(mu - run.momentum[n]).max() < 1e-15 and np.abs(g - run.group_element[n]).max() < 1e-14
    at_once, _ = body.step(START, step=0.1, steps=10)
    assert np.abs(at_once - mu).max() < 1e-14
    far, _ = body.step(START, step=0.1, steps=1000)
    assert np.abs(far - reference(100)).max() < 1e-6


def test_runs_that_stop_say_where(body: ca.System) -> None:
    with pytest.raises(RunError, match="a step of .* works here") as caught:
        body.simulate([200, 50, 100], time=10, step=0.1)
    assert caught.value.step == 1
    with pytest.raises(RunError):
        body.step([200, 50, 100], step=0.1)
    steep = ca.System("SO3", "x^4/4 + y^4/3 + z^2/2 + x*y", coordinates="x y z")
    with pytest.warns(ca.CoadjointWarning, match="hardly converges"):
        run = steep.simulate([1.2, 0.8, 0.5], time=0.25, step=0.25)
    assert len(run.warnings) == 1


def test_events_are_found_within_steps_and_end_runs():
    """The period of a free body is an elliptic integral (Landau and Lifshitz, Mechanics, §37)."""
    from scipy.special import ellipk

    body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
    start, moments = np.array([2, 0.5, 1]), np.array([1.5, 2, 2.5])
    square, twice = start @ start, start @ (start / moments)
    speed = np.sqrt((moments[0] - moments[1]) * (square - twice * moments[2]) / moments.prod())
    parameter = (moments[1] - moments[2]) * (twice * moments[0] - square)
    parameter /= (moments[0] - moments[1]) * (square - twice * moments[2])
    period = 4 * ellipk(parameter) / speed

    def middle(t, g, mu):
        return mu[1]

    middle.direction = 1
    run = body.simulate(start, time=5 * period, step=0.2, truncation=11, events=middle)
    (found,) = run.events
    assert len(found.time) == 5 and found.momentum.shape == (5, 3) and found.group_element.shape == (5, 3, 3)
    assert np.abs(np.diff(found.time) - period).max() < 1e-10
    assert np.abs(found.momentum[:, 1]).max() < 1e-12
    # The other direction half a period later; the second occurrence of either ends a run.
    middle.direction, middle.terminal = -1, True
    ended = body.simulate(start, time=5 * period, step=0.2, truncation=11, at=[1, 2, 3, 4], every=1, events=middle)
    end = found.time[0] + period / 2
    end -= period if end > period else 0
    assert abs(ended.time[-1] - end) < 1e-10 and ended.time[-1] == ended.events[0].time[0]
    assert np.array_equal(ended.momentum[-1], ended.final_momentum) and (np.diff(ended.time) > 0).all()
    middle.terminal = False
    # Far inside one step, seen only by looks within it.
    fast = ca.System("SO3", "z", coordinates="x y z")

    def upright(t, g, mu):
        return g[0, 0] + 0.9

    assert len(fast.simulate([0, 0, 1], time=5, step=1.25, events=upright).events[0].time) == 0
    turned = fast.simulate([0, 0, 1], time=5, step=1.25, events=[upright, middle], looks=8)
    assert np.abs(turned.events[0].time - [np.arccos(-0.9), 2 * np.pi - np.arccos(-0.9)]).max() < 1e-12


def test_events_that_cannot_be_followed():
    body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")

    def failing(t, g, mu):
        raise ValueError("no such sensor")

    def unknown(t, g, mu):
        return np.nan if t > 0.5 else 1.0

    def never(t, g, mu):
        return 1.0

    never.terminal = True
    with pytest.raises(ca.RunError, match="`failing` at time 0: ValueError: no such sensor"):
        body.simulate([2, 0.5, 1], time=1, step=0.1, events=failing)
    with pytest.raises(ca.RunError, match="`unknown` is NaN at time 0.6"):
        body.simulate([2, 0.5, 1], time=1, step=0.1, events=unknown)
    with pytest.warns(ca.CoadjointWarning, match="`never` did not occur; its function was 1 at the start and is 1"):
        body.simulate([2, 0.5, 1], time=1, step=0.1, events=never)
    with pytest.raises(ca.InputError, match="an event is a function"):
        body.simulate([2, 0.5, 1], time=1, step=0.1, events=["x"])
    with pytest.raises(ca.InputError, match="looks"):
        body.simulate([2, 0.5, 1], time=1, step=0.1, events=never, looks=0)


def test_events_of_a_file_come_first():
    text = 'group="SO3"\ncoordinates=["x","y","z"]\nhamiltonian="z"\n[[event]]\nwhen="x - t"\n[run]\nlooks=4\n'

    def low(t, g, mu):
        return g[0, 0]

    run = ca.System.from_text(text).simulate([1, 0, 3], time=3, step=1.5, events=low)
    first, second = run.events
    # x = cos t, and g turns by t.
    assert np.abs(first.time - 0.7390851332151607).max() < 1e-12
    assert np.abs(second.time - np.pi / 2).max() < 1e-12


def test_parameters_of_a_run_are_those_of_a_system_with_them() -> None:
    """What is said of a run, its derivatives and its tolerance are those for the values given."""
    text: dict[str, Any] = dict(
        group="SO3", hamiltonian="x^2/(2*J[0]) + y^2/(2*J[1]) + z^2/(2*J[2])", coordinates="x y z", damping="a"
    )
    start, usual = [2, 0.5, 1], {"J": [1, 2, 3], "a": 0.0}
    body = ca.System(**text, parameters=usual)
    changes: list[tuple[dict[str, Any], dict[str, Any]]] = [
        ({"J": [1.5, 2, 2.5]}, dict(step=0.1)),
        ({"J": [1.25, 2, 2.5]}, dict(step=0.1)),
        ({"a": 0.125}, dict(step=0.1)),
        ({"a": 0.25, "J": [1.5, 2, 3]}, dict(tolerance=1e-9)),
    ]
    for change, how in changes:
        found = body.simulate(start, time=5, parameters=change, **how)
        other = ca.System(**text, parameters=usual | change).simulate(start, time=5, **how)
        assert found.step == other.step and found.label == other.label
        np.testing.assert_allclose(found.momentum, other.momentum, atol=1e-13)
        np.testing.assert_allclose(found.angular_velocity, other.angular_velocity, atol=1e-13)
        np.testing.assert_allclose(found.energy, other.energy, atol=1e-13)
        tangent = found.jvp(parameters={"J": [1, 0, 0]})
        np.testing.assert_allclose(tangent.momentum, other.jvp(parameters={"J": [1, 0, 0]}).momentum, atol=1e-12)
        assert (body.simulate(start, time=5, step=0.1).momentum[-1] != found.momentum[-1]).any()
    for wrong, match in (({"K": 1}, "no parameter `K`"), ({"J": [1, 2]}, "3 finite numbers"), ({"a": -1}, "must not be negative")):
        with pytest.raises(ca.InputError, match=match):
            body.simulate(start, time=5, step=0.1, parameters=wrong)
    # Inputs keep the values that they were read with.
    pulses = dict(times=[0, 1], u=["a", 1])
    driven = ca.System("SO3", "x^2/2 + y^2/4 + z^2/6 + u*x*a", coordinates="x y z", inputs=pulses, parameters=dict(a=0.5))
    with pytest.raises(ca.InputError, match="a number of the algebra or of an input"):
        driven.simulate(start, time=1, step=0.1, parameters=dict(a=1))
