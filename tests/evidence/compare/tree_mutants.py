#!/usr/bin/env python3
"""Changes in the executor of behaviour trees, each of which the tests of its crate must notice.

    tree_mutants.py [--mutants N] [--seed N] [--target DIR]

Operators, not places, say what is changed, so that the source may change too: a statement is left
out (memory not kept, status not set, wake-up forgotten, children not reset), a loop goes backwards
(order of halting), a comparison is turned or moved by one (thresholds, which status guards look
at), a number is one larger, an answer is another. Traces and facts are read from COTAMA_BT_DIR.
Changes that do not compile are not counted. Those that no test notices are printed.
"""

import argparse
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

SOURCES = "verification/trees/src"
SWAPS = [
    (r"^(\s*)((?:m|self)\.[^=]*;|(?:m|self)\.wake = true;)$", r"\1", "leaves out"),
    (r"\bfor (\S+) in ((?:m|self)\.children\(node\)) \{", r"for \1 in \2.iter().rev() {",
     "reverses"),
    (r"\bfor (\S+) in (\S+\.\.\S+) \{", r"for \1 in (\2).rev() {", "reverses"),
    (r" == ", " != ", "turns"),
    (r" != ", " == ", "turns"),
    (r" < ", " <= ", "moves"),
    (r" <= ", " < ", "moves"),
    (r" >= ", " > ", "moves"),
    (r" > ", " >= ", "moves"),
    (r" \+ 1\b", " + 2", "moves"),
    (r" && ", " || ", "turns"),
    (r"Status::Idle\b", "Status::Failure", "renames"),
    (r"Status::Running\b", "Status::Idle", "renames"),
    (r"Answer::Success\b", "Answer::Failure", "renames"),
    (r"Answer::Failure\b", "Answer::Success", "renames"),
    (r"Answer::Running\b", "Answer::Skipped", "renames"),
    (r"Answer::Skipped\b", "Answer::Running", "renames"),
    (r"(\{|\() node, (\w+), 1\)", r"\1 node, \2, 0)", "moves"),
]


def candidates(path):
    """Returns all changes of a file: number of the line, what it becomes, in a word."""
    found = []
    for at, line in enumerate(path.read_text().splitlines()):
        if "#[cfg(test)]" in line:
            break
        if line.lstrip().startswith(("//", "use ", "#[", "fn ", "pub", "const ")):
            continue
        for pattern, new, word in SWAPS:
            for match in re.finditer(pattern, line):
                changed = line[: match.start()] + match.expand(new) + line[match.end():]
                found.append((at, changed, word))
    return found


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("--mutants", type=int, default=60)
    words.add_argument("--seed", type=int, default=46)
    words.add_argument("--target", default=None)
    args = words.parse_args()
    if not os.environ.get("COTAMA_BT_DIR"):
        sys.exit("COTAMA_BT_DIR names no folder of traces and trees")
    draw = random.Random(args.seed)
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        archive = subprocess.run(["git", "archive", "HEAD"], check=True, capture_output=True).stdout
        subprocess.run(["tar", "-x", "-C", folder], input=archive, check=True)
        target = args.target or str(root / "target")
        env = {**os.environ, "CARGO_TARGET_DIR": target, "CARGO_INCREMENTAL": "0"}
        test = ["cargo", "test", "--offline", "-q", "-p", "cotama-trees", "--test", "trees"]

        def run(more):
            return subprocess.run(test + more, cwd=root, env=env, capture_output=True, text=True,
                                  timeout=570)

        assert run([]).returncode == 0, "the tests pass before anything is changed"
        files = sorted((root / SOURCES / "machine").glob("*.rs")) + [root / SOURCES / "machine.rs"]
        files = [it for it in files if it.name not in ("words.rs", "cells.rs")]
        changes = [(path, *it) for path in files for it in candidates(path)]
        draw.shuffle(changes)
        counted = noticed = 0
        for path, at, changed, word in changes:
            if counted == args.mutants:
                break
            before = path.read_text()
            lines = before.splitlines()
            was, lines[at] = lines[at], changed
            path.write_text("\n".join(lines) + "\n")
            try:
                if run(["--no-run"]).returncode == 0:
                    counted += 1
                    try:
                        seen = run([]).returncode != 0
                    except subprocess.TimeoutExpired:
                        seen = True
                    noticed += seen
                    place = f"{path.relative_to(root)}:{at + 1}"
                    what = f"{word}: {was.strip()} -> {changed.strip() or 'nothing'}"
                    print(f"{'noticed' if seen else 'NOT SEEN'}  {place}  {what}", flush=True)
            finally:
                path.write_text(before)
        print(f"{counted} changes of {len(changes)}, {noticed} noticed")
        sys.exit(noticed != counted)


main()
