// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Projected Gauss-Seidel on velocities, known as sequential impulses [Catto2005], [Catto2009].
//
// Each iteration visits the blocks and gives each the impulse that satisfies it alone:
//     joints    lambda += -K^-1 (J v + bias)                          all equality blocks of a group at once,
//                                                                     by a direct method (joint_system.hpp)
//     bounded   lambda := clamp(lambda - (J v + bias) / K, lower, upper)
//     contact   lambda_n := max(0, lambda_n - (J_n v + bias) / K_nn)  the accumulated impulse is clamped,
//                                                                     not its increment
//               lambda_t := friction law with limit mu lambda_n       both tangents at once
// and applies the increment to the velocities. Deviations from [Catto2005]:
//   - the contacts between two bodies are a group that is swept until it is nearly solved before the next one
//   is
//     visited (block Gauss-Seidel): a box then meets its neighbours without the rotation that solving its
//     corners one by one would leave it with, which is what makes tall stacks rock;
//   - iterations go forwards and backwards in turn, so that weight travels down a stack as fast as up;
//   - joints and tangent pairs are blocks, friction an exact local law (friction_cone.cpp); the normal goes
//   before
//     the tangents, so that friction has this sweep's limit.
//
// Where too many joints meet for the direct method, or joints have bounded rows, the group is swept as
// contacts are: bounded rows one by one and the equality blocks again after them.
//
// Cost: iterations * rows * (1..kInnerSweeps). Known limit: contacts converge linearly, slowly for large mass
// ratios.
#include <algorithm>
#include <cmath>

