"""Systems: a Lie group, a Hamiltonian, and what can be done with them."""

from __future__ import annotations

import hashlib
import json
import math
import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, TypeGuard

import numpy as np

from . import _arrays, _core, _text
from ._arrays import Backend, Floats, Numbers, Real, Rotation
from ._progress import Progress, listener
from .errors import CoadjointWarning, InputError
from .lattice import Lattice, lattice
from .results import Run, States
from .stepper import Stepper, held

if TYPE_CHECKING:
    import sympy

__all__ = ["EventFunction", "Law", "Laws", "System", "Verdict"]

#: The function of an event: of the time, the matrix g and the momentum μ.
EventFunction = Callable[[float, Floats, Floats], Real]
#: An energy H(t, μ), and its gradient ∂H/∂μ, as functions of the time and the momentum.
Energy = Callable[[float, Floats], Real]
Gradient = Callable[[float, Floats], Numbers]
#: A velocity or a torque, a function of the time, the matrix g and the momentum μ; and what may be given as one.
Push = Callable[[float, Floats, Floats], Numbers]
Acting = Iterable["str | sympy.Expr"] | Push
#: An input u(t), a function of the time.
Input = Callable[[float], Real]


class System:
    """A Hamiltonian system on the dual of a Lie algebra, and on the cotangent bundle of its group.

    ``group`` is a name such as ``"SO3"``, ``"SE3"``, ``"SO3^8"`` or ``"SO3 |x R3"``, or a dictionary with a ``basis`` of
    matrices, or ``generators`` and ``brackets``. ``hamiltonian`` is text or a SymPy expression in the ``coordinates`` of the
    body momentum: a polynomial, whose steps are made by a series, or any other smooth function (roots, quotients, exp, ln,
    sin, …), whose steps are made by collocation. Numbers are taken as their decimals, exactly: 0.1 is one tenth.
    It may also be a function of (t, μ), with its ``gradient``, another one, which is checked against it once; neither may depend on t.
    ``inputs`` are functions of the time, which H, a velocity and a torque name: lists of values at ``times``, or functions of t.

    The other arguments are the keys of a system file: ``truncation`` K (odd; the method has order K + 1), ``chart``
    (``"exp"`` or ``"cayley"``), ``frame`` (``"auto"``, ``"fixed"`` or ``"comoving"``), ``solver``, ``method`` (``"series"`` or
    ``"collocation"``, if it is not to follow from the Hamiltonian), and for a ``potential`` V(g),
    a function of ``g[0][0]``, …, the ``splitting``. A ``velocity`` is added to ω = ∂H/∂μ, or takes its place where there is no
    Hamiltonian, and a ``torque`` to the change of μ: lists of functions of ``g[0][0]``, …, the coordinates, ``omega[0]``, …, ``t`` and the
    inputs, or one function of Python of (t, g, μ) each, with g as a matrix; steps are then made one by one. ``damping`` is that of the double bracket, a number or one for each coordinate. ``momentum``, ``group_element``, ``t0`` (the time at the start), ``step`` or ``tolerance``,
    ``region`` and ``time`` (the duration) are defaults of runs.

    >>> import numpy as np
    >>> import coadjoint as ca
    >>> fast = ca.System("SO3", lambda t, mu: np.sqrt(1 + mu @ mu), gradient=lambda t, mu: mu / np.sqrt(1 + mu @ mu))
    >>> fast.simulate([2, 0.5, 1], time=10, step=0.1).momentum[-1].round(12)
    array([2. , 0.5, 1. ])

    >>> body = ca.System("SO3", "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)", coordinates="x y z",
    ...                  parameters=dict(I1=1.5, I2=2, I3=2.5))
    >>> body
    System('SO3', 'x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)', coordinates='x y z', parameters={'I1': 1.5, 'I2': 2, 'I3': 2.5})
    >>> run = body.simulate(momentum=[2, 0.5, 1], time=100, step=0.1)
    >>> bool(run.largest_drift.spatial_momentum < 1e-13)
    True
    """

    def __init__(
        self,
        group: str | Mapping[str, Any],
        hamiltonian: str | sympy.Expr | Energy | None = None,
        *,
        gradient: Gradient | None = None,
        coordinates: str | Iterable[Any] | None = None,
        parameters: Mapping[str, Any] | None = None,
        inputs: Mapping[str, Any] | None = None,
        units: Mapping[str, str] | None = None,
        potential: str | sympy.Expr | None = None,
        velocity: Acting | None = None,
        torque: Acting | None = None,
        damping: Real | str | Numbers | None = None,
        truncation: int | None = None,
        chart: str | None = None,
        solver: str | None = None,
        frame: str | None = None,
        method: str | None = None,
        splitting: str | None = None,
        step: Real | str | None = None,
        tolerance: Real | str | None = None,
        region: Numbers | None = None,
        momentum: Numbers | None = None,
        group_element: Numbers | Rotation | None = None,
        t0: Real | str | None = None,
        time: Real | str | None = None,
        name: str = "system",
    ) -> None:
        if not isinstance(coordinates, (str, type(None))):
            coordinates = _arrays.listed(coordinates, "coordinates")
        arguments = [(key, value) for key, value in locals().items() if key not in ("self", "__class__")]
        name = _arrays.text(name, "name")
        acting = {key: own for key, own in (("velocity", velocity), ("torque", torque)) if callable(own)}
        velocity = None if velocity is None or callable(velocity) else _arrays.listed(velocity, "velocity")
        torque = None if torque is None or callable(torque) else _arrays.listed(torque, "torque")
        given = tuple(pair for pair in arguments if pair[1] is not None and pair != ("name", "system"))
        functions = _functions(hamiltonian, gradient)
        given_inputs = _text.mapping(inputs, "inputs")
        called_inputs = {k: v for k, v in given_inputs.items() if callable(v) and not hasattr(v, "free_symbols")}
        driving = (*(velocity or ()), *(torque or ()))
        known = _text.symbols(None if functions else hamiltonian, potential, *driving, *(coordinates or ()))
        called = [] if coordinates is None else _text.names(coordinates, "coordinates")
        shown = _text.mapping(units, "units")
        each: _arrays.Units = [shown.get(own, shown.get("momentum")) for own in called] or shown.get("momentum")

        def text(value: Any) -> str | None:
            return None if value is None else _text.quoted(str(value))

        def exact(value: Any, what: str, unit: _arrays.Units = None) -> str | None:
            return None if value is None else _text.numbers(_arrays.bare(value, what, unit), what)

        def formula(value: Any, what: str) -> str | None:
            return None if value is None else _text.quoted(_text.expression(value, what))

        def formulas(values: list[Any] | None, what: str) -> str | None:
            return None if values is None else _text.strings([_text.expression(own, what) for own in values])

        whole = isinstance(group, str)
        alone = functions or (hamiltonian is None and (velocity is not None or "velocity" in acting))
        top = {
            "name": text(name),
            "group": text(group) if whole else None,
            "coordinates": _text.strings(called) if called else None,
            "hamiltonian": None if alone else formula("" if hamiltonian is None else hamiltonian, "hamiltonian"),
            "potential": formula(potential, "potential"),
            "velocity": formulas(velocity, "velocity"),
            "torque": formulas(torque, "torque"),
            "damping": exact(damping, "damping"),
        }
        tables = {
            "algebra": {} if whole else _text.algebra(group),
            "parameters": {k: exact(v, f"parameter {k}") for k, v in _text.mapping(parameters, "parameters").items()},
            "inputs": {k: exact(v, f"inputs {k}") for k, v in given_inputs.items() if k not in called_inputs},
            "units": {k: text(v) for k, v in shown.items()},
            "integrator": {
                "truncation": exact(truncation, "truncation"),
                "chart": text(chart),
                "solver": text(solver),
                "frame": text(frame),
                "method": text(method),
                "splitting": text(splitting),
                "step": exact(step, "step", shown.get("time")),
                "tolerance": exact(tolerance, "tolerance"),
                "region": exact(region, "region", each),
            },
            "initial": {
                "time": exact(t0, "t0", shown.get("time")),
                "momentum": exact(momentum, "momentum", each),
                "group_element": exact(_arrays.rotated(group_element), "group_element"),
            },
            "run": {"time": exact(time, "time", shown.get("time"))},
        }
        lines = _text.table(None, top)
        for title, entries in tables.items():
            lines += _text.table(title, entries)
        self._read("\n".join(lines) + "\n", name, given, known, functions, called_inputs, acting)

    @classmethod
    def from_text(cls, text: str, name: str = "system") -> System:
        """The system of the text of a system file; ``name`` is what mistakes call it.

        >>> import coadjoint as ca
        >>> ca.System.from_text('group = "SO3"\\nhamiltonian = "mu[0]^2"').group
        'SO3'
        """
        return _restored(cls, _arrays.text(text, "text"), _arrays.text(name, "name"), None, {}, None, {}, {})

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> System:
        """The system of a file, in TOML."""
        return cls.from_text(_core.read_text(path), os.fspath(path))

    @staticmethod
    def lattice(
        shape: Sequence[int] | None = None,
        group: str = "SO3",
        *,
        bonds: Mapping[Any, Any],
        site: str | None = None,
        kind: str | None = None,
        boundary: str | Sequence[str] | None = None,
        edges: Any = None,
        parameters: Mapping[str, Any] | None = None,
        velocity: Sequence[str] | str | None = None,
        damping: Real | str | Numbers | None = None,
        name: str = "lattice",
    ) -> Lattice:
        """Spins on a lattice, of any number, with one energy over its edges.

        ``bonds`` has a 3 × 3 matrix M of the energy a·M b, or an energy as text such as ``"-J*dot(a, b)"``, for each offset of the
        cells of its two spins, or for (offset, from, to) with the numbers of the sites in these cells; with ``edges``, rows (i, j) or
        (i, j, type), for each type, or for None. ``site`` is the energy of a site in x, y and z. ``kind`` is ``"cubic"``,
        ``"triangular"``, ``"honeycomb"`` or ``"kagome"``, ``boundary`` ``"periodic"`` or ``"open"``, or one of them an axis. Arrays of more
        than 16 numbers among ``parameters`` are tables with one number a site. ``damping`` is Gilbert's, and ``velocity``, three texts or
        a vector, is added to ω = ∂H/∂s of each site: functions of x, y, z, ``omega[0]``, …, tables and t.

        >>> import coadjoint as ca, numpy as np
        >>> cube = ca.System.lattice([4, 4, 4], bonds={(1, 0, 0): -np.eye(3), (0, 1, 0): "-dot(a, b)"}, site="D*z^2",
        ...                          parameters=dict(D=np.linspace(0, 1, 64)))
        >>> run = cube.simulate(np.ones((64, 3)), time=1, step=0.1, splitting="bonds")
        >>> run.method
        'bonds, order 6'
        """
        return lattice(
            shape, group=group, bonds=bonds, site=site, kind=kind, boundary=boundary, edges=edges, parameters=parameters,
            velocity=velocity, damping=damping, name=name,
        )

    def _read(
        self,
        text: str,
        name: str,
        given: tuple[tuple[str, Any], ...] | None,
        known: dict[str, Any],
        functions: tuple[Energy, Gradient] | None,
        inputs: dict[str, Input],
        acting: dict[str, Push],
        core: _core.Core | None = None,
    ) -> None:
        self._text_, self._name, self._given, self._known = text, name, given, known
        self._functions, self._inputs, self._acting = functions, inputs, acting
        self._core = _core.Core(text, name, functions, list(inputs.items()), **acting) if core is None else core
        self._facts = self._core.facts()
        self._steppers: dict[tuple[float | None, str, tuple[str, ...]], _core.Stepper] = {}

    # Facts.

    @property
    def text(self) -> str:
        """The text of the system file: the command `coadjoint` reads it too."""
        return self._text_

    @property
    def name(self) -> str:
        """The system's name."""
        return str(self._facts["name"])

    @property
    def group(self) -> str:
        """The group's name."""
        return str(self._facts["group"])

    @property
    def dimension(self) -> int:
        """n, the number of coordinates of the momentum."""
        return int(self._facts["dimension"])

    @property
    def matrix_size(self) -> int:
        """d: group elements are matrices of d rows and columns."""
        return int(self._facts["matrix_size"])

    @property
    def coordinates(self) -> list[str]:
        """The names of the momentum's coordinates."""
        return list(self._facts["coordinates"])

    @property
    def truncation(self) -> int:
        """K: S₁ … S_K are kept; where the system has a tolerance, the K that it asks for."""
        if self._facts["tolerance"] is None or self._facts["truncation_given"]:
            return int(self._facts["truncation"])
        return self._chosen

    @cached_property
    def _chosen(self) -> int:
        found = self._core.choice()
        return int(self._facts["truncation"]) if found is None else found[0]

    @property
    def chart(self) -> str | None:
        """``"exp"`` or ``"cayley"``; None where steps are made by collocation, in the chart of the group."""
        chart: str | None = self._facts["chart"]
        return chart

    @property
    def hamiltonian(self) -> sympy.Expr:
        """The Hamiltonian with the values of the parameters put in, exactly, as SymPy (needs sympy).

        >>> import coadjoint as ca
        >>> ca.System("SO3", "x^2/(2*I)", coordinates="x y z", parameters=dict(I=1.5)).hamiltonian
        x**2/3
        """
        import sympy

        from . import _sympy

        if self._functions:
            raise InputError("the Hamiltonian is a function of Python, and no expression")
        values = {name: sympy.Rational(text) for name, text in self._facts["parameters"].items()}
        return _sympy.polynomial(self._facts["hamiltonian"], {**self._symbols, **values})

    @property
    def _symbols(self) -> dict[str, sympy.Expr]:
        """The coordinates as SymPy: the symbols that were given, with their assumptions, else plain ones."""
        import sympy

        return {name: self._known.get(name, sympy.Symbol(name)) for name in self.coordinates}

    @cached_property
    def identity(self) -> str:
        """A hash of the text and of this version: where it is the same, results have the same bits."""
        self._plain("has no hash")
        inputs = self._facts["inputs_sha256"] or ""
        return hashlib.sha256(f"coadjoint {_core.__version__}\n{inputs}{self._text_}".encode()).hexdigest()

    def layouts(self) -> list[list[str]]:
        """The columns that rows of an ensemble may have: momenta alone, with matrices, with quaternions.

        >>> import coadjoint as ca
        >>> ca.System("SO3", "x^2", coordinates="x y z").layouts()[0]
        ['mu_1', 'mu_2', 'mu_3']
        """
        return self._core.layouts()

    # Runs.

    def simulate(
        self,
        momentum: Numbers | None = None,
        *,
        t0: Real | None = None,
        time: Real | None = None,
        step: Real | None = None,
        tolerance: Real | None = None,
        region: Real | None = None,
        group_element: Numbers | Rotation | None = None,
        truncation: int | None = None,
        every: int | None = None,
        at: Numbers | None = None,
        events: EventFunction | Sequence[EventFunction] = (),
        looks: int | None = None,
        parameters: Mapping[str, Any] | None = None,
        backend: Backend = "auto",
        estimate: bool = True,
        progress: bool | Progress | None = None,
    ) -> Run:
        """One trajectory from this momentum (n,) and group element (d, d), the identity if none is given.

        The momentum is a list in the order of the coordinates, or a Series or dictionary by their names. The group
        element is a matrix or, for rotations, a SciPy ``Rotation`` or a quaternion w, x, y, z. Quantities of astropy,
        pint and unyt are converted to the system's ``units``, or refused.

        The run starts at the time ``t0`` (0, or what the system says, if not given), of which H, torques, inputs and events are
        functions, and goes on for ``time``, exactly; steps are of size ``step`` or a little less. ``tolerance`` picks the step (and
        the truncation, unless it is given) for this error at the end, along the run or for momenta up to the norm
        ``region``. Every ``every``-th step is recorded, or the times ``at`` (alone, if ``every`` is not given).
        ``backend`` is ``"auto"``, ``"jit"``, ``"c"`` or ``"interpreter"``: the numbers have the same bits.
        ``estimate=False`` leaves out :attr:`Run.estimated_error`, which takes about half as long as the run.
        ``progress`` is True, False, or a function of (done, total); if not given, a bar where somebody looks on.

        ``events`` are functions of (t, g, μ), as SciPy's ``solve_ivp`` has them: :attr:`Run.events` gives the moments at
        which one changes its sign; an attribute ``direction`` above or below 0 keeps only changes upwards or downwards, an
        attribute ``terminal = True`` ends the run there. A function is called after every step, and at the ends of
        ``looks`` equal parts of it (1, or what the system says): two changes within one part are not seen. The events of
        the system's own text come first.

        ``parameters`` are values of some of the system's for this run: what was derived and compiled for other values of the same
        parameters is used again.

        Raises :class:`InputError` for what makes no sense and :class:`RunError` where the run stops.

        >>> import coadjoint as ca
        >>> body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
        >>> run = body.simulate([2, 0.5, 1], time=20, tolerance=1e-8, at=[5, 10, 20])
        >>> run.time
        array([ 5., 10., 20.])
        >>> def upright(t, g, mu):
        ...     return g[2, 2]
        >>> body.simulate([2, 0.5, 1], time=5, step=0.1, events=upright).events[0].time.round(4)
        array([1.1718, 3.3151])
        """
        source = self if parameters is None else self._with(parameters)
        start, element = self._state(momentum, group_element)
        times = self._times(at, step)
        watched = _events(events)
        parts = None if looks is None else _arrays.count(looks, "looks", 1)
        if parts is not None and parts > 1000:
            raise InputError(f"looks={looks}: a step is cut into 1000 parts at most; take a smaller step")
        with listener(progress, "integrating") as told:
            found = source._core.simulate(
                self._asked(t0, time, step, tolerance, region, truncation),
                momentum=start,
                group_element=element,
                every=None if every is None else _arrays.count(every, "every", 1),
                at=times,
                events=watched,
                looks=parts,
                backend=_arrays.text(backend, "backend"),
                estimate=_arrays.flag(estimate, "estimate"),
                record=True,
                progress=told,
            )
        for text in found["warnings"]:
            warnings.warn(text, CoadjointWarning, stacklevel=2)
        found["start"] = {
            "momentum": None if start is None else start.tolist(),
            "group_element": None if element is None else element.tolist(),
            "backend": backend,
        }
        found["ended_by"] = _ended_by(found, watched)
        return Run(found, source)

    def _with(self, parameters: Mapping[str, Any]) -> System:
        """This system with other values of some of its parameters; both use what was derived and compiled for one of them."""
        given = _text.mapping(parameters, "parameters")
        values = [(_arrays.text(name, "parameters"), _arrays.floats(own, f"parameters[{name!r}]").ravel().tolist()) for name, own in given.items()]
        core, text = self._core.with_parameters(values)
        return _restored(type(self), text, self._name, None, self._known, self._functions, self._inputs, self._acting, core)

    def _times(self, at: Numbers | None, step: Real | None) -> Floats | None:
        """The times of ``at``, which must be in the order in which steps of this size reach them."""
        if at is None:
            return None
        times = np.atleast_1d(_arrays.floats(at, "at", unit=self._facts["time_unit"]))
        size = self._facts["step"] if step is None else _arrays.real(step, "step", self._facts["time_unit"])
        backwards = size is not None and size < 0
        if times.ndim != 1 or (np.diff(-times if backwards else times) <= 0).any():
            raise InputError("at must be a list of times in the order of the run, each once: sort them")
        return times

    def ensemble(
        self,
        states: Numbers,
        *,
        t0: Real | None = None,
        time: Real | None = None,
        step: Real | None = None,
        tolerance: Real | None = None,
        region: Real | None = None,
        truncation: int | None = None,
        inputs: Mapping[str, Numbers] | None = None,
        at: Numbers | None = None,
        backend: Backend = "auto",
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> States:
        """Many trajectories: from states, a row each, to the states at the end, over the time ``time`` from ``t0`` on.

        A row is a momentum, (N, n), or a momentum and the entries of the matrix g row by row, (N, n + d²), or, for
        SO(3), a momentum and a unit quaternion w, x, y, z, (N, n + 4). Data frames, dictionaries and other tables go by
        the names of :meth:`layouts`, or of the coordinates, in any order; a column named after a parameter, or a number of
        it such as ``J[0][1]``, gives each row a value of its own. ``inputs`` gives each row samples of its own for the name of an input,
        (N, samples), at the times of the system's. The result has the columns of an array; rows that
        cannot be followed (NaN among them) are NaN, listed in ``failed``, and told by a warning. With times ``at`` the result
        is that of the trajectories there, (N, times, columns); of a row that fails on its way, from there on NaN. The bits depend
        neither on ``threads`` nor on ``backend``, nor on the other rows.

        >>> import coadjoint as ca, numpy as np
        >>> body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
        >>> final = body.ensemble(np.ones((1000, 3)), time=10, step=0.1)
        >>> final.shape, final.failed
        ((1000, 3), [])
        >>> body.ensemble(np.ones((10, 3)), time=10, step=0.1, at=[0, 2.5, 10]).shape
        (10, 3, 3)
        """
        times = self._times(at, step)
        rows, parameters = self._rows(states)
        sampled = {k: _arrays.floats(v, f"inputs[{k!r}]") for k, v in _text.mapping(inputs, "inputs").items()}
        if rows.ndim != 2:
            raise InputError(
                f"states must be a table with a row for each state; its shape is {rows.shape}: "
                f"write states[np.newaxis] for a single one"
            )
        with listener(progress, "trajectories") as told:
            array, failed, facts = self._core.ensemble(
                rows,
                self._asked(t0, time, step, tolerance, region, truncation),
                parameters=parameters,
                inputs=[(name, own.shape, own.ravel()) for name, own in sampled.items()],
                at=times,
                backend=_arrays.text(backend, "backend"),
                threads=None if threads is None else _arrays.count(threads, "threads", 1),
                progress=told,
            )
        if parameters:
            array = np.ascontiguousarray(array[:, : -len(parameters)])
        if times is not None:
            array = array.reshape(len(rows), len(times), array.shape[1])
        found = States._of(array, failed, facts)
        if failed:
            row, number, reason = failed[0]
            where = f"step {number}: " if number else ""
            text = f"{len(failed)} of {len(rows)} rows have no end state and are NaN; the first is row {row}, {where}{reason}"
            warnings.warn(text, CoadjointWarning, stacklevel=2)
        if facts["ratio"]:
            warnings.warn(hardly_converges(facts["ratio"]), CoadjointWarning, stacklevel=2)
        for text in facts["warnings"]:
            warnings.warn(text, CoadjointWarning, stacklevel=2)
        return found

    def step(
        self,
        momentum: Numbers,
        group_element: Numbers | Rotation | None = None,
        *,
        t0: Real | None = None,
        step: Real | None = None,
        steps: int = 1,
        parameters: Mapping[str, Any] | None = None,
        backend: Backend = "jit",
    ) -> tuple[Floats, Floats]:
        """The state after one step (or `steps` of them): the momentum (n,) and the group element (d, d).

        ``parameters`` are values of some of the system's, for these steps: what a control loop holds until its next sample. Nothing
        is derived or compiled anew for them.

        ``t0`` is the time of the state given, which is needed where H, a torque or an input depends on it. The first call for a
        step size compiles it; the next ones take microseconds.

        >>> import coadjoint as ca
        >>> body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
        >>> mu, g = body.step([2, 0.5, 1], step=0.1)
        >>> mu, g = body.step(mu, g, step=0.1)
        >>> (g @ mu).round(12)
        array([2. , 0.5, 1. ])
        >>> driven = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5 + sin(t)*x", coordinates="x y z")
        >>> mu, g = driven.step([2, 0.5, 1], step=0.1, t0=0)
        >>> mu, g = driven.step(mu, g, step=0.1, t0=0.1)
        >>> steered = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z", torque=["u[0]", "u[1]", "u[2]"],
        ...                     parameters=dict(u=[0, 0, 0]))
        >>> mu, g = steered.step([2, 0.5, 1], step=0.1, steps=10, parameters=dict(u=[0, 0.2, 0]))
        """
        names = () if parameters is None else tuple(_text.mapping(parameters, "parameters"))
        stepper = self._stepper(step, backend, names)
        values = None if not names or parameters is None else held(stepper.parameters, parameters)
        if type(steps) is not int or not 0 <= steps < 2**63:
            steps = _arrays.count(steps, "steps")
        t0 = self._time(t0)
        # Results of the last call are taken as they are; the extension checks the numbers as it copies them.
        if _ready(momentum, 1) and (group_element is None or _ready(group_element, 2)):
            return stepper.advance(momentum, group_element, t0, steps, values)
        mu, element = self._state(momentum, group_element)
        if mu is None:
            raise InputError("momentum is missing: give momentum=[…]")
        return stepper.advance(mu, element, t0, steps, values)

    def _stepper(self, step: Real | None, backend: Backend, names: tuple[str, ...]) -> _core.Stepper:
        """Steps of this size, which are given the parameters with these names."""
        size = self._facts["step"] if step is None else step
        if size is None and self._facts["tolerance"] is None:
            raise InputError("step is missing: give step=0.1")
        if size is not None and type(size) is not float or type(backend) is not str:
            size = _arrays.real(size, "step", self._facts["time_unit"])
            _arrays.text(backend, "backend")
        key = (size, backend, names)
        stepper = self._steppers.get(key)
        if stepper is None:
            stepper = self._steppers[key] = self._core.stepper(size, backend, list(names))
        return stepper

    def _time(self, t0: Real | None) -> float:
        """The time of a state."""
        if t0 is None:
            if self._facts["moves"]:
                raise InputError("t0 is missing: the system depends on time; give t0=, the time of this state")
            return 0.0
        return t0 if type(t0) is float and math.isfinite(t0) else _arrays.real(t0, "t0", self._facts["time_unit"])

    def stepper(
        self,
        momentum: Numbers,
        group_element: Numbers | Rotation | None = None,
        *,
        t0: Real | None = None,
        step: Real | None = None,
        parameters: Iterable[str] = (),
        backend: Backend = "jit",
    ) -> Stepper:
        """A state that goes on by steps of one size, as in a control loop: it keeps the time, and what steps leave to the next ones.

        ``parameters`` are the names of those that each call of :meth:`Stepper.advance` gives.

        >>> import coadjoint as ca
        >>> steered = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z", torque=["u[0]", "u[1]", "u[2]"],
        ...                     parameters=dict(u=[0, 0, 0]))
        >>> loop = steered.stepper([2, 0.5, 1], step=0.01, parameters=["u"])
        >>> for _ in range(3):
        ...     loop.advance(10, u=-0.1 * loop.momentum)
        >>> loop.time
        0.3
        """
        names = (parameters,) if isinstance(parameters, str) else tuple(parameters)
        made = self._stepper(step, backend, tuple(_arrays.text(name, "parameters") for name in names))
        mu, element = self._state(momentum, group_element)
        if mu is None:
            raise InputError("momentum is missing: give momentum=[…]")
        return Stepper(made, made.begin(mu, element, self._time(t0)))

    # Algebra.

    def casimirs(self, degree: int = 3) -> list[sympy.Expr]:
        """Generators of the polynomial Casimirs up to this degree, as SymPy.

        >>> import coadjoint as ca
        >>> ca.System("SO3", "x^2", coordinates="x y z").casimirs()
        [x**2 + y**2 + z**2]
        """
        from . import _sympy

        found = self._core.casimirs(_arrays.count(degree, "degree"))
        return [_sympy.polynomial(text, self._symbols) for text in found]

    def series(self, k: int | None = None, *, truncation: int | None = None) -> Any:
        """The exact generating function: S_k as a SymPy expression, or without ``k`` a dictionary of S₁, S₃, …

        >>> import coadjoint as ca
        >>> body = ca.System("SO3", "x^2/2 + y^2/4", coordinates="x y z")
        >>> body.series(1)
        x**2/2 + y**2/4
        >>> body.series(3)
        x**2*z**2/48 + y**2*z**2/96
        """
        from . import _sympy

        if k is not None:
            k = _arrays.count(k, "k", 1)
            if k % 2 == 0:
                return _sympy.polynomial("0", {})
        wanted = _odd(truncation if truncation is not None else k or self.truncation)
        if k is not None and k > wanted:
            raise InputError(f"k={k} is beyond truncation={wanted}: leave truncation out, or give truncation={k}")
        found = _sympy.series(self._core.series("json", wanted), self._symbols)
        return found if k is None else found[k]

    def latex(self, *, truncation: int | None = None) -> str:
        """The Hamiltonian and the exact series as an ``align`` environment of LaTeX."""
        return self._core.series("latex", None if truncation is None else _odd(truncation))

    def check(
        self, *, step: Real | None = None, t0: Real | None = None, points: int = 3, seed: int = 1
    ) -> Laws:
        """The laws of the method, tried on this system at random points near its run, from the time ``t0`` on.

        >>> import coadjoint as ca
        >>> laws = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z").check()
        >>> bool(laws), laws["momentum"].holds
        (True, True)
        """
        size = None if step is None else _arrays.real(step, "step", self._facts["time_unit"])
        start = None if t0 is None else _arrays.real(t0, "t0", self._facts["time_unit"])
        found, warning = self._core.check(size, start, _arrays.count(points, "points"), _arrays.count(seed, "seed"))
        if warning:
            warnings.warn(warning, CoadjointWarning, stacklevel=2)
        return Laws([Law(*law) for law in found])

    def verify(self, run: Run | States, states: Numbers | None = None) -> Verdict:
        """Judges a run afterwards, step by step in doubled precision; or an ensemble, with the ``states`` it started from.

        >>> import coadjoint as ca
        >>> body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
        >>> bool(body.verify(body.simulate([2, 0.5, 1], time=2, step=0.1)))
        True
        """
        if isinstance(run, States):
            if states is None:
                raise InputError("states are missing: give those that the ensemble started from")
            if not hasattr(run, "steps"):
                raise InputError("a part of an ensemble does not know its step: verify the whole one")
            starts = self._table(states)
            if starts.shape != run.shape:
                raise InputError(f"the states have the shape {starts.shape}; the ensemble has {run.shape}")
            rows, names, steps, truncation = np.ascontiguousarray(run), [], run.steps, run.truncation
            refused = [failure.row + 1 for failure in run.failed]
        else:
            if not isinstance(run, Run) or run.truncation is None:
                raise InputError("only runs and ensembles of systems are judged")
            starts, steps, truncation, refused = None, 0, run.truncation, []
            rows, names = run._table(), run._found["columns"]
        found = self._core.verify(
            np.ascontiguousarray(rows),
            names,
            starts=starts,
            t0=run.t0,
            steps=steps,
            step=run.step,
            truncation=truncation,
            refused_rows=refused,
        )
        return Verdict(json.loads(found))

    def emit(
        self,
        language: str = "rust",
        *,
        prefix: str | None = None,
        step: Real | None = None,
        single: bool = False,
    ) -> str:
        """The integrator as code: ``"rust"``, a header of ``"c"`` or ``"cpp"``, a kernel of ``"opencl"`` or ``"cuda"``.

        ``prefix`` begins all names in a header; a kernel is for one ``step``, in ``single`` or double precision.

        >>> import coadjoint as ca
        >>> code = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z").emit("c", prefix="body")
        >>> "body_advance" in code or "body_step" in code
        True
        """
        language, single = _arrays.text(language, "language"), _arrays.flag(single, "single")
        if prefix is not None and _arrays.text(prefix, "prefix") and language not in ("c", "cpp"):
            raise InputError("prefix is for language=\"c\" and \"cpp\" alone")
        if (step is not None or single) and language not in ("opencl", "cuda"):
            raise InputError("step and single are for language=\"opencl\" and \"cuda\" alone")
        size = None if step is None else _arrays.real(step, "step", self._facts["time_unit"])
        return self._core.emit(language, prefix, size, single)

    # Python's own.

    def _plain(self, lacks: str) -> None:
        """Refuses functions of Python, with which the system ``lacks`` something."""
        if self._functions:
            raise InputError(f"a system whose Hamiltonian is a function {lacks}: give it as an expression")
        if self._acting:
            raise InputError(f"a system whose {next(iter(self._acting))} is a function {lacks}: give it as expressions")
        if self._inputs:
            first = next(iter(self._inputs))
            raise InputError(f"a system with the function {first} as an input {lacks}: give its values at times")

    def _asked(
        self,
        t0: Real | None,
        time: Real | None,
        step: Real | None,
        tolerance: Real | None,
        region: Real | None,
        truncation: int | None,
    ) -> dict[str, Any]:

        def real(value: Any, what: str, unit: _arrays.Units = None) -> float | None:
            return None if value is None else _arrays.real(value, what, unit)

        if time is None and self._facts["time"] is None:
            raise InputError("time is missing: give time=100")
        if step is None and tolerance is None and self._facts["step"] is None and self._facts["tolerance"] is None:
            raise InputError("step is missing: give step=0.1, or tolerance=1e-9 to have it chosen")
        return {
            "t0": real(t0, "t0", self._facts["time_unit"]),
            "time": real(time, "time", self._facts["time_unit"]),
            "step": real(step, "step", self._facts["time_unit"]),
            "tolerance": real(tolerance, "tolerance"),
            "region": real(region, "region", self._facts["units"]),
            "truncation": None if truncation is None else _arrays.count(truncation, "truncation"),
            "frame": None,
        }

    def _find(self, names: list[str]) -> tuple[list[int | None], list[str]]:
        found, places, others, varied = self._core.columns(names, len(names))
        if varied:
            raise InputError(f"column {found[-1]} is a parameter of the system; only the rows of an ensemble have their own")
        return places, others

    def _rows(self, states: Any) -> tuple[Floats, list[str]]:
        """The rows of an ensemble, and the parameters that their last columns are."""
        parameters: list[str] = []

        def find(names: list[str]) -> tuple[list[int | None], list[str]]:
            found, places, others, varied = self._core.columns(names, len(names))
            parameters.extend(found[len(found) - varied :])
            return places, others

        return _arrays.table(states, "states", find, self._facts["units"]), parameters

    def _table(self, states: Any) -> Floats:
        return _arrays.table(states, "states", self._find, self._facts["units"])

    def _state(self, momentum: Any, group_element: Any) -> tuple[Floats | None, Floats | None]:
        if momentum is None:
            return None, None if group_element is None else _arrays.element(group_element, self.matrix_size)
        return _arrays.state(momentum, group_element, self._find, self._facts["units"], self.matrix_size)

    def __reduce__(self) -> Any:
        parts = self._text_, self._name, self._given, self._known, self._functions, self._inputs, self._acting
        return _same, (self._facts["inputs_sha256"], type(self), *parts)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, System):
            return NotImplemented
        mine, others = self._facts["inputs_sha256"], other._facts["inputs_sha256"]
        mine_called = self._functions, self._inputs, self._acting
        functions = mine_called == (other._functions, other._inputs, other._acting)
        return functions and (self._text_, mine) == (other._text_, others)

    def __hash__(self) -> int:
        return hash(self._text_)

    def __repr__(self) -> str:
        if self._given is None:
            return f"System.from_text(…, name={self._name!r})"
        given = dict(self._given)
        first = [repr(given.pop("group")), repr(str(given.pop("hamiltonian")))]
        return f"System({', '.join(first + [f'{key}={_arrays.shown(value)}' for key, value in given.items()])})"

    def _repr_html_(self) -> str:
        from ._html import system

        return system(self)


