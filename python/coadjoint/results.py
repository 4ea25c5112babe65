"""The results of runs and ensembles."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._arrays import Floats, Numbers, flag, quaternions
from .derivatives import Gradient, Jacobian, Tangent, backward, forward, jacobian, largest_exponent, monodromy
from .errors import InputError

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from .learning import Model
    from .system import System

__all__ = ["Drift", "Failure", "Run", "States", "Unknown"]


_NAMES = ("spatial momentum", "Casimirs", "energy")
_HIDDEN = "rounding of large numbers hides it"


class Unknown:
    """A number that there is not: of what is not conserved, not known or cannot be measured. It is false and equals None;
    comparing it, or computing with it, raises a TypeError that says why."""

    def __init__(self, what: str, why: str) -> None:
        #: What is unknown, and why.
        self.what, self.why = what, why

    def __bool__(self) -> bool:
        return False

    def __eq__(self, other: object) -> bool:
        return other is None or isinstance(other, Unknown)

    def __hash__(self) -> int:
        return hash(None)

    def __repr__(self) -> str:
        return f"Unknown({self.why!r})"

    def _refuse(self, *_: object) -> Any:
        raise TypeError(f"there is no {self.what}: {self.why}")

    __lt__ = __le__ = __gt__ = __ge__ = __float__ = __abs__ = __neg__ = __format__ = _refuse
    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = _refuse


class Drift(NamedTuple):
    """Relative differences from the start; each an array over the records, NaN where there is none, or the largest over
    all steps, :class:`Unknown` where there is none. The differences are relative to :attr:`Run.drift_scale`."""

    spatial_momentum: Any
    casimirs: Any
    energy: Any


class Crossings(NamedTuple):
    """The moments at which an event occurred, in the order of the run."""

    #: The times, (N,).
    time: Floats
    #: The body momenta there, (N, n).
    momentum: Floats
    #: The matrices of the group element there, (N, d, d).
    group_element: Floats


class Failure(NamedTuple):
    """A row of an ensemble that has no end state."""

    #: Its number, from 0.
    row: int
    #: The step that could not be made, from 1; 0 where the row itself is at fault.
    step: int
    #: Why.
    reason: str


def _dense(entries: Floats, blocks: list[tuple[int, int]]) -> Floats:
    """The matrices with these blocks."""
    rows = entries.shape[0]
    size = max((first + length for first, length in blocks), default=0)
    if len(blocks) == 1:
        return entries.reshape(rows, size, size)
    found = np.zeros((rows, size, size))
    place = 0
    for first, length in blocks:
        own = entries[:, place : place + length * length].reshape(rows, length, length)
        found[:, first : first + length, first : first + length] = own
        place += length * length
    return found


class Run:
    """A trajectory: what was recorded, and how well the run kept what it must.

    All arrays have one row for each record; the first is the start and the last the end.

    >>> import coadjoint as ca
    >>> body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
    >>> run = body.simulate(momentum=[2, 0.5, 1], time=10, step=0.1)
    >>> run.momentum.shape, run.group_element.shape
    ((101, 3), (101, 3, 3))
    >>> bool(run.largest_drift.spatial_momentum < 1e-13)
    True
    """

    def __init__(self, found: dict[str, Any], source: System | Model) -> None:
        self._found, self._source, self._name = found, source, source.name
        facts = source._facts
        self._units = {"time": facts.get("time_unit"), "momentum": facts.get("units", [])}

    @property
    def time(self) -> Floats:
        """The times of the records, (N,)."""
        return self._array("time")

    @property
    def momentum(self) -> Floats:
        """The body momentum μ, (N, n)."""
        return self._array("momentum")

    @cached_property
    def group_element(self) -> Floats:
        """The matrices of the group element g, (N, d, d). For products, block by block."""
        return _dense(self._array("entries"), self._found["blocks"])

    def quaternion(self, *, scalar_first: bool = True) -> Floats:
        """The rotation from body to space as unit quaternions w, x, y, z, or x, y, z, w, (N, 4); of k factors (N, k, 4).

        >>> import coadjoint as ca
        >>> run = ca.System("SO3", "z^2", coordinates="x y z").simulate([0, 0, 1], time=0.2, step=0.1)
        >>> run.quaternion().round(4)
        array([[1.    , 0.    , 0.    , 0.    ],
               [0.995 , 0.    , 0.    , 0.0998],
               [0.9801, 0.    , 0.    , 0.1987]])
        """
        places = self._found["rotations"]
        if not places:
            raise InputError(f"no element of the group of {self._name} is a rotation of space")
        found = [quaternions(self.group_element[:, at : at + 3, at : at + 3]) for at in places]
        every = found[0] if len(found) == 1 else np.stack(found, axis=1)
        return every if flag(scalar_first, "scalar_first") else np.roll(every, -1, axis=-1)

    @property
    def angular_velocity(self) -> Floats:
        """The velocity in the Lie algebra, ξ = g⁻¹ġ, (N, n): for rotations the angular velocity in axes of the body. It is
        ∂H/∂μ at the time of each record, and what a velocity or damping adds to it.
        """
        if not hasattr(self._source._core, "velocities"):
            raise InputError("a learned map has steps, and no velocity between them")
        count = len(self)
        matrices = self.group_element.reshape(count, -1) if self._source._facts["damped"] else np.zeros((count, 0))
        found: Floats = self._source._core.velocities(self.time, self.momentum, matrices)
        return found

    @property
    def spatial_momentum(self) -> Floats:
        """The spatial momentum Ad*_g μ, (N, n): conserved unless a potential breaks the symmetry."""
        return self._array("spatial_momentum")

    @property
    def energy(self) -> Floats:
        """The energy, (N,): of H, and of V where there is a potential; NaN for learned maps, which know none."""
        return self._array("energy")

    @property
    def work(self) -> float | None:
        """The work ∫⟨τ, ω⟩ dt of the torque over the whole run, to the order of the step; None where none acts, or where it is not
        known since steps were made without programs."""
        work: float | None = self._found["work"]
        return work

    @property
    def drift(self) -> Drift:
        """The relative differences from the start at the records, (N,) each."""
        drifts = self._array("drifts")
        return Drift(drifts[:, 0], drifts[:, 1], drifts[:, 2])

    @property
    def largest_drift(self) -> Drift:
        """The largest relative differences of the whole run; :class:`Unknown` where there is none, never 0.

        >>> import coadjoint as ca
        >>> affine = ca.System("Aff1", "a^2/2 + b^2/3", coordinates="a b")
        >>> drift = affine.simulate([1, 0.5], time=1, step=0.1).largest_drift
        >>> drift.casimirs < 1e-12
        Traceback (most recent call last):
        TypeError: there is no drift of the Casimirs: none known
        """
        found, reasons = self._found["largest_drift"], self._found["unknown"]
        named = zip(_NAMES, found, reasons, strict=True)
        return Drift(*(Unknown(f"drift of the {name}", why or _HIDDEN) if value is None else value for name, value, why in named))

    @property
    def estimated_error(self) -> float | None:
        """An estimate of the error at the end: the larger of the relative errors of the momentum and of the group element's
        matrix, in Euclidean norms; None where it is not known, for the reason in ``estimated_error_unknown``.

        >>> import coadjoint as ca
        >>> body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
        >>> body.simulate([2, 0.5, 1], time=10, step=0.1).estimated_error < 1e-9
        True
        >>> body.simulate([2, 0.5, 1], time=10, step=0.1, estimate=False).estimated_error_unknown
        'not estimated'
        """
        error: float | None = self._found["estimated_error"]
        return error

    @property
    def estimated_error_unknown(self) -> str | None:
        """The reason if ``estimated_error`` is None."""
        reason: str | None = self._found["no_estimate"]
        return reason

    @property
    def trusted_until(self) -> float | None:
        """The time until which runs in steps of other sizes go together, where they end elsewhere: then the end is not
        resolved, and ``estimated_error`` is None."""
        until: float | None = self._found["trusted_until"]
        return until

    @property
    def drift_scale(self) -> Drift:
        """The sizes that drifts are relative to: the largest coordinate of the spatial momentum at the start, the size of
        each Casimir, and the energy at the start, |E₀|."""
        return Drift(*self._found["drift_scale"])

    @cached_property
    def events(self) -> list[Crossings]:
        """The moments of each event that :meth:`System.simulate` was given."""
        found: list[Crossings] = []
        blocks, width = self._found["blocks"], len(self.final_momentum)
        for number in range(self._found["watched"]):
            own = [crossing[1:] for crossing in self._found["events"] if crossing[0] == number]
            times, momenta, entries = zip(*own, strict=True) if own else ((), (), ())
            length = sum(rows * rows for _, rows in blocks)
            element = _dense(np.reshape(entries, (len(own), length)), blocks)
            found.append(Crossings(np.array(times, dtype=float), np.reshape(momenta, (len(own), width)), element))
        return found

    def jvp(
        self,
        *,
        momentum: Numbers | None = None,
        group_element: Numbers | None = None,
        parameters: Mapping[str, Any] | None = None,
        inputs: Mapping[str, Numbers] | None = None,
    ) -> Tangent:
        """The changes of all records, to first order, with the start, the parameters and the inputs: the derivative times a vector.

        ``momentum`` (n,) is the change of the momentum at the start, ``group_element`` (n,) that of the attitude as
        ξ = g⁻¹δg in the basis of the Lie algebra, in radians for rotations; ``parameters`` has a number, or an array of its
        shape, for the name of each parameter that changes, and ``inputs`` the changes of the samples, one at each of its times, for the
        name of each input that changes. They are derivatives of the steps themselves, to rounding. Records between steps have none,
        but for that of an event that ended the run: its changes are those of the state where the event occurs, and ``time`` is that of the
        event's time, by differences of its function there.

        >>> import coadjoint as ca
        >>> body = ca.System("SO3", "x^2/(2*I) + y^2/4 + z^2/5", coordinates="x y z", parameters=dict(I=1.5))
        >>> run = body.simulate([2, 0.5, 1], time=10, step=0.1)
        >>> run.jvp(parameters={"I": 1}).momentum.shape
        (101, 3)
        """
        return forward(self, momentum, group_element, parameters, inputs)

    def vjp(
        self,
        *,
        momentum: Numbers | None = None,
        group_element: Numbers | None = None,
        time: Numbers | None = None,
        parameters: Iterable[str] = (),
        inputs: Iterable[str] = (),
    ) -> Gradient:
        """The derivatives of one number in the start, and in the parameters and the samples of the inputs with these names: a vector
        times the derivative.

        ``momentum`` (N, n) and ``group_element`` (N, n) are the derivatives of that number in the momentum and in
        ξ = g⁻¹δg of each record, and ``time`` (N,) those in the records' times, which count at an event that ended the run.
        Whatever their number, it takes about the time of a run and one :meth:`jvp`, and the memory of all N states; where these
        would take more than 64 MiB that of 2√N, and the time of two runs.
        """
        return backward(self, momentum, group_element, time, parameters, inputs)

    def jacobian(self, *, parameters: Iterable[str] = (), inputs: Iterable[str] = ()) -> Jacobian:
        """The derivatives of all records in the start, and in the parameters and the samples of the inputs with these names, by one run
        with all changes side by side.

        >>> import coadjoint as ca
        >>> body = ca.System("SO3", "x^2/(2*J[0]) + y^2/(2*J[1]) + z^2/5", coordinates="x y z", parameters=dict(J=[1.5, 2]))
        >>> found = body.simulate([2, 0.5, 1], time=10, step=0.1).jacobian(parameters=["J"])
        >>> found.start.momentum.shape, found.parameters["J"].group_element.shape
        ((101, 3, 6), (101, 3, 2))
        """
        return jacobian(self, parameters, inputs)

    def monodromy(self) -> Floats:
        """The derivative of the last record in the start, (2n, 2n), for columns (ξ, δμ). After a period of the motion its
        eigenvalues are the Floquet multipliers."""
        return monodromy(self)

    def largest_exponent(self, transient: int = 0) -> float:
        """The largest Lyapunov exponent, in 1/time: the mean growth of a tangent over the run without its first ``transient``
        steps."""
        return largest_exponent(self, transient)

    @property
    def off_group(self) -> float | None:
        """How far the last element is off its group: the largest entry of gᵀg - 1, of what in g is orthogonal or unitary;
        None where nothing is."""
        found: float | None = self._found["off_group"]
        return found

    @property
    def final_momentum(self) -> Floats:
        """The momentum at the end, (n,), recorded or not."""
        end: Floats = self._found["end"]["momentum"]
        return end

    @property
    def final_group_element(self) -> Floats:
        """The group element at the end, (d, d)."""
        end = self._found["end"]
        found: Floats = _dense(end["entries"][np.newaxis], end["blocks"])[0]
        return found

    @property
    def t0(self) -> float:
        """The time at the start."""
        return float(self._found["t0"])

    @property
    def step(self) -> float:
        """The step size used: the one asked for, or a little less, so that whole steps end at the time."""
        return float(self._found["step"])

    @property
    def steps(self) -> int:
        """How many steps were made."""
        return int(self._found["steps"])

    @property
    def truncation(self) -> int | None:
        """K: the method has order K + 1; none for learned maps."""
        found: int | None = self._found.get("truncation")
        return found

    @property
    def backend(self) -> str:
        """The back end that made the steps."""
        return str(self._found["backend"])

    @property
    def warnings(self) -> list[str]:
        """The warnings of the run."""
        return list(self._found["warnings"])

    @property
    def notes(self) -> list[str]:
        """The choices made for the run: the step for a tolerance, a step that divides the time."""
        notes = [self._found.get("choice"), self._found.get("announcement")]
        return [note for note in notes if note]

    @property
    def label(self) -> str:
        """The method, in a few words."""
        return str(self._found["label"])

    @property
    def coordinates(self) -> list[str]:
        """The names of the momentum's coordinates."""
        return self._source.coordinates

    def to_frame(self) -> pandas.DataFrame:
        """The records as a pandas data frame, one column for each number: ``mu_1`` …, as all calls read them."""
        import pandas

        columns = list(self._found["columns"])
        columns[1 : 1 + self.momentum.shape[1]] = [f"mu_{i + 1}" for i in range(self.momentum.shape[1])]
        return pandas.DataFrame(self._table(), columns=columns)

    def _table(self) -> Floats:
        """All columns, as the command writes them."""
        parts = [self.time[:, np.newaxis], self.momentum, self._array("entries")]
        if self._found["has_energy"]:
            parts.append(self.energy[:, np.newaxis])
        return np.hstack([*parts, self._array("drifts")[:, self._known]])

    @property
    def _known(self) -> list[int]:
        """Which drifts there are: 0 of the spatial momentum, 1 of the Casimirs, 2 of the energy."""
        return [place for place, why in enumerate(self._found["unknown"]) if why is None]

    def plot(self, what: str = "all", *, figure: Figure | None = None) -> Figure:
        """A picture: of the momentum, of the drift, or of both (needs matplotlib).

        ``what`` is ``"all"``, ``"momentum"``, ``"drift"`` or, for motions on spheres (three coordinates of
        SO(3) or SU(2)), ``"orbit"``.
        """
        from . import plots

        return plots.run(self, what, figure)

    def _array(self, name: str) -> Floats:
        array: Floats = self._found[name]
        return array

    def __len__(self) -> int:
        return len(self.time)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Run):
            return NotImplemented
        names = ["time", "momentum", "entries", "energy", "drifts"]
        same = all(np.array_equal(self._found[n], other._found[n], equal_nan=True) for n in names)
        return same and self._name == other._name and self.label == other.label

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        drift = self.largest_drift
        parts = []
        for name, value, since in zip(_NAMES, drift, self._found["unmeasured"], strict=True):
            if not isinstance(value, Unknown):
                parts.append(f"{name} {value:.1e}" + ("" if since is None else f" (not measurable after {since:g})"))
        end = self._found["end"]["time"]
        return (
            f"<Run of {self._name}: {self.label}, {self.steps} steps of {self.step:g} to time {end:g}, "
            f"{len(self)} records; largest drift: {', '.join(parts)}>"
        )

    def _repr_html_(self) -> str:
        from ._html import run

        return run(self)


