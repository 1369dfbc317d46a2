// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Collision engines against each other, on the queries of the audit.
#include <algorithm>
#include <cmath>

#include "validation/metrics/metric_parts.hpp"
#include "validation/runner/audit.hpp"
#include "validation/runner/audit_spread.hpp"

namespace rigor::validation {

results::AuditRow pairRow(const std::string& a, const std::vector<AuditAnswer>& ofA, const std::string& b,
                          const std::vector<AuditAnswer>& ofB) {
    results::AuditRow row;
    row.auditor = a + "|" + b;
    row.outcome = "completed";
    Spread normal, depth;
    for (std::size_t i = 0; i < std::min(ofA.size(), ofB.size()); ++i) {
        const AuditAnswer &x = ofA[i], &y = ofB[i];
        if (!x.answered || !y.answered) continue;
        ++row.queries;
        row.overlapping += x.overlap && y.overlap ? 1 : 0;
        row.missed += !x.overlap && y.overlap ? 1 : 0;
        row.spurious += x.overlap && !y.overlap ? 1 : 0;
        if (!x.overlap || !y.overlap || !x.hasContact || !y.hasContact) continue;
        const bool equallyGood = x.minimising && y.minimising;
        normal.add(equallyGood ? 0.0 : angleBetween(x.normal, y.normal));
        depth.add(std::abs(x.depth - y.depth));
    }
    row.normalErrorMax = normal.max();
    row.normalErrorMedian = normal.median();
    row.depthErrorMax = depth.max();
    row.depthErrorMedian = depth.median();
    return row;
}

}  // namespace rigor::validation
