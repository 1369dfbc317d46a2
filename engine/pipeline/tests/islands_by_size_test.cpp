// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// solver = by_island: small islands move as they do without the large ones, and the other way round.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/pipeline/tests/contact_load.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class IslandsBySize : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(IslandsBySize, Spaces);

constexpr double kStep = 1.0 / 60;
constexpr const char* kIntegrators[] = {"symplectic_euler", "moreau_midpoint"};

template <class S>
WorldDef<S> byIsland(int contacts = 6, const std::string& solver = "by_island",
                     const std::string& integrator = "symplectic_euler") {
    WorldDef<S> def = earth<S>();
    def.solver = solver;
    def.integrator = integrator;
    def.islandContacts = contacts;
    return def;
}

template <class S>
void addJointBetween(World<S>& world, BodyId a, BodyId b, double reach) {
    JointDef<S> joint;
    joint.bodyA = a;
    joint.bodyB = b;
    joint.anchorA = at<S>(reach, 0);
    joint.anchorB = at<S>(-reach, 0);
    world.addJoint(joint);
}

/// A ground that moves up and down, under what is added to it.
template <class S>
struct Scene {
    World<S> world;
    std::uint32_t stone;
    BodyId ground;
    std::vector<BodyId> bodies;

    explicit Scene(const WorldDef<S>& def) : world(def) {
        using R = typename S::Real;
        stone = world.addMaterial(R(0.5), R(0));
        BodyDef<S> lift;
        lift.type = BodyType::Kinematic;
        lift.pose.p = at<S>(0, -1);
        ground = world.addBody(lift);
        attach<S>(world, ground, Box<S>{S::Vec::Constant(R(1)) + at<S>(29, 0)}, stone);
    }
    /// A stack and a pendulum that swings beside it.
    void addFew() {
        for (int i = 0; i < 3; ++i)
            bodies.push_back(addCube<S>(world, -10 + 0.02 * i, 0.25 + 0.5 * i, 0.25, 1, stone));
        const BodyId bob = addBall<S>(world, -13, 3, 0.1, 1, stone);
        addJointBetween<S>(world, BodyId{}, bob, 2);
        bodies.push_back(bob);
    }
    /// A row of columns that touch, and two links that hang over its edge.
    void addMany() {
        for (int x = 0; x < 4; ++x)
            for (int y = 0; y < 3; ++y)
                bodies.push_back(addCube<S>(world, 5 + 0.499 * x, 0.25 + 0.5 * y, 0.25, 1, stone));
        BodyId last = bodies.back();
        for (int i = 0; i < 2; ++i) {
            const BodyId link = addBall<S>(world, 5.499 + 1.497 + 0.5 * i, 1.25, 0.1, 0.2, stone);
            addJointBetween<S>(world, last, link, 0.25);
            bodies.push_back(last = link);
        }
    }
    void step(int i) {
        using R = typename S::Real;
        world.setVelocity(ground, at<S>(0, 0.3 * std::cos(0.1 * i)), spin<S>(0));
        world.step(R(kStep));
    }
};

template <class S>
void expectSamePose(const Scene<S>& scene, std::size_t i, const Scene<S>& other, std::size_t j, int step) {
    const Pose<S> a = scene.world.pose(scene.bodies[i]), b = other.world.pose(other.bodies[j]);
    ASSERT_EQ(a.p, b.p) << "body " << i << ", step " << step;
    ASSERT_EQ(toMatrix(a.q), toMatrix(b.q)) << "body " << i << ", step " << step;
}

