#!/usr/bin/env python3
"""Sets our localisation beside `amcl`, which is the code of Nav2's AMCL with a binding to Python, on
the same recorded rounds: map, odometry, scans, moments of update, start and parameters are the same.

    localisation.py [--seeds N] [--record PROGRAM]

The office, and with COTAMA_MAPS_DIR the three public maps. `amcl` has the beam model alone. Prints
the errors of the position at the updates, median and 95 %, and the median time of an update (of
`amcl` through its binding). Exit status 1 when our beam model is less exact on a floor than theirs by
more than a tenth, 77 when the package is missing and nothing is shown.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

try:
    import amcl
except ImportError as missing:
    print(f"SKIPPED, NOTHING IS SHOWN: {missing}; pip install -r requirements.txt", file=sys.stderr)
    sys.exit(77)

# Points that a robot goes over, in metres, connected for a disc of 0.3 m.
ROUNDS = {
    "willow_full_10cm": ["18.85,28.55", "17.55,14.45", "9.25,15.65", "43.65,47.55"],
    "nav2_depot_5cm": ["3.39,-0.05", "17.94,-6.3", "12.04,1.3", "21.44,-6.0", "-2.51,-0.1"],
    "turtlebot3_world_5cm": ["-1.98,-0.02", "0.58,-1.78", "-1.98,-0.02"],
}


def quantile(values, part):
    return sorted(values)[round((len(values) - 1) * part)]


def off(a, b):
    return math.hypot(a[0] - b[0], a[1] - b[1])


def theirs(header, moments):
    """Errors and times of `amcl`."""
    filter = amcl.AMCL(min_particles=500, max_particles=2000, alpha_slow=0.0, alpha_fast=0.0,
        motion_params=amcl.MotionParameters(0.2, 0.2, 0.2, 0.2, 0.2),
        laser_params=amcl.LaserParameters(z_hit=0.5, z_short=0.05, z_max=0.05, z_rand=0.5,
            sigma_hit=0.2, lambda_short=0.1, chi_outlier=0.0, max_beams=60),
        robot_model_type="differential")
    width, cells = header["width"], header["cells"]
    rows = [cells[at:at + width] for at in range(0, len(cells), width)]
    filter.set_map(amcl.create_occupancy_grid_from_list(rows, header["resolution"],
        *header["origin"]))
    spread = amcl.Matrix3D()
    for at, variance in enumerate(header["spread"]):
        spread.set(at, at, variance)
    filter.set_initial_pose(amcl.Vector3D(*moments[0]["truth"]), spread)
    filter.set_laser_pose(amcl.Vector3D(0.0, 0.0, 0.0))
    rays = header["rays"]
    angles = [-math.pi / 2 + math.pi * it / (rays - 1) for it in range(rays)]
    errors, times = [], []
    for moment in moments:
        beams = [[range, angle] for range, angle in zip(moment["ranges"], angles)]
        scan = amcl.create_laser_scan_from_list(beams, header["range"])
        start = time.process_time()
        filter.update(scan, amcl.Vector3D(*moment["odometry"]))
        times.append((time.process_time() - start) * 1e3)
        found = filter.get_pose_mean()
        errors.append(off((found.x, found.y), moment["truth"]))
    return errors, times


def main():
    asked = argparse.ArgumentParser()
    asked.add_argument("--seeds", type=int, default=3)
    asked.add_argument("--record")
    asked = asked.parse_args()
    built = ["cargo", "run", "--quiet", "--release", "-p", "cotama-localisation", "--example",
        "record_localisation", "--"]
    program = [asked.record] if asked.record else built
    maps = os.environ.get("COTAMA_MAPS_DIR")
    if not maps:
        print("COTAMA_MAPS_DIR names no folder: the office alone", file=sys.stderr)
    floors = {"office": []}
    for name, points in ROUNDS.items() if maps else ():
        floors[name] = [pathlib.Path(maps) / f"{name}.yaml", *points]
    worse = 0
    models = ["beam", "likelihood_field", "likelihood_field_prob"]
    print("each: median, 95 %, time of an update")
    for name, way in floors.items():
        ours, other = {it: [[], []] for it in models}, [[], []]
        with tempfile.TemporaryDirectory() as folder:
            for seed in range(asked.seeds):
                log = pathlib.Path(folder) / "log"
                subprocess.run([*program, log, str(seed), *way], check=True)
                header, *moments = [json.loads(it) for it in log.read_text("utf-8").splitlines()]
                for model, it in ours.items():
                    it[0] += [off(at["found"][model]["pose"], at["truth"]) for at in moments]
                    it[1] += [at["found"][model]["ms"] for at in moments]
                found = theirs(header, moments)
                other[0] += found[0]
                other[1] += found[1]
        shown = {}
        for who, it in [("amcl, beam", other), *ours.items()]:
            shown[who] = [quantile(it[0], 0.5), quantile(it[0], 0.95), quantile(it[1], 0.5)]
            texts = "{:.3f} m, {:.3f} m, {:7.3f} ms".format(*shown[who])
            print(f"{name:20} {len(it[0]):5} updates  {who:21} {texts}")
        pairs = zip(shown["beam"][:2], shown["amcl, beam"][:2])
        worse += any(ours > 1.1 * other for ours, other in pairs)
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
