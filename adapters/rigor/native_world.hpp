// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as a world of the in-house engine itself, for programs that use more of the engine than the interface of
// all engines has.
#pragma once

#include <vector>

#include "adapters/interface/types.hpp"
#include "engine/pipeline/world.hpp"

namespace rigor::adapter {

/// Handles in the order of the scenario.
template <class S>
struct NativeWorld {
    engine::World<S> world;
    std::vector<engine::BodyId> bodies;
    std::vector<engine::JointId> joints;
    std::vector<std::uint32_t> materials;
};

/// The world that DynamicsEngine::build makes for these settings, bit for bit. S must have the scenario's dimension.
/// Throws as build() does. Scheduled impulses (Scenario::events) are for the caller to apply.
template <class S>
NativeWorld<S> makeNativeWorld(const Scenario& scenario, double dt, const Settings& settings);

}  // namespace rigor::adapter
