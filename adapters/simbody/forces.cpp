// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/simbody/forces.hpp"

#include <cmath>
#include <variant>

namespace rigor::simbody {
namespace {

using scenario::Body;
using scenario::BodyType;
using SimTK::SpatialVec;

using BodyForces = SimTK::Vector_<SpatialVec>;

/// A force that is a function of a body's motion alone.
class OnBody final : public SimTK::Force::Custom::Implementation {
  public:
    OnBody(const Body& body, const SimTK::MobilizedBody& of, const Vec3& gravity, double drag,
           double quadraticDrag)
        : of_(of),
          mass_(body.massProperties.mass),
          linear_(mass_ * std::log(body.linearVelocityKept) - drag),
          angular_(std::log(body.angularVelocityKept)),
          quadratic_(quadraticDrag),
          weight_(mass_ * toSimbody(gravity)) {}

    void calcForce(const SimTK::State& state, BodyForces& forces, SimTK::Vector_<SimTK::Vec3>&,
                   SimTK::Vector&) const override {
        const SimTK::Vec3 &speed = of_.getBodyOriginVelocity(state),
                          &turn = of_.getBodyAngularVelocity(state);
        const SimTK::Rotation& axes = of_.getBodyRotation(state);
        SimTK::Vec3 torque(0);
        if (angular_ != 0.0) {
            const SimTK::Inertia& inertia = of_.getBodyMassProperties(state).calcInertia();
            torque = angular_ * (axes * (inertia * (~axes * turn)));
        }
        of_.applyBodyForce(state, {torque, weight_ + (linear_ - quadratic_ * speed.norm()) * speed}, forces);
    }
    SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

  private:
    SimTK::MobilizedBody of_;
    double mass_, linear_, angular_, quadratic_;
    SimTK::Vec3 weight_;
};

/// A spring between two points, which pulls nowhere while they coincide.
class Spring final : public SimTK::Force::Custom::Implementation {
  public:
    Spring(Frame a, const SimTK::Vec3& pointA, Frame b, const SimTK::Vec3& pointB, double stiffness,
           double damping, double restLength)
        : a_(std::move(a)),
          b_(std::move(b)),
          pointA_(pointA),
          pointB_(pointB),
          stiffness_(stiffness),
          damping_(damping),
          restLength_(restLength) {}

    void calcForce(const SimTK::State& state, BodyForces& forces, SimTK::Vector_<SimTK::Vec3>&,
                   SimTK::Vector&) const override {
        const SimTK::Vec3 span = b_.body.findStationLocationInGround(state, pointB_) -
                                 a_.body.findStationLocationInGround(state, pointA_);
        const double length = span.norm();
        if (length <= 0.0) return;
        const SimTK::Vec3 n = span / length;
        const SimTK::Vec3 speed = b_.body.findStationVelocityInGround(state, pointB_) -
                                  a_.body.findStationVelocityInGround(state, pointA_);
        const SimTK::Vec3 onA = (stiffness_ * (length - restLength_) + damping_ * SimTK::dot(speed, n)) * n;
        a_.body.applyForceToBodyPoint(state, pointA_, onA, forces);
        b_.body.applyForceToBodyPoint(state, pointB_, -onA, forces);
    }
    SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

  private:
    Frame a_, b_;
    SimTK::Vec3 pointA_, pointB_;
    double stiffness_, damping_, restLength_;
};

void addOnBody(const adapter::Scenario& scenario, Model& model, int index) {
    const Body& body = scenario.bodies[index];
    if (body.type != BodyType::Dynamic) return;
    double drag = 0.0, quadratic = 0.0;
    for (const scenario::Force& force : scenario.forces)
        if (const auto* of = std::get_if<scenario::DragForce>(&force); of != nullptr && of->body == index) {
            drag += of->coefficient;
            quadratic += of->quadratic;
        }
    const bool heavy = body.gravityScale != 1.0;
    const bool damped = body.linearVelocityKept != 1.0 || body.angularVelocityKept != 1.0;
    if (!heavy && !damped && drag == 0.0 && quadratic == 0.0) return;
    const Vec3 gravity = heavy ? body.gravityScale * scenario.gravity : Vec3{};
    SimTK::Force::Custom(model.forces, new OnBody(body, model.bodies[index], gravity, drag, quadratic));
}

void addSpring(const adapter::Scenario& scenario, Model& model, int bodyA, const Vec3& anchorA, int bodyB,
               const Vec3& anchorB, double stiffness, double damping, double restLength) {
    const Frame a = frameOf(scenario, model, bodyA), b = frameOf(scenario, model, bodyB);
    SimTK::Force::Custom(model.forces,
                         new Spring(a, toSimbody(a.pose * anchorA), b, toSimbody(b.pose * anchorB), stiffness,
                                    damping, restLength));
}

}  // namespace

Frame frameOf(const adapter::Scenario& scenario, const Model& model, int body) {
    if (body == kNone) return {model.matter.getGround(), {}};
    if (model.forest.links[body].fixed) return {model.bodies[body], scenario.bodies[body].pose};
    return {model.bodies[body], inverse(model.forest.links[body].frame)};
}

Sides sidesOf(const adapter::Scenario& scenario, const Model& model, const scenario::Joint& joint,
              bool planar) {
    const auto turnOf = [&](int body) {
        return body == kNone ? Quat{} : scenario.bodies[body].pose.orientation;
    };
    return {joint, frameOf(scenario, model, joint.bodyA), frameOf(scenario, model, joint.bodyB),
            conjugate(turnOf(joint.bodyA)) * turnOf(joint.bodyB), planar};
}

std::vector<Acting> addDriven(Model& model, const Driven& driven) {
    const scenario::JointAxis& use = driven.use;
    std::vector<Acting> all;
    if (use.hasSpring()) {
        auto* spring = new PairSpring(model.forces, driven.coordinate, use);
        all.push_back({SimTK::Force::Custom(model.forces, spring), spring, {}});
        if (spring->countsTurns()) model.turns.push_back(spring);
    }
    if (use.hasMotor()) {
        auto* push = new PairPush(model.forces, driven.coordinate);
        const SimTK::Force::Custom force(model.forces, push);
        const SimTK::Constraint hold = keepSpeed(model.matter, driven.coordinate, use.motorSpeed);
        all.push_back({force, push, hold});
        model.motors.push_back({use.motorSpeed, use.motorMaxForce, hold, {}, push});
    }
    return all;
}

void addForces(const adapter::Scenario& scenario, Model& model) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) addOnBody(scenario, model, static_cast<int>(i));
    for (const scenario::Force& force : scenario.forces)
        if (const auto* s = std::get_if<scenario::SpringForce>(&force))
            addSpring(scenario, model, s->bodyA, s->anchorA, s->bodyB, s->anchorB, s->stiffness, s->damping,
                      s->restLength);
}

}  // namespace rigor::simbody
