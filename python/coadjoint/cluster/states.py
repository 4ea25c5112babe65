"""States in files: what is in them, and their rows piece by piece."""

from __future__ import annotations

import os
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from .._arrays import Floats, listed
from .errors import InputError, ShardError
from .files import absolute, fingerprint, locate

#: Numbers as a matrix, and the columns to keep as they are.
Batch = tuple[Floats, pa.RecordBatch | None]

_PIECES = 64


@dataclass(frozen=True)
class File:
    """One file of states: its name, bytes, rows, and hash."""

    name: str
    size: int
    rows: int
    hash: str


@dataclass(frozen=True)
class States:
    """The files that together are the input, in their order. Rows are counted through all of them."""

    files: tuple[File, ...]
    #: The names of the columns.
    columns: tuple[str, ...]
    #: The types of those that hold no numbers.
    others: dict[str, str]

    @cached_property
    def _ends(self) -> list[int]:
        return list(accumulate(file.rows for file in self.files))

    @property
    def rows(self) -> int:
        """The rows of all files together."""
        return self._ends[-1]

    def pieces(self, start: int, stop: int) -> list[tuple[str, int, int, int]]:
        """The rows ``start`` to ``stop`` as (file, bytes of the file, first row in it, row behind the last)."""
        found = []
        for number in range(bisect_right(self._ends, start), len(self.files)):
            file, before = self.files[number], self._ends[number] - self.files[number].rows
            if before >= stop:
                break
            if file.rows:
                found.append((file.name, file.size, max(start - before, 0), min(stop - before, file.rows)))
        return found


def inspect(names: str | os.PathLike[str] | Sequence[str], options: dict[str, Any] | None = None) -> States:
    """Looks at files of states: a file, a pattern with ``*``, a folder of ``.parquet`` files, or a list of these."""
    if isinstance(names, np.ndarray) or hasattr(names, "columns"):
        raise InputError(
            "states is an array or a frame: for an ensemble that fits into memory call system.ensemble(states, ...), "
            "or write it to a .parquet file and give the name of that"
        )
    several = [names] if isinstance(names, (str, os.PathLike)) else listed(names, "states")
    found: list[tuple[Any, str, str]] = []
    for name in several:
        found += _expand(absolute(name), options)
    if not found:
        raise InputError(f"{names}: there is no such file")
    pieces = max(2, _PIECES // len(found))
    files: list[File] = []
    columns: tuple[str, ...] | None = None
    others: dict[str, str] = {}
    for fs, path, name in found:
        size = int(fs.info(path)["size"])
        rows, here, kinds = _header(fs, path, name)
        others |= kinds
        if columns not in (None, here):
            raise InputError(f"{name} has the columns {here}, the files before it have {columns}")
        columns = here
        files.append(File(name, size, rows, fingerprint(fs, path, size, pieces)))
    return States(tuple(files), columns or (), others)


def _expand(name: str, options: dict[str, Any] | None) -> list[tuple[Any, str, str]]:
    fs, path = locate(name, options)
    if any(sign in path for sign in "*?["):
        paths = sorted(fs.glob(path))
    elif fs.isdir(path):
        paths = sorted(entry for entry in fs.ls(path, detail=False) if entry.endswith(".parquet"))
        if not paths:
            raise InputError(f"{name}: the folder has no .parquet file")
    elif fs.exists(path):
        paths = [path]
    else:
        raise InputError(f"{name}: there is no such file")
    if paths == [path]:
        return [(fs, path, name)]
    return [(fs, each, fs.unstrip_protocol(each) if "://" in name else each) for each in paths]


def _header(fs: Any, path: str, name: str) -> tuple[int, tuple[str, ...], dict[str, str]]:
    """Rows, columns, and the types of those that hold no numbers."""
    if not name.endswith(".parquet"):
        raise InputError(
            f"{name}: the name must end in .parquet; convert other files once, as by "
            "pyarrow.parquet.write_table(pyarrow.csv.read_csv('states.csv'), 'states.parquet'), or "
            "pyarrow.parquet.write_table(pyarrow.table(list(numpy.load('states.npy').T), names), 'states.parquet')"
        )
    try:
        with fs.open(path, "rb") as file, pq.ParquetFile(file) as parquet:
            schema = parquet.schema_arrow
            others = {field.name: str(field.type) for field in schema if not _is_number(field.type)}
            return parquet.metadata.num_rows, tuple(schema.names), others
    except pa.ArrowException as error:
        raise InputError(f"{name}: {error}") from error


def _is_number(kind: pa.DataType) -> bool:
    return bool(pa.types.is_floating(kind) or pa.types.is_integer(kind))


def batches(
    piece: tuple[str, int, int, int],
    columns: Sequence[str],
    keep: Sequence[str],
    size: int,
    options: dict[str, Any] | None = None,
) -> Iterator[Batch]:
    """The rows of a piece, at most ``size`` at a time."""
    name, length, start, stop = piece
    fs, path = locate(name, options)
    found = int(fs.info(path)["size"])
    if found != length:
        raise ShardError(f"{name} has {found} bytes; it had {length} when the run was planned")
    wanted = [*columns, *(column for column in keep if column not in columns)]
    # Buffered and not fetched ahead: memory stays small however large the row groups are.
    with fs.open(path, "rb") as file, pq.ParquetFile(file, buffer_size=1 << 20, pre_buffer=False) as parquet:
        groups, before, first = [], 0, None
        for group in range(parquet.num_row_groups):
            rows = parquet.metadata.row_group(group).num_rows
            if before < stop and before + rows > start:
                groups.append(group)
                first = before if first is None else first
            before += rows
        row = first or 0
        for batch in parquet.iter_batches(size, row_groups=groups, columns=wanted, use_threads=False):
            low, high = max(start - row, 0), min(stop - row, batch.num_rows)
            row += batch.num_rows
            if low < high:
                batch = batch.slice(low, high - low)
                numbers = np.empty((batch.num_rows, len(columns)))
                for place, column in enumerate(columns):
                    numbers[:, place] = _numbers(batch.column(column))
                yield numbers, batch.select(list(keep)) if keep else None
            if row >= stop:
                break


def _numbers(column: pa.Array) -> Floats:
    """A column as floating-point numbers; what is missing is NaN."""
    numbers: Floats = column.cast(pa.float64()).to_numpy(zero_copy_only=False)
    return numbers