template <class S>
void expectBothMoveAlone(const std::string& continuousCollision, const std::string& integrator,
                         const std::string& positionCorrection = "ngs") {
    const auto def = [&](const std::string& solver) {
        WorldDef<S> made = byIsland<S>(6, solver, integrator);
        made.continuousCollision = continuousCollision;
        made.positionCorrection = positionCorrection;
        return made;
    };
    Scene<S> both(def("by_island")), few(def("block")), many(def("by_island"));
    both.addFew();
    both.addMany();
    few.addFew();
    many.addMany();
    for (int i = 0; i < 120; ++i) {
        both.step(i);
        few.step(i);
        many.step(i);
        for (std::size_t k = 0; k < few.bodies.size(); ++k) expectSamePose(both, k, few, k, i);
        for (std::size_t k = 0; k < many.bodies.size(); ++k)
            expectSamePose(both, few.bodies.size() + k, many, k, i);
        ASSERT_EQ(both.world.pose(both.ground).p, few.world.pose(few.ground).p);
        ASSERT_EQ(both.world.lastStep().contacts,
                  few.world.lastStep().contacts + many.world.lastStep().contacts);
        ASSERT_EQ(both.world.lastStep().rows, few.world.lastStep().rows + many.world.lastStep().rows);
    }
    std::vector<ContactView<S>> all, part;
    both.world.readContacts(all);
    few.world.readContacts(part);
    const std::size_t ofFew = part.size();
    many.world.readContacts(part);
    EXPECT_EQ(all.size(), ofFew + part.size());
    const double load = normalImpulseOn<S>(both.world, both.ground);
    EXPECT_GT(load, 0.5 * kStep * kGravity * 15) << "the ground carries all boxes";
}
TYPED_TEST(IslandsBySize, EitherMovesAsWithoutTheOther) {
    for (const std::string choice : {"none", "conservative_advancement", "speculative"})
        for (const std::string integrator : kIntegrators) {
            if (choice == "speculative" && integrator == "moreau_midpoint")
                continue;  // no large islands then
            SCOPED_TRACE(choice + ", " + integrator);
            expectBothMoveAlone<TypeParam>(choice, integrator);
        }
}
TYPED_TEST(IslandsBySize, EitherMovesAsWithoutTheOtherByRattle) {
    expectBothMoveAlone<TypeParam>("none", "moreau_midpoint", "rattle");
    expectBothMoveAlone<TypeParam>("conservative_advancement", "moreau_midpoint", "rattle");
}

/// Large islands are another method: the same scene with `block` alone goes another way.
TYPED_TEST(IslandsBySize, LargeOnesAreSolvedOtherwise) {
    using S = TypeParam;
    Scene<S> many(byIsland<S>()), block(byIsland<S>(6, "block")), above(byIsland<S>(1000));
    for (Scene<S>* scene : {&many, &block, &above}) scene->addMany();
    for (int i = 0; i < 30; ++i)
        for (Scene<S>* scene : {&many, &block, &above}) scene->step(i);
    EXPECT_NE(many.world.stateHash(), block.world.stateHash());
    for (std::size_t k = 0; k < block.bodies.size(); ++k) expectSamePose(above, k, block, k, 30);
}

/// The most contacts of an island that is not large: the smallest `island_contacts` with which columns move as by `block`.
template <class S>
int sizeOfColumns(int joints) {
    const auto hash = [&](const WorldDef<S>& def) {
        Scene<S> scene(def);
        for (int x = 0; x < 4; ++x)
            for (int y = 0; y < 3; ++y)
                scene.bodies.push_back(
                    addCube<S>(scene.world, 0.499 * x, 0.25 + 0.5 * y, 0.25, 1, scene.stone));
        JointDef<S> joint;
        joint.bodyA = scene.bodies[0];
        joint.bodyB = scene.bodies[1];
        joint.anchorA = at<S>(0, 0.25);
        joint.anchorB = at<S>(0, -0.25);
        joint.collideConnected = true;
        for (int k = 0; k < joints; ++k) scene.world.addJoint(joint);
        scene.step(0);
        return scene.world.stateHash();
    };
    const std::uint64_t small = hash(byIsland<S>(6, "block"));
    int size = 1;
    while (hash(byIsland<S>(size)) != small) ++size;
    return size;
}
TYPED_TEST(IslandsBySize, ContactsCountTwiceWithJointsBesideThem) {
    const int contacts = sizeOfColumns<TypeParam>(0);
    EXPECT_GT(contacts, 12);
    EXPECT_EQ(sizeOfColumns<TypeParam>(1), contacts + 1);
    EXPECT_EQ(sizeOfColumns<TypeParam>(5), contacts + 5);
    EXPECT_EQ(sizeOfColumns<TypeParam>(contacts + 3), 2 * contacts);
}

