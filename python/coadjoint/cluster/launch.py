"""One call from a file of states to a folder of end states, by whatever there is to run it."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from . import core, local, manifest, result, shard, states
from .columns import choose
from .drive import Engine, drive
from .errors import ClusterError, InputError
from .files import Folder, absolute
from .plan import plan
from .progress import Counter, Progress
from .result import Result
from .shard import Summary, Task


def run(
    system: Any,
    *,
    states: str | os.PathLike[str] | Sequence[str],
    out: str | os.PathLike[str],
    time: float | None = None,
    step: float | None = None,
    tolerance: float | None = None,
    region: float | None = None,
    truncation: int | None = None,
    backend: str = "auto",
    client: Any = None,
    workers: int | None = None,
    threads: int = 1,
    rows_per_shard: int | None = None,
    share: tuple[int, int] | None = None,
    keep: Sequence[str] = (),
    attempts: int = 3,
    restart: bool = False,
    verify: bool = True,
    progress: bool | Callable[[Progress], None] = True,
    storage_options: dict[str, Any] | None = None,
) -> Result:
    """Advances every row of files of states, on many processes or machines, into a folder of Parquet files.

    The files in ``out`` have the same bytes whatever runs the shards, however many workers there are, and whatever
    was killed on the way. Called again, it keeps the shards that are finished and makes the others.

    Parameters
    ----------
    system : coadjoint.System
        The system.
    states : path, fsspec name, pattern, folder, or list
        ``.parquet`` with columns ``mu_1`` … ``mu_n`` and if you like the attitude (``g_11`` … ``g_dd``, or ``q_w``,
        ``q_x``, ``q_y``, ``q_z`` on SO(3)), or ``.npy`` of that many columns. Rows of several files are counted
        through, in the order of the list or of their names.
    out : path or fsspec name
        The folder: ``part-00000.parquet`` … with a row for every row of ``states``, and ``_run`` with the manifest,
        records of shards, and lists of bad rows.
    time, step, tolerance : float, optional
        The duration, and the step or the tolerance; the system's own if not given.
    region : float, optional
        The norm of momenta up to which the tolerance is to hold; along the system's own run if not given.
    truncation : int, optional
        S₁ … S_K are kept, K odd; the system's own if not given.
    backend : str
        What makes the steps: see ``System.ensemble``. The bytes do not depend on it.
    client : optional
        A ``distributed.Client``, or the module ``ray`` after ``ray.init()``. Without one, processes of this machine.
    workers : int, optional
        How many processes, without a client; one for each processor if not given. With 1 this process does it.
    threads : int
        Threads of each worker; with Ray, the processors that it reserves.
    rows_per_shard : int, optional
        How many rows make a shard; chosen by the number of steps if not given.
    share : (i, n), optional
        Only the share i of n of the shards, i from 1: for job arrays.
    keep : list of str
        Other columns of ``.parquet`` files that go through unchanged.
    attempts : int
        How often a shard is tried whose worker dies.
    restart : bool
        Forgets what an earlier run has left in ``out``.
    verify : bool
        Whether finished shards are read again and compared with their SHA-256 before they are kept; else their sizes
        are compared.
    progress : bool or function
        A line on the error stream, nothing, or a function of a ``Progress``.
    storage_options : dict, optional
        For fsspec: of ``states`` and ``out``. They are never written down.

    Raises
    ------
    InputError
        Where the states or an option cannot be used.
    ManifestError
        Where ``out`` holds another run; it says in what the two differ.
    ShardError
        Where a shard cannot be made. What is finished stays.
    ClusterError
        Where not a single row reaches the end.
    """
    asked = {"time": time, "step": step, "tolerance": tolerance, "region": region, "truncation": truncation}
    job = Job(system, states, out, asked, backend, rows_per_shard, share, keep, storage_options)
    if isinstance(attempts, bool) or not isinstance(attempts, int) or attempts < 1:
        raise InputError(f"attempts = {attempts!r}: a whole number, at least 1, is needed")
    if isinstance(threads, bool) or not isinstance(threads, int) or threads < 1:
        raise InputError(f"threads = {threads!r}: a whole number, at least 1, is needed")
    if restart and share is not None:
        raise InputError(
            "restart with share: every job would remove what the others have made; remove the folder once, or begin "
            "anew by a call without share"
        )
    engine = engine_of(client, workers, threads)
    job.settle(restart)
    return job.run(engine, attempts, threads, verify, progress)


def engine_of(client: Any, workers: int | None, threads: int) -> Engine:
    """What runs the shards."""
    if client is None:
        return local.engine(workers)
    home = client.__name__ if hasattr(client, "__path__") else type(client).__module__
    if home != "ray" and home.split(".")[0] != "distributed":
        raise InputError(
            f"client is {client!r}: a dask.distributed.Client, the module ray after ray.init(), or nothing is needed"
        )
    if workers is not None:
        raise InputError("workers is for processes of this machine: the client has its own number")
    if home == "ray":
        from .ray_engine import Ray

        return Ray(client, threads)
    from .dask_engine import Dask

    return Dask(client)


class Job:
    """A run that is planned."""

    def __init__(
        self,
        system: Any,
        names: Any,
        out: str | os.PathLike[str],
        asked: dict[str, Any],
        backend: str,
        rows_per_shard: int | None,
        share: tuple[int, int] | None,
        keep: Sequence[str],
        storage_options: dict[str, Any] | None,
    ) -> None:
        self.options = storage_options
        self.folder = Folder(absolute(out), storage_options)
        self.states = states.inspect(names, storage_options)
        # Everything that workers need to make the same steps, as text and numbers.
        self.core = core.pin(system, asked, backend)
        self.columns = choose(self.states.columns, core.layouts(self.core))
        for name in self.columns:
            if name in self.states.others:
                raise InputError(f"column {name} is of the type {self.states.others[name]}; numbers are needed")
        self.keep = self._kept(keep)
        self.plan = plan(self.states.rows, self.core["steps"], rows_per_shard)
        self.shards = range(self.plan.shards) if share is None else self.plan.share(*share)
        self.versions = core.versions()

    def _kept(self, keep: Sequence[str]) -> list[str]:
        if isinstance(keep, str):
            keep = [keep]
        available = self.states.columns
        for name in keep:
            if isinstance(available, int):
                raise InputError(f"keep: {name}: only .parquet files have columns with names")
            if name not in available:
                raise InputError(f"keep: there is no column {name}; there are {', '.join(available)}")
            if name in self.columns:
                raise InputError(f"keep: column {name} is part of the state and changes")
        return list(dict.fromkeys(keep))

    def manifest(self) -> dict[str, Any]:
        """What the bytes of the run depend on."""
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
                manifest.forget(self.folder)
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
        self, engine: Engine, attempts: int, threads: int, verify: bool, progress: bool | Callable[[Progress], None]
    ) -> Result:
        """Makes all shards of this call, and what is to be written when the last one of all is there."""
        begun = time.perf_counter()
        rows = sum(stop - start for start, stop in map(self.plan.rows_of, self.shards))
        counter = Counter(len(self.shards), rows, progress, engine.workers)
        found: dict[int, Summary] = {}

        def done(summary: Summary | None) -> None:
            if summary is not None:
                found[summary.shard] = summary
                counter.finished(summary.rows, summary.bad, summary.kept)
            counter.tell()

        try:
            again = drive(engine, self.tasks(threads, verify), attempts, done)
        finally:
            counter.close()
            # What workers have left that were killed, here or elsewhere.
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
            rows_per_second=sum(s.rows for s in found.values() if not s.kept) / seconds,
            shard_seconds={number: found[number].seconds for number in sorted(found)},
            worker_memory=max((summary.memory for summary in found.values()), default=0),
            storage_options=self.options,
        )
        if rows and outcome.bad == rows:
            first = next(outcome.bad_rows(), {"reason": "unknown"})
            raise ClusterError(
                f"all {rows} rows are without an end state, the first because {first['reason']}; "
                f"{self.folder.name}/_run/bad-*.jsonl lists them"
            )
        return outcome
