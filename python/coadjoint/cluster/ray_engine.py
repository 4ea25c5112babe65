"""Shards as tasks of Ray."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from . import shard
from .errors import ClusterError, InputError, ShardError, WorkerDied
from .shard import Summary, Task


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

    def workers(self) -> int:
        """Processors of the nodes that are there now, each good for a worker."""
        return int(self._ray.cluster_resources().get("CPU", 0))

    def close(self) -> None:
        """Takes back what has not run; Ray is the caller's."""
        if self._ray.is_initialized():
            for handle in self._running:
                self._ray.cancel(handle, force=True)
        self._running.clear()
