#!/usr/bin/env python3
"""Reads the exported JANI models with Momba and compares their state spaces with the token game.

    python3 -m venv venv && venv/bin/pip install momba==0.6.12
    venv/bin/python tests/evidence/compare/read_exports/momba_jani.py [DEPTH]

For each `NAME.jani` of the golden exports, the states that Momba reaches in at most DEPTH steps
(12) and the number of edges out of them are compared with those of a token game on `NAME.json`.

Exit status: 0 when all agree, 1 when one differs, 77 when Momba is not installed.
"""

import json
import sys
import warnings
from pathlib import Path

GOLDEN = Path(__file__).resolve().parents[4] / "verification/tests/golden/exports"

try:
    from momba import engine, jani
except ImportError:
    print("SKIPPED: Momba is not installed; see the head of this script", file=sys.stderr)
    sys.exit(77)


def reach(start, step, depth):
    """States and edges in at most `depth` steps by `step(state) -> {key: state, ...}, number`."""
    found, layer, edges = dict(start), dict(start), 0
    for _ in range(depth):
        fresh = {}
        for state in layer.values():
            following, count = step(state)
            edges += count
            fresh.update((key, it) for key, it in following if key not in found)
        found.update(fresh)
        layer = fresh
    return set(found), edges


def by_momba(model, depth):
    names = [variable["name"] for variable in model["variables"]]
    explorer = engine.Explorer.new_discrete_time(jani.load_model(json.dumps(model)))

    def key(state):
        return tuple(state.global_env[name].as_int for name in names)

    def step(state):
        targets = [target.state for it in state.transitions for target in it.destinations.support]
        return [(key(it), it) for it in targets], len(targets)

    return reach([(key(it), it) for it in explorer.initial_states], step, depth)


def by_tokens(net, depth):
    index = {place["name"]: i for i, place in enumerate(net["places"])}

    def weights(arcs):
        return [(index[arc["place"]], arc["weight"]) for arc in arcs]

    moves = [[weights(it[part]) for part in ("take", "read", "give")] for it in net["transitions"]]

    def step(marking):
        following = []
        for take, read, give in moves:
            if all(marking[place] >= weight for place, weight in take + read):
                after = list(marking)
                for place, weight in take:
                    after[place] -= weight
                for place, weight in give:
                    after[place] += weight
                following.append((tuple(after), tuple(after)))
        return following, len(following)

    start = tuple(place["initial"] for place in net["places"])
    return reach([(start, start)], step, depth)


def main():
    warnings.simplefilter("ignore")  # that Momba drops comments
    depth = int(sys.argv[1]) if len(sys.argv) > 1 else 12
    differs = False
    models = sorted(GOLDEN.glob("*.jani"))
    for path in models:
        theirs = by_momba(json.loads(path.read_text()), depth)
        ours = by_tokens(json.loads(path.with_suffix(".json").read_text()), depth)
        differs |= theirs != ours
        differ = f"DIFFER, the token game: {len(ours[0])}, {ours[1]}"
        verdict = "agree" if theirs == ours else differ
        size = f"{len(theirs[0])} states, {theirs[1]} edges"
        print(f"{path.name}: {size} in {depth} steps: {verdict}")
    sys.exit(1 if differs or not models else 0)


main()
