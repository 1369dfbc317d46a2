// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A solver finds impulses for blocks of rows. It never knows joints or shapes.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/constraints/row.hpp"
#include "engine/constraints/soft.hpp"
#include "engine/core/table.hpp"
#include "engine/core/tasks.hpp"
#include "engine/solvers/position_correction.hpp"

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
/// The exact law (friction_cone.cpp).
template <class R>
Eigen::Matrix<R, 2, 1> frictionCone(R k11, R k12, R k22, const Eigen::Matrix<R, 2, 1>& impulse,
                                    const Eigen::Matrix<R, 2, 1>& velocity, R limit);

/// Looks over a solver's shoulder, iteration by iteration.
template <class S>
class IterationMonitor {
  public:
    virtual ~IterationMonitor() = default;
    /// Lets the maker of the rows renew their biases for the velocities reached so far.
    virtual void before(std::span<const Velocity<S>> velocities) = 0;
    /// The same for some blocks alone, in ascending order.
    virtual void before(std::span<const Velocity<S>> velocities, std::span<const std::uint32_t> blocks) {
        (void)blocks;
        before(velocities);
    }
    /// Whether before() may change the biases of a block.
    virtual bool mayRenew(std::uint32_t block) const {
        (void)block;
        return true;
    }
    /// `change` is the largest velocity error [m/s or rad/s] that the iteration removed from a row or block.
    /// True: good enough, stop.
    virtual bool after(std::span<const Velocity<S>> velocities, typename S::Real change) = 0;
    /// Velocity errors below this are good enough [m/s or rad/s]; 0: none is.
    virtual typename S::Real tolerance() const { return 0; }
};

template <class S>
struct SolverInput {
    using Real = typename S::Real;
    ConstraintRows<S>& constraints;     ///< impulses hold the warm start, and the solution afterwards
    std::span<Velocity<S>> velocities;  ///< velocities by dense body index; changed in place
    FrictionLaw<S> friction;
    IterationMonitor<S>& monitor;  ///< called around each iteration
    int iterations = 8;            ///< maximum number of iterations
    Real h = 0;                    ///< length of this (sub-)step [s]
    bool warmStarted = false;      ///< the velocities already contain the rows' impulses (relaxation)
    Real residualTolerance = 0;    ///< natural map at which solvers that iterate on it may stop [m/s]
    int pyramidDirections = 4;     ///< generators of the polyhedral friction cone, even (lemke)
};

/// Requirements of a solver on the step around it.
template <class S>
struct SolverStyle {
    using Real = typename S::Real;
    int substeps = 1;  ///< used if the world sets none (WorldDef::substeps 0)
    /// Iterations of each sub-step if the world sets none (WorldDef::velocityIterations 0). A solver with a
    /// number of its own makes no additional iterations in the first step.
    std::optional<int> iterations;
    /// Iterates on positions: bodies move first, solvePositions() puts them right, velocities are what moved
    /// them, and solve() is the velocity pass after that. Else solve() comes first and bodies move with it.
    bool positions = false;
    /// Effect of position errors on the rows if the solver has its own; otherwise that of the position
    /// correction.
    std::optional<BiasRule<Real>> bias;
    /// Effect for joints that are linearised (WorldDef::relinearizedJoints off), if it is not the same.
    std::optional<BiasRule<Real>> linearJointBias;
    /// Iterations of solve() after the bodies have moved, with relaxed biases.
    int relaxIterations = 0;
    bool ownsCorrection = false;  ///< position correction after the step is not wanted
};

template <class S>
class Solver {
  public:
    virtual ~Solver() = default;
    virtual std::unique_ptr<Solver> clone() const = 0;
    virtual SolverStyle<S> style() const { return {}; }
    /// Sets the threads of the next solve() of solvers that distribute their sweeps among threads. The result
    /// does not depend on them.
    virtual void useThreads(const Tasks& tasks) { (void)tasks; }
    /// Changes impulses and velocities. No allocation in a steady state.
    virtual void solve(const SolverInput<S>& input) = 0;
    /// The last solve() did not reach what it promises and left the best it had.
    virtual bool gaveUp() const { return false; }
    /// Called only with style().positions: changes poses through `problem`.
    virtual void solvePositions(PositionProblem<S>& problem, const SolverInput<S>& input) {
        (void)problem;
        (void)input;
    }
};

template <class S>
using SolverFactory = std::unique_ptr<Solver<S>> (*)();
template <class S>
std::span<const AlgorithmEntry<SolverFactory<S>>> solverTable();

/// Friction of a contact: the law with the limit of sliding, or its solution with the limit of sticking where
/// that is inside the limit. `impulse` is the tangents' accumulated impulse, `velocity` what it has led to.
template <class S>
Eigen::Matrix<typename S::Real, 2, 1> contactFriction(FrictionLaw<S> law, const Block<S>& block,
                                                      const Eigen::Matrix<typename S::Real, 2, 1>& impulse,
                                                      const Eigen::Matrix<typename S::Real, 2, 1>& velocity,
                                                      typename S::Real normalImpulse) {
    using Real = typename S::Real;
    const Real pressed = normalImpulse + block.appliedNormal;
    if (block.staticFriction > block.friction) {
        const Eigen::Matrix<Real, 2, 1> stuck =
            law(block.k11, block.k12, block.k22, impulse, velocity, block.staticFriction * pressed);
        const Real slip1 =
            velocity[0] + block.k11 * (stuck[0] - impulse[0]) + block.k12 * (stuck[1] - impulse[1]);
        const Real slip2 =
            velocity[1] + block.k12 * (stuck[0] - impulse[0]) + block.k22 * (stuck[1] - impulse[1]);
        // Rounding of velocities of the size that friction has to stop.
        const Real still =
            Real(64) * std::numeric_limits<Real>::epsilon() *
            (std::abs(velocity[0]) + std::abs(velocity[1]) +
             (block.k11 + block.k22) * (std::abs(impulse[0]) + std::abs(impulse[1]) + pressed));
        if (std::abs(slip1) <= still && std::abs(slip2) <= still) return stuck;
    }
    return law(block.k11, block.k12, block.k22, impulse, velocity, block.friction * pressed);
}

/// Applies the impulses that the rows start with, unless the velocities contain them already.
template <class S>
void applyWarmStart(const SolverInput<S>& input) {
    if (input.warmStarted) return;
    for (const Block<S>& block : input.constraints.blocks)
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            const Row<S>& row = input.constraints.rows[i];
            applyRowImpulse<S>(row, block, row.impulse, input.velocities[block.a], input.velocities[block.b]);
        }
}

}  // namespace rigor::engine
