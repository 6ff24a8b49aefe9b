#!/usr/bin/env python3
"""Exports every shipped model as PNML and as JSON, and lets pm4py count what it reads of the one
against the other.

    read_models.py      needs the program (built in release) and the packages of requirements.txt
"""

import json
import pathlib
import subprocess
import sys
import tempfile

from read_pnml import counts

SIZES = {"philosophers": 5, "token_ring": 4, "kanban": 3, "fms": 3, "swimming_pool": 1}


def cotama(*arguments):
    command = ["cargo", "run", "--quiet", "--release", "-p", "cotama", "--", *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def arcs(net):
    """Pairs of a node and the next one; a place that is read is both before and after."""
    pairs = set()
    for transition in net["transitions"]:
        name = transition["name"]
        for arc in transition["take"] + transition["read"]:
            pairs.add((arc["place"], "->", name))
        for arc in transition["give"] + transition["read"]:
            pairs.add((name, "->", arc["place"]))
    return len(pairs)


def main():
    wrong = models = 0
    with tempfile.TemporaryDirectory() as folder:
        for model in json.loads(cotama("models", "--json"))["models"]:
            name = model["name"]
            if name in SIZES:
                name = f"{name}:{SIZES[name]}"
            if model.get("kind") == "system":
                continue
            net = json.loads(cotama("export", name, "--format", "json"))
            path = pathlib.Path(folder) / (name.replace(":", "_") + ".pnml")
            path.write_text(cotama("export", name, "--format", "pnml"), encoding="utf-8")
            said = {"places": len(net["places"]), "transitions": len(net["transitions"]),
                "arcs": arcs(net)}
            found = counts(path)
            models += 1
            wrong += found != said
            print(f"{name}: {found['places']} places, {found['transitions']} transitions,",
                f"{found['arcs']} arcs:",
                  "same" if found == said else f"DIFFERENT, expected {said}")
    print(f"{models} models, {wrong} wrong")
    return 1 if wrong or not models else 0


if __name__ == "__main__":
    sys.exit(main())
