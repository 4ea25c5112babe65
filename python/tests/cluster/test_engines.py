"""The same bytes from Dask and from Ray with two processes each, one of them killed on the way."""

import os

import pytest
import support
from coadjoint import cluster
from support import run


def a_killed_worker_changes_nothing(serial, tmp_path, client, victim):
    states, whole, _ = serial
    killer = support.Killer(victim)
    outcome = run(states, tmp_path / "out", client=client, progress=killer)
    assert killer.killed is not None
    # Results that the killed worker held are asked for again, and found on the disk.
    assert outcome.made + outcome.kept == 8
    support.same(whole, tmp_path / "out")
    # A second call finds everything done.
    assert run(states, tmp_path / "out", client=client).kept == 8
    return outcome


def test_dask(serial, tmp_path):
    distributed = pytest.importorskip("distributed")
    local = distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    try:
        with distributed.Client(local) as client:
            processes = client.run(os.getpid)

            def victim():
                """A worker that has a shard at hand."""
                busy = [address for address, keys in client.processing().items() if keys]
                return processes.get(busy[0]) if busy else None

            a_killed_worker_changes_nothing(serial, tmp_path, client, victim)
    finally:
        local.close()
    with pytest.raises(cluster.InputError, match="client is closed"):
        run(serial[0], tmp_path / "out", client=client)


def test_ray(serial, tmp_path):
    ray, psutil = pytest.importorskip("ray"), pytest.importorskip("psutil")
    with pytest.raises(cluster.InputError, match=r"call ray\.init\(\) first"):
        run(serial[0], tmp_path / "out", client=ray)
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, configure_logging=False)
    try:

        def victim():
            """A worker that has a shard at hand."""
            children = psutil.Process().children(recursive=True)
            return next((child.pid for child in children if child.cmdline()[:1] == ["ray::run"]), None)

        assert a_killed_worker_changes_nothing(serial, tmp_path, ray, victim).again >= 1
    finally:
        ray.shutdown()
