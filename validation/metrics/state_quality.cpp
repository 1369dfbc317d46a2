// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Soundness of the recorded states themselves.
#include <cmath>

#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {

std::vector<MetricValue> quaternionNormError(const MetricInput& input) {
    std::vector<MetricValue> rows;
    if (input.trajectory.frames() < 2) return rows;
    for (const int body : observedDynamic(input)) {
        Worst worst;
        for (std::size_t k = 0; k < input.trajectory.frames(); ++k)
            worst.add(std::abs(norm(input.trajectory.state(k, body).orientation) - 1.0),
                      input.trajectory.times[k]);
        rows.push_back(worst.row(bodyName(input, body)));
    }
    return withWorst(std::move(rows));
}

}  // namespace rigor::validation
