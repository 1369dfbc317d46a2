// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::siconos {

/// Siconos' solvers of friction problems in the local form (W, q, mu).
class SiconosContactSolvers final : public adapter::ContactSolverEngine {
  public:
    std::vector<std::string> solvers() const override;
    std::unique_ptr<adapter::ContactSolve> take(const adapter::ContactProblem& problem,
                                                const adapter::Settings& settings) const override;
};

}  // namespace rigor::siconos
