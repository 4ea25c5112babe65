"""A run that is planned: which shards there are, and what they need."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Sequence
from typing import Any

from .._arrays import Backend, Numbers, listed, unused
from .._progress import Progress, listener
from ..system import System
from . import core, manifest, result, shard, states
from .drive import Engine, drive
from .errors import ClusterError, InputError
from .files import Folder, absolute
from .plan import Plan, plan
from .result import Result
from .shard import Summary, Task


def forget(folder: Folder, wanted: dict[str, Any]) -> None:
    """Removes the files that the manifest in a folder names, and then replaces it. Without one nothing is removed."""
    known = manifest.read(folder)
    if known is None:
        return
    shards = range(Plan(known["plan"]["rows"], known["plan"]["rows_per_shard"]).shards)
    there = {*folder.names(), *(f"_run/{name}" for name in folder.names("_run"))}
    names = {result.SUMMARY, *(of(n) for n in shards for of in (shard.part, shard.record, shard.bad_list))}
    for name in sorted(names & there):
        folder.remove(name)
    folder.sweep(lambda name: (shard.number(name) or 0) in shards)
    folder.put(manifest.NAME, manifest.seal(wanted))


class Job:
    """A run that is planned."""

    def __init__(
        self,
        system: System,
        names: Any,
        out: str | os.PathLike[str],
        asked: dict[str, Any],
        backend: Backend,
        rows_per_shard: int | None,
        share: tuple[int, int] | None,
        keep: Sequence[str],
        storage_options: dict[str, Any] | None,
        at: Numbers | None,
    ) -> None:
        self.options = storage_options
        self.folder = Folder(absolute(out), storage_options)
        self.states = states.inspect(names, storage_options)
        self.columns, others, parameters = core.columns(system, self.states.columns)
        # Everything that workers need to make the same steps, as text and numbers.
        self.core = core.pin(system, asked, backend, at, parameters)
        for name in self.columns:
            if name in self.states.others:
                raise InputError(f"column {name} is of the type {self.states.others[name]}; numbers are needed")
        self.keep = self._kept(keep)
        unused("states", [name for name in others if name not in self.keep])
        self.plan = plan(self.states.rows, self.core["steps"], rows_per_shard)
        self.shards = range(self.plan.shards) if share is None else self.plan.share(*listed(share, "share"))
        self.versions = core.versions()

    def _kept(self, keep: Sequence[str]) -> list[str]:
        keep = [keep] if isinstance(keep, str) else listed(keep, "keep")
        available = self.states.columns
        for name in keep:
            if name not in available:
                raise InputError(f"keep: there is no column {name}; there are {', '.join(available)}")
            if name in self.columns:
                raise InputError(f"keep: column {name} is part of the state and changes")
        return list(dict.fromkeys(keep))

    def manifest(self) -> dict[str, Any]:
        """Everything that the bytes of the run depend on."""
        return {
            "format": 1,
            "versions": self.versions,
            "job": self.core,
            # Without folders: states may be moved between one call and the next.
            "states": [
                {"name": file.name.rsplit("/", 1)[-1], "bytes": file.size, "rows": file.rows, "sha256": file.hash}
                for file in self.states.files
            ],
            "columns": self.columns,
            "keep": self.keep,
            "plan": {"rows": self.plan.rows, "rows_per_shard": self.plan.rows_per_shard, "shards": self.plan.shards},
        }

    def settle(self, restart: bool) -> None:
        """Takes the folder, or refuses one of another run."""
        for file in self.states.files:
            if file.name.startswith(self.folder.path + "/") or file.name.startswith(self.folder.name + "/"):
                raise InputError(f"out is the folder of {file.name}: give another one")
        try:
            if restart:
                forget(self.folder, self.manifest())
            manifest.settle(self.folder, self.manifest())
        except OSError as error:
            raise ClusterError(f"out: {self.folder.name} cannot be written: {error}") from error

    def tasks(self, threads: int, verify: bool) -> Iterator[Task]:
        """The shards of this call."""
        for number in self.shards:
            start, stop = self.plan.rows_of(number)
            yield Task(
                shard=number,
                start=start,
                stop=stop,
                pieces=self.states.pieces(start, stop),
                columns=self.columns,
                keep=self.keep,
                job=self.core,
                versions=self.versions,
                out=self.folder.name,
                storage_options=self.options,
                threads=threads,
                verify=verify,
            )

    def run(
        self, engine: Engine, attempts: int, threads: int, verify: bool, progress: bool | Progress | None
    ) -> Result:
        """Makes all shards of this call, and what is to be written when the last one of all is there."""
        begun = time.perf_counter()
        rows = sum(stop - start for start, stop in map(self.plan.rows_of, self.shards))
        found: dict[int, Summary] = {}
        with listener(progress, "rows") as told:

            def done(summary: Summary) -> None:
                found[summary.shard] = summary
                if told is not None:
                    told(sum(each.rows for each in found.values()), rows)

            try:
                again = drive(engine, self.tasks(threads, verify), attempts, done)
            finally:
                # Remove the partial files of killed workers, here or elsewhere.
                self.folder.sweep(lambda name: shard.number(name) in self.shards)
        complete = result.summarize(self.folder, self.plan)
        drift: dict[str, float] = {}
        for summary in found.values():
            shard.raise_to(drift, summary.drift)
        seconds = time.perf_counter() - begun
        outcome = Result(
            out=self.folder.name,
            rows=rows,
            bad=sum(summary.bad for summary in found.values()),
            made=sum(not summary.kept for summary in found.values()),
            kept=sum(summary.kept for summary in found.values()),
            again=again,
            complete=complete,
            drift=drift,
            warnings=core.warnings(drift.pop("ratio", 0.0), [note for s in found.values() for note in s.notes]),
            seconds=seconds,
            storage_options=self.options,
        )
        if rows and outcome.bad == rows:
            first = next(outcome.bad_rows(), {"reason": "unknown"})
            raise ClusterError(
                f"all {rows} rows are without an end state, the first because {first['reason']}; "
                f"{self.folder.name}/_run/bad-*.jsonl lists them"
            )
        return outcome
