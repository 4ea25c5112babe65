"""Measures what docs/measurements/cluster.md has: python benchmarks/measure_cluster.py [quick]."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import coadjoint as ca
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from coadjoint import cluster

QUICK = "quick" in sys.argv
FOLDER = Path(tempfile.mkdtemp(prefix="coadjoint-bench-"))


def body():
    return ca.System(
        "SO3",
        "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)",
        coordinates="x y z",
        parameters=dict(I1=1.5, I2=2, I3=2.5),
    )


def states(rows: int, group: int = 1 << 20) -> str:
    """A file of so many momenta, written in pieces."""
    path = FOLDER / f"states-{rows}-{group}.parquet"
    if not path.exists():
        sink = None
        for start in range(0, max(rows, 1), group):
            x = np.arange(start, min(start + group, rows)) / max(rows, 1)
            table = pa.table({"mu_1": 2 - x, "mu_2": 0.5 + 0.3 * x * x, "mu_3": 1 + x})
            sink = sink or pq.ParquetWriter(path, table.schema, use_dictionary=False)
            sink.write_table(table, row_group_size=group)
        sink.close()
    return str(path)


def run(rows: int, per_shard: int, *, client=None, workers=None, steps=1000, group=1 << 20, **options):
    if client is None and workers is None:
        workers = 1
    return cluster.run(
        body(), states=states(rows, group), out=FOLDER / "out", time=0.1 * steps, step=0.1, client=client,
        workers=workers, rows_per_shard=per_shard, progress=False, restart=True, **options,
    )


def engines():
    """Name, client, workers; with two processes each."""
    yield "this process", None, 1
    yield "two processes", None, 2
    from dask.distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as local, Client(local) as client:
        yield "Dask, two processes", client, None
    import ray

    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        yield "Ray, two processes", ray, None
    finally:
        ray.shutdown()


def sizes() -> None:
    print("\nseconds of a shard by its rows, 1000 steps, this process; the median of those after the first")
    for power in range(8, 19 if QUICK else 21, 2):
        rows = 1 << power
        count = 4 if power > 16 else 8
        found = run(rows * count, rows)
        seconds = sorted(list(found.shard_seconds.values())[1:])
        median = seconds[len(seconds) // 2]
        print(f"{rows:>9} rows {median:9.4f} s  {median / rows / 1000 * 1e9:7.1f} ns a step and row")


def overhead() -> None:
    print("\nshards of one row and one step: what a shard costs besides its rows")
    count = 200 if QUICK else 1000
    for name, client, workers in engines():
        begun = time.perf_counter()
        run(2, 1, client=client, workers=workers, steps=1)
        first = time.perf_counter() - begun
        begun = time.perf_counter()
        found = run(count, 1, client=client, workers=workers, steps=1)
        seconds = time.perf_counter() - begun
        inside = sum(found.shard_seconds.values()) / count
        again = time.perf_counter()
        cluster.run(
            body(), states=states(count), out=FOLDER / "out", time=0.1, step=0.1, client=client,
            workers=workers, rows_per_shard=1, progress=False,
        )
        again = time.perf_counter() - again
        print(
            f"{name:>20}: first call {first:6.2f} s, then {seconds / count * 1e3:6.2f} ms a shard, of which in the "
            f"worker {inside * 1e3:6.2f} ms; kept ones {again / count * 1e3:6.2f} ms each"
        )


def speed() -> None:
    rows = 1 << (19 if QUICK else 21)
    print(f"\n{rows} rows of 1000 steps in 16 shards")
    for turn in range(1 if QUICK else 2):
        for name, client, workers in engines():
            found = run(rows, rows // 16, client=client, workers=workers)
            print(
                f"{name:>20}: {found.seconds:7.1f} s, {found.rows_per_second:10,.0f} rows/s, "
                f"{rows * 1000 / found.seconds / 1e6:6.1f} million steps/s, load {os.getloadavg()[0]:.1f}"
            )


MEMORY = """
import sys
sys.path.insert(0, {here!r})
import measure_cluster as bench
bench.FOLDER = bench.Path({folder!r})
found = bench.run({rows}, {per_shard}, steps=10, group={group})
print(found.worker_memory / 2**20, found.seconds, found.rows_per_second)
"""


def memory() -> None:
    print("\nlargest memory of a process that makes all shards of a file, 10 steps")
    for rows, group in [(10_000, 1 << 20), (1_000_000, 1 << 20), (10_000_000, 1 << 20), (10_000_000, 10_000_000)]:
        if QUICK and rows > 1_000_000:
            continue
        states(rows, group)
        script = MEMORY.format(
            here=str(Path(__file__).parent), folder=str(FOLDER), rows=rows, per_shard=1 << 20, group=group
        )
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, cwd=FOLDER)
        if done.returncode:
            raise RuntimeError(done.stderr)
        size, seconds, speed = map(float, done.stdout.split())
        print(f"{rows:>12,} rows, row groups of {group:>10,}: {size:6.0f} MiB, {seconds:6.1f} s, {speed:12,.0f} rows/s")


def verify() -> None:
    rows = 1 << (20 if QUICK else 23)
    run(rows, 1 << 20, steps=1)
    begun = time.perf_counter()
    cluster.check(FOLDER / "out")
    seconds = time.perf_counter() - begun
    print(f"\ncheck: {rows * 24 / seconds / 1e6:,.0f} MB/s")


if __name__ == "__main__":
    import shutil

    print(f"pyarrow {pa.__version__}, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f} at the beginning")
    wanted = [name for name in sys.argv[1:] if name != "quick"] or ["sizes", "overhead", "speed", "memory", "verify"]
    try:
        for name in wanted:
            globals()[name]()
    finally:
        shutil.rmtree(FOLDER)
