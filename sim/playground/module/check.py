#!/usr/bin/env python3
"""Runs in the module of pages, held against `cotama simulate`, record by record.

    check.py PROGRAM [--runs N] [--module FILE.wasm]

Of every model, robot and team that PROGRAM lists it writes the page, takes model and module out of
it (or another module), draws runs of up to 12 words, and compares the records, the marking, what
would use each event, and the next deadline. Needs `wasmtime` (PyPI).
"""

import argparse
import base64
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile

import wasmtime

from subjects import subjects

REASONS = ["", "on_purpose", "not_enabled", "too_early", "too_late", "full"]
WORDS = 12


class Module:
    """A model in play, in the module."""

    def __init__(self, made, data):
        store, module = made
        self.store, self.data = store, data
        self.exports = wasmtime.Instance(store, module, []).exports(store)
        self.memory = self.exports["memory"]
        self.model = base64.b64decode(data["model"])

    def call(self, name, *numbers):
        return self.exports[name](self.store, *numbers)

    def start(self, rounds):
        self.page = self.call("open", len(self.model))
        self.memory.write(self.store, self.model, self.call("input", self.page))
        if self.call("load", self.page, int(rounds)) != 0:
            raise RuntimeError(self.text())
        return self.records()

    def words(self):
        start, length = self.call("words", self.page), self.call("words_length", self.page)
        return iter(memoryview(self.memory.read(self.store, start, start + 4 * length)).cast("I"))

    def text(self):
        start, length = self.call("text", self.page), self.call("text_length", self.page)
        return bytes(self.memory.read(self.store, start, start + length)).decode()

    def tell(self, event, at):
        number = 0 if event is None else event + 1
        status = self.call("tell", self.page, number, at % 2**32, at // 2**32)
        return self.records() if status == 0 else status

    def employ(self):
        tables = base64.b64decode(self.data["robot"]["tables"])
        self.memory.write(self.store, tables, self.call("tables", self.page, len(tables)))
        if self.call("employ", self.page) != 0:
            raise RuntimeError(self.text())

    def period(self, up, works, said, stands, at):
        """A period of the decider: the event that it told, and the records."""
        halves = [it for number in (up, works) for it in (number % 2**32, number // 2**32)]
        told = 0 if said is None else said[1] * 256 + said[2] + 1
        time = at % 2**32, at // 2**32
        status = self.call("period", self.page, *halves, told, 0, int(stands), *time)
        assert status == 0, status
        words, data = self.words(), self.data
        listed(words)
        event = next(words) - 1
        for _ in range(4):
            next(words)
        return event, [self.record(words, data) for _ in range(next(words))]

    def pilot(self):
        self.call("pilot", self.page)
        return list(self.words())

    def why(self, event, at):
        self.call("why", self.page, event, at % 2**32, at // 2**32)
        return self.text()

    def records(self):
        words, data = self.words(), self.data
        return [self.record(words, data) for _ in range(next(words))]

    def record(self, words, data):
        at, is_round = time(words), next(words) == 1
        events, fired = listed(words), listed(words)
        unused, emitted, changed = pairs(words), listed(words), pairs(words)
        record = {
            "time_ms": at,
            "events": [data["events"][it][0] for it in events],
            "fired": [data["transitions"][it][0] for it in fired],
            "ignored": [(data["events"][it][0], REASONS[why]) for it, why in unused],
            "emitted": [data["outputs"][it] for it in emitted],
            "changed": [(data["places"][it][0], tokens) for it, tokens in changed],
        }
        return {**record, **({"round": True} if is_round else {})}

    def state(self, at):
        self.call("state", self.page, at % 2**32, at // 2**32)
        words, data = self.words(), self.data
        _, _, now, _ = next(words), next(words), time(words), next(words)
        is_due, due, first = next(words) == 1, time(words), next(words)
        tokens, prospects = listed(words), pairs(words)
        return {
            "time_ms": now,
            "deadline": (due, data["transitions"][first][0]) if is_due else None,
            "tokens": tokens,
            "prospects": prospects,
        }


def time(words):
    low = next(words)
    return low + (next(words) << 32)


def listed(words):
    return [next(words) for _ in range(next(words))]


def pairs(words):
    return [(next(words), next(words)) for _ in range(next(words))]


def word(name, at, now):
    return f"+{at - now}" if name is None else f"{name}@{at}"


def drawn(rng, data, module, rounds):
    """A run: what is told, more often than not what something would use."""
    records, now, words = module.start(rounds), 0, []
    for _ in range(rng.randint(1, WORDS)):
        state, at = module.state(now), now + rng.choice([0, 0, 1, 50, 100, 1000, 5000, 60000])
        due = state["deadline"]
        if due and rng.random() < 0.2:
            at = max(now, due[0])
        usable = [it for it, (why, _) in enumerate(state["prospects"]) if why == 0]
        event = None
        if data["events"] and rng.random() < 0.8:
            is_usable = usable and rng.random() < 0.7
            event = rng.choice(usable) if is_usable else rng.randrange(len(data["events"]))
        if event is None and at == now and not rounds:
            at += 1
        name = None if event is None else data["events"][event][0]
        told = module.tell(event, at)
        if told == 1:
            break
        assert not isinstance(told, int), (told, words)
        words.append(word(name, at, now))
        records, now = records + told, at
    return words, records, module.state(now), now


def driven(rng, data, module):
    """A run of a robot: failures and flags that come and go, and what is said to it."""
    records, robot = module.start(True), data["robot"]
    module.employ()
    now, words, flags, failures = 0, [], set(), set()
    says = [it for it in robot["says"] if it[1] not in (4, 5)]
    for at in range(100, 100 * rng.randint(2, 40), 100):
        if rng.random() < 0.3:
            failures ^= {rng.randrange(len(robot["failures"]))}
        if rng.random() < 0.1:
            flags ^= {rng.randrange(len(robot["flags"]))}
        on = [robot["failures"][it] for it in failures]
        up = sum(1 << it for it in flags.union(*(it["flags"] for it in on)))
        works = 2**64 - 1
        for it in on:
            works &= it["works"][0] | it["works"][1] << 32
        usable = [it for it in says if module.state(at)["prospects"][it[0]][0] == 0]
        said = rng.choice(usable) if usable and rng.random() < 0.5 else None
        state = module.pilot()
        event, more = module.period(up, works, said, state[9] == 0, at)
        assert module.pilot()[-1] == 1, "the decider is elsewhere"
        name = None if event < 0 else data["events"][event][0]
        words.append(word(name, at, now))
        records, now = records + more, at
    return words, records, module.state(now), now


def same(program, path, words, rounds, mine, state, module, now):
    """Asserts that the program says the same."""
    command = [program, "simulate", path, "--json", *(["--rounds"] if rounds else []), "--", *words]
    said = subprocess.run(command, capture_output=True, text=True, check=True)
    answer = json.loads(said.stdout)
    theirs = [
        {
            **it,
            "ignored": [(why["event"], why["reason"]) for why in it["ignored"]],
            "changed": [(place["place"], place["tokens"]) for place in it["changed"]],
        }
        for it in answer["steps"]
    ]
    assert mine == theirs, first(mine, theirs)
    due = answer["deadline"]
    assert state["deadline"] == (due and (due["time_ms"], due["transition"])), (state, due)
    assert state["time_ms"] == answer["time_ms"]
    assert state["tokens"][: len(answer["marking"])] == list(answer["marking"].values())
    if rounds:
        return
    users = {it["event"]: it["transition"] for it in answer["enabled"]}
    unused = {it["event"]: it for it in answer["unused"]}
    for event, (why, transition) in enumerate(state["prospects"]):
        name = module.data["events"][event][0]
        if why == 0:
            assert users[name] == module.data["transitions"][transition][0], name
        else:
            assert unused[name]["reason"] == REASONS[why], name
            assert unused[name]["text"] == module.why(event, now), name


def first(mine, theirs):
    for at, pair in enumerate(zip(mine, theirs)):
        if pair[0] != pair[1]:
            return f"record {at}: {pair}"
    return f"{len(mine)} and {len(theirs)} records"


def main():
    asked = argparse.ArgumentParser()
    asked.add_argument("program")
    asked.add_argument("--runs", type=int, default=200)
    asked.add_argument("--module")
    asked = asked.parse_args()
    engine = wasmtime.Engine()
    folder = pathlib.Path(tempfile.mkdtemp())
    models = []
    for path in subjects(asked.program):
        page = folder / "page.html"
        command = [asked.program, "play", path, "--output", str(page)]
        written = subprocess.run(command, capture_output=True, text=True)
        if written.returncode != 0:
            # A mission without a robot has no supervisors to play; two ways are no model.
            continue
        text = page.read_text(encoding="utf-8")
        data = re.search(r'<script type="application/json" id="data">(.*?)</script>', text).group(1)
        data = json.loads(data)
        # No other command plays a part of a team.
        if data["command"]:
            models.append((path, data))
    page.unlink()
    folder.rmdir()
    bytes_ = pathlib.Path(asked.module).read_bytes() if asked.module else None
    module = wasmtime.Module(engine, bytes_ or base64.b64decode(models[0][1]["module"]))
    rng, records, done = random.Random(45), 0, {}
    for at in range(asked.runs):
        path, data = models[at % len(models)]
        rounds = data["system"] and rng.random() < 0.5
        # A store of its own: a page keeps its memory.
        it = Module((wasmtime.Store(engine), module), data)
        by_flags = data["robot"] and rng.random() < 0.5
        rounds = rounds or bool(by_flags)
        run = driven(rng, data, it) if by_flags else drawn(rng, data, it, rounds)
        words, mine, state, now = run
        if not words:
            continue
        try:
            same(asked.program, path, words, rounds, mine, state, it, now)
        except (AssertionError, subprocess.CalledProcessError) as wrong:
            sys.exit(f"{path} {'--rounds ' if rounds else ''}{' '.join(words)}: {wrong}")
        records += len(mine)
        done[path] = done.get(path, 0) + 1
    print(f"{sum(done.values())} runs of {len(done)} models: {records} records are the same")


main()
