// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/methods/newton_finish.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/solvers/impulses.hpp"
#include "engine/solvers/matrix_space.hpp"

namespace rigor::engine {

template <class S>
typename S::Real renewedResidual(const SolverInput<S>& input) {
    input.monitor.before(input.velocities);
    return naturalMapResidual<S>(input.constraints, input.velocities);
}

template <class S>
void NewtonFinish<S>::Saved::save(const SolverInput<S>& input) {
    readImpulses(input.constraints, impulses);
    velocities.assign(input.velocities.begin(), input.velocities.end());
}
template <class S>
void NewtonFinish<S>::Saved::restore(const SolverInput<S>& input) const {
    for (std::size_t i = 0; i < impulses.size(); ++i) input.constraints.rows[i].impulse = impulses[i];
    std::copy(velocities.begin(), velocities.end(), input.velocities.begin());
}

template <class S>
void NewtonFinish<S>::assemble(const SolverInput<S>& input) {
    if (assembled_) return;
    problem_.assemble<S>(input.constraints, input.velocities.size());
    eliminated_ = joints_.eliminate(problem_, kJointShift);
    assembled_ = true;
}

/// A step of Newton's method to target_, on the rows without the free ones where there are such.
template <class S>
bool NewtonFinish<S>::takeNewtonStep(double damping) {
    if (!eliminated_) return newton_.step(problem_, damping, target_);
    if (!newton_.step(joints_.reduce(problem_), damping, reduced_)) return false;
    joints_.expand(problem_, reduced_, target_);
    return true;
}

template <class S>
typename S::Real NewtonFinish<S>::attempt(const SolverInput<S>& input, Real residual, Real goal, int steps) {
    assemble(input);
    best_.save(input);
    Real best = residual;
    double damping = kLeastDamping, least = kLeastDamping;
    int astray = 0, fruitless = 0;
    for (int step = 0; step < steps && best > goal && fruitless <= kMostFruitless; ++step) {
        problem_.readVelocities<S>(input.constraints, input.velocities);
        if (!eliminated_) problem_.findOffsets();
        Real reached = std::numeric_limits<Real>::infinity();
        if (takeNewtonStep(damping) && !runsAway()) reached = take(input, target_);
        if (reached < best) {
            best = reached;
            astray = fruitless = 0;
            best_.save(input);
            damping = std::max(least, 1e-2 * damping);
            continue;
        }
        if (eliminated_ && reached < kStill * best) break;
        ++fruitless;
        if (!(reached < kLost * best) || ++astray > 2) {
            best_.restore(input);
            input.monitor.before(input.velocities);
            damping *= 100;
            if (eliminated_) damping = least = std::max(damping, kJointDamping);
            astray = 0;
            if (damping > kMostDamping) break;
        }
    }
    best_.restore(input);
    return renewedResidual(input);
}

template <class S>
typename S::Real NewtonFinish<S>::attemptFromInside(const SolverInput<S>& input, Real residual, Real goal) {
    assemble(input);
    if (interiorStarts_ == kInteriorStarts || !ContactInterior::fits(problem_)) return residual;
    constexpr std::array<double, kInteriorStarts> kShifts{1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
    const double shift = kShifts[static_cast<std::size_t>(interiorStarts_++)];
    before_.save(input);
    problem_.readVelocities<S>(input.constraints, input.velocities);
    problem_.findOffsets();
    if (!interior_.solve(problem_, shift, target_)) return residual;
    const Real reached = attempt(input, take(input, target_), goal);
    if (reached < residual) return reached;
    before_.restore(input);
    return renewedResidual(input);
}

/// Sets impulses, brought back into cones and bounds; returns their residual.
template <class S>
typename S::Real NewtonFinish<S>::take(const SolverInput<S>& input, const std::vector<double>& impulses) {
    next_.assign(impulses.begin(), impulses.end());
    projectImpulses(input.constraints, next_);
    setImpulses(input, next_);
    return renewedResidual(input);
}

/// Impulses far beyond those there are: a singular system, whose rounding the velocities would keep.
template <class S>
bool NewtonFinish<S>::runsAway() const {
    double now = 0, then = 0;
    for (std::size_t i = 0; i < problem_.n; ++i) {
        const double K = problem_.at(i, i);
        now = std::max(
            now, K * std::abs(problem_.lambda[i]) + std::abs(eliminated_ ? problem_.w[i] : problem_.q[i]));
        then = std::max(then, K * std::abs(target_[i]));
    }
    return !(then < 1e3 * now);
}

#define RIGOR_INSTANTIATE(S)        \
    template class NewtonFinish<S>; \
    template typename S::Real renewedResidual<S>(const SolverInput<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
RIGOR_INSTANTIATE(MatrixSpace<2>)
RIGOR_INSTANTIATE(MatrixSpace<3>)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
