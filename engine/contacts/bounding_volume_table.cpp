// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/bounding_volume.hpp"

namespace rigor::engine {

std::span<const AlgorithmEntry<BoundingVolume>> boundingVolumeTable() {
    static constexpr AlgorithmEntry<BoundingVolume> table[] = {
#define BRACED(...) \
    { __VA_ARGS__ }
#define ALGORITHM(name, volume, summary) {#name, BoundingVolume BRACED volume, summary},
#include "engine/contacts/bounding_volumes.def"
#undef BRACED
    };
    return table;
}

}  // namespace rigor::engine
