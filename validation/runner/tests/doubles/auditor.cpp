// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An auditor without a fault. Every process that loads it adds a line to the file that RIGOR_DOUBLE_LOADS names.
#include <cstdlib>
#include <fstream>

#include "validation/runner/tests/doubles/ball_collisions.hpp"

namespace rigor::doubles {
namespace {

const bool kNoted = [] {
    if (const char* file = std::getenv("RIGOR_DOUBLE_LOADS"))
        std::ofstream(file, std::ios::app) << "loaded\n";
    return true;
}();

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeAuditor<rigor::doubles::BallCollisions>)
