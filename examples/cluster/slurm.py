"""An ensemble as an array of jobs, from Python:

    sbatch --array=1-8 --cpus-per-task=4 --mem=2G --requeue --wrap "python examples/cluster/slurm.py states.parquet final"

All jobs write into one folder. Finished shards are kept: submit the same line until all are there.
"""

import os
import sys

import coadjoint as ca
from coadjoint import cluster

# As many as --array has; not what is in this submission, which may be a few that failed.
SHARES = int(os.environ.get("SHARES", "8"))
# The same in all jobs.
ROWS_PER_SHARD = int(os.environ.get("ROWS_PER_SHARD", "100000"))

body = ca.System(
    "SO3",
    "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)",
    coordinates="x y z",
    parameters=dict(I1=1.5, I2=2, I3=2.5),
)

states, out = sys.argv[1:]
result = cluster.run(
    body,
    states=states,
    out=out,
    time=100,
    step=0.1,
    rows_per_shard=ROWS_PER_SHARD,
    share=(int(os.environ["SLURM_ARRAY_TASK_ID"]), SHARES),
    threads=int(os.environ.get("SLURM_CPUS_PER_TASK", "1")),
)
print(f"{result.rows} rows, {result.bad} bad; the whole is {'complete' if result.complete else 'not complete yet'}")
