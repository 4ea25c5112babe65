"""A bar for runs that take long, by tqdm where it is installed."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

Progress = Callable[[int, int], object]


@contextmanager
def listener(progress: bool | Progress | None, what: str) -> Iterator[Progress | None]:
    """Who is told: nobody, a function of (done, total), or a bar where somebody looks on."""
    notebook = "ipykernel" in sys.modules
    if callable(progress):
        yield progress
        return
    if progress is False or not (progress or notebook or sys.stderr.isatty()):
        yield None
        return
    try:
        if notebook:
            import ipywidgets  # noqa: F401
            from tqdm.notebook import tqdm
        else:
            from tqdm import tqdm
    except ImportError:
        yield None
        return
    # Short runs show none.
    with tqdm(desc=what, leave=False, unit_scale=True, delay=1) as bar:

        def tell(done: int, total: int) -> None:
            bar.total = total or None
            bar.update(done - bar.n)

        yield tell
