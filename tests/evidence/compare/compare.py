#!/usr/bin/env python3
"""Time OR-Tools CP-SAT and HiGHS on the instances of the allocation benchmark.

    cargo bench -p cotama-tests --bench allocation -- --export DIR
    python tests/evidence/compare/compare.py DIR

One instance is an allocation problem: one candidate per activity, the sums of
durations and energies within two limits, the largest sum of quality. See
README.md next to this file for what is measured and how to read the table.

Exit status: 0 when every answer agrees, 1 when a plan breaks its limits or two
proven answers differ, 2 when the input cannot be read.
"""

import argparse
import itertools
import json
import math
import multiprocessing
import os
import platform
import random
import statistics
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

SCHEMA_IN = "cotama/bench-allocation/1"
SCHEMA_OUT = "cotama/bench-compare/1"
SHORT = 0.1  # seconds; a run shorter than this is repeated
OPTIMAL, FEASIBLE, INFEASIBLE = "optimal", "feasible", "infeasible"
UNKNOWN, INVALID = "unknown", "invalid"
PROVEN = (OPTIMAL, INFEASIBLE)
OURS = "cotama"


class InputError(Exception):
    pass


# ---------------------------------------------------------------- problem


@dataclass
class Instance:
    name: str
    kind: str
    duration: int
    energy: int
    activities: list
    ours: dict | None = None


@dataclass
class Answer:
    status: str
    seconds: float
    cpu_seconds: float = 0.0
    quality: int | None = None
    bound: int | None = None
    runs: int = 1
    limit: float | None = None
    plan: list | None = None
    note: str | None = None

    def gap(self):
        if self.status == OPTIMAL:
            return 0.0
        if self.quality is None or self.bound is None:
            return None
        return (self.bound - self.quality) / max(1, abs(self.quality))


def instance_from(data, name, kind, ours=None):
    try:
        limits = data["limits"]
        activities = [[tuple(c) for c in options] for options in data["activities"]]
        numbers = [limits["duration_ms"], limits["energy_mj"]]
    except (KeyError, TypeError) as error:
        raise InputError(f"{name}: not an allocation instance ({error!r})") from error
    for options in activities:
        for candidate in options:
            if len(candidate) != 3:
                raise InputError(f"{name}: a candidate is [quality, duration_ms, energy_mj], "
                    f"not {candidate}")
            numbers.extend(candidate)
    if any(type(n) is not int for n in numbers):
        raise InputError(f"{name}: every number must be an integer")
    return Instance(name, kind, numbers[0], numbers[1], activities, ours)


def check_ours(entry):
    name = entry.get("name")
    if entry.get("status") not in (OPTIMAL, FEASIBLE, INFEASIBLE):
        raise InputError(f"{name}: unexpected status {entry.get('status')!r}")
    if not isinstance(entry.get("seconds"), (int, float)) or not entry["seconds"] >= 0:
        raise InputError(f"{name}: unexpected seconds {entry.get('seconds')!r}")
    if entry["status"] != INFEASIBLE and type(entry.get("quality")) is not int:
        raise InputError(f"{name}: unexpected quality {entry.get('quality')!r}")
    return entry


def read_json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: {error}") from error


def load(path):
    """A folder with results.json (or instances alone), or JSON lines of entries with instances."""
    path = Path(path)
    if path.is_dir():
        results = path / "results.json"
        if not results.exists():
            files = sorted(path.glob("*.json"))
            return [instance_from(read_json(f), f.stem, f.stem.rsplit("-", 1)[0]) for f in files]
        data = read_json(results)
        if data.get("schema") != SCHEMA_IN:
            raise InputError(f"{results}: schema {data.get('schema')!r}, expected {SCHEMA_IN!r}")
        return [
            instance_from(read_json(path / f"{e['name']}.json"), e["name"], e["kind"],
                check_ours(e))
            for e in data["instances"]
        ]
    instances = []
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
        entries = [json.loads(line) for line in lines if line.strip()]
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: {error}") from error
    for number, entry in enumerate(entries, 1):
        name = entry.get("name", f"line-{number}")
        ours = check_ours(entry) if "status" in entry else None
        instances.append(instance_from(entry, name, entry.get("kind", name), ours))
    return instances


