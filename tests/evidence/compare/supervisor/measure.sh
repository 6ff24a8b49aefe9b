#!/usr/bin/env bash
# Measures one supervisor written four times: instructions for an event here, and size and
# instructions on a Cortex-M4F.
#
#   tests/evidence/compare/supervisor/measure.sh
#
# Needs valgrind; for the second part Debian's compiler (see .ci/install-thumb), arm-none-eabi-ld,
# qemu-system-arm and gcc. Instructions are not cycles. Exit status 1 when the four disagree or a
# promise is not kept.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../../../target}")/supervisor
export CARGO_TARGET_DIR
cd "$here"
target=thumbv7em-none-eabihf
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# promise WHAT MEASURED MOST
promise() {
    if awk -v is="$2" -v most="$3" 'BEGIN { exit !(is > most) }'; then
        echo "not kept: $1 is $2, $3 was promised" >&2
        failed=1
    fi
}

echo "Ten million events on $(uname -m), $(rustc -V | cut -d' ' -f1,2), opt-level 3:"
cargo build --quiet --locked --release -p supervisor
declare -A each
for version in nothing hand net smlang statig; do
    # Counts from entry to return of the function of this name, whatever it calls.
    said=$(valgrind --quiet --tool=callgrind --callgrind-out-file="$work/calls" \
        --collect-atstart=no \
        --toggle-collect="*stream_$version*" "$CARGO_TARGET_DIR/release/supervisor" "$version")
    each[$version]=$(awk -v loop="${each[nothing]:-0}" '
        /^(totals|summary):/ { printf "%.1f", $2 / 1e7 - loop; exit }' "$work/calls")
    [ "$version" != nothing ] || continue
    printf '  %-8s %6s instructions an event; %s\n' "$version" "${each[$version]}" "$said"
    if [ "$said" != "${first:=$said}" ]; then
        echo "they disagree" >&2
        exit 1
    fi
done
promise "net!, instructions an event" "${each[net]}" "${each[statig]}"
promise "net!, instructions an event" "${each[net]}" \
    "$(awk -v it="${each[hand]}" 'BEGIN { print 2 * it }')"

# From here on only Debian's compiler.
export PATH=/usr/bin:/bin CARGO_TARGET_DIR=$CARGO_TARGET_DIR/debian
unset CARGO RUSTC RUSTDOC RUSTFLAGS RUSTUP_TOOLCHAIN
echo
echo "On $target, $(rustc -V | cut -d' ' -f1,2), opt-level s, overflow checks on:"
cargo build --quiet --locked --profile firmware --target "$target" -p supervisor-firmware
built=$CARGO_TARGET_DIR/$target/firmware

gcc -O2 -fPIC -shared -o "$work/icount.so" firmware/icount.c
mark=$(arm-none-eabi-nm "$built/count" | awk '$3 == "icount_mark" { print "0x" $1 }')
timeout 120 qemu-system-arm -M mps2-an386 -nographic -monitor none -serial none \
    -semihosting-config enable=on,target=native -kernel "$built/count" \
    -plugin "$work/icount.so,mark=$mark" -d plugin -D "$work/counts" >"$work/said"
grep '^bytes ' "$work/said" >"$work/bytes"
sed -i '/^bytes /d' "$work/said"
if [ "$(wc -l <"$work/said")" != "$(wc -l <"$work/counts")" ]; then
    echo "the emulator did not count every region" >&2
    exit 1
fi
answers() { awk -v version="$1" '$1 == version { print $2 }' "$work/said"; }
for version in net smlang statig; do
    cmp <(answers hand) <(answers "$version") || {
        echo "$version disagrees on the target" >&2
        exit 1
    }
done
# VERSION CLASS MEAN MOST; the marks' own instructions are taken off.
paste -d' ' "$work/said" "$work/counts" | awk '
    $1 == "empty" { marks = $3; next }
    { n[$1 " " $2]++; sum[$1 " " $2] += $3 - marks
      if ($3 - marks > most[$1 " " $2]) most[$1 " " $2] = $3 - marks }
    END { for (it in n) printf "%s %.0f %d\n", it, sum[it] / n[it], most[it] }' >"$work/classes"

class() {
    awk -v version="$1" -v class="$2" '$1 == version && $2 == class { print $3, $4 }' \
        "$work/classes"
}
echo "             code  tables  state     ignored       fired     settled  " \
    "(bytes; instructions, mean and most)"
for version in hand net timed_net smlang statig; do
    arm-none-eabi-ld --gc-sections -e "offer_$version" -u "offer_$version" -o "$work/image" \
        "$built/libentries.a"
    read -r code tables < <(arm-none-eabi-size -A "$work/image" | awk '
        $1 ~ /^\.text/ { code += $2 } $1 ~ /^\.(rodata|data)/ { tables += $2 }
        END { print code, tables + 0 }')
    state=$(awk -v version="$version" '$2 == version { print $3 }' "$work/bytes")
    printf '  %-9s %6d %7d %6d' "$version" "$code" "$tables" "$state"
    for class in ignored fired settled; do
        read -r mean most < <(class "$version" "$class")
        printf ' %6d %4d' "$mean" "$most"
        case $version:$class in
            net:ignored | timed_net:ignored)
                promise "$version, instructions for an ignored event" "$most" 250 ;;
            net:* | timed_net:*) promise "$version, instructions for a fired event" "$most" 400 ;;
        esac
    done
    echo
    case $version in
        net) promise "net!, bytes of state" "$state" 16 ;;
        timed_net) promise "net!, bytes of state with clocks" "$state" 32 ;;
    esac
done
exit $failed
