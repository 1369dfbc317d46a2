// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Wall time and CPU time of a piece of work. CPU time is that of all threads of this process, user and
// system: on a machine that others use it is what the work took, wall time is what one waited.
#pragma once

#include <ctime>
#include <vector>

namespace rigor::validation {

/// Wall times and CPU times [s] of the same operations, one each.
struct ClockSamples {
    std::vector<double> wall, cpu;
};

class Stopwatch {
  public:
    /// Times `work`, which was `operations` of them, and keeps the time of one.
    template <class Work>
    void time(Work&& work, double operations = 1.0) {
        const double cpu = now(CLOCK_PROCESS_CPUTIME_ID), wall = now(CLOCK_MONOTONIC);
        work();
        const double wallEnd = now(CLOCK_MONOTONIC), cpuEnd = now(CLOCK_PROCESS_CPUTIME_ID);
        samples_.wall.push_back((wallEnd - wall) / operations);
        samples_.cpu.push_back((cpuEnd - cpu) / operations);
    }
    /// Replaces the last times by those of an engine's own clock (adapter::StepCounters::stepSeconds).
    void correctLast(double seconds) {
        samples_.wall.back() = seconds;
        samples_.cpu.back() = seconds;
    }
    void reserve(std::size_t count) {
        samples_.wall.reserve(count);
        samples_.cpu.reserve(count);
    }
    const ClockSamples& samples() const { return samples_; }

  private:
    static double now(clockid_t clock) {
        timespec t{};
        clock_gettime(clock, &t);
        return t.tv_sec + 1e-9 * t.tv_nsec;
    }
    ClockSamples samples_;
};

}  // namespace rigor::validation
