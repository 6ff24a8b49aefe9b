#!/usr/bin/env python3
"""Team assignment beside OR-Tools CP-SAT, and n x n assignment beside scipy.

    python tests/evidence/compare/teams.py            # draws, solves, compares; some minutes
    python tests/evidence/compare/teams.py --seeds 3 --limit 60

Random crowded teams of 20 to 60 robots, all tasks at once: ours with one setting, CP-SAT with one
worker and linearization_level=2 (with its usual level it does not prove even plain assignments of
30 x 30). Squares of 100 to 2,000: ours in 32 bits, scipy's linear_sum_assignment on the same
tables, each table once, as a processor learns the branches that it has seen. Both in processor time
of one thread, one after the other on the same machine; answers must agree. Exit status 1 when they
do not.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent


def export(folder, *arguments):
    """Runs a program of ours that writes what it solved, and reads what came out."""
    command = ["cargo", "run", "--release", "--quiet", *arguments, "--export", str(folder)]
    subprocess.run(command, cwd=HERE / "assignment", check=True, stdout=subprocess.DEVNULL)
    return [json.loads(line) for line in (folder / "results.jsonl").read_text().splitlines()]


def cp_sat(instance, limit):
    """Status, cost in parts, and processor time of the solve call."""
    from ortools.sat.python import cp_model

    model = cp_model.CpModel()
    parts, robots = instance["cost_denominator"], len(instance["robots"])
    of_robot, objective = [[] for _ in range(robots)], []
    for task in instance["tasks"]:
        ways = []
        if task["skip_cost"] is not None:
            skipped = model.new_bool_var("")
            ways.append(skipped)
            objective.append(skipped * (parts * task["skip_cost"]))
        for plan in task["plans"]:
            used, roles = model.new_bool_var(""), plan["roles"]
            ways.append(used)
            objective.append(used * (parts * plan["extra_cost"]))
            largest = None
            if task["combine"] == "max":
                most = max([c for role in roles for c in role["cost"] if c is not None], default=0)
                largest = model.new_int_var(0, most, "")
                objective.append(largest * parts)
            for role in roles:
                able = [(r, c) for r, c in enumerate(role["cost"]) if c is not None]
                chosen = [(r, c, model.new_bool_var("")) for r, c in able]
                model.add(sum(x for _, _, x in chosen) == used)
                for r, _, x in chosen:
                    of_robot[r].append(x)
                cost = sum(c * x for _, c, x in chosen)
                if largest is not None:
                    model.add(largest >= cost)
                else:
                    weight = parts // len(roles) if task["combine"] == "mean" else parts
                    objective.append(cost * weight)
        model.add_exactly_one(ways)
    for chosen in of_robot:
        model.add_at_most_one(chosen)
    model.minimize(sum(objective))
    solver = cp_model.CpSolver()
    solver.parameters.num_workers = 1
    solver.parameters.linearization_level = 2
    solver.parameters.max_time_in_seconds = limit
    start = time.process_time()
    status = solver.solve(model)
    seconds = time.process_time() - start
    said = {cp_model.OPTIMAL: "optimal", cp_model.INFEASIBLE: "infeasible"}.get(status, "unknown")
    cost = round(solver.objective_value) if said == "optimal" else None
    return said, cost, seconds


def teams(folder, seeds, limit):
    """Ours and CP-SAT on the same teams; whether all answers agree."""
    agree, ratios, slow = True, [], []
    print(f"{'robots-tasks-kind-seed':<24}{'ours, ms':>11}{'CP-SAT, ms':>12}{'ratio':>9}")
    for ours in export(folder, "--bin", "joint", "--", str(seeds)):
        instance = json.loads((folder / f"{ours['name']}.json").read_text())
        status, cost, seconds = cp_sat(instance, limit)
        ratio = seconds / ours["seconds"]
        note = ""
        if "unknown" in (status, ours["status"]):
            note = f"  ours {ours['status']}, CP-SAT {status}"
        elif (status, cost) != (ours["status"], ours["cost"]):
            agree, note = False, f"  DIFFERS: {ours['status']} {ours['cost']}, {status} {cost}"
        if ours["status"] != "unknown":
            ratios.append(ratio)
            if seconds >= 0.1:
                slow.append(ratio)
        print(f"{ours['name']:<24}{ours['seconds'] * 1e3:>11.2f}{seconds * 1e3:>12.1f}"
              f"{ratio:>9.1f}{note}", flush=True)
    least = min(slow, default=float("nan"))
    print(f"\nmedian ratio {statistics.median(ratios):.1f} of {len(ratios)}; "
          f"least where CP-SAT takes 100 ms or more: {least:.1f} (of {len(slow)})\n")
    return agree


def squares(folder):
    """Ours and scipy on the same tables; whether all totals agree."""
    import numpy
    from scipy.optimize import linear_sum_assignment

    agree = True
    print(f"{'n, costs to':<16}{'ours, ms':>11}{'scipy, ms':>12}{'ours/scipy':>12}")
    for ours in export(folder, "--bin", "assignment", "--"):
        n, tables = ours["n"], numpy.fromfile(folder / f"{ours['name']}.bin", dtype="<u4")
        times = []
        for table, total in zip(tables.reshape(-1, n, n), ours["totals"]):
            table = table.astype(numpy.float64)  # as scipy computes
            start = time.thread_time()
            rows, columns = linear_sum_assignment(table)
            times.append(time.thread_time() - start)
            agree &= int(table[rows, columns].sum()) == total
        seconds = statistics.median(times)
        print(f"{n}, {ours['most']:<10}{ours['seconds'] * 1e3:>11.3f}{seconds * 1e3:>12.3f}"
              f"{ours['seconds'] / seconds:>12.2f}", flush=True)
    return agree


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=1, help="teams of each size and kind (1)")
    parser.add_argument("--limit", type=float, default=60, help="seconds for CP-SAT (60)")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        agree = squares(folder / "squares")
        print()
        agree &= teams(folder / "teams", arguments.seeds, arguments.limit)
    if not agree:
        print("answers differ", file=sys.stderr)
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
