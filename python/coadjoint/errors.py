"""The exceptions of the package: all are :class:`Error`.

>>> import coadjoint as ca
>>> try:
...     ca.System("SO3", "x^2 + sqr(y)", coordinates="x y z")
... except ca.InputError as error:
...     print(error)     # doctest: +ELLIPSIS
system:4:22: error: unknown function `sqr`...
"""

from __future__ import annotations

import re

__all__ = ["CoadjointWarning", "Error", "InputError", "RunError"]


class Error(Exception):
    """Everything that this package raises of its own."""


class InputError(Error, ValueError):
    """The input makes no sense, or the request is impossible: the message says where, and what to write instead."""


class RunError(Error, RuntimeError):
    """A run that stopped on its way."""

    #: The time at which it stopped, where that is known.
    time: float | None = None
    #: The step that could not be made, from 1; 0 for the start.
    step: int | None = None

    def __init__(self, message: str, time: float | None = None, step: int | None = None) -> None:
        super().__init__(message)
        self.time, self.step = time, step

    def __reduce__(self) -> tuple[type[RunError], tuple[str, float | None, int | None]]:
        return type(self), (str(self), self.time, self.step)


class CoadjointWarning(UserWarning):
    """Something that a run went on with, but that should be known."""


# Settings of the command that have another name here, and those that are not settings.
_NAMES = {"start": "momentum", "dt": "step", "initial": "states"}


def _python(message: str) -> str:
    """Settings as Python writes them: `--step 0.1` as `step=0.1`, `--step` as `step`."""

    def name(word: str) -> str:
        return _NAMES.get(word, word.replace("-", "_"))

    message = re.sub(
        r"--([a-z][a-z-]*) (-?\d[\d.e+-]*\d|\d)\b", lambda m: f"{name(m[1])}={m[2]}", message
    )
    return re.sub(r"--([a-z][a-z-]*)", lambda m: name(m[1]), message)


def _make(kind: str, message: str, time: float | None, step: int | None) -> Error:
    """The exception for a failure; called by the extension module."""
    message = _python(message).rstrip()
    return InputError(message) if kind == "input" else RunError(message, time, step)
