// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace rigor::engine {

void checkFailed(const char* file, int line, const char* condition, const char* message) {
    std::fprintf(stderr, "%s:%d: check failed: %s (%s)\n", file, line, condition, message);
    std::abort();
}

}  // namespace rigor::engine
