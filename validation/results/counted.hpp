// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers of things in messages.
#pragma once

#include <cstddef>
#include <string>

namespace rigor::results {

/// "1 case", "2 cases"; for things whose plural has an s alone.
inline std::string counted(std::size_t n, const std::string& thing) {
    return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

}  // namespace rigor::results
