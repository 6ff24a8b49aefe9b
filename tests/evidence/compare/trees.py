#!/usr/bin/env python3
"""Random behaviour trees, ticked by BehaviorTree.CPP itself and by `cotama conform`.

    trees.py PROGRAM [--trees N] [--runs N] [--seed N]

`behaviortreepy` carries the real library (4.8.2). It ticks random trees of its control nodes,
decorators, scripts and guards, whose leaves answer at random, and what it does is written as
traces; PROGRAM, which is `cotama`, must accept each. Left out is what this package does not show or
have: SKIPPED from a leaf, tickOnce, clocks, the nodes of Nav2; and an `_onHalted` that throws, at
which the library ends the process.
"""

import argparse
import pathlib
import random
import re
import subprocess
import sys
import tempfile

import behaviortreepy as bt

CONTROLS = [
    "Sequence", "Fallback", "AsyncSequence", "AsyncFallback", "SequenceWithMemory",
    "ReactiveSequence", "ReactiveFallback", "Parallel", "ParallelAll", "IfThenElse", "WhileDoElse",
]
DECORATORS = [
    ("Inverter", ""), ("ForceSuccess", ""), ("ForceFailure", ""), ("KeepRunningUntilFailure", ""),
    ("Repeat", ' num_cycles="2"'), ("RetryUntilSuccessful", ' num_attempts="3"'), ("RunOnce", ""),
    ("Precondition", ' if="x == 1" else="SKIPPED"'),
    ("Precondition", ' if="x &lt; 3" else="FAILURE"'),
    ("LoopDouble", ' value="{v}"'), ("LoopDouble", ' value="{x}" if_empty="SKIPPED"'),
]
GUARDS = [
    ' _skipIf="x == 1"', ' _while="x != 2"', ' _failureIf="x == 3"', ' _successIf="x == 4"',
    ' _onSuccess="x = 1"', ' _onFailure="x += 1"', ' _onHalted="x := 2"', ' _post="x += 1"',
]
# A queue on the blackboard. Up to 4.8 a text that is written there again is a new queue, which it is
# not in 4.10, so each is written once.
TEXT = "'2;4;'"
LETTER = {"SUCCESS": "S", "FAILURE": "F", "RUNNING": "R", "SKIPPED": "K", "IDLE": "I"}


class Maker:
    """Makes a tree, and notes its leaves."""

    def __init__(self, draw):
        self.draw = draw
        self.leaves = []
        self.queues = 0

    def node(self, level):
        guard = self.draw.choice(GUARDS) if self.draw.random() < 1 / 5 else ""
        if level == 0 or self.draw.random() < 1 / 4:
            kind = self.draw.choice("AAAAACCSX")
            if kind == "X":
                return f'<Script code="x = x + 1"{guard}/>'
            self.leaves.append(f"{kind}{len(self.leaves) + 1}")
            return f"<{self.leaves[-1]}{guard}/>"
        if self.draw.random() < 1 / 3:
            tag, ports = self.draw.choice(DECORATORS)
            if tag == "LoopDouble":
                self.queues += 1
                ports += f' queue="{{q{self.queues}}}"'
            return f"<{tag}{ports}{guard}>{self.node(level - 1)}</{tag}>"
        tag = self.draw.choice(CONTROLS)
        pair = tag in ("IfThenElse", "WhileDoElse")
        count = self.draw.randint(2, 3) if pair else self.draw.randint(1, 3)
        ports = f' success_count="{self.draw.randint(1, count)}"' if tag == "Parallel" else ""
        inner = "".join(self.node(level - 1) for _ in range(count))
        return f"<{tag}{ports}{guard}>{inner}</{tag}>"

    def tree(self):
        node = self.node(3)
        written = "; ".join(f"q{it} := {TEXT}" for it in range(1, self.queues + 1))
        queues = f'<RunOnce><Script code="{written}"/></RunOnce>' if written else ""
        inner = f'<Script code="x := 0"/>{queues}{node}'
        return (
            '<root BTCPP_format="4"><BehaviorTree ID="Main"><Sequence>'
            f"{inner}</Sequence></BehaviorTree></root>\n"
        )


