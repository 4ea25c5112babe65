"""The display in notebooks: a table, and a picture where matplotlib is installed."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from html import escape
from typing import TYPE_CHECKING

from .errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .results import Run
    from .system import System


def _picture(draw: Callable[[Figure], object], size: tuple[float, float]) -> str:
    """A picture of a figure that no window shows; nothing where it cannot be drawn."""
    try:
        from matplotlib.figure import Figure

        draw(figure := Figure(figsize=size, layout="constrained"))
    except (ImportError, InputError):
        return ""
    figure.savefig(content := io.BytesIO(), format="png", dpi=90)
    return f'<div><img src="data:image/png;base64,{base64.b64encode(content.getvalue()).decode()}"></div>'


def _code(text: str) -> str:
    return f"<code>{escape(text)}</code>"


def system(system: System) -> str:
    """A table of what the system is, and the level curves of H where momenta lie on spheres."""
    from . import plots

    facts = system._facts
    rows = [
        ("group", _code(system.group)),
        ("H", _code(facts["hamiltonian"])),
        ("coordinates", _code(", ".join(system.coordinates))),
        ("method", f"K = {system.truncation}, order {system.truncation + 1}, {escape(system.chart or 'collocation')}"),
    ]
    if facts["comoving"]:
        rows.append(("frame", "comoving"))
    if facts["splitting"]:
        rows.append(("potential", f"kicks by {escape(facts['splitting'])}"))
    cells = (
        f'<tr><td style="text-align:left;color:#666">{name}</td><td style="text-align:left">{value}</td></tr>'
        for name, value in rows
    )
    picture = _picture(lambda figure: plots.levels(system, figure=figure), (3.4, 3.4))
    return f"<b>{escape(system.name)}</b><table>{''.join(cells)}</table>{picture}"


def run(run: Run) -> str:
    """The figures of a run, and the momentum above the drift."""
    from . import plots

    head = (
        f"<b>{escape(run._name)}</b>: {escape(run.label)}; {run.steps} steps of {run.step:g}, "
        f"{len(run)} records; by {escape(run.backend)}"
    )
    notes = "".join(f"<div>{escape(note)}</div>" for note in run.notes + run.warnings)
    return f"<div>{head}</div>{_picture(lambda figure: plots.run(run, figure=figure), (8, 5.5))}{notes}"