def verify(instance, plan):
    """The quality of a plan, and what is wrong with it (None when nothing is)."""
    if len(plan) != len(instance.activities):
        return None, f"{len(plan)} choices for {len(instance.activities)} activities"
    quality = duration = energy = 0
    for activity, (choice, options) in enumerate(zip(plan, instance.activities)):
        if type(choice) is not int or not 0 <= choice < len(options):
            return None, f"activity {activity} has no single candidate ({choice})"
        q, d, e = options[choice]
        quality, duration, energy = quality + q, duration + d, energy + e
    if duration > instance.duration:
        return quality, f"duration {duration} over the limit {instance.duration}"
    if energy > instance.energy:
        return quality, f"energy {energy} over the limit {instance.energy}"
    return quality, None


def picked(instance, values):
    """The one candidate of each activity whose variable is set; -1 where there is not just one."""
    plan, start = [], 0
    for options in instance.activities:
        chosen = [k for k in range(len(options)) if values[start + k] > 0.5]
        plan.append(chosen[0] if len(chosen) == 1 else -1)
        start += len(options)
    return plan


# ---------------------------------------------------------------- solvers
#
# Each solver lives in a process of its own: the OR-Tools package carries another
# version of the HiGHS library under the same name, and one process can load only one.


class CpSat:
    name = "CP-SAT"

    def __init__(self, options):
        global cp_model
        import ortools
        from ortools.sat.python import cp_model

        self.options = options
        self.version = f"OR-Tools {ortools.__version__}"

    def model(self, instance):
        model = cp_model.CpModel()
        variables, columns = [], ([], [], [])
        for activity in instance.activities:
            group = [model.new_bool_var("") for _ in activity]
            model.add_exactly_one(group)
            variables += group
            for candidate in activity:
                for column, value in zip(columns, candidate):
                    column.append(value)
        total = cp_model.LinearExpr.weighted_sum
        model.add(total(variables, columns[1]) <= instance.duration)
        model.add(total(variables, columns[2]) <= instance.energy)
        model.maximize(total(variables, columns[0]))
        return model, variables

    def solve(self, instance, limit):
        model, variables = self.model(instance)
        solver = cp_model.CpSolver()
        solver.parameters.num_search_workers = 1
        solver.parameters.max_time_in_seconds = limit
        for key, value in self.options:
            if not hasattr(solver.parameters, key):
                raise InputError(f"CP-SAT has no parameter {key!r}")
            setattr(solver.parameters, key, value)
        cpu = time.process_time()
        status = solver.solve(model)
        cpu = time.process_time() - cpu
        # The solver's own clock: it leaves out the crossing from Python, in its favour.
        seconds = solver.wall_time
        if status == cp_model.INFEASIBLE:
            return Answer(INFEASIBLE, seconds, cpu)
        if status not in (cp_model.OPTIMAL, cp_model.FEASIBLE):
            # Stopped this early, CP-SAT gives 0 for a bound that it does not have.
            return Answer(UNKNOWN, seconds, cpu, None, None)
        plan = picked(instance, [solver.value(v) for v in variables])
        return Answer(
            OPTIMAL if status == cp_model.OPTIMAL else FEASIBLE,
            seconds,
            cpu,
            round(solver.objective_value),
            whole(solver.best_objective_bound),
            plan=plan,
        )


