"""How far a run is, for a line on the screen or for a function of the caller."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Progress:
    """How far a run is. Kept shards count as done, and not for the speed."""

    shards: int
    shards_done: int
    shards_kept: int
    rows: int
    rows_done: int
    bad: int
    workers: int
    #: Since the run began.
    seconds: float
    #: Rows that this run has made, a second.
    rows_per_second: float
    #: Until the end at this speed; None before the first shard is there.
    seconds_left: float | None

    def __str__(self) -> str:
        text = (
            f"{self.shards_done}/{self.shards} shards, {self.rows_done:,} of {self.rows:,} rows, "
            f"{self.rows_per_second:,.0f} rows/s"
        )
        if self.seconds_left is not None:
            text += f", {_clock(self.seconds_left)} left"
        text += f", {self.workers} worker{'' if self.workers == 1 else 's'}"
        if self.bad:
            text += f", {self.bad:,} bad rows"
        return text


class Counter:
    """Counts shards and tells."""

    #: Seconds between lines where the output is no terminal.
    QUIET = 30.0

    def __init__(
        self, shards: int, rows: int, tell: bool | Callable[[Progress], None], workers: Callable[[], int]
    ) -> None:
        self._shards, self._rows = shards, rows
        self._workers = workers
        self._begun = time.monotonic()
        self._done = self._kept = self._rows_done = self._rows_made = self._bad = 0
        self._tell = tell if callable(tell) else self._line if tell else None
        self._told = -self.QUIET if sys.stderr.isatty() else self._begun

    def finished(self, rows: int, bad: int, kept: bool) -> None:
        """A shard is there."""
        self._done += 1
        self._kept += kept
        self._rows_done += rows
        self._rows_made += 0 if kept else rows
        self._bad += bad

    def now(self) -> Progress:
        """How far the run is."""
        seconds = time.monotonic() - self._begun
        speed = self._rows_made / seconds if seconds > 0 else 0.0
        left = (self._rows - self._rows_done) / speed if speed > 0 else None
        return Progress(
            shards=self._shards,
            shards_done=self._done,
            shards_kept=self._kept,
            rows=self._rows,
            rows_done=self._rows_done,
            bad=self._bad,
            workers=self._workers(),
            seconds=seconds,
            rows_per_second=speed,
            seconds_left=left,
        )

    def tell(self) -> None:
        """Tells, if anybody listens."""
        if self._tell is not None:
            self._tell(self.now())

    def _line(self, progress: Progress) -> None:
        """One line that is written over on a terminal, a line now and then elsewhere."""
        last = progress.shards_done == progress.shards
        if sys.stderr.isatty():
            print(f"\r\033[K{progress}", end="\n" if last else "", file=sys.stderr, flush=True)
        elif last or time.monotonic() - self._told >= self.QUIET:
            self._told = time.monotonic()
            print(progress, file=sys.stderr, flush=True)


def _clock(seconds: float) -> str:
    whole = int(seconds + 0.5)
    hours, minutes, rest = whole // 3600, whole // 60 % 60, whole % 60
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
