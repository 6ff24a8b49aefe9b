#!/usr/bin/env python3
"""A tree as a net through whose nodes a token walks, beside the states of its executor.

    tree_net.py PROGRAM [--actions N]

The tree is a `ParallelAll` of N actions. In its net a token goes from child to child within a tick;
statuses and counters are places, answers of actions are the only choices. PROGRAM, which is
`cotama`, counts the markings of the net and the states of the tree; a plain search here finds as
many markings, and between ticks as many as the tree has states, 3^n - 2^n + 1. Then it asks the net
whether an end can always be reached, and the tree all that is asked by default. Times are of the
whole program on one thread, the least of three.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time


def lines(n):
    """Returns the transitions: name, places taken with weights, places read, places given."""
    yield "tick", {"T": 1}, {}, {"p1": 1}
    for i in range(1, n + 1):
        here, there = f"p{i}", f"p{i + 1}"
        for done in "SF":
            yield f"skip{done}{i}", {here: 1}, {f"{done}{i}": 1}, {there: 1}
        for before in "IR":
            run = {f"R{i}": 1}
            if before == "R":
                yield f"runs{i}", {here: 1}, run, {there: 1}
            else:
                yield f"starts{i}", {here: 1, f"I{i}": 1}, {}, {there: 1, **run}
            taken = {here: 1, f"{before}{i}": 1, "open": 1}
            yield f"{before}S{i}", taken, {}, {there: 1, f"S{i}": 1, "done": 1}
            failed = {there: 1, f"F{i}": 1, "done": 1, "failed": 1}
            yield f"{before}F{i}", {**taken, "well": 1}, {}, failed
    end = f"p{n + 1}"
    yield "again", {end: 1}, {"open": 1}, {"T": 1}
    yield "fails", {end: 1, "done": n}, {"failed": 1}, {"endF": 1}
    yield "succeeds", {end: 1, "done": n}, {"well": n}, {"endS": 1}


def initial(n):
    return {"T": 1, "open": n, "well": n, **{f"I{i}": 1 for i in range(1, n + 1)}}


def net(n):
    """Returns the net as TINA reads it."""
    text = "".join(f"pl {place} ({tokens})\n" for place, tokens in initial(n).items())
    for name, takes, reads, gives in lines(n):
        arcs = [f"{place}*{weight}" for place, weight in takes.items()]
        arcs += [f"{place}?{weight}" for place, weight in reads.items()]
        text += f"tr {name} {' '.join(arcs)} -> {' '.join(f'{p}*{w}' for p, w in gives.items())}\n"
    return text


def markings(n):
    """Counts all markings, and those between ticks, by a plain search."""
    start = frozenset(initial(n).items())
    seen, todo = {start}, [start]
    while todo:
        marking = dict(todo.pop())
        for _, takes, reads, gives in lines(n):
            needs = [*takes.items(), *reads.items()]
            if any(marking.get(place, 0) < weight for place, weight in needs):
                continue
            after = dict(marking)
            for sign, arcs in ((-1, takes), (1, gives)):
                for place, weight in arcs.items():
                    after[place] = after.get(place, 0) + sign * weight
            after = frozenset(it for it in after.items() if it[1])
            if after not in seen:
                seen.add(after)
                todo.append(after)
    return len(seen), sum(("T", 1) in it for it in seen)


def tree(n):
    actions = "".join(f"<A{i}/>" for i in range(1, n + 1))
    inner = f'<ParallelAll max_failures="1">{actions}</ParallelAll>'
    return f'<root BTCPP_format="4"><BehaviorTree ID="T">{inner}</BehaviorTree></root>'


def counted(program, path):
    """Returns what the program counts."""
    ended = subprocess.run([program, "statespace", path, "--json"], capture_output=True, check=True)
    return json.loads(ended.stdout)


def asked(program, *words):
    """Returns how long a check takes, in seconds."""
    times = []
    for _ in range(3):
        start = time.monotonic()
        subprocess.run([program, "check", *words], capture_output=True, check=True)
        times.append(time.monotonic() - start)
    return min(times)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--actions", type=int, default=11)
    given = parser.parse_args()
    differ = 0
    with tempfile.TemporaryDirectory() as folder:
        files = [pathlib.Path(folder, name) for name in ("tree.net", "tree.xml")]
        for n in (2, 3, 4, given.actions):
            files[0].write_text(net(n))
            files[1].write_text(tree(n))
            of_net, of_tree = (counted(given.program, it) for it in files)
            walked = markings(n) if n <= 4 else None
            between = 3**n - 2**n + 1
            all_markings = int(of_net["states"])
            differ += of_tree["states"] != between
            differ += walked is not None and walked != (all_markings, between)
            ends = ["--property", "AG EF (endS + endF >= 1)", "--engine", "explicit"]
            net_s, tree_s = asked(given.program, files[0], *ends), asked(given.program, files[1])
            print(f"{n} actions: {of_tree['states']} states, {of_tree['questions']} questions, "
                  f"all asked in {tree_s:.2f} s; {all_markings} markings, one asked in {net_s:.2f} s")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
