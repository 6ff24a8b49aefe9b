#!/usr/bin/env python3
"""Runs mutants that `cargo mutants` generates as `run.py` runs seeded defects: built together, each
chosen at run time, so that a thousand of them need one build.

    tests/mutants/generated.py NAME            the sample of generated/NAME.txt, written there
    tests/mutants/generated.py NAME --missed   again those that were missed, after tests were added
    tests/mutants/generated.py NAME --alone    builds those alone that were missed in a `const fn`
    tests/mutants/generated.py --table         writes generated/README.md anew

The head of a list says what is run:

    crate: core
    files: core/src/**/*.rs
    but: **/proofs.rs                    files left out
    sample: 600 19                       how many are drawn, with which seed; all without this line
    program: tests/stories players       who may kill, in this order; tests whose names hold a word
    compiled: tests/refused              each is built alone, and must break the build of the
                                         crate's tests, this program, or else one of those above

What the compiler computes is computed without a mutant when all are built together: those that
are missed in a `const fn` are built alone with `--alone`. Where a constant cannot be computed then,
it is no mutant: it is not built.

`CRATE/doc` stands for the examples of a crate's documentation, which are compiled each time.

They are run in the order in which they are drawn: when the file `defects/stop` appears in the
target directory, a run ends with a smaller sample. The rest of the suite is not run, so a mutant
that survives here may be killed by it. A run that computes for five times as long as without a
mutant and five seconds more is ended, and kills the mutant. Needs cargo-mutants, which lists them.
"""
import json
import os
import random
import resource
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True
from choice import CONST_MODULE, FEATURES, blamed, functions, seeded, with_choice
from lists import ROOT, SUITES, Defect
from samples import COUNTS, List, table
import run as runs

# Where this file appears, a run ends with the mutants that it has run.
STOP = runs.WORK / "stop"
# So many programs run at once.
WORKERS = int(os.environ.get("WORKERS", "2"))
# A compiler that computes for longer than so many seconds is ended.
COMPILING = 100
# With them the tests are built.
FEATURES_OF = {"cotama-core": ["--features", "alloc"]}


def offset(text, place):
    """Of a line and a column, both from 1, in characters."""
    lines = text.split("\n")
    return sum(len(it) + 1 for it in lines[: place["line"] - 1]) + place["column"] - 1


def listed(sample):
    """All mutants of the list's files in the order of cargo-mutants."""
    package = SUITES[sample.crate][0][0]
    command = ["cargo", "mutants", "--list", "--json", "-p", package]
    for files in sample.files:
        command += ["-f", files]
    for files in sample.but:
        command += ["-e", files]
    out = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
    defects = []
    for it in json.loads(out):
        text = (ROOT / it["file"]).read_text()
        defect = Defect(sample.crate, it["span"]["start"]["line"], it["name"].split(": ", 1)[1])
        begin, end = (offset(text, it["span"][name]) for name in ("start", "end"))
        defect.file, defect.at = it["file"], begin
        defect.old, defect.new = text[begin:end].split("\n"), it["replacement"].split("\n")
        defect.source = text.split("\n")[defect.line - 1].strip()
        defects.append(defect)
    return defects


def seed(defects):
    """Writes the copy with all mutants that can be chosen."""
    files, changed = {}, {}
    for defect in defects:
        if not defect.alone:
            files.setdefault(defect.file, []).append(defect)
    for name, those in files.items():
        changed[name] = with_choice((ROOT / name).read_text(), those, constant=True)
    for crate in {it.file.split("/")[0] for it in defects}:
        name = f"{crate}/src/lib.rs"
        text = changed.get(name) or (ROOT / name).read_text()
        changed[name] = FEATURES + text + CONST_MODULE
    runs.copy_workspace(changed)
    for name, text in changed.items():
        runs.write(runs.COPY / name, text)


def check(package, targets="--lib"):
    """The compiler's errors in a library, or in its tests."""
    command = ["cargo", "check", "--offline", targets, "--message-format=json", "-p", package]
    command += FEATURES_OF.get(package, [])
    environment = dict(os.environ, CARGO_TARGET_DIR=str(runs.WORK / "check"))
    if targets == "--lib":
        # But a constant that is computed for ever is an error.
        environment["RUSTFLAGS"] = "--cap-lints allow"
    run = subprocess.run(
        command, cwd=runs.COPY, env=environment, capture_output=True, text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (COMPILING, COMPILING + 5)),
    )
    messages = [json.loads(it) for it in run.stdout.splitlines()]
    found = [it["message"] for it in messages if it["reason"] == "compiler-message"]
    errors = [it for it in found if it["level"] == "error"]
    if run.returncode and not errors and "(signal: " in run.stderr:
        return [{"message": "the compiler computes too long", "code": {"code": "E0080"}}]
    if run.returncode and not errors:
        sys.exit(run.stderr)
    return errors


