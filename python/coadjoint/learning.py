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
import re
import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _arrays, _core, _text
from ._arrays import (
    Backend,
    Floats,
    Numbers,
    Real,
    Rotation,
    count,
    flag,
    floats,
    listed,
    names,
    real,
    text,
    unused,
    vector,
)
from ._progress import Progress, listener
from .errors import CoadjointWarning, InputError
from .results import Run, States
from .system import System, of_core

if TYPE_CHECKING:
    import sympy

__all__ = ["Model", "learn"]


class Model:
    """A learned map, for one step size.

    Models are saved as JSON, which the command `coadjoint` reads too; they pickle and compare by that text.
    """

    def __init__(self, text: str, name: str = "model", summary: Mapping[str, Any] | None = None) -> None:
        self._model_text, self._name = _arrays.text(text, "text"), _arrays.text(name, "name")
        self._core = _core.ModelCore(text, name)
        self._facts = self._core.facts()
        #: How well it fits: errors on the data, drifts along a trajectory, what was chosen, rows left out.
        self.summary: dict[str, Any] = dict(summary) if isinstance(summary, Mapping) else {}

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Model:
        """The model of a file."""
        return cls(_core.read_text(path), os.fspath(path))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the model as JSON: all of it, or what was there stays."""
        _core.write_text(path, self._model_text)

    @property
    def text(self) -> str:
        """The model as JSON."""
        return self._model_text

    @property
    def name(self) -> str:
        """The model's name."""
        return self._name

    @property
    def coordinates(self) -> list[str]:
        """The names of the momentum's coordinates."""
        return [f"mu[{i}]" for i in range(int(self._facts["dimension"]))]

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
        momentum: Numbers,
        *,
        time: Real,
        every: int = 1,
        progress: bool | Progress | None = None,
    ) -> Run:
        """The motion from this momentum; ``time`` must be a whole number of the model's steps."""
        start = _momentum(momentum, "momentum", int(self._facts["dimension"]))
        with listener(progress, "following") as told:
            found = self._core.simulate(start, real(time, "time"), count(every, "every", 1), told)
        for said in found["warnings"]:
            warnings.warn(said, CoadjointWarning, stacklevel=2)
        return Run(found, self)

    def step(
        self,
        momentum: Numbers,
        group_element: Numbers | Rotation | None = None,
        *,
        steps: int = 1,
        backend: Backend = "jit",
    ) -> tuple[Floats, Floats | None]:
        """The state after one application of the map, or ``steps`` of them, as :meth:`System.step` gives it. The group
        element is None where only momenta were learned. For polynomials.

        >>> import coadjoint as ca, numpy as np
        >>> body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
        >>> before = np.random.default_rng(1).uniform(-1, 1, (200, 3))
        >>> model = ca.learn(before, body.ensemble(before, time=0.1, step=0.1), step=0.1, degree=4)
        >>> mu, g = model.step([0.3, 0.2, 0.9])
        >>> bool(abs(mu - body.step([0.3, 0.2, 0.9], step=0.1)[0]).max() < 1e-7), g
        (True, None)
        """
        if group_element is not None:
            self._knows_attitudes("group_element")
        mu, g = self._system.step(momentum, group_element, steps=steps, backend=backend)
        return mu, g if self.attitude else None

    def ensemble(
        self,
        states: Numbers,
        *,
        time: Real,
        backend: Backend = "auto",
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> States:
        """Many trajectories of the map, as :meth:`System.ensemble` has them; ``time`` must be a whole number of the
        model's steps. For polynomials."""
        rows, _ = self._system._rows(states)
        if rows.ndim == 2 and rows.shape[1] != int(self._facts["dimension"]):
            self._knows_attitudes("states")
        end = self._core.steps(real(time, "time")) * self.step_size
        return self._system.ensemble(rows, time=end, backend=backend, threads=threads, progress=progress)

    @property
    def generating_function(self) -> sympy.Expr:
        """S(p) of a learned polynomial as SymPy, in the symbols ``mu[0]``, … of the canonical momentum (needs sympy)."""
        import sympy

        from . import _sympy

        known = {name: sympy.Symbol(name) for name in self.coordinates}
        return _sympy.polynomial(self.generating_text, known, exact=False)

    @property
    def generating_text(self) -> str:
        """S(p) of a learned polynomial in the notation of system files; its numbers are decimals."""
        return self._core.generating_function()

    @cached_property
    def _system(self) -> System:
        """The system whose steps, of the model's size, are the map."""
        return of_core(self._core.system(), self._model_text, self._name)

    def _knows_attitudes(self, what: str) -> None:
        if not self.attitude:
            raise InputError(f"{what}: the model was learned from momenta alone, so it says nothing about attitudes")

    def emit(self, language: str = "rust", *, prefix: str | None = None, single: bool = False) -> str:
        """A learned polynomial as code, in the languages of :meth:`System.emit`."""
        return self._core.emit(
            text(language, "language"), None if prefix is None else text(prefix, "prefix"), flag(single, "single")
        )

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


def _momentum(value: Any, what: str, length: int | None = None) -> Floats:
    """One momentum: by the names ``mu_1`` … where there are names."""
    found = names(value)
    if found is None:
        return vector(value, what, length)
    wanted = [f"mu_{i + 1}" for i in range(length or sum(name.startswith("mu_") for name in found))]
    if missing := [name for name in wanted if name not in found]:
        raise InputError(f"{what}: {missing[0]} is missing; there are {', '.join(found)}")
    unused(what, [name for name in found if name not in wanted])
    return vector([value[name] for name in wanted], what)


def _columns(what: str, value: Any, after: bool, attitude: bool) -> tuple[dict[str, Floats], list[str]]:
    """Columns by the names of files, and the names of those that nobody uses: of tables by their names, of arrays of
    momenta (N, n), matrices (N, d, d) or quaternions (N, 4) by their places."""
    following = "_next" if after else ""
    found = names(value)
    if found is not None:
        files = {name: re.sub(r"^(mu|g|q)_(?!next_)", rf"\1{following}_", name) for name in found}
        files = {name: file for name, file in files.items() if re.match(r"(mu|g|q)_", name)}
        if twice := [name for name in files if found.count(name) > 1]:
            raise InputError(f"{what}: column {twice[0]} is there twice: keep one")
        columns = {file: floats(value[name], f"{what}, {name}", finite=False) for name, file in files.items()}
        if wrong := [name for name, column in columns.items() if column.ndim != 1]:
            raise InputError(f"{what}, {wrong[0]}: a list of numbers is needed")
        return columns, [name for name in found if name not in files]
    array = floats(value.as_matrix() if hasattr(value, "as_matrix") else value, what, finite=False)
    size = array.shape[-1] if array.ndim else 0
    if array.ndim == 2 and not attitude:
        labels = [f"mu{following}_{i + 1}" for i in range(size)]
    elif array.ndim == 2 and size == 4 and attitude:
        labels = [f"q{following}_{x}" for x in "wxyz"]
    elif array.ndim == 3 and array.shape[1] == size and attitude:
        separator = "_" if size > 9 else ""
        labels = [f"g{following}_{i + 1}{separator}{j + 1}" for i in range(size) for j in range(size)]
    else:
        form = "(N, d, d), or (N, 4) for quaternions" if attitude else "(N, n)"
        raise InputError(f"{what} must have the shape {form}; it is {array.shape}")
    flat = array.reshape(len(array), -1)
    return {name: np.ascontiguousarray(flat[:, i]) for i, name in enumerate(labels)}, []


def _data(
    before: Any, after: Any, attitudes: tuple[Any, Any] | None, what: str
) -> tuple[list[tuple[str, Floats]], list[str]]:
    """All columns of pairs of states, and the names of those that nobody uses."""
    if after is None and names(before) is None:
        raise InputError(
            f"{what}: give the states before and after a step, or a data frame with the columns mu_1 …, mu_next_1 …"
        )
    if not isinstance(attitudes, (tuple, type(None))) or len(attitudes or (0, 0)) != 2:
        raise InputError("attitudes must be a pair: those before and those after the step")
    sides = [("before" if after is not None else what, before, False, False), ("after", after, True, False)]
    sides += [(f"attitudes {side[0]}", value, side[2], True) for side, value in zip(sides, attitudes or ())]
    columns: dict[str, Floats] = {}
    others: list[str] = []
    for side in sides:
        if side[1] is not None:
            found, unknown = _columns(*side)
            columns |= found
            others += [name for name in unknown if name not in others]
    return list(columns.items()), others


def _algebra(group: Any) -> str | None:
    """The text of a system file with this group, unless it is known by its name."""
    if isinstance(group, System):
        return group.text
    return None if isinstance(group, str) else "\n".join(_text.table("algebra", _text.algebra(group)))


def learn(
    before: Numbers,
    after: Numbers | None = None,
    *,
    step: Real,
    attitudes: tuple[Any, Any] | None = None,
    group: str | Mapping[str, Any] | System = "SO3",
    chart: str = "exp",
    model: str = "auto",
    degree: int | None = None,
    ridge: Real = 0.0,
    tolerance: Real = 1e-6,
    drop_bad_rows: bool = False,
    test: Any = None,
    start: Numbers | None = None,
    seed: int = 0,
    widths: Sequence[int] = (500, 500),
    evaluations: int = 1000,
    drift_steps: int = 1000,
    progress: bool | Progress | None = None,
) -> Model:
    """Learns the map behind pairs of states a time ``step`` apart.

    ``group`` is that of the data: a name, a dictionary with a ``basis``, or with ``generators`` and ``brackets``, as for
    :class:`System`, or a system, whose group it is.

    ``before`` and ``after`` are momenta, (N, n); ``attitudes`` a pair of arrays of matrices, (N, d, d), or of quaternions
    w, x, y, z. A data frame or a dictionary with the columns ``mu_1`` …, ``mu_next_1`` … takes the place of both.
    ``test`` is a pair of arrays (with ``attitudes``, four), or a frame. ``model`` is ``"auto"`` (what cross-validates
    best), ``"polynomial"``, ``"gp"``, ``"network"`` or ``"hybrid"``.
    ``tolerance`` is how far attitudes may be off the group and momenta off conservation; ``inf`` for noisy data, and for
    momenta before and after a step of a method that is no Poisson map: the nearest one is found, and a warning says by how
    much the method changes the Casimirs.

    >>> import coadjoint as ca, numpy as np, warnings
    >>> inertia = np.array([1.5, 2, 2.5])
    >>> before = np.random.default_rng(1).uniform(-1, 1, (300, 3))
    >>> after = before + 0.05 * np.cross(before, before / inertia)        # forward Euler
    >>> with warnings.catch_warnings(action="ignore"):     # of Casimirs, and of attitudes, of which nothing is known
    ...     model = ca.learn(before, after, step=0.05, tolerance=np.inf)
    ...     run = model.simulate([0.3, 0.2, 0.9], time=50)
    >>> bool(run.largest_drift.casimirs < 1e-12)
    True
    """
    data, others = _data(before, after, attitudes, "data")
    tested = None
    if test is not None:
        if isinstance(test, tuple) and len(test) in (2, 4):
            tested, _ = _data(test[0], test[1], (test[2], test[3]) if len(test) == 4 else None, "test")
        else:
            tested, _ = _data(test, None, None, "test")
    settings = {
        "group": group if isinstance(group, str) else "",
        "algebra": _algebra(group),
        "chart": text(chart, "chart"),
        "step": real(step, "step"),
        "kind": text(model, "model"),
        "degree": None if degree is None else count(degree, "degree"),
        "ridge": real(ridge, "ridge"),
        "tolerance": real(tolerance, "tolerance"),
        "drop": flag(drop_bad_rows, "drop_bad_rows"),
        "start": None if start is None else [float(x) for x in _momentum(start, "start")],
        "seed": count(seed, "seed"),
        "widths": [count(width, "widths") for width in listed(widths, "widths")],
        "evaluations": count(evaluations, "evaluations"),
        "drift_steps": count(drift_steps, "drift_steps"),
    }
    with listener(progress, "learning") as told:
        found_text, summary = _core.learn(data, tested, settings, told)
    found = Model(found_text, "model", json.loads(summary))
    unused("data", others + found.summary.get("unused", []))
    for message in found.summary.get("warnings") or []:
        warnings.warn(message, CoadjointWarning, stacklevel=2)
    dropped = found.summary.get("dropped") or []
    if dropped:
        row, reason = dropped[0]
        said = f"{len(dropped)} rows were left out; the first is row {row}: {reason}"
        warnings.warn(said, CoadjointWarning, stacklevel=2)
    return found
