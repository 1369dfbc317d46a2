// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as a multibody system of Simbody: building, stepping, snapshots.
#include "adapters/simbody/world.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "adapters/interface/joint_springs.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/snapshot_numbers.hpp"
#include "adapters/simbody/integrators.hpp"

namespace rigor::simbody {

using adapter::BodyState;
using scenario::Body;
using scenario::BodyType;
using SimTK::Stage;
using SimTK::Vector;

SimbodyWorld::SimbodyWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings)
    : scenario_(adapter::withStiffness(scenario.dimension == 2 ? adapter::planarLift(scenario) : scenario)),
      settings_(settings),
      dt_(dt),
      planar_(scenario.dimension == 2),
      model_(buildModel(scenario_, planar_)),
      integrator_(makeIntegrator(model_->system, dt, settings)),
      forces_(scenario_.bodies.size()) {
    state_ = model_->system.realizeTopology();
    model_->system.realizeModel(state_);
    nearSpeed_.resize(model_->motors.size());
    std::vector<BodyState> start;
    for (const Body& body : scenario_.bodies)
        start.push_back({body.pose.position, body.pose.orientation, body.velocity, body.angularVelocity});
    place(start);
    for (LoopJoint& joint : model_->loops) joint.dropIdle(model_->system, state_);
    realize(Stage::Velocity);
}

/// Springs on angles count full turns by their last value.
void SimbodyWorld::countTurns() {
    if (!model_->turns.empty()) realize(Stage::Position);
    for (const PairSpring* spring : model_->turns) spring->follow(state_);
}

bool SimbodyWorld::is(const char* key, const char* value) const {
    return adapter::textSetting(settings_, key) == value;
}

void SimbodyWorld::place(std::span<const BodyState> states) {
    for (const int body : model_->forest.order)
        if (scenario_.bodies[body].type == BodyType::Dynamic)
            placeBody(*model_, scenario_, body, states, state_);
    model_->system.realize(state_, Stage::Time);
    model_->system.prescribeQ(state_);
    realize(Stage::Position);
    model_->system.prescribeU(state_);
    countTurns();
    realize(Stage::Velocity);
}

void SimbodyWorld::applyForce(int body, const Vec3& force, const Vec3& torque) {
    if (scenario_.bodies[body].type != BodyType::Dynamic) return;
    forces_[body].force += force;
    forces_[body].torque += torque;
}

/// The velocities change by M^-1 J^T p, less what the constraints do not allow.
bool SimbodyWorld::applyImpulse(int body, const Vec3& impulse, const Vec3& angularImpulse) {
    if (scenario_.bodies[body].type != BodyType::Dynamic) return true;
    const SimTK::SimbodyMatterSubsystem& matter = model_->matter;
    releaseMotors();
    realize(Stage::Velocity);
    SimTK::Vector_<SimTK::SpatialVec> spatial(matter.getNumBodies(),
                                              SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0)));
    model_->bodies[body].applyBodyForce(state_, {toSimbody(angularImpulse), toSimbody(impulse)}, spatial);
    Vector generalised, change;
    matter.multiplyBySystemJacobianTranspose(state_, spatial, generalised);
    matter.multiplyByMInv(state_, generalised, change);
    Vector violation;
    Vector bias;
    matter.calcBiasForMultiplyByG(state_, bias);
    matter.multiplyByG(state_, change, bias, violation);
    if (violation.size() > 0) {
        Vector reaction, held, back;
        matter.solveForConstraintImpulses(state_, violation, reaction);
        matter.multiplyByGTranspose(state_, reaction, held);
        matter.multiplyByMInv(state_, held, back);
        change -= back;
    }
    state_.updU() += change;
    realize(Stage::Velocity);
    return true;
}

/// Forces of the step. A constant force that lasts for a part of it acts with that part of its strength.
void SimbodyWorld::prepareForces() {
    const double begin = static_cast<double>(steps_) * dt_, end = begin + dt_;
    for (const scenario::Force& force : scenario_.forces) {
        const auto* f = std::get_if<scenario::ConstantForce>(&force);
        if (f == nullptr) continue;
        const bool whole = f->start <= begin && f->end >= end;
        const double part =
            whole ? 1.0 : std::max(0.0, (std::min(end, f->end) - std::max(begin, f->start)) / dt_);
        if (part > 0.0) applyForce(f->body, part * f->force, part * f->torque);
    }
    model_->discrete.clearAllForces(state_);
    for (std::size_t b = 0; b < forces_.size(); ++b) {
        if (scenario_.bodies[b].type != BodyType::Dynamic) continue;
        const Wrench& wrench = forces_[b];
        model_->discrete.setOneBodyForce(state_, model_->bodies[b],
                                         {toSimbody(wrench.torque), toSimbody(wrench.force)});
    }
    std::fill(forces_.begin(), forces_.end(), Wrench{});
}

