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

namespace rigor::engine {

inline constexpr std::uint32_t kNoBody = 0xffffffff;  ///< in the place of a body that impulses do not move

/// The joints, each given by its two bodies (below `bodies`, or kNoBody), in an order by which those of every
/// part are eliminated before those that join it to the rest.
std::vector<std::uint32_t> dissectJoints(std::span<const std::pair<std::uint32_t, std::uint32_t>> joints,
                                         std::size_t bodies);

}  // namespace rigor::engine
