#!/usr/bin/env bash
# Counts the instructions of one plan of the patrol, and of a mission that uses nearly all promised
# steps, with callgrind on the build that is shipped.
#
#   tests/evidence/measure/instructions.sh
#
# The count is of this machine's instruction set and compiler; unlike a time it is the same in every
# run. Instructions are not cycles. Needs valgrind.
set -euo pipefail
cd "$(dirname "$0")/../../.."
command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 1; }
target_dir=${CARGO_TARGET_DIR:-target}
example=plan_patrol

cargo build --quiet --locked --profile dist -p cotama-tests --example "$example"
out=$(mktemp)
trap 'rm -f "$out"' EXIT
echo "instructions of one plan of the patrol ($(uname -m), $(rustc -V | cut -d' ' -f1,2)):"
for function in exact_patrol exact_hard panorama_patrol; do
    # Counts from entry to return of the function of this name, whatever it calls.
    valgrind --quiet --tool=callgrind --callgrind-out-file="$out" --collect-atstart=no \
        --toggle-collect="*${function}*" "$target_dir/dist/examples/$example" >/dev/null
    count=$(awk '/^(totals|summary):/ { print $2; exit }' "$out")
    if [ "${count:-0}" -lt 100 ]; then
        echo "nothing was counted: $example has no function $function that is not inlined" >&2
        exit 1
    fi
    printf '  %-16s %12d\n' "$function" "$count"
done
