// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenario's forces and events, computed by the harness, one implementation for all engines: from the
// engine's own states at the start of each step, constant during that step. Worlds that evaluate the forces
// themselves get the events alone.
#pragma once

#include <cstddef>
#include <span>

#include "adapters/interface/engine.hpp"

namespace rigor::validation {

/// Applies to `world` what acts during the step that starts at step * dt. `states` are those of that moment.
void applyForces(const scenario::Scenario& scenario, std::size_t step, double dt,
                 std::span<const adapter::BodyState> states, adapter::World& world);

/// True if applyForces needs states.
bool forcesNeedStates(const scenario::Scenario& scenario, const adapter::World& world);

}  // namespace rigor::validation
