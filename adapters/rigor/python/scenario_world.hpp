// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// rigor.World of a scenario and a spec.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "engine/python/any_world.hpp"

namespace rigor::adapter {

namespace py = pybind11;

/// A name of the library or a file, or the content of one.
using ScenarioSource = std::variant<std::string, py::dict>;

/// The world as a run of `rigor` builds it for this spec, scheduled impulses included. `dt` is the scenario's first time
/// step unless given; `set` are values of the scenario to replace. Throws scenario::LoadError, BadInput, Unsupported.
std::shared_ptr<engine::python::AnyWorld> makeScenarioWorld(const ScenarioSource& source,
                                                            const std::string& spec, std::optional<double> dt,
                                                            const py::dict& set);

}  // namespace rigor::adapter
