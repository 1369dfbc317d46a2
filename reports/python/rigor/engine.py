# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""The in-house engine: World, WorldBatch and what they are built of."""

from __future__ import annotations

try:
    from ._engine import EngineError, JointAxis, Shape, World, WorldBatch
except ImportError as error:
    raise ImportError(
        "rigor.World needs the engine's module, which is built where CMake finds pybind11 (Debian: pybind11-dev, python3-dev). "
        f"Results and commands work without it. ({error})"
    ) from error

__all__ = ["EngineError", "JointAxis", "Shape", "World", "WorldBatch"]
