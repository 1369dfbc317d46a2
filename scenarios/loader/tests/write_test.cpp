// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every scenario of the library that is written is read back as the same scenario.
#include "scenarios/loader/write.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

constexpr double kUlps = 4e-15;  ///< measured 5e-16: normalised quaternions and axes

double apart(const Vec3& a, const Vec3& b) {
    return norm(a - b) / (1.0 + norm(a));
}
double apart(const Quat& a, const Quat& b) {
    return std::hypot(a.w - b.w, a.x - b.x, std::hypot(a.y - b.y, a.z - b.z));
}
double apart(const Pose& a, const Pose& b) {
    return std::max(apart(a.position, b.position), apart(a.orientation, b.orientation));
}

struct SameGeometry {
    void operator()(const Sphere& a, const Sphere& b) const { EXPECT_EQ(a.radius, b.radius); }
    void operator()(const Box& a, const Box& b) const { EXPECT_EQ(a.halfExtents, b.halfExtents); }
    template <class Round>
    void operator()(const Round& a, const Round& b) const requires requires {
        a.halfLength;
    }
    {
        EXPECT_EQ(a.radius, b.radius);
        EXPECT_EQ(a.halfLength, b.halfLength);
    }
    /// The loader lists the corners as it finds them.
    void operator()(const ConvexHull& a, const ConvexHull& b) const {
        const auto sorted = [](std::vector<Vec3> list) {
            std::sort(list.begin(), list.end(), [](const Vec3& p, const Vec3& q) {
                return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
            });
            return list;
        };
        EXPECT_EQ(sorted(a.vertices), sorted(b.vertices));
    }
    void operator()(const HalfSpace& a, const HalfSpace& b) const {
        EXPECT_LT(apart(a.normal, b.normal), kUlps);
        EXPECT_EQ(a.offset, b.offset);
    }
    void operator()(const Segment& a, const Segment& b) const {
        EXPECT_EQ(a.a, b.a);
        EXPECT_EQ(a.b, b.b);
    }
    void operator()(const Chain& a, const Chain& b) const {
        EXPECT_EQ(a.vertices, b.vertices);
        EXPECT_EQ(a.loop, b.loop);
    }
    void operator()(const TriangleMesh& a, const TriangleMesh& b) const {
        EXPECT_EQ(a.vertices, b.vertices);
        EXPECT_EQ(a.triangles, b.triangles);
    }
    void operator()(const Ellipsoid& a, const Ellipsoid& b) const { EXPECT_EQ(a.halfAxes, b.halfAxes); }
    void operator()(const HeightField& a, const HeightField& b) const {
        EXPECT_EQ(a.heights, b.heights);
        EXPECT_EQ(a.columns, b.columns);
        EXPECT_EQ(a.rows, b.rows);
        EXPECT_EQ(a.spacingX, b.spacingX);
        EXPECT_EQ(a.spacingZ, b.spacingZ);
        EXPECT_EQ(a.thickness, b.thickness);
    }
    template <class A, class B>
    void operator()(const A&, const B&) const {
        ADD_FAILURE() << "another kind of shape";
    }
};

void expectSameBody(const Body& a, const Body& b, int dimension) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.type, b.type);
    EXPECT_EQ(a.collides, b.collides);
    EXPECT_LT(apart(a.pose, b.pose), kUlps);
    EXPECT_EQ(a.pose.position, b.pose.position);
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.angularVelocity, b.angularVelocity);
    EXPECT_EQ(a.gravityScale, b.gravityScale);
    EXPECT_EQ(a.linearVelocityKept, b.linearVelocityKept);
    EXPECT_EQ(a.angularVelocityKept, b.angularVelocityKept);
    EXPECT_EQ(a.massProperties.mass, b.massProperties.mass);
    EXPECT_EQ(a.massProperties.centerOfMass, b.massProperties.centerOfMass);
    if (dimension == 3) {
        EXPECT_EQ(a.massProperties.inertia, b.massProperties.inertia);
    } else {
        EXPECT_EQ(a.massProperties.inertia(2, 2), b.massProperties.inertia(2, 2));
    }
    ASSERT_EQ(a.shapes.size(), b.shapes.size());
    for (std::size_t k = 0; k < a.shapes.size(); ++k) {
        EXPECT_EQ(a.shapes[k].material, b.shapes[k].material);
        EXPECT_EQ(a.shapes[k].surfaceVelocity.linear, b.shapes[k].surfaceVelocity.linear);
        EXPECT_EQ(a.shapes[k].surfaceVelocity.angular, b.shapes[k].surfaceVelocity.angular);
        EXPECT_LT(apart(a.shapes[k].pose, b.shapes[k].pose), kUlps);
        std::visit(SameGeometry{}, a.shapes[k].geometry, b.shapes[k].geometry);
    }
}

void expectSameAxis(const JointAxis& a, const JointAxis& b) {
    EXPECT_EQ(a.mode, b.mode);
    EXPECT_EQ(a.lower, b.lower);
    EXPECT_EQ(a.upper, b.upper);
    EXPECT_EQ(a.motorSpeed, b.motorSpeed);
    EXPECT_EQ(a.motorMaxForce, b.motorMaxForce);
    EXPECT_EQ(a.target, b.target);
    EXPECT_EQ(a.frequency, b.frequency);
    EXPECT_EQ(a.dampingRatio, b.dampingRatio);
    EXPECT_EQ(a.stiffness, b.stiffness);
    EXPECT_EQ(a.damping, b.damping);
}

