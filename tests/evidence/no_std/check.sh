#!/usr/bin/env bash
# Proves that core, and models without `std`, need neither the standard library nor a heap.
#
#   tests/evidence/no_std/check.sh [TARGET]
#
# Builds this crate, and its canaries, which must fail to build for the reason they are there for.
# With a TARGET of Cortex-M the compiler is Debian's (see .ci/install-thumb); then each entry point
# is linked alone as well, and its size is printed.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
# Before the folder changes.
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../../target}")
cd "$here"
target=${1:-}
build=(cargo build --quiet --locked --profile firmware)
if [ -n "$target" ]; then
    # Debian's compiler, not that of rustup; the two do not share a folder.
    export PATH=/usr/bin:/bin CARGO_TARGET_DIR=$CARGO_TARGET_DIR/debian
    unset CARGO RUSTC RUSTDOC RUSTFLAGS RUSTUP_TOOLCHAIN
    build+=(--target "$target")
else
    export CARGO_TARGET_DIR=$CARGO_TARGET_DIR/no_std
fi

"${build[@]}"
echo "builds without std and without a heap" \
    "(${target:-this machine}, $(rustc -V | cut -d' ' -f1,2))"

# canary FEATURE MESSAGE: fails to build, with this message.
canary() {
    local said
    if said=$("${build[@]}" --features "$1" 2>&1); then
        echo "$1 builds, but must not: this check is blind" >&2
        exit 1
    elif ! grep -qF "$2" <<<"$said"; then
        printf '%s fails for another reason than "%s":\n%s\n' "$1" "$2" "$said" >&2
        exit 1
    fi
    echo "$1: refused, $2"
}
canary canary-alloc "no global memory allocator found"
if [ -z "$target" ]; then
    canary canary-std "found duplicate lang item"
    exit 0
fi
canary canary-std "can't find crate for \`std\`"

# Linked alone, an entry point keeps only what it reaches; an undefined symbol would be an error
# here.
library=$CARGO_TARGET_DIR/$target/firmware/libcotama_no_std.a
"${build[@]}" # the canaries took the library away
image=$(mktemp)
trap 'rm -f "$image"' EXIT
echo "entry point        code  tables   RAM   bytes on $target, opt-level s, overflow checks on"
for entry in cotama_panorama cotama_exact cotama_front cotama_monitor cotama_assign cotama_team \
    cotama_level cotama_asia cotama_two_ways; do
    arm-none-eabi-ld --gc-sections -e "$entry" -u "$entry" -o "$image" "$library"
    arm-none-eabi-size -A "$image" | awk -v entry="$entry" '
        $1 ~ /^\.(text|rodata|data|bss)/ { size[$1] += $2 }
        END { printf "%-17s %7d %7d %5d\n", entry, size[".text"], size[".rodata"],
            size[".data"] + size[".bss"] }'
done
