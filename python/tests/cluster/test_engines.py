"""The same bytes from Dask with two processes, one of them killed on the way."""

import os

import pytest
import support
from coadjoint import cluster
from support import run


def test_a_killed_worker_changes_nothing(serial, tmp_path):
    states, whole, _ = serial
    distributed = pytest.importorskip("distributed")
    local = distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    try:
        with distributed.Client(local) as client:
            processes = client.run(os.getpid)

            def victim():
                """A worker that has a shard at hand."""
                busy = [address for address, keys in client.processing().items() if keys]
                return processes.get(busy[0]) if busy else None

            killer = support.Killer(victim)
            outcome = run(states, tmp_path / "out", client=client, progress=killer)
            assert killer.killed is not None
            # Results that the killed worker held are asked for again, and found on the disk.
            assert outcome.made + outcome.kept == 8
            support.same(whole, tmp_path / "out")
            # A second call finds everything done.
            assert run(states, tmp_path / "out", client=client).kept == 8
    finally:
        local.close()
    with pytest.raises(cluster.InputError, match="client is closed"):
        run(states, tmp_path / "out", client=client)
