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
def test_jobs_of_the_command_are_kept_and_together_the_whole(ending, tmp_path):
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
    for index in (1, 3):
        done = job(script, index, SHARDS="3")
        assert done.returncode == 0, done.stderr
    for index in (1, 2, 3):
        before = parts[index - 1].stat().st_mtime_ns if index != 2 else None
        again = job(script, index, SHARDS="3")
        assert again.returncode == 0, again.stderr
        assert before in (None, parts[index - 1].stat().st_mtime_ns)
    straight = [COMMAND, "ensemble", system, "--initial", states, "--out", whole, "--time", "10"]
    subprocess.run(straight, check=True, capture_output=True)
    if ending == "npy":
        joined = np.concatenate([np.load(part) for part in parts])
        assert np.array_equal(joined, np.load(whole), equal_nan=True)
    else:
        lines = [part.read_text().splitlines() for part in parts]
        assert [lines[0][0], *(row for part in lines for row in part[1:])] == whole.read_text().splitlines()


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
    assert cluster.check(tmp_path / "final")["bad"] == 0
