#!/usr/bin/env bash
# Calibrates a list of recordings as a SLURM array: `sbatch --export=ALL,LIST=recordings.txt,OUT=calibrated slurm.sh`.
# Nothing is shared but the folder. A task that is requeued goes on where it was; the one that ends last sums up.
#SBATCH --job-name=eyebolt-batch
#SBATCH --array=0-15
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
#SBATCH --requeue
set -euo pipefail

: "${LIST:?a file with the path of a recording on each line}"
: "${OUT:?a folder that all nodes see}"

# Numbers of an array may begin anywhere; those of shards begin at 0.
shard=$((SLURM_ARRAY_TASK_ID - ${SLURM_ARRAY_TASK_MIN:-0}))
exec eyebolt batch --list "$LIST" -o "$OUT" \
    --shard "$shard/$SLURM_ARRAY_TASK_COUNT" --threads "${SLURM_CPUS_PER_TASK:-1}" "$@"
