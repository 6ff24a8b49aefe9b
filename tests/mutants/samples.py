"""Lists of generated mutants: what is drawn, how many were caught, which were missed and why."""
import math
import sys

from lists import LISTS, folded

FOLDER = LISTS / "generated"
COUNTS = ["caught", "too long", "missed", "not built"]
HEAD = ["crate", "files", "but", "sample", "program", "compiled"]


class Missed:
    """A mutant that no test noticed, and why that may be so."""

    def __init__(self, file, what, source):
        self.file, self.what, self.source = file, what, source
        self.why = []

    def key(self):
        return self.file, self.what, self.source


class List:
    """A list of `generated/`."""

    def __init__(self, name):
        self.name, self.path = name, FOLDER / f"{name}.txt"
        self.head, self.files, self.but, self.programs, self.missed = [], [], [], [], []
        self.crate, self.taken, self.seed, self.all, self.counts = "", 0, 0, 0, {}
        self.compiled, self.first = "", (0, 0)
        for number, line in enumerate(self.path.read_text().splitlines(), 1):
            key, _, value = line.partition(": ")
            if key in HEAD:
                self.head.append(line)
            if key == "crate":
                self.crate = value
            elif key in ("files", "but"):
                getattr(self, key).append(value)
            elif key == "sample":
                self.taken, self.seed = map(int, value.split())
            elif key == "program":
                program, *names = value.split()
                self.programs.append((program, names))
            elif key == "compiled":
                self.compiled = value
            elif key == "mutants":
                self.all = int(value)
            elif key in COUNTS:
                self.counts[key] = int(value)
            elif key == "first":
                self.first = tuple(map(int, value.split(" of ")))
            elif key == "survivor":
                file, what = value.split(": ", 1)
                self.missed.append(Missed(file, what, ""))
            elif line.startswith("- "):
                self.missed[-1].source = line[2:]
            elif key in ("equivalent", "open"):
                self.missed[-1].why.append(line)
            elif line.strip():
                sys.exit(f"{self.path}:{number}: not a line of a list: {line}")

    def crates(self):
        return {self.crate} | {it.split("/")[0] for it, _ in self.programs}

    def known(self, defect):
        """What is kept of a mutant that was missed."""
        key = defect.file, defect.what, defect.source
        return next((it for it in self.missed if it.key() == key), None)

    def write(self, found, counts, missed, again):
        """Writes the counts and who was missed; when only those that were missed are run again,
        the others stay caught."""
        if again:
            before = dict(self.counts)
            self.counts = {it: before.get(it, 0) + counts[it] for it in COUNTS}
            self.counts["missed"] = counts["missed"]
        else:
            self.all, self.counts = found, counts
            self.first = self.killed(), self.viable()
        self.missed = [self.known(it) or Missed(it.file, it.what, it.source) for it in missed]
        self.store()

    def store(self):
        """Writes the list as it is known."""
        lines = [*self.head, "", f"mutants: {self.all}"]
        lines += [f"{it}: {self.counts[it]}" for it in COUNTS]
        lines.append("first: {} of {}".format(*self.first))
        for it in self.missed:
            lines += ["", f"survivor: {it.file}: {it.what}", f"- {it.source}", *it.why]
        self.path.write_text("\n".join(lines) + "\n")

    def not_built(self, defect):
        """One that was missed is no mutant, as the library is not built with it alone."""
        self.first = self.first[0], self.first[1] - 1
        self.counts["missed"] -= 1
        self.counts["not built"] += 1
        self.missed.remove(self.known(defect))
        self.store()

    def shorten(self, taken):
        """Makes it a sample of fewer."""
        at = next(n for n, it in enumerate(self.head) if it.startswith("sample: "))
        self.taken, self.head[at] = taken, f"sample: {taken} {self.seed}"

    def killed(self):
        return self.counts["caught"] + self.counts["too long"]

    def viable(self):
        return self.killed() + self.counts["missed"]


def tail(successes, trials, chance):
    """The probability of at most so many successes."""
    if chance <= 0:
        return 1.0
    if chance >= 1:
        return 1.0 if successes >= trials else 0.0
    logs = (
        math.lgamma(trials + 1) - math.lgamma(it + 1) - math.lgamma(trials - it + 1)
        + it * math.log(chance) + (trials - it) * math.log1p(-chance)
        for it in range(successes + 1)
    )
    return math.fsum(math.exp(it) for it in logs)


def interval(successes, trials):
    """The exact 95 % interval of Clopper and Pearson (1934), in percent."""

    def root(below):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if below(middle) else (low, middle)
        return 100 * low

    least = 0.0 if successes == 0 else root(lambda it: 1 - tail(successes - 1, trials, it) < 0.025)
    most = 100.0 if successes == trials else root(lambda it: tail(successes, trials, it) > 0.025)
    return least, most


def table():
    """Writes `generated/README.md` below its introduction anew."""
    path = FOLDER / "README.md"
    text = path.read_text().split("\n| ")[0].rstrip() + "\n"
    names = sorted(it.stem for it in FOLDER.glob("*.txt"))
    text += "\n| list | mutants | drawn | built | killed at first | of all, at 95 % | equivalent "
    text += "| of others | killed now |\n| --- " + "| ---: " * 8 + "|\n"
    lists = [List(it) for it in names]
    for it in (it for it in lists if it.counts):
        drawn = min(it.taken or it.all, it.all)
        (first, built), now = it.first, it.killed()
        share = "all are drawn"
        if drawn < it.all:
            share = "{:.1f} to {:.1f} %".format(*interval(first, built))
        same = sum("equivalent: " in "".join(missed.why) for missed in it.missed)
        cells = [it.name, it.all, drawn, built, f"{first} ({100 * first / built:.1f} %)", share,
                 same, f"{100 * first / (built - same):.1f} %",
                 f"{now} ({100 * now / built:.1f} %)"]
        text += "| " + " | ".join(str(cell) for cell in cells) + " |\n"
    for it in (it for it in lists if it.missed):
        text += f"\n## {it.name}\n\n"
        for missed in it.missed:
            why = "; ".join(missed.why) or "not looked at yet"
            text += folded(f"- `{missed.file}`, `{missed.source}`: {missed.what}: {why}") + "\n"
    path.write_text(text)
