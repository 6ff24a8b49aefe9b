#!/usr/bin/env python3
"""The deepest stack of an image for Cortex-M, from its disassembly.

    firmware/stack.py IMAGE OBJDUMP [ENTRY ...]

For each function all that it takes from the stack is added up, whether it is given back or not, and
the deepest chain of calls is found. Interrupts are added to it: the frame that the processor pushes
(104 bytes with the floating-point unit) and the deepest chain of each handler, since each may
interrupt the others. Where a call through a register may go is listed below, by the trait that is
called; such a call that is not listed, an address in a constant that no list has, and recursion are
errors: nothing can be said then. Prints the bytes, then the chain, a line
each. Exit status 1 when nothing can be said.
"""

import re
import subprocess
import sys

FRAME = 104
CASCADE = "cotama_nets::player::cascade::"
OBSERVER = "cotama_nets::player::observer::"
# Who calls through a register, and what: parts of names. The player's cascade tells a closure what
# happens (`dyn FnMut`); one of them shows it to the observer that stands for anyone (`dyn Observer`),
# which passes it on to the observer of the caller.
DYNAMIC = [
    ((CASCADE, "::show"), ("<" + OBSERVER + "Anyone<",)),
    ((CASCADE, ""), ("::whole::{{closure}}", "FnOnce::call_once{{vtable.shim}}")),
    (
        ("<" + OBSERVER + "Anyone<", ""),
        ("<() as " + OBSERVER, OBSERVER + "Observer::on_", "decider::Acts<"),
    ),
]
HEADER = re.compile(r"^([0-9a-f]+) <(.*)>:$")
LINE = re.compile(r"^\s+([0-9a-f]+):\t(.*)$")
TARGET = re.compile(r"\b([0-9a-f]+) <([^>]*)>")


def registers(list_):
    """How many registers a list like {r4, r5-r7, lr} names."""
    count = 0
    for one in list_.split(","):
        ends = re.findall(r"[a-z]+(\d+)", one.strip())
        if "-" in one and len(ends) == 2:
            count += int(ends[1]) - int(ends[0]) + 1
        else:
            count += 1
    return count


def number(text):
    return int(text, 0)


def taken(code):
    """The bytes that an instruction takes from the stack."""
    words = code.split("\t")
    name, rest = words[0].split(".")[0], " ".join(words[1:])
    if name == "push" or (name in ("stmdb", "stmfd") and rest.startswith("sp!")):
        return 4 * registers(rest[rest.index("{") + 1 : rest.index("}")])
    if name in ("vpush", "vstmdb") and "{" in rest:
        width = 8 if "{d" in rest else 4
        return width * registers(rest[rest.index("{") + 1 : rest.index("}")])
    if name in ("sub", "subw", "subs") and rest.startswith("sp,"):
        amount = re.search(r"#(\d+|0x[0-9a-f]+)", rest)
        if not amount:
            raise ValueError(f"takes an unknown amount: {code}")
        return number(amount.group(1))
    if name in ("str", "strd"):
        amount = re.search(r"\[sp, #-(\d+)\]!", rest)
        return number(amount.group(1)) if amount else 0
    return 0


def read(image, objdump):
    """Of each function by its address: name, bytes, functions it calls."""

    def run(*options):
        return subprocess.run(
            [objdump, *options, image], capture_output=True, text=True, check=True
        ).stdout

    functions, indirect, constants, current = {}, set(), set(), None
    for line in run("-d", "-C", "--no-show-raw-insn").splitlines():
        header = HEADER.match(line)
        if header:
            current = int(header.group(1), 16)
            functions[current] = [header.group(2), 0, set()]
            continue
        match = LINE.match(line)
        if not match or current is None:
            continue
        code = match.group(2).split(";")[0].split("@")[0].strip()
        function = functions[current]
        word = re.match(r"\.word\t0x([0-9a-f]+)", code)
        if word:
            constants.add(int(word.group(1), 16))
        function[1] += taken(code)
        name = code.split("\t")[0].split(".")[0]
        target = TARGET.search(match.group(2))
        if name == "blx" or (name == "bx" and "lr" not in code and "pc" not in code):
            indirect.add(current)
        elif name.startswith("b") and target and "+" not in target.group(2):
            function[2].add(int(target.group(1), 16))
    # And in tables, but for the vector table: those are interrupts.
    for line in run("-s", "-j", ".rodata", "-j", ".data").splitlines():
        match = re.match(r"^ [0-9a-f]+ ((?:[0-9a-f]{2,8} ){1,4})", line)
        for word in match.group(1).split() if match else []:
            if len(word) == 8:
                constants.add(int.from_bytes(bytes.fromhex(word), "little"))
    addresses = {at for at in functions if at | 1 in constants}
    listed = set()
    for at in indirect:
        name = functions[at][0]
        parts = next((to for (has, ends), to in DYNAMIC if has in name and name.endswith(ends)), None)
        if parts is None:
            raise ValueError(f"{name} calls through a register")
        known = {it for it in addresses if any(part in functions[it][0] for part in parts)}
        functions[at][2] |= known
        listed |= known
    # A number may look like an address; a function that nobody calls by name is really meant.
    direct = set().union(*(calls for _, _, calls in functions.values()))
    # The hardware alone calls Reset, at the lowest address: a small number in any table.
    for at in addresses - listed - direct - {min(functions)}:
        raise ValueError(f"who calls {functions[at][0]} through a register?")
    return functions


def deepest(functions, start):
    """The deepest chain of calls from a function: its bytes and the chain."""
    known, path = {}, []

    def visit(at):
        if at in known:
            return known[at]
        if at in path:
            names = [functions[it][0] for it in path[path.index(at) :]]
            raise ValueError("recursion: " + " > ".join(names))
        path.append(at)
        name, own, calls = functions[at]
        best = (0, [])
        for call in sorted(calls - {at}):
            if call in functions:
                best = max(best, visit(call), key=lambda it: it[0])
        path.pop()
        known[at] = (own + best[0], [(name, own)] + best[1])
        return known[at]

    return visit(start)


def main():
    image, objdump, *entries = sys.argv[1:]
    try:
        functions = read(image, objdump)
        by_name = {name: at for at, (name, _, _) in functions.items()}
        chains = [deepest(functions, by_name[it]) for it in entries or ["main"]]
    except (ValueError, KeyError) as error:
        print(f"{image}: nothing can be said: {error}", file=sys.stderr)
        return 1
    total = sum(it[0] for it in chains) + FRAME * (len(chains) - 1)
    print(total)
    for _, chain in chains:
        for name, own in chain:
            print(f"  {own:6} {name}")
    return 0


sys.setrecursionlimit(10_000)
sys.exit(main())
