"""One call from a file of states to a folder of end states, by whatever there is to run it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

from .._arrays import Backend, Numbers, Real, count, flag
from .._progress import Progress
from ..system import System
from .drive import Engine
from .engines import Dask, Here, Ray
from .errors import InputError
from .job import Job
from .result import Result


def run(
    system: System,
    *,
    states: str | os.PathLike[str] | Sequence[str],
    out: str | os.PathLike[str],
    t0: Real | None = None,
    time: Real | None = None,
    step: Real | None = None,
    tolerance: Real | None = None,
    region: Real | None = None,
    truncation: int | None = None,
    at: Numbers | None = None,
    backend: Backend = "auto",
    client: Any = None,
    threads: int | None = None,
    rows_per_shard: int | None = None,
    share: tuple[int, int] | None = None,
    keep: Sequence[str] = (),
    attempts: int = 3,
    restart: bool = False,
    verify: bool = True,
    progress: bool | Progress | None = None,
    storage_options: dict[str, Any] | None = None,
) -> Result:
    """Advances every row of files of states, on one machine or many, into a folder of Parquet files.

    The files in ``out`` have the same bytes whatever runs the shards, however many workers there are, and whatever
    was killed on the way. Called again, it keeps the shards that are finished and makes the others.

    Parameters
    ----------
    system : coadjoint.System
        The system.
    states : path, fsspec name, pattern, folder, or list
        ``.parquet`` with columns ``mu_1`` … ``mu_n`` and if you like the attitude (``g_11`` … ``g_dd``, or ``q_w``,
        ``q_x``, ``q_y``, ``q_z`` on SO(3)). Rows of several files are counted through, in the order of the list or of
        their names.
    out : path or fsspec name
        The folder: ``part-00000.parquet`` … with a row for every row of ``states``, and ``_run`` with the manifest,
        records of shards, and lists of bad rows.
    t0, time, step, tolerance : float, optional
        The time at the start, the duration, and the step or the tolerance; the system's own if not given.
    region : float, optional
        The norm of momenta up to which the tolerance is to hold; along the system's own run if not given.
    truncation : int, optional
        S₁ … S_K are kept, K odd; the system's own if not given.
    at : list of times, optional
        Trajectories in place of end states: for every row of ``states`` a row at each time, with the columns ``row``
        (counted from 0) and ``time`` in front.
    backend : str
        What makes the steps: see ``System.ensemble``. The bytes do not depend on it.
    client : optional
        A ``distributed.Client``, or the module ``ray`` after ``ray.init()``. Without one, this process.
    threads : int, optional
        Threads of each worker, 1 if not given; with Ray, the processors that it reserves. Without a client, threads of this
        process, one for each processor if not given.
    rows_per_shard : int, optional
        How many rows make a shard; chosen by the number of steps if not given.
    share : (i, n), optional
        Only the share i of n of the shards, i from 1: for job arrays.
    keep : list of str
        Other columns that go through unchanged.
    attempts : int
        How often a shard is tried whose worker dies.
    restart : bool
        Forgets what an earlier run has left in ``out``.
    verify : bool
        Whether finished shards are read again and compared with their SHA-256 before they are kept; else their sizes
        are compared.
    progress : bool or function, optional
        A bar, nothing, or a function of (rows done, rows), as for ``System.ensemble``.
    storage_options : dict, optional
        For fsspec: of ``states`` and ``out``. They are never written down.

    Raises
    ------
    InputError
        Where the states or an option cannot be used.
    ManifestError
        Where ``out`` holds another run; it says in what the two differ.
    ShardError
        Where a shard cannot be made. Finished shards stay.
    ClusterError
        Where not a single row reaches the end.
    """
    asked = {"t0": t0, "time": time, "step": step, "tolerance": tolerance, "region": region, "truncation": truncation}
    job = Job(system, states, out, asked, backend, rows_per_shard, share, keep, storage_options, at)
    if threads is None:
        threads = 1 if client is not None else _processors()
    attempts, threads = count(attempts, "attempts", 1), count(threads, "threads", 1)
    restart, verify = flag(restart, "restart"), flag(verify, "verify")
    if restart and share is not None:
        raise InputError(
            "restart with share: every job would remove what the others have made; remove the folder once, or begin "
            "anew by a call without share"
        )
    engine = engine_of(client, threads)
    job.settle(restart)
    return job.run(engine, attempts, threads, verify, progress)


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def engine_of(client: Any, threads: int) -> Engine:
    """The engine that runs the shards."""
    if client is None:
        return Here()
    home = client.__name__ if hasattr(client, "__path__") else type(client).__module__
    if home != "ray" and home.split(".")[0] != "distributed":
        raise InputError(
            f"client is {client!r}: a dask.distributed.Client, the module ray after ray.init(), or nothing is needed"
        )
    return Ray(client, threads) if home == "ray" else Dask(client)