#include "engine/solvers/joint_system.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Pgs final : public Solver<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Pgs>(*this); }

    void solve(const SolverInput<S>& input) override {
        applyWarmStart<S>(input);
        findGroups(input.constraints.blocks);
        factorJoints(input.constraints);
        const std::size_t n = groups_.size() - 1;
        for (int i = 0; i < input.iterations; ++i) {
            input.monitor.before(input.velocities);
            Real change = 0;
            for (std::size_t k = 0; k < n; ++k) {
                const std::size_t group = (i % 2 == 0) ? k : n - 1 - k;
                change = std::max(change, solveGroup(input, groups_[group], groups_[group + 1]));
            }
            if (input.monitor.after(input.velocities, change)) break;
        }
    }

  private:
    static bool isJoint(const Block<S>& block) { return block.kind != BlockKind::Contact; }

    /// Consecutive contact blocks between the same two bodies form a group; so do all consecutive joints.
    void findGroups(const std::vector<Block<S>>& blocks) {
        groups_.clear();
        for (std::uint32_t i = 0; i < blocks.size(); ++i) {
            const bool joins =
                i > 0 && isJoint(blocks[i]) == isJoint(blocks[i - 1]) &&
                (isJoint(blocks[i]) || (blocks[i].a == blocks[i - 1].a && blocks[i].b == blocks[i - 1].b));
            if (!joins) groups_.push_back(i);
        }
        groups_.push_back(static_cast<std::uint32_t>(blocks.size()));
    }

    /// All equality blocks are one system. One alone is solved by its own inverse.
    void factorJoints(const ConstraintRows<S>& constraints) {
        items_.clear(), joints_.clear();
        for (std::uint32_t i = 0; i < constraints.blocks.size(); ++i) {
            const Block<S>& block = constraints.blocks[i];
            if (block.kind != BlockKind::Joint) continue;
            joints_.push_back(i);
            items_.push_back({&block, constraints.rows.data() + block.first});
        }
        direct_ = joints_.size() > 1 && system_.factor(items_);
    }

    /// Returns the residual that the group had when it was visited.
    Real solveGroup(const SolverInput<S>& input, std::uint32_t first, std::uint32_t last) {
        if (direct_ && isJoint(input.constraints.blocks[first])) return solveJoints(input, first, last);
        Real found = 0;
        const int sweeps = last - first > 1 ? kInnerSweeps : 1;
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            Real largest = 0;
            for (std::uint32_t k = 0; k < last - first; ++k) {
                // Joints forwards and backwards; contacts always forwards, which measurably calms stacks.
                const bool backwards = sweep % 2 != 0 && isJoint(input.constraints.blocks[first]);
                const Block<S>& block = input.constraints.blocks[backwards ? last - 1 - k : first + k];
                Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
                largest = std::max(largest, solveBlock(input, block, a, b));
            }
            if (sweep == 0) found = largest;
            if (largest <= kInnerTolerance * found) break;
        }
        return found;
    }

    /// The joints of one group: equality blocks by the factors, bounded rows between them one by one.
    Real solveJoints(const SolverInput<S>& input, std::uint32_t first, std::uint32_t last) {
        Real found = 0;
        for (int sweep = 0; sweep < kInnerSweeps; ++sweep) {
            Real largest = 0;
            bool bounded = false;
            for (std::uint32_t k = first; k < last; ++k) {
                const Block<S>& block = input.constraints.blocks[k];
                if (block.kind != BlockKind::Bounded) continue;
                bounded = true;
                largest = std::max(largest, solveBounded(input, block, input.velocities[block.a],
                                                         input.velocities[block.b]));
            }
            largest = std::max(largest, solveEqualities(input));
            if (sweep == 0) found = largest;
            if (!bounded || largest <= kInnerTolerance * found) break;
        }
        return found;
    }

    /// Returns the largest residual there was.
    Real solveEqualities(const SolverInput<S>& input) {
        Real largest = 0;
        for (std::size_t k = 0; k < joints_.size(); ++k) {
            const Block<S>& block = input.constraints.blocks[joints_[k]];
            const Row<S>* rows = input.constraints.rows.data() + block.first;
            const Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
            BlockVector<S>& right = system_.at(k);
            for (int i = 0; i < block.rows; ++i)
                right[i] =
                    -(rowVelocity<S>(rows[i], a, b) + rows[i].bias + rows[i].softness * rows[i].impulse);
            largest = std::max(largest, right.cwiseAbs().maxCoeff());
        }
        system_.solve();
        for (std::size_t k = 0; k < joints_.size(); ++k) {
            const Block<S>& block = input.constraints.blocks[joints_[k]];
            Row<S>* rows = input.constraints.rows.data() + block.first;
            const BlockVector<S>& lambda = system_.at(k);
            for (int i = 0; i < block.rows; ++i) {
                rows[i].impulse += lambda[i];
                applyRowImpulse<S>(rows[i], block, lambda[i], input.velocities[block.a],
                                   input.velocities[block.b]);
            }
        }
        return largest;
    }

    static Real solveBlock(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                           Velocity<S>& b) {
        switch (block.kind) {
            case BlockKind::Joint:
                return solveJoint(input, block, a, b);
            case BlockKind::Bounded:
                return solveBounded(input, block, a, b);
            case BlockKind::Contact:
                break;
        }
        return solveContact(input, block, a, b);
    }

    static Real solveBounded(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                             Velocity<S>& b) {
        Row<S>& row = input.constraints.rows[block.first];
        const Real error = rowVelocity<S>(row, a, b) + row.bias + row.softness * row.impulse;
        const Real accumulated = std::clamp(row.impulse - row.invK * error, row.lower, row.upper);
        const Real step = accumulated - row.impulse;
        row.impulse = accumulated;
        applyRowImpulse<S>(row, block, step, a, b);
        return row.invK > 0 ? std::abs(step) / row.invK : Real(0);
    }

    static Real solveJoint(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                           Velocity<S>& b) {
        Row<S>* rows = input.constraints.rows.data() + block.first;
        BlockVector<S> error(block.rows);
        for (int i = 0; i < block.rows; ++i)
            error[i] = rowVelocity<S>(rows[i], a, b) + rows[i].bias + rows[i].softness * rows[i].impulse;
        const BlockVector<S> lambda = -(input.constraints.matrices[block.matrix] * error);
        for (int i = 0; i < block.rows; ++i) {
            rows[i].impulse += lambda[i];
            applyRowImpulse<S>(rows[i], block, lambda[i], a, b);
        }
        return error.cwiseAbs().maxCoeff();
    }

    static Real solveContact(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                             Velocity<S>& b) {
        Row<S>* rows = input.constraints.rows.data() + block.first;
        Row<S>& normal = rows[0];
        const Real error = rowVelocity<S>(normal, a, b) + normal.bias + normal.softness * normal.impulse;
        const Real accumulated = std::max(Real(0), normal.impulse - normal.invK * error);
        const Real step = accumulated - normal.impulse;
        normal.impulse = accumulated;
        applyRowImpulse<S>(normal, block, step, a, b);
        Real residual = std::abs(step) / normal.invK;
        if (block.rows > 1) residual = std::max(residual, solveFriction(input, block, rows, a, b));
        return residual;
    }

    static Real solveFriction(const SolverInput<S>& input, const Block<S>& block, Row<S>* rows,
                              Velocity<S>& a, Velocity<S>& b) {
        using Vec2 = Eigen::Matrix<Real, 2, 1>;
        constexpr int tangents = S::tangents;
        Vec2 impulse = Vec2::Zero(), velocity = Vec2::Zero();
        for (int i = 0; i < tangents; ++i) {
            impulse[i] = rows[1 + i].impulse;
            velocity[i] = rowVelocity<S>(rows[1 + i], a, b);
        }
        const Vec2 next = contactFriction<S>(input.friction, block, impulse, velocity, rows[0].impulse);
        Real residual = 0;
        for (int i = 0; i < tangents; ++i) {
            const Real step = next[i] - impulse[i];
            rows[1 + i].impulse = next[i];
            applyRowImpulse<S>(rows[1 + i], block, step, a, b);
            residual = std::max(residual, std::abs(step) / rows[1 + i].invK);
        }
        return residual;
    }

    static constexpr int kInnerSweeps = 10;              ///< at most, per visit of a group
    static constexpr Real kInnerTolerance = Real(0.01);  ///< of the first sweep's residual
    std::vector<std::uint32_t> groups_;
    std::vector<std::uint32_t> joints_;  ///< equality blocks
    std::vector<typename JointSystem<S>::Item> items_;
    JointSystem<S> system_;
    bool direct_ = false;  ///< the factors are those of this solve
};

}  // namespace

template <class S>
std::unique_ptr<Solver<S>> makePgs() {
    return std::make_unique<Pgs<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makePgs, Solver);

}  // namespace rigor::engine
