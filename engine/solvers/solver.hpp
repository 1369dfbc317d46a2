// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A solver finds impulses for blocks of rows. It never knows joints or shapes.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/constraints/row.hpp"
#include "engine/core/table.hpp"

namespace rigor::engine {

/// Friction of one contact with two tangents: given K of the tangent rows, the accumulated impulse, the
/// tangential velocity it has led to and the largest magnitude allowed, the new accumulated impulse. With one
/// tangent (2D) K is diag(k, 1) and the second components are zero.
template <class S>
using FrictionLaw = Eigen::Matrix<typename S::Real, 2, 1> (*)(
    typename S::Real k11, typename S::Real k12, typename S::Real k22,
    const Eigen::Matrix<typename S::Real, 2, 1>& impulse,
    const Eigen::Matrix<typename S::Real, 2, 1>& velocity, typename S::Real limit);
template <class S>
std::span<const AlgorithmEntry<FrictionLaw<S>>> frictionTable();

/// Lets the maker of the rows renew their biases for the velocities reached so far.
template <class S>
class BiasUpdate {
  public:
    virtual ~BiasUpdate() = default;
    virtual void updateBiases(std::span<const Velocity<S>> velocities) = 0;
};

template <class S>
struct SolverInput {
    ConstraintRows<S>& constraints;     ///< impulses hold the warm start, and the answer afterwards
    std::span<Velocity<S>> velocities;  ///< by dense body index; changed in place
    FrictionLaw<S> friction;
    BiasUpdate<S>* biases = nullptr;  ///< called before each iteration; may be null
    int iterations = 8;
    typename S::Real tolerance = 0;  ///< ends early when an iteration's residual is below [m/s or rad/s]
};

template <class S>
class Solver {
  public:
    virtual ~Solver() = default;
    virtual std::unique_ptr<Solver> clone() const = 0;
    /// Replaces `residuals` by one value per iteration: the largest velocity error [m/s or rad/s] that the
    /// iteration removed from a block. No allocation in a steady state.
    virtual void solve(const SolverInput<S>& input, std::vector<typename S::Real>& residuals) = 0;
};

template <class S>
using SolverFactory = std::unique_ptr<Solver<S>> (*)();
template <class S>
std::span<const AlgorithmEntry<SolverFactory<S>>> solverTable();

/// Applies the impulses that the rows start with.
template <class S>
void applyWarmStart(const SolverInput<S>& input) {
    for (const Block<S>& block : input.constraints.blocks)
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            const Row<S>& row = input.constraints.rows[i];
            applyRowImpulse<S>(row, block, row.impulse, input.velocities[block.a], input.velocities[block.b]);
        }
}

}  // namespace rigor::engine
