#!/usr/bin/env python3
"""Seeds the defects of the lists into one copy of the workspace, each chosen at run time, and says
which test notices it. `README.md` says what the lists look like.

    tests/mutants/run.py [LIST[:WORD]...]   defects of the lists (all by default) that contain WORD
    tests/mutants/run.py --write [LIST...]  and writes the tests that kill into the lists
    tests/mutants/run.py --table            writes the lists of README.md anew

The body of a function with defects is copied once for each: `if crate::defect::on(17) { the body
with defect 17 } else { the body }`, so that one build has them all. What the compiler refuses so
(mostly `const fn` that a constant calls) is found by its messages and built alone.

Exits 1 when a defect survives, does not compile, or when its text is not found exactly once.
"""
import json
import os
import re
import resource
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

sys.dont_write_bytecode = True
from choice import MODULE, VARIABLE, blamed, original, seeded, with_choice
from lists import ALL, LISTS, ROOT, read_list, table, write_killers

WORK = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "defects"
COPY = WORK / "workspace"
# They compile a crate of their own, or read texts; they ask nothing of the code that runs.
SKIPPED = [
    "first_program", "doc_examples", "claims", "seeded_defects", "certificates::small",
]
# How a run ends that hangs, or that a panic does not end.
ENDS = ["time", "a crash"]
NAMED_SECONDS = float(os.environ.get("SECONDS_PER_TEST", "60"))
MEMORY = 8_000_000_000

def write(path, text):
    """Writes what has changed only, so that cargo builds no more than it must."""
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def copy_workspace(but):
    """Copies what has changed, but the files that are written otherwise."""
    names = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard", "-z"],
        cwd=ROOT, check=True, capture_output=True, text=True,
    ).stdout.split("\0")
    for name in filter(None, names):
        source, target = ROOT / name, COPY / name
        if name in but or not source.is_file():
            continue
        content = source.read_bytes()
        if target.exists() and target.read_bytes() == content:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
        target.chmod(source.stat().st_mode)


def build(defects, only=None):
    """Builds the test programs of the defects: their paths by name, and the compiler's errors."""
    packages = sorted({package for it in defects for package in it.suite[0]})
    command = ["cargo", "test", "--offline", "--no-run", "--message-format=json"]
    for package in packages:
        command += ["-p", package]
    for target in targets(only or {program for it in defects for program in it.suite[1]}):
        command += ["--lib"] if target == "lib" else ["--test", target]
    environment = dict(
        os.environ, CARGO_TARGET_DIR=str(WORK / "build"), CARGO_PROFILE_DEV_DEBUG="0",
        CARGO_INCREMENTAL="1", RUSTFLAGS="--cap-lints allow",
    )
    run = subprocess.run(command, cwd=COPY, env=environment, capture_output=True, text=True)
    programs, errors = {}, []
    for line in run.stdout.splitlines():
        message = json.loads(line)
        if message["reason"] == "compiler-artifact" and message["executable"]:
            target, folder = message["target"], Path(message["manifest_path"]).parent
            if message["profile"]["test"]:
                name = target["name"] if target["kind"] == ["test"] else "lib"
                programs[f"{folder.name}/{name}"] = (message["executable"], folder)
        elif message["reason"] == "compiler-message" and message["message"]["level"] == "error":
            errors.append(message["message"])
    if run.returncode and not errors:
        sys.exit(run.stderr)
    return programs, errors


def targets(programs):
    """The names of test targets for cargo: of `core/` all of the crate."""
    names = set()
    for crate, target in (it.split("/") for it in programs):
        if target:
            names.add(target)
            continue
        manifest = (ROOT / crate / "Cargo.toml").read_text()
        names.update(re.findall(r'\[\[test\]\]\nname = "(\w+)"', manifest))
        if "autotests = false" not in manifest:
            for path in (ROOT / crate / "tests").iterdir():
                if path.suffix == ".rs" or (path / "main.rs").exists():
                    names.add(path.stem)
        if "test = false\n\n[features]" not in manifest:
            names.add("lib")
    return sorted(names)


