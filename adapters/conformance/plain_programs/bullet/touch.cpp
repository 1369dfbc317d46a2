// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Touch: the boxes of slide_and_stop in Bullet alone. Two boxes that touch have contacts if the floor is the
// first of the pair and none if the block is; a rounding apart they have none in either order. So a block that is
// inserted first falls for a step, g dt^2, and a block on the floor leaves its first step with two of its four
// corners a rounding off the floor: in the second it stands on the other two, tips, and digs in (slide_and_stop:
// 0.011 m, 0.0027 m with the block first). Boxes have no distance at which contacts are kept.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

constexpr double kTouchStep = 1.0 / 60;

class Slide : public RigidBodyBase {
  public:
    Slide(bool floorFirst, double overlap) : block_(floorFirst ? 1 : 0) {
        const auto floor = [&] {
            createRigidBody(0, {0, -0.5, 0}, std::make_unique<btBoxShape>(btVector3(20, 0.5, 20)));
        };
        if (floorFirst) floor();
        const btVector3 moments(btScalar(0.045), btScalar(0.085), btScalar(0.045));
        btRigidBody& block = createRigidBody(
            2, btTransform(btQuaternion::getIdentity(), btVector3(0, btScalar(0.05 - overlap), 0)),
            std::make_unique<btBoxShape>(btVector3(0.25, 0.05, 0.25)), moments);
        block.setLinearVelocity({4, 0, 0});
        if (!floorFirst) floor();
        bodies[0]->setFriction(0.5);
        bodies[1]->setFriction(1.0);
    }
    int points() const {
        int count = 0;
        for (int i = 0; i < world->getDispatcher()->getNumManifolds(); ++i)
            count += world->getDispatcher()->getManifoldByIndexInternal(i)->getNumContacts();
        return count;
    }
    double depth() const { return 0.05 - bodies[block_]->getWorldTransform().getOrigin().y(); }

  private:
    std::size_t block_;
};

TEST(PlainBullet, BoxesThatTouchAreFoundInOneOrder) {
    for (const bool floorFirst : {true, false})
        for (const double overlap : {-1e-15, 0.0, 1e-15}) {
            Slide slide(floorFirst, overlap);
            slide.world->performDiscreteCollisionDetection();
            const bool found = overlap > 0.0 || (overlap == 0.0 && floorFirst);
            EXPECT_EQ(slide.points(), found ? 4 : 0) << floorFirst << " " << overlap;
        }
}

TEST(PlainBullet, ABlockThatTouchesTipsOrFallsForOneStep) {
    for (const bool floorFirst : {true, false}) {
        Slide slide(floorFirst, 0.0);
        std::vector<int> points;
        Trajectory plain{slide.states()};
        double deepest = 0.0;
        for (int i = 0; i < 90; ++i) {
            slide.world->stepSimulation(kTouchStep, 0);
            plain.push_back(slide.states());
            if (i < 2) points.push_back(slide.points());
            deepest = std::max(deepest, slide.depth());
        }
        EXPECT_EQ(points, (floorFirst ? std::vector<int>{4, 2} : std::vector<int>{0, 4}));
        const double oneStep = 9.81 * kTouchStep * kTouchStep;
        if (floorFirst)
            EXPECT_GT(deepest, 1.5 * oneStep);
        else
            EXPECT_NEAR(deepest, oneStep, 1e-9);

        Scenario scene =
            load("scenarios/library/3d/slide_and_stop.json", {"bodies.block.inertia=[0.045,0.085,0.045]"});
        if (!floorFirst) std::swap(scene.bodies[0], scene.bodies[1]);
        EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, kTouchStep, 90), kSameBits));
    }
}

}  // namespace
}  // namespace rigor::plain
