"""Helpers of the tests of clusters; also imported by scripts that they start."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import coadjoint as ca
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from coadjoint import cluster

#: Rows of the input, rows of a shard, and the schedule: shards last long enough to be killed in.
ROWS, PER_SHARD = 3000, 400
SCHEDULE = {"time": 100.0, "step": 0.1}


def body(inertia=(1.5, 2, 2.5)):
    """The free rigid body."""
    return ca.System(
        "SO3",
        "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)",
        coordinates="x y z",
        parameters=dict(zip(["I1", "I2", "I3"], inertia)),
    )


def run(states, out, **options):
    """A run of the body with the schedule above, in this process if no client is given."""
    options = {"progress": False, "rows_per_shard": PER_SHARD} | SCHEDULE | options
    return cluster.run(options.pop("system", None) or body(), states=states, out=out, **options)


def momenta(rows: int) -> np.ndarray:
    """Momenta, no two alike."""
    x = np.arange(rows) / max(rows, 1)
    return np.column_stack([2 - x, 0.5 + 0.3 * x * x, 1 + x])


def write(path: Path, numbers: np.ndarray, names=("mu_1", "mu_2", "mu_3"), group: int = 700, **others) -> str:
    """Writes a Parquet file of states in row groups that do not fit the shards."""
    columns = {name: numbers[:, i] for i, name in enumerate(names)} | others
    pq.write_table(pa.table(columns), path, row_group_size=group)
    return str(path)


def tree(folder) -> dict[str, bytes]:
    """All files of a folder, by their names."""
    folder = Path(folder)
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def same(a, b) -> None:
    """Both folders have the same files with the same bytes."""
    a, b = tree(a), tree(b)
    assert a.keys() == b.keys()
    assert [name for name in a if a[name] != b[name]] == []


def end_states(folder) -> np.ndarray:
    """The rows of all parts, read as anybody would."""
    table = pq.read_table(folder)
    return np.column_stack([table[name] for name in table.column_names])


class Killer:
    """Kills one worker, by SIGKILL, when the first shard is there; ``victim`` says which process."""

    def __init__(self, victim) -> None:
        self.victim = victim
        self.killed: int | None = None

    def __call__(self, done, total) -> None:
        if self.killed is None and 0 < done < total:
            pid = self.victim()
            if pid is not None:
                os.kill(pid, signal.SIGKILL)
                self.killed = pid


def advance(numbers: np.ndarray) -> np.ndarray:
    """The rows at the end, by one call of the package."""
    return np.asarray(body().ensemble(numbers, **SCHEDULE))
