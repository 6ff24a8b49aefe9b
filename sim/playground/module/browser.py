#!/usr/bin/env python3
"""Random runs in pages themselves, in a browser without a window, held against `cotama simulate`.

    browser.py PROGRAM [--runs N] [--clicks N] [--browser FILE]

Runs are given to a page by its link: events and time, of a robot also failures and flags that come
and go. The recording that the page saves is compared with the one that PROGRAM writes of the
command that the page shows, record by record; and the marking at the end. Then clicks: anything
that can be clicked, in pages of a net, a robot and a failure. Needs `playwright` (PyPI) and a
Chromium. Status 75: there is none.
"""

import argparse
import json
import pathlib
import random
import shlex
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

from subjects import subjects

try:
    from playwright.sync_api import sync_playwright
except ImportError:
    print("no playwright")
    sys.exit(75)

WORDS = 12
# Time in ms after which a page that says nothing is wrong; machines may be busy.
PATIENCE = 120_000
CAPTURE = """
    window.saved = [];
    URL.createObjectURL = (blob) => { window.saved.push(blob.text()); return "#"; };
    HTMLAnchorElement.prototype.click = () => {};
"""
CLICKS = """async (n) => {
    let seed = 7;
    const below = (k) => {
        seed = (seed * 1103515245 + 12345) % 2147483648;
        return Math.floor((seed / 2147483648) * k);
    };
    const sorts = "#controls button:not(#copy,#record,#runs,#takeplan,#saveplan),.part,#log tr,"
        + "#rounds,#came li,#plane button";
    let all = [], done = 0, worst = 0, times = [];
    for (let at = 0; done < n; at += 1) {
        if (at % 50 === 0) {
            all = [...document.querySelectorAll(sorts)];
            if (at % 1000 === 0) await new Promise((then) => setTimeout(then));
        }
        const it = all[below(all.length)];
        const rare = { rounds: 40, start: 30, upto: 400, add: 40, fresh: 10, decider: 40 }[it.id];
        if (it.disabled || it.closest("[hidden]") || (rare && below(rare) > 0)) continue;
        const from = performance.now();
        it.dispatchEvent(new MouseEvent("click", { bubbles: true }));
        const took = performance.now() - from;
        done += 1;
        worst = Math.max(worst, took);
        if (/event|switch/.test(it.className)) times.push(took);
    }
    times.sort((a, b) => a - b);
    return { done, median: times[times.length >> 1], worst };
}"""


def quoted(name):
    return urllib.parse.quote(name, safe="")


def drawn(rng, data, rounds):
    """A run as words of a link."""
    now, words, robot = 0, [], data["robot"]
    by_flags = robot and rng.random() < 0.5
    says = [it for it in robot["says"] if it[1] not in (4, 5)] if robot else []
    events = [it[0] for it in says] if by_flags else list(range(len(data["events"])))
    for _ in range(rng.randint(1, WORDS * (3 if by_flags else 1))):
        at = now + (100 if rounds else rng.choice([0, 0, 1, 50, 100, 1000, 5000, 60000]))
        toggles = ""
        if by_flags and rng.random() < 0.4:
            toggles = f"!m{rng.randrange(len(robot['failures']))}"
        if by_flags and rng.random() < 0.1:
            toggles += f"!f{rng.randrange(len(robot['flags']))}"
        if events and rng.random() < (0.4 if by_flags else 0.8):
            event = rng.choice(events)
            name = data["events"][event][0]
            is_first = next(i for i, it in enumerate(data["events"]) if it[0] == name) == event
            words.append(f"{quoted(name) if is_first else f':{event}'}@{at}{toggles}")
        else:
            at += 0 if rounds or at > now else 1
            words.append(f"+{at - now}{toggles}")
        now = at
    return words


def recorded(page):
    before = page.evaluate("saved.length")
    page.evaluate("document.getElementById('record').click()")
    lines = page.evaluate("(at) => saved[at]", before).splitlines()
    return [json.loads(it) for it in lines]


