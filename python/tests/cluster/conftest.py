import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

import support  # noqa: E402

from coadjoint import cluster  # noqa: E402


@pytest.fixture(scope="session")
def serial(tmp_path_factory):
    """The input and the folder of the run that all others are compared with: one process, undisturbed, bad rows among."""
    folder = tmp_path_factory.mktemp("serial")
    numbers = support.momenta(support.ROWS)
    numbers[1234, 1] = float("nan")
    numbers[2801:2803, 0] = float("inf")
    states = support.write(folder / "states.parquet", numbers)
    out = folder / "out"
    outcome = cluster.run(
        support.body(), states=states, out=out, rows_per_shard=support.PER_SHARD, workers=1, progress=False,
        **support.SCHEDULE,
    )
    return states, out, outcome
