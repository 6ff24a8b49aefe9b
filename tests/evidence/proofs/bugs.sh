#!/usr/bin/env bash
# check.sh --bugs [NAME...]: plants each bug of bugs.txt in a copy of the workspace, and sees that
# the harness named there fails. A bug costs a build of one crate. Exit status 1 when a harness does
# not see its bug, when a bug does not compile or its text is not there once.
set -euo pipefail
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
copy=$CARGO_TARGET_DIR/bugs/workspace
rm -rf "$copy"
mkdir -p "$copy"
(cd "$here/../../.." && tar cf - --exclude=./target --exclude='./.*' .) | tar xf - -C "$copy"
export CARGO_TARGET_DIR=$CARGO_TARGET_DIR/bugs/build CARGO_TERM_COLOR=never
cd "$copy/tests/evidence/proofs/run"
planted=0 found=0 quick=()
for room in units nets executive allocation assignment; do
    quick+=(--config "profile.dev.package.cotama-$room.opt-level=1")
done

# Plants the bug that was read, if one was, and runs its harness.
try() {
    [[ -n $harness ]] || return 0
    local path=$copy/$file text said features=()
    text=$(cat "$path"; printf x)
    local before=${text%%"$old"*} after=${text#*"$old"}
    planted=$((planted + 1))
    if [[ $before == "$text" || $after == *"$old"* ]]; then
        echo "$harness: NOT FOUND exactly once in $file: $old"
        return
    fi
    printf %s "$before$new${after%x}" >"$path"
    case $file in
        core/*) features=(--no-default-features) ;;
        models/*) features=(--no-default-features --features models) ;;
    esac
    # A bug must not hide behind what it costs to optimise the code.
    said=$(timeout 600 cargo run --quiet --locked "${features[@]}" "${quick[@]}" \
        -- "$harness" 2>&1) || true
    if grep -q "$harness: FAILS" <<<"$said"; then
        found=$((found + 1))
        echo "$harness: found"
    elif grep -q "^$harness: \|^[0-9]* harnesses" <<<"$said"; then
        echo "$harness: SURVIVED"
    else
        echo "$harness: DOES NOT COMPILE, or hangs"
        grep -m3 '^error' <<<"$said" || true
    fi
    printf %s "${text%x}" >"$path"
}

harness=
while IFS= read -r line; do
    case $line in
        'harness: '*)
            try
            harness=${line#*: } file='' old='' new=''
            [[ $# == 0 ]] || grep -qF "$(printf '%s\n' "$@")" <<<"$harness" || harness=
            ;;
        'file: '*) file=${line#*: } ;;
        '- '*) old+=${old:+$'\n'}${line#- } ;;
        '+ '*) new+=${new:+$'\n'}${line#+ } ;;
    esac
done <"$here/bugs.txt"
try
echo "$found of $planted bugs are found, each by its harness"
[[ $found == "$planted" ]]