class Law(NamedTuple):
    """A law of the method, and how well it holds."""

    #: Its name, and what it says.
    name: str
    statement: str
    #: What was measured, and what it is compared with.
    value: float
    bound: float
    #: None where it could not be measured.
    holds: bool | None

    def __repr__(self) -> str:
        if self.holds is None:
            return f"{self.name:<12} not measured"
        verdict = "holds" if self.holds else "FAILS"
        relation = ">=" if self.name.startswith("order") else "<="
        return f"{self.name:<12} {self.value:9.2g} {relation} {self.bound:<7.2g} {verdict}   {self.statement}"


class Laws:
    """The laws that were tried; true if none was found not to hold."""

    def __init__(self, laws: list[Law]) -> None:
        self._laws = laws

    def __bool__(self) -> bool:
        return all(law.holds is not False for law in self._laws)

    def __iter__(self) -> Iterator[Law]:
        return iter(self._laws)

    def __len__(self) -> int:
        return len(self._laws)

    def __getitem__(self, name: str) -> Law:
        for law in self._laws:
            if law.name == name:
                return law
        raise KeyError(f"{name!r}; there are {', '.join(law.name for law in self._laws)}")

    def __repr__(self) -> str:
        return "\n".join(map(repr, self._laws))


class Verdict:
    """The result of a judgement; true if every row was judged and none is wrong."""

    def __init__(self, found: dict[str, Any]) -> None:
        #: In a few words.
        self.text: str = found["verdict"]
        #: What is wrong with the first wrong row.
        self.wrong: str | None = found.get("wrong")
        #: How many rows could not be judged, and why the first of them.
        self.not_judged: int = found["not_judged"]
        self.why: str | None = found.get("why_not_judged")
        #: Rows judged, and the steps between them.
        self.rows: int = found["rows"]
        self.steps: int = found["steps"]
        #: The largest deviations from the exact step, each over what rounding may do.
        self.momentum: float | None = found.get("momentum")
        self.group_element: float | None = found.get("group_element")

    def __bool__(self) -> bool:
        return self.wrong is None and self.not_judged == 0

    def __repr__(self) -> str:
        more = self.wrong or self.why
        return f"<Verdict: {self.text}{': ' + more if more else ''}; {self.rows} rows, {self.steps} steps>"