class Highs:
    name = "HiGHS"

    def __init__(self, options):
        global highspy, np
        import highspy
        import numpy as np

        self.options = options
        self.version = highspy.Highs().version()

    def model(self, instance):
        candidates = [c for options in instance.activities for c in options]
        groups = len(instance.activities)
        lp = highspy.HighsLp()
        lp.num_col_ = len(candidates)
        lp.num_row_ = groups + 2
        lp.sense_ = highspy.ObjSense.kMaximize
        lp.col_cost_ = np.array([c[0] for c in candidates], dtype=np.double)
        lp.col_lower_ = np.zeros(len(candidates))
        lp.col_upper_ = np.ones(len(candidates))
        lp.integrality_ = [highspy.HighsVarType.kInteger] * len(candidates)
        lp.row_lower_ = np.array([1.0] * groups + [-highspy.kHighsInf] * 2)
        lp.row_upper_ = np.array([1.0] * groups
            + [float(instance.duration), float(instance.energy)])
        start, index, value = [0], [], []
        for group, options in enumerate(instance.activities):
            for _, duration, energy in options:
                index += [group, groups, groups + 1]
                value += [1.0, float(duration), float(energy)]
                start.append(len(index))
        lp.a_matrix_.format_ = highspy.MatrixFormat.kColwise
        lp.a_matrix_.start_ = np.array(start, dtype=np.int32)
        lp.a_matrix_.index_ = np.array(index, dtype=np.int32)
        lp.a_matrix_.value_ = np.array(value, dtype=np.double)
        return lp

    def solve(self, instance, limit):
        highs = highspy.Highs()
        # The quality is an integer: a gap under one unit is a proof.
        defaults = [
            ("output_flag", False),
            ("threads", 1),
            ("mip_rel_gap", 0.0),
            ("mip_abs_gap", 0.99),
            ("time_limit", float(limit)),
        ]
        for key, value in defaults + self.options:
            if highs.setOptionValue(key, value) != highspy.HighsStatus.kOk:
                raise InputError(f"HiGHS refuses the option {key}={value!r}")
        if highs.passModel(self.model(instance)) == highspy.HighsStatus.kError:
            raise InputError(f"{instance.name}: HiGHS refuses the model")
        cpu, wall = time.process_time(), time.perf_counter()
        highs.run()
        seconds, cpu = time.perf_counter() - wall, time.process_time() - cpu
        status, info = highs.getModelStatus(), highs.getInfo()
        if status == highspy.HighsModelStatus.kInfeasible:
            return Answer(INFEASIBLE, seconds, cpu)
        bound = whole(info.mip_dual_bound)
        if info.primal_solution_status != 2:  # no feasible point
            return Answer(UNKNOWN, seconds, cpu, None, bound)
        plan = picked(instance, highs.getSolution().col_value)
        optimal = status == highspy.HighsModelStatus.kOptimal
        quality = round(info.objective_function_value)
        return Answer(OPTIMAL if optimal else FEASIBLE, seconds, cpu, quality, bound, plan=plan)


worker = None  # the one solver of a worker process


def start_worker(make, options):
    global worker
    worker = make(options)
    return worker.version


def solve_in_worker(instance, limit):
    return worker.solve(instance, limit)


class Solver:
    """A solver in its own process, which inherits the affinity of this one."""

    def __init__(self, make, options):
        self.name = make.name
        self.pool = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"))
        try:
            self.version = self.pool.submit(start_worker, make, options).result()
        except ImportError as error:
            raise InputError(f"{error}; install the packages of requirements.txt") from error

    def solve(self, instance, limit):
        return self.pool.submit(solve_in_worker, instance, limit).result()

    def close(self):
        self.pool.shutdown()


def whole(bound):
    """An upper bound of an integer objective, rounded down to an integer."""
    if bound is None or not math.isfinite(bound) or abs(bound) >= 2**62:
        return None
    return math.floor(bound + 1e-6 * max(1.0, abs(bound) * 1e-3))


