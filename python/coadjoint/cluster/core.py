"""The part of the package that runs on clusters need: a system as text, its schedule, and rows advanced."""

from __future__ import annotations

import platform
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow

from .._arrays import Backend, Floats, Numbers, text
from .._core import Core, __version__
from ..system import System, hardly_converges
from .errors import InputError, ShardError

#: What a run does, whatever its rows are.
_SCHEDULE = ("t0", "time", "step", "steps", "truncation", "frame")


@dataclass(frozen=True)
class Made:
    """Rows at the end, or at each time one after the other: NaN where there is no state, and (index, step, reason) for each of
    these rows."""

    states: Floats
    bad: list[tuple[int, int, str]]
    drift: dict[str, float]
    notes: list[str]


def versions() -> dict[str, str]:
    """The versions that the bytes of a run depend on, besides its manifest.

    Parquet files name the program that wrote them, and its version chooses encodings and statistics: pyarrow is among
    them. Other kinds of processors may have other last bits.
    """
    return {"coadjoint": __version__, "pyarrow": pyarrow.__version__, "processor": platform.machine()}


def pin(
    system: System, asked: dict[str, Any], backend: Backend, at: Numbers | None, parameters: list[str]
) -> dict[str, Any]:
    """The run in text and numbers, with these columns of parameters: what a tolerance picks is picked here, once."""
    core = _core(system.text)
    none = np.empty((0, system.dimension + len(parameters)))
    asked, times = system._asked(**asked), system._times(at, asked.get("step"))
    _, _, facts = core.ensemble(
        none, asked, parameters=parameters, at=times, backend=text(backend, "backend"), threads=1, progress=None
    )
    job = {"text": system.text, "backend": backend} | {key: facts[key] for key in _SCHEDULE}
    if parameters:
        job["parameters"] = parameters
    if times is not None:
        job["at"] = times.tolist()
    return job


def columns(system: System, available: Sequence[str]) -> tuple[list[str], list[str], list[str]]:
    """The columns of a state among those of a file, in the order in which the steps want them, the others, and those of the
    first that are parameters."""
    if not isinstance(system, System):
        raise InputError(f"system must be a coadjoint.System, not {type(system).__name__}")
    system._plain("does not go to other machines")
    if system._facts["inputs_of_files"]:
        raise InputError("the table of inputs is a file, which other machines lack: give lists of values at times")
    names, places, others, varied = _core(system.text).columns(list(available), len(available))
    missing = [name for name, place in zip(names, places, strict=True) if place is None]
    if missing:
        raise InputError(f"column {missing[0]} is missing: files of states have all entries of the matrix, also zeros")
    return [available[place] for place in places if place is not None], others, names[len(names) - varied :]


def advance(job: dict[str, Any], numbers: Floats, threads: int) -> Made:
    """Advances rows."""
    asked = {"tolerance": None, "region": None} | {key: job[key] for key in ("t0", "time", "step", "truncation", "frame")}
    at = np.array(job["at"]) if "at" in job else None
    states, failed, facts = _core(job["text"]).ensemble(
        numbers, asked, parameters=job.get("parameters", []), at=at, backend=job["backend"], threads=threads, progress=None
    )
    for key in _SCHEDULE:
        if facts[key] != job[key]:
            raise ShardError(f"{key} is {facts[key]} here and {job[key]} in the manifest")
    drift = {key: facts[key] for key in ("spatial_momentum", "casimirs", "ratio") if facts[key] is not None}
    return Made(states, failed, drift, facts["notes"])


def warnings(ratio: float, notes: list[str]) -> list[str]:
    """The warnings of a run."""
    found = list(dict.fromkeys(notes))
    if ratio != 0.0:
        found.append(hardly_converges(ratio))
    return found


_known: dict[str, Core] = {}
_lock = threading.Lock()


def _core(text: str) -> Core:
    """The system of a text, which keeps what has been derived: once in a process."""
    with _lock:
        if text not in _known:
            _known[text] = Core(text, "system")
        return _known[text]
