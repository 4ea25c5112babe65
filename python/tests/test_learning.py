"""Maps learned from arrays and frames."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pandas
import pytest
import sympy

import coadjoint as ca
from coadjoint import InputError

STEP = 0.1


def pairs(body: ca.System, count: int, seed: int) -> tuple[np.ndarray, ...]:
    """Momenta and attitudes before and after a step of the true motion."""
    random = np.random.default_rng(seed)
    before = random.uniform(-1, 1, (count, 3))
    attitude = np.tile(np.eye(3).ravel(), (count, 1))
    after = np.asarray(body.ensemble(np.hstack([before, attitude]), time=STEP, step=STEP / 4))
    return before, after[:, :3], np.tile(np.eye(3), (count, 1, 1)), after[:, 3:].reshape(-1, 3, 3)


def test_learned_maps_keep_momentum_and_casimirs(body: ca.System, tmp_path: Path) -> None:
    before, after, g, g_next = pairs(body, 300, 1)
    model = ca.learn(before, after, attitudes=(g, g_next), step=STEP, test=pairs(body, 50, 2), degree=4)
    assert model.attitude and model.summary["test"]["max_error"]["momentum"] < 1e-6
    run = model.simulate([0.5, 0.2, 0.7], time=100)
    assert run.largest_drift.spatial_momentum < 1e-12 and run.largest_drift.casimirs < 1e-12
    true = body.simulate([0.5, 0.2, 0.7], time=10, step=STEP)
    assert np.abs(model.simulate([0.5, 0.2, 0.7], time=10).momentum - true.momentum).max() < 1e-4
    assert np.isnan(run.energy).all() and run.group_element.shape == (1001, 3, 3)
    model.save(tmp_path / "model.json")
    assert ca.Model.load(tmp_path / "model.json") == model == pickle.loads(pickle.dumps(model))
    assert "pub struct" in model.emit("rust") and "SO3" in repr(model)


def test_frames_and_dictionaries_are_read_by_their_names(body: ca.System) -> None:
    before, after, *_ = pairs(body, 100, 3)
    names = [f"mu_{i}" for i in (1, 2, 3)] + [f"mu_next_{i}" for i in (1, 2, 3)]
    frame = pandas.DataFrame(np.hstack([before, after]), columns=names)
    by_frame = ca.learn(frame, step=STEP, degree=4)
    by_arrays = ca.learn(before, after, step=STEP, degree=4)
    by_dictionary = ca.learn({name: frame[name].to_numpy() for name in names}, step=STEP, degree=4)
    assert by_frame == by_arrays == by_dictionary and not by_frame.attitude
    ends = frame[names[5:2:-1]]
    for after in [after, ends, ends.rename(columns=lambda name: name.replace("next_", ""))]:
        assert ca.learn(frame[names[2::-1]], after, step=STEP, degree=4) == by_frame


def test_a_poisson_map_is_found_beside_euler(body: ca.System) -> None:
    inertia = np.array([1.5, 2, 2.5])
    before = np.random.default_rng(5).uniform(-1, 1, (300, 3))
    after = before + STEP * np.cross(before, before / inertia)
    with pytest.raises(InputError, match="Casimir"):
        ca.learn(before, after, step=STEP)
    with pytest.warns(ca.CoadjointWarning, match="Casimirs differ by up to"):
        model = ca.learn(before, after, step=STEP, tolerance=np.inf)
    with pytest.warns(ca.CoadjointWarning, match="attitude"):
        run = model.simulate([0.5, 0.2, 0.7], time=100)
    assert run.largest_drift.casimirs < 1e-12 and run.group_element.shape == (1001, 0, 0)


def test_data_that_make_no_sense_are_refused(body: ca.System) -> None:
    before, after, g, g_next = pairs(body, 20, 4)
    bad = after.copy()
    bad[3, 1] = np.nan
    for arguments, message in [
        ((before, bad), "row"),
        ((before, after[:10]), "column|length|10"),
        ((before[:, :2], after[:, :2]), "mu_3"),
        ((before[0], after[0]), "shape"),
        ((before,), "after"),
        (({"mu_1": before[:, 0]},), "mu_2"),
    ]:
        with pytest.raises(InputError, match=message):
            ca.learn(*arguments, step=STEP, degree=2)
    for settings, message in [
        (dict(model="forest"), "forest"),
        (dict(chart="polar"), "polar"),
        (dict(group="SO99x"), "SO99x"),
        (dict(attitudes=g), "pair"),
        (dict(attitudes=(g, 2 * g_next)), "group|row"),
        (dict(seed=-1), "seed"),
    ]:
        with pytest.raises(InputError, match=message):
            ca.learn(before, after, **{"step": STEP, "degree": 2, **settings})
    with pytest.warns(ca.CoadjointWarning, match="1 rows were left out"):
        assert ca.learn(before, bad, step=STEP, degree=2, drop_bad_rows=True).summary["dropped"]
    model = ca.learn(before, after, step=STEP, degree=2)
    with pytest.raises(InputError, match="whole number of steps"):
        model.simulate([1, 0, 0], time=0.25)
    with pytest.raises(InputError, match="JSON"):
        ca.Model("nonsense")


def test_maps_are_learned_on_an_algebra_of_its_own(tmp_path: Path) -> None:
    brackets = ["[U, V] = -E", "[U, R] = -2*V", "[V, R] = 2*U"]
    algebra = {"generators": "U V R E", "brackets": brackets, "name": "oscillator"}
    system = ca.System(algebra, "U^2/2 + V^2/3 + R*E/5 + R^2/9")
    before = np.random.default_rng(7).uniform(-1, 1, (150, 4))
    after = system.ensemble(before, time=STEP, step=STEP)
    model = ca.learn(before, after, step=STEP, group=system, degree=4)
    assert model == ca.learn(before, after, step=STEP, group=algebra, degree=4)
    assert model.group == "oscillator" and model.summary["drifts"]["casimir"] < 1e-12
    # A step, an ensemble and a run are the same map, near that of the system.
    mu, attitude = model.step(before[3], steps=10)
    ends = model.ensemble(before, time=10 * STEP)
    assert attitude is None and np.abs(mu - ends[3]).max() < 1e-12
    with pytest.warns(ca.CoadjointWarning, match="attitude"):
        run = model.simulate(before[3], time=10 * STEP)
    assert np.abs(run.momentum[-1] - mu).max() < 1e-12
    assert np.abs(np.asarray(ends) - np.asarray(system.ensemble(before, time=10 * STEP, step=STEP))).max() < 1e-3
    # S is Δt·H to first order, up to the Casimir U² + V² − RE, which moves no momentum.
    momenta = [sympy.Symbol(name) for name in model.coordinates]
    terms = sympy.Poly(model.generating_function, *momenta).as_dict()
    assert abs(terms[2, 0, 0, 0] - terms[0, 2, 0, 0] - STEP / 6) < 1e-3 and "*mu[0]^2" in model.generating_text
    model.save(tmp_path / "model.json")
    assert pickle.loads(pickle.dumps(ca.Model.load(tmp_path / "model.json"))).step(before[3], steps=10)[0].tolist() == mu.tolist()
    for wrong, message in [
        (lambda: model.ensemble(before, time=0.25), "whole number"),
        (lambda: model.ensemble(np.hstack([before, before]), time=1), "momenta alone"),
        (lambda: model.step(before[3], np.eye(4)), "momenta alone"),
        (lambda: ca.learn(before, after, step=STEP, group="oscillator"), "oscillator"),
        (lambda: ca.learn(before, after, step=STEP, group={"basis": 3}), "basis"),
        (lambda: ca.learn(before, after, step=STEP, group=3), "group"),
    ]:
        with pytest.raises(InputError, match=message):
            wrong()


def test_only_polynomials_are_programs(body: ca.System) -> None:
    before, after, g, g_next = pairs(body, 40, 6)
    process = ca.learn(before, after, attitudes=(g, g_next), step=STEP, model="gp")
    for use in [lambda: process.step(before[0]), lambda: process.ensemble(before, time=1), lambda: process.generating_text]:
        with pytest.raises(InputError, match="only polynomial models"):
            use()
