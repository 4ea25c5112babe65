"""States that go on step by step, as in a control loop."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from . import _arrays, _core
from ._arrays import Floats
from .errors import InputError

__all__ = ["Stepper", "held"]


class Stepper:
    """A state of a system, its time, and the steps that it makes: :meth:`System.stepper`."""

    def __init__(self, steps: _core.Stepper, loop: _core.ControlLoop) -> None:
        self._loop, self._known = loop, steps.parameters
        self._names = {name for name, _ in self._known}

    def advance(self, steps: int = 1, **parameters: Any) -> None:
        """Makes ``steps`` steps, during which the parameters have these values. A step that cannot be made raises StepError; the state is
        then that before it."""
        if type(steps) is not int or not 0 <= steps < 2**63:
            steps = _arrays.count(steps, "steps")
        if self._names != parameters.keys():
            wanted = ", ".join(f"{name}=…" for name, _ in self._known) or "no parameter"
            raise InputError(f"advance takes the parameters that stepper() was given the names of: {wanted}")
        self._loop.advance(steps, held(self._known, parameters) if parameters else None)

    @property
    def time(self) -> float:
        """The time of the state."""
        return self._loop.state[0]

    @property
    def momentum(self) -> Floats:
        """The momentum, (n,)."""
        return self._loop.state[1]

    @property
    def group_element(self) -> Floats:
        """The group element, (d, d)."""
        return self._loop.state[2]


def held(known: list[tuple[str, int]], parameters: Mapping[str, Any]) -> list[float]:
    """The numbers of parameters, one after the other, in the order of a stepper."""
    values: list[float] = []
    for name, count in known:
        value = parameters[name]
        own = [value] if count == 1 and type(value) is float else _arrays.floats(value, f"parameter {name}").ravel().tolist()
        if len(own) != count:
            raise InputError(f"parameter {name} has {len(own)} numbers; the system's has {count}")
        values.extend(own)
    return values