def viable(sample, defects):
    """Marks as alone what cannot be built with the others."""
    while True:
        seed(defects)
        errors = check(SUITES[sample.crate][0][0])
        if not errors:
            return
        guilty = [it for it in blamed(errors, defects, runs.COPY) if not it.alone]
        if not guilty:
            sys.exit("\n".join(it["rendered"] for it in errors))
        for defect in guilty:
            defect.alone = True
        print(f"{len(guilty)} are not built", flush=True)


def is_stopped(sample, run):
    """Whether the run is to end: so many are a sample as well, as they are run in the order in which
    they are drawn."""
    if not STOP.exists() or not sample.taken:
        return False
    STOP.unlink()
    sample.shorten(run)
    return True


def alone(sample, defects, counts, missed):
    """What the compiler runs: each is built by itself, without a choice."""
    package = SUITES[sample.crate][0][0]
    programs = [(sample.compiled, []), *sample.programs]
    for defect in defects:
        defect.suite = (defect.suite[0], [it for it, _ in programs])
    library = f"{sample.crate}/src/lib.rs"
    # Nobody is to be warned of what the mutant does not use.
    quiet = "#![allow(warnings, clippy::all, clippy::pedantic, clippy::nursery)]\n"

    def write(defect):
        runs.copy_workspace({library})
        texts = {library: (ROOT / library).read_text()}
        if defect:
            texts[defect.file] = seeded((ROOT / defect.file).read_text(), defect)
        texts[library] = quiet + texts[library]
        for name, text in texts.items():
            runs.write(runs.COPY / name, text)

    write(None)
    built, errors = runs.build(defects)
    if errors:
        sys.exit("\n".join(it["rendered"] for it in errors))
    runner = runs.Runner(built)
    for program, names in programs:
        if failure := runner.first_failure(built[program], 0, names, 1800):
            sys.exit(f"without a mutant, {program} {failure} fails")

    def killer(defect):
        """What fails, and how."""
        if check(package, "--tests"):
            return "caught", "the compiler"
        # What runs as it was built before is not built again.
        for number, (program, names) in enumerate(programs):
            found = built
            if number > 0:
                found, errors = runs.build([defect], {program})
                if errors:
                    return "caught", f"the compiler of {program}"
            if failure := runner.first_failure(found[program], 0, names, 600):
                return "too long" if failure == "time" else "caught", f"{program} {failure}"
        return "missed", ""

    for run, defect in enumerate(defects):
        if is_stopped(sample, run):
            break
        write(defect)
        how, said = "caught", "the compiler"
        errors = check(package)
        # A constant of the library that panics is no mistake of the mutant's syntax or types.
        if any((it.get("code") or {}).get("code") != "E0080" for it in errors):
            how, said = "not built", errors[0]["message"].split("\n")[0]
        elif not errors:
            how, said = killer(defect)
        counts[how] += 1
        print(f"{defect.file}:{defect.line}: {defect.what}: {how}: {said}", flush=True)
        if how == "missed":
            missed.append(defect)


def examples(crate, target):
    """How the examples of a crate's documentation are run, as its tests were built."""
    package = SUITES[crate][0][0]
    environment = {
        "CARGO_TARGET_DIR": target, "CARGO_PROFILE_DEV_DEBUG": "0", "CARGO_INCREMENTAL": "1",
        "RUSTFLAGS": "--cap-lints allow",
    }
    names = [f"{name}={value}" for name, value in environment.items()]
    command = ["cargo", "test", "--offline", "--doc", "-p", package]
    return [*names, *command, *FEATURES_OF.get(package, []), "--"]


def is_refused(sample, defect):
    """Whether the library is not built with a mutant alone: constants are computed with it then."""
    runs.copy_workspace({defect.file})
    runs.write(runs.COPY / defect.file, seeded((ROOT / defect.file).read_text(), defect))
    return bool(check(SUITES[sample.crate][0][0]))


