"""A process that makes shards: tasks come in by a pipe, summaries go out."""

from __future__ import annotations

import os
import pickle
import signal
import sys

from . import shard


def main() -> None:
    """Reads tasks until there are no more."""
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
        answer: shard.Summary | Exception
        try:
            answer = shard.run(task)
        except Exception as error:
            answer = error
        try:
            pickle.dump(answer, answers)
            answers.flush()
        except BrokenPipeError:
            return
