#!/usr/bin/env bash
# Measures posteriors in fixed point on a Cortex-M4F: bytes of code, tables and stack, and the
# instructions of a query, for all states of the evidence of two networks.
#
#   tests/evidence/measure/inference.sh
#
# Needs Debian's compiler (see .ci/install-thumb), arm-none-eabi-ld, qemu-system-arm and gcc.
# Instructions are not cycles. Exit status 1 when a promise is not kept.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../../target}")/decisional_level
export CARGO_TARGET_DIR PATH=/usr/bin:/bin # only Debian's compiler
unset CARGO RUSTC RUSTDOC RUSTUP_TOOLCHAIN
# Panics name their files: not where this folder lies.
RUSTFLAGS="--remap-path-prefix=$(realpath "$here/../../..")=."
export RUSTFLAGS
cd "$here/decisional_level"
target=thumbv7em-none-eabihf
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# promise WHAT MEASURED MOST
promise() {
    [ "$2" -le "$3" ] || { echo "not kept: $1 is $2, at most $3 was promised" >&2; failed=1; }
}
# figure NAME: the number that pages print.
figure() { awk -v name="$1" '$1 == name { print $2; it++ } END { exit it != 1 }' "$figures"; }
figures=$here/../../golden/figures.txt

cargo build --quiet --locked --profile firmware --target "$target" -p decisional-level-firmware
built=$CARGO_TARGET_DIR/$target/firmware
gcc -O2 -fPIC -shared -o "$work/icount.so" ../../compare/supervisor/firmware/icount.c
mark=$(arm-none-eabi-nm "$built/inference" | awk '$3 == "icount_mark" { print "0x" $1 }')
timeout 120 qemu-system-arm -M mps2-an386 -nographic -monitor none -serial none \
    -semihosting-config enable=on,target=native -kernel "$built/inference" \
    -plugin "$work/icount.so,mark=$mark" -d plugin -D "$work/counts" >"$work/said"
is() { awk -v what="$1" '$1 " " $2 == what { print $3 }' "$work/said"; }

echo "Posteriors in fixed point on $target, $(rustc -V | cut -d' ' -f1,2), opt-level s," \
    "overflow checks on:"
echo "             code  tables   stack  instructions of queries: mean     most"
for name in asia two_ways; do
    arm-none-eabi-ld --gc-sections -e "robot_$name" -u "robot_$name" -o "$work/image" \
        "$built/libentries.a"
    read -r code tables < <(arm-none-eabi-size -A "$work/image" | awk '
        $1 ~ /^\.text/ { code += $2 } $1 ~ /^\.rodata/ { tables += $2 }
        END { print code, tables + 0 }')
    # Regions follow one another as the batches do; the marks' own instructions are taken off.
    read -r queries mean most < <(awk -v name="$name" '
        FNR == NR && $1 == "batch" { if ($2 == name) from = all; all += $3
            if ($2 == name) to = all }
        FNR == NR { next }
        FNR == 1 { marks = $1 }
        FNR > from && FNR <= to { n++; sum += $1 - marks; if ($1 - marks > most) most = $1 - marks }
        END { if (FNR != all) exit 1; printf "%d %.0f %d\n", n, sum / n, most }
    ' "$work/said" "$work/counts")
    printf '  %-8s %7d %7d %7d %7d %21d %8d\n' "$name" "$code" "$tables" "$(is "stack $name")" \
        "$queries" "$mean" "$most"
    promise "flash of $name, bytes" $((code + tables)) "$(figure inference.bytes)"
    promise "the worst query of $name, instructions" "$most" "$(figure inference.query)"
done
exit $failed