def is_const(defect):
    """Whether it is in a `const fn`."""
    text = (ROOT / defect.file).read_text()
    return any(it[0] is not None and it[2] < defect.at < it[3] for it in functions(text))


def spent():
    """Seconds of computing of the programs that have run."""
    return sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def main():
    if "--table" in sys.argv:
        return table()
    name = sys.argv[1]
    sample = List(name)
    os.environ.update({"LC_ALL": "C", "CARGO_TERM_COLOR": "never", "COTAMA_SKIP_PUBLIC": "1"})
    os.environ["RUSTC_BOOTSTRAP"] = "cotama_core,cotama_models,cotama_verification,cotama_sim"
    os.environ.pop("UPDATE_GOLDEN", None)
    found = listed(sample)
    defects = found
    again = "--missed" in sys.argv
    if again or "--alone" in sys.argv:
        # Sources may have changed since, and with them what would be drawn.
        defects = list({sample.known(it).key(): it for it in found if sample.known(it)}.values())
        if len(defects) != len(sample.missed):
            sys.exit("a mutant that was missed is no more there, or is there twice")
    elif sample.taken:
        # A larger sample of the same seed has all of the smaller one.
        drawn = random.Random(sample.seed).sample(range(len(found)), len(found))
        defects = [found[it] for it in drawn[: sample.taken]]
    packages = sorted({it for crate in sample.crates() & SUITES.keys() for it in SUITES[crate][0]})
    tests = [it for it, _ in sample.programs if not it.endswith("/doc")]
    for number, defect in enumerate(defects, 1):
        defect.number, defect.suite = number, (packages, tests)
    print(f"{len(defects)} of {len(found)} mutants", flush=True)
    begin = time.monotonic()
    if sample.compiled:
        counts, missed = dict.fromkeys(COUNTS, 0), []
        alone(sample, defects, counts, missed)
        return sample.write(len(found), counts, missed, again)
    docs = {}
    for program, names in sample.programs:
        crate, _, target = program.partition("/")
        if target == "doc":
            docs[program] = ("env", runs.COPY / crate)
            names[:] = examples(crate, runs.WORK / "build")
    if "--alone" in sys.argv:
        for defect in filter(is_const, defects):
            runs.copy_workspace(set())
            if is_refused(sample, defect):
                print(f"{defect.file}:{defect.line}: {defect.what}: not built", flush=True)
                sample.not_built(defect)
        return None
    viable(sample, defects)
    print(f"checked after {time.monotonic() - begin:.0f} s", flush=True)
    built, errors = runs.build(defects)
    if errors:
        sys.exit("\n".join(it["rendered"] for it in errors))
    print(f"built after {time.monotonic() - begin:.0f} s", flush=True)
    runner = runs.Runner({**built, **docs})
    limits = []
    for program, names in sample.programs:
        start = spent()
        if failure := runner.first_failure(runner.programs[program], 0, names, 1800):
            sys.exit(f"without a mutant, {program} {failure} fails")
        limits.append(round(5 + 5 * (spent() - start)))
    print(f"seconds at most: {limits}", flush=True)
    counts = dict.fromkeys(COUNTS, 0)
    missed, killers = [], {}

    def killer(defect):
        """The program that kills, and the test that fails."""
        # Who killed the one before in this file is asked first.
        order = sorted(range(len(limits)), key=lambda it: it != killers.get(defect.file))
        for asked in order:
            program, names = sample.programs[asked]
            limit = limits[asked]
            failure = runner.first_failure(
                runner.programs[program], defect.number, names, 10 * limit, limit
            )
            if failure:
                killers[defect.file] = asked
                return program, failure
        return None

    with ThreadPoolExecutor(WORKERS) as pool:
        runs_of = [None if it.alone else pool.submit(killer, it) for it in defects]
        for run, (defect, asked) in enumerate(zip(defects, runs_of)):
            if not again and is_stopped(sample, run):
                pool.shutdown(cancel_futures=True)
                break
            if asked is None:
                counts["not built"] += 1
                continue
            killed = asked.result()
            how = "missed" if not killed else "too long" if killed[1] == "time" else "caught"
            counts[how] += 1
            said = " ".join(killed) if killed else "missed"
            print(f"{defect.file}:{defect.line}: {defect.what}: {said}", flush=True)
            if not killed:
                missed.append(defect)
    print(f"done after {time.monotonic() - begin:.0f} s", flush=True)
    sample.write(len(found), counts, missed, again)


if __name__ == "__main__":
    main()
