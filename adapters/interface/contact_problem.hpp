// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact problems: the problem of a solver in one step, without collision detection and integration around
// it. Per contact the normal component first, then the tangents (1 in 2D, 2 in 3D):
//     local    u = W r + q
//     global   M v = H r + f,   u = H^T v + w                     (W = H^T M^-1 H, q = w + H^T M^-1 f)
//     law      u_N >= 0, r_N >= 0, u_N r_N = 0;   |r_T| <= mu r_N, and r_T opposite to u_T at its limit where
//              it slips
// r: impulse over the step, u: relative velocity after it, restitution and gaps being in q or w. Source:
// Acary, Bremond, Huber, On solving contact problems with Coulomb friction: formulations and numerical
// comparisons, 2018.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

/// Sparse matrix by columns: the entries of column j are at start[j] .. start[j + 1] - 1, sorted by row, each
/// entry once.
struct SparseMatrix {
    int rows = 0, columns = 0;
    std::vector<int> start;  ///< columns + 1
    std::vector<int> row;
    std::vector<double> value;
};

struct ContactProblem {
    int dimension = 3;       ///< 2 or 3: components per contact
    std::vector<double> mu;  ///< coefficient of each contact, >= 0
    std::vector<double> W;   ///< n x n, row by row, n = dimension * contacts; may be unsymmetric
    std::vector<double> q;   ///< n
    bool hasBodies = false;  ///< the following is known; W and q are made from it
    SparseMatrix M, H;       ///< m x m, m x n
    std::vector<double> f;   ///< m
    std::vector<double> w;   ///< n

    std::size_t contacts() const { return mu.size(); }
    std::size_t size() const { return q.size(); }
};

/// Friction model that a solver really solves. The first tangent is at angle 0.
struct FrictionModel {
    enum class Kind {
        Cone,    ///< |r_T| <= mu r_N
        Box,     ///< |r_T1| <= mu r_N and |r_T2| <= mu r_N: up to sqrt 2 mu; exact in 2D
        Polygon  ///< the convex hull of `corners` directions of length mu r_N: at most mu; exact in 2D
    } kind = Kind::Cone;
    int corners = 4;
};

struct ContactSolution {
    std::vector<double> r;  ///< n
    int iterations = 0;     ///< done, as the solver counts them
    bool gaveUp = false;    ///< the solver says that it did not reach what it promises
};

/// A problem inside one solver.
class ContactSolve {
  public:
    virtual ~ContactSolve() = default;
    /// Solves from r = 0, whatever came before, in at most `iterations` >= 1 of its own; may end when it is
    /// as near as `tolerance` >= 0 [as u] by its own measure.
    virtual ContactSolution run(int iterations, double tolerance) = 0;
    virtual FrictionModel friction() const { return {}; }
};

class ContactSolverEngine {
  public:
    virtual ~ContactSolverEngine() = default;
    /// Values of the engine's option "solver", those that can take no contact problem included.
    virtual std::vector<std::string> solvers() const = 0;
    /// `settings` is complete; its "solver" is meant. The problem has been checked (sizes, finite numbers).
    /// Throws Unsupported with what the solver lacks.
    virtual std::unique_ptr<ContactSolve> take(const ContactProblem& problem,
                                               const Settings& settings) const = 0;
};

}  // namespace rigor::adapter
