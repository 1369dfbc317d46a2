// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/growth.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "validation/bench/print.hpp"

namespace rigor::validation {
namespace {

using results::BenchCase;

auto identityOf(const BenchCase& c) {
    return std::tie(c.part, c.name, c.engine, c.threads);
}

std::optional<double> exponent(double before, double after, double sizes) {
    if (!(before > 0.0) || !(after > 0.0)) return std::nullopt;
    return std::log(after / before) / std::log(sizes);
}

Growth growthBetween(const BenchCase& small, const BenchCase& large) {
    const double sizes = large.size / small.size;
    const bool wall = large.summary.clock == "wall";
    Growth growth;
    std::tie(growth.part, growth.name, growth.engine, growth.threads) = identityOf(large);
    growth.sizeUnit = large.sizeUnit;
    growth.from = small.size;
    growth.to = large.size;
    growth.time = exponent(wall ? small.summary.wall : small.summary.cpu,
                           wall ? large.summary.wall : large.summary.cpu, sizes)
                      .value_or(0.0);
    growth.longest = exponent(countOf(small, "longest_ms"), countOf(large, "longest_ms"), sizes);
    growth.contacts = exponent(countOf(small, "contacts"), countOf(large, "contacts"), sizes);
    growth.memory =
        exponent(static_cast<double>(worldMemory(small)), static_cast<double>(worldMemory(large)), sizes);
    return growth;
}

}  // namespace

std::int64_t worldMemory(const BenchCase& c) {
    std::int64_t most = 0;
    for (const results::BenchRepetition& r : c.repetitions)
        if (r.round > 0) most = std::max(most, r.ownMemoryKiB);
    return most;
}

std::vector<Growth> growthsOf(const std::vector<BenchCase>& cases) {
    std::vector<Growth> all;
    std::vector<bool> done(cases.size(), false);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (done[i]) continue;
        std::vector<const BenchCase*> sizes;
        for (std::size_t k = i; k < cases.size(); ++k) {
            if (identityOf(cases[k]) != identityOf(cases[i])) continue;
            done[k] = true;
            if (cases[k].summary.valid && cases[k].size > 0.0) sizes.push_back(&cases[k]);
        }
        std::stable_sort(sizes.begin(), sizes.end(),
                         [](const BenchCase* a, const BenchCase* b) { return a->size < b->size; });
        for (std::size_t k = 1; k < sizes.size(); ++k)
            if (sizes[k - 1]->size < sizes[k]->size) all.push_back(growthBetween(*sizes[k - 1], *sizes[k]));
    }
    return all;
}

}  // namespace rigor::validation
