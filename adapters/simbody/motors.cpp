// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Motors. Simbody has a constraint of constant speed without a bound on its force, so every step evaluates whether a
// bounded force is enough: the speed is then a constraint, else the force is the bound.
#include <algorithm>
#include <cmath>

#include "adapters/simbody/world.hpp"

namespace rigor::simbody {

using SimTK::Vector;

namespace {

constexpr int kSweeps = 200;

/// Difference of speed that counts as none, over the speed or 1.
constexpr double kSameSpeed = 1e-9;

}  // namespace

double Motor::rate(const SimTK::State& state) const {
    if (pair == nullptr) return mobilizer.getOneU(state, 0);
    const PairCoordinate& on = pair->coordinate();
    return PairCoordinate::product(on.gradient(on.poses(state)), on.motions(state));
}

double Motor::gain(const SimTK::State& state, const Vector& change) const {
    if (pair == nullptr) return mobilizer.getOneFromUPartition(state, 0, change);
    const PairCoordinate& on = pair->coordinate();
    SimTK::Vector_<SimTK::SpatialVec> bodies;
    on.a().getMatterSubsystem().multiplyBySystemJacobian(state, change, bodies);
    return PairCoordinate::product(on.gradient(on.poses(state)), {bodies[on.a().getMobilizedBodyIndex()],
                                                                  bodies[on.b().getMobilizedBodyIndex()]});
}

double Motor::acceleration(const SimTK::State& state, const Vector& all) const {
    if (pair == nullptr) return gain(state, all);
    const PairCoordinate& on = pair->coordinate();
    SimTK::Vector_<SimTK::SpatialVec> bodies;
    on.a().getMatterSubsystem().calcBodyAccelerationFromUDot(state, all, bodies);
    const PairCoordinate::Poses at = on.poses(state);
    return on.bias(at, on.motions(state)) +
           PairCoordinate::product(on.gradient(at), {bodies[on.a().getMobilizedBodyIndex()],
                                                     bodies[on.b().getMobilizedBodyIndex()]});
}

void Motor::push(SimTK::State& state, const SimTK::Force::DiscreteForces& discrete, double amount) const {
    if (pair != nullptr)
        pair->push(state, amount);
    else
        discrete.setOneMobilityForce(state, mobilizer, SimTK::MobilizerUIndex(0), amount);
}

void SimbodyWorld::releaseMotors() {
    for (const Motor& motor : model_->motors)
        if (!motor.hold.isDisabled(state_)) motor.hold.disable(state_);
}

/// The accelerations that a motor's force gives to all coordinates are measured by applying it.
SimbodyWorld::MotorProblem SimbodyWorld::motorProblem() {
    const auto& motors = model_->motors;
    const auto accelerations = [&] {
        realize(SimTK::Stage::Acceleration);
        return Vector(state_.getUDot());
    };
    for (const Motor& motor : motors) motor.push(state_, model_->discrete, 0.0);
    const Vector before = accelerations();
    MotorProblem problem;
    for (const Motor& motor : motors) {
        problem.rates.push_back(motor.rate(state_));
        problem.accelerations.push_back(motor.acceleration(state_, before));
    }
    for (const Motor& motor : motors) {
        motor.push(state_, model_->discrete, 1.0);
        problem.changes.push_back(accelerations() - before);
        motor.push(state_, model_->discrete, 0.0);
        std::vector<double> gains;
        for (const Motor& other : motors) gains.push_back(other.gain(state_, problem.changes.back()));
        problem.gains.push_back(std::move(gains));
    }
    return problem;
}

/// Forces that bring all coordinates to their speeds by the end of the step, each within its bound.
std::vector<double> SimbodyWorld::motorForces(const MotorProblem& problem) const {
    const std::size_t count = model_->motors.size();
    std::vector<double> forces(count, 0.0);
    for (int sweep = 0; sweep < (count > 1 ? kSweeps : 1); ++sweep)
        for (std::size_t i = 0; i < count; ++i) {
            const Motor& motor = model_->motors[i];
            double missing = (motor.speed - problem.rates[i]) / dt_ - problem.accelerations[i];
            for (std::size_t j = 0; j < count; ++j) missing -= problem.gains[j][i] * forces[j];
            const double own = problem.gains[i][i];
            if (own > 0.0) forces[i] = std::clamp(forces[i] + missing / own, -motor.maxForce, motor.maxForce);
        }
    return forces;
}

/// Gives coordinates the rest of their speeds by impulses of their motors, and keeps them there.
void SimbodyWorld::hold(const std::vector<std::size_t>& held, const MotorProblem& problem) {
    std::vector<double> impulses(problem.rates.size(), 0.0);
    for (int sweep = 0; sweep < (held.size() > 1 ? kSweeps : 1); ++sweep)
        for (const std::size_t i : held) {
            double missing = model_->motors[i].speed - problem.rates[i];
            for (const std::size_t j : held) missing -= problem.gains[j][i] * impulses[j];
            impulses[i] += missing / problem.gains[i][i];
        }
    for (const std::size_t i : held) {
        state_.updU() += impulses[i] * problem.changes[i];
        model_->motors[i].hold.enable(state_);
    }
}

void SimbodyWorld::setMotors() {
    const auto& motors = model_->motors;
    releaseMotors();
    model_->system.realizeModel(state_);
    const MotorProblem problem = motorProblem();
    const std::vector<double> forces = motorForces(problem);
    std::vector<std::size_t> held;
    for (std::size_t i = 0; i < motors.size(); ++i) {
        const double missing = motors[i].speed - problem.rates[i];
        const bool enough = std::abs(forces[i]) < motors[i].maxForce && problem.gains[i][i] > 0.0;
        if (enough &&
            (nearSpeed_[i] || std::abs(missing) <= kSameSpeed * std::max(1.0, std::abs(motors[i].speed))))
            held.push_back(i);
        else
            motors[i].push(state_, model_->discrete, forces[i]);
        nearSpeed_[i] = enough;
    }
    hold(held, problem);
}

}  // namespace rigor::simbody
