"""Runs that are impossible are refused before anything runs, or end with their reason."""

import os
import subprocess
import sys
from pathlib import Path

import coadjoint
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import support
from coadjoint import cluster
from support import run


def test_options_that_make_no_sense(serial, tmp_path):
    states, out, _ = serial
    for options, expected in [
        ({"rows_per_shard": 0}, "rows_per_shard=0"),
        ({"attempts": 0}, "attempts=0"),
        ({"threads": 1.5}, "threads=1.5"),
        ({"share": (0, 3)}, "no share 0 of 3"),
        ({"share": (4, 3)}, "no share 4 of 3"),
        ({"share": (1, 3), "restart": True}, "every job would remove what the others have made"),
        ({"keep": ["id"]}, "there is no column id; there are mu_1, mu_2, mu_3"),
        ({"keep": ["mu_1"]}, "column mu_1 is part of the state"),
        ({"client": "dask"}, "a dask.distributed.Client, the module ray"),
        ({"states": np.ones((2, 3))}, r"call system\.ensemble"),
        ({"states": "nowhere.parquet"}, "there is no such file"),
        ({"states": str(tmp_path)}, "the folder has no .parquet file"),
        ({"states": str(out), "out": out}, "out is the folder of"),
    ]:
        with pytest.raises(cluster.InputError, match=expected):
            run(options.pop("states", states), options.pop("out", tmp_path / "out"), **options)
    assert not (tmp_path / "out").exists()


def test_files_that_hold_no_states(tmp_path):
    names = ["mu_1", "mu_2", "mu_3"]
    for name, content, expected in [
        ("missing", pa.table({"mu_1": [1.0], "mu_2": [1.0]}), "column mu_3 is missing: this system needs mu_1, mu_2"),
        ("fourth", pa.table({f"mu_{i}": [1.0] for i in range(1, 5)}), "column mu_4: the momentum of this system"),
        ("twice", pa.table([pa.array([1.0])] * 4, [*names, "mu_1"]), "column mu_1 is there twice"),
        ("part", pa.table({name: [1.0] for name in [*names, "q_w"]}), "column q_x is missing"),
        ("both", pa.table({name: [1.0] for name in [*names, "q_w", "g_11"]}), "g_11 and q_w both give the attitude"),
        ("parameter", pa.table({name: [1.0] for name in [*names, "i1"]}), "column i1 is no parameter of the system"),
        ("text", pa.table({"mu_1": ["1"], "mu_2": [1.0], "mu_3": [1.0]}), "column mu_1 is of the type string"),
        ("broken.parquet", b"PAR1 and no more", "broken.parquet: "),
        ("table.csv", b"mu_1\n1\n", "pyarrow.csv"),
        ("table.npy", b"", "numpy.load"),
        ("table.txt", b"", "must end in .parquet"),
    ]:
        if isinstance(content, pa.Table):
            path = tmp_path / f"{name}.parquet"
            pq.write_table(content, path)
        else:
            path = tmp_path / name
            path.write_bytes(content)
        with pytest.raises(cluster.InputError, match=expected):
            run(path, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_columns_go_by_name_and_unused_ones_are_told(tmp_path):
    table = pa.table({"z": [1.0], "note": ["first"], "x": [2.0], "y": [0.5]})
    pq.write_table(table, tmp_path / "own.parquet")
    with pytest.warns(coadjoint.CoadjointWarning, match="states: nothing is done with the columns note"):
        run(tmp_path / "own.parquet", tmp_path / "out")
    end = pq.read_table(tmp_path / "out" / "part-00000.parquet")
    expected = support.body().ensemble([[2, 0.5, 1]], **support.SCHEDULE)
    np.testing.assert_array_equal(np.array([end[name].to_numpy() for name in "xyz"]).T, expected)


def test_an_input_that_changes_on_the_way(serial, tmp_path):
    states = support.write(tmp_path / "states.parquet", support.momenta(support.ROWS))

    def change(*_):
        support.write(tmp_path / "states.parquet", support.momenta(10))

    with pytest.raises(cluster.ShardError, match=r"shard 1 \(rows 400 to 799\): .* when the run was planned"):
        run(states, tmp_path / "out", progress=change)


def test_a_folder_that_cannot_be_written(serial, tmp_path):
    states, _, _ = serial
    (tmp_path / "file").write_text("")
    with pytest.raises(cluster.ClusterError, match="cannot be written"):
        run(states, tmp_path / "file" / "out")


FULL = """
import resource, sys
sys.path.insert(0, {tests!r})
import support
from coadjoint import cluster
resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000))
try:
    cluster.run(support.body(), states={states!r}, out={out!r}, rows_per_shard=400,
                progress=False, **support.SCHEDULE)
except cluster.ShardError as error:
    print(error)
"""


def test_a_full_disk_ends_the_run_and_leaves_no_half_file(serial, tmp_path):
    """Files of more than 5000 bytes cannot be written, as on a disk that is full."""
    states, whole, _ = serial
    out = tmp_path / "out"
    script = FULL.format(tests=str(Path(__file__).parent), states=states, out=str(out))
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout
    assert "(rows " in said and "cannot write or read" in said and "File too large" in said
    assert [name for name in support.tree(out) if name != "_run/manifest.json"] == []
    run(states, out)
    support.same(whole, out)


def test_a_shard_that_kills_every_worker_is_named(serial, tmp_path, monkeypatch):
    """Workers die whenever they run, until the limit is reached."""

    def die(task):
        raise cluster.WorkerDied("signal 9")

    monkeypatch.setattr(cluster.engines.shard, "run", die)
    with pytest.raises(cluster.ShardError, match=r"shard 0 \(rows 0 to 2999\): tried 2 times: signal 9"):
        run(serial[0], tmp_path / "out", attempts=2, rows_per_shard=3000)
    assert os.listdir(tmp_path / "out") == ["_run"]
