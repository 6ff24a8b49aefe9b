#!/usr/bin/env python3
"""Behaviour trees written as JANI, read and explored by Momba.

    read_jani.py PROGRAM [--trees N] [--seed N]

PROGRAM, which is `cotama`, writes random trees as JANI, and Momba's own engine counts the states and
transitions that it can reach: as many as `cotama statespace` has states, questions, ends and edges.
A tree is left out where its graph is too large for JANI.
"""

import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

from momba import engine, jani

CONTROLS = ["Sequence", "Fallback", "ReactiveSequence", "ReactiveFallback", "PipelineSequence",
            "Parallel", "RoundRobin", "SequenceWithMemory", "RecoveryNode"]
DECORATORS = ["Inverter", "KeepRunningUntilFailure", 'RetryUntilSuccessful num_attempts="2"',
              "RateController", 'Timeout msec="9"', 'TryCatch catch_on_halt="true"']


def node(draw, level):
    if level == 0 or draw.random() < 1 / 4:
        return f"<{draw.choice('AAACSL')}{draw.randint(1, 99)}/>"
    if draw.random() < 1 / 3:
        ports = draw.choice(DECORATORS)
        tag = ports.split()[0]
        count = 2 if tag == "TryCatch" else 1
    else:
        ports = tag = draw.choice(CONTROLS)
        count = 2
    return f"<{ports}>{''.join(node(draw, level - 1) for _ in range(count))}</{tag}>"


def cotama(*arguments):
    return subprocess.run(arguments, capture_output=True, text=True, check=False)


def main():
    asked = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    asked.add_argument("program")
    asked.add_argument("--trees", type=int, default=60)
    asked.add_argument("--seed", type=int, default=46)
    asked = asked.parse_args()
    read = large = wrong = most = 0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(asked.trees):
            inner = node(random.Random(f"{asked.seed} {number}"), 5)
            tree, file = pathlib.Path(folder, "tree.xml"), pathlib.Path(folder, "tree.jani")
            tree.write_text('<root BTCPP_format="4"><BehaviorTree ID="Main">'
                            f"{inner}</BehaviorTree></root>\n")
            line = [asked.program, "export", tree, "--format", "jani", "--output", file]
            written = cotama(*line)
            if written.returncode:
                assert "states and questions" in written.stderr, (inner, written.stderr)
                large += 1
                continue
            space = json.loads(cotama(asked.program, "statespace", tree, "--json").stdout)
            points = space["states"] + space["questions"] + len(space["ends"])
            explorer = engine.Explorer.new_discrete_time(jani.load_model(file.read_text()))
            found = (explorer.count_states(), explorer.count_transitions())
            read += 1
            most = max(most, found[0])
            if found != (points, space["edges"]):
                wrong += 1
                print(f"{inner}: {found}, not {points, space['edges']}", file=sys.stderr)
    print(f"{read} trees read, of up to {most} states, {large} too large: {wrong} differ")
    return 1 if wrong or not read else 0


if __name__ == "__main__":
    sys.exit(main())
