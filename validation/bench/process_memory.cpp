// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/process_memory.hpp"

#include <dlfcn.h>

#include <fstream>

#include "adapters/interface/registry.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::validation {
namespace {

constexpr const char* kLibrary = "rigor_count_allocations.so";

std::int64_t statusKiB(const std::string& key) {
    std::ifstream status("/proc/self/status");
    std::string line;
    while (std::getline(status, line))
        if (line.starts_with(key)) return std::stoll(line.substr(key.size()));
    return 0;
}

}  // namespace

std::optional<Allocations> allocationsSoFar() {
    using Count = void (*)(std::uint64_t*, std::uint64_t*);
    static const auto count = reinterpret_cast<Count>(dlsym(RTLD_DEFAULT, "rigorCountedAllocations"));
    if (count == nullptr) return std::nullopt;
    Allocations now;
    count(&now.calls, &now.bytes);
    return now;
}

std::vector<std::string> withCountedAllocations(std::vector<std::string> command) {
    if (isSanitized()) return command;
    for (const auto& folder : adapter::adapterPath()) {
        const auto library = folder / kLibrary;
        if (!std::filesystem::exists(library)) continue;
        command.insert(command.begin(), {"/usr/bin/env", "LD_PRELOAD=" + library.string()});
        break;
    }
    return command;
}

std::int64_t residentKiB() {
    return statusKiB("VmRSS:");
}

std::int64_t peakResidentKiB() {
    return statusKiB("VmHWM:");
}

void forgetPeak() {
    std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace rigor::validation
