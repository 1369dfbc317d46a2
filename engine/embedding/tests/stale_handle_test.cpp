// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Handles of what is gone: every function that takes one says so and leaves the world as it was.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "engine/embedding/frame_stepper.hpp"
#include "engine/embedding/tests/tick.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class StaleHandle : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(StaleHandle, Spaces);

/// A box on the ground that hangs on the world and is pulled; beside it handles of as many things that are gone.
template <class S>
struct Scene {
    using R = typename S::Real;
    World<S> world{earth<S>()};
    BodyId body, goneBody;
    ShapeId shape, goneShape;
    JointId joint, goneJoint;
    ForceId force, goneForce;

    Scene() {
        const std::uint32_t stone = world.addMaterial(R(0.5), R(0));
        addGround<S>(world, stone);
        std::tie(body, shape, joint, force) = add(0, stone);
        std::tie(goneBody, goneShape, goneJoint, goneForce) = add(3, stone);
        for (int i = 0; i < 10; ++i) world.step(R(kTick));
        world.removeBody(goneBody);
        for (int i = 0; i < 10; ++i) world.step(R(kTick));
    }
    std::tuple<BodyId, ShapeId, JointId, ForceId> add(double x, std::uint32_t stone) {
        const BodyId id = addCube<S>(world, x, 0.5, 0.5, 1, stone);
        JointDef<S> hinge;
        hinge.type = JointType::Hinge;
        hinge.bodyB = id;
        hinge.anchorA = at<S>(x, 0.5);
        return {id, world.shapes().back().id, world.addJoint(hinge),
                world.addForce(LinearDrag<S>{id, R(0.1)})};
    }
};

template <class S>
std::vector<std::function<void()>> usesOf(World<S>& w, BodyId body, ShapeId shape, JointId joint,
                                          ForceId force) {
    using R = typename S::Real;
    using Vec = typename S::Vec;
    JointDef<S> hinge;
    hinge.bodyB = body;
    return {
        [=, &w] { w.removeBody(body); },
        [=, &w] { w.addShape(body, {Sphere<S>{R(1)}}); },
        [=, &w] { w.applyForce(body, Vec::Zero(), zeroAng<S>()); },
        [=, &w] { w.applyImpulse(body, Vec::Zero(), zeroAng<S>()); },
        [=, &w] { w.applyForceAt(body, Vec::Zero(), Vec::Zero()); },
        [=, &w] { w.applyImpulseAt(body, Vec::Zero(), Vec::Zero()); },
        [=, &w] { w.pose(body); },
        [=, &w] { w.velocity(body); },
        [=, &w] { w.angularVelocity(body); },
        [=, &w] { w.velocityAt(body, Vec::Zero()); },
        [=, &w] { w.constants(body); },
        [=, &w] { w.isAsleep(body); },
        [=, &w] { w.setVelocity(body, Vec::Zero(), zeroAng<S>()); },
        [=, &w] { w.setPose(body, {}); },
        [=, &w] { w.wake(body); },
        [=, &w] { w.setType(body, BodyType::Static); },
        [=, &w] { w.setMassOfShapes(body); },
        [=, &w] { w.setGravityScale(body, R(2)); },
        [=, &w] { w.setContinuous(body, ContinuousMode::On); },
        [=, &w] { w.addJoint(hinge); },
        [=, &w] {
            w.addForce(LinearDrag<S>{body, R(1)});
        },
        [=, &w] { FrameStepper<S>(w).pose(body); },
        [=, &w] { w.removeShape(shape); },
        [=, &w] { w.setFilter(shape, {}); },
        [=, &w] { w.filter(shape); },
        [=, &w] { w.setSurfaceVelocity(shape, {}); },
        [=, &w] { w.surfaceVelocity(shape); },
        [=, &w] { w.setDensity(shape, R(1)); },
        [=, &w] { w.setMaterial(shape, 0); },
        [=, &w] { w.sensorOverlaps(shape); },
        [=, &w] { w.removeJoint(joint); },
        [=, &w] { w.jointAxes(joint); },
        [=, &w] { w.jointCoordinate(joint); },
        [=, &w] { w.jointSpeed(joint); },
        [=, &w] { w.jointForce(joint); },
        [=, &w] { w.jointTorque(joint); },
        [=, &w] { w.setJointAxis(joint, 0, {}); },
        [=, &w] { w.setJointMotor(joint, 0, R(1), R(1)); },
        [=, &w] { w.setJointTarget(joint, 0, R(1)); },
        [=, &w] { w.jointAxis(joint); },
        [=, &w] { w.jointRows(joint); },
        [=, &w] { w.jointImpulses(joint); },
        [=, &w] { w.removeForce(force); },
    };
}

TYPED_TEST(StaleHandle, IsRefusedByEveryFunctionAndChangesNothing) {
    using S = TypeParam;
    Scene<S> scene;
    ASSERT_FALSE(scene.world.contains(scene.goneBody) || scene.world.contains(scene.goneShape) ||
                 scene.world.contains(scene.goneJoint) || scene.world.contains(scene.goneForce));
    const std::uint64_t before = scene.world.stateHash();
    const auto stale =
        usesOf<S>(scene.world, scene.goneBody, scene.goneShape, scene.goneJoint, scene.goneForce);
    for (std::size_t i = 0; i < stale.size(); ++i) EXPECT_EQ(refusal(stale[i]), "stale_handle") << i;
    EXPECT_EQ(scene.world.stateHash(), before);
    EXPECT_EQ(scene.world.bodyCount(), 2U);
    scene.world.step(static_cast<typename S::Real>(kTick));
    EXPECT_TRUE(scene.world.contains(scene.joint));
}

/// The same calls with handles that are good are not refused for their handles.
TYPED_TEST(StaleHandle, GoodOnesPass) {
    using S = TypeParam;
    Scene<S> any;
    const std::size_t count = usesOf<S>(any.world, {}, {}, {}, {}).size();
    for (std::size_t i = 0; i < count; ++i) {
        Scene<S> scene;
        const std::string id =
            refusal(usesOf<S>(scene.world, scene.body, scene.shape, scene.joint, scene.force)[i]);
        EXPECT_TRUE(id == "none" || id == "sensor") << i << ": " << id;
    }
}

TYPED_TEST(StaleHandle, ANullOneHasItsOwnError) {
    using S = TypeParam;
    Scene<S> scene;
    const auto null = usesOf<S>(scene.world, {}, {}, {}, {});
    for (std::size_t i = 0; i < null.size(); ++i) {
        const std::string id = refusal(null[i]);
        // A joint or a drag of the world with itself has its own error.
        EXPECT_TRUE(id == "null_handle" || id == "joint_bodies" || id == "force_body") << i << ": " << id;
    }
}

}  // namespace
}  // namespace rigor::engine::test
