"""Pictures."""

from __future__ import annotations

import numpy as np
import pytest

import coadjoint as ca
from coadjoint import InputError, plots


def test_every_picture_is_drawn(body: ca.System, tmp_path) -> None:
    run = body.simulate([2, 0.5, 1], time=30, step=0.1)
    figures = {
        "all": run.plot(),
        "momentum": run.plot("momentum"),
        "drift": run.plot("drift"),
        "orbit": plots.orbit(run, body),
        "several": plots.drift({"h = 0.1": run, "h = 0.3": body.simulate([2, 0.5, 1], time=30, step=0.3)}),
        "work": plots.work_precision({"ours": [(1, 1e-3), (2, 1e-6)], "other": [(2, 1e-2), (8, 1e-4)]}),
    }
    for name, figure in figures.items():
        figure.savefig(tmp_path / f"{name}.png")
        assert (tmp_path / f"{name}.png").stat().st_size > 5000
    # The level curves lie on the sphere, and the energy is the same along each.
    radius = float(np.linalg.norm(run.momentum[0]))
    for curve in plots._level_curves(body, radius, 8, 0.0):
        assert np.allclose(np.linalg.norm(curve, axis=1), radius)
        energy = (curve**2 / [3, 4, 5]).sum(axis=1)
        assert np.ptp(energy) < 1e-2 * energy.mean()


def test_pictures_that_cannot_be_drawn_are_refused(body: ca.System) -> None:
    with pytest.raises(InputError, match="orbit"):
        body.simulate([2, 0.5, 1], time=1, step=0.1).plot("orbits")
    pair = ca.System("SO3^2", "sum(i, 0..2, x[i]^2)", coordinates="x y z")
    with pytest.raises(InputError, match="three coordinates"):
        pair.simulate([1, 0, 0, 0, 1, 0], time=1, step=0.1).plot("orbit")
    with pytest.raises(InputError, match="no curve"):
        plots.work_precision({})
