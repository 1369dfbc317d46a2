# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Body-steps a second through Python and without it: moving bodies times steps over time, the best of many short rounds.

Each scene is stepped in one call, and again with a call and a look at the states for every step. The rounds of Python and those
of the program `python_body_steps` (C++) alternate; at the end both have the same state hash, or this program ends with exit
code 1. The time is the processor's, which other programs of the machine disturb less; that of batches is the clock's:

    cmake --build build/release --target rigor_python python_body_steps
    PYTHONPATH=build/release/python python3 adapters/rigor/python/benchmarks/body_steps.py [ROUNDS]
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, Callable

import numpy as np

import rigor
from rigor import _engine

PROGRAM = Path(_engine.__file__).resolve().parents[2] / "bin" / "benchmarks" / "python_body_steps"
STEPS = 10
SETTLING = 200


def scene(name: str, dimension: int, bodies: list[dict[str, Any]]) -> dict[str, Any]:
    up = [0, 1, 0][:dimension]
    plane = {"half_space": {"normal": up}} if dimension == 3 else {"half_plane": {"normal": up}}
    ground = {"name": "ground", "type": "static", "material": "any", "shapes": [plane]}
    return {
        "rigor": 1,
        "name": name,
        "title": name,
        "dimension": dimension,
        "gravity": [-9.81 * x for x in up],
        "duration": 1,
        "dt": [1 / 240],
        "materials": {"any": {"friction": 0.5, "restitution": 0, "density": 1000}},
        "bodies": [ground, *bodies],
    }


def flight() -> dict[str, Any]:
    """A thousand bodies in free flight, far apart and without shapes."""
    bodies = [
        {"name": f"b{i}", "mass": 1, "inertia": [1, 2, 3], "position": [3 * i, 0, 0], "angular_velocity": [0.1, 1, 0.2], "shapes": []}
        for i in range(1000)
    ]
    return scene("flight", 3, bodies)


def discs() -> dict[str, Any]:
    """2D: 50 stacks of 20 discs."""
    disc = {"material": "any", "shapes": [{"circle": {"radius": 0.5}}]}
    return scene("discs", 2, [{"name": f"d{i}", "position": [2 * (i % 50), 0.5 + i // 50], **disc} for i in range(1000)])


class Native:
    """The program that steps the same scene in C++."""

    def __init__(self, scenario: str, spec: str, dt: float, *batch: int) -> None:
        command = [str(PROGRAM), scenario, spec, repr(dt), str(STEPS), *map(str, batch)]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def ask(self, word: str) -> list[str]:
        assert self.process.stdin is not None and self.process.stdout is not None and self.process.stderr is not None
        try:
            self.process.stdin.write(word + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass
        answer = self.process.stdout.readline().split()
        if not answer:
            sys.exit(self.process.stderr.read())
        return answer

    def end(self) -> None:
        self.process.communicate()


def seconds(work: Callable[[], object], clock: Callable[[], float]) -> float:
    began = clock()
    work()
    return clock() - began


def compare(label: str, world: Any, native: Native, bodies: int, rounds: int, batch: bool) -> None:
    def each() -> None:
        for _ in range(STEPS):
            world.step()
            world.states[-1, 1]

    works = {"step": lambda: world.step(STEPS)} if batch else {"step": lambda: world.step(STEPS), "each": each}
    clock = time.perf_counter if batch else time.process_time
    text = f"{label:38}{bodies:6}"
    for _ in range(SETTLING // STEPS):
        world.step(STEPS)
        native.ask("step")
    for word, work in works.items():
        ours, theirs = [], []
        for _ in range(rounds):
            ours.append(seconds(work, clock))
            theirs.append(float(native.ask(word)[1 if batch else 0]))
        rate = bodies * STEPS / 1e6
        text += f"{rate / min(ours):10.2f}{rate / min(theirs):8.2f}{100 * (min(ours) / min(theirs) - 1):7.1f}"
    print(text, flush=True)
    mine = int(world.state_hashes()[0] if batch else world.state_hash())
    if mine != int(native.ask("hash")[0]):
        sys.exit(f"{label}: the states of Python and of C++ differ")
    native.end()


def moving(world: Any) -> int:
    return sum(world.body(name)["type"] == "dynamic" for name in world.bodies)


def main() -> None:
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is missing: cmake --build BUILD --target python_body_steps builds it")
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    print(f"{'[1e6 body-steps/s]':38}bodies  one call     C++      %  each step     C++      %")
    with tempfile.TemporaryDirectory() as folder:
        made = []
        for scenario in (flight(), discs()):
            made.append(str(Path(folder) / f"{scenario['name']}.json"))
            Path(made[-1]).write_text(json.dumps(scenario), encoding="utf-8")
        for source in (*made, "bench_many_pyramids", "bench_sphere_pile", "bench_ragdolls"):
            for precision in ("f32", "f64"):
                spec = f"rigor:preset=fast,precision={precision}"
                world = rigor.World(source, spec)
                native = Native(source, spec, world.dt)
                compare(f"{Path(source).stem} {precision}", world, native, moving(world), rounds, False)
    for precision in ("f32", "f64"):
        for threads in (1, 2):
            spec = f"rigor:preset=fast,precision={precision}"
            world = rigor.World("box_stack", spec)
            native = Native("box_stack", spec, world.dt, 200, threads)
            batch = world.batch(200, threads=threads)
            compare(f"200 x box_stack {precision}, threads {threads}", batch, native, 200 * moving(world), rounds, True)


if __name__ == "__main__":
    np.seterr(all="raise")
    main()
