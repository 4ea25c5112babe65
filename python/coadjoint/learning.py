"""Maps learned from data: whatever the data are, what is learned is symplectic, and keeps momentum and Casimirs.

>>> import coadjoint as ca, numpy as np
>>> body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
>>> before = np.random.default_rng(1).uniform(-1, 1, (200, 3))
>>> after = body.ensemble(before, time=0.1, step=0.1)
>>> model = ca.learn(before, after, group="SO3", step=0.1, degree=4)
>>> bool(model.summary["drifts"]["casimir"] < 1e-12)
True
"""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _core
from ._arrays import Floats, floats, vector
from ._progress import Progress, listener
from .errors import CoadjointWarning, InputError
from .results import Run
from .system import _count, _real

__all__ = ["Model", "geometrize", "learn"]


class Model:
    """A learned map, for one step size.

    Models are saved as JSON, which the command `coadjoint` reads too; they pickle and compare by that text.
    """

    def __init__(self, text: str, name: str = "model", summary: Mapping[str, Any] | None = None) -> None:
        self._model_text, self._name = text, name
        self._core = _core.ModelCore(text, name)
        self._facts = self._core.facts()
        #: How well it fits: errors on the data, drifts along a trajectory, what was chosen, rows left out.
        self.summary: dict[str, Any] = dict(summary or {})

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Model:
        """The model of a file."""
        with open(path, encoding="utf-8") as file:
            return cls(file.read(), os.fspath(path))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the model as JSON."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self._model_text)

    @property
    def text(self) -> str:
        """The model as JSON."""
        return self._model_text

    @property
    def group(self) -> str:
        """The group's name."""
        return str(self._facts["group"])

    @property
    def step_size(self) -> float:
        """The time that one application stands for."""
        return float(self._facts["step"])

    @property
    def kind(self) -> str:
        """The kind of model."""
        return str(self._facts["kind"])

    @property
    def attitude(self) -> bool:
        """Whether attitudes were learned; from momenta alone they cannot be."""
        return bool(self._facts["attitude"])

    def simulate(
        self,
        momentum: Any,
        *,
        time: float,
        every: int = 1,
        progress: bool | Progress | None = None,
    ) -> Run:
        """The motion from this momentum; ``time`` must be a whole number of the model's steps."""
        dimension = int(self._facts["dimension"])
        start = vector(momentum, "momentum", dimension)
        if _count(every, "every") < 1:
            raise InputError("every=0: every counts steps from 1; try every=1")
        told = listener(progress, "following")
        try:
            found = self._core.simulate(start, _real(time, "time"), int(every), told)
        finally:
            if told is not None:
                told.close()
        for text in found["warnings"]:
            warnings.warn(text, CoadjointWarning, stacklevel=2)
        names = [f"mu[{i}]" for i in range(dimension)]
        return Run(found, names, self._name, {"time": None, "momentum": [None] * dimension})

    def emit(self, language: str = "rust", *, prefix: str | None = None, single: bool = False) -> str:
        """A learned polynomial as code, in the languages of :meth:`System.emit`."""
        return self._core.emit(language, prefix, bool(single))

    def __reduce__(self) -> Any:
        return Model, (self._model_text, self._name, self.summary)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Model):
            return NotImplemented
        return self._model_text == other._model_text

    def __hash__(self) -> int:
        return hash(self._model_text)

    def __repr__(self) -> str:
        what = f"{self.kind} on {self.group}, step {self.step_size:g}"
        choice = self._facts["choice"]
        return f"<Model: {what}; {choice}>" if choice else f"<Model: {what}>"


def _columns(what: str, value: Any, names: tuple[str, str]) -> dict[str, Floats]:
    """Columns of an array (N, n), or (N, d, d) for attitudes, or (N, 4) quaternions, by the names of files."""
    array = floats(value, what, finite=False)
    momentum, element = names
    if array.ndim == 2 and momentum:
        return {f"{momentum}_{i + 1}": np.ascontiguousarray(array[:, i]) for i in range(array.shape[1])}
    if array.ndim == 2 and array.shape[1] == 4 and not momentum:
        letter = element.replace("g", "q", 1)
        return {f"{letter}_{x}": np.ascontiguousarray(array[:, i]) for i, x in enumerate("wxyz")}
    if array.ndim == 3 and not momentum and array.shape[1] == array.shape[2]:
        size = array.shape[1]
        separator = "_" if size > 9 else ""
        return {
            f"{element}_{i + 1}{separator}{j + 1}": np.ascontiguousarray(array[:, i, j])
            for i in range(size)
            for j in range(size)
        }
    form = "(N, n)" if momentum else "(N, d, d), or (N, 4) for quaternions"
    raise InputError(f"{what} must have the shape {form}; it is {array.shape}")