def run(solver, instance, limit, repeat):
    """One run, or the median of `repeat` runs when it is short."""
    answer = solver.solve(instance, limit)
    answer.limit = limit
    if answer.status in PROVEN and answer.seconds < SHORT:
        runs = [answer] + [solver.solve(instance, limit) for _ in range(repeat - 1)]
        answer.seconds = statistics.median(r.seconds for r in runs)
        answer.cpu_seconds = statistics.median(r.cpu_seconds for r in runs)
        answer.runs = len(runs)
    if answer.plan is not None:
        quality, wrong = verify(instance, answer.plan)
        if wrong is None and quality != answer.quality:
            wrong = f"reports quality {answer.quality}, its plan has {quality}"
        if wrong is not None:
            answer.status, answer.note = INVALID, wrong
    return answer


def ours_of(instance):
    entry = instance.ours
    answer = Answer(entry["status"], entry["seconds"], 0.0, entry.get("quality"),
        entry.get("bound"))
    if isinstance(entry.get("plan"), list):
        quality, wrong = verify(instance, entry["plan"])
        if wrong is None and quality != answer.quality:
            wrong = f"reports quality {answer.quality}, its plan has {quality}"
        if wrong is not None:
            answer.status, answer.note = INVALID, wrong
    return answer


def contradictions(name, answers):
    """Every pair of answers that cannot both be true."""
    found = [f"{name}: {who} returns a wrong plan: {a.note}" for who, a in answers.items()
        if a.status == INVALID]
    sound = {who: a for who, a in answers.items() if a.status != INVALID}
    for who, a in sound.items():
        ceiling = a.quality if a.status == OPTIMAL else a.bound
        for other, b in sound.items():
            if b.quality is None:
                continue
            if a.status == INFEASIBLE:
                found.append(f"{name}: {who} proves there is no plan, "
                        f"{other} has one of quality {b.quality}")
            elif ceiling is not None and b.quality > ceiling:
                what = "optimum" if a.status == OPTIMAL else "bound"
                found.append(f"{name}: {who} proves {what} {ceiling}, "
                        f"{other} has quality {b.quality}")
    return found


# ---------------------------------------------------------------- report


def seconds_text(value):
    if value is None:
        return "-"
    if value < 0.001:
        return f"{value * 1e6:.0f} µs"
    if value < 1:
        return f"{value * 1e3:.3g} ms"
    return f"{value:.3g} s"


def number_text(value, mark=""):
    if value is None:
        return "-"
    return mark + (f"{value:.3g}" if value < 1000 else f"{value:.0f}")


def gap_text(value):
    return "-" if value is None else f"{100 * value:.4f} %"


def ratio(answers):
    """(ratio, mark): the faster of the others over ours.

    "≥": no other solver finished, so the time is at least its limit.
    "≤": ours did not finish and another did, so our time is at least the one given.
    """
    ours = answers.get(OURS)
    others = [a for who, a in answers.items() if who != OURS]
    if ours is None or ours.status == INVALID or not others:
        return None
    proven = [a.seconds for a in others if a.status in PROVEN]
    own = max(ours.seconds, 1e-9)
    if ours.status in PROVEN:
        # A solver stopped at its limit is known to need at least that long.
        open_ = [max(a.seconds, a.limit or 0.0) for a in others if a.status in (FEASIBLE, UNKNOWN)]
        if proven and (not open_ or min(proven) <= min(open_)):
            return min(proven) / own, ""
        if proven or open_:
            return min(proven + open_) / own, "≥"
        return None
    return (min(proven) / own, "≤") if proven else None


def summary_of(ratios, pick):
    """A statistic of the ratios, marked when an unfinished run could move it."""
    if not ratios:
        return None, ""
    value = pick([r for r, _ in ratios])
    up = any(mark == "≥" and r <= value for r, mark in ratios)
    down = any(mark == "≤" and r >= value for r, mark in ratios)
    return value, "~" if up and down else "≥" if up else "≤" if down else ""


def median_time(answers):
    """The median time; marked when an unfinished run is at or under it."""
    if not answers:
        return "-"
    value = statistics.median(a.seconds for a in answers)
    cut = any(a.status not in PROVEN and a.seconds <= value * 1.001 for a in answers)
    return (">" if cut else "") + seconds_text(value)


