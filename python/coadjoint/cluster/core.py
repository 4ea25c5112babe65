"""What the cluster needs of the package: a system as text, its schedule, and rows advanced."""

from __future__ import annotations

import platform
import threading
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pyarrow


@dataclass(frozen=True)
class Made:
    """Rows at the end: NaN where there is no end state, and (index, step, reason) for each of these."""

    states: np.ndarray
    bad: list[tuple[int, int, str]]
    drift: dict[str, float] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


def versions() -> dict[str, str]:
    """What the bytes of a run depend on besides its manifest.

    Parquet files name the program that wrote them, and its version chooses encodings and statistics: pyarrow is among
    them. Other processors have other instructions for fused products and functions of their own.
    """
    import coadjoint

    return {
        "coadjoint": coadjoint.__version__,
        "pyarrow": pyarrow.__version__,
        "processor": platform.machine(),
    }


def pin(system: Any, time: float | None, step: float | None, tolerance: float | None, backend: str | None) -> dict:
    """The run in text and numbers."""
    step, steps = system.schedule(time=time, step=step, tolerance=tolerance)
    return {"system": system.text, "step": step, "steps": steps, "backend": backend or "auto"}


def described(job: dict) -> dict[str, Any]:
    return dict(job)


def shape(job: dict) -> tuple[int, int, bool]:
    return _system(job["system"]).shape


def steps(job: dict) -> int:
    return job["steps"]


def advance(job: dict, numbers: np.ndarray, threads: int) -> Made:
    """Advances rows."""
    states, bad = _system(job["system"]).advance(numbers, job["step"], job["steps"], threads)
    return Made(states, bad)


_systems: dict[str, Any] = {}
_lock = threading.Lock()


def _system(text: str) -> Any:
    """The system of a text, derived and compiled once in a process."""
    with _lock:
        if text not in _systems:
            import coadjoint

            _systems[text] = coadjoint.System(text)
        return _systems[text]
