# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""A run that the tests make once: two engines, two time steps, a body that slides and one that falls for ever."""

from __future__ import annotations

import functools
import os
import tempfile
from pathlib import Path

import rigor

#: Progress of the run that made_run() has made.
PROGRESS: list[rigor.Progress] = []

_ROOT = Path(os.environ.get("TEST_TMPDIR") or tempfile.mkdtemp(prefix="rigor-python-"))


@functools.lru_cache(maxsize=None)
def temporary_folder() -> Path:
    """A folder of this process's own."""
    _ROOT.mkdir(parents=True, exist_ok=True)
    return Path(tempfile.mkdtemp(dir=_ROOT))


@functools.lru_cache(maxsize=None)
def made_run() -> rigor.Run:
    """slide_and_stop at 1/60 and 1/240 on the in-house engine and on ODE, matched."""
    return rigor.validate(
        "slide_and_stop",
        engines=["rigor:preset=matched", "ode:preset=matched"],
        dt=["1/60", "1/240"],
        out=temporary_folder() / "slide",
        progress=PROGRESS.append,
    )
