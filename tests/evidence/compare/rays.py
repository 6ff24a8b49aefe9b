#!/usr/bin/env python3
"""Casts rays of 8 m on the public maps with raycast2D and, where it is installed, with the march of
range_libc, and sets their rates beside those of our benchmark: scans of 360 rays from free places.

    rays.py [--seconds N] [--ours COMMAND]

COTAMA_MAPS_DIR is the folder of the maps. All rates are of one core, in time on the processor.
raycast2D walks from cell to cell and answers with cells, range_libc marches over distances, as ours
does. Shares of hits and mean ranges show that the same was asked: exit status 1 when they differ by
more than 6 points or a tenth. Places are drawn for each program by itself, and Bresenham's lines of
raycast2D pass between cells that touch at a corner. 77 when a package or the maps are missing.
"""

import argparse
import math
import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

try:
    import numpy
    import raycast2D
except ImportError as missing:
    print(f"SKIPPED, NOTHING IS SHOWN: {missing}; pip install -r requirements.txt", file=sys.stderr)
    sys.exit(77)
try:
    import range_libc
except ImportError:
    range_libc = None
    print("range_libc is not installed: it is built from github.com/kctess5/range_libc")
FOLDER = os.environ.get("COTAMA_MAPS_DIR")
if not FOLDER:
    print("SKIPPED, NOTHING IS SHOWN: COTAMA_MAPS_DIR names no folder of maps", file=sys.stderr)
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[3]
MAPS = {"willow_full_10cm": 0.1, "nav2_depot_5cm": 0.05, "turtlebot3_world_5cm": 0.05}
RANGE_M, RAYS, BATCH = 8.0, 360, 200


def grey_levels(path):
    """Returns the grey levels of a binary PGM file of one byte a cell."""
    data = path.read_bytes()
    header = re.match(rb"P5\s(?:#.*\n)*\s*(\d+)\s+(\d+)\s+(?:#.*\n)*255\s", data)
    width, height = int(header[1]), int(header[2])
    return numpy.frombuffer(data, numpy.uint8, width * height, header.end()).reshape(height, width)


def occupied_and_free(name):
    """Returns which cells stop rays, as a square with a frame as wide as a ray is long, and the free
    cells with 0.1 m around them that are free too."""
    grey = grey_levels(pathlib.Path(FOLDER) / f"{name}.pgm")
    shade = (255.0 - grey) / 255.0
    frame = round(RANGE_M / MAPS[name]) + 1
    side = max(grey.shape) + 2 * frame
    square = numpy.zeros((side, side), bool)
    free = numpy.zeros((side, side), bool)
    inside = (slice(frame, frame + grey.shape[0]), slice(frame, frame + grey.shape[1]))
    square[inside] = shade > 0.65
    free[inside] = shade < 0.196
    near = math.ceil(0.1 / MAPS[name])
    shifts = [(x, y) for x in range(-near, near + 1) for y in range(-near, near + 1)]
    clear = numpy.logical_and.reduce([numpy.roll(free, it, (0, 1)) for it in shifts])
    return square, numpy.argwhere(clear)


def with_raycast2d(square, places, cells):
    """Returns a function from places to rays that hit and the sum of their ranges in cells."""
    lidar = raycast2D.Lidar2D(num_rays=RAYS, FOV=360, ray_length=cells,
        occupancy_grid=numpy.where(square, 0, 255).astype(numpy.uint8))
    def cast(drawn):
        return [(place, lidar.scan((int(place[1]), int(place[0]), 0.0))) for place in drawn]
    def told(scans):
        ranges = [numpy.hypot(at[:, 0].astype(float) - place[1], at[:, 1].astype(float) - place[0])
            for place, at in scans]
        return sum(map(len, ranges)), sum(it.sum() for it in ranges)
    return cast, told


def with_range_libc(square, places, cells):
    march = range_libc.PyRayMarching(range_libc.PyOMap(square), float(cells))
    angles = numpy.linspace(0, math.tau, RAYS, endpoint=False, dtype=numpy.float32)
    def cast(drawn):
        asked = numpy.zeros((len(drawn) * RAYS, 3), numpy.float32)
        asked[:, :2] = numpy.repeat(drawn[:, ::-1] + 0.5, RAYS, axis=0)
        asked[:, 2] = numpy.tile(angles, len(drawn))
        out = numpy.zeros(len(asked), numpy.float32)
        march.calc_range_many(asked, out)
        return out
    def told(out):
        hits = out[out < cells]
        return len(hits), float(hits.sum())
    return cast, told


def measured(make, name, seconds):
    """Returns million rays a second on the processor, the share of hits, the mean range in metres."""
    square, places = occupied_and_free(name)
    cells = round(RANGE_M / MAPS[name])
    cast, told = make(square, places, cells)
    random = numpy.random.default_rng(1)
    used = rays = hits = total = 0
    while used < seconds:
        drawn = places[random.integers(len(places), size=BATCH)]
        start = time.process_time()
        answer = cast(drawn)
        used += time.process_time() - start
        some, ranges = told(answer)
        rays, hits, total = rays + BATCH * RAYS, hits + some, total + ranges
    return rays / used / 1e6, hits / rays, total / hits * MAPS[name]


def main():
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--seconds", default=2.0, type=float)
    asked.add_argument("--ours", default="cargo bench -q -p cotama-floor --bench rays")
    asked = asked.parse_args()
    printed = subprocess.run(shlex.split(asked.ours), cwd=ROOT, check=True, text=True,
        stdout=subprocess.PIPE, env=os.environ).stdout
    others = {"raycast2D": with_raycast2d}
    if range_libc:
        others["range_libc"] = with_range_libc
    wrong = 0
    print(f"{'map':22} {'program':10} {'M rays/s':>9} {'hit':>6} {'mean':>7} {'ours over it':>13}")
    for name in MAPS:
        row = rf"{name} +scans +([\d.]+) M rays/s on the processor.*\((\d+) % hit, ([\d.]+) m"
        rate, share, mean = map(float, re.search(row, printed).groups())
        print(f"{name:22} {'ours':10} {rate:9.1f} {share:4.0f} % {mean:5.2f} m")
        for program, make in others.items():
            its_rate, its_share, its_mean = measured(make, name, asked.seconds)
            differs = abs(100 * its_share - share) > 6 or abs(its_mean / mean - 1) > 0.1
            wrong += differs
            print(f"{'':22} {program:10} {its_rate:9.1f} {100 * its_share:4.0f} % {its_mean:5.2f} m "
                f"{rate / its_rate:13.1f}{'  DIFFERS' if differs else ''}")
    sys.exit(1 if wrong else 0)


main()
