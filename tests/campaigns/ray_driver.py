#!/usr/bin/env python3
"""A campaign on a Ray cluster: shards are fanned out, and merged where the driver runs.

    pip install ray
    tests/campaigns/ray_driver.py delivery --runs 100000 --shards 8 --out found [--strategy swarm ...]

Further options go to `cotama campaign` as they are. `cotama` is on the PATH of every node, or
COTAMA names it; DIR of --out is on a file system that all nodes share. A shard whose worker dies is
started again by Ray, and goes on from the last whole block in its folder. `--kill-one` kills a worker
midway, to show that.
"""

import argparse
import ctypes
import os
import pathlib
import subprocess
import sys
import time

import ray

COTAMA = os.environ.get("COTAMA", "cotama")


@ray.remote(max_retries=5)
def shard(mission, options, index, of, folder):
    """Runs one shard; says how often that was begun."""
    attempts = pathlib.Path(f"{folder}.attempts")
    with attempts.open("a") as file:
        file.write(f"{os.getpid()}\n")
    # A worker that is killed takes its program along (Linux), or two would write one folder.
    libc = ctypes.CDLL(None)
    command = [COTAMA, "campaign", mission, *options, "--shard", f"{index}/{of}"]
    done = subprocess.run(
        [*command, "--jobs", "1", "--out", folder],
        capture_output=True,
        text=True,
        preexec_fn=lambda: libc.prctl(1, 9),
    )
    # 1 says that a requirement is broken.
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stderr)
    return len(attempts.read_text().splitlines())


def kill_one(folders):
    """Kills the first worker that has results and is not done."""
    while True:
        for folder in folders:
            attempts = pathlib.Path(f"{folder}.attempts")
            lines = pathlib.Path(folder) / "runs.jsonl"
            if attempts.exists() and lines.exists() and lines.stat().st_size > 0:
                os.kill(int(attempts.read_text().split()[-1]), 9)
                return
        time.sleep(0.02)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mission")
    parser.add_argument("--shards", type=int, default=8)
    parser.add_argument("--out", required=True)
    parser.add_argument("--kill-one", action="store_true")
    known, options = parser.parse_known_args()
    out = pathlib.Path(known.out).resolve()
    parts = out.with_name(out.name + "-shards")
    parts.mkdir(parents=True, exist_ok=True)
    folders = [str(parts / str(index)) for index in range(1, known.shards + 1)]
    ray.init(ignore_reinit_error=True, log_to_driver=False, include_dashboard=False)
    begun = [
        shard.remote(known.mission, options, index, known.shards, folder)
        for index, folder in enumerate(folders, 1)
    ]
    if known.kill_one:
        kill_one(folders)
    attempts = ray.get(begun)
    print(f"{known.shards} shards, begun {sum(attempts)} times", flush=True)
    merge = [COTAMA, "campaign", "merge", *folders, "--out", str(out)]
    sys.exit(subprocess.run(merge).returncode)


if __name__ == "__main__":
    main()
