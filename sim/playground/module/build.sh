#!/usr/bin/env bash
# Builds the module for pages of `cotama play`:   sim/playground/module/build.sh [FILE.wasm]
#
# Without a name it takes the place of the one that is shipped, and module.txt names its compiler.
#
# Needs a compiler with the target wasm32-unknown-unknown (`rustup target add`), or one with the
# sources of its library and `wasm-ld` (Debian: rustc-web, cargo-web, rust-web-src, lld): then what
# the module needs of the library is built first. All compilers of PATH are tried; RUSTC names
# another one. Status 75: there is none.
#
# Says on standard output which compiler built it. The same compiler makes the same bytes.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=$(realpath -m "${1:-$here/module.wasm}")
target=wasm32-unknown-unknown
work=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../../target}")/module
mkdir -p "$work"

# library RUSTC: what the module needs of the library, built from its sources.
library() {
    local rustc=$1 from version root
    from=$("$rustc" --print sysroot)/lib/rustlib/src/rust/library
    version=$("$rustc" --version | tr -c 'a-zA-Z0-9.\n' '-')
    root=$work/$version
    local to=$root/lib/rustlib/$target/lib
    if [ ! -e "$to/liballoc.rlib" ]; then
        mkdir -p "$to"
        local flags=(--edition 2024 --crate-type rlib --target "$target" -C opt-level=s
            -C panic=abort -Zforce-unstable-if-unmarked --remap-path-prefix "$from=library"
            --cap-lints allow -L "$to" --out-dir "$to")
        local cfg=(--cfg 'feature="compiler-builtins"' --cfg 'feature="mem"')
        {
            RUSTC_BOOTSTRAP=1 "$rustc" --crate-name core "${flags[@]}" "$from/core/src/lib.rs"
            RUSTC_BOOTSTRAP=1 "$rustc" --crate-name compiler_builtins "${flags[@]}" "${cfg[@]}" \
                --extern core="$to/libcore.rlib" \
                "$from/compiler-builtins/compiler-builtins/src/lib.rs"
            RUSTC_BOOTSTRAP=1 "$rustc" --crate-name alloc "${flags[@]}" \
                --extern core="$to/libcore.rlib" \
                --extern compiler_builtins="$to/libcompiler_builtins.rlib" "$from/alloc/src/lib.rs"
        } >&2
    fi
    echo "$root"
}

# built RUSTC CARGO FLAG...: the module.
built() {
    local rustc=$1 cargo=$2
    shift 2
    local flags=("$@" --remap-path-prefix "$here/../../..=." -C link-arg=-zstack-size=262144)
    local IFS=$'\x1f'
    RUSTC=$rustc CARGO_ENCODED_RUSTFLAGS="${flags[*]}" CARGO_TARGET_DIR=$work CARGO_INCREMENTAL=0 \
        "$cargo" build --profile module --locked --target "$target" -p cotama-module \
        --manifest-path "$here/../../../Cargo.toml" >&2
    cp "$work/$target/module/cotama_module.wasm" "$out"
    if [ "$out" = "$here/module.wasm" ]; then
        "$rustc" --version | tee "$here/module.txt"
    else
        "$rustc" --version
    fi
}

while read -r rustc; do
    cargo=$(dirname "$rustc")/cargo
    [ -x "$cargo" ] || continue
    root=$("$rustc" --print sysroot)
    if [ -e "$root/lib/rustlib/$target/lib" ]; then
        built "$rustc" "$cargo"
        exit
    fi
    if [ -e "$root/lib/rustlib/src/rust/library/core/src/lib.rs" ] &&
        command -v wasm-ld >/dev/null; then
        built "$rustc" "$cargo" --sysroot "$(library "$rustc")" -C linker=wasm-ld \
            -C linker-flavor=wasm-ld
        exit
    fi
done < <(if [ -n "${RUSTC:-}" ]; then echo "$RUSTC"; else type -ap rustc; fi)
echo "no compiler for $target" >&2
exit 75
