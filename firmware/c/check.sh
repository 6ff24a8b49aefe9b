#!/usr/bin/env bash
# The C API: the header, the library, the example in C against its twin in Rust, the refusals, the
# overlaps of memory.
#
#   firmware/c/check.sh
#
# One line a check. What a check needs and is not here is named as skipped; COTAMA_SKIP_TOOLS=0
# makes that a failure. Exit status 0 when nothing failed.
set -uo pipefail
here=$(realpath "$(dirname "$0")")
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../target}")/c
export CARGO_TARGET_DIR
unset COTAMA_MISSION # what is compared is the delivery
cd "$here" || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0 passed=0 skipped=0

# check TITLE COMMAND...: one line; what a failure says follows it.
check() {
    local title=$1
    shift
    if "$@" >"$work/said" 2>&1; then
        printf 'ok       %s\n' "$title"
        passed=$((passed + 1))
    else
        printf 'FAILED   %s\n' "$title"
        sed 's/^/         /' "$work/said"
        failed=$((failed + 1))
    fi
}

# skip TITLE REASON: loudly.
skip() {
    printf 'SKIPPED  %s: %s\n' "$1" "$2"
    skipped=$((skipped + 1))
    [ "${COTAMA_SKIP_TOOLS:-1}" != 0 ] || failed=$((failed + 1))
}
has() { command -v "$1" >/dev/null; }

# The functions that the header names.
functions() {
    grep -oE '\bcotama_[a-z_]+\(' include/cotama.h | tr -d '(' | sort -u
}

# The header is what cbindgen makes of this version of the crate.
cbindgen=${CBINDGEN:-$(command -v cbindgen || ls ~/.cargo/bin/cbindgen 2>/dev/null)}
same_header() {
    "$cbindgen" --quiet --config cbindgen.toml --crate cotama-c --output "$work/cotama.h" . &&
        diff include/cotama.h "$work/cotama.h"
}
if [ -n "$cbindgen" ]; then
    check "include/cotama.h is what cbindgen makes" same_header
else
    skip "include/cotama.h is what cbindgen makes" "no cbindgen (cargo install cbindgen)"
fi

# The numbers of the delivery robot are what the build script makes of its file.
same_numbers() {
    cargo run --quiet --locked --example robot_header >"$work/cotama_robot.h" &&
        diff include/cotama_robot.h "$work/cotama_robot.h"
}
check "include/cotama_robot.h is what the build script makes" same_numbers

check "format" cargo fmt --all --check
check "lints" cargo clippy --quiet --locked --workspace --examples -- -D warnings
check "the static library" cargo build --quiet --locked --release -p cotama-c-library
library=$CARGO_TARGET_DIR/release/libcotama.a

strict=(-Wall -Wextra -pedantic -Werror -Iinclude)
printf '#include "%s"\n' cotama_robot.h cotama.h >"$work/only.c"
cp "$work/only.c" "$work/only.cpp"
for cc in gcc clang; do
    if has $cc; then
        check "the headers alone as C11, $cc" $cc -std=c11 "${strict[@]}" -fsyntax-only \
            "$work/only.c"
        check "the example as C11, $cc" $cc -std=c11 "${strict[@]}" -g example.c "$library" \
            -o "$work/example-$cc"
    else
        skip "the headers and the example as C11, $cc" "no $cc"
    fi
done
for cxx in g++ clang++; do
    if has $cxx; then
        check "the headers alone as C++17, $cxx" $cxx -std=c++17 "${strict[@]}" -fsyntax-only \
            "$work/only.cpp"
    else
        skip "the headers alone as C++17, $cxx" "no $cxx"
    fi
done
has gcc || exit 1

check "the same steps in Rust" cargo run --quiet --locked --example same_steps
cp "$work/said" "$work/rust.txt"
# same BINARY [COMMAND...]: it prints what Rust prints.
same() {
    "${@:2}" "$1" >"$work/c.txt" && cmp "$work/c.txt" "$work/rust.txt"
}
for cc in gcc clang; do
    [ ! -x "$work/example-$cc" ] ||
        check "the example prints what Rust prints, $cc, $(wc -l <"$work/rust.txt") lines" \
            same "$work/example-$cc"
done

check "the refusals as C11, gcc" gcc -std=c11 "${strict[@]}" -g refusals.c "$library" \
    -o "$work/refusals"
check "every refusal" "$work/refusals"
said=$(cat "$work/said")
check "the overlaps as C11, gcc" gcc -std=c11 "${strict[@]}" -g overlaps.c "$library" \
    -o "$work/overlaps"
check "every overlap" "$work/overlaps"
said+="; $(cat "$work/said")"
# Every function that is given memory is in the table of overlaps.
all_in_the_table() {
    diff <(functions | grep -vxE 'cotama_(error_text|version)') \
        <(sed -nE 's/^CALLS\((\w+),.*/cotama_\1/p' overlaps.c | sort)
}
check "  of every function" all_in_the_table
if has valgrind; then
    memory=(valgrind --quiet --error-exitcode=9 --leak-check=full --track-origins=yes)
    check "the example under valgrind" same "$work/example-gcc" "${memory[@]}"
    check "every refusal under valgrind" "${memory[@]}" "$work/refusals" without-padding
    check "every overlap under valgrind" "${memory[@]}" "$work/overlaps" without-padding
