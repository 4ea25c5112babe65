from collections.abc import Callable
import os
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "ControlLoop",
    "Core",
    "ModelCore",
    "Stepper",
    "__version__",
    "backward",
    "forward",
    "largest_exponent",
    "learn",
    "read_text",
    "simulate_lattice",
    "write_text",
]

__version__: str

_Asked = dict[str, Any]
_Progress = Callable[[int, int], object]

def simulate_lattice(
    text: str,
    name: str,
    arrays: dict[str, NDArray[np.float64]],
    asked: _Asked,
    *,
    every: int | None,
    estimate: bool,
    progress: _Progress | None,
) -> dict[str, Any]: ...
@final
class Core:
    def __new__(
        cls,
        text: str,
        name: str,
        functions: tuple[Callable[..., Any], Callable[..., Any]] | None = None,
        inputs: list[tuple[str, Callable[..., Any]]] = ...,
        velocity: Callable[..., Any] | None = None,
        torque: Callable[..., Any] | None = None,
    ) -> Core: ...
    def with_parameters(self, values: list[tuple[str, list[float]]]) -> tuple[Core, str]: ...
    def facts(self) -> dict[str, Any]: ...
    def parameters(self) -> list[tuple[str, list[int]]]: ...
    def inputs(self) -> list[tuple[str, int]]: ...
    def simulate(
        self,
        asked: _Asked,
        *,
        momentum: NDArray[np.float64] | None,
        group_element: NDArray[np.float64] | None,
        every: int | None,
        at: NDArray[np.float64] | None,
        events: list[tuple[str, Callable[..., float], int, bool]],
        looks: int | None,
        backend: str,
        estimate: bool,
        record: bool,
        progress: _Progress | None,
    ) -> dict[str, Any]: ...
    def ensemble(
        self,
        states: NDArray[np.float64],
        asked: _Asked,
        *,
        parameters: list[str],
        inputs: list[tuple[str, tuple[int, ...], NDArray[np.float64]]] = ...,
        at: NDArray[np.float64] | None,
        backend: str,
        threads: int | None,
        progress: _Progress | None,
    ) -> tuple[NDArray[np.float64], list[tuple[int, int, str]], dict[str, Any]]: ...
    def layouts(self) -> list[list[str]]: ...
    def columns(
        self, names: list[str] | None, width: int
    ) -> tuple[list[str], list[int | None], list[str], int]: ...
    def hamiltonian(self, time: float, momenta: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def velocities(
        self,
        times: NDArray[np.float64],
        momenta: NDArray[np.float64],
        matrices: NDArray[np.float64],
    ) -> NDArray[np.float64]: ...
    def choice(self) -> tuple[int, float] | None: ...
    def stepper(self, step: float | None, backend: str, varied: list[str]) -> Stepper: ...
    def series(self, form: str, truncation: int | None) -> str: ...
    def casimirs(self, degree: int) -> list[str]: ...
    def check(
        self, step: float | None, t0: float | None, points: int, seed: int
    ) -> tuple[list[tuple[str, str, float, float, bool | None]], str | None]: ...
    def verify(
        self,
        rows: NDArray[np.float64],
        names: list[str],
        *,
        starts: NDArray[np.float64] | None,
        t0: float,
        steps: int,
        step: float,
        truncation: int,
        refused_rows: list[int],
    ) -> str: ...
    def emit(
        self, language: str, prefix: str | None, step: float | None, single: bool
    ) -> str: ...

@final
class Stepper:
    @property
    def backend(self) -> str: ...
    @property
    def parameters(self) -> list[tuple[str, int]]: ...
    def begin(
        self,
        momentum: NDArray[np.float64],
        group_element: NDArray[np.float64] | None,
        time: float,
    ) -> ControlLoop: ...
    def advance(
        self,
        momentum: NDArray[np.float64],
        group_element: NDArray[np.float64] | None,
        time: float,
        steps: int,
        parameters: list[float] | None,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...

@final
class ControlLoop:
    @property
    def state(
        self,
    ) -> tuple[float, NDArray[np.float64], NDArray[np.float64]]: ...
    def advance(self, steps: int, parameters: list[float] | None) -> None: ...

def forward(
    run: dict[str, Any],
    tangents: NDArray[np.float64],
    parameters: NDArray[np.float64],
    inputs: dict[str, NDArray[np.float64]],
    at: list[int],
) -> NDArray[np.float64]: ...
def backward(
    run: dict[str, Any], cotangents: NDArray[np.float64], at: list[int]
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]: ...
def largest_exponent(run: dict[str, Any], transient: int) -> float: ...
def read_text(path: str | os.PathLike[str]) -> str: ...
def write_text(path: str | os.PathLike[str], text: str) -> None: ...
def learn(
    data: list[tuple[str, NDArray[np.float64]]],
    test: list[tuple[str, NDArray[np.float64]]] | None,
    settings: dict[str, Any],
    progress: _Progress | None,
) -> tuple[str, str]: ...
@final
class ModelCore:
    def __new__(cls, text: str, name: str) -> ModelCore: ...
    def facts(self) -> dict[str, Any]: ...
    def simulate(
        self,
        momentum: NDArray[np.float64],
        time: float,
        every: int,
        progress: _Progress | None,
    ) -> dict[str, Any]: ...
    def system(self) -> Core: ...
    def steps(self, time: float) -> int: ...
    def generating_function(self) -> str: ...
    def emit(self, language: str, prefix: str | None, single: bool) -> str: ...
