// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The one place that names engines: what their libraries are known not to do, measured.
#include <cstring>
#include <map>

#include "adapters/conformance/kit.hpp"

namespace rigor::conformance {
namespace {

// engine, precision, preset, dimension, check, tolerance instead, reason
constexpr Deviation kDeviations[] = {
    {"", "", "", 0, "", 0.0, ""},
};

struct Use {
    bool needed = false;
};
std::map<const Deviation*, Use>& uses() {
    static std::map<const Deviation*, Use> all;
    return all;
}

bool matches(const Deviation& d, const std::string& check, const Arena& arena) {
    const auto is = [](const char* pattern, const std::string& value) {
        return *pattern == '\0' || value == pattern;
    };
    return engineSpec().engine == d.engine && is(d.precision, arena.precision) &&
           (arena.preset.empty() || is(d.preset, arena.preset)) &&
           (d.dimension == 0 || d.dimension == arena.dimension) && check == d.check;
}

const Deviation* find(const std::string& check, const Arena& arena) {
    for (const Deviation& d : kDeviations)
        if (matches(d, check, arena)) return &d;
    return nullptr;
}

}  // namespace

void expectWithin(const std::string& check, double error, double tolerance, const Arena& arena) {
    const Deviation* known = find(check, arena);
    if (known == nullptr) {
        EXPECT_LE(error, tolerance) << "check '" << check << "'";
        return;
    }
    Use& use = uses()[known];
    if (!(error <= tolerance)) use.needed = true;
    EXPECT_LE(error, known->max) << "check '" << check << "', known deviation: " << known->reason;
}

std::vector<std::string> staleDeviations() {
    std::vector<std::string> stale;
    for (const auto& [deviation, use] : uses())
        if (!use.needed)
            stale.push_back(std::string(deviation->check) + " (" + deviation->preset +
                            "): met without the deviation: " + deviation->reason);
    return stale;
}

}  // namespace rigor::conformance
