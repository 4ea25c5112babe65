"""Measures what docs/measurements/cluster.md has: python benchmarks/measure_cluster.py [quick]."""

from __future__ import annotations

import os
import resource
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
    """A file of `count` momenta, written in pieces."""
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


def processor() -> float:
    """Seconds of processor time of this process and of those that it has waited for: a busy machine adds little to it."""
    return sum(
        used.ru_utime + used.ru_stime for used in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    )


def sizes() -> None:
    print("\na shard by its rows, 1000 steps, this process: processor time, the least of three runs, over the shards")
    for power in range(8, 17 if QUICK else 19, 2):
        rows = 1 << power
        count = max(1, min(16, (1 << 15) // rows))
        taken = []
        run(2, 1)
        for _ in range(1 if power == 18 else 3):
            begun = processor()
            run(rows * count, rows)
            taken.append((processor() - begun) / count)
        print(f"{rows:>9} rows {min(taken):9.4f} s  {min(taken) / rows / 1000 * 1e9:7.1f} ns a step and row", flush=True)


def overhead() -> None:
    print("\nshards of one row and one step: what a shard costs besides its rows")
    count = 200 if QUICK else 1000
    for name, client, workers in engines():
        begun = time.perf_counter()
        run(2, 1, client=client, workers=workers, steps=1)
        first = time.perf_counter() - begun
        begun, used = time.perf_counter(), time.process_time()
        found = run(count, 1, client=client, workers=workers, steps=1)
        seconds, used = time.perf_counter() - begun, time.process_time() - used
        inside = sorted(found.shard_seconds.values())[count // 2]
        again = time.perf_counter()
        cluster.run(
            body(), states=states(count), out=FOLDER / "out", time=0.1, step=0.1, client=client,
            workers=workers, rows_per_shard=1, progress=False,
        )
        again = time.perf_counter() - again
        print(
            f"{name:>20}: first call {first:6.2f} s, then {seconds / count * 1e3:6.2f} ms a shard, in the worker "
            f"{inside * 1e3:6.2f} ms (median), in this process (with Dask's scheduler) {used / count * 1e3:6.2f} ms of its "
            f"processor; kept ones {again / count * 1e3:6.2f} ms each; load {os.getloadavg()[0]:.1f}",
            flush=True,
        )


def speed() -> None:
    rows = 1 << (16 if QUICK else 18)
    print(f"\n{rows} rows of 1000 steps in 16 shards")
    for _ in range(1 if QUICK else 3):
        for name, client, workers in engines():
            begun = processor()
            found = run(rows, rows // 16, client=client, workers=workers)
            used = processor() - begun
            print(
                f"{name:>20}: {found.seconds:7.1f} s, {found.rows_per_second:10,.0f} rows/s, "
                f"processor time here and of children {used:6.1f} s, load {os.getloadavg()[0]:.1f}",
                flush=True,
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
