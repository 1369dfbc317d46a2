// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One step of the generalised Newton method of Alart and Curnier [AlartCurnier1991] on all rows together: the
// finish of an iteration that has found out which contacts stick, slide and are open. The equations, with
// z = lambda - rho w, rho = 1/W_ii, w = W lambda + q:
//     free, and bounded rows with z inside the bounds, and normals with z_n > 0:    w = 0
//     bounded rows and normals else:                                                lambda = the bound
//     tangents of an open contact:                                                  lambda_t = 0
//     tangents, |z_t| <= mu lambda_n (of sticking):                                 w_t = 0
//     tangents else:                                     lambda_t = mu lambda_n z_t / |z_t|
// (rolling and torsional friction are tangents too, with their own coefficient for mu)
// are piecewise smooth; the step is that of the piece at lambda. Redundant rows make it singular, so W_ii
// counts (1 + sigma) fold in the rows w = 0: the steps then converge linearly with a rate of about sigma over
// the smallest relevant eigenvalue. A larger sigma keeps steps short where the matrix is nearly singular by
// itself, as Levenberg's and Marquardt's damping does. Cost: n^3 / 3. Known limits: no convergence from far
// away; the caller checks what a step has brought.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/solvers/lcp/assembled.hpp"
#include "engine/solvers/lcp/dense.hpp"

namespace rigor::engine {

class ContactNewton {
  public:
    /// Newton step from problem.lambda (and problem.q) to `next`. False if the equations could not be solved.
    bool step(const AssembledProblem& problem, double sigma, std::vector<double>& next);

  private:
    void tangentRows(const AssembledProblem& p, const AssembledContact& contact, double* A);

    DenseLu lu_;
    std::vector<double> w_, right_;
    std::vector<std::uint8_t> pinned_;  ///< 1 for rows that are at a bound after the step
};

}  // namespace rigor::engine
