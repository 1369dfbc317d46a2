// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Packets that an instance sends: the state after every request, and the result of a stage. The keys are
// described in README.md.
#pragma once

#include "scenarios/model/scenario.hpp"
#include "validation/live/instance_world.hpp"
#include "validation/live/packet.hpp"

namespace rigor::validation {

/// Poses, velocities, contacts, counters; with `stages` also boxes, pairs, manifolds, rows, iterations,
/// islands of engines that have them.
Packet instanceFrame(InstanceWorld& instance, bool stages);

/// Names and kinds of bodies and joints, and how the engine was set up: what does not change while it runs.
nlohmann::json instanceDescription(InstanceWorld& instance);

}  // namespace rigor::validation
