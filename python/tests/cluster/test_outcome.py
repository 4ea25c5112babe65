"""The output of a run: rows in their order, bad rows by their numbers, and the same bytes by every way."""

import json

import coadjoint as ca
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import support
from coadjoint import cluster
from support import run


def test_rows_end_where_one_call_of_the_package_ends_them(serial):
    states, out, outcome = serial
    given = pq.read_table(states)
    given = np.column_stack([given[name] for name in given.column_names])
    good = np.isfinite(given).all(axis=1)
    expected = support.advance(given[good])
    found = support.end_states(out)
    assert found.shape == given.shape
    assert np.array_equal(found[good], expected)
    assert np.isnan(found[~good]).all()
    assert (outcome.rows, outcome.bad, outcome.made, outcome.kept, outcome.complete) == (3000, 3, 8, 0, True)


def test_bad_rows_are_listed_by_shard_with_their_numbers_in_the_whole_input(serial):
    _, out, outcome = serial
    lists = {name: content for name, content in support.tree(out).items() if "bad-" in name}
    assert list(lists) == ["_run/bad-00003.jsonl", "_run/bad-00007.jsonl"]
    rows = [json.loads(line)["row"] for content in lists.values() for line in content.splitlines()]
    assert rows == [1234, 2801, 2802]
    assert [line["row"] for line in outcome.bad_rows()] == rows
    assert all("mu_" in line["reason"] for line in cluster.bad_rows(out))


def test_two_threads_leave_the_same_bytes(serial, tmp_path):
    states, out, _ = serial
    outcome = run(states, tmp_path / "two", threads=2)
    support.same(out, tmp_path / "two")
    assert outcome.made == 8


def test_a_shard_whose_worker_died_is_made_again(serial, tmp_path, monkeypatch):
    states, out, _ = serial
    make, died = cluster.engines.shard.run, []

    def once(task):
        if task.shard == 3 and not died:
            died.append(task)
            raise cluster.WorkerDied("signal 9")
        return make(task)

    monkeypatch.setattr(cluster.engines.shard, "run", once)
    assert run(states, tmp_path / "killed").again == 1
    support.same(out, tmp_path / "killed")


def test_files_in_pieces_are_one_input(serial, tmp_path):
    states, out, _ = serial
    table = pq.read_table(states)
    folder = tmp_path / "pieces"
    folder.mkdir()
    for start, stop in [(0, 1), (1, 1999), (1999, 3000)]:
        pq.write_table(table.slice(start, stop - start), folder / f"part-{start:04}.parquet")
    for name in (folder, f"file://{folder}/part-*.parquet"):
        run(name, tmp_path / "out", restart=True)
        found = {name: content for name, content in support.tree(tmp_path / "out").items() if "manifest" not in name}
        expected = {name: content for name, content in support.tree(out).items() if "manifest" not in name}
        assert found == expected


def test_shards_of_any_size_give_the_same_rows(serial, tmp_path):
    states, out, _ = serial
    run(states, tmp_path / "large", rows_per_shard=100_000)
    assert np.array_equal(support.end_states(out), support.end_states(tmp_path / "large"), equal_nan=True)


@pytest.mark.parametrize("backend", ["interpreter", "jit"])
def test_backends_leave_the_same_bytes_but_for_the_name_in_the_manifest(backend, serial, tmp_path):
    states, out, _ = serial
    run(states, tmp_path / backend, backend=backend, share=(4, 8))
    found, expected = support.tree(tmp_path / backend), support.tree(out)
    del found["_run/manifest.json"]
    assert sorted(found) == ["_run/bad-00003.jsonl", "_run/shard-00003.json", "part-00003.parquet"]
    assert all(expected[name] == content for name, content in found.items())


def test_attitudes_go_with_their_momenta(tmp_path):
    """As quaternions and as matrices, in columns of any order."""
    names = ["q_w", "mu_3", "q_x", "mu_1", "q_y", "mu_2", "q_z"]
    numbers = np.tile([1.0, 1.0, 0.0, 2.0, 0.0, 0.5, 0.0], (300, 1))
    states = support.write(tmp_path / "states.parquet", numbers, names, group=70)
    run(states, tmp_path / "out")
    table = pq.read_table(tmp_path / "out")
    assert table.column_names == ["mu_1", "mu_2", "mu_3", "q_w", "q_x", "q_y", "q_z"]
    single = support.body().simulate(momentum=[2, 0.5, 1], **support.SCHEDULE)
    end = np.array([column[-1].as_py() for column in table.columns])
    w, x, y, z = end[3:]
    first_row = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)]
    assert np.allclose(end[:3], single.momentum[-1], atol=1e-11)
    assert np.allclose(first_row, single.group_element[-1][0], atol=1e-10)