void expectSameJoint(const Joint& a, const Joint& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.type, b.type);
    EXPECT_EQ(a.bodyA, b.bodyA);
    EXPECT_EQ(a.bodyB, b.bodyB);
    EXPECT_EQ(a.anchorA, b.anchorA);
    EXPECT_EQ(a.anchorB, b.anchorB);
    EXPECT_EQ(a.length, b.length);
    EXPECT_LT(apart(a.axisA, b.axisA), kUlps);
    EXPECT_LT(apart(a.axisB, b.axisB), kUlps);
    EXPECT_LT(apart(a.normalA, b.normalA), kUlps);
    EXPECT_LT(apart(a.spinAxisB, b.spinAxisB), kUlps);
    EXPECT_EQ(a.collideConnected, b.collideConnected);
    EXPECT_EQ(a.breakForce, b.breakForce);
    EXPECT_EQ(a.breakTorque, b.breakTorque);
    for (std::size_t k = 0; k < kMaxJointAxes; ++k) expectSameAxis(a.axes[k], b.axes[k]);
}

void expectSameForce(const Force& a, const Force& b) {
    ASSERT_EQ(a.index(), b.index());
    if (const auto* f = std::get_if<ConstantForce>(&a)) {
        const auto& o = std::get<ConstantForce>(b);
        EXPECT_EQ(f->body, o.body);
        EXPECT_EQ(f->force, o.force);
        EXPECT_EQ(f->torque, o.torque);
        EXPECT_EQ(f->start, o.start);
        EXPECT_EQ(f->end, o.end);
    } else if (const auto* s = std::get_if<SpringForce>(&a)) {
        const auto& o = std::get<SpringForce>(b);
        EXPECT_EQ(s->bodyA, o.bodyA);
        EXPECT_EQ(s->bodyB, o.bodyB);
        EXPECT_EQ(s->anchorA, o.anchorA);
        EXPECT_EQ(s->anchorB, o.anchorB);
        EXPECT_EQ(s->stiffness, o.stiffness);
        EXPECT_EQ(s->damping, o.damping);
        EXPECT_EQ(s->restLength, o.restLength);
    } else {
        const auto& d = std::get<DragForce>(a);
        const auto& o = std::get<DragForce>(b);
        EXPECT_EQ(d.body, o.body);
        EXPECT_EQ(d.coefficient, o.coefficient);
        EXPECT_EQ(d.quadratic, o.quadratic);
    }
}

class WrittenScenario : public testing::TestWithParam<LibraryEntry> {};

TEST_P(WrittenScenario, IsReadBackAsItWasWritten) {
    const Scenario a = loadScenario(GetParam().file).scenario;
    const Scenario b = loadScenarioText(scenarioText(a), "written").scenario;
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.dimension, b.dimension);
    EXPECT_EQ(a.gravity, b.gravity);
    EXPECT_EQ(a.duration, b.duration);
    EXPECT_EQ(a.timeSteps, b.timeSteps);
    EXPECT_EQ(a.observed, b.observed);
    EXPECT_EQ(a.timeLimit, b.timeLimit);
    EXPECT_EQ(a.isolates, b.isolates);
    EXPECT_EQ(a.source, b.source);
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (int i = 0; i < static_cast<int>(a.materials.size()); ++i) {
        EXPECT_EQ(a.materials[i].name, b.materials[i].name);
        for (int j = 0; j <= i; ++j) {
            const auto one = pairCoefficients(a, i, j), other = pairCoefficients(b, i, j);
            EXPECT_EQ(one.friction, other.friction);
            EXPECT_EQ(one.restitution, other.restitution);
            EXPECT_EQ(one.staticFriction, other.staticFriction);
            EXPECT_EQ(one.rollingFriction, other.rollingFriction);
            EXPECT_EQ(one.torsionalFriction, other.torsionalFriction);
        }
    }
    ASSERT_EQ(a.bodies.size(), b.bodies.size());
    for (std::size_t i = 0; i < a.bodies.size(); ++i) expectSameBody(a.bodies[i], b.bodies[i], a.dimension);
    ASSERT_EQ(a.joints.size(), b.joints.size());
    for (std::size_t i = 0; i < a.joints.size(); ++i) expectSameJoint(a.joints[i], b.joints[i]);
    ASSERT_EQ(a.forces.size(), b.forces.size());
    for (std::size_t i = 0; i < a.forces.size(); ++i) expectSameForce(a.forces[i], b.forces[i]);
    ASSERT_EQ(a.events.size(), b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
        EXPECT_EQ(a.events[i].time, b.events[i].time);
        EXPECT_EQ(a.events[i].body, b.events[i].body);
        EXPECT_EQ(a.events[i].impulse, b.events[i].impulse);
        EXPECT_EQ(a.events[i].angularImpulse, b.events[i].angularImpulse);
    }
}

INSTANTIATE_TEST_SUITE_P(All, WrittenScenario, testing::ValuesIn(listScenarios()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace rigor::scenario
