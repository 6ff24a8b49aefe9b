#!/usr/bin/env python3
"""`cotama estimate` beside SCAN (smc_scan 0.3.0), on equal models, one thread each.

    cargo install smc_scan --version 0.3.0 --locked --root DIR
    cargo build --profile dist -p cotama
    tests/evidence/compare/smc/smc.py --scan DIR/bin/scan --cotama target/dist/cotama

Each model is what `cotama export MODEL --format jani` writes, with a counter of steps that ends a
run and the question as a property of SCAN's dialect. SCAN draws until its precision is reached;
here 20 times as many runs are drawn, so that the clock can tell. Measured is the processor time of
whole programs, less that of one run or of a few, which is loading and building; the median of
--repeat rounds, in turns. Exit status 1 when a
verdict differs, intervals do not overlap, or a ratio is below 20.
"""

import argparse
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

CONFIDENCE, LEAST = 0.95, 20

# The model, its options, the question, its goal (none: a deadlock), the most steps, and how far a
# share may be from the truth.
CASES = [
    ("watchdog", ["--untimed"], "EF Fault", {"Fault": 1}, 20, 0.01),
    ("philosophers:5", [], "EF deadlock", None, 40, 0.01),
    ("philosophers:8", [], "EF deadlock", None, 60, 0.01),
    ("philosophers:12", [], "EF (eat_1 & eat_7)", {"eat_1": 1, "eat_7": 1}, 60, 0.01),
    ("local", [], "EF HandOver", {"HandOver": 1}, 12, 0.01),
    ("delivery_by_hand", [], "EF ls.Planning", {"ls_Planning": 1}, 60, 0.02),
    ("delivery_by_hand", [], "EF (ls.Following & gom.not_wifi)", {"ls_Following": 1, "gom_not_wifi": 1},
     200, 0.02),
]


def both(terms):
    """All of them, as a balanced tree of conjunctions."""
    if len(terms) == 1:
        return terms[0]
    half = (len(terms) + 1) // 2
    return {"op": "∧", "left": both(terms[:half]), "right": both(terms[half:])}


def marked(variable, tokens):
    return {"op": "≥", "left": variable, "right": tokens}


def for_scan(model, goal, steps):
    """The exported model with a counter that ends each run, and the question."""
    automaton = model["automata"][0]
    bounds = {"kind": "bounded", "base": "int", "lower-bound": 0, "upper-bound": steps}
    model["variables"].append({"name": "steps", "type": bounds, "initial-value": 0})
    guards = []
    for edge in automaton["edges"]:
        own = [edge["guard"]["exp"]] if "guard" in edge else []
        guards += own
        edge["guard"] = {"exp": both([{"op": "<", "left": "steps", "right": steps}, *own])}
        count = {"ref": "steps", "value": {"op": "+", "left": "steps", "right": 1}}
        edge["destinations"][0]["assignments"].append(count)
    if goal is None:
        # No disjunction: SCAN 0.3.0 reads `(a and b) or c` as `a and b and c`.
        reached = both([{"op": "¬", "exp": it} for it in guards])
    else:
        reached = both([marked(place, tokens) for place, tokens in goal.items()])
    path = {"op": "Pmax", "exp": {"op": "F", "exp": reached}}
    initial = {"op": "initial"}
    said = {"op": "filter", "fun": "values", "values": path, "states": initial}
    model["properties"] = [{"name": "asked", "expression": said}]
    return model


def run(command):
    """Its output, and the seconds of processor time that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if said.returncode not in (0, 1, 3) or not said.stdout:
        sys.exit(f"{command}: exit code {said.returncode}\n{said.stderr}")
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return said.stdout, seconds


def scan(program, path, precision):
    command = [program, path, "verify", "asked", "--single-thread", "--json", "-c", str(CONFIDENCE)]
    said, seconds = run([*command, "-p", str(precision)])
    return json.loads(said), seconds


def cotama(program, model, options, asked, steps, runs, seed):
    command = [program, "estimate", model, *options, "--property", asked, "--steps", str(steps)]
    command += ["--runs", str(runs), "--seed", str(seed), "--confidence", str(CONFIDENCE)]
    said, seconds = run([*command, "--jobs", "1", "--json"])
    return json.loads(said), seconds


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--scan", default="scan")
    arguments.add_argument("--cotama", default="target/dist/cotama")
    arguments.add_argument("--repeat", type=int, default=3)
    given = arguments.parse_args()
    os.environ["NO_COLOR"] = "1"
    load = os.getloadavg()[0]
    if load > 0.5:
        print(f"WARNING: other programs run here (load {load:.1f})", file=sys.stderr)
    failed = False
    print("| model | asked | steps | SCAN: share, ± | of runs | ours: share | of runs "
          "| runs a second: SCAN | ours | ratio |")
    print("| --- | --- | ---: | --- | ---: | --- | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        path = str(pathlib.Path(folder) / "asked.jani")
        for model, options, asked, goal, steps, half in CASES:
            exported, _ = run([given.cotama, "export", model, "--format", "jani"])
            text = json.dumps(for_scan(json.loads(exported), goal, steps), ensure_ascii=False)
            pathlib.Path(path).write_text(text)
            ours, theirs = [], []
            for round in range(given.repeat):
                # So coarse that a run or a few are enough: what loading takes.
                few, loading = scan(given.scan, path, 0.99)
                found, whole = scan(given.scan, path, half)
                theirs.append((found["runs"] - few["runs"]) / max(whole - loading, 1e-9))
                runs = found["runs"]
                many = 20 * runs
                _, loading = cotama(given.cotama, model, options, asked, steps, 1, round)
                answer, whole = cotama(given.cotama, model, options, asked, steps, many, round)
                ours.append((many - 1) / max(whole - loading, 1e-9))
            row = answer["results"][0]
            it = row["probability"]
            share = found["rate"]
            slow, fast = statistics.median(theirs), statistics.median(ours)
            overlap = it["low"] <= share + half and share - half <= it["high"]
            # What some run of SCAN showed, and what some run showed here.
            verdicts = (found["successes"] > 0, row["verdict"] == "true")
            wrong = not overlap or verdicts[0] != verdicts[1] or fast < LEAST * slow
            failed |= wrong
            print(f"| {model} | `{asked}` | {steps} | {share:.3f} ± {half} | {runs} "
                  f"| {it['low']:.4f} to {it['high']:.4f} | {answer['runs']} | {slow:.0f} "
                  f"| {fast:.0f} | {fast / slow:.0f}{' WRONG' if wrong else ''} |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