template <class S>
void expectSameStages(const std::string& integrator) {
    using R = typename S::Real;
    Scene<S> scene(byIsland<S>(6, "by_island", integrator));
    scene.addFew();
    scene.addMany();
    for (int i = 0; i < 20; ++i) scene.step(i);
    std::vector<unsigned char> bytes;
    scene.world.saveSnapshot(bytes);
    Scene<S> restored(byIsland<S>(6, "by_island", integrator));
    restored.addFew();
    restored.addMany();
    restored.world.restoreSnapshot(bytes);
    for (int i = 0; i < 20; ++i) {
        scene.world.step(R(kStep));
        restored.world.beginStep(R(kStep));
        while (restored.world.stepping()) restored.world.runPhase();
        ASSERT_EQ(scene.world.stateHash(), restored.world.stateHash()) << "step " << i;
    }
}
TYPED_TEST(IslandsBySize, SnapshotsAndStagesGoTheSameWay) {
    for (const char* integrator : kIntegrators) {
        SCOPED_TRACE(integrator);
        expectSameStages<TypeParam>(integrator);
    }
}

/// The fastest that a box of a column has moved while boxes were put on it one by one [m/s], and the load of the
/// ground relative to the column's weight at the end.
template <class S>
std::pair<double, double> growColumn(const WorldDef<S>& def) {
    using R = typename S::Real;
    Scene<S> scene(def);
    std::vector<BodyId> column;
    double fastest = 0;
    for (int i = 0; i < 12; ++i) {
        const double top = i == 0 ? -0.25 : static_cast<double>(scene.world.pose(column.back()).p[1]);
        column.push_back(addCube<S>(scene.world, 0, top + 0.5, 0.25, 1, scene.stone));
        for (int k = 0; k < 20; ++k) {
            scene.world.setVelocity(scene.ground, S::Vec::Zero(), spin<S>(0));
            scene.world.step(R(kStep));
            for (const BodyId box : column)
                fastest = std::max(fastest, std::abs(static_cast<double>(scene.world.velocity(box)[1])));
        }
    }
    return {fastest, normalImpulseOn<S>(scene.world, scene.ground) / (kStep * kGravity * 12)};
}

/// A column grows over the threshold: impulses pass from one method to the other as forces. The boxes sink to where
/// soft contacts carry them, more slowly than one step of free fall would let them.
TYPED_TEST(IslandsBySize, ChangeTheirMethodWithoutAJolt) {
    using S = TypeParam;
    for (const char* integrator : kIntegrators) {
        const auto [fastest, load] = growColumn<S>(byIsland<S>(8, "by_island", integrator));
        EXPECT_LT(fastest, kStep * kGravity) << integrator;
        EXPECT_NEAR(load, 1, 2e-3) << integrator;
    }
}

/// A spring between two islands sees both ends at the same time: it adds no momentum.
template <class S>
void expectMomentumOfSpring(const std::string& integrator) {
    using R = typename S::Real;
    WorldDef<S> def = byIsland<S>(1, "by_island", integrator);
    def.gravity.setZero();
    Scene<S> scene(def);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 4; ++i) bodies.push_back(addCube<S>(scene.world, 0.5 * i, 5, 0.25, 1, scene.stone));
    bodies.push_back(addBall<S>(scene.world, -3, 5, 0.2, 1, scene.stone));
    LinearSpring<S> spring;
    spring.bodyA = bodies.front();
    spring.bodyB = bodies.back();
    spring.stiffness = 40;
    spring.restLength = 1;
    scene.world.addForce(spring);
    for (int i = 0; i < 60; ++i) {
        scene.world.step(R(kStep));
        double momentum = 0, speed = 0;
        for (const BodyId body : bodies) {
            momentum += static_cast<double>(scene.world.velocity(body)[0]);
            speed = std::max(speed, std::abs(static_cast<double>(scene.world.velocity(body)[0])));
        }
        ASSERT_NEAR(momentum, 0, tol<S>(1e-6, 1e-5) * std::max(speed, 1.0)) << "step " << i;
    }
}
TYPED_TEST(IslandsBySize, ForcesJoinThem) {
    for (const char* integrator : kIntegrators) {
        SCOPED_TRACE(integrator);
        expectMomentumOfSpring<TypeParam>(integrator);
    }
}

