// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/stepper.hpp"

#include "validation/hash.hpp"
#include "validation/runner/forces.hpp"

namespace rigor::validation {
namespace {

using adapter::BodyState;

bool isFiniteState(const BodyState& s) {
    return isFinite(s.position) && isFinite(s.orientation) && isFinite(s.velocity) &&
           isFinite(s.angularVelocity);
}

}  // namespace

Stepper::Stepper(const scenario::Scenario& scenario, double dt, adapter::World& world)
    : scenario_(scenario),
      dt_(dt),
      world_(world),
      needsStates_(forcesNeedStates(scenario, world)),
      states_(scenario.bodies.size()) {}

void Stepper::begin() {
    if (needsStates_) (void)states();
    applyForces(scenario_, steps_, dt_, states_, world_);
}

void Stepper::end() {
    ++steps_;
    statesRead_ = false;
}

void Stepper::jumpTo(std::size_t steps) {
    steps_ = steps;
    statesRead_ = false;
}

std::span<const BodyState> Stepper::states() {
    if (!statesRead_) world_.readStates(states_);
    statesRead_ = true;
    return states_;
}

std::string Stepper::nonFinite() {
    const std::span<const BodyState> now = states();
    for (std::size_t i = 0; i < now.size(); ++i)
        if (!isFiniteState(now[i]))
            return "the state of " + scenario_.bodies[i].name +
                   " is not finite at t = " + std::to_string(time()) + " s";
    return "";
}

std::string Stepper::stateHash() {
    Fnv1a hash;
    for (const BodyState& s : states())
        for (const double v : {s.position.x, s.position.y, s.position.z, s.orientation.w, s.orientation.x,
                               s.orientation.y, s.orientation.z, s.velocity.x, s.velocity.y, s.velocity.z,
                               s.angularVelocity.x, s.angularVelocity.y, s.angularVelocity.z})
            hash.number(v);
    return hash.hex();
}

}  // namespace rigor::validation
