// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Lines of memory that are sent for before they are needed. They change when, never what.
#pragma once

#include <cstdint>

namespace rigor::engine {

/// Sends for the lines of [first, last), to be read.
inline void prefetch(const void* first, const void* last) {
    for (auto line = reinterpret_cast<std::uintptr_t>(first); line < reinterpret_cast<std::uintptr_t>(last);
         line += 64)
        __builtin_prefetch(reinterpret_cast<const void*>(line));
}

/// Sends for a line that is to be changed: taken from the caches of other cores at once, not only when it is
/// written to. Compilers make PREFETCHW of the built-in only for processors newer than the oldest x86-64,
/// on all of which it is at least allowed.
inline void prefetchToWrite(const void* line) {
#if defined(__x86_64__)
    asm volatile("prefetchw %0" : : "m"(*static_cast<const char*>(line)));
#else
    __builtin_prefetch(line, 1);
#endif
}

}  // namespace rigor::engine
