"""Explores every path of harnesses on machine code: prove.py IMAGE [NAME...]

A harness holds when no input leads to a panic and no path was given up. What makes that a proof and
no search: an address with more than 4,096 values is an error (the tool would pick one in silence);
a path that ends in an error, a jump to anywhere or the limit of time is "unknown". Names that begin
with `proof_canary_` must fail. PROOF_SECONDS (default 120) is the limit for each. Prints the names
of those that hold to the file in PROOF_HOLDS. Exit status 1 when one is not as it must be.
"""

import logging
import multiprocessing
import os
import sys
import time

logging.disable(logging.CRITICAL)  # before angr says what it lacks, and can do without

import angr
import claripy
from angr.concretization_strategies import SimConcretizationStrategyRange

SECONDS = float(os.environ.get("PROOF_SECONDS", 120))
ADDRESSES = 4096


class AnyWord(angr.SimProcedure):
    """A symbol for any 32 bits; those above them in the register are anyone's."""

    def run(self):
        word = claripy.BVS("input", self.state.arch.bits)
        self.state.globals["inputs"] = self.state.globals.get("inputs", ()) + (word[31:0],)
        return word


class Reject(angr.SimProcedure):
    """An assumption does not hold."""

    NO_RET = True

    def run(self):
        self.state.globals["end"] = "rejected"
        self.exit(0)


class Panic(angr.SimProcedure):
    """An assertion does not hold, or arithmetic overflows."""

    NO_RET = True

    def run(self):
        self.state.globals["end"] = "panic"
        self.exit(1)


class Cover(angr.SimProcedure):
    """A case that counts comes up on this path."""

    def run(self, text, length):
        text = self.state.memory.load(text, self.state.solver.eval_one(length))
        text = self.state.solver.eval(text, cast_to=bytes).decode()
        self.state.globals["covers"] = self.state.globals.get("covers", ()) + (text,)


HOOKS = {
    "proof_any32": AnyWord,
    "proof_reject": Reject,
    "proof_covered": Cover,
    "a_panic_can_be_reached": Panic,
}


def explore(project, name):
    """The verdict on a harness, and what was seen."""
    entry = project.loader.find_symbol(name).rebased_addr
    zeros = {angr.options.ZERO_FILL_UNCONSTRAINED_REGISTERS}
    state = project.factory.call_state(entry, add_options=zeros)
    state.memory.read_strategies = [SimConcretizationStrategyRange(ADDRESSES)]
    state.memory.write_strategies = [SimConcretizationStrategyRange(ADDRESSES)]
    paths = project.factory.simgr(state)
    ends, covers = {"returned": 0, "rejected": 0}, set()
    while paths.active:
        paths.step()
        if paths.errored:
            return "unknown", f"a path was given up: {paths.errored[0].error}"
        if paths.unconstrained:
            return "unknown", "a jump to anywhere"
        for path in paths.deadended:
            end = path.globals.get("end", "returned")
            if end == "panic":
                inputs = [path.solver.eval(it) for it in path.globals.get("inputs", ())]
                return "fails", f"a panic with the inputs {inputs}"
            ends[end] += 1
            covers.update(path.globals.get("covers", ()))
        paths.drop(stash="deadended")
    if ends["returned"] == 0:
        return "fails", "every path is rejected"
    seen = f"{ends['returned']} paths, {ends['rejected']} rejected"
    return "holds", f"{seen}, covers: {', '.join(sorted(covers)) or 'none'}"


def within_time(project, name):
    """The same in a process of its own: a question to the solver can only be killed."""
    here, there = multiprocessing.Pipe(duplex=False)
    work = multiprocessing.get_context("fork").Process(
        target=lambda: there.send(explore(project, name))
    )
    work.start()
    there.close()
    try:
        return here.recv() if here.poll(SECONDS) else ("unknown", f"{SECONDS:.0f} s have passed")
    except EOFError:
        return "unknown", "the process ended"
    finally:
        work.kill()


def main(image, names):
    project = angr.Project(image, auto_load_libs=False)
    for symbol, hook in HOOKS.items():
        project.hook(project.loader.find_symbol(symbol).rebased_addr, hook())
    symbols = project.loader.main_object.symbols
    every = {it.name for it in symbols if it.is_function and it.name.startswith("proof_")}
    wrong, holds = 0, []
    for name in names or sorted(every - HOOKS.keys()):
        start = time.time()
        verdict, seen = within_time(project, name)
        short = name.removeprefix("proof_").replace("__", "::")
        canary = name.startswith("proof_canary_")
        if verdict == "holds" and not canary:
            holds.append(short)
        is_right = verdict == ("fails" if canary else "holds")
        wrong += not is_right
        note = " as it must" if canary and is_right else "" if is_right else " (WRONG)"
        print(f"{short}: {verdict}{note}: {seen}, {time.time() - start:.1f} s", flush=True)
    if "PROOF_HOLDS" in os.environ:
        with open(os.environ["PROOF_HOLDS"], "w", encoding="utf-8") as file:
            file.writelines(f"{it}\n" for it in sorted(holds))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
