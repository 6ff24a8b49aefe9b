"""The lists of seeded defects: read, written, shown."""
import sys
from pathlib import Path

LISTS = Path(__file__).resolve().parent
ROOT = LISTS.parent.parent
# For each crate the packages that are built for a list of it, and the test programs that may kill.
SUITES = {
    "core": (["cotama-core", "cotama-tests"], ["core/", "tests/stories"]),
    "models": (["cotama-models"], ["models/"]),
    "sim": (["cotama-sim"], ["sim/"]),
    "cli": (["cotama"], ["cli/"]),
    "verification": (["cotama-verification"], ["verification/engines"]),
    "decisional": (
        ["cotama-sim", "cotama-models"],
        ["sim/supervised", "models/supervised", "models/cotama_data"],
    ),
}
ALL = [
    "core", "models", "sim", "cli", "structural", "reductions", "explicit", "stubborn", "temporal",
    "fairness", "coverability", "tpn", "classes_ltl", "classes_ctl", "budget", "certificate",
    "decisional",
]


class Defect:
    """One paragraph of a list."""

    def __init__(self, listed, line, what):
        self.list, self.line, self.what = listed, line, what
        self.number = 0
        self.file = self.by = self.equivalent = self.open = ""
        self.old, self.new = [], []
        self.alone = False
        self.result = None
        # Where the text stands; None where it occurs once.
        self.at = None
        # Packages and programs; the engines have a list each.
        self.suite = SUITES.get(listed, SUITES["verification"])

    def texts(self):
        return "\n".join(self.old), "\n".join(self.new)


def read_list(name):
    defects = []
    for line, text in enumerate((LISTS / f"{name}.txt").read_text().splitlines(), 1):
        if text.startswith("mutant: "):
            defects.append(Defect(name, line, text[8:]))
        elif text[:2] in ("- ", "-"):
            defects[-1].old.append(text[2:])
        elif text[:2] in ("+ ", "+"):
            defects[-1].new.append(text[2:])
        elif text == "alone: yes":
            defects[-1].alone = True
        elif (key := text.split(": ", 1)[0]) in ("file", "by", "equivalent", "open"):
            setattr(defects[-1], key, text.split(": ", 1)[1])
        elif text.strip():
            sys.exit(f"{name}.txt:{line}: not a line of a list: {text}")
    return defects


def write_killers(name, defects):
    """Writes `by:` where another test kills, or none was named."""
    path = LISTS / f"{name}.txt"
    lines = path.read_text().splitlines()
    for defect in sorted(defects, key=lambda it: -it.line):
        if not defect.result or defect.result == defect.by:
            continue
        at = defect.line
        while not lines[at].startswith("- "):
            if lines[at].startswith("by: "):
                del lines[at]
            else:
                at += 1
        lines.insert(at, f"by: {defect.result}")
    path.write_text("\n".join(lines) + "\n")


def table():
    """Writes what stands below the introduction of README.md anew: each list, file by file."""
    path = LISTS / "README.md"
    text = path.read_text().split("\n## ")[0].rstrip() + "\n"
    for name in (it for it in ALL if (LISTS / f"{it}.txt").exists()):
        text += f"\n## {name}\n"
        file = None
        for defect in sorted(read_list(name), key=lambda it: it.file):
            if defect.file != file:
                file = defect.file
                text += f"\n`{file}`:\n\n"
            program, _, test = defect.by.partition(" ")
            killer = f"`{program}` `{test}`" if not test.endswith("::") else f"`{defect.by}`"
            killer = f"equivalent: {defect.equivalent}" if defect.equivalent else killer
            killer = f"survives: {defect.open}" if defect.open else killer
            known = defect.by or defect.equivalent or defect.open
            text += folded(f"- {defect.what}: {killer}" if known else f"- {defect.what}") + "\n"
    path.write_text(text)


def folded(text):
    lines = [""]
    for word in text.split(" "):
        if lines[-1].strip() and len(lines[-1]) + 1 + len(word) > 100:
            lines.append("  " + word)
        else:
            lines[-1] += (" " if lines[-1] else "") + word
    return "\n".join(lines)
