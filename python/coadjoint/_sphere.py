"""The sphere of momenta as pictures see it: from where, and along which curves H is constant."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ._arrays import Floats

if TYPE_CHECKING:
    from .system import System

# Where the eye is: elevation and azimuth in degrees.
VIEW = (25.0, 40.0)


def frame(view: tuple[float, float]) -> Floats:
    """What is right, up, and towards the eye, as rows."""
    up, turned = np.radians(view)
    right = np.array([-np.sin(turned), np.cos(turned), 0.0])
    eye = np.array([np.cos(up) * np.cos(turned), np.cos(up) * np.sin(turned), np.sin(up)])
    return np.array([right, np.cross(eye, right), eye])


def energies(system: System, x: Floats, y: Floats, z: Floats) -> Floats:
    """H at these momenta."""
    found: Floats = system._core.hamiltonian(np.stack([x, y, z], axis=-1).reshape(-1, 3))[0]
    return found.reshape(x.shape)


def levels(values: Floats, count: int) -> Floats:
    """So many values of H that share out the momenta evenly; none where H is one number."""
    if np.ptp(values) < 1e-12 * np.abs(values).max():
        return np.array([])
    return np.unique(np.quantile(values, (np.arange(count) + 0.5) / count))
