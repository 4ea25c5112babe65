"""Shards in processes of this machine, or in this process."""

from __future__ import annotations

import concurrent.futures
import os
import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Iterable

from .._arrays import count
from . import shard
from .errors import WorkerDied
from .shard import Summary, Task

_START = (
    "import pickle, sys; sys.path[:] = pickle.load(sys.stdin.buffer); "
    "from coadjoint.cluster.local import serve; serve()"
)


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

    def workers(self) -> int:
        """This one."""
        return 1

    def close(self) -> None:
        """Nothing is left."""


class Processes:
    """Processes of this machine, each with a thread that feeds it. One that dies is replaced.

    They are interpreters of their own and never import the caller's script, which therefore needs no guard
    against being run again.
    """

    def __init__(self, count: int) -> None:
        # One more for each, so that no process waits for this one.
        self.capacity = 2 * count
        self._threads = concurrent.futures.ThreadPoolExecutor(count, thread_name_prefix="coadjoint")
        self._own = threading.local()
        self._all: set[_Process] = set()
        self._closed = False

    def submit(self, task: Task) -> concurrent.futures.Future[Summary]:
        """Hands the shard to the next process that is free."""
        return self._threads.submit(self._run, task)

    def wait(self, handles: Iterable[concurrent.futures.Future[Summary]]) -> set[concurrent.futures.Future[Summary]]:
        """Those that are done."""
        first = concurrent.futures.FIRST_COMPLETED
        return concurrent.futures.wait(list(handles), timeout=0.5, return_when=first).done

    def result(self, handle: concurrent.futures.Future[Summary]) -> Summary:
        """Its summary."""
        return handle.result()

    def workers(self) -> int:
        """Processes that run."""
        return len(self._all)

    def close(self) -> None:
        """Ends all processes."""
        self._closed = True
        for process in list(self._all):
            process.kill()
        self._threads.shutdown(wait=True, cancel_futures=True)
        for process in list(self._all):
            process.end()

    def _run(self, task: Task) -> Summary:
        process: _Process | None = getattr(self._own, "process", None)
        if process is None or process.ended():
            process = self._own.process = self._begin()
        try:
            return process.run(task)
        except WorkerDied:
            self._own.process = None
            self._all.discard(process)
            raise

    def _begin(self) -> _Process:
        if self._closed:
            raise WorkerDied("the run has ended")
        process = _Process()
        self._all.add(process)
        if self._closed:
            process.kill()
        return process


class _Process:
    """A process and the pipes to it."""

    def __init__(self) -> None:
        pipe = subprocess.PIPE
        self._process = subprocess.Popen([sys.executable, "-c", _START], stdin=pipe, stdout=pipe)
        if self._process.stdin is None or self._process.stdout is None:
            raise WorkerDied("a worker process has no pipes")
        self._tasks, self._answers = self._process.stdin, self._process.stdout
        self._send([os.path.abspath(entry) for entry in sys.path])

    def ended(self) -> bool:
        """Whether it is there no more."""
        return self._process.poll() is not None

    def run(self, task: Task) -> Summary:
        """Has it make a shard, and waits."""
        try:
            self._send(task)
            answer = pickle.load(self._answers)
        except (EOFError, BrokenPipeError, pickle.UnpicklingError):
            code = self.end()
            how = f"signal {-code}" if code < 0 else f"exit code {code}"
            raise WorkerDied(f"the worker process {self._process.pid} ended by {how}") from None
        if isinstance(answer, Summary):
            return answer
        raise answer

    def kill(self) -> None:
        """Ends it at once."""
        self._process.kill()

    def end(self) -> int:
        """Waits for its end, and returns its exit code."""
        for pipe in (self._tasks, self._answers):
            try:
                pipe.close()
            except BrokenPipeError:
                pass
        return self._process.wait()

    def _send(self, value: object) -> None:
        pickle.dump(value, self._tasks)
        self._tasks.flush()


def serve() -> None:
    """The work of such a process: tasks come in by a pipe, summaries go out, until there are no more tasks."""
    # An interruption is the parent's business.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    tasks = sys.stdin.buffer
    answers = os.fdopen(os.dup(1), "wb")
    # Output of other code must not come between the answers.
    os.dup2(2, 1)
    while True:
        try:
            task = pickle.load(tasks)
        except EOFError:
            return
        answer: Summary | Exception
        try:
            answer = shard.run(task)
        except Exception as error:
            answer = error
        try:
            pickle.dump(answer, answers)
            answers.flush()
        except BrokenPipeError:
            return


def engine(workers: int | None) -> Here | Processes:
    """This process for one worker, else a pool of processes; one for each processor if no number is given."""
    if workers is None:
        workers = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    workers = count(workers, "workers", 1)
    return Here() if workers == 1 else Processes(workers)