def compared(page, program, data, words, rounds, folder):
    """Plays a run in the page and by the program; returns how many records are the same."""
    link = ("rounds=100&" if rounds else "") + "run=" + ",".join(words)
    page.evaluate(
        "(it) => { document.getElementById('said').textContent = '';"
        " if (location.hash === '#' + it) location.hash = ''; location.hash = it; }",
        link,
    )
    said = f"step {len(words)} of {len(words)}"
    page.wait_for_function(
        "(it) => document.getElementById('steps').textContent === it"
        " && document.getElementById('said').textContent.startsWith('The run of the link')",
        arg=said,
        polling=20,
        timeout=PATIENCE,
    )
    mine = recorded(page)
    shown = page.evaluate("document.getElementById('command').textContent")
    command = [program, *shlex.split(shown)[1:]]
    at = command.index("simulate") + 2
    trace = folder / "run.jsonl"
    command[at:at] = ["--json", "--trace", str(trace)]
    answer = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    theirs = [json.loads(it) for it in trace.read_text(encoding="utf-8").splitlines()]
    keys = ("schema", "t_ms", "round", "event", "ignored", "fired", "end")
    plain = lambda all: [{key: it[key] for key in keys if key in it} for it in all]
    if not rounds:
        mine, theirs = plain(mine), plain(theirs)
    for number, pair in enumerate(zip(plain(mine), plain(theirs))):
        assert pair[0] == pair[1], f"{shown}: record {number}: {pair}"
    assert len(mine) == len(theirs), f"{shown}: {len(mine)} and {len(theirs)} records"
    marked = page.evaluate(
        "[...document.querySelectorAll('#marking li')].map((it) => it.textContent.replace('✉ ', ''))"
    )
    hidden = {it[0] for it in data["places"] if not it[1]}
    holds = answer["marking"].items()
    wanted = [k + (f" × {v}" if v > 1 else "") for k, v in holds if v and k not in hidden]
    assert marked == wanted, f"{shown}: {marked} and {wanted}"
    return len(mine)


def shown(browser, file, wrong):
    """Opens a page; all that it says on the console goes to `wrong`."""
    page = browser.new_page()
    page.add_init_script(CAPTURE)
    page.on("console", lambda it: wrong.append(it.text))
    page.on("pageerror", lambda it: wrong.append(str(it)))
    page.goto(file.as_uri())
    page.wait_for_function("document.documentElement.dataset.ready", timeout=PATIENCE)
    return page


def main():
    asked = argparse.ArgumentParser()
    asked.add_argument("program")
    asked.add_argument("--runs", type=int, default=200)
    asked.add_argument("--clicks", type=int, default=2000)
    asked.add_argument("--browser", default=shutil.which("chromium"))
    asked = asked.parse_args()
    if not asked.browser:
        print("no Chromium")
        sys.exit(75)
    folder = pathlib.Path(tempfile.mkdtemp())
    rng, records, runs, wrong = random.Random(45), 0, 0, []
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=asked.browser, args=["--no-sandbox"])
        opened = []
        for name in subjects(asked.program):
            file = folder / "page.html"
            command = [asked.program, "play", name, "--output", str(file)]
            if subprocess.run(command, capture_output=True).returncode == 0:
                opened.append((name, file.rename(folder / f"{len(opened)}.html")))
        each = -(-asked.runs // len(opened))
        for name, file in opened:
            page = shown(browser, file, wrong)
            data = json.loads(page.text_content("#data"))
            # No other command plays a part of a team.
            for _ in range(each if data["command"] else 0):
                rounds = bool(data["robot"]) or data["system"] and rng.random() < 0.5
                words = drawn(rng, data, rounds)
                records += compared(page, asked.program, data, words, rounds, folder)
                runs += 1
            page.close()
        print(f"{runs} runs of {len(opened)} models in the browser: {records} records are the same")
        for name in ("door", "delivery", "shift"):
            file = next(it[1] for it in opened if it[0] == name)
            page = shown(browser, file, wrong)
            said = page.evaluate(CLICKS, asked.clicks)
            is_broken = page.evaluate("!document.getElementById('broken').hidden")
            assert not is_broken, page.text_content("#broken")
            print(f"{name}: {said['done']} clicks, an event in {said['median']:.2f} ms (median), "
                  f"at most {said['worst']:.0f} ms")
            page.close()
        browser.close()
    shutil.rmtree(folder)
    if wrong:
        sys.exit(f"{len(wrong)} messages on the console, first: {wrong[0]}")


main()
