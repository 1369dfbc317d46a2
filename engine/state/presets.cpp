// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>

#include "engine/core/error.hpp"
#include "engine/state/prefer_accuracy.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine {
namespace {

template <class S>
void preferNothing(WorldDef<S>&) {}

}  // namespace

template <class S>
WorldDef<S> WorldDef<S>::preset(std::string_view name) {
    WorldDef def;
#define PRESET(known, change, summary) \
    if (name == #known) {              \
        change(def);                   \
        return def;                    \
    }
#include "engine/state/presets.def"
    throw EngineError("preset", "no preset has the name " + std::string(name));
}

const std::vector<PresetInfo>& presets() {
    static const std::vector<PresetInfo> all{
#define PRESET(known, change, summary) {#known, summary},
#include "engine/state/presets.def"
    };
    return all;
}

#define RIGOR_INSTANTIATE(S) template WorldDef<S> WorldDef<S>::preset(std::string_view);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
