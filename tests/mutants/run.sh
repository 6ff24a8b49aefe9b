#!/usr/bin/env bash
# Seeds one defect after the other into a copy of the workspace, and sees whether a test fails each
# time.
#
#   tests/mutants/run.sh [LIST...]       all lists next to this script by default: one for each
#                                        engine of the checker, and `decisional`
#   tests/mutants/run.sh --table         writes the lists of README.md anew
#
# A list has paragraphs:
#
#   mutant: what is wrong, in plain words
#   file: path below verification/src; for `decisional`, in the workspace
#   crate: `models` for a defect that models/tests/supervised kills, in `decisional`
#   test: the module of tests/engines.rs that kills it, where it is not the one of the engine; for
#       `decisional`, of sim/tests/supervised
#   by: the test that kills it, tried first; the whole module is run only when it does not;
#       `time` when the module hangs
#   - text that occurs exactly once in the file, of one or more lines
#   + text in its place
#   equivalent: why no test can tell the difference; then it is not run
#
# Each mutant costs one incremental build of the crate and of its test program, and one test.
# Before, the tests that are named in a list are run once without a defect; a test that kills and is
# not named is run again without the defect, after it. SECONDS_PER_RUN (default 120) is how long tests
# may take: one that hangs is killed by time. Exits 1 when a mutant survives, does not compile, or
# its text is not found, or when a test fails without a defect.
set -euo pipefail
export LC_ALL=C CARGO_PROFILE_DEV_DEBUG=0 CARGO_INCREMENTAL=1 CARGO_TERM_COLOR=never
unset COTAMA_MCC_DIR COTAMA_TPN_DIR # the suite alone must do
lists=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$lists/../.." && pwd)
work=${CARGO_TARGET_DIR:-$root/target}/mutants
copy=$work/workspace
export CARGO_TARGET_DIR=$work/build
limit=${SECONDS_PER_RUN:-120}
declare -A target_of=([explicit]=statespace [certificate]=certificates [classes_ltl]=check
    [classes_ctl]=check [fairness]=check [budget]=check)
bad=0

# Builds the tests of the list; prints where they are.
build() {
    (cd "$copy" && cargo test --offline -p "cotama-$crate" --test "$program" --no-run \
        --message-format=json) \
        2>"$work/build.log" | sed -n 's/.*"executable":"\([^"]*\)".*/\1/p' | tail -1
}

# Runs tests until one fails; prints its name, or `time`, or `a crash`; nothing when all pass.
first_failure() {
    local line out tests status=0
    exec {out}< <(cd "$copy/$crate" && ulimit -v 16000000 &&
        exec timeout "$limit" "$@" 2>/dev/null)
    tests=$!
    while read -r line <&"$out"; do
        if [[ $line =~ ^test\ (.*)\ \.\.\.\ FAILED$ ]]; then
            echo "${BASH_REMATCH[1]}"
            kill "$tests" 2>/dev/null || true
            return
        fi
    done
    wait "$tests" || status=$?
    case $status in 0) ;; 124) echo time ;; *) echo "a crash" ;; esac
}

# Ends it all when tests of these names, or with these beginnings, fail without a defect.
sound() {
    local tests failure
    tests=$(build)
    failure=$(first_failure "$tests" "$@")
    [[ -z $failure ]] || { echo "$engine: without a defect $failure fails" >&2; exit 1; }
}

report() { printf '%s: %s: %s\n' "$engine" "$mutant" "$1"; }

