// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An engine made ready for a scenario: loaded, its settings resolved, the scenario checked.
#pragma once

#include <memory>

#include "adapters/interface/registry.hpp"

namespace rigor::adapter {

struct PreparedEngine {
    LoadedEngine engine;
    Settings settings;
    /// A new world of a scenario that the engine was prepared for.
    std::unique_ptr<World> build(const Scenario& scenario, double dt) const {
        return engine.build(scenario, dt, settings);
    }
};

/// Throws Unsupported where the engine has no dynamics, or lacks what the scenario needs; BadInput for wrong
/// settings and for a scenario or time step that libraries may not get (input_check.hpp).
PreparedEngine prepareEngine(const EngineSpec& spec, const Scenario& scenario, double dt);

}  // namespace rigor::adapter
