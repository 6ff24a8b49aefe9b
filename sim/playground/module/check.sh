#!/usr/bin/env bash
# The module for pages of `cotama play`: as it is shipped, and built anew.
#
#   sim/playground/module/check.sh PROGRAM PYTHON
#
# PROGRAM is `cotama`; PYTHON has `wasmtime`. Random runs in both modules are held against those of
# the program. The compiler that module.txt names makes the bytes of module.wasm; where another one
# builds it, the runs alone count. Status 75: built anew it was not, as no compiler is here.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$2" "$here/check.py" "$1" --runs "${COTAMA_PLAY_RUNS:-400}"
status=0
"$here/build.sh" "$work/module.wasm" >"$work/module.txt" || status=$?
[ "$status" = 0 ] || exit "$status"
if cmp -s "$work/module.txt" "$here/module.txt"; then
    cmp "$work/module.wasm" "$here/module.wasm" || {
        echo "module.wasm is not what its sources make: sim/playground/module/build.sh" >&2
        exit 1
    }
    echo "built anew: the same bytes"
else
    echo "built anew by another compiler: $(cat "$work/module.txt")"
    "$2" "$here/check.py" "$1" --runs "${COTAMA_PLAY_RUNS:-400}" --module "$work/module.wasm"
fi