# Runs the mutant that was read, if one was.
try() {
    [[ -n $mutant ]] || return 0
    local path=$copy/$below$file text tests killer=
    if [[ -n $equivalent ]]; then
        report "equivalent: $equivalent"
        return
    fi
    text=$(cat "$path"; printf x)
    local before=${text%%"$old"*} after=${text#*"$old"}
    if [[ $before == "$text" || $after == *"$old"* ]]; then
        report "NOT FOUND exactly once in $file"
        bad=1
        return
    fi
    cp -p "$path" "$work/original"
    printf %s "$before$new${after%x}" >"$path"
    if tests=$(build) && [[ -n $tests ]]; then
        [[ -z $by || $by == time ]] ||
            killer=$(first_failure "$tests" --exact "$target::$by")
        if [[ -z $killer ]]; then
            killer=$(first_failure "$tests" "$target::")
            cat "$work/original" >"$path"
            case $killer in
                '') ;;
                time | 'a crash') sound "$target::" ;;
                *) sound --exact "$killer" ;;
            esac
        fi
        if [[ -n $killer ]]; then
            report "killed by ${killer#"$target"::}"
        else
            report SURVIVED
            bad=1
        fi
    else
        report "DOES NOT COMPILE"
        grep -m3 '^error' "$work/build.log" || true
        bad=1
    fi
    cat "$work/original" >"$path"
}

run() {
    engine=$1 usual=${target_of[$1]:-$1} crate=verification program=engines below=verification/src/
    [[ $engine != decisional ]] || crate=sim program=supervised below=
    local usual_crate=$crate
    local line name names
    for name in $({ echo "$usual"; sed -n 's/^test: //p' "$lists/$engine.txt"; } | sort -u); do
        mapfile -t names < <(awk -v usual="$usual" -v wanted="$name" '
            /^mutant: / { target = usual }
            /^test: / { target = $2 }
            /^by: / && $2 != "time" && target == wanted { print wanted "::" $2 }' \
            "$lists/$engine.txt" |
            sort -u)
        [[ ${#names[@]} == 0 ]] || sound --exact "${names[@]}"
    done
    mutant=
    while IFS= read -r line; do
        case $line in
            'mutant: '*)
                try
                mutant=${line#*: } target=$usual file='' by='' old='' new='' equivalent=''
                crate=$usual_crate
                ;;
            'file: '*) file=${line#*: } ;;
            'by: '*) by=${line#*: } ;;
            'test: '*) target=${line#*: } ;;
            'crate: '*) crate=${line#*: } ;;
            'equivalent: '*) equivalent=${line#*: } ;;
            '- '*) old+=${old:+$'\n'}${line#- } ;;
            '+ '*) new+=${new:+$'\n'}${line#+ } ;;
        esac
    done <"$lists/$engine.txt"
    try
}

# The introduction, then for each engine a list of its defects, in lines of 100 columns.
table() {
    sed '/^## /,$d' "$lists/README.md"
    for name in "${all[@]}"; do
        printf '## %s\n\n' "$name"
        awk -v usual="${target_of[$name]:-$name}" '
            function row(    killer, words, count, line, at) {
                if (mutant == "") return
                if (equivalent != "") killer = "equivalent: " equivalent
                else if (by == "time") killer = "the tests of `" target "` hang"
                else killer = "`" target " " by "`"
                count = split("- " mutant ": " killer, words, " ")
                line = words[1]
                for (at = 2; at <= count; at++) {
                    if (length(line " " words[at]) > 100) {
                        print line
                        line = "  " words[at]
                    } else {
                        line = line " " words[at]
                    }
                }
                print line
            }
            /^mutant: / { row(); mutant = substr($0, 9); target = usual; by = equivalent = "" }
            /^test: / { target = substr($0, 7) }
            /^by: / { by = substr($0, 5) }
            /^equivalent: / { equivalent = substr($0, 13) }
            END { row(); print "" }' "$lists/$name.txt"
    done | sed '$d'
}

all=(structural reductions explicit stubborn temporal fairness coverability tpn classes_ltl
    classes_ctl budget certificate decisional)
if [[ ${1-} == --table ]]; then
    table >"$lists/README.new"
    mv "$lists/README.new" "$lists/README.md"
    exit
fi
# All anew: what a run that was killed half-way has built may be a mutant.
rm -rf "$work"
mkdir -p "$copy"
(cd "$root" && tar cf - --exclude=./target --exclude='./.*' .) | tar xf - -C "$copy"
[[ $# -gt 0 ]] || set -- "${all[@]}"
for name in "$@"; do run "$name"; done
exit $bad
