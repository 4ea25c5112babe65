"""The same bytes from Ray with two processes, one of them killed on the way."""

import pytest
import support
from coadjoint import cluster

ray = pytest.importorskip("ray")
psutil = pytest.importorskip("psutil")


def test_a_killed_worker_changes_nothing(serial, tmp_path):
    states, whole, _ = serial
    with pytest.raises(cluster.InputError, match=r"call ray\.init\(\) first"):
        run(states, tmp_path / "out")
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, configure_logging=False)
    try:

        def victim():
            """A worker that has a shard at hand."""
            for process in psutil.Process().children(recursive=True):
                if process.cmdline()[:1] == ["ray::run"]:
                    return process.pid
            return None

        killer = support.Killer(victim)
        outcome = run(states, tmp_path / "out", progress=killer)
        assert killer.killed is not None and outcome.again >= 1
        assert outcome.made + outcome.kept == 8
        support.same(whole, tmp_path / "out")
        assert run(states, tmp_path / "out").kept == 8
    finally:
        ray.shutdown()


def run(states, out, **options):
    options = {"progress": False} | options | support.SCHEDULE
    return cluster.run(support.body(), states=states, out=out, client=ray, rows_per_shard=support.PER_SHARD, **options)
