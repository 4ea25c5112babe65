"""Trajectories: their arrays, their accuracy, and the settings of runs."""

from __future__ import annotations

from pathlib import Path

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
