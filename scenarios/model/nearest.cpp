// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/nearest.hpp"

#include <algorithm>
#include <numeric>

namespace rigor::scenario {

std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> beforeLast, last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
        }
        beforeLast = last;
        last = row;
    }
    return last.back();
}

std::optional<std::string> nearestName(const std::string& found, const std::vector<std::string>& known) {
    std::optional<std::string> best;
    std::size_t least = 0;
    for (const std::string& name : known) {
        const std::size_t distance = editDistance(found, name);
        if (3 * distance > std::max(found.size(), name.size())) continue;
        if (best && distance >= least) continue;
        best = name;
        least = distance;
    }
    return best;
}

std::string didYouMean(const std::string& found, const std::vector<std::string>& known) {
    const auto name = nearestName(found, known);
    return name ? "; did you mean '" + *name + "'?" : "";
}

}  // namespace rigor::scenario
