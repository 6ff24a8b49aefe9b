#!/usr/bin/env bash
# Builds the firmware, runs it in an emulator, and compares it with this machine, byte by byte.
#
#   firmware/check.sh [--write]
#
# Installs what it can where it lacks: Debian's compiler for Cortex-M (see .ci/install-thumb), an
# emulator; a Cortex-M0 is looked at only where its compiler is there. Prints a table of what the
# firmware costs, and last the digest of all traces. Exit status 0 when all agree and nothing costs
# over 5 % more than budget.txt says, 75 when the tools cannot be had here. --write rewrites
# scenes.txt and budget.txt.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
cd "$here"
write=${1:-}
out=$(realpath -m "${CARGO_TARGET_DIR:-$here/../target}")/firmware
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
fail() { echo "FAILED: $*" >&2; failed=1; }
cannot() { echo "the firmware cannot be built here: $*" >&2; exit 75; }

m4=thumbv7em-none-eabihf m3=thumbv7m-none-eabi m0=thumbv6m-none-eabi
if ! command -v qemu-system-arm >/dev/null; then
    [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null || cannot "there is no qemu-system-arm"
    (apt-get -qq update && DEBIAN_FRONTEND=noninteractive timeout 300 \
        apt-get -qq -o DPkg::Lock::Timeout=120 --no-install-recommends install -y \
        qemu-system-arm) >/dev/null </dev/null || cannot "apt-get cannot install qemu-system-arm"
fi
../.ci/install-thumb $m4 $m3 || cannot "no compiler (reason above)"
command -v gcc >/dev/null || cannot "there is no gcc for the counter of instructions"

echo
echo "The scenes on this machine, and the stories of the robot:"
export CARGO_TARGET_DIR=$out/host
[ "$write" != --write ] || touch scenes.txt
cargo build --quiet --locked
"$out/host/debug/host" scenes "$work/host.trace" | tee "$work/host.said"
[ "$write" != --write ] || cp "$work/host.said" scenes.txt
cargo test --quiet --locked -p robot | grep "^test result: ok. [1-9]"
diff scenes.txt "$work/host.said" || fail "the scenes are not those of scenes.txt"
for planner in rule exact; do
    "$out/host/debug/host" session "$work/$planner.sent" "$work/$planner.answered" \
        ${planner/rule/} >"$work/$planner.said"
done

# From here on only Debian's compiler.
export PATH=/usr/bin:/bin
unset CARGO RUSTC RUSTDOC RUSTUP_TOOLCHAIN
RUSTFLAGS="--remap-path-prefix=$(realpath ..)=."
export RUSTFLAGS
image() { # BOARD TARGET BIN...
    local board=$1 target=$2 bins=()
    shift 2
    for bin in "$@"; do bins+=(--bin "$bin"); done
    CARGO_TARGET_DIR=$out/$board cargo build --quiet --locked --release -p image \
        --features "$board" --target "$target" "${bins[@]}"
}
built() { echo "$out/$1/$2/release/$3"; } # BOARD TARGET BIN

# run MACHINE IMAGE OPTION...: what it sends goes to out, what it says to said and shouted.
run() {
    local machine=$1 image=$2
    shift 2
    timeout 120 qemu-system-arm -M "$machine" "$@" -display none -monitor none \
        -chardev "file,id=uart,path=$work/out" -serial chardev:uart \
        -semihosting-config enable=on,target=native -kernel "$image" \
        >"$work/said" 2>"$work/shouted"
}
# talk MACHINE IMAGE SENT: the same, sending it these bytes.
talk() {
    timeout 120 qemu-system-arm -M "$1" -display none -monitor none \
        -chardev stdio,id=uart,signal=off -serial chardev:uart \
        -semihosting-config enable=on,target=native -kernel "$2" \
        <"$3" >"$work/out" 2>"$work/shouted"
}
echo
for at in "mps2-an386 $m4 Cortex-M4F" "mps2-an385 $m3 Cortex-M3"; do
    read -r machine target name <<<"$at"
    image mps2 "$target" scenes cuts loop exact
    run "$machine" "$(built mps2 "$target" scenes)" || fail "the scenes end with status $?"
    cmp "$work/host.trace" "$work/out" || fail "another trace on $name"
    diff "$work/host.said" <(grep -v "^stack" "$work/said") || fail "other scenes on $name"
    echo "$name: the trace of the scenes is that of this machine, byte by byte"
    run "$machine" "$(built mps2 "$target" cuts)" || fail "power cuts end with status $?"
    echo "$name: $(cat "$work/said")"
    for planner in rule exact; do
        bin=${planner/rule/loop}
        talk "$machine" "$(built mps2 "$target" "$bin")" "$work/$planner.sent" ||
            fail "a session ends with status $?"
        cmp "$work/$planner.answered" "$work/out" || fail "another session on $name, $bin"
        echo "$name, image $bin: $(stat -c %s "$work/out") bytes answered as here, across a reset" \
            "by the watchdog"
        [ "$target" != $m4 ] || awk '/^stack/ { print $2 }' "$work/shouted" >"$work/$bin.stack"
    done
done

# A Cortex-M0, where its compiler was asked for: the micro:bit, with the RAM of the larger nRF51822.
if [ -d "/usr/lib/rustlib/$m0" ] && ../.ci/install-thumb $m0 >/dev/null; then
    image nrf51822 $m0 scenes
    run microbit "$(built nrf51822 $m0 scenes)" -global nrf51-soc.sram-size=32768 ||
        fail "the scenes end with status $?"
    cmp "$work/host.trace" "$work/out" || fail "another trace on Cortex-M0"
    diff "$work/host.said" <(grep -v "^stack" "$work/said") || fail "other scenes on Cortex-M0"
    echo "Cortex-M0: the trace of the scenes is that of this machine, byte by byte"
else
    echo "!!! SKIPPED: Cortex-M0: no compiler for it (.ci/install-thumb $m0)"
fi

# 32 bits on this machine, where its standard library is there.
if [ -d /usr/lib/rustlib/i686-unknown-linux-gnu ]; then
    CARGO_TARGET_DIR=$out/i686 cargo build --quiet --locked -p host \
        --target i686-unknown-linux-gnu
    "$out/i686/i686-unknown-linux-gnu/debug/host" scenes "$work/32.trace" >"$work/32.said"
    cmp "$work/host.trace" "$work/32.trace" || fail "another trace on 32 bits"
    echo "32 bits on this machine: the same trace"
else
    echo "!!! SKIPPED: 32 bits on this machine: no standard library for i686"
fi

# What it costs.
image mps2 $m4 count
image nrf52840 $m4 loop exact
gcc -O2 -fPIC -shared -o "$work/icount.so" ../tests/evidence/compare/supervisor/firmware/icount.c
count=$(built mps2 $m4 count)
mark=$(arm-none-eabi-nm "$count" | awk '$3 == "icount_mark" { print "0x" $1 }')
timeout 120 qemu-system-arm -M mps2-an386 -display none -monitor none -serial none \
    -semihosting-config enable=on,target=native -kernel "$count" \
    -plugin "$work/icount.so,mark=$mark" -d plugin -D "$work/counts" >"$work/said"
# NAME MOST: the marks' own instructions are taken off.
awk '
    FNR == NR && $1 == "batch" { name[++batches] = $2; left[batches] = $3; all += $3 }
    FNR == NR { next }
    { while (left[at] == 0) at++; left[at]--; it = name[at] }
    it == "empty" { marks = $1; next }
    !(it in most) { order[++kinds] = it; most[it] = -1 }
    $1 - marks > most[it] { most[it] = $1 - marks }
    END {
        if (FNR != all) { print "the emulator did not count every region" > "/dev/stderr"; exit 1 }
        for (it = 1; it <= kinds; it++) print order[it], most[order[it]]
    }' "$work/said" "$work/counts" >"$work/most" || fail "instructions were not counted"
measured() {
    local what
    while read -r what most; do
        printf 'instructions: %s\t%s\n' "${what//_/ }" "$most"
    done <"$work/most"
    for bin in loop exact; do
        arm-none-eabi-size -A "$(built nrf52840 $m4 "$bin")" | awk -v image="$bin" '
            $1 ~ /^\.(vector_table|text|rodata|data)$/ { flash += $2 }
            $1 ~ /^\.(data|bss|uninit)$/ { ram += $2 }
            END { printf "flash of image %s, bytes\t%d\nstatics of image %s in RAM, bytes\t%d\n",
                image, flash, image, ram }'
        printf 'stack of image %s by painting, bytes\t%s\n' "$bin" "$(cat "$work/$bin.stack")"
    done
    printf 'stack of image loop at most, by analysis, bytes\t%s\n' \
        "$(./stack.py "$(built nrf52840 $m4 loop)" arm-none-eabi-objdump main SysTick \
            DefaultHandler | head -1)"
    awk '/^bytes/ { gsub(/_/, " ", $2); printf "%s, bytes\t%d\n", $2, $3 }' "$work/said"
}
measured >"$work/measured"
table() {
    echo "| what | on a Cortex-M4F |"
    echo "| --- | --- |"
    LC_ALL=en_US.UTF-8 awk -F'\t' '
        { for (it = $2; it ~ /[0-9][0-9][0-9][0-9]/;)
            sub(/[0-9][0-9][0-9]($|,)/, ",&", it)
          printf "| %s | %s |\n", $1, it }' "$1"
}
if [ "$write" = --write ]; then
    cp "$work/measured" budget.txt
    awk -v table="$(table budget.txt)" '
        /^\| what \| on a Cortex-M4F/ { print table; skip = 1 }
        skip && !/^\|/ { skip = 0 }
        !skip' ../docs/embed.md >"$work/page"
    cp "$work/page" ../docs/embed.md
fi
grep -qF "$(table budget.txt)" ../docs/embed.md || fail "docs/embed.md has other figures: --write"
echo
echo "On a Cortex-M4F, $(rustc -V | cut -d' ' -f1,2), overflow checks on (instructions are not cycles):"
awk -F'\t' -v OFS='\t' '
    FNR == NR { budget[$1] = $2; next }
    {
        printf "  %-54s %9d  %s\n", $1, $2, ($1 in budget) ? "of " budget[$1] : "without budget"
        seen[$1] = 1
        if (!($1 in budget) || $2 > 1.05 * budget[$1]) over = over "\n  " $1
    }
    END {
        for (it in budget) if (!(it in seen)) over = over "\n  " it " was not measured"
        if (over) { print "over the budget by more than 5 %, or without one:" over; exit 1 }
    }' budget.txt "$work/measured" || fail "the budget is not kept"
[ "$failed" = 0 ] || exit 1
echo
tail -1 "$work/host.said"
