#!/usr/bin/python3
"""Tracing off costs nothing: the untraced core and a copy of it with the trace lines deleted take the same number of instructions, within 1 %
(counted by valgrind's callgrind). What tracing on costs an event is printed; time decides nothing.  Usage: trace_cost_test.py COMPILER LIBRARY..."""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def end_of_statement(text, at):
    """The place after the statement that begins at `at`: a block in braces, or up to its semicolon."""
    while text[at].isspace():
        at += 1
    depth = 0
    block = text[at] == "{"
    while True:
        depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(text[at], 0)
        at += 1
        if depth == 0 and (text[at - 1] == "}" if block else text[at - 1] == ";"):
            return at


def without_trace(text):
    """Deletes `if constexpr (traced<Trace>) STATEMENT` and calls of `trace_`. Returns the rest and how many there were."""
    deleted = 0
    for pattern, skip in ((r"if constexpr \(traced<Trace>\)", True), (r"(?<![\w.])trace_\(", False)):
        while True:
            found = [m for m in re.finditer(pattern, text) if skip or text[:m.start()].rstrip()[-1] in ";{})"]
            if not found:
                break
            start, after = found[0].start(), found[0].end()
            text = text[:start] + ";" + text[end_of_statement(text, after if skip else start):]
            deleted += 1
    return text, deleted


def compiled(compiler, tree, source, output):
    """One file, against the core in `tree`: all that is measured is templates in headers."""
    subprocess.run([compiler, "-std=c++20", "-O2", "-DNDEBUG", "-ffp-contract=off", "-fno-math-errno", "-w", f"-I{tree}", f"-I{ROOT}", "-isystem", "/usr/include/eigen3", "-c",
                    str(ROOT / "tests/trace_cost" / source), "-o", str(output)], check=True)
    return output


def linked(compiler, libraries, objects, program):
    """Of templates that several objects have, the first object's count: the driver, the same for both programs, comes last."""
    subprocess.run([compiler, *objects, *libraries, "-lqhull_r", "-lgmpxx", "-lgmp", "-o", str(program)], check=True)
    return program


def instructions(program, folder):
    out = folder / "callgrind"
    run = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", "--toggle-collect=gjkdbg::measured*", str(program), "count", "20"], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"callgrind failed: {run.stderr}")
    return int(re.search(r"^summary: (\d+)", out.read_text(), re.M).group(1))


def main():
    compiler, *libraries = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deleted = 0
        for room in ("shapes", "algo"):
            (folder / room).mkdir()
            for file in (ROOT / room).glob("*.[hc]*"):
                text, count = without_trace(file.read_text()) if room == "algo" and file.name not in ("trace.h", "world_trace.h") else (file.read_text(), 0)
                (folder / room / file.name).write_text(text)
                deleted += count
        if deleted < 20:
            sys.exit(f"only {deleted} trace lines were found to delete: the test no longer knows them")
        driver = compiled(compiler, ROOT, "driver.cpp", folder / "driver.o")
        as_it_is, bare = (linked(compiler, libraries, [compiled(compiler, tree, "untraced.cpp", folder / f"{name}.o"), driver], folder / name)
                          for tree, name in ((ROOT, "as_it_is"), (folder, "bare")))
        with_lines, without = instructions(as_it_is, folder), instructions(bare, folder)
        if without < 1_000_000:
            sys.exit(f"only {without} instructions were counted")
        nanoseconds = subprocess.run([as_it_is, "time", "100"], capture_output=True, text=True, check=True).stdout.strip()
        print(f"tracing off: {with_lines} instructions, {without} with {deleted} trace lines deleted: {100 * (with_lines / without - 1):+.2f} %")
        print(f"tracing on: {nanoseconds} ns an event")
        if abs(with_lines / without - 1) > 0.01:
            sys.exit("the untraced core pays for its trace")


main()
