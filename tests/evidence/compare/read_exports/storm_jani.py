#!/usr/bin/env python3
"""Reads the exported JANI models with Storm and compares its verdicts with the token game.

    python3 -m venv venv && venv/bin/pip install stormpy==2.0.0
    venv/bin/python tests/evidence/compare/read_exports/storm_jani.py [FILE.jani ...]

Each `NAME.jani` (those of the golden exports) is read as it is; the verdict on each of its
properties is compared with that on the law of the same place in `NAME.json`, found by a token game
over all markings.

Exit status: 0 when all agree, 1 when one differs or is not read, 77 when Storm is not installed.
"""

import json
import sys
from pathlib import Path

GOLDEN = Path(__file__).resolve().parents[4] / "verification/tests/golden/exports"
MOST = 200_000

try:
    import stormpy
except ImportError:
    print("SKIPPED: Storm is not installed; see the head of this script", file=sys.stderr)
    sys.exit(77)


class Game:
    """All markings of a net, and which lead to which."""

    def __init__(self, net):
        self.index = {place["name"]: i for i, place in enumerate(net["places"])}
        weights = lambda arcs: [(self.index[arc["place"]], arc["weight"]) for arc in arcs]
        parts = ("take", "read", "give")
        moves = [[weights(it[part]) for part in parts] for it in net["transitions"]]
        start = tuple(place["initial"] for place in net["places"])
        self.next, open_ = {}, [start]
        while open_ and len(self.next) < MOST:
            marking = open_.pop()
            if marking in self.next:
                continue
            self.next[marking] = []
            for take, read, give in moves:
                if all(marking[place] >= weight for place, weight in take + read):
                    after = list(marking)
                    for place, weight in take:
                        after[place] -= weight
                    for place, weight in give:
                        after[place] += weight
                    self.next[marking].append(tuple(after))
            open_.extend(self.next[marking])
        self.whole = not open_

    def can(self, holds):
        """The markings from which one that holds is reached."""
        before = {marking: [] for marking in self.next}
        for marking, following in self.next.items():
            for it in following:
                before[it].append(marking)
        found, open_ = set(), [it for it in self.next if holds(it)]
        while open_:
            it = open_.pop()
            if it not in found:
                found.add(it)
                open_.extend(before[it])
        return found

    def law(self, law):
        """Whether a law holds; none for one that is no property."""
        if isinstance(law, str):
            return None
        (kind, of), = law.items()
        tokens = lambda name, marking: marking[self.index[name]]
        if kind == "invariant":
            total = lambda it: sum(arc["weight"] * tokens(arc["place"], it) for arc in of["sum"])
            return all(total(it) == of["equals"] for it in self.next)
        if kind == "never_both":
            return not any(all(tokens(name, it) > 0 for name in of) for it in self.next)
        if kind == "reachable":
            return any(tokens(of, it) > 0 for it in self.next)
        if kind == "always_can":
            return len(self.can(lambda it: tokens(of, it) > 0)) == len(self.next)
        if kind == "deadlock_free":
            ends = lambda it: of["end"] is not None and tokens(of["end"], it) > 0
            return all(following or ends(it) for it, following in self.next.items())
        raise ValueError(kind)


def main():
    files = [Path(it) for it in sys.argv[1:]] or sorted(GOLDEN.glob("*.jani"))
    wrong = not files
    for path in files:
        game = Game(json.loads(path.with_suffix(".json").read_text()))
        laws = json.loads(path.with_suffix(".json").read_text())["laws"]
        expected = [it for it in map(game.law, laws) if it is not None]
        model, properties = stormpy.parse_jani_model(str(path))
        read = f"{len(properties)} of {len(expected)} properties"
        said = [f"{path.name}: {model.model_type.name}, {read}"]
        wrong |= len(properties) != len(expected)
        if not game.whole:
            print(said[0] + ": too many markings to compare")
            continue
        for of, right in zip(properties, expected):
            built = stormpy.build_model(model, [of])
            found = stormpy.model_checking(built, of, only_initial_states=True)
            found = found.get_truth_values_vector().get(built.initial_states[0])
            wrong |= found != right
            verdict = "agree" if found == right else f"DIFFER, the token game: {right}"
            said.append(f"  {of.get_name()}: {found} on {built.nr_states} states: {verdict}")
        print("\n".join(said))
    sys.exit(1 if wrong else 0)


main()