class Runner:
    """Runs test programs, with a defect or without."""

    def __init__(self, programs):
        self.programs = programs
        self.seconds = {}

    def first_failure(self, program, number, arguments, limit, computing=None):
        """The first test that fails, `time`, `a crash`, or None when all pass; `limit` is in
        seconds on the clock, `computing` in those of the processor."""
        path, folder = program

        def alone():
            os.setsid()
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            if computing:
                resource.setrlimit(resource.RLIMIT_CPU, (computing, computing + 5))

        skipped = [it for name in SKIPPED for it in ("--skip", name)]
        environment = {**os.environ, VARIABLE: str(number), "RUST_BACKTRACE": "0"}
        run = subprocess.Popen(
            [path, *arguments, *skipped], cwd=folder,
            env=environment, preexec_fn=alone, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, errors="replace",
        )
        late = threading.Event()

        def end():
            late.set()
            os.killpg(run.pid, signal.SIGKILL)

        timer = threading.Timer(limit, end)
        timer.start()
        found = None
        ran = None
        for line in run.stdout:
            if failed := re.match(r"test (.*?)(?: - should panic)? \.\.\. FAILED$", line):
                found = failed.group(1)
                break
            if ended := re.match(r"running (\d+) tests?$", line):
                ran = int(ended.group(1))
        timer.cancel()
        if found is not None:
            try:
                os.killpg(run.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        status = run.wait()
        run.stdout.close()
        if found is None and "--exact" in arguments and ran == 0:
            return "no such test"
        if found is not None or status == 0:
            return found
        return "time" if late.is_set() or status == -signal.SIGXCPU else "a crash"

    def suite(self, defect):
        """The programs that may kill a defect, quick ones first."""
        programs = [
            it for it in self.programs
            if any(it == own or own.endswith("/") and it.startswith(own) for own in defect.suite[1])
        ]
        return sorted(programs, key=lambda it: (self.seconds.get(it, 0), it))

    def sound(self, defects):
        """Ends it all when a program fails without a defect; keeps how long each takes."""
        for program in sorted({it for defect in defects for it in self.suite(defect)}):
            begin = time.monotonic()
            failure = self.first_failure(self.programs[program], 0, [], 1800)
            if failure:
                sys.exit(f"without a defect, {program} {failure} fails")
            self.seconds[program] = round(time.monotonic() - begin, 1)

    def kill(self, defect, programs=None):
        """Who kills the defect: "PROGRAM TEST", or None."""
        programs = programs or {it: self.programs[it] for it in self.suite(defect)}
        if defect.by:
            program, test = defect.by.split(" ", 1)
            if program in programs:
                # A name that ends in `::` is a module, for one of whose tests it may do as well.
                names = [test] if test.endswith("::") else ["--exact", "--include-ignored", test]
                run = programs[program]
                failure = self.first_failure(run, defect.number, names, NAMED_SECONDS)
                if failure == "no such test":
                    print(f"  there is no test {defect.by}", flush=True)
                elif failure:
                    return f"{program} {test if failure in ENDS else failure}", failure
        for program, run in programs.items():
            limit = 30 + 3 * self.seconds.get(program, 60)
            if failure := self.first_failure(run, defect.number, [], limit):
                return f"{program} {failure}", failure
        return None


def check_texts(defects):
    """Ends it all where a text is not found exactly once."""
    wrong = []
    for defect in defects:
        old, new = defect.texts()
        path = ROOT / defect.file
        count = path.read_text().count(old) if old and path.is_file() else 0
        if count != 1 or old == new:
            wrong.append(f"{defect.list}.txt:{defect.line}: found {count} times in {defect.file}")
    if wrong:
        sys.exit("\n".join(wrong))


def programs_with_sources(crate):
    """The roots of test programs that hold a source file of the crate itself."""
    holds = [it for it in (ROOT / crate / "tests").glob("*/*.rs")
             if '#[path = "../../src/' in it.read_text()]
    return sorted({str(it.parent.relative_to(ROOT) / "main.rs") for it in holds})


def seed(defects):
    """Writes the copy with all of the defects that can be chosen, and no other."""
    files, changed = {}, {}
    for defect in defects:
        if not defect.alone:
            files.setdefault(defect.file, []).append(defect)
    for name, those in files.items():
        changed[name] = with_choice((ROOT / name).read_text(), those)
    for crate in {it.split("/")[0] for it in files}:
        for name in [f"{crate}/src/lib.rs", *programs_with_sources(crate)]:
            changed[name] = changed.get(name) or (ROOT / name).read_text()
            changed[name] += MODULE
    copy_workspace(changed)
    for name, text in changed.items():
        write(COPY / name, text)


def report(defect, killed):
    defect.result = killed and killed[0]
    said = f"survives, as is known: {defect.open}" if defect.open else "SURVIVES"
    if killed:
        said = f"killed by {killed[0]}" + (f" ({killed[1]})" if killed[1] in ENDS else "")
    print(f"{defect.list}.txt:{defect.line}: {defect.what}: {said}", flush=True)


def run(defects):
    begin = time.monotonic()
    while True:
        seed(defects)
        programs, errors = build(defects)
        if not errors:
            break
        guilty = blamed(errors, defects, COPY)
        if not guilty:
            sys.exit("\n".join(it["rendered"] for it in errors))
        for defect in guilty:
            print(f"{defect.list}.txt:{defect.line}: cannot be chosen at run time", flush=True)
            defect.alone = True
    print(f"built in {time.monotonic() - begin:.0f} s", flush=True)
    runner = Runner(programs)
    runner.sound(defects)
    print(f"sound after {time.monotonic() - begin:.0f} s: {runner.seconds}", flush=True)
    alone = [it for it in defects if it.alone]
    for defect in defects:
        if not defect.alone:
            report(defect, runner.kill(defect))
    together = time.monotonic() - begin
    for defect in alone:
        seed([])
        write(COPY / defect.file, seeded(original(defect), defect))
        killed, errors = None, []
        # One program after the other, first the one that kills.
        first = defect.by.split(" ")[0]
        for program in sorted(runner.suite(defect), key=lambda it: it != first):
            found, errors = build([defect], {program})
            killed = None if errors else runner.kill(defect, {program: found.get(program)})
            if killed or errors:
                break
        report(defect, killed)
        if errors:
            print("  it does not compile:", errors[0]["message"], flush=True)
    print(f"{len(defects) - len(alone)} together in {together:.0f} s, {len(alone)} alone in "
          f"{time.monotonic() - begin - together:.0f} s")


def main():
    os.environ.update({"LC_ALL": "C", "CARGO_TERM_COLOR": "never", "COTAMA_SKIP_PUBLIC": "1"})
    for name in ("COTAMA_MCC_DIR", "COTAMA_TPN_DIR", "UPDATE_GOLDEN"):
        os.environ.pop(name, None)
    if "--table" in sys.argv:
        return table()
    wanted = [it for it in sys.argv[1:] if not it.startswith("-")]
    defects = []
    for want in wanted or [it for it in ALL if (LISTS / f"{it}.txt").exists()]:
        name, _, word = want.partition(":")
        defects += [it for it in read_list(name) if word in it.file or word in it.what]
    for number, defect in enumerate(defects, 1):
        defect.number = number
    check_texts(defects)
    asked = [it for it in defects if not it.equivalent]
    run(asked)
    if "--write" in sys.argv:
        for name in {it.list for it in asked}:
            write_killers(name, [it for it in asked if it.list == name])
    killed = [it for it in asked if it.result]
    known = [it for it in asked if it.open and not it.result]
    print(f"{len(killed)} of {len(asked)} killed, {len(known)} known to survive, "
          f"{len(defects) - len(asked)} equivalent")
    sys.exit(0 if len(killed) + len(known) == len(asked) else 1)


if __name__ == "__main__":
    main()
