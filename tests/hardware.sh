#!/bin/sh
# Reports how Pellicle runs on your GPU, in one file that you can send.
#
#   tests/hardware.sh [--short] [ADAPTER [REPORT]]
#
# ADAPTER is a part of an adapter's name as `pellicle devices` prints it; by default, PELLICLE_ADAPTER or the best adapter is used.
# REPORT is hardware-report.txt by default. --short runs one small suite and small pictures, to try the script itself.
#
# The script needs cargo, the GPU's driver and a POSIX shell with GNU coreutils (timeout), sed, grep and awk. It builds first, however
# long that takes. The rest ends within ten minutes; the report says what was cut off. A failure does not stop the script.
# The exit code is 0 if every test passed and nothing failed or was cut off, 1 otherwise, and 2 if the script could not start.

set -u
export LC_ALL=C

# Time limits in seconds.
all_limit=590
bench_limit=120
render_limit=25

short=false
if [ "${1-}" = --short ]; then
    short=true
    shift
fi
case "${1-}" in
-*)
    echo "usage: tests/hardware.sh [--short] [ADAPTER [REPORT]]" >&2
    exit 2
    ;;
esac
if [ -n "${1-}" ]; then
    export PELLICLE_ADAPTER="$1"
fi
report=${2-hardware-report.txt}
case "$report" in
/*) ;;
*) report=$PWD/$report ;;
esac
cd "$(dirname "$0")/.." || exit 2

for tool in cargo timeout sed grep awk; do
    command -v "$tool" >/dev/null || {
        echo "hardware.sh needs $tool" >&2
        exit 2
    }
done

size=640x480
seconds=1
suites=
scenes="scenes/soap_bubble.toml scenes/film_wedge.toml scenes/metal_spheres.toml"
compared="scenes/bench/bubble.toml scenes/bench/metals.toml scenes/bench/wedge.toml"
if $short; then
    size=64x48
    seconds=0.1
    suites="--test shader pipeline_cache::"
    scenes="scenes/film_wedge.toml"
fi

pellicle=${CARGO_TARGET_DIR:-target}/release/pellicle
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT
trap 'exit 2' INT TERM
: >"$report" || exit 2

# Private caches, so that the first start really is one.
export PELLICLE_CACHE_DIR="$folder/cache/pellicle"
export MESA_SHADER_CACHE_DIR="$folder/cache/mesa"
export __GL_SHADER_DISK_CACHE_PATH="$folder/cache/nvidia"
# Without a desktop, drivers complain if this is not set.
export XDG_RUNTIME_DIR="${XDG_RUNTIME_DIR:-$folder}"

all_well=true

say() { printf '%s\n' "$*" >>"$report"; }

heading() {
    say ""
    say "== $*"
    printf '%s\n' "$*" >&2
}

# The first line that a command prints.
known() { "$@" 2>/dev/null | head -n 1 | grep . || echo "not known"; }

empty_caches() {
    rm -rf "$folder/cache"
    mkdir -p "$PELLICLE_CACHE_DIR" "$MESA_SHADER_CACHE_DIR" "$__GL_SHADER_DISK_CACHE_PATH"
}

now() { date +%s.%N; }

# Seconds between two times.
between() { awk -v from="$1" -v to="$2" 'BEGIN { printf "%.2f", to - from }'; }

# Runs a command for at most the given number of seconds, within the limit of the whole script; its output goes to $folder/output.
limited() {
    limit=$1
    shift
    left=$((deadline - $(date +%s)))
    if [ "$left" -lt "$limit" ]; then
        limit=$left
    fi
    all_well_before=$all_well
    all_well=false
    if [ "$limit" -le 0 ]; then
        say "NOT RUN, the ten minutes are over: $*"
        : >"$folder/output"
        return 1
    fi
    timeout -k 5 "$limit" "$@" >"$folder/output" 2>&1
    code=$?
    case $code in
    0)
        all_well=$all_well_before
        return 0
        ;;
    124 | 137) say "CUT OFF after $limit s: $*" ;;
    *) say "FAILED ($code): $*" ;;
    esac
    return 1
}

# The same, with the output added to the report.
reported() {
    limited "$@"
    cat "$folder/output" >>"$report"
}

# Renders a scene on `gpu` or `cpu` with one sample per pixel and further arguments.
# The last lines of a failure go to the report.
render() {
    scene=$1
    backend=$2
    shift 2
    if [ "$backend" = gpu ] && [ -n "${PELLICLE_ADAPTER-}" ]; then
        set -- "$@" --adapter "$PELLICLE_ADAPTER"
    else
        set -- "$@" --backend "$backend"
    fi
    limited "$render_limit" "$pellicle" render "$scene" -o "$folder/picture.png" --samples 1 "$@" && return
    tail -n 5 "$folder/output" >>"$report"
    return 1
}

# Sets `took` to the seconds from the start to a picture.
start() {
    begun=$(now)
    render "$1" "$2" --size "$size" || return 1
    took=$(between "$begun" "$(now)")
}

# How much longer the first of two equal frames takes than the second, from the speeds that the command reports.
compile_seconds() {
    awk -v size="$size" '
        BEGIN { split(size, sides, "x"); samples = sides[1] * sides[2] * 1e-6 }
        /million samples\/s/ { rate = $(NF - 2); took[++frames] = rate > 0 ? samples / rate : "" }
        END { if (took[1] == "" || took[2] == "") print "?"; else printf "%.2f\n", took[1] - took[2] }
    ' "$folder/output"
}

# Adds a line to the table of starts.
starts() {
    empty_caches
    start "$1" "$2" || return
    first=$took
    start "$1" "$2" || return
    second=$took
    empty_caches
    render "$1" "$2" --size "$size" --frames 0:2 || return
    compile=$(compile_seconds)
    [ "$2" = gpu ] || compile=-
    say "$(printf '%-12s%-10s%16s%16s%12s' "$(basename "$1" .toml)" "$2" "$first" "$second" "$compile")"
}

processor() {
    name=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2>/dev/null | head -n 1)
    [ -n "$name" ] || name=$(sysctl -n machdep.cpu.brand_string 2>/dev/null) || name=$(uname -m)
    printf '%s, %s threads\n' "$name" "$(known nproc)"
}

system() {
    name=$(sed -n 's/^PRETTY_NAME="\(.*\)"$/\1/p' /etc/os-release 2>/dev/null)
    printf '%s\n' "${name:+$name, }$(uname -srm)"
}

commit() {
    changed=$(git status --porcelain --untracked-files=no 2>/dev/null)
    printf '%s\n' "$(known git rev-parse HEAD)${changed:+, with changes}"
}

# Summarizes the output of the suites: a line for each, and the sum. Fails if no suite ended.
count_tests() {
    awk '
        /^ +Running / { suite = $2 == "unittests" ? $3 : $2; running = 1 }
        /^test result: / {
            running = 0
            ended = 1
            passed += $4; failed += $6; ignored += $8
            printf "%-36s%6d passed%6d failed%6d ignored   %s\n", suite, $4, $6, $8, $NF
        }
        /process didn.t exit successfully/ { running = 0; print "BROKE OFF: " $0 }
        END {
            if (running) print "not ended: " suite
            printf "%-36s%6d passed%6d failed%6d ignored\n", "together", passed, failed, ignored
            exit !ended
        }
    ' "$folder/output"
}

# The names of the tests that failed: the last list under "failures:" before a result.
failed_tests() {
    awk '
        /^ +Running / { suite = $2 == "unittests" ? $3 : $2 }
        /^failures:$/ { list = "" }
        /^    [^ ]/ { list = list "  " suite ": " substr($0, 5) "\n" }
        /^test result: FAILED/ { printf "%s", list }
        /^test result: / { list = "" }
    ' "$folder/output"
}

# The messages of the failed tests, up to 400 lines.
said_by_failed_tests() {
    awk '/^failures:$/ { said = 1 } /^test result: / { said = 0 } said' "$folder/output" | head -n 400
}

echo "building; this does not count" >&2
cargo build --workspace --release --bin pellicle >&2 || exit 2
# shellcheck disable=SC2086 # Words, on purpose.
cargo test --release -p pellicle-tests -p pellicle-cli ${suites:---lib --tests} --no-run >&2 || exit 2

begun_at=$(date +%s)
deadline=$((begun_at + all_limit))
empty_caches

say "Pellicle on this machine"
say "date       $(date -u +%Y-%m-%dT%H:%M:%SZ)"
say "commit     $(commit)"
say "processor  $(processor)"
say "system     $(system)"
say "compiler   $(known rustc --version)"
if $short; then
    say "form       short: small pictures, one suite"
fi
if render scenes/film_wedge.toml gpu --size 16x8; then
    say "adapter    $(head -n 1 "$folder/output")"
else
    say "adapter    none that renders"
fi

heading "adapters"
reported "$render_limit" "$pellicle" devices

heading "starts: seconds to a picture of $size, one sample per pixel"
say "The first start finds no shaders in any cache, the second those of the first. The compile time is how much longer the first"
say "of two equal frames takes than the second. A driver's cache that cannot be moved (Metal, DX12) is not emptied."
say "$(printf '%-12s%-10s%16s%16s%12s' scene renderer 'first start' 'second start' compile)"
for scene_file in $compared; do
    for with in gpu cpu; do
        starts "$scene_file" "$with"
    done
done

# shellcheck disable=SC2086 # Words, on purpose.
{
    heading "pellicle bench, the scenes of scenes/bench"
    reported "$bench_limit" "$pellicle" bench --seconds "$seconds" $compared
    if ! $short; then
        heading "pellicle bench"
        reported "$bench_limit" "$pellicle" bench --seconds "$seconds" $scenes
    fi

    heading "tests${suites:+: $suites}"
    limited "$all_limit" cargo test --release -p pellicle-tests -p pellicle-cli ${suites:---lib --tests} --no-fail-fast
}
count_tests >>"$report" || all_well=false
if grep -q '^test result: FAILED' "$folder/output"; then
    all_well=false
    heading "tests that failed"
    failed_tests >>"$report"
    heading "messages of the tests that failed"
    said_by_failed_tests >>"$report"
fi

say ""
say "$(($(date +%s) - begun_at)) s without the build"
echo "the report is $report" >&2
$all_well && exit 0
exit 1
