// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/contact_problem.hpp"

namespace rigor::bullet {

/// Contact problems for the solvers that Bullet exports with a matrix interface.
class BulletContactSolvers final : public adapter::ContactSolverEngine {
  public:
    std::vector<std::string> solvers() const override;
    std::unique_ptr<adapter::ContactSolve> take(const adapter::ContactProblem& problem,
                                                const adapter::Settings& settings) const override;
};

}  // namespace rigor::bullet
