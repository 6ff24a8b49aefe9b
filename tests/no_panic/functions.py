#!/usr/bin/env python3
"""The public functions of a crate, and those that the roots call: a name a line, with its type.

    functions.py public CRATE src/lib.rs
    functions.py called CRATE... <RELOCATIONS

`public` reads the source as it is compiled for a target: it walks from `lib.rs` along the `mod`
lines, and passes over modules, items and methods below a `#[cfg]` that asks for a feature, for
tests or for proofs (`not(...)` of one of them holds). A function counts that is `pub` without
`(crate)`, alone or in an `impl` of a type; so does one that a macro of the crate makes, wherever
the macro is invoked. Those below `#[doc(hidden)]` do not, nor do methods of traits.
What `net!` and `system!` make is none of the list: check.sh asks for roots of each of them.

`called` reads the demangled relocations of a build without optimization, in which each call of a
function is one to its symbol: a function counts that a root, or a closure or observer of this
crate, calls itself. So what the compiler resolved is compared, with its type, not the text of the
roots. A function that a root only hands on as a value is called elsewhere, and does not count.
"""

import re
import sys
from os.path import commonprefix
from pathlib import Path

CFG = re.compile(r"\s*#\[cfg\((.*)\)\]")
OFF = r"(?:feature = \"\w+\"|test|kani)"
FUNCTION = re.compile(r" *pub (?:const |unsafe )*fn (\w+)")
TYPE = re.compile(r" *pub (?:struct|enum|union) (\$?\w+)")


def is_off(cfg):
    """Whether a condition fails without features, tests and proofs; it must be about them."""
    if not re.fullmatch(rf"(?:not\()?(?:all\(|any\()?{OFF}(?:, {OFF})*\)*", cfg):
        sys.exit(f"#[cfg({cfg})]: this walk does not know whether that holds")
    return not cfg.startswith("not(")


def self_type(header):
    """The type of `impl<..> path::Type<..> where ..`; None for one of a trait."""
    depth, flat = 0, ""
    for at, sign in enumerate(header):
        depth += (sign == "<") - (sign == ">" and header[at - 1] != "-")
        flat += sign if depth == 0 and sign != ">" else ""
    words = flat.split("{")[0].split(" where ")[0].split()[1:]
    return None if "for" in words else words[-1].split("::")[-1]