/// Boxes that fall as one island, which is large from when they meet: they go on as they fell.
TYPED_TEST(IslandsBySize, FallingOnesKeepTheirWay) {
    using S = TypeParam;
    using R = typename S::Real;
    Scene<S> scene(byIsland<S>(6, "by_island", "moreau_midpoint"));
    std::vector<BodyId> boxes;
    for (int i = 0; i < 6; ++i) boxes.push_back(addCube<S>(scene.world, 0.5 * i, 60, 0.25, 1, scene.stone));
    for (int i = 0; i < 6; ++i) {
        boxes.push_back(addCube<S>(scene.world, 0.5 * i, 60.6, 0.25, 1, scene.stone));
        scene.world.setVelocity(boxes.back(), at<S>(0, -0.5), spin<S>(0));
    }
    for (int i = 0; i < 60; ++i) scene.world.step(R(kStep));
    double height = 0, speed = 0;
    for (const BodyId box : boxes) {
        height += static_cast<double>(scene.world.pose(box).p[1]) / 12;
        speed += static_cast<double>(scene.world.velocity(box)[1]) / 12;
    }
    EXPECT_NEAR(height, 60.3 - 0.25 - 0.5 * kGravity, 1e-3);
    EXPECT_NEAR(speed, -0.25 - kGravity, 1e-4);
}

/// A row of cubes that touch, without gravity, and a ball; one of the two flies at the other, by ten times its size in a
/// step.
template <class S>
void shoot(const std::string& continuousCollision, bool ballFlies) {
    using R = typename S::Real;
    WorldDef<S> def = byIsland<S>(1);
    def.gravity.setZero();
    def.continuousCollision = continuousCollision;
    Scene<S> scene(def);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 4; ++i) bodies.push_back(addCube<S>(scene.world, 0.5 * i, 5, 0.25, 1, scene.stone));
    bodies.push_back(addBall<S>(scene.world, -7, 5, 0.2, 1, scene.stone));
    for (int i = 0; i < 5; ++i) scene.world.step(R(kStep));  // the cubes are one large island
    const double speed = 240;
    for (std::size_t k = 0; k < bodies.size(); ++k)
        if ((k == 4) == ballFlies)
            scene.world.setVelocity(bodies[k], at<S>(ballFlies ? speed : -speed, 0), spin<S>(0));
    const double momentum = ballFlies ? speed : -4 * speed;
    bool hit = false;
    for (int i = 0; i < 10; ++i) {
        scene.world.step(R(kStep));
        double sum = 0;
        for (const BodyId body : bodies) sum += static_cast<double>(scene.world.velocity(body)[0]);
        ASSERT_NEAR(sum, momentum, tol<S>(1e-4, 1e-4) * std::abs(momentum)) << "step " << i;
        ASSERT_LT(scene.world.pose(bodies[4]).p[0], scene.world.pose(bodies[0]).p[0] - R(0.2))
            << "step " << i;
        hit = hit || (scene.world.velocity(bodies[4])[0] != R(0)) != ballFlies ||
              std::abs(static_cast<double>(scene.world.velocity(bodies[4])[0]) - speed) > 1;
        const auto& impacts = scene.world.lastStep().impacts;
        for (std::size_t k = 1; k < impacts.size(); ++k) ASSERT_LE(impacts[k - 1].time, impacts[k].time);
    }
    EXPECT_TRUE(hit);
}

/// Fast bodies meet those of the other size at their time of impact, and exchange momentum with them.
TYPED_TEST(IslandsBySize, FastBodiesDoNotPassThem) {
    for (const std::string choice : {"conservative_advancement", "speculative"})
        for (const bool ballFlies : {true, false}) {
            SCOPED_TRACE(choice + (ballFlies ? ", the ball flies" : ", the row flies"));
            shoot<TypeParam>(choice, ballFlies);
        }
}

/// Choices that need contacts as rows leave all islands to one method.
TYPED_TEST(IslandsBySize, GiveWayToChoicesThatNeedRows) {
    using S = TypeParam;
    const auto run = [](WorldDef<S> def) {
        Scene<S> scene(def);
        scene.addMany();
        for (int i = 0; i < 20; ++i) scene.step(i);
        return scene.world.stateHash();
    };
    const auto set = [](WorldDef<S> def, int choice) {
        if (choice == 0) def.friction = "pyramid";
        if (choice == 1) def.restitution = "poisson";
        if (choice == 2) def.measureResiduals = true;
        if (choice == 3) def.fault = "flipped_normal";
        return def;
    };
    for (int choice = 0; choice < 4; ++choice)
        EXPECT_EQ(run(set(byIsland<S>(), choice)), run(set(byIsland<S>(6, "block"), choice))) << choice;
}

}  // namespace
}  // namespace rigor::engine::test
