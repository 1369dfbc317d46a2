// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/narrowphase/narrowphases.hpp"

#include <cstring>

namespace rigor::engine {

std::span<const NarrowPhaseEntry> narrowPhases() {
    static constexpr NarrowPhaseEntry kTable[] = {
#define NARROW_PHASE(name, function, summary) {#name, summary},
#include "engine/narrowphase/narrowphases.def"
#undef NARROW_PHASE
    };
    return kTable;
}

template <class S>
CollideFunction<S> findNarrowPhase(const char* name) {
#define NARROW_PHASE(entry, function, summary) \
    if (std::strcmp(name, #entry) == 0) return &function<S>;
#include "engine/narrowphase/narrowphases.def"
#undef NARROW_PHASE
    return nullptr;
}

template CollideFunction<Space2f> findNarrowPhase(const char*);
template CollideFunction<Space2d> findNarrowPhase(const char*);
template CollideFunction<Space3f> findNarrowPhase(const char*);
template CollideFunction<Space3d> findNarrowPhase(const char*);

}  // namespace rigor::engine
