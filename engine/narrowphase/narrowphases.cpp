// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/narrowphase/narrowphases.hpp"

#include <cstring>

namespace rigor::engine {

std::span<const NarrowPhaseEntry> narrowPhases() {
    static constexpr NarrowPhaseEntry kTable[] = {
#define ALGORITHM(name, function, summary) {#name, summary},
#include "engine/narrowphase/narrowphases.def"
#undef ALGORITHM
    };
    return kTable;
}

template <class S>
CollideFunction<S> findNarrowPhase(const char* name) {
#define ALGORITHM(entry, function, summary) \
    if (std::strcmp(name, #entry) == 0) return &function<S>;
#include "engine/narrowphase/narrowphases.def"
#undef ALGORITHM
    return nullptr;
}

template CollideFunction<Space2f> findNarrowPhase(const char*);
template CollideFunction<Space2d> findNarrowPhase(const char*);
template CollideFunction<Space3f> findNarrowPhase(const char*);
template CollideFunction<Space3d> findNarrowPhase(const char*);

}  // namespace rigor::engine