def _functions(energy: Any, gradient: Any) -> tuple[Energy, Gradient] | None:
    """The energy and its gradient, where they are functions."""
    if callable(energy) and callable(gradient):
        return energy, gradient
    if gradient is not None:
        raise InputError("gradient is a function of the time and the momentum, beside a Hamiltonian that is one too")
    if callable(energy) and not hasattr(energy, "free_symbols"):
        raise InputError("a Hamiltonian that is a function needs its gradient: give gradient=…, a function of (t, mu)")
    return None


def _events(given: Any) -> list[tuple[str, Callable[..., float], int, bool]]:
    """Name, function, sign of the direction, and whether it ends the run, of each event."""
    found = []
    for function in [given] if callable(given) else _arrays.listed(given, "events"):
        if not callable(function):
            raise InputError(f"an event is a function of the time, g and μ, not {_arrays.shown(function)}")
        name = getattr(function, "__name__", type(function).__name__)
        direction = _arrays.real(getattr(function, "direction", 0), f"the direction of {name}")
        found.append((name, function, int(np.sign(direction)), bool(getattr(function, "terminal", False))))
    return found


def _ended_by(found: dict[str, Any], watched: list[Any]) -> tuple[Any, int, float] | None:
    """The event that ended a run: itself where it is a function of Python, its number, and its time."""
    if not found["events"]:
        return None
    number, time = found["events"][-1][:2]
    own = number - (found["watched"] - len(watched))
    return (watched[own] if own >= 0 else None, number, time) if found["terminal"][number] else None


