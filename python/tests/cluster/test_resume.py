"""Runs that were stopped go on; runs that are others are refused."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pyarrow.parquet as pq
import pytest
import support
from coadjoint import cluster
from coadjoint.cluster import manifest
from support import run


DRIVER = """
import sys
sys.path.insert(0, {tests!r})
import support
from coadjoint import cluster
cluster.run(support.body(), states={states!r}, out={out!r}, rows_per_shard=support.PER_SHARD, threads=1,
            progress=lambda done, _: print(done // support.PER_SHARD, flush=True), **support.SCHEDULE)
"""


def test_a_killed_driver_is_gone_on_with(serial, tmp_path):
    states, whole, _ = serial
    out = tmp_path / "out"
    script = tmp_path / "driver.py"
    script.write_text(DRIVER.format(tests=str(Path(__file__).parent), states=states, out=str(out)))
    driver = subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True)
    try:
        for line in driver.stdout:
            if int(line) >= 2:
                break
    finally:
        driver.send_signal(signal.SIGKILL)
        driver.wait()
        driver.stdout.close()
    outcome = run(states, out)
    assert outcome.kept >= 2
    assert outcome.made >= 1
    support.same(whole, out)


def test_finished_shards_are_kept_and_damaged_ones_made_again(serial, tmp_path):
    states, whole, _ = serial
    out = tmp_path / "out"
    run(states, out)
    assert run(states, out).kept == 8
    damaged = out / "part-00002.parquet"
    content = bytearray(damaged.read_bytes())
    content[100] ^= 1
    damaged.write_bytes(content)
    os.truncate(out / "part-00004.parquet", 10)
    os.unlink(out / "_run" / "bad-00007.jsonl")
    with pytest.raises(cluster.ClusterError, match=r"of 8 shards 3 are missing or changed \(2, 4, 7\)"):
        cluster.check(out)
    outcome = run(states, out)
    assert (outcome.kept, outcome.made) == (5, 3)
    support.same(whole, out)
    assert cluster.check(out)["bad"] == 3


def test_another_run_is_refused_and_what_differs_is_said(serial, tmp_path):
    states, whole, _ = serial
    out = tmp_path / "out"
    run(states, out, share=(1, 8))
    before = support.tree(out)
    other = support.write(tmp_path / "states.parquet", support.momenta(support.ROWS))
    for options, expected in [
        ({"step": 0.2}, r"job\.step was 0\.1 and is 0\.2 now"),
        ({"time": 50.0}, "job.steps was 1000 and is 500 now"),
        ({"rows_per_shard": 500}, "plan.rows_per_shard was 400 and is 500 now"),
        ({"backend": "interpreter"}, 'job.backend was "auto" and is "interpreter" now'),
        ({"system": support.body((1.5, 2.0, 2.6))}, r"job\.text was .*I3 = 2\.5.* and is .*I3 = 2\.6"),
        ({"states": other}, r"states\[0\]\.sha256 was"),
    ]:
        with pytest.raises(cluster.ManifestError, match=expected) as refused:
            run(options.pop("states", states), out, **options)
        assert "restart=True" in str(refused.value)
    assert support.tree(out) == before
    run(states, out, step=0.2, restart=True)
    assert run(states, out, step=0.2).kept == 8
    run(states, out, restart=True)
    support.same(whole, out)


def test_a_manifest_of_another_version_is_refused(serial, tmp_path):
    states, _, _ = serial
    out = tmp_path / "out"
    run(states, out, share=(1, 8))
    path = out / "_run" / "manifest.json"
    known = json.loads(path.read_text())
    known["versions"]["coadjoint"] = "0.0.1"
    known.pop("crc32")
    path.write_bytes(manifest.seal(known))
    with pytest.raises(cluster.ManifestError, match='versions.coadjoint was "0.0.1" and is'):
        run(states, out)
    path.write_text("{")
    with pytest.raises(cluster.ManifestError, match="cannot be read"):
        run(states, out)
    path.unlink()
    before = support.tree(out)
    for options in [{}, {"restart": True}]:
        with pytest.raises(cluster.ManifestError, match="parts of another run and no manifest"):
            run(states, out, **options)
    assert support.tree(out) == before


def test_only_own_files_are_removed(serial, tmp_path):
    states, whole, _ = serial
    out = tmp_path / "out"
    out.mkdir()
    # Named as others name theirs.
    foreign = out / "part-00000-abc.parquet"
    foreign.write_bytes(b"not ours")
    for options in [{}, {"restart": True}]:
        with pytest.raises(cluster.ManifestError, match="no manifest"):
            run(states, out, **options)
    assert os.listdir(out) == [foreign.name]
    foreign.rename(tmp_path / "away")
    run(states, out)
    (tmp_path / "away").rename(foreign)
    run(states, out, restart=True)
    assert foreign.read_bytes() == b"not ours"
    foreign.unlink()
    support.same(whole, out)


def test_a_changed_byte_of_a_record_is_noticed(serial, tmp_path):
    states, whole, _ = serial
    out = tmp_path / "out"
    run(states, out)
    for name in ["manifest.json", "shard-00003.json"]:
        path = out / "_run" / name
        content = path.read_bytes()
        for index in range(0, len(content), 7):
            path.write_bytes(content[:index] + bytes([content[index] ^ 1]) + content[index + 1 :])
            with pytest.raises(cluster.ClusterError):
                cluster.check(out)
        path.write_bytes(content)
    assert cluster.check(out)["bad"] == 3
    bad = out / "_run" / "bad-00003.jsonl"
    content = bad.read_bytes()
    bad.write_bytes(content.replace(b"1", b"2", 1))
    with pytest.raises(cluster.ClusterError, match="not as it was written"):
        list(cluster.bad_rows(out))
    bad.write_bytes(content)
    support.same(whole, out)


def test_a_worker_of_another_version_is_refused(serial, tmp_path, monkeypatch):
    """The driver believes in another pyarrow than the worker has."""
    states, _, _ = serial
    from coadjoint.cluster import core

    there = core.versions()
    believed = iter([there | {"pyarrow": "1.0"}])
    monkeypatch.setattr(core, "versions", lambda: next(believed, there))
    with pytest.raises(cluster.ShardError, match=r"has pyarrow .* instead of 1\.0"):
        run(states, tmp_path / "out")


def test_what_others_have_written_is_left_alone(serial, tmp_path):
    states, _, _ = serial
    out = tmp_path / "out"
    out.mkdir()
    (out / "notes.txt").write_text("mine")
    run(states, out)
    run(states, out, step=0.2, restart=True)
    assert (out / "notes.txt").read_text() == "mine"
    assert pq.read_table(sorted(out.glob("*.parquet"))).num_rows == support.ROWS
