// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Projected Gauss-Seidel on velocities, known as sequential impulses [Catto2005], [Catto2009].
//
// Each iteration visits the blocks in order and gives each the impulse that satisfies it alone:
//     joint     lambda += -K^-1 (J v + bias)                          all rows of the block at once
//     contact   lambda_n := max(0, lambda_n - (J_n v + bias) / K_nn)  the accumulated impulse is clamped,
//                                                                     not its increment
//               lambda_t := friction law with limit mu lambda_n       both tangents at once
// and applies the increment to the velocities. Deviation from [Catto2005]: joints and tangent pairs are
// solved as blocks, friction by an exact local law (see friction_cone.cpp), and the normal goes before the
// tangents, so that friction has this iteration's limit.
//
// Cost: iterations * rows. Known limit: linear convergence, slow for high stacks and large mass ratios.
#include <algorithm>
#include <cmath>

#include "engine/solvers/solver.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Pgs final : public Solver<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Pgs>(*this); }

    void solve(const SolverInput<S>& input, std::vector<Real>& residuals) override {
        residuals.clear();
        applyWarmStart<S>(input);
        for (int i = 0; i < input.iterations; ++i) {
            if (input.biases) input.biases->updateBiases(input.velocities);
            Real residual = 0;
            for (const Block<S>& block : input.constraints.blocks) {
                Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
                residual =
                    std::max(residual, block.kind == BlockKind::Contact ? solveContact(input, block, a, b)
                                                                        : solveJoint(input, block, a, b));
            }
            residuals.push_back(residual);
        }
    }

  private:
    static Real solveJoint(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                           Velocity<S>& b) {
        Row<S>* rows = input.constraints.rows.data() + block.first;
        BlockVector<S> error(block.rows);
        for (int i = 0; i < block.rows; ++i) error[i] = rowVelocity<S>(rows[i], a, b) + rows[i].bias;
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
        const Real error = rowVelocity<S>(normal, a, b) + normal.bias;
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
        const Vec2 next = input.friction(block.k11, block.k12, block.k22, impulse, velocity,
                                         block.friction * rows[0].impulse);
        Real residual = 0;
        for (int i = 0; i < tangents; ++i) {
            const Real step = next[i] - impulse[i];
            rows[1 + i].impulse = next[i];
            applyRowImpulse<S>(rows[1 + i], block, step, a, b);
            residual = std::max(residual, std::abs(step) / rows[1 + i].invK);
        }
        return residual;
    }
};

}  // namespace

template <class S>
std::unique_ptr<Solver<S>> makePgs() {
    return std::make_unique<Pgs<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makePgs, Solver);

}  // namespace rigor::engine
