// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Projected Jacobi with mass splitting [Tonge2012]: in an iteration everything is solved from the same
// velocities, so that the order of contacts does not matter and all of it could be done at once. Plain Jacobi
// diverges as soon as a body takes part in several constraints, whose impulses all remove the same error.
// Here a body with n partners is n bodies of mass m / n, one for each partner, moving together:
//     each pair of bodies   solve its rows with the masses m_A / n_A, m_B / n_B      (K grows accordingly)
//     each body             v := mean over its parts = v + M^-1 sum of J^T d(lambda)
// The split K, as a quadratic form, is nowhere below the true one, so for frictionless contacts and joints
// each iteration lowers the energy of the error: it converges, without a relaxation factor to choose.
//
// The rows between two bodies (a manifold, a joint with its limits) are one unit, swept until nearly solved
// with the kernels of sequential_impulses.hpp: fewer parts per body, hence faster than a split by contact point.
//
// Cost: iterations * rows * (1..kInnerSweeps), plus a copy of the rows per step. Known limit: information
// travels one body per iteration and in parts of 1/n: several times the iterations of pgs for the same
// residual.
#include "engine/solvers/joints/joint_inverses.hpp"
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Jacobi final : public Solver<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Jacobi>(*this); }

    void useThreads(const Tasks& tasks) override { tasks_ = &tasks; }

    void solve(const SolverInput<S>& input) override {
        applyWarmStart<S>(input);
        findUnits(input.constraints.blocks, input.velocities.size());
        splitMasses(input);
        const SolverInput<S> split{split_,        input.velocities,        input.friction,
                                   input.monitor, input.iterations,        input.h,
                                   true,          input.residualTolerance, input.pyramidDirections};
        for (int i = 0; i < input.iterations; ++i) {
            input.monitor.before(input.velocities);
            for (std::size_t r = 0; r < split_.rows.size(); ++r)
                split_.rows[r].bias = input.constraints.rows[r].bias;
            const Real change = iterate(split);
            for (std::size_t r = 0; r < split_.rows.size(); ++r)
                input.constraints.rows[r].impulse = split_.rows[r].impulse;
            if (input.monitor.after(input.velocities, change)) break;
        }
    }

  private:
    /// Consecutive blocks between the same two bodies are a unit; partners_ counts the units of a body.
    void findUnits(const std::vector<Block<S>>& blocks, std::size_t bodies) {
        units_.clear();
        partners_.assign(bodies, Real(0));
        for (std::uint32_t i = 0; i < blocks.size(); ++i) {
            if (i > 0 && blocks[i].a == blocks[i - 1].a && blocks[i].b == blocks[i - 1].b) continue;
            units_.push_back(i);
            partners_[blocks[i].a] += 1;
            partners_[blocks[i].b] += 1;
        }
        units_.push_back(static_cast<std::uint32_t>(blocks.size()));
    }

    /// The rows with m / n in place of m.
    void splitMasses(const SolverInput<S>& input) {
        const ConstraintRows<S>& whole = input.constraints;
        split_.rows.assign(whole.rows.begin(), whole.rows.end());
        split_.blocks.assign(whole.blocks.begin(), whole.blocks.end());
        tasks_->forEach(split_.blocks.size(), kBlockGrain, [this](std::size_t k) {
            Block<S>& block = split_.blocks[k];
            const Real nA = partners_[block.a], nB = partners_[block.b];
            block.invMassA *= nA;
            block.invMassB *= nB;
            Row<S>* rows = split_.rows.data() + block.first;
            for (int i = 0; i < block.rows; ++i) {
                rows[i].invIAngA *= nA;
                rows[i].invIAngB *= nB;
                const Real K = rowK<S>(rows[i], block);
                rows[i].invK = K > 0 ? Real(1) / K : Real(0);
            }
            if (block.kind == BlockKind::Moment) {
                const Row<S>&t1 = rows[0], &t2 = rows[block.rows - 1];
                block.k11 = rowCoupling<S>(t1, t1, block);
                block.k12 = block.rows > 1 ? rowCoupling<S>(t1, t2, block) : Real(0);
                block.k22 = block.rows > 1 ? rowCoupling<S>(t2, t2, block) : Real(1);
            }
            if (block.kind == BlockKind::Contact && block.rows > 1) {
                const Row<S>&t1 = rows[1], &t2 = rows[S::tangents];
                block.k11 = rowCoupling<S>(t1, t1, block);
                if (S::tangents > 1) {
                    block.k12 = rowCoupling<S>(t1, t2, block);
                    block.k22 = rowCoupling<S>(t2, t2, block);
                }
            }
        });
        invertJoints<S>(split_);
    }

    Real iterate(const SolverInput<S>& split) {
        results_.resize(units_.size() - 1);
        tasks_->forEach(results_.size(), kUnitGrain, [&](std::size_t u) {
            const Block<S>& block = split_.blocks[units_[u]];
            Result& result = results_[u];
            result.a = split.velocities[block.a];
            result.b = split.velocities[block.b];
            result.change = solveUnit(split, units_[u], units_[u + 1], result.a, result.b);
        });
        // The order of a sum is part of it: unit by unit.
        Real change = 0;
        change_.assign(partners_.size(), Velocity<S>{});
        for (std::size_t u = 0; u < results_.size(); ++u) {
            const Block<S>& block = split_.blocks[units_[u]];
            change = std::max(change, results_[u].change);
            collect(block.a, results_[u].a, split.velocities[block.a]);
            collect(block.b, results_[u].b, split.velocities[block.b]);
        }
        for (std::size_t i = 0; i < change_.size(); ++i) {
            split.velocities[i].v += change_[i].v;
            split.velocities[i].w += change_[i].w;
        }
        return change;
    }

    void collect(std::uint32_t body, const Velocity<S>& part, const Velocity<S>& whole) {
        change_[body].v += (part.v - whole.v) / partners_[body];
        change_[body].w += (part.w - whole.w) / partners_[body];
    }

    /// Returns the error of the unit before it was solved.
    static Real solveUnit(const SolverInput<S>& split, std::uint32_t first, std::uint32_t last,
                          Velocity<S>& a, Velocity<S>& b) {
        Real found = 0;
        const int sweeps = last - first > 1 ? kInnerSweeps : 1;
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            Real largest = 0;
            for (std::uint32_t k = first; k < last; ++k)
                largest = std::max(largest, solveBlock(split, split.constraints.blocks[k], a, b));
            if (sweep == 0) found = largest;
            if (largest <= kInnerTolerance * found) break;
        }
        return found;
    }

    static Real solveBlock(const SolverInput<S>& split, const Block<S>& block, Velocity<S>& a,
                           Velocity<S>& b) {
        if (block.kind == BlockKind::Joint) return solveJointBlock(split, block, a, b);
        if (block.kind == BlockKind::Bounded) return solveBoundedRow(split, block, a, b);
        if (block.kind == BlockKind::Moment) return solveMoment(split, block, a, b);
        const Real residual = solveNormal(split, block, a, b);
        return std::max(residual, solveFriction(split, block, a, b));
    }

    /// maximum number of sweeps per unit and iteration
    static constexpr int kInnerSweeps = 10;
    /// relative to the first sweep's residual
    static constexpr Real kInnerTolerance = Real(0.01);
    static constexpr std::size_t kBlockGrain = 64, kUnitGrain = 16;  ///< some microseconds of work
    struct Result {
        Velocity<S> a, b;  ///< velocities of the split parts of its bodies
        Real change = 0;
    };
    const Tasks* tasks_ = &Tasks::one();
    ConstraintRows<S> split_;
    std::vector<std::uint32_t> units_;
    std::vector<Real> partners_;
    std::vector<Result> results_;      ///< result of each unit
    std::vector<Velocity<S>> change_;  ///< velocity change of the bodies in this iteration
};

}  // namespace

SolverTraits makeJacobiTraits() {
    return {};
}

template <class S>
std::unique_ptr<Solver<S>> makeJacobi() {
    return std::make_unique<Jacobi<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeJacobi, Solver);

}  // namespace rigor::engine
