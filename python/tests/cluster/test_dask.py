"""The same bytes from a Dask cluster of two processes, one of them killed on the way."""

import pytest
import support
from coadjoint import cluster

distributed = pytest.importorskip("distributed")


def test_a_killed_worker_changes_nothing(serial, tmp_path):
    states, whole, _ = serial
    local = distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    try:
        with distributed.Client(local) as client:
            processes = client.run(lambda: __import__("os").getpid())

            def victim():
                """A worker that has a shard at hand."""
                busy = [address for address, keys in client.processing().items() if keys]
                return processes.get(busy[0]) if busy else None

            killer = support.Killer(victim)
            outcome = run(client, states, tmp_path / "out", progress=killer)
            assert killer.killed is not None
            # Results that the killed worker held are asked for again, and found on the disk.
            assert outcome.made + outcome.kept == 8
            support.same(whole, tmp_path / "out")
            # A second call finds everything done.
            assert run(client, states, tmp_path / "out").kept == 8
            with pytest.raises(cluster.InputError, match="the client has its own number"):
                run(client, states, tmp_path / "out", workers=2)
    finally:
        local.close()
    with pytest.raises(cluster.InputError, match="client is closed"):
        run(client, states, tmp_path / "out")


def run(client, states, out, **options):
    options = {"progress": False} | options | support.SCHEDULE
    options["rows_per_shard"] = support.PER_SHARD
    return cluster.run(support.body(), states=states, out=out, client=client, **options)
