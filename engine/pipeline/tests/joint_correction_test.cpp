// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints that begin beyond their limits: every position correction of the table brings them back, on either
// side, along a line and about an axis; without one they stay where they are. Contacts beside joints: what joints hold is
// pushed apart with them, and joints that no contact pushes do not depend on those that one does.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Beyond : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Beyond, Spaces);

/// The coordinate of a joint after two seconds that starts at 0 with limits from `lower` to `upper`.
template <class S>
double afterTwoSeconds(const char* correction, JointType type, double lower, double upper) {
    using R = typename S::Real;
    WorldDef<S> def;
    def.positionCorrection = correction;
    World<S> world(def);
    BodyDef<S> body;
    body.mass = 2;
    body.inertia = isotropic<S>(0.5);
    const BodyId id = world.addBody(body);
    JointDef<S> joint;
    joint.type = type;
    joint.bodyB = id;
    if (type == JointType::Slider) joint.axisA = joint.axisB = at<S>(1, 0);
    joint.axes[0].mode = AxisMode::Limited;
    joint.axes[0].lower = static_cast<R>(lower);
    joint.axes[0].upper = static_cast<R>(upper);
    world.addJoint(joint);
    for (int i = 0; i < 120; ++i) world.step(R(1.0 / 60));
    if (type == JointType::Slider) return world.pose(id).p[0];
    return spinOf<S>(logMap(world.pose(id).q));
}

TYPED_TEST(Beyond, EveryCorrectionBringsAJointBackWithinItsLimits) {
    using S = TypeParam;
    for (const auto& correction : positionCorrectionTable<S>())
        for (const JointType type : {JointType::Slider, JointType::Hinge}) {
            SCOPED_TRACE(std::string(correction.name) + (type == JointType::Slider ? ", slider" : ", hinge"));
            const double low = afterTwoSeconds<S>(correction.name, type, 0.1, 10),
                         high = afterTwoSeconds<S>(correction.name, type, -10, -0.1);
            if (std::string(correction.name) == "none") {
                EXPECT_EQ(low, 0);
                EXPECT_EQ(high, 0);
                continue;
            }
            EXPECT_GE(low, 0.1 - 1e-3);
            EXPECT_LE(high, -0.1 + 1e-3);
            // No further than the speed that it was pushed with takes it.
            EXPECT_LE(low, 3);
            EXPECT_GE(high, -3);
        }
}

template <class S>
class BesideContacts : public testing::Test {};
TYPED_TEST_SUITE(BesideContacts, Spaces);

/// Links of one metre on hinges between two fixed points, sagging, each a small cube; angles from the horizontal.
template <class S>
std::vector<BodyId> addBridge(World<S>& world, std::span<const double> angles, std::uint32_t material) {
    std::vector<BodyId> links;
    typename S::Vec from = S::Vec::Zero(), before = S::Vec::Zero();
    const auto join = [&](const typename S::Vec& onA, BodyId b, const typename S::Vec& onB) {
        JointDef<S> joint;
        joint.type = JointType::Hinge;
        joint.bodyA = links.empty() ? BodyId{} : links.back();
        joint.bodyB = b;
        joint.anchorA = onA;
        joint.anchorB = onB;
        world.addJoint(joint);
    };
    for (const double angle : angles) {
        const typename S::Vec along = at<S>(std::cos(angle), std::sin(angle)), half = along / 2;
        const typename S::Vec middle = from + half;
        const BodyId link = addCube<S>(world, double(middle[0]), double(middle[1]), 0.1, 1, material);
        join(before, link, -half);
        links.push_back(link);
        before = half;
        from += along;
    }
    join(before, BodyId{}, from);
    return links;
}

/// Under a ball of a hundred masses of a link its link would be pushed out by itself, and its hinges would pull it back: with
/// corrections in turn 2.2 of 4 mm are left.
TYPED_TEST(BesideContacts, ALoadOnABridgeIsPushedOutOfIt) {
    using S = TypeParam;
    World<S> world(WorldDef<S>{});  // no gravity
    const std::uint32_t m = world.addMaterial(0, 0);
    const std::array angles{-0.9, -0.3, 0.3, 0.9};
    const std::vector<BodyId> links = addBridge<S>(world, angles, m);
    constexpr double kReach = 0.1 + 0.3, kOverlap = 0.004;
    const typename S::Vec place = world.pose(links[1]).p;
    const BodyId load =
        addBall<S>(world, double(place[0]), double(place[1]) + kReach - kOverlap, 0.3, 100, m);
    world.step(static_cast<typename S::Real>(1.0 / 60));
    const Pose<S>&link = world.pose(links[1]), &ball = world.pose(load);
    const typename S::Vec up = rotate(link.q, typename S::Vec(S::Vec::Unit(1)));
    EXPECT_LT(kReach - double(up.dot(ball.p - link.p)), 0.15 * kOverlap);
    for (std::size_t k = 0; k + 1 < links.size(); ++k) {
        const auto end = [&](std::size_t i, double side) {
            return toWorld<S>(world.pose(links[i]),
                              at<S>(side * std::cos(angles[i]) / 2, side * std::sin(angles[i]) / 2));
        };
        EXPECT_LT(double((end(k, 1) - end(k + 1, -1)).norm()), tol<S>(1e-12, 1e-6));
    }
}

TYPED_TEST(BesideContacts, JointsThatNothingPushesDoNotDependOnContactsElsewhere) {
    using S = TypeParam;
    World<S> alone(earth<S>()), beside(earth<S>());
    const std::array angles{-0.9, -0.3, 0.3, 0.9};
    const std::vector<BodyId> first = addBridge<S>(alone, angles, alone.addMaterial(0, 0)),
                              second = addBridge<S>(beside, angles, beside.addMaterial(0, 0));
    addCube<S>(beside, 40, 0, 0.5, 1, 0);
    addCube<S>(beside, 40, 0.9, 0.5, 1, 0);
    for (int i = 0; i < 60; ++i)
        for (World<S>* world : {&alone, &beside}) world->step(static_cast<typename S::Real>(1.0 / 60));
    for (std::size_t k = 0; k < first.size(); ++k) {
        EXPECT_EQ(alone.pose(first[k]).p, beside.pose(second[k]).p);
        EXPECT_EQ(alone.velocity(first[k]), beside.velocity(second[k]));
    }
}

}  // namespace
}  // namespace rigor::engine::test