class Crate:
    """What a walk finds: types and macros in its first pass, functions in its second."""

    def __init__(self, name):
        self.name, self.types, self.macros, self.found = name, {}, {}, set()

    def walk(self, file, folder, path):
        lines = iter(file.read_text().splitlines())
        state = {"of": None, "macro": None, "off": False}
        for line in lines:
            cfg = CFG.match(line)
            state["off"] |= bool(cfg) and is_off(cfg[1]) or line.strip() == "#[doc(hidden)]"
            if line.strip().startswith(("#", "//")) or not line.strip():
                continue
            self.line(line, lines, folder, path, state)
            state["off"] = False

    def line(self, line, lines, folder, path, state):
        indent = len(line) - len(line.lstrip())
        if state["off"]:
            skip(line, lines, indent)
        elif module := re.match(r"(?:pub(?:\(\w+\))? )?mod (\w+);", line):
            below = folder / module[1]
            file = folder / f"{module[1]}.rs"
            self.walk(file if file.exists() else below / "mod.rs", below, [*path, module[1]])
        elif macro := re.match(r"macro_rules! (\w+)", line):
            state["macro"] = self.macros.setdefault(macro[1], set())
        elif line == "}":
            state["macro"] = state["of"] = None
        elif line.lstrip().startswith("impl"):
            while "{" not in line and ";" not in line:
                line += " " + next(lines).strip()
            state["of"] = None if line.endswith("}") else self_type(line.strip())
            state["trait"] = state["of"] is None
            state["indent"] = indent
        elif line == " " * state.get("indent", 0) + "}":
            state["of"], state["trait"] = None, False
        elif declared := TYPE.match(line):
            self.declare(state["macro"], path, declared[1])
        elif function := FUNCTION.match(line):
            self.add(state["macro"], path, state["of"], function[1])
        elif called := re.match(r" *(\w+)! ?[{(]", line):
            self.invoke(called[1], line, lines, indent, path, state["macro"])

    def declare(self, macro, path, name):
        if macro is not None:
            macro.add((name, None))
        else:
            self.types.setdefault(name, set()).add("::".join(path))

    def add(self, macro, path, of, name):
        if macro is not None:
            macro.add((of, name))
        else:
            self.found.add((tuple(path), of, name))

    def invoke(self, called, line, lines, indent, path, macro):
        made = self.macros.get(called)
        if not made:
            return
        # The type stands on a line of its own, a set of them is followed by its integer.
        given = {}
        while not line.startswith(" " * indent + ("}" if "{" in line[:40] else ")")):
            if name := re.match(r" *([A-Z]\w*),$", line):
                given.setdefault("one", name[1])
            elif name := re.match(r" *([A-Z]\w*)\(u\d+\) \{", line):
                given.setdefault("many", name[1])
            line = next(lines)
            if re.match(" " * indent + r"[})]", line):
                break
        for of, name in made:
            if of and of.startswith("$"):
                of = given["many" if of == "$set" else "one"]
            if name is None:
                self.declare(macro, path, of)
            else:
                self.add(macro, path, of, name)

    def public(self):
        for path, of, name in self.found:
            where = "::".join(path)
            if of:
                homes = self.types.get(of, set())
                if where not in homes:
                    where = nearest(where, homes, of)
                where += f"::{of}"
            yield f"{where}::{name}"


def nearest(where, homes, of):
    """The module that declares a type: of several the one nearest to where it is used."""
    shared = {it: len(commonprefix([it.split("::"), where.split("::")])) for it in homes}
    best = [it for it in homes if shared[it] == max(shared.values())]
    if len(best) != 1:
        sys.exit(f"{where}: of which {of} is this? {sorted(homes)}")
    return best[0]


def skip(line, lines, indent):
    """Passes over an item: to the bracket that closes it, or the line that ends it."""
    while not line.endswith((";", ",")) and "}" not in line and not line.endswith("{"):
        line = next(lines)
    if line.endswith("{"):
        for line in lines:
            if re.match(" " * indent + r"\}", line):
                return


def public(name, root):
    crate = Crate(name)
    for _ in range(2):
        crate.found.clear()
        crate.walk(Path(root), Path(root).parent, [name])
    return set(crate.public())


def called(crates):
    ours, found = False, set()
    for line in sys.stdin:
        if section := re.match(r"RELOCATION RECORDS FOR \[(.*)\]", line):
            ours = re.search(r"\.text\.\S* (root_|open_|<?cotama_no_panic::)", section[1])
        elif ours and (value := re.match(r"[0-9a-f]+ +R_\S+ +(.*)", line)):
            if name := plain(value[1]):
                found.add(name)
    return {it for it in found if it.split("::")[0] in crates}


def plain(symbol):
    """A demangled symbol without generics, as path::Type::function; None for those of a trait."""
    symbol = re.sub(r"(::h[0-9a-f]{16})?([-+]0x[0-9a-f]+)?$", "", symbol.strip())
    if own := re.search(r"<impl (.*)>::(\w+)$", symbol):
        symbol = f"{own[1]}::{own[2]}"
    if symbol.startswith("<") and (own := re.fullmatch(r"<(.*)>::(\w+)", symbol)):
        symbol = f"{own[1]}::{own[2]}"
    if " as " in symbol or " for " in symbol:
        return None
    while (less := re.sub(r"(::)?<[^<>]*>", "", symbol)) != symbol:
        symbol = less
    return symbol


if __name__ == "__main__":
    command, *rest = sys.argv[1:]
    names = public(*rest) if command == "public" else called(rest)
    print(*sorted(names), sep="\n")
