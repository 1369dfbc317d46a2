// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A plan divided among machines. A shard has whole scenarios, so that audits stay together and timings that are compared
// with each other come from one machine.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rigor::validation {

struct CasePlan;

struct Shard {
    int number = 1, count = 1;  ///< 1 <= number <= count
    std::string plan = {};      ///< hash of the ids of the whole plan
    std::size_t planned = 0;    ///< number of cases of the whole plan

    /// True if the scenario at this place of the whole plan belongs to the shard.
    bool hasScenario(std::size_t place) const {
        return place % count == static_cast<std::size_t>(number - 1);
    }
};

/// "2/8". Throws std::invalid_argument.
Shard parseShard(const std::string& text);

/// The cases of a shard, in the order of the plan, and in `shard` what identifies the whole plan.
std::vector<CasePlan> casesOfShard(const std::vector<CasePlan>& plan, Shard& shard);

}  // namespace rigor::validation
