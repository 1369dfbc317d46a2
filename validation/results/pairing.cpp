// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/pairing.hpp"

#include "validation/results/spec_labels.hpp"

namespace rigor::results {

const char* pairByName(PairBy by) {
    constexpr const char* kNames[] = {"", "engine", "spec", "dt"};
    return kNames[static_cast<std::size_t>(by)];
}

std::optional<PairBy> parsePairBy(const std::string& name) {
    for (const PairBy by : {PairBy::Nothing, PairBy::Engine, PairBy::Spec, PairBy::TimeStep})
        if (name == pairByName(by)) return by;
    return std::nullopt;
}

PairKey pairKey(const CaseRow& c, PairBy by) {
    switch (by) {
        case PairBy::Engine:
            return {c.scenario, c.preset, c.dt};
        case PairBy::Spec:
            return {c.scenario, c.engine, c.dt};
        case PairBy::TimeStep:
            return {c.scenario, c.spec, 0.0};
        case PairBy::Nothing:
            break;
    }
    return {c.scenario, c.spec, c.dt};
}

bool differBy(const CaseRow& a, const CaseRow& b, PairBy by) {
    switch (by) {
        case PairBy::Engine:
            return a.engine != b.engine;
        case PairBy::Spec:
            return a.spec != b.spec;
        case PairBy::TimeStep:
            return a.dt != b.dt;
        case PairBy::Nothing:
            break;
    }
    return true;
}

bool isDefaultSpec(const CaseRow& c) {
    return c.spec == c.engine || c.spec == c.engine + ":preset=" + kDefaultPreset;
}

}  // namespace rigor::results
