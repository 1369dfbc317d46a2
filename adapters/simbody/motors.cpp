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

double SimbodyWorld::rateOf(std::size_t motor, const Vector& rates) const {
    return model_->motors[motor].mobilizer.getOneFromUPartition(state_, 0, rates);
}

void SimbodyWorld::releaseMotors() {
    for (const Motor& motor : model_->motors)
        if (!motor.hold.isDisabled(state_)) motor.hold.disable(state_);
}

/// Forces that bring all coordinates to their speeds by the end of the step, each within its bound. `gain` are the
/// accelerations by a unit of each motor's force, `before` those without any.
std::vector<double> SimbodyWorld::motorForces(const std::vector<Vector>& gain, const Vector& before) const {
    const std::size_t count = gain.size();
    std::vector<double> forces(count, 0.0);
    for (int sweep = 0; sweep < (count > 1 ? kSweeps : 1); ++sweep)
        for (std::size_t i = 0; i < count; ++i) {
            const Motor& motor = model_->motors[i];
            double missing = (motor.speed - motor.mobilizer.getOneU(state_, 0)) / dt_ - rateOf(i, before);
            for (std::size_t j = 0; j < count; ++j) missing -= rateOf(i, gain[j]) * forces[j];
            const double own = rateOf(i, gain[i]);
            if (own > 0.0) forces[i] = std::clamp(forces[i] + missing / own, -motor.maxForce, motor.maxForce);
        }
    return forces;
}

/// Gives coordinates the rest of their speeds by impulses of their motors, and keeps them there.
void SimbodyWorld::hold(const std::vector<std::size_t>& held, const std::vector<Vector>& gain) {
    for (int sweep = 0; sweep < (held.size() > 1 ? kSweeps : 1); ++sweep)
        for (const std::size_t i : held) {
            const Motor& motor = model_->motors[i];
            const double missing = motor.speed - motor.mobilizer.getOneU(state_, 0);
            state_.updU() += missing / rateOf(i, gain[i]) * gain[i];
        }
    for (const std::size_t i : held) model_->motors[i].hold.enable(state_);
}

/// The accelerations that a motor's force gives to all coordinates are measured by applying it.
void SimbodyWorld::setMotors() {
    const auto& motors = model_->motors;
    releaseMotors();
    model_->system.realizeModel(state_);
    const auto push = [&](std::size_t of, double force) {
        model_->discrete.setOneMobilityForce(state_, motors[of].mobilizer, SimTK::MobilizerUIndex(0), force);
    };
    const auto accelerations = [&] {
        realize(SimTK::Stage::Acceleration);
        return Vector(state_.getUDot());
    };
    const Vector before = accelerations();
    std::vector<Vector> gain;
    for (std::size_t j = 0; j < motors.size(); ++j) {
        push(j, 1.0);
        gain.push_back(accelerations() - before);
        push(j, 0.0);
    }
    const std::vector<double> forces = motorForces(gain, before);
    std::vector<std::size_t> held;
    for (std::size_t i = 0; i < motors.size(); ++i) {
        const double missing = motors[i].speed - motors[i].mobilizer.getOneU(state_, 0);
        const bool enough = std::abs(forces[i]) < motors[i].maxForce && rateOf(i, gain[i]) > 0.0;
        if (enough &&
            (nearSpeed_[i] || std::abs(missing) <= kSameSpeed * std::max(1.0, std::abs(motors[i].speed))))
            held.push_back(i);
        else
            push(i, forces[i]);
        nearSpeed_[i] = enough;
    }
    hold(held, gain);
}

}  // namespace rigor::simbody
