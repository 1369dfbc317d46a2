// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/scenario.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::scenario {

const char* geometryName(const Geometry& geometry, int dimension) {
    static constexpr const char* kNames3d[] = {"sphere", "box",           "capsule",     "cylinder",
                                               "cone",   "hull",          "half_space",  "segment",
                                               "chain",  "triangle_mesh", "height_field"};
    static constexpr const char* kNames2d[] = {"circle", "box",           "capsule",     "cylinder",
                                               "cone",   "polygon",       "half_plane",  "segment",
                                               "chain",  "triangle_mesh", "height_field"};
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
    }
    return "?";
}

PairCoefficients pairCoefficients(const Scenario& scenario, int materialA, int materialB) {
    for (const MaterialPair& pair : scenario.pairs)
        if ((pair.a == materialA && pair.b == materialB) || (pair.a == materialB && pair.b == materialA))
            return {pair.friction, pair.restitution};
    const Material& a = scenario.materials[static_cast<std::size_t>(materialA)];
    const Material& b = scenario.materials[static_cast<std::size_t>(materialB)];
    return {std::sqrt(a.friction * b.friction), std::min(a.restitution, b.restitution)};
}

int findBody(const Scenario& scenario, const std::string& name) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
        if (scenario.bodies[i].name == name) return static_cast<int>(i);
    return kNone;
}

bool mayCollide(const Scenario& scenario, int bodyA, int bodyB) {
    const Body& a = scenario.bodies[static_cast<std::size_t>(bodyA)];
    const Body& b = scenario.bodies[static_cast<std::size_t>(bodyB)];
    if (bodyA == bodyB || !a.collides || !b.collides) return false;
    if (a.type != BodyType::Dynamic && b.type != BodyType::Dynamic) return false;
    return std::none_of(scenario.joints.begin(), scenario.joints.end(), [&](const Joint& joint) {
        const bool connects =
            (joint.bodyA == bodyA && joint.bodyB == bodyB) || (joint.bodyA == bodyB && joint.bodyB == bodyA);
        return connects && !joint.collideConnected;
    });
}

}  // namespace rigor::scenario