else
    skip "the example, the refusals and the overlaps under valgrind" "no valgrind"
fi
sane=(-fsanitize=address,undefined -fno-sanitize-recover=all)
for program in example refusals overlaps; do
    check "$program.c with sanitizers" gcc -std=c11 "${strict[@]}" -g "${sane[@]}" $program.c \
        "$library" -o "$work/$program-sane"
done
check "the example under sanitizers" same "$work/example-sane"
check "every refusal under sanitizers" "$work/refusals-sane"
check "every overlap under sanitizers" "$work/overlaps-sane"

# The program of the documentation is its first block of C.
awk '/^```c$/ { inside = 1; next } /^```$/ && inside { exit } inside' ../../docs/embed-c.md \
    >"$work/page.c"
check "the program of docs/embed-c.md as C11" gcc -std=c11 "${strict[@]}" "${sane[@]}" \
    "$work/page.c" "$library" -o "$work/page"
page() { [ "$("$work/page")" = "the job is stopped at 1120 ms" ]; }
check "  says what it should" page

# No function can panic, in the code that the compiler makes at level 3 with overflow checks: linked
# alone, each holds no call of the panic handler. The canary holds one.
panic_free() {
    local free=$CARGO_TARGET_DIR/panic_free it links
    CARGO_TARGET_DIR=$free CARGO_PROFILE_RELEASE_OPT_LEVEL=3 cargo build --quiet --locked \
        --release -p cotama-c-library --features panic-free,canary || return 1
    for it in $(functions) cotama_canary; do
        links=yes
        gcc -nostartfiles -Wl,--gc-sections,--defsym=rust_eh_personality=0,-e,"$it",-u,"$it" \
            -o "$work/root" "$free/release/libcotama.a" 2>"$work/why" || links=no
        case $it:$links in
            cotama_canary:yes) echo "the canary links: this check is blind"; return 1 ;;
            cotama_canary:no) grep -qF a_panic_can_be_reached "$work/why" || return 1 ;;
            *:no) echo "$it can panic, or lacks something:"; head -3 "$work/why"; return 1 ;;
        esac
    done
}
check "no function can panic, all $(functions | wc -l)" panic_free

# The library as firmware links it: every function that the header names is there, and nothing that
# it calls lacks.
target=thumbv7em-none-eabihf
on_thumb() {
    env -u CARGO -u RUSTC -u RUSTDOC -u RUSTFLAGS -u RUSTUP_TOOLCHAIN PATH=/usr/bin:/bin \
        CARGO_TARGET_DIR="$CARGO_TARGET_DIR/debian" \
        cargo build --quiet --locked --release --target "$target" -p cotama-c-library || return 1
    mapfile -t all < <(functions)
    size "all of it" "${all[@]}" &&
        size "a supervisor" cotama_watchdog_{start,offer,advance,wake_at,state,store} &&
        size "  and its return" cotama_watchdog_{start,offer,advance,wake_at,state,store,restore} &&
        size "the decisional level" cotama_level_{start,perceive,round,requests} &&
        size "  and its return" cotama_level_{start,perceive,round,requests,store,restore} &&
        size "  and names" cotama_level_{start,perceive,round,requests,transition_names} &&
        size "margins" cotama_monitor_{start,planned,spend,left,assess} &&
        size "planning by the rule" cotama_plan_by_rule &&
        size "planning exactly" cotama_plan_exactly
}
# size WHAT FUNCTION...: what an image that keeps them takes; whatever lacks is an error.
size() {
    local entries=() it
    for it in "${@:2}"; do entries+=(-u "$it"); done
    arm-none-eabi-ld --gc-sections -e "$2" "${entries[@]}" -o "$work/image" \
        "$CARGO_TARGET_DIR/debian/$target/release/libcotama.a" || return 1
    arm-none-eabi-size -A "$work/image" | awk -v what="$1" '
        $1 ~ /^\.text/ { code += $2 } $1 ~ /^\.(rodata|ARM\.exidx)/ { tables += $2 }
        $1 ~ /^\.(data|bss)/ { ram += $2 }
        END { printf "%-22s %6d + %5d bytes of code and tables, %d of RAM\n", what, code, tables,
            ram; exit ram != 0 }'
}
if [ -e "$(/usr/bin/rustc --print sysroot 2>/dev/null)/lib/rustlib/$target/stamp" ] &&
    has arm-none-eabi-ld; then
    check "the library on $target, all $(functions | wc -l) functions" on_thumb
    sed 's/^/         /' "$work/said"
else
    skip "the library on $target" "no compiler for it (.ci/install-thumb $target)"
fi

printf '%d checks passed, %d failed, %d skipped; %s\n' $passed $failed $skipped "$said"
[ $failed = 0 ]
