"""The derivatives of runs, forwards and backwards."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _arrays, _core
from ._arrays import Floats
from .errors import InputError

if TYPE_CHECKING:
    from .results import Run

__all__ = ["Gradient", "Jacobian", "Tangent", "forward", "backward", "jacobian", "largest_exponent", "monodromy"]

#: A record may be this far, relatively, from a whole number of steps.
_SLACK = 1e-9


class Tangent(NamedTuple):
    """The changes of the records of a run, to first order."""

    #: ξ = g⁻¹δg in the basis of the Lie algebra, (N, n): for rotations δg by a small angle about the body's axes.
    group_element: Floats
    #: δμ, (N, n).
    momentum: Floats
    #: The changes of the records' times, (N,): that of an event which ended the run, else 0.
    time: Floats


class Jacobian(NamedTuple):
    """The derivatives of the records of a run, with axes after those of a :class:`Tangent` for what they are taken in."""

    #: In the start (ξ, δμ), 2n numbers.
    start: Tangent
    #: In each of the parameters asked for, the axes of its shape.
    parameters: dict[str, Tangent]
    #: In the samples of each input asked for, at its times.
    inputs: dict[str, Tangent]


class Gradient(NamedTuple):
    """The derivatives of one number in what a run begins with."""

    #: In ξ = g⁻¹δg of the group element, (n,).
    group_element: Floats
    #: In the momentum, (n,).
    momentum: Floats
    #: In each of the parameters asked for, an array of its shape.
    parameters: dict[str, Floats]
    #: In the samples of each input asked for, at its times.
    inputs: dict[str, Floats]


def _asked(run: Run, names: Iterable[str]) -> tuple[dict[str, Any], dict[str, tuple[int, ...]]]:
    """The run as the core asks for it, and the shapes of the parameters in the order in which it has them."""
    source, start = run._source, run._found.get("start")
    if start is None:
        raise InputError("a learned map has no derivatives: those are of systems known as text")
    if getattr(source, "_functions", None) is not None:
        raise InputError("a Hamiltonian that is a function has no derivatives: give it as an expression")
    if acting := getattr(source, "_acting", None):
        raise InputError(f"a {next(iter(acting))} that is a function has no derivatives: give it as expressions")
    core: Any = source._core
    known = {name: tuple(shape) for name, shape in core.parameters()}
    wanted = [_arrays.text(name, "parameters") for name in names]
    for name in wanted:
        if name not in known:
            listed = ", ".join(known) or "none"
            raise InputError(f"parameters: the system has no parameter {name!r}; there are: {listed}")
    shapes = {name: shape for name, shape in known.items() if name in wanted}
    asked = {
        **start,
        "core": core,
        "step": run.step,
        "steps": run.steps,
        "t0": run.t0,
        "truncation": run.truncation,
        "comoving": "comoving" in run.label,
        "parameters": list(shapes),
        "event": run._found["ended_by"],
    }
    return asked, shapes


def _steps(run: Run) -> list[int]:
    """The number of steps made up to each record; one more than all whole ones at the event that ended the run."""
    ended = run._found["ended_by"]
    last = [run.steps + 1] if ended and len(run) and run.time[-1] == ended[2] else []
    times = run.time[: len(run) - len(last)]
    steps = np.rint((times - run.t0) / run.step)
    apart = np.abs(times - (run.t0 + steps * run.step))
    if (apart > _SLACK * (np.abs(times - run.t0) + abs(run.step))).any():
        raise InputError("derivatives are of whole steps: record every n-th step, or times that are multiples of the step")
    return [int(step) for step in steps] + last


def _samples(run: Run, names: Iterable[str]) -> dict[str, int]:
    """The numbers of samples of these inputs."""
    core: Any = run._source._core
    known = dict(core.inputs())
    wanted = [_arrays.text(name, "inputs") for name in names]
    for name in wanted:
        if known.get(name, 0) == 0:
            what = "is a function, which has no samples" if name in known else "is no input of the system"
            raise InputError(f"inputs: {name!r} {what}; those with samples: {', '.join(k for k, n in known.items() if n) or 'none'}")
    return {name: known[name] for name in wanted}


def forward(
    run: Run, momentum: Any, group_element: Any, parameters: Mapping[str, Any] | None, inputs: Mapping[str, Any] | None
) -> Tangent:
    """:meth:`Run.jvp`."""
    given = {} if parameters is None else dict(parameters)
    sampled = {} if inputs is None else dict(inputs)
    asked, shapes = _asked(run, given)
    n = run.momentum.shape[1]

    def vector(value: Any, what: str) -> Floats:
        return np.zeros(n) if value is None else _arrays.vector(value, what, n)

    changes = [np.zeros(0)]
    for name, shape in shapes.items():
        change = _arrays.floats(given[name], f"parameters[{name!r}]")
        if change.shape != shape:
            raise InputError(f"parameters[{name!r}] has the shape {change.shape}; the parameter has {shape}")
        changes.append(change.ravel())
    state = np.concatenate([vector(group_element, "group_element"), vector(momentum, "momentum")])
    change = np.concatenate(changes)
    samples = {name: _arrays.vector(sampled[name], f"inputs[{name!r}]", count) for name, count in _samples(run, sampled).items()}
    columns = {name: own[:, np.newaxis] for name, own in samples.items()}
    found = _carried(run, asked, state[:, np.newaxis], change[:, np.newaxis], columns)
    return Tangent(*(own[..., 0] for own in found))


def _carried(run: Run, asked: dict[str, Any], state: Floats, parameters: Floats, inputs: dict[str, Floats]) -> Tangent:
    """The changes of the records with k columns of changes, which are the last axis."""
    (rows, k), steps = state.shape, _steps(run)
    found = _core.forward(asked, state, parameters, inputs, steps)
    # Of the event that ended the run there is a row more.
    before = max(len(steps) - 1, 0) * k * rows
    last = found[before:].reshape(len(steps[-1:]), k, -1)
    both = np.concatenate([found[:before].reshape(-1, k, rows), last[..., :rows]])
    times = np.zeros((len(steps), k))
    if last.shape[-1] > rows:
        times[-1] = last[0, :, rows]
    both = both.transpose(0, 2, 1)
    return Tangent(both[:, : rows // 2], both[:, rows // 2 :], times)


def jacobian(run: Run, parameters: Iterable[str], inputs: Iterable[str]) -> Jacobian:
    """:meth:`Run.jacobian`."""
    asked, shapes = _asked(run, [parameters] if isinstance(parameters, str) else parameters)
    samples = _samples(run, [inputs] if isinstance(inputs, str) else inputs)
    start = 2 * run.momentum.shape[1]
    axes = [(start,), *shapes.values(), *((count,) for count in samples.values())]
    ends = np.cumsum([int(np.prod(shape)) for shape in axes])
    units = np.split(np.eye(ends[-1]), ends[:-1])
    state, of_parameters, of_inputs = units[0], units[1 : len(shapes) + 1], units[len(shapes) + 1 :]
    changes = np.concatenate([np.zeros((0, ends[-1])), *of_parameters])
    found = _carried(run, asked, state, changes, dict(zip(samples, of_inputs, strict=True)))
    parts = zip(axes, *(np.split(own, ends[:-1], axis=-1) for own in found), strict=True)
    first, *others = [Tangent(*(own.reshape(*own.shape[:-1], *shape) for own in part)) for shape, *part in parts]
    named = dict(zip([*shapes, *samples], others, strict=True))
    return Jacobian(first, {name: named[name] for name in shapes}, {name: named[name] for name in samples})


def backward(
    run: Run, momentum: Any, group_element: Any, time: Any, parameters: Iterable[str], inputs: Iterable[str]
) -> Gradient:
    """:meth:`Run.vjp`."""
    asked, shapes = _asked(run, [parameters] if isinstance(parameters, str) else parameters)
    samples = _samples(run, [inputs] if isinstance(inputs, str) else inputs)
    count, n = run.momentum.shape

    def rows(value: Any, what: str) -> Floats:
        if value is None:
            return np.zeros((count, n))
        array = _arrays.floats(value, what)
        if array.shape != (count, n):
            raise InputError(f"{what} has the shape {array.shape}: give a row for each record, {(count, n)}")
        return array

    times = np.zeros(count) if time is None else _arrays.vector(time, "time", count)
    both = np.hstack([rows(group_element, "group_element"), rows(momentum, "momentum"), times[:, np.newaxis]])
    found, of_inputs = _core.backward(asked, both, _steps(run))
    named: dict[str, Floats] = {}
    place = 2 * n
    for name, shape in shapes.items():
        size = int(np.prod(shape))
        named[name] = found[place : place + size].reshape(shape)
        place += size
    return Gradient(found[:n], found[n : 2 * n], named, {name: of_inputs[name] for name in samples})


def monodromy(run: Run) -> Floats:
    """:meth:`Run.monodromy`."""
    asked, _ = _asked(run, ())
    size = 2 * len(run.final_momentum)
    found = _core.forward(asked, np.eye(size), np.zeros((0, size)), {}, _steps(run)[-1:])
    return found.reshape(size, -1).T[:size]


def largest_exponent(run: Run, transient: Any) -> float:
    """:meth:`Run.largest_exponent`."""
    asked, _ = _asked(run, ())
    return _core.largest_exponent(asked, _arrays.count(transient, "transient"))
