// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Non-linear Gauss-Seidel on positions [Catto2009, "position correction"]: after the bodies have moved, each
// iteration visits the constraints, evaluates C where the bodies are now, and moves them along M^-1 J^T:
//     joint     lambda = -K^-1 C                                all of the error; limits where C < 0
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

    void correctJoints(PositionProblem<S>& problem) {
        for (std::size_t j = 0; j < problem.jointCount(); ++j) {
            problem.evaluateJoint(j, joint_);
            const int held = joint_.block.rows;
            if (held > 0) {
                BlockVector<S> error(held);
                for (int r = 0; r < held; ++r) error[r] = joint_.row[static_cast<std::size_t>(r)].error;
                const BlockVector<S> lambda = -(joint_.inverseK * error);
                for (int r = 0; r < held; ++r)
                    problem.move(joint_.block, joint_.row[static_cast<std::size_t>(r)], lambda[r]);
            }
            for (auto r = static_cast<std::size_t>(held); r < static_cast<std::size_t>(joint_.count); ++r)
                if (joint_.row[r].error < 0)
                    problem.move(joint_.block, joint_.row[r], -joint_.row[r].error * joint_.row[r].invK);
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

    JointPositions<S> joint_;
};

}  // namespace

template <class S>
std::unique_ptr<PositionCorrection<S>> makeNgs() {
    return std::make_unique<Ngs<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeNgs, PositionCorrection);

}  // namespace rigor::engine