def hardly_converges(ratio: float) -> str:
    """The warning of an ensemble in which the last two terms of the series have this ratio."""
    return (
        f"the series hardly converges for some rows: its terms have the ratio {ratio:.3f}, above 0.25; "
        "the motion may be inaccurate: take a smaller step"
    )


def of_core(core: _core.Core, text: str, name: str) -> System:
    """The system of an extension's object; ``text`` is what it was made of."""
    return _restored(System, text, name, None, {}, None, {}, {}, core)


def _restored(kind: type[System], *parts: Any) -> System:
    system = kind.__new__(kind)
    system._read(*parts)
    return system


def _same(inputs: str | None, kind: type[System], *parts: Any) -> System:
    """A system as it was pickled."""
    system = _restored(kind, *parts)
    if system._facts["inputs_sha256"] != inputs:
        raise InputError(f"{system._name}: the table of its inputs is another than it was when the system was pickled")
    return system


def _ready(array: Any, dimensions: int) -> TypeGuard[Floats]:
    """Whether this is an array that the extension takes as it is."""
    return type(array) is np.ndarray and array.dtype == np.float64 and array.ndim == dimensions


def _odd(truncation: Any) -> int:
    if (k := _arrays.count(truncation, "truncation")) % 2 == 0 or k > 63:
        raise InputError(f"truncation={k}: give an odd number from 1 to 63; the even terms vanish")
    return k
