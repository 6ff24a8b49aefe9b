#!/usr/bin/env python3
"""Runs mutants that `cargo mutants` generates as `run.py` runs seeded defects: built together, each
chosen at run time, so that a thousand of them need one build.

    tests/mutants/generated.py CRATE GLOB[,GLOB...] EVERY PROGRAM[,PROGRAM...] [TEST...]

Of the mutants in those files of a crate every EVERY-th is taken, in the order of cargo-mutants;
each PROGRAM is a test program that may kill them (`core/lib`), of it the tests whose names contain
one of TEST. The rest of the suite is not run, so a mutant that survives here may be killed by it.
What the compiler refuses is counted as unviable; that includes what a constant calls, which could
be built alone.
"""
import json
import os
import subprocess
import sys

sys.dont_write_bytecode = True
from lists import ROOT, Defect, SUITES
import run as runs

SECONDS = 60


def offset(text, place):
    """Of a line and a column, both from 1, in characters."""
    lines = text.split("\n")
    return sum(len(it) + 1 for it in lines[: place["line"] - 1]) + place["column"] - 1


def listed(crate, globs, every):
    package = SUITES[crate][0][0]
    command = ["cargo", "mutants", "--list", "--json", "-p", package]
    for glob in globs.split(","):
        command += ["-f", glob]
    found = json.loads(subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout)
    sample = found[::every]
    print(f"{len(sample)} of {len(found)} mutants", flush=True)
    defects = []
    for number, it in enumerate(sample, 1):
        defect = Defect(crate, it["span"]["start"]["line"], it["name"].split(": ", 1)[1])
        text = (ROOT / it["file"]).read_text()
        begin, end = (offset(text, it["span"][name]) for name in ("start", "end"))
        defect.file, defect.at, defect.number = it["file"], begin, number
        defect.old, defect.new = text[begin:end].split("\n"), it["replacement"].split("\n")
        defects.append(defect)
    return defects


def main():
    crate, globs, every, programs, *names = sys.argv[1:]
    os.environ.update({"LC_ALL": "C", "CARGO_TERM_COLOR": "never", "COTAMA_SKIP_PUBLIC": "1"})
    os.environ.pop("UPDATE_GOLDEN", None)
    asked = programs.split(",")
    defects = listed(crate, globs, int(every))
    for defect in defects:
        # Constants, and what else stands outside of functions, cannot be chosen.
        defect.suite = (SUITES[crate][0], asked)
    while True:
        runs.seed(defects)
        built, errors = runs.build(defects)
        if not errors:
            break
        guilty = runs.blamed(errors, defects, runs.COPY)
        if not guilty:
            sys.exit("\n".join(it["rendered"] for it in errors))
        for defect in guilty:
            defect.alone = True
        print(f"{len(guilty)} are not built", flush=True)
    runner = runs.Runner(built)

    def first(number, seconds):
        """The first test that fails in any of the programs."""
        tried = (runner.first_failure(built[it], number, names, seconds) for it in asked)
        return next((it for it in tried if it), None)

    if failure := first(0, 1800):
        sys.exit(f"without a mutant, {failure} fails")
    told = {"caught": 0, "missed": 0, "timeout": 0, "unviable": 0}
    for defect in defects:
        if defect.alone:
            told["unviable"] += 1
            continue
        failure = first(defect.number, SECONDS)
        how = "timeout" if failure == "time" else "caught" if failure else "missed"
        told[how] += 1
        if how != "caught":
            print(f"{how}: {defect.file}:{defect.line}: {defect.what}", flush=True)
    print(", ".join(f"{number} {how}" for how, number in told.items()))
    viable = len(defects) - told["unviable"]
    print(f"{100 * (viable - told['missed']) / max(viable, 1):.1f} % of {viable} viable")


if __name__ == "__main__":
    main()
