// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact problems of boxes on boxes, made without any engine: axis-aligned boxes whose faces touch
// have one contact at each corner of the faces' common part.
#pragma once

#include <string>
#include <vector>

#include "validation/contact_problems/problem.hpp"

namespace rigor::validation {

/// "stack_10", "pyramid_14", "heavy_on_light" (100 kg on four of 1 kg), "struck_pyramid" (every box has a
/// random velocity: impacts and sliding), "wall_28" (2D).
const std::vector<std::string>& contactScenes();

/// Complete. Throws std::invalid_argument for unknown names.
ExportedProblem makeContactScene(const std::string& name, std::uint64_t seed);

}  // namespace rigor::validation
