// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Space is isotropic: the whole scene, gravity included, turned about the origin. Engines that solve friction
// along fixed directions of the world, or choose them by the largest component of the normal, show it here.
#include <cmath>

#include "validation/symmetry/transforms.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr double kPi = 3.14159265358979323846;

void turnForces(Scenario& s, const Quat& Q) {
    for (Force& force : s.forces) {
        if (auto* f = std::get_if<ConstantForce>(&force)) {
            f->force = rotate(Q, f->force);
            f->torque = rotate(Q, f->torque);
        }
        if (auto* f = std::get_if<SpringForce>(&force))
            if (f->bodyA == kNone) f->anchorA = rotate(Q, f->anchorA);
    }
    for (Event& e : s.events) {
        e.impulse = rotate(Q, e.impulse);
        e.angularImpulse = rotate(Q, e.angularImpulse);
    }
}

/// The frame of the world is not turned: what joints have in it is.
void turnJoints(Scenario& s, const Quat& Q) {
    for (Joint& j : s.joints) {
        if (j.bodyA == kNone) {
            j.anchorA = rotate(Q, j.anchorA);
            j.axisA = rotate(Q, j.axisA);
            j.normalA = rotate(Q, j.normalA);
        }
        if (j.bodyB == kNone) {
            j.anchorB = rotate(Q, j.anchorB);
            j.axisB = rotate(Q, j.axisB);
            j.spinAxisB = rotate(Q, j.spinAxisB);
        }
    }
}

Transformed turned(const Scenario& scenario, const Quat& Q) {
    Scenario s = bare(scenario);
    s.gravity = rotate(Q, s.gravity);
    for (Body& b : s.bodies) {
        b.pose = {rotate(Q, b.pose.position), Q * b.pose.orientation};
        b.velocity = rotate(Q, b.velocity);
        b.angularVelocity = rotate(Q, b.angularVelocity);
    }
    turnJoints(s, Q);
    turnForces(s, Q);
    const auto back = [Q](const Trajectory& t) {
        return mapped(
            t,
            [Q](const BodyState& b, double) {
                return BodyState{rotateInverse(Q, b.position), conjugate(Q) * b.orientation,
                                 rotateInverse(Q, b.velocity), rotateInverse(Q, b.angularVelocity)};
            },
            [Q](ContactPoint c, double) {
                for (Vec3* v : {&c.pointA, &c.pointB, &c.normal, &c.frictionImpulse})
                    *v = rotateInverse(Q, *v);
                return c;
            });
    };
    return {s, 1.0, back};
}

}  // namespace

Transformed rotation(const Scenario& s, const Trajectory*) {
    const Vec3 axis = s.dimension == 2 ? Vec3{0, 0, 1} : Vec3{1, 2, 3} / norm(Vec3{1, 2, 3});
    return turned(s, fromAxisAngle(axis, 1.0));
}

Transformed rotation90(const Scenario& s, const Trajectory*) {
    return turned(s, fromAxisAngle(s.dimension == 2 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, kPi / 2.0));
}

std::string rotationVerticalObstacle(const Scenario& s) {
    return s.dimension == 2 ? "in 2D nothing turns about the vertical" : "";
}

Transformed rotationVertical(const Scenario& s, const Trajectory*) {
    require(rotationVerticalObstacle(s));
    const double g = norm(s.gravity);
    return turned(s, fromAxisAngle(g > 0.0 ? -s.gravity / g : Vec3{0, 1, 0}, kPi / 8.0));
}

}  // namespace rigor::validation
