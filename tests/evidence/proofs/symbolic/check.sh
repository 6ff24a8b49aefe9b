#!/usr/bin/env bash
# Explores harnesses on the machine code of x86-64 with angr: every path, all inputs.
#
#   tests/evidence/proofs/symbolic/check.sh                    compares with holds.txt
#   UPDATE_GOLDEN=1 tests/evidence/proofs/symbolic/check.sh    writes it anew
#   tests/evidence/proofs/symbolic/check.sh NAME...            these: units::units::sums_never_wrap
#
# Needs gcc, and a Python with what requirements.txt lists; PYTHON says which (default python3).
# PROOF_SECONDS (default 120) is the limit for each harness. A canary must fail.
set -euo pipefail
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
python=${PYTHON:-python3}
"$python" -c 'import angr' 2>/dev/null || {
    echo "$python has no angr: pip install -r tests/evidence/proofs/symbolic/requirements.txt" >&2
    exit 2
}
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../../../target}")/symbolic
export CARGO_TARGET_DIR RUSTFLAGS="--cfg kani --cfg kani_shim --cfg kani_symbolic"
cd "$here"
cargo build --quiet --locked --profile symbolic
library=$CARGO_TARGET_DIR/symbolic/libcotama_symbolic.a image=$CARGO_TARGET_DIR/harnesses.elf
mapfile -t names < <(nm --defined-only "$library" 2>/dev/null |
    awk '$2 == "T" && $3 ~ /^proof_/ { print $3 }' | sort -u)
# A panic goes where nothing is: the explorer watches that address.
cc -nostartfiles -no-pie -Wl,--gc-sections "-Wl,-e,${names[0]}" "${names[@]/#/-Wl,-u,}" \
    -Wl,--defsym,a_panic_can_be_reached=0x7ffff000 \
    -Wl,--defsym,rust_eh_personality=0 -o "$image" "$library"
if [ $# -gt 0 ]; then
    names=("${@//::/__}")
    exec "$python" prove.py "$image" "${names[@]/#/proof_}"
fi
PROOF_HOLDS=$CARGO_TARGET_DIR/holds.txt "$python" prove.py "$image"
if [ -n "${UPDATE_GOLDEN:-}" ]; then
    cp "$CARGO_TARGET_DIR/holds.txt" holds.txt
else
    diff holds.txt "$CARGO_TARGET_DIR/holds.txt"
fi