def test_an_object_store_gets_whole_objects(serial):
    import fsspec

    states, out, _ = serial
    store = fsspec.filesystem("memory")
    with open(states, "rb") as file:
        store.pipe_file("/bucket/states.parquet", file.read())
    try:
        outcome = run("memory://bucket/states.parquet", "memory://bucket/final")
        found = {name.removeprefix("/bucket/final/"): store.cat_file(name) for name in store.find("/bucket/final")}
        assert found == support.tree(out)
        assert run("memory://bucket/states.parquet", "memory://bucket/final").kept == outcome.made
    finally:
        store.rm("/bucket", recursive=True)


@pytest.mark.parametrize("rows", [0, 1])
def test_no_row_and_one_row(rows, tmp_path):
    states = support.write(tmp_path / "states.parquet", support.momenta(rows))
    outcome = run(states, tmp_path / "out")
    table = pq.read_table(tmp_path / "out")
    assert table.num_rows == outcome.rows == rows
    assert table.column_names == ["mu_1", "mu_2", "mu_3"]
    assert outcome.complete and cluster.check(tmp_path / "out")["rows"] == rows


def test_all_rows_bad_is_an_error_that_says_why(tmp_path):
    states = support.write(tmp_path / "states.parquet", np.full((5, 3), np.nan))
    with pytest.raises(cluster.ClusterError, match="all 5 rows are without an end state, the first because .*mu_1"):
        run(states, tmp_path / "out")
    assert len(list(cluster.bad_rows(tmp_path / "out"))) == 5


def test_other_columns_go_through_where_they_are_asked_for(tmp_path):
    names = pa.array([None if i == 3 else f"body {i}" for i in range(1000)])
    others = {"id": np.arange(1000), "name": names}
    states = support.write(tmp_path / "states.parquet", support.momenta(1000), group=300, **others)
    run(states, tmp_path / "out", keep=["name", "id"])
    table = pq.read_table(tmp_path / "out")
    assert table.column_names == ["mu_1", "mu_2", "mu_3", "name", "id"]
    assert table["name"].to_pylist() == names.to_pylist()
    assert table["id"].to_pylist() == list(range(1000))


def test_shares_of_an_array_of_jobs_are_together_the_whole(serial, tmp_path):
    states, out, _ = serial
    made = []
    for index in (3, 1, 2):
        outcome = run(states, tmp_path / "shares", share=(index, 3))
        made.append(outcome.made)
        assert outcome.complete == (index == 2)
    assert sum(made) == 8
    support.same(out, tmp_path / "shares")


def test_progress_counts_up_to_the_whole(serial, tmp_path):
    states, _, _ = serial
    seen = []
    run(states, tmp_path / "out", progress=lambda *done: seen.append(done))
    assert seen == [(min(400 * (n + 1), 3000), 3000) for n in range(8)]


def test_trajectories_are_those_of_one_call_of_the_package(tmp_path):
    body = ca.System(
        "SO3", "x^2/(2*I1) + y^2/4 + z^2/5", coordinates="x y z", parameters={"I1": 1.5}, momentum=[2, 0.5, 1]
    )
    states = {"I1": [1.5, 1.6, 1.7], "x": [2.0, 2.0, 2.0], "y": [0.5, 0.5, 0.5], "z": [1.0, 1.0, 1.0], "id": [7, 8, 9]}
    pq.write_table(pa.table(states), tmp_path / "states.parquet")
    asked = {"time": 3, "tolerance": 1e-8, "at": [0, 0.55, 3]}
    options = {"system": body, "keep": ["id"], "rows_per_shard": 2, "step": None} | asked
    run(tmp_path / "states.parquet", tmp_path / "out", **options)
    found = pq.read_table(tmp_path / "out")
    states.pop("id")
    expected = body.ensemble(states, **asked)
    assert found["row"].to_pylist() == [0, 0, 0, 1, 1, 1, 2, 2, 2]
    assert found["time"].to_pylist() == [0, 0.55, 3] * 3
    assert found["id"].to_pylist() == [7, 7, 7, 8, 8, 8, 9, 9, 9]
    momenta = np.column_stack([found[name] for name in "xyz"]).reshape(3, 3, 3)
    assert (momenta == np.asarray(expected)).all()
