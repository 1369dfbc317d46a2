// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/ids.hpp"

#include <string>

#include "engine/core/error.hpp"

namespace rigor::engine {

void throwUnknownHandle(const UnknownHandle& handle) {
    const std::string kind = handle.kind;
    if (handle.index == 0)
        throw EngineError("null_handle", "the handle of a " + kind + " is null, and a " + kind +
                                             " is needed (index 0 names none)");
    const auto named = [&](std::uint32_t generation) {
        return kind + " " + std::to_string(handle.index) + ", generation " + std::to_string(generation);
    };
    std::string message = named(handle.generation);
    if (handle.index >= handle.slots)
        message += ": this world has never had it; its indices end at " + std::to_string(handle.slots - 1) +
                   ". Is the handle of another world?";
    else if (handle.generation >= handle.slotGeneration)
        message +=
            ": this world has never had it. Is the handle of another world, or of a time after the "
            "snapshot that was restored?";
    else
        message +=
            ": it has been removed" +
            (handle.taken ? ", and " + named(handle.slotGeneration) + " has its place" : std::string()) +
            ". World::contains() tests a handle";
    throw EngineError("stale_handle", message);
}

}  // namespace rigor::engine
