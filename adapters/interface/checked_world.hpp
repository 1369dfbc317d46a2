// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A world of a module, with every answer checked that the harness uses as an index or stores as text, and with the
// floating-point environment put back after every call. The code of a module can do what it likes in its process; this
// is against mistakes, so that they end as a sentence on the engine and not as another number or a crash of the harness.
#pragma once

#include <memory>

#include "adapters/interface/engine.hpp"
#include "adapters/interface/float_environment.hpp"

namespace rigor::adapter {

inline constexpr std::size_t kMostLedgerLines = 10000, kMostLedgerBytes = 1u << 20;
inline constexpr std::size_t kMostPhases = 64;

/// Builds a world and wraps it. The result is a StateSetting if the module's world is one. What a module throws is thrown
/// on with at most kLongestMessage bytes of text: Unsupported, BadInput and EngineFailure as such, std::logic_error as
/// std::invalid_argument, anything else as an EngineFailure. Answers that do not fit the scenario are an EngineFailure.
/// `found` says what loading the module did to the floating-point environment `before`.
std::unique_ptr<World> buildChecked(const DynamicsEngine& engine, const Scenario& scenario, double dt,
                                    const Settings& settings, const FloatEnvironment& before,
                                    const std::string& found);

/// A query of a module; exceptions and the floating-point environment as above.
CollisionAnswer collideChecked(const CollisionEngine& engine, const CollisionQuery& query);

}  // namespace rigor::adapter
