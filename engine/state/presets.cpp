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
    std::string known;
    for (const PresetInfo& one : presets()) known += (known.empty() ? "" : ", ") + one.name;
    throw EngineError("preset", "found \"" + std::string(name) + "\", expected one of: " + known);
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
