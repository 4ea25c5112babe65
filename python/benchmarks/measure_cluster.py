"""Measures what docs/measurements/cluster.md has: python benchmarks/measure_cluster.py [ROWS]."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
import time
from pathlib import Path

import coadjoint as ca
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from coadjoint import cluster

ROWS = int(sys.argv[1]) if len(sys.argv) > 1 else 1 << 18
FOLDER = Path(tempfile.mkdtemp(prefix="coadjoint-bench-"))
BODY = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")


def run(rows: int, per_shard: int, steps: int, client=None, workers=None, restart=True) -> cluster.Result:
    """Advances a file of this many momenta."""
    path = FOLDER / f"states-{rows}.parquet"
    if not path.exists():
        x = np.arange(rows) / rows
        pq.write_table(pa.table({"mu_1": 2 - x, "mu_2": 0.5 + 0.3 * x * x, "mu_3": 1 + x}), path)
    options = {"client": client, "workers": workers, "rows_per_shard": per_shard, "restart": restart, "progress": False}
    return cluster.run(BODY, states=str(path), out=FOLDER / "out", time=0.1 * steps, step=0.1, **options)


def engines():
    """Name, client, workers; with two processes each."""
    yield "this process", None, 1
    yield "two processes", None, 2
    from dask.distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as local, Client(local) as client:
        yield "Dask, two processes", client, None
    import ray

    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    yield "Ray, two processes", ray, None
    ray.shutdown()


def timed(work) -> tuple[float, float, cluster.Result]:
    """Seconds of wall and of this process's processor time, and the result."""
    begun, used = time.perf_counter(), time.process_time()
    found = work()
    return time.perf_counter() - begun, time.process_time() - used, found


def main() -> None:
    print(f"pyarrow {pa.__version__}, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}")
    count = 1000
    for name, client, workers in engines():
        first, _, _ = timed(lambda: run(2, 1, 1, client, workers))
        wall, used, found = timed(lambda: run(count, 1, 1, client, workers))
        inside = sorted(found.shard_seconds.values())[count // 2]
        kept, _, _ = timed(lambda: run(count, 1, 1, client, workers, restart=False))
        each = [f"{1e3 * seconds:.2f}" for seconds in (wall / count, inside, used / count, kept / count)]
        print(f"{name}: first call {first:.2f} s; ms a shard of one row: {', '.join(each)} (in all, worker, driver, kept)")
        found = run(ROWS, ROWS // 16, 1000, client, workers)
        memory = found.worker_memory / 2**20
        print(f"  {ROWS} rows of 1000 steps: {found.seconds:.1f} s, {found.rows_per_second:,.0f} rows/s, {memory:.0f} MiB")
    seconds, _, _ = timed(lambda: cluster.check(FOLDER / "out"))
    print(f"check: {ROWS * 24 / seconds / 1e6:,.0f} MB/s")


if __name__ == "__main__":
    try:
        main()
    finally:
        shutil.rmtree(FOLDER)
