#!/usr/bin/env bash
# Type-checks every proof harness and runs it with the stand-in for Kani: on all inputs where those
# are few enough, else on a sample. Fuzz targets are type-checked, on stable and without libFuzzer.
# docs/proofs.md says more.
#
#   check.sh                     all of them, and compares the table in docs/proofs.md
#   UPDATE_GOLDEN=1 check.sh     writes the table anew
#   check.sh NAME...             the harnesses whose names hold one of these
#   check.sh --bugs [NAME...]    plants the bugs of bugs.txt, one after the other, and
#                                sees that the harness named there fails each time
#
# KANI_SHIM_RUNS: the most runs of a harness. KANI_SHIM_REPLAY: the inputs of one run, as a failure
# prints them. Exit status 1 when a harness fails, a canary does not, or one that is listed as
# exhaustive was not; when a harness is not listed; when the table differs.
set -euo pipefail
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
root=$(realpath "$here/../../..")
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$root/target}")/proofs
export CARGO_TARGET_DIR RUSTFLAGS="--cfg kani --cfg kani_shim"
cd "$here/run"

if [ "${1:-}" = --bugs ]; then
    shift
    exec "$here/bugs.sh" "$@"
fi
if [ $# -gt 0 ]; then
    exec cargo run --quiet --locked -- "$@"
fi

cargo fmt --check
for alone in fuzz kani kani-macros symbolic; do
    cargo fmt --check --manifest-path "../$alone/Cargo.toml"
done
cargo test --quiet --locked -p kani --lib
cargo clippy --quiet --locked --no-default-features -- -D warnings
(cd "$root" && cargo clippy --quiet --locked --lib -p cotama-core -p cotama-units \
    -p cotama-nets -p cotama-executive -p cotama-allocation -p cotama-assignment -p cotama-models \
    -p cotama-certificate -p cotama-checker -p cotama-formats -p cotama-property \
    -p cotama-verification -- -D warnings)
cargo check --quiet --locked --manifest-path ../fuzz/Cargo.toml \
    --no-default-features --features models,verification
table=$CARGO_TARGET_DIR/table.md
cargo run --quiet --locked -- --table "$table"

# Every harness of the source has a line.
listed=$(sed -n 's/^- `\([a-z0-9_]*\)`:.*/\1/p' "$table" | sort)
written=$(grep -rhA4 '^#\[kani::proof\]' "$root"/{core/*,models,verification,verification/*}/src |
    sed -n 's/^pub fn \([a-z0-9_]*\)().*/\1/p' | sort)
diff <(echo "$written") <(echo "$listed") ||
    { echo "harnesses in the source (<) and in the table (>) differ" >&2; exit 1; }

# The table stands in the page between two lines.
page=$root/docs/proofs.md
begin='<!-- The table: tests/evidence/proofs/check.sh -->' end='<!-- End of it. -->'
{
    awk -v line="$begin" '{ print } $0 == line { exit }' "$page"
    echo
    cat "$table"
    echo
    awk -v line="$end" '$0 == line { on = 1 } on' "$page"
} >"$table.page"
if [ -n "${UPDATE_GOLDEN:-}" ]; then
    cp "$table.page" "$page"
else
    diff "$page" "$table.page" ||
        { echo "docs/proofs.md (<) is not as it must be (>)" >&2; exit 1; }
fi
