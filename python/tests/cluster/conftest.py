import importlib.util
import sys
from pathlib import Path

import pytest

if any(importlib.util.find_spec(name) is None for name in ("pyarrow", "fsspec", "psutil")):
    # Without what runs on clusters need there is nothing to test.
    collect_ignore_glob = ["test_*.py"]
else:
    sys.path.insert(0, str(Path(__file__).parent))

    import support
    from coadjoint import cluster


@pytest.fixture(scope="session")
def serial(tmp_path_factory):
    """The input and the folder of the run that others are compared with: one process, undisturbed, with bad rows."""
    folder = tmp_path_factory.mktemp("serial")
    numbers = support.momenta(support.ROWS)
    numbers[1234, 1] = float("nan")
    numbers[2801:2803, 0] = float("inf")
    states = support.write(folder / "states.parquet", numbers)
    options = {"rows_per_shard": support.PER_SHARD, "progress": False} | support.SCHEDULE
    outcome = cluster.run(support.body(), states=states, out=folder / "out", **options)
    return states, folder / "out", outcome
