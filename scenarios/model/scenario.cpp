// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/scenario.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::scenario {

const char* geometryName(const Geometry& geometry, int dimension) {
    static constexpr const char* kNames3d[] = {"sphere", "box",           "capsule",      "cylinder",
                                               "cone",   "hull",          "half_space",   "segment",
                                               "chain",  "triangle_mesh", "height_field", "ellipsoid"};
    static constexpr const char* kNames2d[] = {"circle", "box",           "capsule",      "cylinder",
                                               "cone",   "polygon",       "half_plane",   "segment",
                                               "chain",  "triangle_mesh", "height_field", "ellipsoid"};
    return (dimension == 2 ? kNames2d : kNames3d)[geometry.index()];
}

const char* jointName(JointType type) {
    switch (type) {
        case JointType::Ball:
            return "ball";
        case JointType::Hinge:
            return "hinge";
        case JointType::Slider:
            return "slider";
        case JointType::Fixed:
            return "fixed";
        case JointType::Distance:
            return "distance";
        case JointType::ConeTwist:
            return "cone_twist";
        case JointType::SixDof:
            return "six_dof";
        case JointType::Wheel:
            return "wheel";
    }
    return "?";
}

const char* jointAxisName(JointType type, int dimension, std::size_t k) {
    using Names = std::vector<const char*>;
    static const Names none, angle{"angle"}, travel{"travel"}, length{"length"}, swing{"swing"},
        cone{"twist", "swing"}, wheel{"travel", "angle"}, three{"x", "y", "angle"},
        six{"x", "y", "z", "twist", "swing_y", "swing_z"};
    const auto of = [&]() -> const Names& {
        switch (type) {
            case JointType::Hinge:
                return angle;
            case JointType::Slider:
                return travel;
            case JointType::Distance:
                return length;
            case JointType::Ball:
                return dimension == 3 ? swing : none;
            case JointType::ConeTwist:
                return cone;
            case JointType::Wheel:
                return wheel;
            case JointType::SixDof:
                return dimension == 3 ? six : three;
            case JointType::Fixed:
                break;
        }
        return none;
    };
    const Names& names = of();
    return k < names.size() ? names[k] : nullptr;
}

std::vector<std::string> Joint::features() const {
    bool limit = false, motor = false, spring = false;
    for (const JointAxis& axis : axes) {
        // A rod that is no rod any more is a rope; what six_dof leaves free or locks is its type.
        limit = limit || axis.mode == AxisMode::Limited;
        motor = motor || axis.hasMotor();
        spring = spring || axis.hasSpring();
    }
    std::vector<std::string> requested;
    if (limit) requested.push_back("limit");
    if (motor) requested.push_back("motor");
    if (spring) requested.push_back("spring");
    if (breakForce < 1e299 || breakTorque < 1e299) requested.push_back("break");
    return requested;
}

PairCoefficients pairCoefficients(const Scenario& scenario, int materialA, int materialB) {
    for (const MaterialPair& pair : scenario.pairs)
        if ((pair.a == materialA && pair.b == materialB) || (pair.a == materialB && pair.b == materialA))
            return {pair.friction, pair.restitution, pair.staticFriction, pair.rollingFriction,
                    pair.torsionalFriction};
    const Material& a = scenario.materials[materialA];
    const Material& b = scenario.materials[materialB];
    const double friction = std::sqrt(a.friction * b.friction);
    double sticking = 0.0;
    if (a.staticFriction > 0.0 || b.staticFriction > 0.0)
        sticking = std::max(friction, std::sqrt(std::max(a.friction, a.staticFriction) *
                                                std::max(b.friction, b.staticFriction)));
    return {friction, std::min(a.restitution, b.restitution), sticking,
            std::sqrt(a.rollingFriction * b.rollingFriction),
            std::sqrt(a.torsionalFriction * b.torsionalFriction)};
}

Vec3 surfaceVelocityAt(const Shape& shape, const Pose& body, Vec3 point) {
    const SurfaceVelocity& s = shape.surfaceVelocity;
    return rotate(body.orientation, s.linear) +
           cross(rotate(body.orientation, s.angular), point - body.position);
}

int findBody(const Scenario& scenario, const std::string& name) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
        if (scenario.bodies[i].name == name) return static_cast<int>(i);
    return kNone;
}

namespace {

bool someShapesMayTouch(const Body& a, const Body& b) {
    if (a.shapes.empty() || b.shapes.empty()) return true;
    for (const Shape& ofA : a.shapes)
        for (const Shape& ofB : b.shapes)
            if (mayTouch(ofA, ofB)) return true;
    return false;
}

}  // namespace

bool mayCollide(const Scenario& scenario, int bodyA, int bodyB) {
    const Body& a = scenario.bodies[bodyA];
    const Body& b = scenario.bodies[bodyB];
    if (bodyA == bodyB || !a.collides || !b.collides) return false;
    if (a.type != BodyType::Dynamic && b.type != BodyType::Dynamic) return false;
    if (!someShapesMayTouch(a, b)) return false;
    return std::none_of(scenario.joints.begin(), scenario.joints.end(), [&](const Joint& joint) {
        const bool connects =
            (joint.bodyA == bodyA && joint.bodyB == bodyB) || (joint.bodyA == bodyB && joint.bodyB == bodyA);
        return connects && !joint.collideConnected;
    });
}

}  // namespace rigor::scenario
