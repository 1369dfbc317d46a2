// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cost of a piece of work beside its time: its allocations and the memory that it takes.
#pragma once

#include <algorithm>

#include "validation/bench/process_memory.hpp"
#include "validation/bench/stopwatch.hpp"
#include "validation/results/bench_types.hpp"

namespace rigor::validation {

/// A stopwatch that counts the calls of the allocator within what it times, where they are counted.
class CountingStopwatch {
  public:
    /// `samples`: room for so many, which is not counted.
    explicit CountingStopwatch(std::size_t samples) { watch_.reserve(samples); }

    /// Times `work`, which was `operations` of them.
    template <class Work>
    void time(Work&& work, double operations = 1.0) {
        const auto before = allocationsSoFar();
        watch_.time(work, operations);
        const auto after = allocationsSoFar();
        operations_ += operations;
        if (!before || !after) return;
        counted_.calls += after->calls - before->calls;
        counted_.bytes += after->bytes - before->bytes;
    }
    void correctLast(double seconds) { watch_.correctLast(seconds); }
    const ClockSamples& samples() const { return watch_.samples(); }

    /// Calls and bytes of an operation, in the mean.
    void writeAllocations(results::BenchRepetition& done) const {
        if (!allocationsSoFar() || !(operations_ > 0.0)) return;
        done.allocations = counted_.calls / operations_;
        done.allocatedBytes = counted_.bytes / operations_;
    }

  private:
    Stopwatch watch_;
    Allocations counted_;
    double operations_ = 0.0;
};

/// Resident memory from here on.
class GrownMemory {
  public:
    GrownMemory() {
        forgetPeak();
        before_ = residentKiB();
    }
    /// The peak until now, and what of it came since the beginning.
    void write(results::BenchRepetition& done) const {
        done.peakMemoryKiB = peakResidentKiB();
        done.ownMemoryKiB = std::max<std::int64_t>(0, done.peakMemoryKiB - before_);
    }

  private:
    std::int64_t before_ = 0;
};

}  // namespace rigor::validation
