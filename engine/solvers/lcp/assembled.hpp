// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All rows of a step as one problem, for solvers that treat them together:
//     w = W lambda + q,   W = J M^-1 J^T + diag(softness),   q = J v_0 + bias
// with v_0 the velocities without the rows' impulses. W is the Delassus operator: symmetric, positive
// semi-definite; singular where rows are redundant (a box on four corners). Rows are in the order of the
// world. It is in double precision for every space: pivoting in single loses its last digit after some
// hundred rows.
// Cost: memory n^2; time the sum over bodies of (rows of the body)^2.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/solvers/solver.hpp"

namespace rigor::engine {

/// Admissible set of a row's impulse.
enum class RowKind : std::uint8_t {
    Free,     ///< w = 0
    Bounded,  ///< lower <= lambda <= upper
    Normal,   ///< 0 <= lambda _|_ w >= 0
    Tangent   ///< friction, see AssembledContact
};
struct AssembledContact {
    std::size_t normal = 0;    ///< row that bounds the tangents
    std::size_t tangents = 0;  ///< number of them
    std::size_t first = 0;  ///< the first of them: normal + 1; other rows for rolling and torsional friction
    double mu = 0, muStatic = 0;  ///< muStatic >= mu
    double applied = 0;           ///< impulse applied on top of the normal's impulse in the limit of friction
    bool moment = false;          ///< the block is a Moment, which has no normal of its own
};

class AssembledProblem {
  public:
    std::size_t n = 0;
    std::vector<double> W;  ///< n x n, row by row; a row that no body can follow has a 1 on the diagonal
    std::vector<double> w, q, lambda;
    std::vector<double> own;           ///< empty, or W_ii before other rows were taken out (FreeRows)
    std::vector<double> lower, upper;  ///< bounds of Bounded rows; infinite for Free, [0, inf) for Normal
    std::vector<RowKind> kind;
    std::vector<AssembledContact> contacts;

    /// Everything but w, q and lambda.
    template <class S>
    void assemble(const ConstraintRows<S>& rows, std::size_t bodies);
    /// w and lambda from the biases, velocities and impulses of now. O(n).
    template <class S>
    void readVelocities(const ConstraintRows<S>& rows, std::span<const Velocity<S>> velocities);

    /// q from w and lambda.
    void findOffsets();

    double at(std::size_t i, std::size_t j) const { return W[i * n + j]; }
    /// `sum` and W_i lambda of row i, from its first entry to its last.
    double addCoupled(double sum, std::size_t i, const std::vector<double>& impulses) const {
        const double* entries = W.data() + i * n;
        const std::size_t first = ends_.empty() ? 0 : ends_[i].first, end = ends_.empty() ? n : ends_[i].end;
        for (std::size_t j = first; j < end; ++j) sum += entries[j] * impulses[j];
        return sum;
    }
    /// Velocity that a unit impulse of row i gives the row, if no other row holds it.
    double scale(std::size_t i) const { return own.empty() ? at(i, i) : own[i]; }
    /// W_ii with the damping sigma of Newton's method (ContactNewton).
    double damped(std::size_t i, double sigma) const {
        return own.empty() ? at(i, i) * (1 + sigma) : at(i, i) + sigma * own[i];
    }
    /// w of row i under the impulses.
    double velocity(std::size_t i, const std::vector<double>& impulses) const {
        return addCoupled(q[i], i, impulses);
    }
    /// The impulse of row i within the bounds that comes next to making its w zero, the others kept.
    double relaxed(std::size_t i, const std::vector<double>& impulses, double least, double most) const {
        return std::clamp(impulses[i] - velocity(i, impulses) / at(i, i), least, std::max(least, most));
    }
    /// Natural map of the row: the difference of lambda_i from its projection, as a velocity.
    double defect(std::size_t i, double least, double most) const {
        return at(i, i) * std::abs(lambda[i] - relaxed(i, lambda, least, most));
    }

  private:
    template <class S>
    void sortByBody(const ConstraintRows<S>& rows, std::size_t bodies);
    template <class S>
    void readRows(const ConstraintRows<S>& rows);
    template <class S>
    void coupleBodies(const ConstraintRows<S>& rows, std::size_t bodies);

    void findEnds();

    /// Columns of a row from its first entry to one past its last.
    struct Ends {
        std::size_t first = 0, end = 0;
    };
    std::vector<Ends> ends_;                    ///< columns of each row; empty: not known
    std::vector<std::uint32_t> start_, entry_;  ///< rows by body; entry = 2 row + side
    std::vector<double> invMass_;               ///< inverse mass of each body
};

}  // namespace rigor::engine
