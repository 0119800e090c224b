#!/usr/bin/env bash
#SBATCH --job-name=pellicle
#SBATCH --array=1-16
#SBATCH --cpus-per-task=8
#SBATCH --mem=4G
#SBATCH --time=01:00:00
#SBATCH --requeue
#SBATCH --signal=B:USR1@120
#SBATCH --open-mode=append
#SBATCH --output=pellicle_%A_%a.log
#
# Renders one part of a picture in each task of a Slurm array.
#
#   SCENE=my_scene.toml OUTPUT=parts sbatch examples/clusters/render_array.sh [OPTIONS OF pellicle render]
#
# Task K of N writes part_K_of_N.exr to the folder OUTPUT, which has a file of this name only when it is complete. A task that is stopped,
# by pre-emption or the time limit, leaves a checkpoint, and goes on from it when it is started again. Two minutes before the time limit
# (--signal) a task puts itself back into the queue.
#
# SCENE            the scene file
# OUTPUT           the folder of parts, which all machines share; parts by default
# PELLICLE         the command; pellicle by default
# BACKEND          cpu (the default) or gpu; all parts need the same
# PARTS            number of parts; by default, the number of tasks. Set it to render some parts again: PARTS=16 sbatch --array=3,7 ...
# CHECKPOINT_EVERY how often a checkpoint is written; 60s by default
#
# Without Slurm, set SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT:
#
#   export SCENE=my_scene.toml SLURM_ARRAY_TASK_COUNT=4
#   for k in 1 2 3 4; do SLURM_ARRAY_TASK_ID=$k examples/clusters/render_array.sh; done
#
# The exit code is that of pellicle: 0 if the part is complete, 143 if it was stopped and can be resumed.
set -euo pipefail

scene=${SCENE:?"is not set: name the scene file"}
output=${OUTPUT:-parts}
pellicle=${PELLICLE:-pellicle}
part=${SLURM_ARRAY_TASK_ID:?"is not set: submit this script with sbatch, or set it to the number of the part"}
parts=${PARTS:-${SLURM_ARRAY_TASK_COUNT:?"is not set: submit this script with sbatch, or set it to the number of parts"}}
if ((part < 1 || part > parts)); then
    echo "render_array.sh: there is no part $part of $parts; parts are 1 to $parts. To render some of them again, set PARTS to the number of all" >&2
    exit 2
fi

name=$(printf '%0*d_of_%d' "${#parts}" "$part" "$parts")
mkdir -p "$output"
# A part that was stopped early is a valid file with fewer samples, so it must not have the name of a complete one.
unfinished=$output/unfinished_$name.exr
checkpoint=$output/part_$name.checkpoint

child=
stopping=false
again=false
interrupted=false
# Called by the traps.
# shellcheck disable=SC2329
stop() {
    interrupted=true
    # Another signal changes nothing: pellicle is ending already.
    if ! "$stopping"; then
        stopping=true
        if [ -n "$child" ]; then kill -TERM "$child" 2>/dev/null || true; fi
    fi
}
# Slurm sends TERM when it ends the task, and USR1, which --signal asks for, when the time limit is near. A task that is canceled gets TERM
# too, so only USR1 puts it back into the queue; after a pre-emption Slurm does that.
trap stop TERM INT
trap 'again=true; stop' USR1

"$pellicle" render "$scene" --backend "${BACKEND:-cpu}" --part "$part/$parts" -o "$unfinished" \
    --checkpoint "$checkpoint" --checkpoint-every "${CHECKPOINT_EVERY:-60s}" --resume "$@" &
child=$!
# A signal may have come before there was anything to end.
if "$stopping"; then kill -TERM "$child" 2>/dev/null || true; fi

# A signal ends the wait, but not pellicle, which first finishes its round and writes its checkpoint.
while true; do
    interrupted=false
    code=0
    wait "$child" || code=$?
    "$interrupted" || break
done

if ((code == 0)); then
    mv -f "$unfinished" "$output/part_$name.exr"
    rm -f "$checkpoint"
    echo "part $part of $parts: complete"
elif ((code == 143)); then
    echo "part $part of $parts: stopped; the checkpoint is $checkpoint" >&2
    if "$again" && [ -n "${SLURM_ARRAY_JOB_ID-}" ]; then
        # Not SLURM_JOB_ID: that of an array's last task is the number of the whole array.
        scontrol requeue "${SLURM_ARRAY_JOB_ID}_$part" || echo "part $part of $parts: not put back into the queue" >&2
    fi
else
    echo "part $part of $parts: failed with exit code $code" >&2
fi
exit "$code"
