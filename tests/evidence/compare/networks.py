#!/usr/bin/env python3
"""Read networks of `cotama risk` with pgmpy and pyAgrum, and theirs with it.

    cargo build --release -p cotama
    cargo build --profile bench -p cotama-risk --example speed
    python tests/evidence/compare/networks.py [--cotama target/release/cotama]
        [--speed target/release/examples/speed] [--pomegranate PYTHON]

Networks are learned from the data of `models/risk/data`, written as BIF, read and
written again by both, and asked the same questions. Posteriors of pgmpy must agree to
1e-12; those of pyAgrum to 1e-6, as it keeps numbers in single precision. Then the time
of a query is measured, ours in turns with pyAgrum and, where it is installed, bayesian-cpp:
medians and ratios. With a Python that has pomegranate 0.14 (README.md says how it is built), its
exact search is measured beside ours too: minutes.

Exit status: 0 when all agree, 1 when something differs, 77 when a package is missing.
"""

import argparse
import json
import os
import random
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import pyagrum
    from pgmpy.inference import VariableElimination
    from pgmpy.readwrite import BIFReader, BIFWriter
except ImportError as missing:
    print(f"SKIPPED, NOTHING IS SHOWN: {missing}; pip install -r requirements.txt", file=sys.stderr)
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[3]
DATA = ROOT / "models/risk/data"
QUERIES = [
    ("cancer", "Cancer", {"Xray": "positive", "Dyspnoea": "True"}),
    ("asia", "lung", {"dysp": "yes", "xray": "yes"}),
    ("two_ways", "ratio", {"status": "failed", "way": "short", "object_speed": "medium"}),
    ("sixteen", "v5", {"v9": "0", "v10": "1", "v14": "0"}),
]


def cotama(program, *words):
    done = subprocess.run([program, "risk", *words], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"cotama risk {' '.join(words)}: {done.stdout}{done.stderr}")
    return done.stdout


def ours(program, path, query, evidence):
    known = [word for pair in evidence.items() for word in ("--evidence", "=".join(pair))]
    answer = cotama(program, "infer", str(path), "--query", query, *known, "--json")
    return json.loads(answer)["posterior"]


def off(posterior, theirs):
    return max(abs(share - theirs(state)) for state, share in posterior.items())


def agrum(network, query, evidence):
    inference = pyagrum.VariableElimination(network)
    inference.setEvidence(evidence)
    inference.makeInference()
    return inference.posterior(query)


def compare(program, folder, name, rng):
    """The largest differences: ours read by pgmpy, by pyAgrum, theirs read by us."""
    path = folder / f"{name}.bif"
    cotama(program, "learn", str(DATA / f"{name}.csv"), "--method", "k2", "--out", str(path))
    model, network = BIFReader(str(path)).get_model(), pyagrum.loadBN(str(path))
    elimination = VariableElimination(model)
    others = [folder / f"{name}.{end}" for end in ("pgmpy.bif", "agrum.bif", "agrum.bifxml")]
    BIFWriter(model).write_bif(str(others[0]))
    pyagrum.saveBN(network, str(others[1]))
    pyagrum.saveBN(network, str(others[2]))
    names, worst = sorted(model.nodes()), [0.0] * 5
    for _ in range(6):
        query, *known = rng.sample(names, 3)
        evidence = {it: rng.choice(model.states[it]) for it in known}
        own = ours(program, path, query, evidence)
        theirs = elimination.query([query], evidence=evidence, show_progress=False)
        found = [off(own, lambda state: theirs.get_value(**{query: state}))]
        theirs = agrum(network, query, evidence)
        found.append(off(own, lambda state: theirs[{query: state}]))
        found += [off(own, ours(program, it, query, evidence).get) for it in others]
        worst = [max(pair) for pair in zip(worst, found)]
    return worst


def microseconds(work, times):
    start = time.perf_counter()
    for _ in range(times):
        work()
    return (time.perf_counter() - start) / times * 1e6


class Native:
    """A network of `models/risk/data` in bayesian-cpp, by states as numbers."""

    def __init__(self, bayesian, name):
        self.model = BIFReader(str(DATA / f"{name}.bif")).get_model()
        card = {it: self.model.get_cardinality(it) for it in self.model.nodes()}
        self.known = {it: bayesian.Variable(at, it, card[it]) for at, it in enumerate(card)}
        factors = [
            bayesian.Potential([self.known[it] for it in cpd.variables], cpd.values.flatten().tolist())
            for cpd in self.model.get_cpds()
        ]
        self.engine = bayesian.Inference(factors)

    def ask(self, query, evidence):
        number = {it: self.model.states[it].index(state) for it, state in evidence.items()}
        return [self.known[query]], {self.known[it]: at for it, at in number.items()}

    def off(self, posterior, query, evidence):
        found = self.engine.conditional_given(*self.ask(query, evidence)).probabilities()
        return off(posterior, dict(zip(self.model.states[query], found)).get)


