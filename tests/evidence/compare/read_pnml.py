#!/usr/bin/env python3
"""Reads PNML files with pm4py and compares the numbers of places, transitions and arcs.

    read_pnml.py FACTS.tsv FILE.pnml...

FACTS.tsv has the columns model, places, transitions and arcs; a model is the name of a file without
`.pnml`.
Exits with 1 when a number differs, a file cannot be read or has no facts.
"""

import csv
import pathlib
import sys

from pm4py.objects.petri_net.importer import importer


def counts(path):
    net, _, _ = importer.apply(str(path))
    return {"places": len(net.places), "transitions": len(net.transitions), "arcs": len(net.arcs)}


def main(facts, *files):
    with open(facts, newline="", encoding="utf-8") as table:
        expected = {row["model"]: row for row in csv.DictReader(table, delimiter="\t")}
    wrong = 0
    for path in map(pathlib.Path, files):
        try:
            found = counts(path)
            said = {key: int(expected[path.stem][key]) for key in found}
        except Exception as error:  # pm4py raises what its parts raise
            print(f"{path.name}: {type(error).__name__}: {error}")
            wrong += 1
            continue
        wrong += found != said
        verdict = "same" if found == said else f"DIFFERENT, expected {said}"
        print(f"{path.name}: {found['places']} places, {found['transitions']} transitions,",
            f"{found['arcs']} arcs: {verdict}")
    print(f"{len(files)} files, {wrong} wrong")
    return 1 if wrong or not files else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
