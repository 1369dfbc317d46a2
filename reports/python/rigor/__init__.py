# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Rigor from Python: results of runs, the program's commands, and the in-house engine.

Results (``rigor.open``) need numpy, pandas and h5py alone:

    >>> import rigor
    >>> run = rigor.validate("slide_and_stop", engines=["rigor", "ode:preset=matched"])
    >>> run.cases[["engine", "dt", "grade", "relative_error"]]
    >>> run.trajectory(engine="rigor", preset="default", dt=1 / 240).bodies["block"].position

The engine (``rigor.World``) is there where Rigor was built with pybind11:

    >>> world = rigor.World("box_stack", "rigor:solver=nsgs")
    >>> world.step(100)
    >>> world.states[:, :3]

SI units throughout, angles in radians. Axes are right-handed, y is up in most scenarios, 2D is the x-y plane. Quaternions are
in the order w, x, y, z and turn the body's axes into the world's. A contact's normal points from A to B; its depth is positive
where the shapes overlap.
"""

from __future__ import annotations

from typing import Any

from .commands import CommandRun, collide, compare, engines, scenarios, studies, study, validate
from .errors import (
    BadCommand,
    CommandFailed,
    DamagedStore,
    NewerFormat,
    NoSuchCase,
    NotARun,
    ProgramNotFound,
    RigorError,
)
from .program import Progress, find_program
from .run import Run, open
from .trajectory import CONTACT, Motion, Trajectory, read_trajectory

__version__ = "0.2.0"

#: What comes from the engine, loaded when first used.
_ENGINE = ("EngineError", "JointAxis", "Shape", "World", "WorldBatch")

__all__ = [
    "BadCommand",
    "CONTACT",
    "CommandFailed",
    "CommandRun",
    "DamagedStore",
    "Motion",
    "NewerFormat",
    "NoSuchCase",
    "NotARun",
    "ProgramNotFound",
    "Progress",
    "RigorError",
    "Run",
    "Trajectory",
    "collide",
    "compare",
    "engines",
    "find_program",
    "open",
    "read_trajectory",
    "scenarios",
    "studies",
    "study",
    "validate",
    *_ENGINE,
]


def __getattr__(name: str) -> Any:
    if name in _ENGINE:
        from . import engine

        return getattr(engine, name)
    raise AttributeError(f"module 'rigor' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted(__all__)
