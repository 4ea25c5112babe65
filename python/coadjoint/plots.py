"""Pictures by matplotlib: the momentum, the drift, orbits on their spheres, and work against precision.

Matplotlib is needed only when a picture is asked for. Every function returns the figure.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import Floats, text
from .errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .results import Run
    from .system import System

__all__ = ["drift", "levels", "momentum", "orbit", "run", "work_precision"]

# Okabe and Ito's colours, which colour-blind readers tell apart.
_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
# So many coordinates are drawn at most.
_CURVES = 7
_EPSILON = 2.0**-53
# Where the eye is: elevation and azimuth in degrees.
VIEW = (25.0, 40.0)


def _figure(figure: Figure | None, size: tuple[float, float]) -> Figure:
    if figure is not None:
        return figure
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise InputError("pictures need matplotlib: pip install matplotlib") from None
    # Of pyplot, so that terminals and notebooks show it as ever.
    made: Figure = plt.figure(figsize=size, layout="constrained")
    return made


def _time(run: Run) -> str:
    unit = run._units["time"]
    return f"time in {unit}" if unit else "time"


def run(run: Run, what: str = "all", figure: Figure | None = None) -> Figure:
    """The momentum above the drift, or one of them; or the orbit."""
    if text(what, "what", ("all", "momentum", "drift", "orbit")) == "orbit":
        return orbit(run, figure=figure)
    if what == "momentum":
        return momentum(run, figure=figure)
    if what == "drift":
        return drift(run, figure=figure)
    figure = _figure(figure, (8, 5.5))
    above, below = figure.subplots(2, 1, sharex=True)
    _momentum(above, run)
    _drift(below, {"": run})
    below.set_xlabel(_time(run))
    figure.suptitle(f"{run._name}: {run.label}, h = {run.step:g}", fontsize=11)
    return figure


def momentum(run: Run, *, figure: Figure | None = None) -> Figure:
    """The coordinates of the momentum over time."""
    figure = _figure(figure, (8, 3.2))
    axes = figure.subplots()
    _momentum(axes, run)
    axes.set_xlabel(_time(run))
    axes.set_title(f"{run._name}: {run.label}, h = {run.step:g}", fontsize=11)
    return figure


def _momentum(axes: Axes, run: Run) -> None:
    shown = run.coordinates[:_CURVES]
    for i, name in enumerate(shown):
        axes.plot(run.time, run.momentum[:, i], color=_COLOURS[i], linewidth=1, label=name)
    units = {unit for unit in run._units["momentum"][: len(shown)] if unit}
    unit = f" in {units.pop()}" if len(units) == 1 else ""
    more = f", {len(shown)} of {len(run.coordinates)}" if len(run.coordinates) > len(shown) else ""
    axes.set_ylabel(f"momentum{unit}{more}")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), borderaxespad=0, fontsize=9)
    axes.margins(x=0)


def drift(runs: Run | Mapping[str, Run], *, figure: Figure | None = None) -> Figure:
    """The relative drift of what is conserved, of one run, or of several by their names."""
    from .results import Run

    named = {"": runs} if isinstance(runs, Run) else dict(runs)
    if not named:
        raise InputError("no run is given")
    figure = _figure(figure, (8, 3.2))
    axes = figure.subplots()
    _drift(axes, named)
    axes.set_xlabel(_time(next(iter(named.values()))))
    return figure


def _drift(axes: Axes, runs: Mapping[str, Run]) -> None:
    colour = 0
    for name, run in runs.items():
        kinds = [
            ("spatial momentum", run.drift.spatial_momentum, "-"),
            ("Casimirs", run.drift.casimirs, "--"),
            ("energy", run.drift.energy, ":"),
        ]
        for kind, values, style in (kinds[place] for place in run._known):
            label = f"{name}: {kind}" if name else kind
            # Zero has no place on this axis; a quarter of the rounding unit stands for it.
            shown = np.maximum(values, _EPSILON / 4)
            own = _COLOURS[colour % len(_COLOURS)]
            axes.semilogy(run.time, shown, color=own, linestyle=style if name else "-", linewidth=1, label=label)
            colour += 0 if name else 1
        colour += 1 if name else 0
    axes.axhline(_EPSILON, color="0.7", linewidth=0.8, zorder=0)
    axes.set_ylabel("relative drift")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), borderaxespad=0, fontsize=9)
    axes.margins(x=0)


def orbit(
    run: Run,
    system: System | None = None,
    *,
    levels: int = 12,
    figure: Figure | None = None,
    view: tuple[float, float] = VIEW,
) -> Figure:
    """The orbit of a momentum with three coordinates on its sphere; with the ``system``, the level curves of H too, of one that
    depends on time those at the start.

    ``view`` is the elevation and the azimuth of the eye, in degrees. Curves behind the sphere are dashed.
    """
    if run.momentum.shape[1] != 3:
        raise InputError(
            f"orbits are drawn of three coordinates of momentum; {run._name} has {run.momentum.shape[1]}"
        )
    radius = float(np.linalg.norm(run.momentum[0]))
    norms = np.linalg.norm(run.momentum, axis=1)
    if radius == 0 or not np.allclose(norms, radius, rtol=1e-6):
        raise InputError(f"the momenta of {run._name} lie on no sphere about the origin")
    figure = _figure(figure, (5.4, 5.4))
    axes, project = _sphere(figure, radius, run.coordinates, view)
    if system is not None:
        for curve in _level_curves(system, radius, levels, run.t0):
            _on_sphere(axes, project(curve), color="0.62", linewidth=0.7)
    _on_sphere(axes, project(run.momentum), color=_COLOURS[0], linewidth=1.6)
    start = project(run.momentum[:1])[0]
    axes.plot(start[0], start[1], "o", color=_COLOURS[1], markersize=6, label="start",
              markerfacecolor=_COLOURS[1] if start[2] >= 0 else "white")
    axes.set_title(f"{run._name}: momentum on its sphere, |μ| = {radius:.4g}", fontsize=11)
    axes.legend(loc="lower right", fontsize=9, frameon=False)
    return figure


def levels(system: System, *, count: int = 9, figure: Figure | None = None) -> Figure:
    """The level curves of H on a sphere of momenta, which every motion follows: for SO(3) and SU(2)."""
    if system.group not in ("SO3", "SU2"):
        raise InputError(f"the momenta of {system.name} lie on no spheres about the origin")
    if system._facts["moves"]:
        raise InputError(f"{system.name} depends on time, so its motions follow no level curves")
    curves = _level_curves(system, 1.0, count, 0.0)
    if not curves:
        raise InputError(f"the Hamiltonian of {system.name} is one number on each sphere")
    figure = _figure(figure, (5.4, 5.4))
    axes, project = _sphere(figure, 1.0, system.coordinates, VIEW)
    for curve in curves:
        _on_sphere(axes, project(curve), color=_COLOURS[0], linewidth=1)
    return figure


def _sphere(
    figure: Figure, radius: float, names: Sequence[str], view: tuple[float, float]
) -> tuple[Axes, Callable[[Floats], Floats]]:
    """The outline of a sphere and its axes, and what turns points so that the eye sees the first two coordinates."""
    axes = figure.subplots()
    axes.set_aspect("equal")
    axes.axis("off")
    up, turned = np.radians(view)
    right = np.array([-np.sin(turned), np.cos(turned), 0.0])
    eye = np.array([np.cos(up) * np.cos(turned), np.cos(up) * np.sin(turned), np.sin(up)])
    seen = np.array([right, np.cross(eye, right), eye]).T
    circle = np.linspace(0, 2 * np.pi, 361)
    axes.fill(radius * np.cos(circle), radius * np.sin(circle), color="#f4f6f8", zorder=0)
    axes.plot(radius * np.cos(circle), radius * np.sin(circle), color="0.6", linewidth=0.8)
    for name, (x, y, depth) in zip(names, radius * seen, strict=True):
        front = depth >= 0
        axes.plot([x, 1.22 * x], [y, 1.22 * y], color="0.3" if front else "0.75", linewidth=0.9)
        place = (1.22 * x, 1.22 * y)
        axes.annotate(name, place, ha="center", va="center", color="0.1" if front else "0.6", fontsize=11)
    return axes, lambda points: points @ seen


def _on_sphere(axes: Axes, points: Floats, **style: Any) -> None:
    """A curve on the sphere: solid in front, dashed behind."""
    front = points[:, 2] >= 0
    behind: dict[str, Any] = {"linestyle": (0, (2, 3)), "alpha": 0.55}
    sides: list[tuple[bool, dict[str, Any]]] = [(True, {}), (False, behind)]
    for visible, more in sides:
        shown = np.where((front == visible)[:, None], points, np.nan)
        axes.plot(shown[:, 0], shown[:, 1], **style, **more)


def _level_curves(system: System, radius: float, count: int, time: float) -> list[Floats]:
    """The curves of equal energy at this time on the sphere, from a grid of longitude and latitude; none where H is one number."""
    from matplotlib.figure import Figure

    def place(longitude: Any, latitude: Any) -> Floats:
        flat = radius * np.cos(latitude)
        return np.stack([flat * np.cos(longitude), flat * np.sin(longitude), radius * np.sin(latitude)], axis=-1)

    grid = np.meshgrid(np.linspace(-np.pi, np.pi, 361), np.linspace(-np.pi / 2, np.pi / 2, 181))
    values = system._core.hamiltonian(time, place(*grid).reshape(-1, 3)).reshape(grid[0].shape)
    if np.ptp(values) < 1e-12 * np.abs(values).max():
        return []
    # As many momenta lie between one curve and the next.
    chosen = np.unique(np.quantile(values, (np.arange(count) + 0.5) / count))
    found = Figure().subplots().contour(*grid, values, chosen)
    return [place(*part.T) for level in found.allsegs for part in level if len(part) > 1]


def work_precision(
    curves: Mapping[str, Sequence[tuple[float, float]]],
    *,
    work: str = "seconds",
    error: str = "error at the end",
    figure: Figure | None = None,
) -> Figure:
    """Work against precision: for each method the pairs (work, error), on logarithmic axes. Lower left is better."""
    if not curves:
        raise InputError("no curve is given")
    figure = _figure(figure, (6, 4.2))
    axes = figure.subplots()
    markers = "osD^vP*"
    for i, (name, pairs) in enumerate(curves.items()):
        points = np.asarray(sorted(pairs), dtype=float).reshape(-1, 2)
        style = {"color": _COLOURS[i % len(_COLOURS)], "marker": markers[i % len(markers)]}
        axes.loglog(points[:, 1], points[:, 0], markersize=4, linewidth=1.2, label=name, **style)
    axes.set_xlabel(error)
    axes.set_ylabel(work)
    axes.grid(True, which="major", color="0.9")
    axes.legend(fontsize=9)
    return figure
