"""Files that ``coadjoint ensemble --shard i/n --keep`` has written, checked and put together."""

from __future__ import annotations

import csv
import json
import os
import shutil
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import IO, Any

import numpy as np

from . import parquet
from .errors import ClusterError, InputError, ManifestError
from .files import Folder, absolute, digest


@dataclass(frozen=True)
class _Shard:
    path: str
    note: dict[str, Any]
    index: int
    count: int


def join_shards(files: Sequence[str | os.PathLike[str]], to: str | os.PathLike[str]) -> dict[str, int]:
    """Puts the files of all shards together, in the order of the shards, and the lists of rejected rows.

    Every file must be as its note ``FILE.done`` says, the notes must be of one run, and no shard may be missing: else
    ClusterError. Returns the rows and the rejected ones. The joined file is that of a run in one piece (but for
    Parquet, whose row groups stay as they are).
    """
    found = sorted((_read(absolute(file)) for file in files), key=lambda each: each.index)
    if not found:
        raise InputError("no files are given")
    target = absolute(to)
    ending = target.rsplit(".", 1)[-1].lower()
    for each in found:
        if each.path.rsplit(".", 1)[-1].lower() != ending:
            raise InputError(f"{each.path} and {target} are of different formats")
    _same_run(found)
    parent, _, name = target.rpartition("/")
    folder = Folder(parent or "/")
    write = {"csv": _csv, "npy": _npy, "parquet": _parquet}.get(ending)
    if write is None:
        raise InputError(f"{target}: the name must end in .csv, .npy or .parquet")
    paths = [each.path for each in found]
    lists = [f"{each.path}.rejected.csv" for each in found if each.note["journal"]["rejected"]]
    inputs = [*paths, *lists]
    folder.write(name, lambda file: write(file, paths), passing_in="", inputs=inputs)
    rejected = f"{name}.rejected.csv"
    if lists:
        folder.write(rejected, lambda file: _csv(file, lists), passing_in="", inputs=inputs)
    elif (folder.read(rejected) or b"").startswith(b"row,step,reason\n"):
        folder.remove(rejected)
    journals = [each.note["journal"] for each in found]
    return {key: sum(journal[key] for journal in journals) for key in ("rows", "rejected")}


def _read(path: str) -> _Shard:
    try:
        with open(f"{path}.done", "rb") as file:
            raw = file.read()
        # As the command has sealed it: the checksum of all that follows it.
        head, _, rest = raw.partition(b'",')
        if head != b'{"crc32":"%08x' % zlib.crc32(rest):
            raise ValueError("its checksum is not that of its content")
        note = json.loads(raw)
        index, count = map(int, note["journal"]["identity"]["shard"].split("/"))
    except FileNotFoundError:
        raise ClusterError(
            f"{path} is not finished, or was made without --keep: there is no {path}.done. Run its job again"
        ) from None
    except (ValueError, KeyError, TypeError) as error:
        raise ManifestError(f"{path}.done cannot be read: {error!r}") from None
    lists = [(path, note["sha256"])]
    if note["journal"]["rejected"]:
        lists.append((f"{path}.rejected.csv", note["rejected_sha256"]))
    for name, known in lists:
        try:
            with open(name, "rb") as file:
                same = digest(file) == known
        except FileNotFoundError:
            same = False
        if not same:
            raise ClusterError(f"{name} is not what {path}.done says. Run its job again")
    return _Shard(path, note, index, count)


def _same_run(found: list[_Shard]) -> None:
    first = found[0]
    for each in found:
        ours, others = first.note["journal"]["identity"], each.note["journal"]["identity"]
        for key in sorted(ours.keys() | others.keys()):
            if key != "shard" and ours.get(key) != others.get(key):
                raise ManifestError(
                    f"{first.path} and {each.path} are of different runs: "
                    f"{key} is {ours.get(key)} and {others.get(key)}"
                )
        if each.count != first.count:
            raise ManifestError(f"{first.path} is one of {first.count} shards, {each.path} one of {each.count}")
    indices = [each.index for each in found]
    missing = sorted(set(range(1, first.count + 1)) - set(indices))
    if missing:
        raise ClusterError(f"of {first.count} shards these are missing: {', '.join(map(str, missing))}")
    for before, after in zip(found, found[1:]):
        if before.index == after.index:
            raise InputError(f"{before.path} and {after.path} are the same shard")


def _csv(file: IO[bytes], paths: list[str]) -> None:
    for number, path in enumerate(paths):
        with open(path, encoding="utf-8", newline="") as source:
            reader = csv.reader(source)
            next(reader, None)
            lines = reader.line_num
        with open(path, "rb") as source:
            header = b"".join(source.readline() for _ in range(lines))
            if number == 0:
                file.write(header)
            shutil.copyfileobj(source, file, 1 << 20)


def _npy(file: IO[bytes], paths: list[str]) -> None:
    arrays = [np.load(path, mmap_mode="r") for path in paths]
    rows = sum(len(array) for array in arrays)
    header = {"descr": "<f8", "fortran_order": False, "shape": (rows, arrays[0].shape[1])}
    np.lib.format.write_array_header_1_0(file, header)
    for path, array in zip(paths, arrays):
        with open(path, "rb") as source:
            source.seek(os.path.getsize(path) - array.nbytes)
            shutil.copyfileobj(source, file, 1 << 20)


def _parquet(file: IO[bytes], paths: list[str]) -> None:
    parquet.joined(file, (open(path, "rb") for path in paths))
