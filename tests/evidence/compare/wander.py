#!/usr/bin/env python3
"""Lets a robot wander over the office in IR-SIM, and sets its speed beside that of the benchmark of
our devices: the same walls, 180 laser rays up to 5.6 m at 10 Hz, the same rule of wandering, one
core.

    wander.py [--floor FILE] [--seconds N] [--ours COMMAND]

Both are measured in time on the processor. Exit status 77 when a package is missing and nothing is
shown.
"""

import argparse
import math
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time
import tomllib

try:
    import irsim
    import numpy
    import yaml
except ImportError as missing:
    print(f"SKIPPED, NOTHING IS SHOWN: {missing}; pip install -r requirements.txt", file=sys.stderr)
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[3]
STEP_S = 0.1
RAYS = 180


def world(floor):
    """Returns the floor's opaque things as obstacles of IR-SIM; its doors stand open."""
    metres = lambda points: [[x / 1000, y / 1000] for x, y in points]
    shapes = []
    for wall in floor["wall"]:
        points = metres(wall["points_mm"])
        points += points[:1] if wall.get("closed") else []
        shapes.append({"name": "linestring", "vertices": points})
    for thing in floor.get("furniture", []):
        if "outline_mm" in thing:
            shapes.append({"name": "polygon", "vertices": metres(thing["outline_mm"])})
        else:
            centre, radius = metres([thing["centre_mm"]])[0], thing["radius_mm"] / 1000
            shapes.append({"name": "circle", "center": centre, "radius": radius})
    width, height = (it / 1000 for it in floor["size_mm"])
    laser = {"name": "lidar2d", "range_min": 0.02, "range_max": 5.6, "angle_range": math.pi,
        "number": RAYS, "noise": False}
    robot = {"kinematics": {"name": "diff"}, "shape": {"name": "circle", "radius": 0.25},
        "state": [12, 10, 0.3], "vel_max": [1, 2], "sensors": [laser]}
    obstacles = [{"shape": it, "static": True} for it in shapes]
    return {"world": {"width": width, "height": height, "step_time": STEP_S, "sample_time": STEP_S,
        "control_mode": "auto", "collision_mode": "unobstructed"}, "robot": [robot],
        "obstacle": obstacles}, len(shapes)


def wandering(env, seconds):
    """Returns the seconds on the processor: right, ahead and left decide, as in our benchmark."""
    action, third = [0.0, 0.0], RAYS // 3
    start = time.process_time()
    for _ in range(round(seconds / STEP_S)):
        env.step(numpy.array(action).reshape(2, 1))
        ranges = env.get_lidar_scan()["ranges"]
        right, ahead, left = (min(ranges[at * third:(at + 1) * third]) for at in range(3))
        side = 1.0 if left >= right else -1.0
        action = [0.0, side] if ahead < 0.6 else [0.3, 0.2 * side]
    return time.process_time() - start


def main():
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--floor", default=ROOT / "sim/floor/floors/office.toml", type=pathlib.Path)
    asked.add_argument("--seconds", default=60, type=int)
    asked.add_argument("--ours", default="cargo bench -q -p cotama-devices --bench devices laser")
    asked = asked.parse_args()
    described, count = world(tomllib.loads(asked.floor.read_text()))
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "office.yaml"
        path.write_text(yaml.safe_dump(described))
        env = irsim.make(str(path), display=False, log_level="ERROR")
        used = wandering(env, asked.seconds)
    theirs = asked.seconds / used
    printed = subprocess.run(shlex.split(asked.ours), cwd=ROOT, check=True, text=True,
        stdout=subprocess.PIPE, env=os.environ).stdout
    ours = float(re.search(r"laser +(\d+) x real time on the processor", printed)[1])
    print(f"{count} walls and things, {RAYS} rays, {asked.seconds} s of simulated time in IR-SIM")
    print(f"IR-SIM {irsim.__version__}: {theirs:.0f} x real time; ours: {ours:.0f} x; "
        f"ratio {ours / theirs:.0f}")


main()
