#!/usr/bin/env bash
# Measures our checker beside stateright (reachable markings) and libpetri (state classes of time
# nets).
#
#   tests/evidence/compare/checkers/measure.sh [--repeat N] [--pairs N] [--small]
#
# Each run is a process of its own; figures are medians of N runs (3), taken in turns. Two threads
# are compared with one in N pairs (25), each beside two processes at once that share nothing: what
# the machine gives two of anything. --small leaves out the nets that take stateright more than a
# few seconds. Referendum is read from the folder COTAMA_MCC_DIR, further time nets from
# COTAMA_TPN_DIR. Prints Markdown. Exit status 1 when counts differ.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../../../target/checkers}")
export CARGO_TARGET_DIR
repeat=3
pairs=25
markings=(philosophers:12 kanban:5 fms:5)
large=1
while [ $# -gt 0 ]; do
    case $1 in
        --repeat) repeat=${2:?--repeat takes a number}; shift 2 ;;
        --pairs) pairs=${2:?--pairs takes a number}; shift 2 ;;
        --small) markings=(philosophers:11 kanban:4 fms:4); large=0; shift ;;
        *) echo "unknown argument $1" >&2; exit 2 ;;
    esac
done
[[ $repeat =~ ^[1-9][0-9]*$ ]] || { echo "--repeat takes a number from 1" >&2; exit 2; }
[[ $pairs =~ ^[1-9][0-9]*$ ]] || { echo "--pairs takes a number from 1" >&2; exit 2; }
(cd "$here" && cargo build --quiet --locked --release)
checkers=$CARGO_TARGET_DIR/release/checkers
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

differ() { echo "counts differ: $1" >&2; failed=1; }

# Medians, in a line, of nodes, edges, markings, CPU seconds, clock seconds and bytes of the runs in
# a file.
medians() {
    for column in 1 2 3 4 5 6; do
        cut -d' ' -f"$column" "$1" | sort -g |
            awk '{ it[NR] = $1 } END { printf "%s ", it[int((NR + 1) / 2)] }'
    done
    echo # `read` fails on a line without an end
}

# runs WHAT NET PROGRAM...: every program in turn, N times, into the file of its name; in it one
# line for each run.
runs() {
    local what=$1 net=$2 program
    shift 2
    for program in "$@"; do : >"$work/$program"; done
    for _ in $(seq "$repeat"); do
        for program in "$@"; do "$checkers" "$what" "$program" "$net" >>"$work/$program"; done
    done
    for program in "$@"; do
        [ "$(cut -d' ' -f1-3 "$work/$program" | sort -u | wc -l)" = 1 ] ||
            differ "$net, $program with itself"
    done
}

echo "$(rustc -V | cut -d' ' -f1,2)," \
    "$(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2 | xargs), $(nproc) processors;" \
    "load average $(cut -d' ' -f1-3 /proc/loadavg); median of $repeat"
if awk '{ exit !($1 > 0.5) }' /proc/loadavg; then
    echo "WARNING: this machine is not idle: times of two threads mean little," \
        "and CPU times suffer too" >&2
fi
"$checkers" nothing >"$work/nothing"
nothing=$(cut -d' ' -f6 "$work/nothing")

if [ $large = 0 ]; then
    :
elif [ -n "${COTAMA_MCC_DIR:-}" ]; then
    markings+=("$COTAMA_MCC_DIR/Referendum-PT-0015.pnml")
else
    echo "SKIPPED: COTAMA_MCC_DIR names no folder of public nets, for Referendum-PT-0015.pnml" >&2
fi
echo
echo "| net | states | states per CPU second: ours | stateright | ratio |" \
    "bytes per state: ours | stateright | ratio |"
