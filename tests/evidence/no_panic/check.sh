#!/usr/bin/env bash
# Proves that no operation of the executor can panic or needs a heap, for every model that ships;
# and the same of the functions of core and models that a board calls. `open_` names those of which
# the compiler cannot see it.
#
#   tests/evidence/no_panic/check.sh [TARGET]
#
# Links each root of this crate alone: it links exactly if its code holds no panic. With a TARGET of
# Cortex-M the compiler is Debian's (see .ci/install-thumb). Exit status 1 when a root can panic,
# when a canary cannot, and when a net or a system of the models has no roots.
set -euo pipefail
export LC_ALL=C
here=$(realpath "$(dirname "$0")")
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../../target}")/no_panic
cd "$here"
target=${1:-}
build=(cargo build --quiet --locked --profile checked)
# The compiler's own division of 128 bits has tables for unwinding, which nothing here does.
nm=nm pass=-Wl,
link=(cc -nostartfiles "-Wl,--gc-sections,--defsym=rust_eh_personality=0")
if [ -n "$target" ]; then
    export PATH=/usr/bin:/bin
    unset CARGO RUSTC RUSTDOC RUSTFLAGS RUSTUP_TOOLCHAIN
    CARGO_TARGET_DIR+=/debian
    build+=(--target "$target")
    nm=arm-none-eabi-nm
    link=(arm-none-eabi-ld --gc-sections) pass=
fi
export CARGO_TARGET_DIR

# The canary of the heap: with it the crate must not build, and for this reason.
if said=$("${build[@]}" --features canary-heap 2>&1) ||
    ! grep -qF "no global memory allocator found" <<<"$said"; then
    printf 'canary_heap builds, or fails for another reason: this check is blind\n%s\n' "$said" >&2
    exit 1
fi
printf '%-28s %s\n' canary_heap "refused, there is no heap"

"${build[@]}"
library=$CARGO_TARGET_DIR/${target:+$target/}checked/libcotama_no_panic.a

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$nm" --defined-only "$library" 2>/dev/null |
    awk '$2 == "T" && $3 ~ /^(root|open|canary)_/ { print $3 }' | sort -u >"$work/names"

# links NAME: whether an image that begins there links.
links() {
    "${link[@]}" "${pass}-e${pass:+,}$1" "${pass}-u${pass:+,}$1" -o "$work/image" "$library" \
        2>"$work/why"
}

failed=0 roots=0
while read -r name; do
    said=links
    links "$name" || said=$(grep -o a_panic_can_be_reached "$work/why" | sort -u || cat "$work/why")
    case $name:$said in
        root_*:links) roots=$((roots + 1)) verdict="cannot panic" ;;
        root_*) failed=1 verdict="CAN PANIC: $said" ;;
        open_*:links) failed=1 verdict="CANNOT PANIC: make it a root" ;;
        open_*:a_panic_can_be_reached) verdict="open: not seen that it cannot panic" ;;
        open_*) failed=1 verdict="FAILS FOR ANOTHER REASON: $said" ;;
        canary_*:links) failed=1 verdict="LINKS: this check is blind" ;;
        canary_*:a_panic_can_be_reached) verdict="refused, it can panic" ;;
        canary_*) failed=1 verdict="REFUSED FOR ANOTHER REASON: $said" ;;
    esac
    printf '%-28s %s\n' "$name" "$verdict"
done <"$work/names"

# Every net and every system of the models, and of this crate, by the module that `net!`, `system!`
# or a macro over them makes of it, has a player's roots here; so has the system that is printed from
# the robot's file.
{
    find ../../../models/src src -name '*.rs' -exec awk '
        /^ *(cotama_core::|crate::)?(net|system)! *\{/ { open = 1 }
        open && /^ *(pub )?mod [a-z0-9_]+ *(extends .*)?\{/ { sub(/pub /, ""); print $2; open = 0 }
    ' {} +
    echo p3dx_delivery
} | sort -u >"$work/shipped"
sed -n 's/^\(root\|open\)_\(.*\)_start$/\2/p' "$work/names" | sort >"$work/rooted"
if ! diff "$work/shipped" "$work/rooted"; then
    echo "the nets and systems of models/src (<) and those that have roots (>) differ" >&2
    failed=1
fi
for canary in index overflow; do
    grep -qx "canary_$canary" "$work/names" || { echo "canary_$canary is gone" >&2; failed=1; }
done
[ "$roots" -gt 0 ] || failed=1
echo "$roots roots without panics and without a heap" \
    "(${target:-this machine}, $(rustc -V | cut -d' ' -f1,2))"
exit $failed