def native(program):
    """Networks of bayesian-cpp; whether its posteriors are ours in single precision."""
    try:
        import bayesian
    except ImportError:
        print("bayesian-cpp: not installed")
        return [], True
    networks, agrees = [], True
    for name, query, evidence in QUERIES:
        network = Native(bayesian, name)
        worst = network.off(ours(program, DATA / f"{name}.bif", query, evidence), query, evidence)
        print(f"{name:10} {worst:.1e} between ours and bayesian-cpp")
        agrees &= worst < 1e-5
        networks.append(network)
    return networks, agrees


def said(*words):
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    return [float(it) for it in done.stdout.split()]


def queries(speed, natives):
    """Times of a query, in turns; medians of 9 means, and how many times ours the others take."""
    print(f"a query, us, medians of 9 means in turns (load {os.getloadavg()[0]:.1f})")
    print("           ours prepared  from the start    pyAgrum    ratios   bayesian-cpp    ratios")
    for at, (name, query, evidence) in enumerate(QUERIES):
        network, rounds = pyagrum.loadBN(str(DATA / f"{name}.bif")), []
        known = ["=".join(pair) for pair in evidence.items()]
        for _ in range(9):
            taken = said(speed, "ask", str(DATA / f"{name}.bif"), query, *known)
            taken.append(microseconds(lambda: agrum(network, query, evidence), 200))
            if natives:
                asked, engine = natives[at].ask(query, evidence), natives[at].engine
                taken.append(microseconds(lambda: engine.conditional_given(*asked), 2_000))
            rounds.append(taken)
        prepared, whole, *others = map(statistics.median, zip(*rounds))
        line = f"{name:10} {prepared:13.3f} {whole:15.3f}"
        for other in others:
            line += f" {other:10.1f} {other / prepared:6.0f} {other / whole:5.0f}  "
        print(line)


POMEGRANATE = """
import csv, sys, time, numpy, pomegranate
data = numpy.array(list(csv.reader(open(sys.argv[1])))[1:])
start = time.perf_counter()
pomegranate.BayesianNetwork.from_samples(data, algorithm="exact-dp", n_jobs=1)
print((time.perf_counter() - start) * 1e3)
"""


def searches(speed, python):
    """Times of exact searches by BIC: ours before and after one of pomegranate's."""
    print(f"exact search by BIC, ms, medians of 7 (load {os.getloadavg()[0]:.1f})")
    print("                 ours  pomegranate   ratio")
    for name, *_ in QUERIES:
        path = str(DATA / f"{name}.csv")
        own = [said(speed, "learn", "bic", path)[0] for _ in range(3)]
        other = said(python, "-c", POMEGRANATE, path)[0]
        own += [said(speed, "learn", "bic", path)[0] for _ in range(4)]
        own = statistics.median(own)
        print(f"{name:10} {own:10.2f} {other:12.1f} {other / own:7.0f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cotama", default=str(ROOT / "target/release/cotama"))
    parser.add_argument("--speed", default=str(ROOT / "target/release/examples/speed"))
    parser.add_argument("--pomegranate", metavar="PYTHON")
    given = parser.parse_args()
    program, rng, agrees = given.cotama, random.Random(1), True
    print("largest difference of a posterior")
    print(f"{'':10} ours in pgmpy  in pyAgrum  pgmpy's BIF  pyAgrum's BIF  its XMLBIF")
    with tempfile.TemporaryDirectory() as folder:
        for name, *_ in QUERIES:
            worst = compare(program, Path(folder), name, rng)
            print(f"{name:10} {''.join(f'{it:12.1e}' for it in worst)}")
            limits = [1e-12, 1e-6, 1e-12, 1e-6, 1e-5]
            agrees &= all(it < limit for it, limit in zip(worst, limits))
    natives, alike = native(program)
    agrees &= alike
    queries(given.speed, natives)
    if given.pomegranate:
        searches(given.speed, given.pomegranate)
    print("all agree" if agrees else "THEY DIFFER")
    return 0 if agrees else 1


if __name__ == "__main__":
    sys.exit(main())
