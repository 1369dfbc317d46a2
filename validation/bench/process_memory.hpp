// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Memory of this process, the same way for every engine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rigor::validation {

/// Calls of the C library's allocator by all of this process and the bytes that they requested, since it
/// began. Empty unless the counting library (preload/) was put before the others. Pools inside an engine and
/// mmap are not seen.
struct Allocations {
    std::uint64_t calls = 0, bytes = 0;
};
std::optional<Allocations> allocationsSoFar();

/// `command` so that it runs with the counting library; as it is where that library is not installed, or in a
/// sanitizer build, which has an allocator of its own.
std::vector<std::string> withCountedAllocations(std::vector<std::string> command);

/// Resident memory now, and the most since the last call of forgetPeak() or the start [KiB]; 0 if the system
/// does not report it.
std::int64_t residentKiB();
std::int64_t peakResidentKiB();
void forgetPeak();

}  // namespace rigor::validation
