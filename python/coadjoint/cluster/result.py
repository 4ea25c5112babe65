"""The output of a run: its parts, its bad rows, and whether all of it is as it was written."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from . import manifest, shard
from .errors import ClusterError, ManifestError
from .files import Folder, absolute
from .plan import Plan

SUMMARY = "_run/summary.json"


@dataclass(frozen=True, repr=False)
class Result:
    """A run, or the share of one that a call has made."""

    #: The folder.
    out: str
    #: Rows of the shards that the call was for.
    rows: int
    #: Rows of them without an end state: NaN in the parts, and listed.
    bad: int
    #: Shards that this call has made, and those that it has found finished.
    made: int
    kept: int
    #: How often a shard was handed over again because its worker died; Dask does not say how often it did.
    again: int
    #: Whether the whole run is finished, not only this share.
    complete: bool
    #: The largest relative drifts of the spatial momentum and of the Casimirs.
    drift: dict[str, float]
    #: What should be known of the run: a series that hardly converges, a compiler that a worker did not find.
    warnings: list[str]
    seconds: float
    storage_options: dict[str, Any] | None = None

    def __repr__(self) -> str:
        """A few lines, without what may be secret."""
        state = "complete" if self.complete else "not complete yet"
        drifts = ", ".join(f"{name.replace('_', ' ')} {value:.1e}" for name, value in sorted(self.drift.items()))
        lines = [
            f"{self.out}: {state}",
            f"  {self.rows:,} rows, {self.bad:,} bad; {self.made:,} shards made, {self.kept:,} kept",
            f"  largest relative drift: {drifts}",
            f"  {self.seconds:.1f} s",
        ]
        return "\n".join(lines + [f"  warning: {text}" for text in self.warnings])

    def bad_rows(self) -> Iterator[dict[str, Any]]:
        """The rows without an end state: row (counted from 0), step, reason."""
        return bad_rows(self.out, self.storage_options)


def bad_rows(out: str | os.PathLike[str], storage_options: dict[str, Any] | None = None) -> Iterator[dict[str, Any]]:
    """The rows without an end state in a folder of results, in their order."""
    folder = Folder(absolute(out), storage_options)
    for name in folder.names("_run"):
        if name.startswith("bad-"):
            content = folder.read(f"_run/{name}") or b""
            record = folder.read(shard.record(shard.number(name) or 0))
            # Without its record a shard is being made.
            if record is None:
                continue
            known = manifest.unseal(record).get("bad_sha256")
            if hashlib.sha256(content).hexdigest() != known:
                raise ClusterError(f"{folder.name}/_run/{name} is not as it was written: call run again")
            for line in content.split(b"\n"):
                if line:
                    yield json.loads(line)


def summarize(folder: Folder, plan: Plan) -> bool:
    """Writes the record of a whole run, if it is whole; whether it is."""
    there = set(folder.names("_run"))
    records = [shard.record(number) for number in range(plan.shards)]
    if any(name.removeprefix("_run/") not in there for name in records):
        return False
    total: dict[str, Any] = {"rows": 0, "bad": 0, "shards": plan.shards, "drift": {}}
    for content in folder.read_all(records):
        try:
            entry = manifest.unseal(content)
        except ValueError:
            return False
        total["rows"] += entry["rows"]
        total["bad"] += entry["bad"]
        shard.raise_to(total["drift"], entry["drift"])
    folder.put(SUMMARY, manifest.seal(total))
    return True


def check(out: str | os.PathLike[str], storage_options: dict[str, Any] | None = None) -> dict[str, Any]:
    """Reads everything that a finished run has written and compares it with its records.

    Returns the record of the run: rows, bad, shards, drift. Raises ClusterError with the shards that are missing or
    changed; calling ``run`` again makes them.
    """
    folder = Folder(absolute(out), storage_options)
    known = manifest.read(folder)
    if known is None:
        raise ManifestError(f"{folder.name} has no manifest: it is no folder of coadjoint.cluster.run")
    plan = Plan(known["plan"]["rows"], known["plan"]["rows_per_shard"])
    wrong = []
    for number in range(plan.shards):
        start, stop = plan.rows_of(number)
        if shard.finished(folder, number, start, stop, verify=True) is None:
            wrong.append(number)
    if wrong:
        some = ", ".join(map(str, wrong[:10])) + (", …" if len(wrong) > 10 else "")
        raise ClusterError(
            f"{folder.name}: of {plan.shards} shards {len(wrong)} are missing or changed ({some}); call run again"
        )
    summarize(folder, plan)
    return manifest.unseal(folder.read(SUMMARY) or b"{}")


__all__ = ["Result", "bad_rows", "check", "summarize"]
