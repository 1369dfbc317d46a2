// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints that begin beyond their limits: every position correction of the table brings them back, on either
// side, along a line and about an axis; without one they stay where they are.
#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace rigor::engine::test
