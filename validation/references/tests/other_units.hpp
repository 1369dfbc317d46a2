// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scene in other units of length, time and mass: every number that has a unit is multiplied by it, so that
// the results of a reference must be multiplied likewise. If the units are powers of two rounding is the
// same.
#pragma once

#include <cmath>
#include <string>
#include <type_traits>
#include <variant>

#include "scenarios/model/scenario.hpp"

namespace rigor::validation::testing {

using scenario::Scenario;
using scenario::Vec3;

struct Units {
    double length = 1, time = 1, mass = 1;
    double speed() const { return length / time; }
    double force() const { return mass * length / (time * time); }
};
inline double scaledUnlessEndless(double value, double factor) {
    return std::abs(value) < 1e299 ? factor * value : value;
}
inline void scaleShape(scenario::Geometry& geometry, double l) {
    std::visit(
        [l](auto& g) {
            using G = std::decay_t<decltype(g)>;
            if constexpr (std::is_same_v<G, scenario::Sphere>) {
                g.radius *= l;
            } else if constexpr (std::is_same_v<G, scenario::Box>) {
                g.halfExtents = l * g.halfExtents;
            } else if constexpr (std::is_same_v<G, scenario::HalfSpace>) {
                g.offset *= l;
            } else if constexpr (std::is_same_v<G, scenario::Segment>) {
                g.a = l * g.a;
                g.b = l * g.b;
            } else if constexpr (std::is_same_v<G, scenario::HeightField>) {
                g.spacingX *= l;
                g.spacingZ *= l;
                g.thickness *= l;
                for (double& h : g.heights) h *= l;
            } else if constexpr (std::is_same_v<G, scenario::ConvexHull> ||
                                 std::is_same_v<G, scenario::Chain> ||
                                 std::is_same_v<G, scenario::TriangleMesh>) {
                for (Vec3& v : g.vertices) v = l * v;
            } else if constexpr (std::is_same_v<G, scenario::Ellipsoid>) {
                g.halfAxes = l * g.halfAxes;
            } else {
                g.radius *= l;
                g.halfLength *= l;
            }
        },
        geometry);
}
inline void scaleJoint(scenario::Joint& joint, int dimension, const Units& u) {
    joint.anchorA = u.length * joint.anchorA;
    joint.anchorB = u.length * joint.anchorB;
    joint.length *= u.length;
    joint.breakForce = scaledUnlessEndless(joint.breakForce, u.force());
    joint.breakTorque = scaledUnlessEndless(joint.breakTorque, u.force() * u.length);
    for (std::size_t k = 0; k < joint.axes.size(); ++k) {
        const char* name = scenario::jointAxisName(joint.type, dimension, k);
        if (!name) break;
        const std::string coordinate = name;
        const bool isLength = coordinate == "travel" || coordinate == "length" || coordinate.size() == 1;
        const double unit = isLength ? u.length : 1.0, load = u.force() * (isLength ? 1.0 : u.length);
        scenario::JointAxis& axis = joint.axes[k];
        axis.lower = scaledUnlessEndless(axis.lower, unit);

        axis.upper = scaledUnlessEndless(axis.upper, unit);
        axis.motorSpeed *= unit / u.time;
        axis.motorMaxForce *= load;
        axis.target *= unit;
        axis.frequency /= u.time;
        axis.stiffness *= load / unit;
        axis.damping *= load * u.time / unit;
    }
}
inline void scaleForce(scenario::Force& force, const Units& u) {
    if (auto* f = std::get_if<scenario::ConstantForce>(&force)) {
        f->force = u.force() * f->force;
        f->torque = (u.force() * u.length) * f->torque;
        f->start *= u.time;
        f->end = scaledUnlessEndless(f->end, u.time);
    } else if (auto* spring = std::get_if<scenario::SpringForce>(&force)) {
        spring->anchorA = u.length * spring->anchorA;
        spring->anchorB = u.length * spring->anchorB;
        spring->restLength *= u.length;
        spring->stiffness *= u.force() / u.length;
        spring->damping *= u.mass / u.time;
    } else if (auto* drag = std::get_if<scenario::DragForce>(&force)) {
        drag->coefficient *= u.mass / u.time;
        drag->quadratic *= u.mass / u.length;
    }
}
/// The same scene in other units; false for one that is damped, whose factor per second has no exact power.
inline bool inUnits(Scenario& s, const Units& u) {
    s.gravity = (u.speed() / u.time) * s.gravity;
    s.duration *= u.time;
    for (double& dt : s.timeSteps) dt *= u.time;
    for (auto& b : s.bodies) {
        if (b.linearVelocityKept != 1.0 || b.angularVelocityKept != 1.0) return false;
        b.pose.position = u.length * b.pose.position;
        b.velocity = u.speed() * b.velocity;
        b.angularVelocity = b.angularVelocity / u.time;
        b.massProperties.mass *= u.mass;
        b.massProperties.centerOfMass = u.length * b.massProperties.centerOfMass;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) b.massProperties.inertia(i, j) *= u.mass * u.length * u.length;
        for (auto& shape : b.shapes) {
            shape.pose.position = u.length * shape.pose.position;
            shape.surfaceVelocity = {u.speed() * shape.surfaceVelocity.linear,
                                     shape.surfaceVelocity.angular / u.time};
            scaleShape(shape.geometry, u.length);
        }
    }
    const auto scaleLengths = [&](auto& surface) {
        surface.rollingFriction *= u.length;
        surface.torsionalFriction *= u.length;
    };
    for (auto& m : s.materials) scaleLengths(m);
    for (auto& p : s.pairs) scaleLengths(p);
    for (auto& joint : s.joints) scaleJoint(joint, s.dimension, u);
    for (auto& force : s.forces) scaleForce(force, u);
    for (auto& event : s.events) {
        event.time *= u.time;
        event.impulse = (u.mass * u.speed()) * event.impulse;
        event.angularImpulse = (u.mass * u.speed() * u.length) * event.angularImpulse;
    }
    return true;
}

}  // namespace rigor::validation::testing
