"""Hands shards to an engine, again where a worker died, until all are there."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from typing import Any, Protocol

from .errors import ShardError, WorkerDied
from .shard import Summary, Task, placed


class Engine(Protocol):
    """An engine that runs shards: this process, Dask, or Ray."""

    #: Shards handed over at a time.
    capacity: int

    def submit(self, task: Task) -> Any:
        """Hands over a shard; returns a handle that can be hashed."""

    def wait(self, handles: Iterable[Any]) -> Iterable[Any]:
        """The handles that are done, after half a second at most."""

    def result(self, handle: Any) -> Summary:
        """The summary of a shard that is done. Raises WorkerDied, ShardError, or what the shard raised."""

    def close(self) -> None:
        """Stops what is still running and gives everything back."""


def drive(engine: Engine, tasks: Iterable[Task], attempts: int, done: Callable[[Summary], None]) -> int:
    """Runs all tasks, and returns how often one was handed over again. ``done`` hears of every shard that is finished.

    A shard whose worker died, or whose file system failed in passing, is tried ``attempts`` times. The first
    shard that cannot be made ends the run; shards that are finished stay.
    """
    waiting = iter(tasks)
    again: deque[Task] = deque()
    running: dict[Any, Task] = {}
    tried: dict[int, int] = {}
    exhausted = False
    try:
        while True:
            while len(running) < engine.capacity and not (exhausted and not again):
                task = again.popleft() if again else next(waiting, None)
                if task is None:
                    exhausted = True
                    break
                running[engine.submit(task)] = task
            if not running:
                return sum(tried.values())
            for handle in engine.wait(running):
                task = running.pop(handle)
                try:
                    summary = engine.result(handle)
                except (WorkerDied, OSError) as error:
                    count = tried[task.shard] = tried.get(task.shard, 0) + 1
                    if count >= attempts:
                        text = (
                            f"tried {count} times: {error}. Finished shards are kept: mend the cause (often too little "
                            "memory for a worker) and call again"
                        )
                        raise ShardError(placed(task, text)) from error
                    again.append(task)
                except ShardError as error:
                    raise ShardError(placed(task, str(error))) from error
                else:
                    done(summary)
    finally:
        engine.close()

