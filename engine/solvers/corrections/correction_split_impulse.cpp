// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Split impulses: a second velocity for position errors alone [Catto2009, "pseudo velocities"]. With pseudo
// velocities u, starting from zero each step and forgotten after it, projected Gauss-Seidel solves
//     joints            J u + beta C / h = 0
//     contacts, limits  0 <= lambda _|_ J u + beta (C + slop) / h >= 0
// and the bodies move by h u more. The real velocities never see it, so no energy enters through them. In
// units of position, d = h u, this is one linear problem with accumulated impulses:
//     lambda := lambda - (J d + beta C) / K,   clamped to >= 0 for contacts and limits
// against ngs (correction_ngs.cpp), which evaluates C anew after every single move. Deviation: errors are
// those after the bodies have moved, so that overlap that the motion has opened already is not corrected as
// well.
//
// Cost: iterations * rows, evaluating each joint once. Known limit: rotations are linearised over the whole
// correction; a joint that is far off goes to the tangent and needs several steps.
#include <algorithm>

#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {
namespace {

template <class S>
class SplitImpulse final : public PositionCorrection<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<PositionCorrection<S>> clone() const override {
        return std::make_unique<SplitImpulse>(*this);
    }

    void correct(PositionProblem<S>& problem, const PositionIterations& iterations, Real slop) override {
        gather(problem, slop);
        for (int i = 0; i < iterations.usual; ++i)
            for (Unit& unit : units_) {
                const Real moved = problem.moved(unit.block, unit.row) - unit.start;
                Real lambda = unit.lambda - (moved + unit.error) * unit.row.invK;
                if (unit.unilateral) lambda = std::max(Real(0), lambda);
                problem.move(unit.block, unit.row, lambda - unit.lambda);
                unit.lambda = lambda;
            }
        problem.applyRotations();
    }

  private:
    static constexpr Real kBaumgarte = Real(0.2);    ///< beta
    static constexpr Real kLongestMove = Real(0.2);  ///< longest move per step and contact [m]

    struct Unit {
        Block<S> block;
        Row<S> row;
        Real error = 0;  ///< beta C
        Real start = 0;  ///< J times what had moved before
        Real lambda = 0;
        bool unilateral = false;
    };

    void gather(PositionProblem<S>& problem, Real slop) {
        units_.clear();
        for (std::size_t j = 0; j < problem.jointCount(); ++j) {
            problem.evaluateJoint(j, joint_);
            for (std::size_t r = 0; r < static_cast<std::size_t>(joint_.count); ++r) {
                const Row<S>& row = joint_.row[r];
                if (joint_.unilateral[r] && row.error >= 0) continue;
                units_.push_back({joint_.block, row, kBaumgarte * row.error, problem.moved(joint_.block, row),
                                  0, joint_.unilateral[r]});
            }
        }
        for (std::size_t c = 0; c < problem.contactCount(); ++c) {
            // Contacts that are open by less than the correction may close take part: they hold against it.
            const Real error = problem.separation(c) + slop;
            const Block<S>& block = problem.contactBlock(c);
            const Row<S>& row = problem.contactRow(c);
            const Real requested = error < 0 ? std::max(kBaumgarte * error, -kLongestMove) : error;
            units_.push_back({block, row, requested, problem.moved(block, row), 0, true});
        }
    }

    std::vector<Unit> units_;
    JointPositions<S> joint_;
};

}  // namespace

template <class S>
std::unique_ptr<PositionCorrection<S>> makeSplitImpulse() {
    return std::make_unique<SplitImpulse<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeSplitImpulse, PositionCorrection);

}  // namespace rigor::engine
