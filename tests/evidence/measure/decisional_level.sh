#!/usr/bin/env bash
# Measures the whole decisional level of the delivery robot on a Cortex-M4F: bytes of code, tables
# and state, and the instructions of every event in the first states that the supervisors reach, and
# of observers and periods in missions by dice.
#
#   tests/evidence/measure/decisional_level.sh
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
echo "The decisional level on $target, $(rustc -V | cut -d' ' -f1,2), opt-level s," \
    "overflow checks on:"

# An image that begins at these entry points keeps only what they reach.
size() {
    local entries=() it
    for it in "${@:2}"; do entries+=(-u "robot_$it"); done
    arm-none-eabi-ld --gc-sections -e "robot_$2" "${entries[@]}" -o "$work/image" \
        "$built/libentries.a"
    read -r code tables ram < <(arm-none-eabi-size -A "$work/image" | awk '
        $1 ~ /^\.text/ { code += $2 } $1 ~ /^\.rodata/ { tables += $2 }
        $1 ~ /^\.(data|bss)/ { ram += $2 }
        END { print code, tables + 0, ram + 0 }')
    printf '  %-42s %6d + %5d = %6d\n' "$1" "$code" "$tables" $((code + tables))
}
echo "code + tables, each linked alone, in bytes; what they share counts in each"
level=(new perceive decide schedule watch)
size "supervisors: event and round" tell round
size "the decider: from flags to requests" perceive decide
size "executive: schedule and watchdogs" schedule
size "margins" watch
size "allocation by the rule, mission tables" plan_by_rule
size "allocation exactly, mission tables" plan_exactly
size "all but allocation" "${level[@]}"
size "all, allocation exactly" "${level[@]}" plan_exactly
size "all, allocation by the rule" "${level[@]}" plan_by_rule
promise "the whole level, bytes of code and tables" $((code + tables)) "$(figure decisional.bytes)"
promise "statics in RAM, bytes" "$ram" 0

gcc -O2 -fPIC -shared -o "$work/icount.so" ../../compare/supervisor/firmware/icount.c
mark=$(arm-none-eabi-nm "$built/count" | awk '$3 == "icount_mark" { print "0x" $1 }')
timeout 600 qemu-system-arm -M mps2-an386 -nographic -monitor none -serial none \
    -semihosting-config enable=on,target=native -kernel "$built/count" \
    -plugin "$work/icount.so,mark=$mark" -d plugin -D "$work/counts" >"$work/said"
is() {
    awk -v what="$1" '$1 == what && NF == 2 { print $2 }  $1 " " $2 == what { print $3 }' \
        "$work/said"
}
printf 'state: %d bytes, of which the supervisors %d and the executive %d; ' \
    "$(is "bytes robot")" "$(is "bytes supervisors")" "$(is "bytes executive")"
printf 'while it plans %d more, exactly %d\n' "$(is "bytes rule")" "$(is "bytes exact")"
promise "state, bytes" "$(is "bytes robot")" "$(figure decisional.state)"

# A region is named after its batch; those of the exploration follow each other as a round and one
# of each event, those of missions as observers and a period. NAME COUNT MEAN MOST; the marks' own
# instructions are taken off.
awk '
    FNR == NR && $1 == "batch" { name[++batches] = $2; left[batches] = $3; all += $3 }
    FNR == NR && $1 == "event" { event[++events] = $3 }
    FNR == NR { next }
    left[at] == 0 { at++; of = 0 }
    {
        left[at]--
        it = name[at]
        if (it == "explore") { it = of ? "tell " event[of] : "round"; of = (of + 1) % (events + 1) }
        if (it == "walk") { it = of ? "decide" : "perceive"; of = !of }
        if (it == "empty") { marks = $1; next }
        if (!(it in n)) order[++kinds] = it
        n[it]++; sum[it] += $1 - marks; if ($1 - marks > most[it]) most[it] = $1 - marks
    }
    END {
        if (FNR != all) { print "the emulator did not count every region" > "/dev/stderr"; exit 1 }
        for (it = 1; it <= kinds; it++) printf "%s %d %.0f %d\n", order[it], n[order[it]],
            sum[order[it]] / n[order[it]], most[order[it]]
    }' "$work/said" "$work/counts" | sed 's/^tell /tell_/' >"$work/classes"
class() { awk -v name="$1" '$1 == name { print $4 }' "$work/classes"; }
echo "instructions in each of the first $(is states) states that the supervisors reach; of" \
    "observers, with the flags of"
echo "each two failures, and in missions by dice; of plans, from each activity with each" \
    "set of hardware:"
printf '  %-68s %8s %7s %7s\n' "" calls mean most
awk '{ printf "  %-68s %8d %7d %7d\n", $1, $2, $3, $4 }' "$work/classes"
worst=$(awk '/^tell_/ { if ($4 > most) most = $4 } END { print most }' "$work/classes")
promise "the worst event, instructions" "$worst" "$(figure decisional.event)"
promise "the worst round, instructions" "$(class round)" "$(figure decisional.round)"
promise "the worst diagnosis, instructions" "$(class perceive)" "$(figure decisional.diagnosis)"
promise "the patrol by the rule, instructions" "$(class patrol_rule)" 10000
echo "the worst event: $worst instructions; the worst round: $(class round)"
exit $failed
