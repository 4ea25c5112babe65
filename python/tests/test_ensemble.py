"""Ensembles: arrays in, arrays out, and rows that fail."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import coadjoint as ca
from coadjoint import InputError


def states(count: int, width: int = 3) -> np.ndarray:
    return np.random.default_rng(7).uniform(-1, 1, (count, width))


def test_rows_are_those_of_single_runs(body: ca.System) -> None:
    start = states(37)
    final = body.ensemble(start, time=10, step=0.1)
    assert final.shape == (37, 3) and final.failed == [] and final.ok.all()
    assert final.drift.spatial_momentum < 1e-13 and final.columns == ["mu_1", "mu_2", "mu_3"]
    for row in [0, 20, 36]:
        alone = body.simulate(start[row], time=10, step=0.1).final_momentum
        assert np.abs(final[row] - alone).max() < 1e-13


def test_bits_depend_on_nothing_else(body: ca.System) -> None:
    start = states(1000)
    first = body.ensemble(start, time=3, step=0.1, threads=1)
    for more in [{"threads": 3}, {"backend": "interpreter"}, {"backend": "jit"}]:
        np.testing.assert_array_equal(body.ensemble(start, time=3, step=0.1, **more), first)
    np.testing.assert_array_equal(body.ensemble(start[500:], time=3, step=0.1), first[500:])


def test_attitudes_go_along(body: ca.System) -> None:
    start = states(5)
    matrices = body.ensemble(np.hstack([start, np.tile(np.eye(3).ravel(), (5, 1))]), time=2, step=0.1)
    quaternions = body.ensemble(np.hstack([start, np.tile([1.0, 0, 0, 0], (5, 1))]), time=2, step=0.1)
    run = body.simulate(start[3], time=2, step=0.1)
    assert np.abs(matrices[3, 3:].reshape(3, 3) - run.final_group_element).max() < 1e-13
    w = quaternions[3, 3]
    assert abs(4 * w * w - 1 - np.trace(run.final_group_element)) < 1e-12
    assert [len(names) for names in body.layouts()] == [3, 12, 7]


def test_rows_that_fail_are_nan_and_told(body: ca.System) -> None:
    start = states(20)
    start[4] = np.nan
    start[11] *= 1000
    with (
        pytest.warns(ca.CoadjointWarning, match="2 of 20 rows .* the first is row 4, mu_1 is NaN"),
        pytest.warns(ca.CoadjointWarning, match="hardly converges"),
    ):
        final = body.ensemble(start, time=5, step=0.1)
    assert [(f.row, f.step) for f in final.failed] == [(4, 0), (11, 1)]
    assert "works here" in final.failed[1].reason
    assert np.isnan(final[[4, 11]]).all() and list(np.flatnonzero(~final.ok)) == [4, 11]
    whole = np.delete(start, [4, 11], axis=0)
    np.testing.assert_array_equal(body.ensemble(whole, time=5, step=0.1), final[final.ok])


@pytest.mark.parametrize("dtype", ["f4", ">f8", "i8", "u1", "O"])
def test_dtypes_are_converted(body: ca.System, dtype: str) -> None:
    start = np.array([[1, 0, 1], [0, 1, 1]]).astype(dtype)
    expected = body.ensemble(np.array([[1.0, 0, 1], [0, 1, 1]]), time=1, step=0.1)
    np.testing.assert_array_equal(body.ensemble(start, time=1, step=0.1), expected)


def test_strides_and_read_only_arrays(body: ca.System) -> None:
    start = states(10)
    expected = body.ensemble(start, time=1, step=0.1)
    strided = np.repeat(np.repeat(start, 2, axis=0), 3, axis=1)[::2, ::3]
    reversed_ = np.ascontiguousarray(start[::-1])[::-1]
    frozen = start.copy()
    frozen.setflags(write=False)
    for array in [strided, reversed_, frozen, np.asfortranarray(start), start.tolist()]:
        np.testing.assert_array_equal(body.ensemble(array, time=1, step=0.1), expected)
    np.testing.assert_array_equal(start, states(10))


def test_shapes_that_make_no_sense_are_refused(body: ca.System) -> None:
    run = lambda array: body.ensemble(array, time=1, step=0.1)  # noqa: E731
    for array, message in [
        (np.ones(3), "newaxis"),
        (np.ones((2, 5)), "3 or 12 or 7"),
        (np.ones((2, 3, 1)), "shape"),
        (np.ones((2, 3)) * 1j, "complex"),
        (np.array([["a", "b", "c"]]), "type"),
        ([[1, 2, 3], [1, 2]], "lengths"),
        (np.array([[{}, 1, 2]]), "numbers"),
        (np.array(["2020"], dtype="M8[Y]"), "type"),
        (np.array([[True, False, True]]), "type bool"),
    ]:
        with pytest.raises(InputError, match=message):
            run(array)
    with pytest.raises(InputError, match="masked"):
        run(np.ma.masked_array(np.ones((1, 3)), [[0, 1, 0]]))
    empty = run(np.empty((0, 3)))
    assert empty.shape == (0, 3) and empty.failed == []
    for threads in [0, -1, 10**6, 1.5]:
        with pytest.raises(InputError, match="threads"):
            body.ensemble(np.ones((1, 3)), time=1, step=0.1, threads=threads)


def test_trajectories_are_those_of_single_runs(body: ca.System) -> None:
    times = [0, 0.55, 7, 20]
    found = body.ensemble(states(3), time=20, step=0.1, at=times)
    assert found.shape == (3, 4, 3) and found.ok.all()
    for row, start in zip(found, states(3), strict=True):
        single = body.simulate(start, time=20, step=0.1, at=times)
        np.testing.assert_allclose(row, single.momentum, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(found[:, -1], body.ensemble(states(3), time=20, step=0.1))
    assert body.ensemble(np.empty((0, 3)), time=1, step=0.1, at=[0, 1]).shape == (0, 2, 3)
    with pytest.raises(InputError, match="sort them"):
        body.ensemble(states(3), time=20, step=0.1, at=[2, 1])


def test_results_pickle(body: ca.System) -> None:
    final = body.ensemble(states(4), time=1, step=0.1)
    again = pickle.loads(pickle.dumps(final))
    np.testing.assert_array_equal(again, final)
    assert again.backend == final.backend and again.columns == final.columns and again.step == 0.1


def test_an_ensemble_runs_in_a_forked_process(body: ca.System) -> None:
    import multiprocessing
    import sys

    if sys.platform == "win32":
        pytest.skip("no fork here")
    expected = body.ensemble(states(8), time=1, step=0.1)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        found = pool.map(_advance, [(body, part) for part in np.split(states(8), 2)])
    np.testing.assert_array_equal(np.vstack(found), expected)


def _advance(work: tuple[ca.System, np.ndarray]) -> np.ndarray:
    system, rows = work
    return np.asarray(system.ensemble(rows, time=1, step=0.1))


@pytest.mark.parametrize("hold", ["previous", "linear", "spline"])
def test_rows_have_inputs_of_their_own(hold: str) -> None:
    def driven(u: np.ndarray) -> ca.System:
        given = dict(times=[0, 0.75, 2, 3.5], u=u.tolist(), v=[0.1, 0.2, 0.3, 0.1], hold=hold)
        return ca.System("SO3", "x^2/3 + y^2/4 + z^2/5 + v*x", coordinates="x y z", torque=["u", "0", "-z/5"], inputs=given)

    start, samples = states(11), states(11, 4)
    final = driven(np.zeros(4)).ensemble(start, time=3, step=0.1, inputs={"u": samples})
    for row in range(11):
        alone = driven(samples[row]).simulate(start[row], time=3, step=0.1)
        np.testing.assert_array_equal(final[row], alone.final_momentum)
    system = driven(np.zeros(4))
    middle = system.ensemble(start, time=3, step=0.1, inputs={"u": samples}, at=[1.25, 3], threads=1)
    np.testing.assert_array_equal(middle[:, 1], final)
    for wrong, words in [
        ({"u": samples.T}, r"shape \[4, 11\]; 11 rows of 4 samples"),
        ({"u": samples[0]}, r"shape \[4\]"),
        ({"w": samples}, "is no input of the system; those with samples: u, v"),
    ]:
        with pytest.raises(InputError, match=words):
            system.ensemble(start, time=3, step=0.1, inputs=wrong)
    assert system.ensemble(start[:0], time=3, step=0.1, inputs={"u": samples[:0]}).shape == (0, 3)
