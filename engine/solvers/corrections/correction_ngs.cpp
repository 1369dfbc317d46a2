// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Non-linear Gauss-Seidel on positions [Catto2009, "position correction"]: after the bodies have moved, each
// iteration loops over the constraints, evaluates C where the bodies are now, and moves them along M^-1 J^T:
//     joints    lambda = -K^-1 C                                all of the error, all joints at once by a
//                                                               direct method (joint_system.hpp); then limits
//                                                               where C < 0, one by one
//     contact   lambda = max(0, -beta (C + slop)) / K           beta < 1 lets coupled contacts converge
// Velocities are not touched, so no energy enters through them (potential energy does: bodies are lifted
// out). Without contacts and limits the iterations end when they improve the joints no more.
// Cost: iterations * constraints.
#include <algorithm>

#include "engine/solvers/joints/joint_system.hpp"
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Ngs final : public PositionCorrection<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<PositionCorrection<S>> clone() const override { return std::make_unique<Ngs>(*this); }

    void correct(PositionProblem<S>& problem, int iterations, Real slop) override {
        Real last = std::numeric_limits<Real>::infinity();
        bool together = true;
        for (int i = 0; i < iterations; ++i) {
            const Real error = correctJoints(problem, together);
            correctContacts(problem, slop);
            problem.applyRotations();
            if (!(error < Real(0.5) * last)) {
                // Rounding reached, or too far off for Newton's iteration: joint by joint is slow and sure.
                constexpr Real kRounding = Real(1000) * std::numeric_limits<Real>::epsilon();
                if (problem.contactCount() == 0 && !limited_ && error < kRounding) break;
                together = together && error < kRounding;
            }
            last = error;
        }
    }

  private:
    static constexpr Real kBaumgarte = Real(0.2);    ///< beta of contacts
    static constexpr Real kLongestMove = Real(0.2);  ///< longest move per contact and iteration [m]

    /// Returns the largest error of a row that holds.
    Real correctJoints(PositionProblem<S>& problem, bool together) {
        const std::size_t n = problem.jointCount();
        limited_ = false;
        if (n == 0) return 0;
        if (joints_.size() < n) joints_.resize(n);
        Real largest = 0;
        items_.clear();
        held_.clear();
        for (std::size_t j = 0; j < n; ++j) {
            JointPositions<S>& joint = joints_[j];
            problem.evaluateJoint(j, joint);
            limited_ = limited_ || joint.count > joint.block.rows;
            if (joint.block.rows == 0) continue;
            held_.push_back(j);
            items_.push_back({&joint.block, joint.row.data()});
            for (std::size_t r = 0; r < joint.block.rows; ++r)
                largest = std::max(largest, std::abs(joint.row[r].error));
        }
        if (largest > 0) {
            if (together && system_.factor(items_))
                correctTogether(problem);
            else
                correctOneByOne(problem);
        }
        if (limited_) correctLimits(problem);
        return largest;
    }

    void correctTogether(PositionProblem<S>& problem) {
        for (std::size_t k = 0; k < held_.size(); ++k)
            for (int r = 0; r < joints_[held_[k]].block.rows; ++r)
                system_.at(k)[r] = -joints_[held_[k]].row[r].error;
        system_.solve();
        for (std::size_t k = 0; k < held_.size(); ++k) move(problem, joints_[held_[k]], system_.at(k));
        problem.applyRotations();
    }

    void correctOneByOne(PositionProblem<S>& problem) {
        for (const std::size_t j : held_) {
            JointPositions<S>& joint = joints_[j];
            problem.evaluateJoint(j, joint);
            BlockVector<S> error(joint.block.rows);
            for (int r = 0; r < joint.block.rows; ++r) error[r] = joint.row[r].error;
            BlockMatrix<S> inverseK;
            invertBlock<S>(joint.row.data(), joint.block, inverseK);
            const BlockVector<S> lambda = -(inverseK * error);
            move(problem, joint, lambda.data());
            problem.applyRotations();
        }
    }

    static void move(PositionProblem<S>& problem, const JointPositions<S>& joint, const Real* lambda) {
        for (int r = 0; r < joint.block.rows; ++r) problem.move(joint.block, joint.row[r], lambda[r]);
    }

    void correctLimits(PositionProblem<S>& problem) {
        for (std::size_t j = 0; j < problem.jointCount(); ++j) {
            JointPositions<S>& joint = joints_[j];
            if (joint.count == joint.block.rows) continue;
            problem.evaluateJoint(j, joint);
            for (auto r = static_cast<std::size_t>(joint.block.rows);
                 r < static_cast<std::size_t>(joint.count); ++r)
                if (joint.row[r].error < 0)
                    problem.move(joint.block, joint.row[r], -joint.row[r].error * joint.row[r].invK);
            problem.applyRotations();
        }
    }

    static void correctContacts(PositionProblem<S>& problem, Real slop) {
        for (std::size_t c = 0; c < problem.contactCount(); ++c) {
            const Real error = problem.separation(c) + slop;
            if (error >= 0) continue;
            const Row<S>& row = problem.contactRow(c);
            problem.move(problem.contactBlock(c), row,
                         std::min(-kBaumgarte * error, kLongestMove) * row.invK);
        }
    }

    std::vector<JointPositions<S>> joints_;
    std::vector<std::size_t> held_;  ///< joints with equality rows
    std::vector<typename JointSystem<S>::Item> items_;
    JointSystem<S> system_;
    bool limited_ = false;  ///< some joint has limits
};

}  // namespace

template <class S>
std::unique_ptr<PositionCorrection<S>> makeNgs() {
    return std::make_unique<Ngs<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeNgs, PositionCorrection);

}  // namespace rigor::engine
