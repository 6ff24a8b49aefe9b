"""Sources with many defects, each chosen at run time, and whom the compiler's errors are about."""
import re

from lists import ROOT

VARIABLE = "COTAMA_DEFECT"
MODULE = f"""
mod defect {{
    extern crate std;
    use std::sync::atomic::{{AtomicU32, Ordering::Relaxed}};
    static CHOSEN: AtomicU32 = AtomicU32::new(u32::MAX);
    /// The defect that was chosen; 0 is none.
    #[inline]
    pub(crate) fn chosen() -> u32 {{
        match CHOSEN.load(Relaxed) {{ u32::MAX => choose(), number => number }}
    }}
    #[cold]
    fn choose() -> u32 {{
        let number = std::env::var("{VARIABLE}").ok().and_then(|it| it.parse().ok()).unwrap_or(0);
        CHOSEN.store(number, Relaxed);
        number
    }}
}}
"""
# Where a constant calls a function, the compiler computes without a defect and the program with it.
# No stable Rust tells the two apart: the crates that have this are built with `RUSTC_BOOTSTRAP`.
FEATURES = "#![allow(internal_features)]\n#![feature(core_intrinsics, const_eval_select)]\n"
CONST_MODULE = MODULE.replace("pub(crate) fn chosen()", "fn at_run_time()").rstrip()[:-1] + """
    const fn none() -> u32 { 0 }
    #[inline]
    pub(crate) const fn chosen() -> u32 {
        core::intrinsics::const_eval_select((), none, at_run_time)
    }
}
"""

TOKEN = re.compile(
    r"""//[^\n]*|/\*.*?\*/|b?r(?P<h>\#*)".*?"(?P=h)|b?"(?:\\.|[^"\\])*"
    |b?'(?:\\(?:u\{[^}]*\}|x..|.)|[^\\'])'|'\w+|\w+|\S""",
    re.S | re.X,
)


def functions(text):
    """The outermost functions: where their `const` is or None, name, where `{` is, after `}`."""
    found, depth, wanted, body, before, head_const = [], 0, None, None, [], None
    for token in TOKEN.finditer(text):
        word = token.group()
        if word.startswith(("//", "/*")):
            continue
        if body is None and wanted is None and before[-1:] == ["fn"] and re.match(r"[a-z_]", word):
            wanted = (depth, word, head_const)
        if word == "const":
            head_const = token.start()
        elif word not in ("fn", "unsafe", "extern") and before[-1:] != ["fn"]:
            head_const = None
        if word in "([{":
            if word == "{" and body is None and wanted is not None and wanted[0] == depth:
                body = token.start()
            depth += 1
        elif word in ")]}":
            depth -= 1
            if body is not None and depth == wanted[0]:
                found.append((wanted[2], wanted[1], body, token.end()))
                body = wanted = None
        elif word == ";" and body is None and wanted is not None and wanted[0] == depth:
            wanted = None
        before = [word]
    return found


def original(defect):
    return (ROOT / defect.file).read_text()


def place(text, defect):
    """Where the text of a defect stands in its file."""
    return text.index(defect.texts()[0]) if defect.at is None else defect.at


def seeded(text, defect, begin=0):
    """The file, or its part from `begin` on, with the defect."""
    old, new = defect.texts()
    at = text.index(old) if defect.at is None else defect.at - begin
    return text[:at] + new + text[at + len(old) :]


def with_choice(text, defects, constant=False):
    """The text of a file with all these defects, each chosen at run time. Those that are outside of
    functions are marked as alone, and left out. A `const fn` is one no longer, but when `constant`.
    """
    of_function = {}
    bodies = functions(text)
    for defect in defects:
        old, _ = defect.texts()
        at = place(text, defect)
        for body in bodies:
            if body[2] < at and at + len(old) < body[3]:
                of_function.setdefault(body, []).append(defect)
                break
        else:
            defect.alone = True
    for (const, _, start, end), those in sorted(of_function.items(), key=lambda it: -it[0][2]):
        body = text[start:end]
        choice = "{ match crate::defect::chosen() {\n"
        for defect in those:
            choice += f"{defect.number} =>\n{seeded(body, defect, start)}\n"
        text = text[:start] + choice + "_ => " + body + "\n}}" + text[end:]
        if const is not None and not constant:
            text = text[:const] + "     " + text[const + 5 :]
    return text


def blamed(errors, defects, copy):
    """The defects that the compiler's errors are about."""
    guilty = set()
    for error in errors:
        named = set()
        if (error.get("code") or {}).get("code") == "E0015":
            paths = re.findall(r"`([^`]+)`", error["message"])
            named = {it.split("::")[-1].split("<")[0] for it in paths}
        spans = [it for it in error["spans"]]
        for child in error["children"]:
            spans += child["spans"]
        for span in list(spans):
            while span.get("expansion"):
                span = span["expansion"]["span"]
                spans.append(span)
        for span in spans:
            path = (copy / span["file_name"]).resolve()
            try:
                name = str(path.relative_to(copy.resolve()))
            except ValueError:
                continue
            there = [it for it in defects if it.file == name and not it.alone]
            if there and span["is_primary"]:
                guilty.update(at_line(path.read_text(), span["line_start"], there))
        if named:
            guilty.update(it for it in defects if not it.alone and name_of(it) in named)
    return guilty


def name_of(defect):
    text = original(defect)
    at = place(text, defect)
    return next((it[1] for it in functions(text) if it[2] < at < it[3]), "")


def at_line(text, line, defects):
    """The defect whose copy of a body has this line; all of the function outside of copies."""
    at = sum(len(it) + 1 for it in text.split("\n")[: line - 1])
    numbers = {it.number: it for it in defects}
    for const, _, start, end in functions(text):
        choices = [
            (start + it.start(), int(it.group(1)))
            for it in re.finditer(r"^(\d+) =>\n", text[start:end], re.M)
        ]
        if not choices or not start <= at < end:
            continue
        ends = [it for it, _ in choices[1:]] + [text.rindex("\n_ => {", start, end)]
        for (begin, number), stop in zip(choices, ends):
            if begin <= at < stop and number in numbers:
                return [numbers[number]]
        return [numbers[number] for _, number in choices if number in numbers]
    return []
