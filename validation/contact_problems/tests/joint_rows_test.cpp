// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of joints against the motions that they permit and those that they forbid.
#include "validation/contact_problems/joint_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace rigor::validation::testing {
namespace {

using namespace scenario;

struct Pair {
    Scenario scenario;
    std::vector<BodyState> states;
    Joint joint;
};

Vec3 unit(const Vec3& v) {
    return v / norm(v);
}

/// Two bodies anywhere, their frames off their centres, joined at a point of the world.
Pair joined(JointType type, int dimension, std::mt19937& rng) {
    std::uniform_real_distribution<double> some(-1.0, 1.0);
    const bool flat = dimension == 2;
    const auto vector = [&] { return Vec3{some(rng), some(rng), flat ? 0.0 : some(rng)}; };
    const auto spin = [&] { return flat ? Vec3{0, 0, some(rng)} : vector(); };
    Pair p;
    p.scenario.dimension = dimension;
    for (int i = 0; i < 2; ++i) {
        Body body;
        body.massProperties.centerOfMass = vector();
        p.scenario.bodies.push_back(body);
        const Vec3 axis = flat ? Vec3{0, 0, 1} : unit(vector());
        p.states.push_back({vector(), fromAxisAngle(axis, 3.0 * some(rng)), {}, {}});
    }
    const Pose a{p.states[0].position, p.states[0].orientation},
        b{p.states[1].position, p.states[1].orientation};
    p.joint.type = type;
    p.joint.bodyA = 0;
    p.joint.bodyB = 1;
    const Vec3 anchor = vector(), axis = unit(vector());
    p.joint.anchorA = inverse(a) * anchor;
    p.joint.anchorB = inverse(b) * (type == JointType::Distance ? anchor + vector() : anchor);
    p.joint.axisA = rotateInverse(a.orientation, axis);
    p.joint.axisB = rotateInverse(b.orientation, axis);
    // A moves anyhow, and B with it.
    const Vec3 v = vector(), w = spin();
    for (std::size_t i = 0; i < 2; ++i) {
        const Vec3 center = Pose{p.states[i].position, p.states[i].orientation} *
                            p.scenario.bodies[i].massProperties.centerOfMass;
        p.states[i].velocity = v + cross(w, center);
        p.states[i].angularVelocity = w;
    }
    return p;
}

Vec3 centerOfB(const Pair& p) {
    return Pose{p.states[1].position, p.states[1].orientation} *
           p.scenario.bodies[1].massProperties.centerOfMass;
}
Vec3 anchorOfB(const Pair& p) {
    return Pose{p.states[1].position, p.states[1].orientation} * p.joint.anchorB;
}
Vec3 axisOf(const Pair& p) {
    return rotate(p.states[0].orientation, p.joint.axisA);
}
/// B turns about its anchor besides.
void turnB(Pair& p, const Vec3& w) {
    p.states[1].velocity += cross(w, centerOfB(p) - anchorOfB(p));
    p.states[1].angularVelocity += w;
}

double largest(const Pair& p) {
    double worst = 0.0;
    for (const JointRow& row : jointRows(p.scenario, p.joint, p.states)) {
        const BodyState &a = p.states[0], &b = p.states[1];
        const double rate = dot(row.linear, b.velocity + cross(b.angularVelocity, row.armB) - a.velocity -
                                                cross(a.angularVelocity, row.armA)) +
                            dot(row.angular, b.angularVelocity - a.angularVelocity);
        worst = std::max(worst, std::abs(rate));
    }
    return worst;
}

struct Motion {
    JointType type;
    int dimension;
    bool permitted;
    std::function<void(Pair&)> add;
};

const std::vector<Motion>& motions() {
    const auto about = [](Vec3 w) { return [w](Pair& p) { turnB(p, w); }; };
    const auto push = [](Vec3 v) { return [v](Pair& p) { p.states[1].velocity += v; }; };
    const auto aboutAxis = [](Pair& p) { turnB(p, 0.7 * axisOf(p)); };
    const auto alongAxis = [](Pair& p) { p.states[1].velocity += 0.7 * axisOf(p); };
    const Vec3 any{0.3, -0.5, 0.4}, flat{0.3, -0.5, 0}, z{0, 0, 0.7};
    static const std::vector<Motion> list{
        {JointType::Ball, 3, true, about(any)},     {JointType::Ball, 3, false, push(any)},
        {JointType::Hinge, 3, true, aboutAxis},     {JointType::Hinge, 3, false, about(any)},
        {JointType::Hinge, 3, false, push(any)},    {JointType::Hinge, 2, true, about(z)},
        {JointType::Hinge, 2, false, push(flat)},   {JointType::Slider, 3, true, alongAxis},
        {JointType::Slider, 3, false, aboutAxis},   {JointType::Slider, 3, false, push(any)},
        {JointType::Slider, 2, true, alongAxis},    {JointType::Slider, 2, false, about(z)},
        {JointType::Fixed, 3, false, about(any)},   {JointType::Fixed, 3, false, push(any)},
        {JointType::Fixed, 2, false, about(z)},     {JointType::Distance, 3, true, about(any)},
        {JointType::Distance, 3, false, push(any)},
    };
    return list;
}

TEST(JointRows, HoldWhatTheJointHoldsAndNothingElse) {
    std::mt19937 rng(7);
    for (const Motion& motion : motions())
        for (int k = 0; k < 20; ++k) {
            Pair p = joined(motion.type, motion.dimension, rng);
            EXPECT_LT(largest(p), 1e-12) << "moving as one body";
            motion.add(p);
            if (motion.permitted)
                EXPECT_LT(largest(p), 1e-12) << static_cast<int>(motion.type) << " " << motion.dimension;
            else
                EXPECT_GT(largest(p), 1e-3) << static_cast<int>(motion.type) << " " << motion.dimension;
        }
}

TEST(JointRows, AreAsManyAsTheFreedomsTheyTake) {
    std::mt19937 rng(8);
    const auto count = [&](JointType type, int dimension) {
        const Pair p = joined(type, dimension, rng);
        return jointRows(p.scenario, p.joint, p.states).size();
    };
    EXPECT_EQ(count(JointType::Ball, 3), 3u);
    EXPECT_EQ(count(JointType::Hinge, 3), 5u);
    EXPECT_EQ(count(JointType::Hinge, 2), 2u);
    EXPECT_EQ(count(JointType::Slider, 3), 5u);
    EXPECT_EQ(count(JointType::Slider, 2), 2u);
    EXPECT_EQ(count(JointType::Fixed, 3), 6u);
    EXPECT_EQ(count(JointType::Fixed, 2), 3u);
    EXPECT_EQ(count(JointType::Distance, 3), 1u);
}

}  // namespace
}  // namespace rigor::validation::testing