def _data(before: Any, after: Any, attitudes: tuple[Any, Any] | None, what: str) -> list[tuple[str, Floats]]:
    """All columns of pairs of states: arrays, or a data frame or dictionary with the names of files."""
    if after is None:
        if not (isinstance(before, Mapping) or hasattr(before, "columns")):
            raise InputError(
                f"{what}: give the states before and after a step, or a data frame with the columns mu_1 …, mu_next_1 …"
            )
        names = list(before.columns if hasattr(before, "columns") else before)
        return [(str(n), np.ravel(floats(before[n], f"{what}, column {n}", finite=False))) for n in names]
    columns = _columns("before", before, ("mu", ""))
    columns |= _columns("after", after, ("mu_next", ""))
    if attitudes is not None:
        if not isinstance(attitudes, tuple) or len(attitudes) != 2:
            raise InputError("attitudes must be a pair: those before and those after the step")
        columns |= _columns("attitudes before", attitudes[0], ("", "g"))
        columns |= _columns("attitudes after", attitudes[1], ("", "g_next"))
    return list(columns.items())


def learn(
    before: Any,
    after: Any = None,
    *,
    step: float,
    attitudes: tuple[Any, Any] | None = None,
    group: str = "SO3",
    chart: str = "exp",
    model: str = "auto",
    degree: int | None = None,
    ridge: float = 0.0,
    loss: str = "chart",
    tolerance: float = 1e-6,
    drop_bad_rows: bool = False,
    test: Any = None,
    start: Any = None,
    seed: int = 0,
    widths: Sequence[int] = (500, 500),
    activation: str = "tanh",
    evaluations: int = 1000,
    drift_steps: int = 1000,
    progress: bool | Progress | None = None,
    _momenta_only: bool = False,
) -> Model:
    """Learns the map behind pairs of states a time ``step`` apart.

    ``before`` and ``after`` are momenta, (N, n); ``attitudes`` a pair of arrays of matrices, (N, d, d), or of quaternions
    w, x, y, z. A data frame or a dictionary with the columns ``mu_1`` …, ``mu_next_1`` … takes the place of both.
    ``test`` is a pair of arrays (with ``attitudes``, four), or a frame. ``model`` is ``"auto"`` (what cross-validates
    best), ``"polynomial"``, ``"gp"``, ``"network"`` or ``"hybrid"``; ``loss`` is ``"chart"`` or ``"group"``.
    ``tolerance`` is how far attitudes may be off the group and momenta off conservation; ``inf`` for noisy data.
    """
    if loss not in ("chart", "group"):
        raise InputError(f'loss="{loss}": there are "chart" and "group"')
    data = _data(before, after, attitudes, "data")
    tested = None
    if test is not None:
        if isinstance(test, tuple) and len(test) in (2, 4):
            tested = _data(test[0], test[1], (test[2], test[3]) if len(test) == 4 else None, "test")
        else:
            tested = _data(test, None, None, "test")
    settings = {
        "group": str(group),
        "chart": str(chart),
        "step": _real(step, "step"),
        "kind": str(model),
        "degree": None if degree is None else _count(degree, "degree"),
        "ridge": _real(ridge, "ridge"),
        "group_loss": loss == "group",
        "tolerance": _real(tolerance, "tolerance"),
        "drop": bool(drop_bad_rows),
        "momenta_only": _momenta_only,
        "start": None if start is None else [float(x) for x in vector(start, "start")],
        "seed": _count(seed, "seed"),
        "widths": [_count(width, "widths") for width in widths],
        "activation": str(activation),
        "evaluations": _count(evaluations, "evaluations"),
        "drift_steps": _count(drift_steps, "drift_steps"),
    }
    told = listener(progress, "learning")
    try:
        text, summary = _core.learn(data, tested, settings, told)
    finally:
        if told is not None:
            told.close()
    found = Model(text, "model", json.loads(summary))
    dropped = found.summary.get("dropped") or []
    if dropped:
        row, reason = dropped[0]
        text = f"{len(dropped)} rows were left out; the first is row {row}: {reason}"
        warnings.warn(text, CoadjointWarning, stacklevel=2)
    return found


def geometrize(
    before: Any,
    after: Any = None,
    *,
    step: float,
    group: str = "SO3",
    chart: str = "exp",
    degree: int | None = None,
    test: Any = None,
    start: Any = None,
    seed: int = 0,
    drop_bad_rows: bool = False,
    drift_steps: int = 1000,
    progress: bool | Progress | None = None,
) -> Model:
    """The Poisson map nearest to a method that is none: from momenta before and after a step of it, (N, n) each.

    >>> import coadjoint as ca, numpy as np
    >>> inertia = np.array([1.5, 2, 2.5])
    >>> before = np.random.default_rng(1).uniform(-1, 1, (300, 3))
    >>> after = before + 0.05 * np.cross(before, before / inertia)        # forward Euler
    >>> model = ca.geometrize(before, after, step=0.05)
    >>> import warnings
    >>> with warnings.catch_warnings(action="ignore"):     # of attitudes nothing is known
    ...     run = model.simulate([0.3, 0.2, 0.9], time=50)
    >>> bool(run.largest_drift.casimirs < 1e-12)
    True
    """
    return learn(
        before,
        after,
        step=step,
        group=group,
        chart=chart,
        model="polynomial",
        degree=degree,
        test=test,
        start=start,
        seed=seed,
        drop_bad_rows=drop_bad_rows,
        drift_steps=drift_steps,
        progress=progress,
        _momenta_only=True,
    )
