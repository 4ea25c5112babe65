#!/usr/bin/env bash
# An ensemble as an array of jobs, by the command alone:
#
#   sbatch examples/cluster/slurm.sh examples/rigid_body.toml states.npy final
#
# writes final/1.npy … final/8.npy, which together are the ends in their order. Jobs that were killed go on where they were
# when they are submitted again, and jobs whose file is there end at once: submit the same line until all are there. Options
# of the command may follow (--time, --step, --tolerance …).
#
#SBATCH --job-name=coadjoint
#SBATCH --array=1-8
#SBATCH --cpus-per-task=4
#SBATCH --mem=1G
#SBATCH --time=04:00:00
#SBATCH --requeue
set -euo pipefail

# As many as --array has; not what is in this submission, which may be a few that failed (--array=3,5).
shards=${SHARDS:-8}

system=$1 states=$2 folder=$3
shift 3
mkdir -p "$folder"
out=$folder/$SLURM_ARRAY_TASK_ID.${states##*.}
# A file has its name only when it is whole.
[ ! -e "$out" ] || exit 0
exec coadjoint ensemble "$system" --initial "$states" --out "$out" \
    --shard "$SLURM_ARRAY_TASK_ID/$shards" --threads "${SLURM_CPUS_PER_TASK:-1}" "$@"
