#!/usr/bin/env bash
# Proves that no operation of the executor can panic or needs a heap, for every model that ships;
# and the same of every other public function of core and of models that a target may call. Those of
# which the compiler cannot see it are named as open.
#
#   tests/no_panic/check.sh [TARGET]
#
# Links each root of this crate alone: it links exactly if its code holds no panic. With a TARGET of
# Cortex-M the compiler is Debian's (see .ci/install-thumb). Exit status 1 when a root can panic,
# when a canary cannot, when a net of the models has no roots, or a system, and when a public
# function has no root and left_out.txt does not say why. roots.txt lists the roots, functions.txt
# the functions that they call: `UPDATE_GOLDEN=1 tests/no_panic/check.sh` writes both.
set -euo pipefail
export LC_ALL=C
here=$(realpath "$(dirname "$0")")
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../target}")/no_panic
cd "$here"
target=${1:-}
build=(cargo build --quiet --locked)
# The compiler's own division of 128 bits has tables for unwinding, which nothing here does.
nm=nm objdump=objdump pass=-Wl,
link=(cc -nostartfiles "-Wl,--gc-sections,--defsym=rust_eh_personality=0")
if [ -n "$target" ]; then
    export PATH=/usr/bin:/bin
    unset CARGO RUSTC RUSTDOC RUSTFLAGS RUSTUP_TOOLCHAIN
    CARGO_TARGET_DIR+=/debian
    build+=(--target "$target")
    nm=arm-none-eabi-nm objdump=arm-none-eabi-objdump
    link=(arm-none-eabi-ld --gc-sections) pass=
fi
export CARGO_TARGET_DIR

# The canary of the heap: with it the crate must not build, and for this reason.
if said=$("${build[@]}" --release --features canary-heap 2>&1) ||
    ! grep -qF "no global memory allocator found" <<<"$said"; then
    printf 'canary_heap builds, or fails for another reason: this check is blind\n%s\n' "$said" >&2
    exit 1
fi
printf '%-28s %s\n' canary_heap "refused, there is no heap"

"${build[@]}" --release
"${build[@]}"
libraries=$CARGO_TARGET_DIR/${target:+$target/}
library=$libraries/release/libcotama_no_panic.a

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
# or a macro over them makes of it, has a player's roots here.
find ../../models/src src -name '*.rs' -exec awk '
    /^ *(cotama_core::|crate::)?(net|system)! *\{/ { open = 1 }
    open && /^ *(pub )?mod [a-z0-9_]+ *(extends .*)?\{/ { sub(/pub /, ""); print $2; open = 0 }
' {} + | sort -u >"$work/shipped"
sed -n 's/^\(root\|open\)_\(.*\)_start$/\2/p' "$work/names" | sort >"$work/rooted"
if ! diff "$work/shipped" "$work/rooted"; then
    echo "the nets and systems of models/src (<) and those that have roots (>) differ" >&2
    failed=1
fi
# Every public function of core and of models, as both are compiled for a target, is called by a
# root itself, or left_out.txt says why not: compared by path and type, see functions.py.
for crate in core models; do
    ./functions.py public "cotama_$crate" "../../$crate/src/lib.rs" >"$work/public_$crate"
done
sort "$work"/public_* >"$work/public"
"$objdump" -r "$libraries/debug/libcotama_no_panic.a" 2>/dev/null |
    sed -E 's/^RELOCATION RECORDS FOR \[\.text\.((unlikely|hot|startup)\.)*/& /' | c++filt |
    ./functions.py called cotama_core cotama_models >"$work/called"
comm -12 "$work/public" "$work/called" >"$work/functions"

# without_root FILE: what is wrong if the functions in the file are those that have a root.
without_root() {
    local name pattern matched
    comm -23 "$work/public" "$1" >"$work/without"
    : >"$work/explained"
    while IFS= read -r pattern; do
        matched=
        while read -r name; do
            # shellcheck disable=SC2053 # the name of a module or type ends with *
            [[ $name == $pattern ]] && matched=1 && echo "$name" >>"$work/explained"
        done <"$work/without"
        [ -n "$matched" ] || echo "left_out.txt names $pattern, which has a root or is gone"
    done < <(sed -nE 's/^([a-zA-Z0-9_:*]+): .+/\1/p' left_out.txt)
    sort -u "$work/explained" | comm -23 "$work/without" - | sed 's/$/ has no root/'
}
without_root "$work/functions" >"$work/wrong"
if [ -s "$work/wrong" ]; then
    cat "$work/wrong" >&2
    failed=1
fi
# The canaries of the comparison: of each crate one function less has a root.
for crate in core models; do
    less=$(grep -m1 "^cotama_$crate::" "$work/functions")
    grep -vxF "$less" "$work/functions" >"$work/less"
    if without_root "$work/less" | grep -qxF "$less has no root"; then
        printf '%-28s %s\n' "canary_without_root_$crate" "refused, $less has no root"
    else
        echo "a function of $crate without a root is not seen: this check is blind" >&2
        failed=1
    fi
done
# The golden lists: of roots, and of functions that have one, the same on every target.
sed -n '/^root_/p' "$work/names" >"$work/roots"
for list in roots functions; do
    [ -z "${UPDATE_GOLDEN:-}" ] || cp "$work/$list" "$list.txt"
    if ! diff "$list.txt" "$work/$list"; then
        echo "$list.txt (<) is not what is checked (>); UPDATE_GOLDEN=1 writes it" >&2
        failed=1
    fi
done
for canary in index overflow; do
    grep -qx "canary_$canary" "$work/names" || { echo "canary_$canary is gone" >&2; failed=1; }
done
[ "$roots" -gt 0 ] || failed=1
echo "$(wc -l <"$work/public") public functions: $(wc -l <"$work/functions") called by roots," \
    "$(wc -l <"$work/explained") left out"
echo "$roots roots without panics and without a heap" \
    "(${target:-this machine}, $(rustc -V | cut -d' ' -f1,2))"
exit $failed
