#!/bin/bash
# A campaign as a job array: sbatch tests/campaigns/slurm.sh
# Then: cotama campaign merge results/[0-9]* --out whole
#SBATCH --array=1-8
#SBATCH --cpus-per-task=1
#SBATCH --requeue
mkdir -p results
# Exit code 1 says that a requirement is broken, and is no failure of the job.
cotama campaign "${MISSION:-delivery}" --runs "${RUNS:-1000000}" --jobs 1 \
    --shard "$SLURM_ARRAY_TASK_ID/${SLURM_ARRAY_TASK_COUNT:-8}" \
    --out "results/$SLURM_ARRAY_TASK_ID" || code=$?
[ "${code:-0}" = 1 ] || exit "${code:-0}"