def counts(answers):
    order = [OPTIMAL, INFEASIBLE, FEASIBLE, UNKNOWN, INVALID]
    tally = [(s, sum(a.status == s for a in answers)) for s in order]
    return ", ".join(f"{n} {s}" for s, n in tally if n) or "-"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "|".join(" --- " for _ in header) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def kinds_of(rows):
    kinds = {}
    for row in rows:
        kinds.setdefault(row["kind"], []).append(row)
    return kinds


def markdown(rows, names, limit, versions):
    out = [", ".join(f"{k} {v}" for k, v in versions.items()) + f"; one CPU, limit {limit:g} s.",
        ""]
    body, overall = [], []
    for kind, members in kinds_of(rows).items():
        per = {n: [m["answers"][n] for m in members if n in m["answers"]] for n in names}
        ratios = [r for r in (ratio(m["answers"]) for m in members) if r is not None]
        overall += [(*r, m["name"]) for m in members if (r := ratio(m["answers"])) is not None]
        body.append(
            [kind, str(len(members))]
            + [median_time(per[n]) for n in names]
            + [counts(per[n]) for n in names]
            + [
                number_text(*summary_of(ratios, statistics.median)),
                number_text(*summary_of(ratios, min)),
            ]
        )
    header = ["kind", "n"] + [f"{n} median" for n in names] + [f"{n} status" for n in names]
    out.append(table(header + ["ratio median", "ratio min"], body))
    if overall:
        value, mark, name = min(overall)
        out += ["", f"Worst ratio of all: {number_text(value, mark)} ({name})."]
    unfinished = [r for r in rows if OURS in r["answers"] and r["answers"][OURS].status == FEASIBLE]
    if unfinished:
        body = []
        for row in unfinished:
            for n in names:
                a = row["answers"].get(n)
                if a is not None:
                    shown = ["-" if v is None else str(v) for v in (a.quality, a.bound)]
                    body.append([row["name"], n, seconds_text(a.seconds), a.status, *shown,
                        gap_text(a.gap())])
        out += ["", f"Not proven by {OURS}; the others were given the same time:", ""]
        out.append(table(["instance", "solver", "time", "status", "quality", "bound", "gap"], body))
    return "\n".join(out)


def machine(rows, names, limit, versions, problems):
    instances = []
    for row in rows:
        r = ratio(row["answers"])
        solvers = {}
        for n, a in row["answers"].items():
            solvers[n] = {k: v for k, v in asdict(a).items() if k != "plan" and v is not None} | {
                "gap": a.gap()}
        instances.append(
            {
                "name": row["name"],
                "kind": row["kind"],
                "solvers": solvers,
                "ratio": None if r is None else {"value": r[0], "mark": r[1]},
            }
        )
    kinds = []
    for kind, members in kinds_of(rows).items():
        ratios = [r for r in (ratio(m["answers"]) for m in members) if r is not None]
        entry = {"kind": kind, "instances": len(members), "seconds_median": {}, "status": {}}
        for n in names:
            found = [m["answers"][n] for m in members if n in m["answers"]]
            if found:
                entry["seconds_median"][n] = statistics.median(a.seconds for a in found)
                entry["status"][n] = {s: sum(a.status == s for a in found)
                    for s in {a.status for a in found}}
        for key, pick in (("ratio_median", statistics.median), ("ratio_min", min)):
            value, mark = summary_of(ratios, pick)
            entry[key] = None if value is None else {"value": value, "mark": mark}
        kinds.append(entry)
    return {
        "schema": SCHEMA_OUT,
        "versions": versions,
        "limit_seconds": limit,
        "kinds": kinds,
        "instances": instances,
        "contradictions": problems,
    }


# ---------------------------------------------------------------- self-test


