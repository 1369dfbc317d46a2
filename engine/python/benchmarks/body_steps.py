# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Body-steps a second through Python: moving bodies times steps over time, the best of many short rounds.

Each scene is stepped in one call, and again with a call and a look at the states for every step. The time is the processor's, which
other programs of the machine disturb less; that of the batches is the clock's. Run it with the package on the PYTHONPATH:
python3 body_steps.py [rounds]
"""

from __future__ import annotations

import sys
import time
from typing import Callable

import numpy as np

import rigor


def flight(precision: str) -> rigor.World:
    """A thousand bodies in free flight, far apart."""
    world = rigor.World(precision=precision, preset="fast")
    for i in range(1000):
        world.add_body(position=(3.0 * i, 0, 0), mass=1, inertia=[1, 2, 3], angular_velocity=(0.1, 1, 0.2))
    return world


def pyramids(precision: str) -> rigor.World:
    """49 pyramids of 30 boxes (layers of 4 x 4, 3 x 3, 2 x 2, 1) at rest."""
    world = rigor.World(precision=precision, preset="fast")
    world.add_shape(world.add_body(type="static"), rigor.Shape.half_space((0, 1, 0)))
    for pyramid in range(49):
        for layer in range(4):
            for i in range((4 - layer) ** 2):
                x, z = i % (4 - layer), i // (4 - layer)
                place = (8 * (pyramid % 7) + 1.05 * (x + 0.5 * layer), 0.5 + layer, 8 * (pyramid // 7) + 1.05 * (z + 0.5 * layer))
                world.add_shape(world.add_body(position=place), rigor.Shape.box((0.5, 0.5, 0.5)))
    return world


def discs(precision: str) -> rigor.World:
    """2D: 50 stacks of 20 discs."""
    world = rigor.World(2, precision=precision, preset="fast")
    world.add_shape(world.add_body(type="static"), rigor.Shape.half_space((0, 1)))
    for i in range(1000):
        world.add_shape(world.add_body(position=(2.0 * (i % 50), 0.5 + i // 50)), rigor.Shape.sphere(0.5))
    return world


def one_by_one(world: rigor.World, steps: int) -> None:
    lowest = 0.0
    for _ in range(steps):
        world.step()
        lowest = min(lowest, float(world.states[-1, 1]))


def best(rounds: int, body_steps: int, work: Callable[[], object], clock: Callable[[], float] = time.process_time) -> float:
    seconds = []
    for _ in range(rounds):
        began = clock()
        work()
        seconds.append(clock() - began)
    return body_steps / min(seconds) / 1e6


def main() -> None:
    rounds, steps = int(sys.argv[1]) if len(sys.argv) > 1 else 100, 10
    print("scene                       in one call   call by call   [1e6 body-steps/s]")
    for scene in (flight, pyramids, discs):
        for precision in ("f32", "f64"):
            world = scene(precision)
            world.step(200)
            moving = sum(world.body(name)["type"] == "dynamic" for name in world.bodies)
            together = best(rounds, moving * steps, lambda: world.step(steps))
            alone = best(rounds, moving * steps, lambda: one_by_one(world, steps))
            print(f"{scene.__name__:12} {precision} {moving:5} bodies {together:10.2f} {alone:14.2f}")
    world = rigor.World("box_stack", "rigor:preset=fast", dt=1 / 60)
    for threads in (1, 2):
        batch = world.batch(200, threads=threads)
        batch.step(100)
        rate = best(rounds, 200 * 10 * steps, lambda: batch.step(steps), time.perf_counter)
        print(f"batch of 200 stacks of 10 boxes, {threads} threads {rate:10.2f}")


if __name__ == "__main__":
    np.seterr(all="raise")
    main()
