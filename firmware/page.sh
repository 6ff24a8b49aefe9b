#!/usr/bin/env bash
# Follows the page "Embed" word by word: from `cotama new net` to the output of an emulated board.
#
#   firmware/page.sh [COTAMA]
#
# COTAMA is the program; it is built where none is given. Needs the compiler for Cortex-M (see
# .ci/install-thumb) and qemu-system-arm. Exit status 0 when the board prints what the page says.
set -euo pipefail
root=$(realpath "$(dirname "$0")/..")
target=$(realpath -m "${CARGO_TARGET_DIR:-$root/target}")
cotama=${1:-}
if [ -z "$cotama" ]; then
    CARGO_TARGET_DIR=$target cargo build --quiet --release --locked --manifest-path \
        "$root/Cargo.toml" -p cotama
    cotama=$target/release/cotama
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$(realpath "$cotama")" "$work/bin/cotama"
ln -s "$root" "$work/cotama"
cd "$work"
export PATH=$work/bin:/usr/bin:/bin CARGO_TARGET_DIR=$target/firmware/page
unset CARGO RUSTC RUSTDOC RUSTUP_TOOLCHAIN RUSTFLAGS
# Debian's compiler comes without a linker of its own for the chip.
export CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER=arm-none-eabi-ld

section=$(sed -n '/^## From a net/,/^## A whole/p' "$root/docs/embed.md")
# The commands of the section, in their order, each a line.
commands=$(grep '^\$ ' <<<"$section" | cut -c3-)
echo "$commands"
while read -r command; do bash -euc "$command" </dev/null >printed 2>errors || {
    cat printed errors
    exit 1
}; done <<<"$commands"
# What the last one printed; Cargo's own words go to the other stream.
expected=$(awk '/^\$ cd gate-board/ { on = 1; next } /^```/ { on = 0 } on' <<<"$section")
diff <(echo "$expected") printed
echo "the board prints what the page says: $(wc -l <printed) lines"
