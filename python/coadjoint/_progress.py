"""A bar for runs that take long, by tqdm where it is installed."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

Progress = Callable[[int, int], object]


class _Bar:
    def __init__(self, what: str, tqdm: Any) -> None:
        # Short runs show none.
        self._bar = tqdm(desc=what, leave=False, unit_scale=True, delay=1)

    def __call__(self, done: int, total: int) -> None:
        self._bar.total = total or None
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        self._bar.close()


class _Given:
    def __init__(self, listener: Progress) -> None:
        self._listener = listener

    def __call__(self, done: int, total: int) -> None:
        self._listener(done, total)

    def close(self) -> None:
        pass


def listener(progress: bool | Progress | None, what: str) -> _Bar | _Given | None:
    """Who is told: nobody, a function of (done, total), or a bar where somebody looks on."""
    if callable(progress):
        return _Given(progress)
    notebook = "ipykernel" in sys.modules
    if progress is False or not (progress or notebook or sys.stderr.isatty()):
        return None
    try:
        if notebook:
            import ipywidgets  # noqa: F401
            from tqdm.notebook import tqdm
        else:
            from tqdm import tqdm
    except ImportError:
        return None
    return _Bar(what, tqdm)