class States(np.ndarray[Any, np.dtype[np.float64]]):
    """The states of an ensemble: an array, (N, columns) at the end or (N, times, columns), that knows how it was made.

    Rows without an end state are NaN, and are listed in :attr:`failed`. Copies know the same; parts, and what is
    computed from it, are mere arrays.
    """

    #: The rows that have no end state.
    failed: list[Failure]
    #: The largest drifts of all rows; of energy none is known.
    drift: Drift
    #: What made the steps.
    backend: str
    #: The names of the columns.
    columns: list[str]
    #: The time at the start, the step size used, and how many steps were made.
    t0: float
    step: float
    steps: int
    #: K.
    truncation: int
    #: What was chosen: the step for a tolerance, a step that divides the time.
    notes: list[str]

    _FACTS = ("failed", "drift", "backend", "columns", "t0", "step", "steps", "truncation", "notes")

    def __getattr__(self, name: str) -> Any:
        if name in States._FACTS:
            text = f"`{name}` belongs to the whole ensemble: it is known neither of a part nor of what is computed from it"
            raise AttributeError(text)
        raise AttributeError(f"an ensemble has no attribute {name!r}")

    def copy(self, order: Any = "C") -> States:
        """A copy that knows the same."""
        found = super().copy(order)
        found.__dict__.update(self.__dict__)
        return found

    def __copy__(self) -> States:
        return self.copy()

    def __deepcopy__(self, memo: Any) -> States:
        return self.copy()

    @classmethod
    def _of(cls, array: Floats, failed: list[tuple[int, int, str]], facts: dict[str, Any]) -> States:
        states = array.view(cls)
        states.failed = [Failure(*row) for row in failed]
        drifts = [facts["spatial_momentum"], facts["casimirs"], None]
        whys = [_HIDDEN, facts["unknown_casimirs"], "ensembles measure none"]
        named = zip(_NAMES, drifts, whys, strict=True)
        states.drift = Drift(*(Unknown(f"drift of the {name}", why) if value is None else value for name, value, why in named))
        states.backend, states.columns = facts["backend"], facts["columns"]
        states.t0, states.step, states.steps = facts["t0"], facts["step"], facts["steps"]
        states.truncation = facts["truncation"]
        notes = [facts["choice"], facts["announcement"], *facts["notes"]]
        states.notes = [note for note in notes if note]
        return states

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        return array[()] if return_scalar else np.asarray(array)

    def __reduce__(self) -> Any:
        whole: Any = super().__reduce__()
        make, arguments, state = whole
        own = {name: getattr(self, name) for name in self._FACTS if hasattr(self, name)}
        return make, arguments, (state, own)

    def __setstate__(self, state: Any) -> None:
        state, own = state
        super().__setstate__(state)
        self.__dict__.update(own)

    @property
    def ok(self) -> NDArray[np.bool_]:
        """Which rows have an end state, (N,)."""
        found: NDArray[np.bool_] = np.logical_not(np.isnan(np.asarray(self)).any(axis=-1))
        return found
