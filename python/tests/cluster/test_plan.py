"""Which rows belong to which shard."""

import pytest
from coadjoint import InputError
from coadjoint.cluster.plan import plan
from coadjoint.cluster.states import File, States


def test_shards_are_consecutive_and_together_everything():
    for rows, per_shard in [(0, 5), (1, 5), (10, 5), (11, 5), (3, 100)]:
        made = plan(rows, 100, per_shard)
        found = [row for number in range(made.shards) for row in range(*made.rows_of(number))]
        assert found == list(range(rows))
        assert made.shards == max(1, -(-rows // per_shard))
        for count in (1, 2, 7):
            shares = [number for index in range(count) for number in made.share(index + 1, count)]
            assert shares == list(range(made.shards))


def test_shards_are_of_seconds_and_not_too_many():
    assert plan(10**7, 1000).rows_per_shard == 2**17
    assert plan(10**7, 1).rows_per_shard == 2**20
    assert plan(10**7, 10**9).rows_per_shard == 256
    assert plan(10**10, 10**9).shards <= 100_000
    with pytest.raises(InputError, match="more than 100000 shards; give 100 at least"):
        plan(10**7, 1, 99)


def test_rows_are_found_in_the_files_that_hold_them():
    lengths = [3, 0, 1, 5, 0]
    files = tuple(File(f"file {i}", 10 * i, length, "") for i, length in enumerate(lengths))
    states = States(files, 3, {})
    rows = [(file.name, row) for file in files for row in range(file.rows)]
    for start in range(10):
        for stop in range(start, 10):
            found = states.pieces(start, stop)
            assert [(name, row) for name, _, a, b in found for row in range(a, b)] == rows[start:stop]
