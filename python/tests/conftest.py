"""Fixtures of all tests."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import pytest

import coadjoint as ca

ROOT = Path(__file__).parents[2]


@pytest.fixture
def body() -> ca.System:
    """A free rigid body."""
    return ca.System(
        "SO3",
        "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)",
        coordinates="x y z",
        parameters={"I1": 1.5, "I2": 2, "I3": 2.5},
    )
