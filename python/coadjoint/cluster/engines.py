"""Shards in this process, or as tasks of a Dask cluster or of Ray."""

from __future__ import annotations

import queue
import uuid
from collections.abc import Iterable
from typing import Any

from . import shard
from .errors import ClusterError, InputError, ShardError, WorkerDied
from .shard import Summary, Task


class Here:
    """One shard after the other in this process."""

    capacity = 1

    def submit(self, task: Task) -> Task:
        """Does nothing before the result is asked for."""
        return task

    def wait(self, handles: Iterable[Task]) -> list[Task]:
        """All results can be asked for."""
        return list(handles)

    def result(self, handle: Task) -> Summary:
        """Makes the shard."""
        return shard.run(handle)

    def close(self) -> None:
        """Nothing is left."""


class Dask:
    """Hands shards to a ``distributed.Client``. Shards of workers that die go to others by Dask's own rules."""

    #: Enough for adaptive clusters to see what there is to do, little enough for the scheduler.
    capacity = 10_000

    def __init__(self, client: Any) -> None:
        if client.asynchronous:
            raise InputError("client is asynchronous: make it by Client(...), without asynchronous=True")
        if client.status != "running":
            raise InputError(f"client is {client.status}: it has no scheduler to hand shards to")
        self._client = client
        self._run = uuid.uuid4().hex[:8]
        self._count = 0
        self._futures: set[Any] = set()
        self._done: queue.SimpleQueue[Any] = queue.SimpleQueue()

    def submit(self, task: Task) -> Any:
        """Hands the shard to the scheduler."""
        self._count += 1
        key = f"coadjoint-{self._run}-{task.shard}-{self._count}"
        future = self._client.submit(shard.run, task, key=key, pure=False)
        self._futures.add(future)
        future.add_done_callback(self._done.put)
        return future

    def wait(self, handles: Iterable[Any]) -> list[Any]:
        """Those that are done."""
        found = []
        try:
            found.append(self._done.get(timeout=0.5))
            while True:
                found.append(self._done.get_nowait())
        except queue.Empty:
            return found

    def result(self, handle: Any) -> Summary:
        """Its summary."""
        from distributed.client import FutureCancelledError
        from distributed.scheduler import KilledWorker

        self._futures.discard(handle)
        try:
            summary: Summary = handle.result()
            return summary
        except KilledWorker as error:
            raise ShardError(
                f"it has ended every worker that tried it, the last one {error.last_worker.address}; often there is "
                "too little memory for a worker (Dask's setting distributed.scheduler.allowed-failures "
                "says how often a shard is tried). Finished shards are kept: mend the cause and call again"
            ) from None
        except FutureCancelledError as error:
            raise WorkerDied(f"Dask has lost the shard: {error}") from None
        except (ImportError, AttributeError) as error:
            raise ShardError(f"a Dask worker cannot load what a shard needs: {error}; install it there too") from error
        except ClusterError:
            raise
        except RuntimeError as error:
            raise ShardError(
                f"Dask: {error} (its scheduler and its workers need coadjoint, pyarrow and fsspec, as here)"
            ) from error

    def close(self) -> None:
        """Takes back what has not run; the cluster is the caller's."""
        if self._futures and self._client.status == "running":
            self._client.cancel(list(self._futures), force=True)
        self._futures.clear()


class Ray:
    """Hands shards to Ray, which the caller has begun with ``ray.init``. Each takes ``threads`` processors."""

    capacity = 4_000

    def __init__(self, ray: Any, threads: int) -> None:
        if not ray.is_initialized():
            raise InputError("client is Ray, which is not running: call ray.init() first")
        self._ray = ray
        # How often a shard is tried is counted by the caller, for all engines alike.
        self._run = ray.remote(num_cpus=threads, max_retries=0)(shard.run)
        self._running: set[Any] = set()

    def submit(self, task: Task) -> Any:
        """Hands the shard to Ray."""
        handle = self._run.remote(task)
        self._running.add(handle)
        return handle

    def wait(self, handles: Iterable[Any]) -> Any:
        """Those that are done."""
        handles = list(handles)
        if not self._ray.wait(handles, num_returns=1, timeout=0.5)[0]:
            return []
        return self._ray.wait(handles, num_returns=len(handles), timeout=0)[0]

    def result(self, handle: Any) -> Summary:
        """Its summary."""
        lost = self._ray.exceptions
        self._running.discard(handle)
        try:
            summary: Summary = self._ray.get(handle)
            return summary
        except lost.RayTaskError as error:
            cause = error.cause
            if isinstance(cause, (ClusterError, InputError, OSError)):
                raise cause from None
            text = str(cause)
            if "No module named" in text:
                reason = text[text.index("No module named") :].splitlines()[0]
                raise ShardError(
                    f"a Ray worker cannot load what a shard needs: {reason}; install it there too"
                ) from None
            raise ShardError(f"{type(cause).__name__}: {text}") from None
        except lost.RayError as error:
            raise WorkerDied(f"Ray has lost the worker: {str(error).splitlines()[0]}") from None

    def close(self) -> None:
        """Takes back what has not run; Ray is the caller's."""
        if self._ray.is_initialized():
            for handle in self._running:
                self._ray.cancel(handle, force=True)
        self._running.clear()
