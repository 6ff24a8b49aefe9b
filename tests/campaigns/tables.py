#!/usr/bin/env python3
"""Reads the results of a campaign with DuckDB and Polars: `runs.parquet` says what `runs.jsonl`
says, and merged shards have the same bytes as one run.

    pip install duckdb polars
    cargo build --release -p cotama --features parquet
    tests/campaigns/tables.py target/release/cotama
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import duckdb
import polars


def campaign(*words):
    command = [sys.argv[1], "campaign", *words, "--json"]
    said = subprocess.run(command, capture_output=True, text=True)
    if said.returncode not in (0, 1):
        sys.exit(said.stderr)


def main():
    with tempfile.TemporaryDirectory() as folder:
        whole, parts, merged = (pathlib.Path(folder) / it for it in ("whole", "part", "merged"))
        what = ["delivery", "--runs", "70000", "--strategy", "swarm", "--shrink", "0"]
        what += ["--require", "in-time", "--require", "AG (gs.Security -> AF<=500ms gs.Safe)"]
        campaign(*what, "--out", str(whole))
        shards = [f"{parts}{it}" for it in (1, 2, 3)]
        for number, shard in enumerate(shards, 1):
            campaign(*what, "--shard", f"{number}/3", "--out", shard)
        campaign("merge", *shards, "--out", str(merged), "--shrink", "0")
        table = whole / "runs.parquet"
        assert table.read_bytes() == (merged / "runs.parquet").read_bytes(), "merged, it differs"

        lines = [json.loads(it) for it in (whole / "runs.jsonl").read_text().splitlines()]
        kept = ["run", "time_ms", "energy_mj", "x_mm", "requests", "replans", "exposed_ms",
                "outcome", "faults", "violated", "plan", "witness"]
        lines = [tuple(it.get(key) for key in kept) for it in lines]
        assert polars.read_parquet(table).rows() == lines, "Polars reads something else"
        rows = duckdb.read_parquet(str(table)).fetchall()
        assert rows == lines, "DuckDB reads something else"
        broken = sum(bool(it[9]) for it in lines)
        plans, witnesses = (sum(it[at] is not None for it in lines) for at in (10, 11))
        assert 0 < witnesses <= broken == plans
        print(f"{len(lines)} runs, {broken} of them broken: the same in JSON lines and Parquet")


if __name__ == "__main__":
    main()