def brute_force(instance):
    best = None
    for plan in itertools.product(*(range(len(a)) for a in instance.activities)):
        quality, wrong = verify(instance, list(plan))
        if wrong is None and (best is None or quality > best):
            best = quality
    return best


def self_test(solvers):
    known = {
        "limits": {"duration_ms": 10, "energy_mj": 10},
        "activities": [[[1, 1, 1], [6, 6, 2], [7, 2, 7]], [[0, 0, 0], [5, 5, 3], [9, 3, 9]],
            [[2, 1, 1], [3, 2, 5]]],
    }
    instances = [instance_from(known, "known", "test")]
    numbers = random.Random(1)
    for k in range(12):
        activities = [
            [[numbers.randint(0, 40), numbers.randint(1, 30), numbers.randint(1, 30)]
                for _ in range(4)]
            for _ in range(6)
        ]
        share = 0.2 if k == 0 else numbers.uniform(0.3, 0.6)
        limits = {"duration_ms": round(180 * share), "energy_mj": round(180 * share)}
        instances.append(instance_from({"limits": limits, "activities": activities}, f"random-{k}",
            "test"))
    hopeless = {"limits": {"duration_ms": 1, "energy_mj": 9},
        "activities": [[[5, 1, 1]], [[5, 1, 1], [9, 1, 2]]]}
    instances.append(instance_from(hopeless, "hopeless", "test"))
    failures, seen = [], set()
    for instance in instances:
        best = brute_force(instance)
        want = INFEASIBLE if best is None else OPTIMAL
        seen.add(want)
        answers = {OURS: Answer(want, 0.0, quality=best, bound=best)}
        for solver in solvers:
            a = answers[solver.name] = run(solver, instance, 10.0, 1)
            if (a.status, a.quality) != (want, best):
                failures.append(f"{instance.name}: {solver.name} {a.status} {a.quality}, "
                    f"brute force {want} {best}")
        failures += contradictions(instance.name, answers)
        # The checks themselves must notice a false claim.
        if best is not None:
            for lie in (Answer(OPTIMAL, 0.0, quality=best - 1),
                    Answer(FEASIBLE, 0.0, quality=best + 1, bound=best + 9)):
                if not contradictions(instance.name, answers | {OURS: lie}):
                    failures.append(
                        f"{instance.name}: a false {lie.status} {lie.quality} went unnoticed")
            if not contradictions(instance.name, answers | {OURS: Answer(INFEASIBLE, 0.0)}):
                failures.append(f"{instance.name}: a false proof of no plan went unnoticed")
    for plan in ([0, 0], [0, 0, -1], [1, 1, 0], [2, 2, 0]):
        if verify(instances[0], plan)[1] is None:
            failures.append(f"the wrong plan {plan} passes")
    if verify(instances[0], [0, 0, 0]) != (3, None):
        failures.append("the plan [0, 0, 0] does not pass with quality 3")
    if seen != {OPTIMAL, INFEASIBLE}:
        failures.append(f"the instances cover {seen} only")
    for failure in failures:
        print(f"FAILED {failure}", file=sys.stderr)
    if not failures:
        names = " and ".join(s.name for s in solvers)
        print(f"self-test passed: {len(instances)} instances, {names} agree with brute force")
    return 1 if failures else 0


# ---------------------------------------------------------------- main


def setting(text):
    key, sep, value = text.partition("=")
    if not sep or not key:
        raise argparse.ArgumentTypeError("expected KEY=VALUE")
    try:
        return key, json.loads(value)
    except ValueError:
        return key, value


def positive(convert):
    def parse(text):
        value = convert(text)
        if not value > 0:
            raise argparse.ArgumentTypeError("must be over zero")
        return value

    return parse


