// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/refusal.hpp"

#include "adapters/interface/input_check.hpp"

namespace rigor::validation {

results::CaseRow rowWithout(const std::string& scenario, const adapter::EngineSpec& spec, double dt) {
    results::CaseRow row;
    row.scenario = scenario;
    row.spec = spec.text();
    row.engine = spec.engine;
    row.preset = spec.preset();
    row.dt = dt;
    return row;
}

results::CaseRow refusedRow(const std::string& scenario, const adapter::EngineSpec& spec, double dt,
                            const adapter::Unsupported& refusal) {
    results::CaseRow row = rowWithout(scenario, spec, dt);
    row.outcome = results::Outcome::Unsupported;
    row.reason = refusal.what();
    row.refusal = adapter::refusalName(refusal.refusal());
    const bool documented = !refusal.documentation().empty();
    row.ledger.push_back({"refused", refusal.lacking(), adapter::refusalText(refusal.refusal()),
                          adapter::realisationName(adapter::Realisation::Unsupported),
                          documented ? "its documentation: " + refusal.documentation()
                                     : "the adapter has no code for it yet"});
    return row;
}

std::optional<adapter::Unsupported> declaredRefusal(const CasePlan& plan,
                                                    const EngineDescription& description) {
    // Another precision may be another module, with features of its own.
    const bool isKnown = description.problem.empty() && description.capabilities.dynamics &&
                         !plan.spec.options.contains("precision");
    if (!isKnown) return std::nullopt;
    try {
        checkSettings(plan.spec, description);
        adapter::checkScenarioInput(plan.scenario, plan.dt);
        adapter::checkSupported(plan.scenario, description.capabilities, plan.spec.engine);
    } catch (const adapter::Unsupported& refusal) {
        return refusal;
    } catch (const adapter::BadInput&) {  // the child says so
    }
    return std::nullopt;
}

}  // namespace rigor::validation
