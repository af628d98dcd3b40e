#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The cases of a study as a Slurm array, one task each. Hand it in from the study's folder, where N is the number of cases
# (breccia sweep strength.yaml --cases | tail -n +2 | wc -l), at most 50 of them at a time:
#   sbatch --array=1-N%50 slurm.sh strength.yaml
# When all have ended: breccia sweep strength.yaml --collect
#SBATCH --job-name=breccia
#SBATCH --cpus-per-task=2
#SBATCH --time=04:00:00
set -euo pipefail
breccia sweep "$1" --case "$SLURM_ARRAY_TASK_ID" --threads "$SLURM_CPUS_PER_TASK"