def factory_of(leaves, draw, events):
    """A factory whose leaves answer at random, and note what they were asked."""
    factory = bt.BehaviorTreeFactory()

    def answer(name, mark, letters):
        letter = draw.choice(letters)
        events.append(f"{name}{mark}{letter}")
        words = {short: long for long, short in LETTER.items()}
        return getattr(bt.NodeStatus, words[letter])

    for leaf in leaves:
        if leaf[0] == "A":
            factory.register_simple_stateful_action(
                leaf,
                lambda *_, it=leaf: answer(it, ":", "SFR"),
                lambda *_, it=leaf: answer(it, "~", "SFR"),
                lambda *_, it=leaf: events.append(f"{it}!"),
            )
        elif leaf[0] == "C":
            factory.register_simple_condition(leaf, lambda *_, it=leaf: answer(it, ":", "SF"))
        else:
            factory.register_simple_action(leaf, lambda *_, it=leaf: answer(it, ":", "SF"))
    return factory


def built(draw):
    """A tree that the library builds: up to 4.9 it refuses several actions below a ReactiveSequence,
    which 4.10 takes."""
    while True:
        maker = Maker(draw)
        text = maker.tree()
        try:
            factory_of(maker.leaves, draw, []).create_tree_from_text(text)
        except RuntimeError as why:
            if "more than one async child" not in str(why):
                raise
        else:
            return text, maker.leaves


def board(tree):
    """The blackboard as a trace has it: numbers, and queues as the text that was written."""
    entries = tree.root_blackboard()

    def value(key):
        try:
            return f"{entries.get_double(key):.15g}"
        except RuntimeError as why:
            unwritten = "hasn't been initialized" in str(why)
            return "?" if unwritten else TEXT if key[0] == "q" else str(why)

    cells = [f"{key}={value(key)}" for key in sorted(entries.get_keys())]
    return ";".join(cells) or "-"


def trace(text, leaves, draw, runs):
    """What the library does in so many runs of up to eight steps."""
    rows = []
    for run in range(1, runs + 1):
        events = []
        tree = factory_of(leaves, draw, events).create_tree_from_text(text)
        for step in range(1, 9):
            events.clear()
            op = "halt" if draw.random() < 1 / 8 else "tick"
            try:
                if op == "halt":
                    tree.halt_tree()
                    status = "H"
                else:
                    status = LETTER[tree.tick_exactly_once().name]
            except Exception:  # the library throws what a script or a node throws
                status = "X"
            shown = " ".join(events) or "-"
            rows.append(f"{run}\t{step}\t{op}\t0\t-\t{shown}\t{status}\t{board(tree)}\n")
            if status == "X":
                break
    return "".join(rows)


UNNAMED = re.compile(r":(\d+), in its status\n *found +X\n *allowed +(X@\S+)\n")


def conforms(program, tree, path):
    """Why the program refuses a trace; nothing where it accepts it. The package does not say which
    node threw, so the name that the program expects is put in."""
    while True:
        said = subprocess.run(
            [program, "conform", tree, path], capture_output=True, text=True, check=False
        )
        if said.returncode == 0:
            return None
        unnamed = UNNAMED.search(said.stdout)
        if not unnamed:
            return said.stdout + said.stderr
        rows = path.read_text().splitlines(keepends=True)
        at = int(unnamed[1]) - 1
        rows[at] = rows[at].replace("\tX\t", f"\t{unnamed[2]}\t")
        path.write_text("".join(rows))


def main():
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("program")
    asked.add_argument("--trees", type=int, default=1000)
    asked.add_argument("--runs", type=int, default=4)
    asked.add_argument("--seed", type=int, default=46)
    asked = asked.parse_args()
    steps, refused, thrown = 0, [], 0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(asked.trees):
            draw = random.Random(f"{asked.seed} {number}")
            text, leaves = built(draw)
            rows = trace(text, leaves, draw, asked.runs)
            steps += rows.count("\n")
            thrown += rows.count("\tX\t")
            tree = pathlib.Path(folder, f"{number}.xml")
            tree.write_text(text)
            path = pathlib.Path(folder, f"{number}.tsv")
            path.write_text(rows)
            why = conforms(asked.program, tree, path)
            if why:
                refused.append((number, text, rows, why))
    for number, text, rows, why in refused[:5]:
        print(f"tree {number}: {text}{rows}{why}", file=sys.stderr)
    print(f"{asked.trees} trees, {steps} steps, {thrown} exceptions: {len(refused)} refused")
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
