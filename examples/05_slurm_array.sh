#!/usr/bin/env bash
# A sweep as a Slurm job array:  sbatch examples/05_slurm_array.sh
#
# Every task of the array runs its part of the cases; the one that finds all of them settled writes table.parquet.
# A task that is killed loses only the cases in flight: submit the same script again, and what is finished is passed over.
# By hand, without Slurm:  SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_TASK_COUNT=2 bash examples/05_slurm_array.sh
#SBATCH --job-name=drum
#SBATCH --array=1-20
#SBATCH --cpus-per-task=4
#SBATCH --time=02:00:00
set -euo pipefail

sweep=${SWEEP:-sweep.toml}
out=${OUT:-results}

if [ ! -e "$sweep" ]; then
    # Many tasks may come here at once: each writes a file of its own, and puts it into place whole.
    cat >"$sweep.$SLURM_ARRAY_TASK_ID" <<'TOML'
seeds = 3

[base]
run.duration = 30.0

[axes]
load.fill = [0.2, 0.3, 0.4, 0.5, 0.6]
contact.bundle.friction = [0.1, 0.2, 0.3, 0.5]
TOML
    mv "$sweep.$SLURM_ARRAY_TASK_ID" "$sweep"
fi

# Tasks are counted from 1 here, as in --array=1-20; the cores of a task are seen by drumrs itself.
exec drumrs sweep "$sweep" --out "$out" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
