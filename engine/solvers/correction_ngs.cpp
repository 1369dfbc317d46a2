// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Non-linear Gauss-Seidel on positions [Catto2009, "position correction"]: after the bodies have moved, each
// iteration visits the constraints, evaluates C where the bodies are now, and moves them along M^-1 J^T:
//     joint     lambda = -K^-1 C                                all of the error
//     contact   lambda = max(0, -beta (C + slop)) / K           a share of it, so that coupled contacts
//     settle
// Velocities are not touched, so no energy enters through them (potential energy does: bodies are lifted
// out). Cost: iterations * constraints.
#include <algorithm>

#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Ngs final : public PositionCorrection<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<PositionCorrection<S>> clone() const override { return std::make_unique<Ngs>(*this); }

    void correct(PositionProblem<S>& problem, int iterations, Real slop) override {
        for (int i = 0; i < iterations; ++i) {
            correctJoints(problem);
            correctContacts(problem, slop);
            problem.applyRotations();
        }
    }

  private:
    static constexpr Real kShare = Real(0.2);        ///< beta of contacts
    static constexpr Real kLongestMove = Real(0.2);  ///< per contact and iteration [m]

    static void correctJoints(PositionProblem<S>& problem) {
        Block<S> block;
        std::array<Row<S>, kMaxJointRows> rows;
        BlockVector<S> error;
        BlockMatrix<S> inverseK;
        for (std::size_t j = 0; j < problem.jointCount(); ++j) {
            problem.evaluateJoint(j, block, rows, error, inverseK);
            const BlockVector<S> lambda = -(inverseK * error);
            for (int r = 0; r < block.rows; ++r)
                problem.move(block, rows[static_cast<std::size_t>(r)], lambda[r]);
            problem.applyRotations();
        }
    }

    static void correctContacts(PositionProblem<S>& problem, Real slop) {
        for (std::size_t c = 0; c < problem.contactCount(); ++c) {
            const Real error = problem.separation(c) + slop;
            if (error >= 0) continue;
            const Row<S>& row = problem.contactRow(c);
            problem.move(problem.contactBlock(c), row, std::min(-kShare * error, kLongestMove) * row.invK);
        }
    }
};

}  // namespace

template <class S>
std::unique_ptr<PositionCorrection<S>> makeNgs() {
    return std::make_unique<Ngs<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeNgs, PositionCorrection);

}  // namespace rigor::engine