/// The integrator begins anew at every step: its forces have changed, and nothing of what it did before is left in it.
void SimbodyWorld::integrate() {
    const double end = static_cast<double>(steps_ + 1) * dt_;
    if (!is("step", "fixed") && next_ > 0.0) integrator_->setInitialStepSize(std::min(next_, dt_));
    integrator_->resetAllStatistics();
    try {
        integrator_->initialize(state_);
        while (integrator_->getTime() < end) integrator_->stepTo(end, end);
    } catch (const SimTK::Exception::Base&) {
        // A step of a size that was given can not be made smaller where it leads beyond all numbers.
        if (!is("step", "fixed")) throw;
        lost_ = true;
    }
    const SimTK::State& reached = integrator_->getAdvancedState();
    const auto isFinite = [](const Vector& of) {
        for (int i = 0; i < of.size(); ++i)
            if (!std::isfinite(of[i])) return false;
        return true;
    };
    lost_ = lost_ || !isFinite(reached.getQ()) || !isFinite(reached.getU());
    if (lost_) return;
    internalSteps_ = integrator_->getNumStepsTaken();
    next_ = integrator_->getPredictedNextStepSize();
    state_ = reached;
}

void SimbodyWorld::step() {
    if (lost_) return;
    prepareForces();
    if (!model_->motors.empty()) setMotors();
    breakJoints();
    integrate();
    if (lost_) return;
    ++steps_;
    countTurns();
    breakJoints();
    realize(Stage::Velocity);
}

/// A joint breaks where it bears more than its strength at the start of a step, under the forces of that step, or at its
/// end.
void SimbodyWorld::breakJoints() {
    for (const LoopJoint& joint : model_->loops) {
        if (!adapter::canBreak(scenario_.joints[joint.joint()]) || !joint.holds(state_)) continue;
        realize(Stage::Acceleration);
        if (joint.isOverloaded(state_)) joint.setHolds(state_, false);
    }
}

bool SimbodyWorld::jointHolds(int index) const {
    return std::all_of(model_->loops.begin(), model_->loops.end(),
                       [&](const LoopJoint& joint) { return joint.joint() != index || joint.holds(state_); });
}

adapter::Scheme SimbodyWorld::scheme() const {
    if (!is("step", "fixed")) return adapter::Scheme::Unknown;
    if (is("integrator", "semi_explicit_euler")) return adapter::Scheme::SymplecticEuler;
    if (is("integrator", "explicit_euler")) return adapter::Scheme::ExplicitEuler;
    return adapter::Scheme::Unknown;
}

void SimbodyWorld::setStates(std::span<const BodyState> states) {
    std::vector<BodyState> all(scenario_.bodies.size());
    readStates(all);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (scenario_.bodies[i].type == BodyType::Dynamic) all[i] = states[i];
    place(all);
}

void SimbodyWorld::save(std::vector<unsigned char>& bytes) const {
    adapter::NumberWriter out(bytes);
    const auto putAll = [&](const Vector& from) {
        for (int i = 0; i < from.size(); ++i) out.put(from[i]);
    };
    out.put(static_cast<double>(steps_));
    out.put(next_);
    out.put(state_.getTime());
    putAll(state_.getQ());
    putAll(state_.getU());
    for (const LoopJoint& joint : model_->loops) out.put(joint.holds(state_) ? 1.0 : 0.0);
    for (const PairSpring* spring : model_->turns) out.put(spring->last().get(state_));
    for (const bool near : nearSpeed_) out.put(near ? 1.0 : 0.0);
    for (const Wrench& wrench : forces_) {
        out.put(wrench.force);
        out.put(wrench.torque);
    }
}

bool SimbodyWorld::restore(const std::vector<unsigned char>& bytes) {
    std::vector<unsigned char> now;
    save(now);
    if (bytes.size() != now.size()) return false;
    adapter::NumberReader in(bytes);
    steps_ = static_cast<std::int64_t>(in.take());
    next_ = in.take();
    state_.setTime(in.take());
    const auto takeAll = [&](Vector& to) {
        for (int i = 0; i < to.size(); ++i) to[i] = in.take();
    };
    Vector q = state_.getQ(), u = state_.getU();
    takeAll(q);
    takeAll(u);
    for (const LoopJoint& joint : model_->loops) joint.setHolds(state_, in.take() != 0.0);
    for (const PairSpring* spring : model_->turns) spring->last().set(state_, in.take());
    for (std::size_t i = 0; i < nearSpeed_.size(); ++i) nearSpeed_[i] = in.take() != 0.0;
    releaseMotors();
    lost_ = false;
    model_->system.realizeModel(state_);
    state_.setQ(q);
    state_.setU(u);
    for (Wrench& wrench : forces_) {
        wrench.force = in.takeVector();
        wrench.torque = in.takeVector();
    }
    realize(Stage::Velocity);
    return true;
}

}  // namespace rigor::simbody
