// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/bounding_volume.hpp"

namespace rigor::engine {

std::span<const AlgorithmEntry<BoundingVolume>> boundingVolumeTable() {
    static constexpr AlgorithmEntry<BoundingVolume> table[] = {
#define ALGORITHM(name, volume, summary) {#name, BoundingVolume volume, summary},
#include "engine/contacts/bounding_volumes.def"
    };
    return table;
}

}  // namespace rigor::engine
