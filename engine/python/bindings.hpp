// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The engine's classes for Python. The module that has them is made in adapters/rigor/python, which adds worlds of
// scenarios.
#pragma once

#include "engine/python/any_world.hpp"

namespace rigor::engine::python {

/// Adds EngineError, Shape, JointAxis, World and WorldBatch to a module; returns the class of worlds.
WorldClass bindEngine(py::module_& module);

}  // namespace rigor::engine::python
