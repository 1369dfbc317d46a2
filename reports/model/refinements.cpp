// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/model/refinements.hpp"

namespace rigor::report {

std::vector<Refinement> refinements(const ViewModel& view) {
    std::vector<Refinement> list;
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s) {
        const auto& name = view.run().scenarios[s].name;
        const auto& main = view.mainMetric(s).name;
        const results::OrderRow* chosen = nullptr;
        for (const auto& o : view.run().orders)
            if (o.scenario == name && (!chosen || (o.metric == main && chosen->metric != main))) chosen = &o;
        if (chosen) list.push_back({name, chosen->metric, chosen->unit});
    }
    return list;
}

}  // namespace rigor::report
