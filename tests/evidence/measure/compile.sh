#!/usr/bin/env bash
# What it costs to check nets while compiling: the processor time of `cargo check` of a library with
# one net, less that of the same net without the token that it needs to move, so with one marking.
# Median of five.
#
#   tests/evidence/measure/compile.sh
#
# Times are of this machine and compiler. The last line is a net that is too large: how long until
# it is refused.
set -euo pipefail
cd "$(dirname "$0")/../../.."
package=$(mktemp -d)
trap 'rm -rf "$package"' EXIT
mkdir "$package/src"
cat >"$package/Cargo.toml" <<TOML
[workspace]
[package]
name = "measured"
version = "0.0.0"
edition = "2024"
[dependencies]
cotama-core = { path = "$PWD/core" }
TOML
export CARGO_TARGET_DIR=$package/target

# A net: its tokens in `On`, its flags and counters, its transitions, its laws, and events beyond
# the usual ones. Every transition reads `On`.
net() {
    echo "cotama_core::net! { pub mod measured { places { On: $1, A: 1, B, C, D, E } $2"
    echo "events { Go, Back, Up, Down, Set, Clear ${5:-} } transitions { $3 } laws { $4 } } }"
}

# One counter that rises: as many markings as values.
chain() {
    net "$1" "counters { count: 0 of $(($2 - 1)) }" "up on Up: _ => _ read On do count += 1;" \
        "always_can(A);"
}

# Flags that are set and cleared, each by itself: 2^n markings.
toggles() {
    local flags="" lines="" events="" flag
    for flag in $(seq "$2"); do
        flags+="f$flag, "
        events+=", Set$flag, Clear$flag"
        lines+="set$flag on Set$flag [!f$flag]: _ => _ read On do f$flag = true;"
        lines+="clear$flag on Clear$flag [f$flag]: _ => _ read On do f$flag = false;"
    done
    net "$1" "flags { $flags }" "$lines" "always_can(A); deadlock_free_except(A);" "$events"
}

# Flags that are set by events and cleared after some time, each by itself: all orders of deadlines.
timers() {
    local flags="" lines="" events="" flag
    for flag in $(seq "$2"); do
        flags+="f$flag, "
        events+=", Set$flag"
        lines+="set$flag on Set$flag [!f$flag]: _ => _ read On do f$flag = true;"
        lines+="clear$flag [f$flag]: _ => _ read On do f$flag = false"
        lines+=" within ${flag}_000..=${flag}_000 ms;"
    done
    net "$1" "flags { $flags }" "$lines" "always_can(A); deadlock_free_except(A);" "$events"
}

# A supervisor of 20 transitions: five states, two flags and a counter.
supervisor() {
    local lines="" from=A to
    for to in B C D E A; do
        lines+="go_$from on Go: $from => $to read On; back_$from on Back: $to => $from read On;"
        from=$to
    done
    lines+="stop_B on Down [hot]: B => A read On; stop_C on Down [hot]: C => A read On;"
    lines+="stop_D on Down [hot]: D => A read On; stop_E on Down [hot]: E => A read On;"
    lines+="heat on Set [!hot]: _ => _ read On do hot = true;"
    lines+=" cool on Clear [hot]: _ => _ read On do hot = false;"
    lines+="light on Set [hot & !lit]: _ => _ read On do lit = true;"
    lines+="dark on Clear [!hot & lit]: _ => _ read On do lit = false;"
    lines+="up on Up: _ => _ read On do count += 1;"
    lines+=" down on Down [!hot]: _ => _ read On do count -= 1;"
    local laws="invariant(A & B & C & D & E = 1); never_both(B, C); always_can(A);"
    laws+=" deadlock_free_except(A);"
    net "$1" "flags { hot, lit } counters { count: 0 of $(($2 / 20 - 1)) }" "$lines" \
        "$laws deterministic;"
}

# Processor time of one check, in milliseconds; ends the script when the compiler says something
# else than this.
once() {
    local TIMEFORMAT=%U seconds
    cargo clean --quiet --package measured --manifest-path "$package/Cargo.toml"
    if ! seconds=$( { time cargo check --quiet --offline --manifest-path "$package/Cargo.toml" \
        2>"$package/said"; } 2>&1 ) &&
        ! grep -q "$1" "$package/said"; then
        cat "$package/said" >&2
        exit 1
    fi
    echo $((10#${seconds//./}))
}

median() {
    local run times=()
    for run in 1 2 3 4 5; do times+=("$(once "$1")"); done
    printf '%s\n' "${times[@]}" | sort -n | sed -n 3p
}

net 1 "" "go on Go: A => B read On;" "" >"$package/src/lib.rs"
once "no error" >/dev/null
printf '%-12s %9s %12s %12s\n' net markings "cargo check" exploration
while read -r kind size markings; do
    "$kind" 0 "$size" >"$package/src/lib.rs"
    still=$(median "no error")
    "$kind" 1 "$size" >"$package/src/lib.rs"
    moving=$(median "more than 1,024 markings")
    printf '%-12s %9s %9d ms %9d ms\n' "$kind" "$markings" "$moving" "$((moving - still))"
done <<'NETS'
chain 2 2
chain 10 10
chain 100 100
chain 500 500
chain 1000 1000
toggles 1 2
toggles 3 8
toggles 7 128
toggles 9 512
toggles 10 1024
timers 1 2
timers 2 4
timers 3 8
timers 4 16
supervisor 40 40
supervisor 100 100
supervisor 500 500
supervisor 1000 1000
supervisor 2000 >1,024
NETS
