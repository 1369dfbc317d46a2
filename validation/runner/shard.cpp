// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/shard.hpp"

#include <charconv>
#include <map>
#include <stdexcept>

#include "validation/hash.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::validation {

Shard parseShard(const std::string& text) {
    Shard shard;
    const char* end = text.data() + text.size();
    const auto [slash, first] = std::from_chars(text.data(), end, shard.number);
    const bool hasSlash = first == std::errc() && slash != end && *slash == '/';
    const auto [last, second] = std::from_chars(hasSlash ? slash + 1 : end, end, shard.count);
    if (!hasSlash || second != std::errc() || last != end || shard.number < 1 || shard.number > shard.count)
        throw std::invalid_argument("--shard: found '" + text + "', expected K/N with 1 <= K <= N, as 2/8");
    return shard;
}

std::vector<CasePlan> casesOfShard(const std::vector<CasePlan>& plan, Shard& shard) {
    std::map<std::string, std::size_t> places;
    std::vector<CasePlan> cases;
    Fnv1a hash;
    for (const CasePlan& c : plan) {
        hash.text(c.id);
        const auto [place, isNew] = places.emplace(c.scenario.name, places.size());
        if (shard.hasScenario(place->second)) cases.push_back(c);
    }
    shard.plan = hash.hex();
    shard.planned = plan.size();
    return cases;
}

}  // namespace rigor::validation
