// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An order of elimination for nets of joints: see dissection.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/ids.hpp"

namespace rigor::engine {
/// The joints, each given by its two bodies (below `bodies`, or kNullIndex), in an order by which those of every
/// part are eliminated before those that join it to the rest.
std::vector<std::uint32_t> dissectJoints(std::span<const std::pair<std::uint32_t, std::uint32_t>> joints,
                                         std::size_t bodies);

}  // namespace rigor::engine