echo "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
for net in "${markings[@]}"; do
    runs markings "$net" cotama array-bfs vec-bfs
    read -r states edges _ time _ bytes < <(medians "$work/cotama")
    for other in array-bfs vec-bfs; do
        cmp -s <(cut -d' ' -f1-2 "$work/cotama" | sort -u) \
            <(cut -d' ' -f1-2 "$work/$other" | sort -u) ||
            differ "$net, $other with ours"
    done
    read -r array _ < <(medians "$work/array-bfs" | cut -d' ' -f4)
    read -r vec _ < <(medians "$work/vec-bfs" | cut -d' ' -f4)
    # Whichever of the two is faster.
    best=$(awk -v array="$array" -v vec="$vec" \
        'BEGIN { print (vec < array ? "vec-bfs" : "array-bfs") }')
    read -r _ _ _ best_time _ best_bytes < <(medians "$work/$best")
    name=$(basename "$net" .pnml)
    awk -v name="$name" -v n="$states" -v t="$time" -v b="$((bytes - nothing))" -v u="$best_time" \
        -v c="$((best_bytes - nothing))" 'BEGIN {
            printf "| %s | %d | %.0f | %.0f | %.1f | %.1f | %.1f | %.1f |\n", name, n, n / t,
                n / u, u / t, b / n, c / n, c / b }'
done
echo
echo "| net | seconds by the clock: 1 thread | 2 threads | pairs |" \
    "speedup, median | least | most | two processes |"
echo "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
for net in "${markings[@]}"; do
    for _ in $(seq "$pairs"); do
        one=$("$checkers" markings cotama "$net")
        two=$("$checkers" markings cotama-2 "$net")
        "$checkers" markings cotama "$net" >"$work/first" &
        "$checkers" markings cotama "$net" >"$work/second"
        wait $!
        [ "$(cut -d' ' -f1-2 <<<"$one")" = "$(cut -d' ' -f1-2 <<<"$two")" ] ||
            differ "$net, two threads with one"
        both=$(cut -d' ' -f5 "$work/first" "$work/second" | sort -g | tail -1)
        awk -v one="$(cut -d' ' -f5 <<<"$one")" -v two="$(cut -d' ' -f5 <<<"$two")" \
            -v both="$both" \
            'BEGIN { print one, two, one / two, 2 * one / both }'
    done >"$work/pairs"
    middle() {
        cut -d' ' -f"$1" "$work/pairs" | sort -g |
            awk '{ it[NR] = $1 } END { print it[int((NR + 1) / 2)] }'
    }
    ends=$(cut -d' ' -f3 "$work/pairs" | sort -g)
    printf '| %s | %.3f | %.3f | %d | %.2f | %.2f | %.2f | %.2f |\n' "$(basename "$net" .pnml)" \
        "$(middle 1)" "$(middle 2)" \
        "$pairs" "$(middle 3)" "$(head -1 <<<"$ends")" "$(tail -1 <<<"$ends")" "$(middle 4)"
done
echo "load average now $(cut -d' ' -f1-3 /proc/loadavg), $(nproc) processors"

timed=(crossing:2 line:3 crossing:3 line:4 line:5)
if [ -n "${COTAMA_TPN_DIR:-}" ]; then
    timed+=("$COTAMA_TPN_DIR"/*.net)
else
    echo "SKIPPED: COTAMA_TPN_DIR names no folder of time nets, for more of them" >&2
fi
echo
echo "| time net | classes: ours | libpetri |" \
    "classes per CPU second: ours | libpetri | ratio | ratio of whole times |"
echo "| --- | ---: | ---: | ---: | ---: | ---: | ---: |"
for net in "${timed[@]}"; do
    name=$(basename "$net" .net)
    if ! timeout 60 "$checkers" classes libpetri "$net" >/dev/null 2>"$work/why"; then
        why=$(head -1 "$work/why")
        echo "$name: not by libpetri: ${why:-no end within 60 s}" >>"$work/not"
        continue
    fi
    runs classes "$net" cotama libpetri
    read -r classes edges markings time _ _ < <(medians "$work/cotama")
    read -r others _ other_markings other_time _ _ < <(medians "$work/libpetri")
    # The same definition, worked out with the matrices of libpetri.
    read -r linear linear_edges _ < <("$checkers" classes linear "$net")
    [ "$classes $edges" = "$linear $linear_edges" ] ||
        differ "$name, our classes with a second opinion: $linear"
    [ "$markings" = "$other_markings" ] || differ "$name, markings: $markings and $other_markings"
    awk -v name="$name" -v n="$classes" -v m="$others" -v t="$time" -v u="$other_time" 'BEGIN {
        printf "| %s | %d | %d | %.0f | %.0f | %.1f | %.1f |\n", name, n, m, n / t, m / u,
            (n / t) / (m / u), u / t }'
done
if [ -s "$work/not" ]; then
    echo
    cat "$work/not"
fi
exit $failed
