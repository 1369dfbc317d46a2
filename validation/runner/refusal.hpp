// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cases that an engine or its adapter refuses for want of a feature.
#pragma once

#include <optional>
#include <string>

#include "validation/runner/describe.hpp"

namespace rigor::validation {

/// The row of a case of which nothing is known but what was to be run.
results::CaseRow rowWithout(const std::string& scenario, const adapter::EngineSpec& spec, double dt);

/// The row of a refused case. Its ledger is what was refused.
results::CaseRow refusedRow(const std::string& scenario, const adapter::EngineSpec& spec, double dt,
                            const adapter::Unsupported& refusal);

/// The refusal with which prepareEngine (adapters/interface/prepared_engine.hpp) ends in the child of this case, if
/// it follows from what the engine declares. Empty if it does not: then the child has to find out.
std::optional<adapter::Unsupported> declaredRefusal(const CasePlan& plan,
                                                    const EngineDescription& description);

}  // namespace rigor::validation
