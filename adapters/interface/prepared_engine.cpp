// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/prepared_engine.hpp"

#include "adapters/interface/input_check.hpp"

namespace rigor::adapter {

PreparedEngine prepareEngine(const EngineSpec& spec, const Scenario& scenario, double dt) {
    PreparedEngine prepared{loadEngine(spec), {}};
    if (prepared.engine->dynamics() == nullptr)
        throw Unsupported("engine '" + spec.engine + "' has no dynamics");
    prepared.settings = resolveSettings(spec, *prepared.engine);
    checkScenarioInput(scenario, dt);
    checkSupported(scenario, prepared.engine->capabilities(), spec.engine);
    return prepared;
}

}  // namespace rigor::adapter
