#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Breaks the formulas of the references one at a time and lists the breaks that no test notices.

    mutate.py BUILD_FOLDER [--files REGEX] [--per-file N] [--seed N] [--list]

A mutant is one source file of validation/references with one change in one line: an operator turned round, a constant
times 1.5, a function taken for its partner, a sign dropped. It is compiled with the file's own command, linked into the
reference tests in place of the file, and run, quick tests first. What survives is printed; mutants that are equivalent
stand with their reason in equivalent_mutants.txt and are not counted. BUILD_FOLDER must compile every file by itself
(-DRIGOR_UNITY=OFF). Exit code 1 if any survives.

Not mutated: checks of assumptions (they have tests of their own), loop headers, lines with tolerances (1e-...), the
number of frames, text. Changes nothing in the source tree; everything happens in BUILD_FOLDER/mutants.
"""
import argparse
import json
import os
import pathlib
import random
import re
import shlex
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
FOLDER = HERE.parent
TIME_LIMIT = 240  # [s] for the tests of one mutant: a loop that never ends is noticed too

OPERATORS = {" + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ", " += ": " -= ", " -= ": " += ",
             " < ": " >= ", " > ": " <= ", " <= ": " > ", " >= ": " < ", " && ": " || ", " || ": " && "}
PARTNERS = {"std::sin(": "std::cos(", "std::cos(": "std::sin(", "std::sqrt(": "(", "std::abs(": "(",
            "std::min(": "std::max(", "std::max(": "std::min(", "std::sinh(": "std::cosh(",
            "std::cosh(": "std::sinh(", "std::exp(": "-std::exp(", "std::log(": "-std::log("}
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*)(?:L)?(?![\w.])")
SIGN = re.compile(r"(?:(?<=[(,=?:] )|(?<=[({])|(?<=return ))-(?=[\w(])")
SKIPPED = re.compile(r"^\s*(#|//|/\*|\*|for \(|while \(|require\(|violated\(|throw |template|using |namespace |class |struct )")


def mutants_of(path):
    """(line number, old line, new line) of every mutant."""
    found = []
    statement = ""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        code = line.split("//")[0]
        statement = code if re.search(r"[;{}]\s*$", statement) or not statement.strip() else statement + " " + code
        if SKIPPED.match(line) or SKIPPED.match(statement) or '"' in code or not code.strip():
            continue
        if "1e-" in code or "frames()" in code:
            continue

        def add(start, end, text):
            found.append((number, line, line[:start] + text + line[end:]))

        for old, new in OPERATORS.items():
            for match in re.finditer(re.escape(old), code):
                add(match.start(), match.end(), new)
        for old, new in PARTNERS.items():
            for match in re.finditer(re.escape(old), code):
                add(match.start(), match.end(), new)
        for match in NUMBER.finditer(code):
            if float(match.group(1)) != 0.0:
                add(match.start(1), match.end(1), repr(1.5 * float(match.group(1))))
        for match in SIGN.finditer(code):
            add(match.start(), match.end(), "")
    return found


def equivalents():
    """{(file, mutated line without blanks at its ends)} of equivalent_mutants.txt: file | line | reason."""
    listed = set()
    for line in (HERE / "equivalent_mutants.txt").read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            name, text, _ = (part.strip() for part in line.split(" | ", 2))
            listed.add((name, text))
    return listed


class Tests:
    """The reference tests with one object file in place of another."""

    def __init__(self, build):
        self.build = build
        self.folder = build / "mutants"
        self.folder.mkdir(exist_ok=True)
        ninja = ["ninja", "-C", str(build)]
        subprocess.run(ninja + ["references_test"], check=True, stdout=subprocess.DEVNULL)
        commands = json.loads(subprocess.run(ninja + ["-t", "compdb"], check=True, capture_output=True, text=True).stdout)
        self.compile_commands = {str((build / c["file"]).resolve()): c["command"] for c in commands
                                 if "rigor_references" in c["output"]}
        link = subprocess.run(ninja + ["-t", "commands", "references_test"], check=True, capture_output=True,
                              text=True).stdout.splitlines()[-1]
        self.link = re.sub(r"(&& :|: &&)", "", link).strip()
        if not any("validation/references/parts.cpp" in file for file in self.compile_commands):
            sys.exit("mutate.py: this build compiles several files as one: configure it with -DRIGOR_UNITY=OFF")
        self.quick = self.quick_tests()

    # Without the data from elsewhere: what is in the repository must notice.
    environment = {k: v for k, v in os.environ.items() if k != "RIGOR_DATA"}

    def quick_tests(self):
        out = subprocess.run([self.build / "tests/references_test"], capture_output=True, text=True, check=True).stdout
        slow = [m[0] for m in re.findall(r"\[       OK \] (\S+) \((\d+) ms\)", out) if int(m[1]) > 100]
        return "*-" + ":".join(slow)

    def run(self, source, text):
        """What became of the mutant: "compiler", "tests", "time" or "survived"."""
        mutant = self.folder / (source.stem + "_mutant.cpp")
        mutant.write_text(text)
        obj, program = mutant.with_suffix(".o"), self.folder / "references_test"
        command = shlex.split(self.compile_commands[str(source)])
        if command[0].endswith("ccache"):
            command = command[1:]
        where = command.index("-o")
        command[where + 1] = str(obj)
        command[command.index("-c") + 1] = str(mutant)
        command = [c for c in command if not c.startswith(("-MF", "-MT", "-MD")) and not c.endswith((".o.d",))]
        command = [c for i, c in enumerate(command) if not (c.endswith(".cpp.o") and c != str(obj))]
        command += ["-w", "-O1"]
        if subprocess.run(command, cwd=self.build, capture_output=True).returncode != 0:
            return "compiler"
        link = shlex.split(self.link)
        link[link.index("-o") + 1] = str(program)
        place = next(i for i, c in enumerate(link) if c.endswith("librigor_references.a"))
        link.insert(place, str(obj))
        subprocess.run(link, cwd=self.build, check=True, capture_output=True)
        for tests in (self.quick, "*"):
            try:
                done = subprocess.run([program, "--gtest_fail_fast", "--gtest_brief=1", "--gtest_filter=" + tests],
                                      capture_output=True, timeout=TIME_LIMIT, env=self.environment)
            except subprocess.TimeoutExpired:
                return "time"
            if done.returncode != 0:
                return "tests"
        return "survived"


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("build", type=pathlib.Path)
    options.add_argument("--files", default=".*", help="regular expression on the names of the files")
    options.add_argument("--per-file", type=int, default=0, help="a random sample of each file; 0: all")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--list", action="store_true", help="print the mutants and run nothing")
    arguments = options.parse_args()

    known, total, survivors, skipped = equivalents(), 0, 0, 0
    tests = None if arguments.list else Tests(arguments.build.resolve())
    for source in sorted(p for p in FOLDER.rglob("*.cpp") if "tests" not in p.parts):
        name = str(source.relative_to(FOLDER))
        if not re.fullmatch(arguments.files, name):
            continue
        mutants = mutants_of(source)
        if arguments.per_file and len(mutants) > arguments.per_file:
            chosen = random.Random(f"{arguments.seed} {name}").sample(range(len(mutants)), arguments.per_file)
            mutants = [mutants[i] for i in sorted(chosen)]
        outcomes = {"compiler": 0, "tests": 0, "time": 0, "survived": 0}
        lines = source.read_text().splitlines()
        for number, old, new in mutants:
            if (name, new.strip()) in known:
                skipped += 1
                continue
            if arguments.list:
                print(f"{name}:{number}: {new.strip()}")
                continue
            outcome = tests.run(source, "\n".join(lines[: number - 1] + [new] + lines[number:]) + "\n")
            outcomes[outcome] += 1
            if outcome == "survived":
                print(f"{name}:{number}\n  - {old.strip()}\n  + {new.strip()}", flush=True)
        killed = outcomes["tests"] + outcomes["time"]
        total += killed + outcomes["survived"]
        survivors += outcomes["survived"]
        if not arguments.list:
            print(f"{name}: {killed} noticed, {outcomes['survived']} survived, {outcomes['compiler']} did not compile",
                  flush=True)
    print(f"{total} mutants, {survivors} survived, {skipped} known to be equivalent")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
