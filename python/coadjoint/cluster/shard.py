"""The one function below all engines: a range of rows in, a Parquet file and a short record out."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow as pa

from .._arrays import Floats
from . import core, parquet, states
from .errors import ClusterError, InputError, ShardError
from .files import LASTING, Folder
from .manifest import seal, unseal
from .plan import group_rows


@dataclass(frozen=True, eq=False)
class Task:
    """Everything that a worker needs for one shard; pickles as text and numbers, and hashes by identity."""

    shard: int
    start: int
    stop: int
    pieces: list[tuple[str, int, int, int]]
    columns: list[str]
    keep: list[str]
    #: What makes the steps: see ``core``.
    job: dict[str, Any]
    #: Versions that the bytes depend on.
    versions: dict[str, str]
    out: str
    storage_options: dict[str, Any] | None
    threads: int
    #: Whether a finished shard is read again in full before it is kept.
    verify: bool


@dataclass(frozen=True)
class Summary:
    """The outcome of one shard."""

    shard: int
    rows: int
    bad: int
    #: The largest relative drifts of spatial momentum and Casimirs, and the largest ratio of the last two terms of the
    #: series where it is worth a warning, else 0.
    drift: dict[str, float]
    #: What this worker could not have, such as a compiler; the bytes do not depend on it.
    notes: list[str]
    #: Whether an earlier run had made it.
    kept: bool


def raise_to(drift: dict[str, float], other: dict[str, float]) -> None:
    """Puts the larger of each into ``drift``; what is no number is larger than any."""
    for name, value in other.items():
        known = drift.setdefault(name, value)
        drift[name] = value if value > known or value != value else known


def number(name: str) -> int | None:
    """The shard that a file belongs to, by its name; None for files of the run as a whole."""
    digits = name.split(".", 1)[0].rpartition("-")[2]
    return int(digits) if digits.isdigit() else None


def part(shard: int) -> str:
    """The name of the file of end states."""
    return f"part-{shard:05}.parquet"


def record(shard: int) -> str:
    """The name of the record that says a shard is finished; it is written last."""
    return f"_run/shard-{shard:05}.json"


def bad_list(shard: int) -> str:
    """The name of the list of rows without an end state."""
    return f"_run/bad-{shard:05}.jsonl"


def run(task: Task) -> Summary:
    """Makes a shard, or keeps the finished one. Running it twice, even at once, leaves the same files."""
    try:
        found = core.versions()
        if found != task.versions:
            others = [key for key, version in task.versions.items() if found.get(key) != version]
            differing = ", ".join(f"{key} {found.get(key)} instead of {task.versions[key]}" for key in others)
            raise ShardError(f"the worker {_worker()} has {differing}: parts would not have the same bytes")
        folder = Folder(task.out, task.storage_options)
        known = finished(folder, task.shard, task.start, task.stop, task.verify)
        notes: list[str] = []
        entry = known if known is not None else _make(task, folder, notes)
    except (ClusterError, InputError) as error:
        raise type(error)(placed(task, str(error))) from None
    except OSError as error:
        if error.errno in LASTING:
            raise ShardError(placed(task, f"cannot write or read: {error}")) from None
        raise
    except Exception as error:
        # Errors of other packages need not survive the way back.
        raise ShardError(placed(task, f"{type(error).__name__}: {error}")) from error
    return Summary(
        shard=task.shard,
        rows=entry["rows"],
        bad=entry["bad"],
        drift=entry["drift"],
        notes=notes,
        kept=known is not None,
    )


def finished(folder: Folder, shard: int, start: int, stop: int, verify: bool) -> dict[str, Any] | None:
    """The record of a finished shard whose files are as they were written; None where it must be made."""
    raw = folder.read(record(shard))
    if raw is None:
        return None
    try:
        entry = unseal(raw)
        if (entry["start"], entry["rows"]) != (start, stop - start):
            return None
        wanted = [(part(shard), entry["bytes"], entry["sha256"])]
        if entry["bad"]:
            wanted.append((bad_list(shard), entry["bad_bytes"], entry["bad_sha256"]))
    except (ValueError, KeyError, TypeError):
        return None
    for name, size, sha in wanted:
        if folder.size(name) != size or (verify and folder.digest(name) != sha):
            return None
    return entry


def _make(task: Task, folder: Folder, notes: list[str]) -> dict[str, Any]:
    folder.remove(record(task.shard))
    # As text: a shard may have a million of them.
    rejected: list[bytes] = []
    drift: dict[str, float] = {}
    width, at = len(task.columns), task.job.get("at")
    places = [] if at is None else ["row", "time"]
    names, count = places + task.columns, len(at or [0])

    def fill(file: Any) -> None:
        sink = None
        row = task.start
        for numbers, kept in _groups(task, group_rows(width * count)):
            made = core.advance(task.job, numbers, task.threads)
            for index, step, reason in made.bad:
                line = {"row": row + index, "step": step, "reason": reason}
                rejected.append(json.dumps(line, ensure_ascii=False).encode() + b"\n")
            raise_to(drift, made.drift)
            notes.extend(text for text in made.notes if text not in notes)
            states = made.states
            if at is not None:
                lines = np.arange(len(states)) // count
                kept = None if kept is None else kept.take(lines)
                states = np.column_stack([row + lines, np.tile(at, len(numbers)), states])
            table = parquet.table(names, states, kept)
            sink = sink or parquet.writer(file, table.schema)
            sink.write_table(table, row_group_size=max(table.num_rows, 1))
            row += len(numbers)
        if sink is None:
            table = parquet.table(names, np.empty((0, len(names))), parquet.no_rows(task.keep))
            sink = parquet.writer(file, table.schema)
            sink.write_table(table)
        sink.close()
        if row != task.stop:
            raise ShardError(f"the input has {row - task.start} rows where {task.stop - task.start} were planned")

    size, sha = folder.write(part(task.shard), fill)
    entry: dict[str, Any] = {
        "shard": task.shard,
        "start": task.start,
        "rows": task.stop - task.start,
        "bytes": size,
        "sha256": sha,
        "bad": len(rejected),
        "drift": drift,
    }
    if rejected:
        entry["bad_bytes"], entry["bad_sha256"] = folder.put(bad_list(task.shard), b"".join(rejected))
    folder.put(record(task.shard), seal(entry))
    return entry


def _groups(task: Task, size: int) -> Iterator[tuple[Floats, pa.Table | None]]:
    """The rows of a shard, ``size`` at a time whatever pieces the files have them in."""
    numbers: list[Floats] = []
    kept: list[pa.RecordBatch] = []
    missing = size
    for piece in task.pieces:
        for matrix, others in states.batches(piece, task.columns, task.keep, size, task.storage_options):
            while len(matrix):
                take = min(missing, len(matrix))
                numbers.append(matrix[:take])
                matrix = matrix[take:]
                if others is not None:
                    kept.append(others.slice(0, take))
                    others = others.slice(take)
                missing -= take
                if missing == 0:
                    yield np.concatenate(numbers), pa.Table.from_batches(kept) if kept else None
                    numbers, kept, missing = [], [], size
    if numbers:
        yield np.concatenate(numbers), pa.Table.from_batches(kept) if kept else None


def placed(task: Task, text: str) -> str:
    """A message that names the shard."""
    here = f"shard {task.shard} (rows {task.start} to {task.stop - 1})"
    return text if text.startswith("shard ") else f"{here}: {text}"


def _worker() -> str:
    return f"{socket.gethostname()}:{os.getpid()}"
