#!/usr/bin/env bash
# Checks the examples of this folder with a pellicle that is built.
#
#   examples/clusters/check.sh [PELLICLE]
#
# PELLICLE is the command, target/release/pellicle by default. Renders a small picture as a whole, on Dask workers of which one is killed,
# and by the Slurm script in a loop in which one task is stopped and started again; all three must be the same. With Slurm installed,
# the script is also submitted as a trial. Needs Python 3 with venv, and pip's access to Dask.
#
# VENV             where the Python environment is kept; in a temporary folder by default
# KEEP=1           keeps the temporary folder
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)

pellicle=$(command -v "${1:-$root/target/release/pellicle}") || {
    echo "check.sh: there is no command ${1:-$root/target/release/pellicle}" >&2
    exit 2
}
pellicle=$(realpath "$pellicle")
scene=$root/scenes/soap_bubble.toml
# A part takes long enough to be stopped in the middle, and no longer.
options=(--size 64x48 --samples 256 --bands 8)
long=(--size 64x48 --samples 2048 --bands 8)

work=$(mktemp -d)
venv=${VENV:-$work/venv}
# shellcheck disable=SC2329
finish() {
    local code=$?
    if [ -n "${KEEP-}" ]; then echo "check.sh: the files are in $work"; else rm -rf "$work"; fi
    if ((code != 0)); then echo "check.sh: FAILED after $SECONDS s" >&2; fi
}
trap finish EXIT

step() { printf -- '-- %s (%s s)\n' "$1" "$SECONDS"; }
fail() {
    echo "check.sh: $1" >&2
    exit 1
}

# Two spectral images are the same: the same bytes, or else the same numbers.
same() {
    if cmp -s "$1" "$2"; then
        echo "$2: the same bytes as $1"
        return
    fi
    "$pellicle" compare "$1" "$2" --format json >"$work/comparison.json" || fail "$2 cannot be compared with $1"
    "$venv/bin/python" - "$work/comparison.json" <<'PYTHON' || fail "$2 is not the same picture as $1"
import json, sys

compared = json.load(open(sys.argv[1]))
bands = compared["bands"]
assert bands, "no bands were compared"
worst = max(abs(band[what]) for band in bands for what in ("rmse", "bias"))
left_out = sum(band["left_out"] for band in bands)
assert worst == 0 and left_out == 0, f"bands differ by {worst}, {left_out} values were left out"
print(f"the same numbers in {len(bands)} bands, in a file of other bytes")
PYTHON
}

step "Dask is installed"
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r "$here/requirements.txt"
"$venv/bin/python" -c 'import dask, distributed; print("dask", dask.__version__, "distributed", distributed.__version__)'

step "the whole picture"
"$pellicle" render "$scene" --backend cpu "${options[@]}" -o "$work/single.exr"

step "parts on Dask workers, one of which is killed"
timeout 120 "$venv/bin/python" "$here/dask_parts.py" "$scene" -o "$work/dask.exr" --parts 8 --folder "$work/dask_parts" \
    --pellicle "$pellicle" --kill-one -- "${options[@]}"
same "$work/single.exr" "$work/dask.exr"

step "the Slurm script in a loop"
export SCENE=$scene PELLICLE=$pellicle OUTPUT=$work/parts SLURM_ARRAY_TASK_COUNT=4
for ((k = 1; k <= SLURM_ARRAY_TASK_COUNT; k++)); do
    SLURM_ARRAY_TASK_ID=$k "$here/render_array.sh" "${options[@]}"
done
"$pellicle" merge "$OUTPUT"/part_*.exr -o "$work/array.exr"
same "$work/single.exr" "$work/array.exr"

step "a part that is missing"
if "$pellicle" merge "$OUTPUT"/part_[124]_*.exr -o "$work/three.exr" 2>"$work/refused.txt"; then
    fail "three of four parts were merged"
fi
cat "$work/refused.txt"
[ ! -e "$work/three.exr" ] || fail "a refused merge wrote a file"

step "a task that is stopped"
export OUTPUT=$work/long_parts SLURM_ARRAY_TASK_COUNT=2 CHECKPOINT_EVERY=1s
# In place of Slurm's scontrol, which puts a task back into the queue.
mkdir "$work/bin"
cat >"$work/bin/scontrol" <<'SCONTROL'
#!/bin/sh
echo "scontrol $*" | tee "$OUTPUT/scontrol.log"
SCONTROL
chmod +x "$work/bin/scontrol"
PATH=$work/bin:$PATH SLURM_ARRAY_JOB_ID=1234 SLURM_ARRAY_TASK_ID=1 "$here/render_array.sh" "${long[@]}" &
task=$!
sleep 0.5
kill -USR1 "$task" 2>/dev/null || true # it has ended, on a very fast machine
code=0
wait "$task" || code=$?
case $code in
143)
    [ ! -e "$OUTPUT/part_1_of_2.exr" ] || fail "a task that was stopped wrote a complete part"
    [ -e "$OUTPUT/part_1_of_2.checkpoint" ] || fail "a task that was stopped wrote no checkpoint"
    [ "$(cat "$OUTPUT/scontrol.log")" = "scontrol requeue 1234_1" ] || fail "the task was not put back into the queue"
    ;;
0) echo "the task was complete before it could be stopped" ;;
*) fail "the task that was stopped ended with exit code $code" ;;
esac
for k in 1 2; do
    SLURM_ARRAY_TASK_ID=$k "$here/render_array.sh" "${long[@]}"
done
"$pellicle" merge "$OUTPUT"/part_*.exr -o "$work/long_array.exr"
"$pellicle" render "$scene" --backend cpu "${long[@]}" -o "$work/long_single.exr"
same "$work/long_single.exr" "$work/long_array.exr"

step "Slurm"
if command -v sbatch >/dev/null; then
    sbatch --test-only --cpus-per-task=1 --mem=100M "$here/render_array.sh"
else
    echo "left out: sbatch is not installed"
fi
step "done"
