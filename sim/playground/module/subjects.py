"""The models whose pages are checked."""

import json
import subprocess


def subjects(program):
    """The name of each model, the least of each family, each robot and its missions."""
    said = lambda *words: json.loads(subprocess.check_output([program, *words, "--json"]))
    for model in said("models")["models"]:
        numbers = model.get("numbers")
        yield f"{model['name']}:{max(2, numbers['least'])}" if numbers else model["name"]
    listed = said("list")
    yield from (it["name"] for kind in ("robots", "missions", "scenarios") for it in listed[kind])
