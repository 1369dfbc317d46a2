// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "scenarios/json/node.hpp"
#include "scenarios/loader/collision_cases.hpp"

namespace rigor::scenario {

/// One query per line: {"id", "a", "pose_a", "b", "pose_b", "expected"}; other keys are passed over. The axis
/// of capsules, cylinders and cones is local z there. Throws LoadError with the problems of the first bad
/// line.
CollisionFile readCollisionLines(const std::string& text, const std::filesystem::path& file);
/// One such line; what is wrong with it goes to the node's context.
CollisionCase readCollisionLine(const Node& node);

}  // namespace rigor::scenario
