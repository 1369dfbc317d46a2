// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The size of an island decides by which of two methods it is solved (pipeline/island_method.hpp).
#pragma once

#include <cstdint>

namespace rigor::engine {

enum class IslandSize : std::uint8_t { Usual, Large };

}  // namespace rigor::engine
