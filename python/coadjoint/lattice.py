"""Lattices of classical spins: one energy over the edges of a graph, for any number of sites."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _arrays, _core, _text
from ._progress import Progress, listener
from .errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Lattice", "LatticeRun"]


@dataclass(frozen=True)
class LatticeRun:
    """A run of a lattice: the spins at its end, and what was recorded on the way."""

    spins: NDArray[np.float64]
    """The spins at the end, (sites, 3), in C order of the shape, the sites of a cell innermost."""
    time: NDArray[np.float64]
    """The times of the records."""
    magnetisation: NDArray[np.float64]
    """The mean spin at these times, (records, 3)."""
    energy: NDArray[np.float64]
    """The energy at these times."""
    sites: NDArray[np.float64]
    """The spins of the chosen sites at these times, (records, sites, 3)."""
    method: str
    """The family of rotations and its order, or collocation."""
    step: float
    steps: int
    length_drift: float
    """The largest relative change of the length of a spin."""
    estimated_error: float | None
    """The estimated relative error at the end, on a cut of at most 16 cells an axis."""


class Lattice:
    """A lattice of spins, by :meth:`System.lattice`."""

    def __init__(self, text: str, arrays: dict[str, NDArray[np.float64]]) -> None:
        self._text = text
        self._arrays = arrays

    @property
    def text(self) -> str:
        """The text of the system file, without the start and the integrator."""
        return self._text

    def simulate(
        self,
        spins: ArrayLike | str,
        *,
        time: float,
        step: float | None = None,
        tolerance: float | None = None,
        t0: float | None = None,
        splitting: str | None = None,
        method: str | None = None,
        truncation: int | None = None,
        seed: int = 1,
        every: int | None = None,
        sites: Sequence[int] = (),
        estimate: bool = True,
        progress: bool | Progress | None = None,
    ) -> LatticeRun:
        """Follows spins (sites, 3), or ``"random"`` ones by a ``seed``, for a time, in steps of a size or by a tolerance.

        ``splitting`` is ``"auto"``, ``"axes"``, ``"bonds"`` or ``"sublattices"``; ``method="collocation"`` takes Gauss's method in
        its place. Steps have the order ``truncation`` + 1. Every ``every``-th step is recorded,
        with the spins of the ``sites`` with these numbers.

        >>> import coadjoint as ca, numpy as np
        >>> ring = ca.System.lattice([8], bonds={(1,): -np.eye(3)}, site="-z/2")
        >>> run = ring.simulate("random", seed=3, time=2, step=0.1)
        >>> run.spins.shape, bool(run.length_drift < 1e-14)
        ((8, 3), True)
        """
        options = dict(splitting=splitting, method=method)
        integrator: dict[str, Any] = {
            key: None if own is None else _text.quoted(own) for key, own in options.items()
        }
        integrator["truncation"] = None if truncation is None else str(_arrays.count(truncation, "truncation", 1))
        arrays = dict(self._arrays)
        if isinstance(spins, str):
            initial = {"momentum": _text.quoted(spins), "seed": str(_arrays.count(seed, "seed", 0))}
        else:
            arrays["spins"] = np.asarray(spins, dtype=float)
            initial = {"momentum": '{ table = "spins" }'}
        recorded = {"sites": str([_arrays.count(site, "sites", 0) for site in sites])}
        lines = _text.table("integrator", integrator) + _text.table("initial", initial) + _text.table("run", recorded)
        asked = dict(
            step=step, tolerance=tolerance, region=None, truncation=None, t0=t0, time=float(time), frame=None
        )
        with listener(progress, "integrating") as told:
            found = _core.simulate_lattice(
                self._text + "\n".join(lines) + "\n",
                "lattice",
                arrays,
                asked,
                every=None if every is None else _arrays.count(every, "every", 1),
                estimate=estimate,
                progress=told,
            )
        return LatticeRun(**found)


def lattice(
    shape: Sequence[int] | None,
    *,
    group: str = "SO3",
    bonds: Mapping[Any, ArrayLike | str],
    site: str | None = None,
    kind: str | None = None,
    boundary: str | Sequence[str] | None = None,
    edges: ArrayLike | None = None,
    parameters: Mapping[str, Any] | None = None,
    velocity: Sequence[str] | str | None = None,
    damping: Any = None,
    name: str = "lattice",
) -> Lattice:
    """The lattice that these arguments describe, as :meth:`System.lattice` has it."""
    arrays: dict[str, NDArray[np.float64]] = {}
    if edges is not None:
        arrays["edges"] = np.asarray(edges, dtype=float)
    given = {}
    for key, value in _text.mapping(parameters, "parameters").items():
        if isinstance(value, np.ndarray) and value.size > 16:
            arrays[f"table {key}"] = np.asarray(value, dtype=float)
            given[key] = f'{{ table = "table {key}" }}'
        else:
            given[key] = _text.numbers(value, f"parameter {key}")
    words = None
    if boundary is not None:
        words = _text.quoted(boundary) if isinstance(boundary, str) else _text.strings(list(boundary))
    table = {
        "shape": None if shape is None else str([_arrays.count(length, "shape", 0) for length in shape]),
        "kind": None if kind is None else _text.quoted(kind),
        "boundary": words,
        "edges": None if edges is None else '"edges"',
        "site": None if site is None else _text.quoted(site),
    }
    top = {
        "name": _text.quoted(name),
        "group": _text.quoted(group),
        "damping": None if damping is None else _text.numbers(damping, "damping"),
        "velocity": None,
    }
    if velocity is not None:
        top["velocity"] = _text.quoted(velocity) if isinstance(velocity, str) else _text.strings(list(velocity))
    lines = _text.table(None, top) + _text.table("parameters", given) + _text.table("lattice", table)
    for key, energy in bonds.items():
        lines.append("[[lattice.bond]]")
        if edges is not None:
            lines.append("" if key is None else f"type = {_arrays.count(key, 'type of edges', 0)}")
        else:
            offset, places = (key[0], key[1:]) if key and isinstance(key[0], tuple) else (key, ())
            if len(places) not in (0, 2):
                raise InputError(f"bonds: {key} is neither an offset nor (offset, from, to)")
            lines.append(f"offset = {[int(own) for own in offset]}")
            lines += [f"{word} = {int(own)}" for word, own in zip(("from", "to"), places, strict=False)]
        if isinstance(energy, str):
            lines.append(f"energy = {_text.quoted(energy)}")
        else:
            rows = _text.numbers(np.asarray(energy, dtype=float), "a matrix of a bond")
            lines.append(f"matrix = {rows}")
    return Lattice("\n".join(lines) + "\n", arrays)
