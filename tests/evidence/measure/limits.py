#!/usr/bin/env python3
"""Whether `cotama check` keeps its limits: rings, stars, chains and independent nets of 1,000,
10,000 and 100,000 places, ten questions each, with --max-seconds 2 --max-memory 200.

Usage: limits.py PROGRAM [--sizes 1000,10000] [--nets ring,star] [--rows]

Prints a table for docs/speed.md: of each net the longest time by the clock, the most seconds of a
core and the most memory of a process, reading the file included, how many of the questions were
answered, and why the others were not. --rows prints each question. Exit code 1 when a run takes
more than 2.5 s or 260 MB.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

SECONDS, MEMORY = 2.5, 260.0


def ring(n):
    """One token goes round."""
    return ([int(i == 0) for i in range(n)], [([i], [(i + 1) % n]) for i in range(n)])


def star(n):
    """One token goes from the middle to any end and back."""
    there = [([0], [i]) for i in range(1, n)]
    return ([int(i == 0) for i in range(n)], there + [([i], [0]) for i in range(1, n)])


def chain(n):
    """One token goes to the end."""
    return ([int(i == 0) for i in range(n)], [([i], [i + 1]) for i in range(n - 1)])


def independent(n):
    """Pairs of places, a token in each pair, which goes back and forth."""
    turns = [turn for i in range(0, n, 2) for turn in (([i], [i + 1]), ([i + 1], [i]))]
    return ([int(i % 2 == 0) for i in range(n)], turns)


NETS = {"ring": ring, "star": star, "chain": chain, "independent": independent}


def questions(n):
    last = n - 1
    return [
        "EF deadlock", f"EF p{last}", "AG !(p1 & p2)", "bounds(p0 + p1)", "live", "quasi_live",
        "one_safe", "stable", "AG EF p0", f"AG (p1 -> AF p{last})",
    ]


def write(path, net):
    tokens, transitions = net
    with open(path, "w", encoding="utf-8") as file:
        grammar = "http://www.pnml.org/version-2009/grammar"
        file.write(f'<?xml version="1.0"?><pnml xmlns="{grammar}/pnml">')
        file.write(f'<net id="n" type="{grammar}/ptnet">')
        file.write('<page id="page">\n')
        for at, count in enumerate(tokens):
            mark = f"<initialMarking><text>{count}</text></initialMarking>" if count else ""
            file.write(f'<place id="p{at}"><name><text>p{at}</text></name>{mark}</place>\n')
        for at, (take, give) in enumerate(transitions):
            file.write(f'<transition id="t{at}"><name><text>t{at}</text></name></transition>\n')
            for place in take:
                file.write(f'<arc id="i{at}_{place}" source="p{place}" target="t{at}"/>\n')
            for place in give:
                file.write(f'<arc id="o{at}_{place}" source="t{at}" target="p{place}"/>\n')
        file.write("</page></net></pnml>\n")


def run(program, path, question):
    """The result, seconds by the clock, MB at the peak and seconds of a core of one process."""
    command = [program, "check", path, "--property", question, "--json",
               "--max-seconds", "2", "--max-memory", "200"]
    with tempfile.TemporaryFile() as out:
        begun = time.monotonic()
        child = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - begun
        out.seek(0)
        try:
            result = json.load(out)["results"][0]
        except (ValueError, KeyError, IndexError):
            result = {"verdict": f"exit code {child.returncode}", "engine": "none"}
    return result, seconds, used.ru_maxrss / 1024, used.ru_utime + used.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--sizes", default="1000,10000,100000")
    parser.add_argument("--nets", default=",".join(NETS))
    parser.add_argument("--only", type=int, help="one question, by its number from 0")
    parser.add_argument("--rows", action="store_true")
    args = parser.parse_args()
    passed = True
    print("| net | places | s, most | of a core | MB, most | answered | not answered |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for size in map(int, args.sizes.split(",")):
        for name in args.nets.split(","):
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, f"{name}.pnml")
                write(path, NETS[name](size))
                rows = []
                for at, question in enumerate(questions(size)):
                    if args.only not in (None, at):
                        continue
                    result, seconds, memory, core = run(args.program, path, question)
                    rows.append((seconds, memory, core))
                    known = result["verdict"] in ("true", "false")
                    rows[-1] += (None if known else result.get("reason") or result["verdict"],)
                    if args.rows:
                        what = result.get("bound") or result["verdict"]
                        print(f"  {name} {size} {question}: {what}, {result['engine']}, "
                              f"{rows[-1][3] or ''} {seconds:.2f} s ({core:.2f} s of a core), "
                              f"{memory:.0f} MB", flush=True)
            most, peak = max(it[0] for it in rows), max(it[1] for it in rows)
            passed &= most <= SECONDS and peak <= MEMORY
            core = max(it[2] for it in rows)
            why = sorted({it[3] for it in rows if it[3]})
            count = sum(it[3] is None for it in rows)
            print(f"| {name} | {size:,} | {most:.2f} | {core:.2f} | {peak:.0f} | "
                  f"{count} of {len(rows)} | {'; '.join(why)} |", flush=True)
    sys.exit(not passed)


if __name__ == "__main__":
    main()
