// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/time_limit.hpp"

namespace rigor::validation {

bool TimeLimit::isOver(double elapsed, double cpu) {
    constexpr double kWork = 1e-3;  ///< processor time that is more than that of being looked at [s]
    if (elapsed < seconds_) return false;
    if (cpu < 0.0 || cpu >= seconds_ || elapsed >= kMostWaiting * seconds_) return true;
    if (cpu > cpuSeen_ + kWork) {
        cpuSeen_ = cpu;
        workedAt_ = elapsed;
    }
    return elapsed - workedAt_ >= kBlocked;
}

}  // namespace rigor::validation
