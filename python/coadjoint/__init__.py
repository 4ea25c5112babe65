"""Integrators for Hamiltonian systems on Lie groups that conserve momentum and Casimirs exactly.

>>> import coadjoint as ca
>>> body = ca.System("SO3", "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)", coordinates="x y z",
...                  parameters=dict(I1=1.5, I2=2, I3=2.5))
>>> run = body.simulate(momentum=[2, 0.5, 1], time=100, step=0.1)
>>> run.momentum.shape
(1001, 3)
"""

from typing import TYPE_CHECKING

from ._core import __version__
from .errors import CoadjointWarning, Error, InputError, RunError
from .lattice import Lattice, LatticeRun
from .learning import Model, learn
from .results import Drift, Failure, Run, States, Unknown
from .stepper import Stepper
from .system import Law, Laws, System, Verdict

if TYPE_CHECKING:
    from . import cluster as cluster

__all__ = [
    "CoadjointWarning",
    "Drift",
    "Error",
    "Failure",
    "InputError",
    "Lattice",
    "LatticeRun",
    "Law",
    "Laws",
    "Model",
    "Run",
    "RunError",
    "States",
    "Stepper",
    "System",
    "Unknown",
    "Verdict",
    "__version__",
    "learn",
]


def __getattr__(name: str) -> object:
    # Needs more packages than the rest, and time to import.
    if name == "cluster":
        import importlib

        return importlib.import_module(".cluster", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
