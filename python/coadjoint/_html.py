"""What notebooks show: tables, and small pictures without any library."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

import numpy as np

from ._arrays import Floats
from ._sphere import VIEW, energies, frame, levels

if TYPE_CHECKING:
    from .results import Run
    from .system import System

_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]
_WIDTH, _HEIGHT = 360, 180
_LEFT, _RIGHT, _TOP, _BOTTOM = 58, 10, 24, 28
# So many points of a curve are drawn at most, and so many curves.
_MOST, _CURVES = 600, 6


def _rows(rows: list[tuple[str, str]]) -> str:
    cells = (
        f'<tr><td style="text-align:left;color:#666">{escape(name)}</td>'
        f'<td style="text-align:left">{value}</td></tr>'
        for name, value in rows
    )
    return f"<table>{''.join(cells)}</table>"


def system(system: System) -> str:
    """A table of what the system is, and the level curves of H where momenta lie on spheres."""

    def code(text: str) -> str:
        return f"<code>{escape(text)}</code>"

    facts = system._facts
    rows = [
        ("group", code(system.group)),
        ("H", code(facts["hamiltonian"])),
        ("coordinates", code(", ".join(system.coordinates))),
        ("method", f"K = {system.truncation}, order {system.truncation + 1}, {escape(system.chart)}"),
    ]
    if facts["comoving"]:
        rows.append(("frame", "comoving"))
    if facts["splitting"]:
        rows.append(("potential", f"kicks by {escape(facts['splitting'])}"))
    return f"<b>{escape(system.name)}</b>{_rows(rows)}{_sphere(system)}"


# Cells of the grid on which level curves of H are found, on a side; how many curves; the picture's radius and margin.
_CELLS, _LEVELS, _RADIUS, _MARGIN = 48, 9, 80, 28


def _sphere(system: System) -> str:
    """The level curves of H on the sphere |μ| = 1, where momenta lie on spheres: what every motion follows."""
    if system.group not in ("SO3", "SU2"):
        return ""
    axes_seen = frame(VIEW)
    # A little beyond the rim, so that curves reach it.
    side = np.linspace(-1.0, 1.0, _CELLS + 1) * (1 + 1 / _CELLS)
    u, v = np.meshgrid(side, side)
    length = np.maximum(np.hypot(u, v), 1.0)
    seen = np.stack([u / length, v / length, np.sqrt(np.maximum(1 - u**2 - v**2, 0))], axis=-1)
    values = energies(system, *np.moveaxis(seen @ axes_seen, -1, 0))
    inside = np.hypot(u, v) <= 1
    if not np.isfinite(values).all():
        return ""
    chosen = levels(values[inside], _LEVELS)
    if not len(chosen):
        return ""
    size = 2 * (_RADIUS + _MARGIN)
    middle = size / 2

    def at(x: Floats, y: Floats) -> tuple[Floats, Floats]:
        return middle + _RADIUS * x, middle - _RADIUS * y

    curves = []
    for level in chosen:
        ends = [at(x, y) for x, y in _crossings(side, values - level)]
        pieces = zip(*[np.round(part, 1) for end in ends for part in end], strict=True)
        path = "".join(f"M{a:g} {b:g}L{c:g} {d:g}" for a, b, c, d in pieces)
        curves.append(f'<path d="{path}"/>')
    axes = []
    for name, direction in zip(system.coordinates, axes_seen.T, strict=True):
        foot, tip, word = (at(r * direction[0], r * direction[1]) for r in (1.0, 1.18, 1.3))
        colour = "#333" if direction[2] >= 0 else "#aaa"
        axes.append(
            f'<line x1="{foot[0]:.1f}" y1="{foot[1]:.1f}" x2="{tip[0]:.1f}" y2="{tip[1]:.1f}" stroke="{colour}"/>'
            f'<text x="{word[0]:.1f}" y="{word[1] + 3:.1f}" text-anchor="middle" fill="{colour}">{escape(name)}</text>'
        )
    title = "level curves of H on a sphere of momenta"
    return (
        f'<div><svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}" viewBox="0 0 {size} {size}" '
        f'font-family="sans-serif" font-size="11" role="img" aria-label="{title}"><title>{title}</title>'
        f'<rect width="100%" height="100%" fill="white"/><clipPath id="coadjoint-rim"><circle cx="{middle}" '
        f'cy="{middle}" r="{_RADIUS}"/></clipPath><circle cx="{middle}" cy="{middle}" r="{_RADIUS}" fill="#f4f6f8" '
        f'stroke="#999"/><g clip-path="url(#coadjoint-rim)" fill="none" stroke="{_COLOURS[0]}">'
        f'{"".join(curves)}</g>{"".join(axes)}</svg></div>'
    )


def _crossings(side: Floats, values: Floats) -> list[tuple[Floats, Floats]]:
    """Both ends of the straight pieces on which numbers on a square grid are 0: each cell is two triangles."""
    x, y = np.meshgrid(side, side)
    points = np.stack([x, y, values], axis=-1)
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]
    corners = np.concatenate([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)]).reshape(-1, 3, 3)
    above = corners[..., 2] > 0
    cut = above.any(axis=1) & ~above.all(axis=1)
    corners, above = corners[cut], above[cut]
    # The corner that is alone on its side, and the two others.
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    row = np.arange(len(corners))
    apex = corners[row, alone]
    ends = []
    for step in (1, 2):
        other = corners[row, (alone + step) % 3]
        share = (apex[:, 2] / (apex[:, 2] - other[:, 2]))[:, None]
        end = apex[:, :2] + share * (other[:, :2] - apex[:, :2])
        ends.append((end[:, 0], end[:, 1]))
    return ends


def run(run: Run) -> str:
    """The momentum and the drift, and the figures of a run."""
    head = (
        f"<b>{escape(run._name)}</b>: {escape(run.label)}; {run.steps} steps of {run.step:g}, "
        f"{len(run)} records; by {escape(run.backend)}"
    )
    names = run.coordinates[:_CURVES]
    curves = [(name, run.momentum[:, i]) for i, name in enumerate(names)]
    unit = run._units["time"]
    across = f"t in {unit}" if unit else "t"
    more = f" (first {_CURVES} of {run.momentum.shape[1]})" if run.momentum.shape[1] > _CURVES else ""
    pictures = _panel(f"momentum{more}", across, run.time, curves, logarithmic=False)
    drifts = [("spatial momentum", run.drift.spatial_momentum, run._found["conserved_momenta"])]
    drifts.append(("Casimirs", run.drift.casimirs, run._found["casimirs"]))
    drifts.append(("energy", run.drift.energy, run._found["has_energy"]))
    kept = [(name, values) for name, values, known in drifts if known]
    if kept:
        pictures += _panel("relative drift", across, run.time, kept, logarithmic=True)
    notes = "".join(f"<div>{escape(note)}</div>" for note in run.notes + run.warnings)
    return f"<div>{head}</div><div>{pictures}</div>{notes}"


def _panel(
    title: str, across: str, time: Floats, curves: list[tuple[str, Floats]], *, logarithmic: bool
) -> str:
    stride = max(1, -(-len(time) // _MOST))
    times = time[::stride]
    shown = []
    for name, values in curves:
        # Of drifts the largest between two points counts.
        if logarithmic:
            starts = np.arange(0, len(values), stride)
            values = np.log10(np.maximum(np.maximum.reduceat(values, starts), 1e-17))
        else:
            values = values[::stride]
        shown.append((name, values))
    every = np.concatenate([values for _, values in shown])
    low, high = float(every.min()), float(every.max())
    if logarithmic:
        low, high = np.floor(low), max(np.ceil(high), np.floor(low) + 1)
    elif high - low < 1e-12 * max(abs(low), abs(high), 1e-300):
        low, high = low - 1, high + 1
    first, last = float(times[0]), float(times[-1])
    wide, tall = _WIDTH - _LEFT - _RIGHT, _HEIGHT - _TOP - _BOTTOM

    def x(t: float) -> float:
        return _LEFT + wide * (t - first) / ((last - first) or 1)

    def y(v: float) -> float:
        return _TOP + tall * (high - v) / (high - low)

    def said(v: float) -> str:
        return f"1e{v:.0f}" if logarithmic else f"{v:.3g}"

    def text(at: float, up: float, what: str, more: str) -> str:
        return f'<text x="{at:.1f}" y="{up:.1f}" {more}>{escape(what)}</text>'

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDTH}" height="{_HEIGHT}" '
        f'viewBox="0 0 {_WIDTH} {_HEIGHT}" font-family="sans-serif" font-size="10" role="img" '
        f'aria-label="{escape(title)}"><rect width="100%" height="100%" fill="white"/>',
        f'<rect x="{_LEFT}" y="{_TOP}" width="{wide}" height="{tall}" fill="none" stroke="#999"/>',
        text(_LEFT, _TOP - 8, title, 'fill="#333"'),
        text(_LEFT + wide / 2, _HEIGHT - 4, across, 'text-anchor="middle" fill="#333"'),
        text(_LEFT, _TOP + tall + 12, f"{first:g}", 'text-anchor="middle" fill="#333"'),
        text(_LEFT + wide, _TOP + tall + 12, f"{last:g}", 'text-anchor="end" fill="#333"'),
        text(_LEFT - 4, _TOP + 8, said(high), 'text-anchor="end" fill="#333"'),
        text(_LEFT - 4, _TOP + tall, said(low), 'text-anchor="end" fill="#333"'),
    ]
    for i, (name, values) in enumerate(shown):
        colour = _COLOURS[i % len(_COLOURS)]
        points = " ".join(f"{x(t):.1f},{y(v):.1f}" for t, v in zip(times, values, strict=True))
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.2"/>')
    # The legend, from the right.
    right = _LEFT + wide
    for i, (name, _) in reversed(list(enumerate(shown))):
        parts.append(text(right, _TOP - 8, name, f'text-anchor="end" fill="{_COLOURS[i % len(_COLOURS)]}"'))
        right -= 6 * len(name) + 8
    return "".join(parts) + "</svg>"
