"""A bar for runs that take long, in terminals and notebooks."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

Progress = Callable[[int, int], object]

# Runs shorter than this show no bar.
_PATIENCE = 1.0


class _Line:
    """A line on the error stream that is written over and over."""

    def __init__(self, what: str) -> None:
        self._what, self._begun, self._shown = what, time.monotonic(), False

    def __call__(self, done: int, total: int) -> None:
        seconds = time.monotonic() - self._begun
        if total == 0 or seconds < _PATIENCE:
            return
        share = min(done / total, 1.0)
        bar = "█" * round(30 * share)
        left = seconds * (1 - share) / share if share > 0 else float("nan")
        sys.stderr.write(f"\r{self._what} {bar:<30} {share:4.0%} {left:6.0f} s left ")
        sys.stderr.flush()
        self._shown = True

    def close(self) -> None:
        if self._shown:
            sys.stderr.write("\r" + " " * 78 + "\r")
            sys.stderr.flush()


class _Bar:
    """tqdm's bar: in a notebook a widget."""

    def __init__(self, what: str, tqdm: Any) -> None:
        self._what, self._tqdm = what, tqdm
        self._bar: Any = None
        self._begun = time.monotonic()

    def __call__(self, done: int, total: int) -> None:
        if total == 0 or (self._bar is None and time.monotonic() - self._begun < _PATIENCE):
            return
        if self._bar is None:
            self._bar = self._tqdm(total=total, desc=self._what, leave=False, unit_scale=True)
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


def _in_notebook() -> bool:
    shell = sys.modules.get("IPython")
    shell = shell.get_ipython() if shell is not None else None
    return type(shell).__name__ == "ZMQInteractiveShell"


class _Given:
    def __init__(self, listener: Progress) -> None:
        self._listener = listener

    def __call__(self, done: int, total: int) -> None:
        self._listener(done, total)

    def close(self) -> None:
        pass


def listener(progress: bool | Progress | None, what: str) -> _Line | _Bar | _Given | None:
    """Who is told: nobody, a function of (done, total), or a bar where somebody looks on."""
    if callable(progress):
        return _Given(progress)
    if progress is False:
        return None
    notebook = _in_notebook()
    if not (progress or notebook or sys.stderr.isatty()):
        return None
    if not notebook:
        return _Line(what)
    try:
        import ipywidgets  # noqa: F401
        from tqdm.notebook import tqdm
    except ImportError:
        return _Line(what)
    return _Bar(what, tqdm)
