"""Mistakes are told where they are, with what to write instead."""

from __future__ import annotations

import inspect
import pickle
import warnings

import numpy as np
import pytest

import coadjoint as ca
from coadjoint import InputError, RunError


def test_the_place_in_the_expression_is_marked() -> None:
    with pytest.raises(InputError) as caught:
        ca.System("SO3", "x^2/2 + w*y", coordinates="x y z")
    lines = str(caught.value).splitlines()
    place = next(i for i, line in enumerate(lines) if "x^2/2 + w*y" in line)
    column = lines[place].index("w*y")
    assert lines[place + 1][column] == "^" and "w" in lines[0]


def test_all_mistakes_are_told_at_once() -> None:
    with pytest.raises(InputError) as caught:
        ca.System("SO7x", "x^2", coordinates="x y z", truncation=4, chart="exq")
    assert str(caught.value).count("error:") >= 3


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (dict(group="SO3", hamiltonian="x^2", coordinates="x y"), "3"),
        (dict(group="SO3", hamiltonian="1/x", coordinates="x y z", method="series"), "polynomial|coordinate"),
        (dict(group="SO3", hamiltonian="a*x^2", coordinates="x y z"), "a"),
        (dict(group="SO3", hamiltonian="a*x^2", coordinates="x y z", parameters={"a": np.nan}), "nan"),
        (dict(group="SO3", hamiltonian="a*x^2", coordinates="x y z", parameters={"a": "1/0"}), "0"),
        (dict(group="SO3", hamiltonian="x^2", coordinates="x y z", parameters={"a b": 1}), "a b"),
        (dict(group=3, hamiltonian="x^2"), "group"),
        (dict(group="SO3", hamiltonian=3.5), "hamiltonian"),
        (dict(group={"base": []}, hamiltonian="x^2"), "base"),
        (dict(group="SO3", hamiltonian="x^2", coordinates="x y z", tolerance=1e-9, step=0.1), "step|tolerance"),
        (dict(group="SO3", hamiltonian="x^2", coordinates="x y z", frame="moving"), "frame|moving"),
        (dict(group="SO3", hamiltonian="x^2", coordinates="x y z", step=float("inf")), "inf"),
    ],
)
def test_systems_that_make_no_sense_are_refused(arguments: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        ca.System(**arguments)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (dict(time=1), "step is missing"),
        (dict(step=0.1), "time is missing"),
        (dict(time=-1, step=0.1), "time must be finite and positive; try time=100"),
        (dict(time=1, step=0), "step must be finite and other than zero; try step=0.1"),
        (dict(time=1, step=0.1, tolerance=1e-8), "not both"),
        (dict(time=1, tolerance=1e-30), "tolerance"),
        (dict(time=1e13, step=1e-3), "1e12 steps"),
        (dict(time=1e9, step=0.1), "every"),
        (dict(time=1, step="0.1"), "step"),
        (dict(time=1, step=0.1, every=0), "every"),
        (dict(time=1, step=0.1, every=1.5), "every"),
        (dict(time=1, step=0.1, at=[2]), "between 0 and the end"),
        (dict(time=1, step=0.1, at=[]), "no times"),
        (dict(time=1, step=0.1, backend="gpu"), "backend"),
        (dict(time=1, step=0.1, truncation=4), "odd"),
        (dict(time=1, step=0.1, group_element=np.eye(2)), "3 rows"),
        (dict(time=1, step=0.1, group_element=2 * np.eye(3)), "group_element"),
        (dict(time=1, step=0.1, momentum=[1, 2]), "3 are needed"),
        (dict(time=1, step=0.1, momentum=[1, np.nan, 2]), r"momentum\[1\] is nan"),
        (dict(time=1, step=0.1, momentum="123"), "type"),
    ],
)
def test_settings_that_make_no_sense_are_refused(body: ca.System, settings: dict, message: str) -> None:
    arguments = {"momentum": [1, 0, 0.5], **settings}
    with pytest.raises(InputError, match=message):
        body.simulate(**arguments)


def test_values_of_other_kinds_are_refused_in_words(body: ca.System) -> None:
    before = np.random.default_rng(1).uniform(-1, 1, (40, 3))
    after = body.ensemble(before, time=0.1, step=0.1)
    short = dict(step=0.1, degree=2, drift_steps=9)
    odd = ["a", b"x", {}, object(), 1j, np.nan, -1, 2**70, [[1], [1, 2]], np.array([1, 2]), np.array(0.1), int, {"a": 1}]
    for call, arguments in [
        (ca.System, dict(group="SO3", hamiltonian="x^2", coordinates="x y z")),
        (ca.System.from_text, dict(text=body.text)),
        (body.simulate, dict(momentum=[1, 2, 3], time=1, step=0.1)),
        (body.ensemble, dict(states=before, time=1, step=0.1)),
        (body.step, dict(momentum=[1, 2, 3], step=0.1)),
        (body.series, {}),
        (body.emit, {}),
        (body.verify, dict(run=after, states=before)),
        (ca.learn, dict(before=before, after=after, **short)),
        (ca.learn(before, after, **short).simulate, dict(momentum=[0.1, 0.2, 0.3], time=1)),
    ]:
        for name in inspect.signature(call).parameters:
            for value in odd if name != "progress" else []:
                if (name, value is odd[7]) == ("drift_steps", True):
                    continue
                try:
                    with warnings.catch_warnings(action="ignore"):
                        call(**{**arguments, name: value})
                except ca.Error as error:
                    assert str(error)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda body: body.simulate([1, 2, 3], time=1, step=0.1, every="a"), "every='a': a whole number"),
        (lambda body: body.series(5, truncation=3), "k=5 is beyond truncation=3"),
        (lambda body: body.check(seed=-1), "seed=-1: a whole number, at least 0"),
        (lambda body: body.emit("c", single="no"), "single='no': True or False"),
        (lambda body: body.emit(3), "language=3: a text"),
        (lambda body: ca.System("SO3", "x^2", coordinates=3), "coordinates=3: a list"),
        (lambda body: ca.System("SO3", "x^2", coordinates="x y z", parameters=3), "parameters=3: a dictionary"),
    ],
)
def test_mistakes_name_the_argument(body: ca.System, call, message: str) -> None:
    with pytest.raises(InputError, match=message):
        call(body)
    assert body.step([1, 2, 3], step=np.array(0.1))[0].shape == (3,)


def test_a_missing_momentum_is_named(body: ca.System) -> None:
    with pytest.raises(InputError, match="momentum is missing"):
        body.simulate(time=1, step=0.1)


def test_errors_are_python_errors_and_pickle(body: ca.System) -> None:
    assert issubclass(InputError, ValueError) and issubclass(RunError, RuntimeError)
    with pytest.raises(ca.Error) as caught:
        body.simulate([200, 50, 100], time=10, step=0.1)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (str(again), again.step, again.time) == (str(caught.value), 1, caught.value.time)


def test_no_message_speaks_of_options(body: ca.System) -> None:
    for settings in [dict(time=1, step=0), dict(time=0, step=1), dict(time=1, tolerance=5)]:
        with pytest.raises(InputError) as caught:
            body.simulate([1, 0, 0], **settings)
        assert "--" not in str(caught.value)
