"""Arrays of jobs, without Slurm: its variables are set by hand."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
import support
from coadjoint import cluster

ROOT = Path(__file__).parents[3]
EXAMPLES = ROOT / "examples" / "cluster"
COMMAND = Path(os.environ.get("COADJOINT", ROOT / "target" / "debug" / "coadjoint"))


def job(arguments, index, **more):
    """Runs a job of an array."""
    path = f"{COMMAND.parent}{os.pathsep}{os.environ['PATH']}"
    variables = {"SLURM_ARRAY_TASK_ID": str(index), "SLURM_CPUS_PER_TASK": "2", "PATH": path} | more
    return subprocess.run(arguments, env=os.environ | variables, capture_output=True, text=True)


@pytest.mark.skipif(not COMMAND.exists(), reason="the command is not built; COADJOINT says where it is")
@pytest.mark.parametrize("ending", ["npy", "csv"])
def test_jobs_of_the_command_are_kept_and_joined(ending, tmp_path):
    numbers = support.momenta(50)
    numbers[17, 2] = np.nan
    states = tmp_path / f"states.{ending}"
    if ending == "npy":
        np.save(states, numbers)
    else:
        lines = [",".join(map(repr, map(float, row))) for row in numbers]
        states.write_text("\n".join(["mu_1,mu_2,mu_3", *lines]) + "\n")
    system = ROOT / "examples" / "rigid_body.toml"
    script = ["bash", EXAMPLES / "slurm.sh", system, states, tmp_path / "final", "--time", "10"]
    parts = [tmp_path / "final" / f"{index}.{ending}" for index in (1, 2, 3)]
    whole = tmp_path / f"whole.{ending}"
    joined = tmp_path / f"joined.{ending}"
    for index in (1, 3):
        done = job(script, index, SHARDS="3")
        assert done.returncode == 0, done.stderr
    join = [sys.executable, "-m", "coadjoint.cluster", "join-shards", joined]
    missing = subprocess.run([*join, parts[0], parts[2]], capture_output=True, text=True)
    assert missing.returncode == 1 and "of 3 shards these are missing: 2" in missing.stderr
    for index in (1, 2, 3):
        again = job(script, index, SHARDS="3")
        assert again.returncode == 0, again.stderr
        assert ("finished by an earlier run, and kept" in again.stdout) == (index != 2)
    other = job(script, 1, SHARDS="4")
    assert other.returncode == 2 and "another shard: 1/3 then, 1/4 now" in other.stderr
    done = subprocess.run([*join, *parts], capture_output=True, text=True)
    assert done.stdout == f"{joined}: 50 rows, 1 of them rejected\n", done.stderr
    straight = [COMMAND, "ensemble", system, "--initial", states, "--out", whole, "--time", "10"]
    subprocess.run(straight, check=True, capture_output=True)
    assert joined.read_bytes() == whole.read_bytes()
    lists = [Path(f"{path}.rejected.csv").read_bytes() for path in (joined, whole)]
    assert lists[0] == lists[1]
    parts[0].write_bytes(parts[1].read_bytes())
    with pytest.raises(cluster.ClusterError, match="is not what .* says"):
        cluster.join_shards(parts, joined)


def test_jobs_in_python_fill_one_folder(tmp_path):
    numbers = support.momenta(support.ROWS)
    states = support.write(tmp_path / "states.parquet", numbers)
    script = [sys.executable, EXAMPLES / "slurm.py", states, tmp_path / "final"]
    for index, said in [(2, "not complete yet"), (1, "complete")]:
        done = job(script, index, SHARES="2", ROWS_PER_SHARD="1000")
        assert done.returncode == 0, done.stderr
        assert said in done.stdout
    table = pq.read_table(tmp_path / "final")
    found = np.column_stack([table[name] for name in table.column_names])
    assert np.array_equal(found, support.advance(numbers))
    check = [sys.executable, "-m", "coadjoint.cluster", "check", tmp_path / "final"]
    assert subprocess.run(check, capture_output=True, text=True).stdout.startswith('{"bad": 0, "drift"')