def arguments():
    parser = argparse.ArgumentParser(
        description="Time CP-SAT and HiGHS on exported allocation instances.")
    parser.add_argument("input", nargs="?",
        help="folder of the benchmark's --export, or a JSON lines file")
    parser.add_argument("--limit", type=positive(float), default=60.0,
        help="seconds per run (default 60)")
    parser.add_argument("--repeat", type=positive(int), default=5,
        help="runs when one takes under 0.1 s (default 5)")
    parser.add_argument("--kind", action="append",
        help="only kinds that contain this text (may be given again)")
    parser.add_argument("--solver", action="append", choices=["cp-sat", "highs"],
        help="only this solver")
    parser.add_argument("--cp-sat", action="append", type=setting, default=[], metavar="KEY=VALUE")
    parser.add_argument("--highs", action="append", type=setting, default=[], metavar="KEY=VALUE")
    parser.add_argument("--cpu", type=int, help="CPU to stay on (default: the last one allowed)")
    parser.add_argument("--json", metavar="FILE",
        help="also write the figures here; - for standard output instead")
    parser.add_argument("--self-test", action="store_true",
        help="compare both solvers with brute force, and stop")
    options = parser.parse_args()
    if options.input is None and not options.self_test:
        parser.error("give a folder or a file, or --self-test")
    return options


def main():
    options = arguments()
    if hasattr(os, "sched_setaffinity"):
        try:
            os.sched_setaffinity(0, {max(os.sched_getaffinity(0)) if options.cpu is None
                else options.cpu})
        except OSError as error:
            raise InputError(f"cannot stay on one CPU: {error}") from error
    else:
        print("note: this system cannot keep a process on one CPU", file=sys.stderr)
    wanted = options.solver or ["cp-sat", "highs"]
    known = {"cp-sat": (CpSat, options.cp_sat), "highs": (Highs, options.highs)}
    solvers = [Solver(*known[key]) for key in known if key in wanted]
    try:
        return self_test(solvers) if options.self_test else compare(options, solvers)
    finally:
        for solver in solvers:
            solver.close()


def compare(options, solvers):
    versions = {s.name: s.version for s in solvers} | {"Python": platform.python_version()}
    instances = load(options.input)
    if options.kind:
        instances = [i for i in instances if any(k in i.kind for k in options.kind)]
    if not instances:
        raise InputError(f"{options.input}: no instance")
    rows, problems = [], []
    wall = cpu = 0.0
    for number, instance in enumerate(instances, 1):
        answers, limit = {}, options.limit
        if instance.ours is not None:
            ours = answers[OURS] = ours_of(instance)
            if ours.status == FEASIBLE:
                limit = max(0.001, ours.seconds)
        for solver in solvers:
            a = answers[solver.name] = run(solver, instance, limit, options.repeat)
            wall, cpu = wall + a.seconds, cpu + a.cpu_seconds
        line = "; ".join(f"{n} {a.status} {seconds_text(a.seconds)}" for n, a in answers.items())
        print(f"[{number}/{len(instances)}] {instance.name}: {line}", file=sys.stderr, flush=True)
        for problem in contradictions(instance.name, answers):
            print(f"CONTRADICTION {problem}", file=sys.stderr, flush=True)
            problems.append(problem)
        rows.append({"name": instance.name, "kind": instance.kind, "answers": answers})
    if wall > 1.05 * cpu + 0.1:
        print(f"WARNING the CPU was shared: {wall:.1f} s passed, {cpu:.1f} s were used",
            file=sys.stderr)

    names = [n for n in [OURS] + [s.name for s in solvers] if any(n in r["answers"] for r in rows)]
    if options.json:
        text = json.dumps(machine(rows, names, options.limit, versions, problems), indent=1) + "\n"
        if options.json == "-":
            sys.stdout.write(text)
        else:
            Path(options.json).write_text(text, encoding="utf-8")
    if options.json != "-":
        print(markdown(rows, names, options.limit, versions))
    if problems:
        print(f"\n{len(problems)} CONTRADICTION(S):", *problems, sep="\n  ", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except InputError as error:
        print(f"compare.py: {error}", file=sys.stderr)
        sys.exit(2)
