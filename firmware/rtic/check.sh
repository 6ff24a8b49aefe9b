#!/usr/bin/env bash
# A supervisor in a task of RTIC 2, and one that logs by defmt: built for Cortex-M3, run in the
# emulator's lm3s6965evb, and compared byte by byte with what the host says.
#
#   firmware/rtic/check.sh            UPDATE_GOLDEN=1: writes golden/logged.txt anew
#
# Needs Debian's compiler for thumbv7m-none-eabi (.ci/install-thumb thumbv7m-none-eabi),
# arm-none-eabi-ld and qemu-system-arm; where one lacks: exit status 75, and a reason.
set -uo pipefail
here=$(realpath "$(dirname "$0")")
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../target}")/rtic
export CARGO_TARGET_DIR
cd "$here" || exit 1
target=thumbv7m-none-eabi
cannot() { echo "SKIPPED  firmware/rtic: $*" >&2; exit 75; }
[ -e "$(/usr/bin/rustc --print sysroot 2>/dev/null)/lib/rustlib/$target/stamp" ] ||
    cannot "no compiler for $target (.ci/install-thumb $target)"
for tool in arm-none-eabi-ld arm-none-eabi-objcopy qemu-system-arm; do
    command -v $tool >/dev/null || cannot "no $tool"
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# check TITLE COMMAND...: one line; what a failure says follows it.
check() {
    local title=$1
    shift
    if "$@" >"$work/said" 2>&1; then
        printf 'ok       %s\n' "$title"
    else
        printf 'FAILED   %s\n' "$title"
        sed 's/^/         /' "$work/said"
        failed=$((failed + 1))
    fi
}

check "format" cargo fmt --all --check
lints() { cargo clippy --quiet --locked "$@" -- -D warnings; }
check "lints of what runs on the host" lints -p cotama-rtic-host -p cotama-rtic-link
check "lints of core with feature defmt" \
    env -C ../.. cargo clippy --quiet --locked -p cotama-core -p cotama-nets -p cotama-units \
    --features defmt -- -D warnings
check "programs of the host" cargo build --quiet --locked -p cotama-rtic-host

# image PACKAGE: by Debian's compiler; its panics name no folder of this machine.
image() {
    env -u CARGO -u RUSTC -u RUSTDOC -u RUSTUP_TOOLCHAIN PATH=/usr/bin:/bin \
        CARGO_TARGET_DIR="$CARGO_TARGET_DIR/debian" \
        RUSTFLAGS="--remap-path-prefix=$(realpath ../..)=." \
        cargo build --quiet --locked --release --target "$target" -p "$1"
}
built=$CARGO_TARGET_DIR/debian/$target/release
check "the image in RTIC 2" image cotama-rtic-app
check "the image that logs" image cotama-rtic-logged

# An instruction takes 64 ns of the emulator's time, so a run does not depend on the host's.
run() {
    timeout 60 qemu-system-arm -M lm3s6965evb -nographic -monitor none -serial none \
        -icount shift=6,sleep=off -semihosting-config enable=on,target=native -kernel "$built/$1"
}
to() { "${@:2}" >"$1"; }

check "the script on the host is golden/supervised.txt" to "$work/host" \
    "$CARGO_TARGET_DIR/debug/expected"
[ -z "${UPDATE_GOLDEN:-}" ] || cp "$work/host" golden/supervised.txt
check "  byte by byte" diff golden/supervised.txt "$work/host"
for again in 1 2; do
    check "the script in RTIC 2 in the emulator, run $again" to "$work/board" run supervised
    check "  byte by byte, $(wc -l <golden/supervised.txt) lines" \
        diff golden/supervised.txt "$work/board"
done

check "the image that logs in the emulator" to "$work/frames" run logged
check "its frames, decoded" to "$work/log" "$CARGO_TARGET_DIR/debug/decode" "$built/logged" \
    "$work/frames"
[ -z "${UPDATE_GOLDEN:-}" ] || cp "$work/log" golden/logged.txt
check "  byte by byte, $(wc -l <golden/logged.txt) lines of $(wc -c <"$work/frames") bytes" \
    diff golden/logged.txt "$work/log"

# Names stand in the file of the image and not in its flash.
names=(recover lose heard bumper touched)
no_names() {
    arm-none-eabi-objcopy -O binary "$built/logged" "$work/flash" || return 1
    local it
    for it in "${names[@]}"; do
        grep -qF "$it" "$built/logged" || { echo "the file lacks $it: this is blind"; return 1; }
        ! grep -qaF "$it" "$work/flash" || { echo "$it is in flash"; return 1; }
    done
    echo "$(wc -c <"$work/flash") bytes of flash"
}
check "no name is in flash" no_names
sed 's/^/         /' "$work/said"
[ $failed = 0 ] && echo "firmware/rtic: all agree"
[ $failed = 0 ]
