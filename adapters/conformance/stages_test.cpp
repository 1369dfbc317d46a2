// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Worlds that can be stopped between the stages of a step, or taken back: the same motion, bit for bit, and
// what is read in between fits together.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "adapters/conformance/kit.hpp"
#include "adapters/interface/state_setting.hpp"

namespace rigor::conformance {
namespace {

class Stages : public DynamicsTest {
  protected:
    /// A block that slides on the ground and a ball that falls beside it.
    Scenario slide() const {
        Scenario s = scene(0.5);
        s.gravity = {0, -9.81, 0};
        addStatic(s, block({5, 0.5, 5}), {0, -0.5, 0});
        addBody(s, block({0.5, 0.5, 0.5}), {0, 0.5, 0}, 2.0, boxMoments(2.0, {0.5, 0.5, 0.5}));
        s.bodies.back().velocity = {1, 0, 0};
        addBody(s, ball(0.25), {2, 1, 0}, 1.0);
        return s;
    }
    bool canSlide() const { return hasShape("box") && hasShape(is2d() ? "circle" : "sphere"); }
    static std::vector<double> bits(const adapter::World& world, const Scenario& s) {
        std::vector<double> all;
        for (std::size_t i = 0; i < s.bodies.size(); ++i) {
            const BodyState b = stateOf(world, s, i);
            for (const double v : {b.position.x, b.position.y, b.position.z, b.orientation.w, b.orientation.x,
                                   b.orientation.y, b.orientation.z, b.velocity.x, b.velocity.y, b.velocity.z,
                                   b.angularVelocity.x, b.angularVelocity.y, b.angularVelocity.z})
                all.push_back(v);
        }
        return all;
    }
    static void stepInStages(adapter::StagedWorld& staged) {
        for (staged.beginStep(); staged.stepping();) staged.runStage();
    }
};
INSTANTIATE_TEST_SUITE_P(Kit, Stages, testing::ValuesIn(dynamicsArenas()), arenaName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Stages);

TEST_P(Stages, OneAtATimeAreTheWholeStep) {
    if (!canSlide()) GTEST_SKIP() << "no boxes or balls";
    const Scenario s = slide();
    const auto whole = build(s, 1.0 / 120), staged = build(s, 1.0 / 120);
    if (staged->staged() == nullptr) GTEST_SKIP() << "steps can not be looked into";
    staged->staged()->watchIterations(true);
    for (int i = 0; i < 60; ++i) {
        for (adapter::World* world : {whole.get(), staged.get()}) world->applyForce(1, {0.5, 0, 0}, {});
        whole->step();
        stepInStages(*staged->staged());
        ASSERT_EQ(bits(*whole, s), bits(*staged, s)) << "step " << i;
    }
    EXPECT_FALSE(staged->staged()->iterations().empty());
}

TEST_P(Stages, HaveNamesThatComeBackInEveryStep) {
    if (!canSlide()) GTEST_SKIP() << "no boxes or balls";
    const auto world = build(slide(), 1.0 / 120);
    adapter::StagedWorld* staged = world->staged();
    if (staged == nullptr) GTEST_SKIP() << "steps can not be looked into";
    EXPECT_FALSE(staged->stepping());
    EXPECT_EQ(staged->nextStage(), "");
    std::vector<std::string> first;
    for (int step = 0; step < 3; ++step) {
        std::vector<std::string> names;
        for (staged->beginStep(); staged->stepping(); staged->runStage()) {
            names.push_back(staged->nextStage());
            EXPECT_FALSE(names.back().empty());
            EXPECT_GE(staged->substep(), 0);
        }
        if (step == 0) first = names;
        EXPECT_EQ(names, first);
    }
    EXPECT_GT(first.size(), 1u);
}

TEST_P(Stages, WhatIsReadFitsTogether) {
    if (!canSlide()) GTEST_SKIP() << "no boxes or balls";
    const Scenario s = slide();
    const auto world = build(s, 1.0 / 120);
    adapter::StagedWorld* staged = world->staged();
    if (staged == nullptr) GTEST_SKIP() << "steps can not be looked into";
    staged->watchIterations(true);
    for (int i = 0; i < 10; ++i) stepInStages(*staged);

    const auto boxes = staged->boxes();
    ASSERT_EQ(boxes.size(), 3u);
    std::set<int> bodies;
    for (const auto& box : boxes) {
        bodies.insert(box.of.body);
        EXPECT_EQ(box.of.shape, 0);
        const Vec3 p = stateOf(*world, s, box.of.body).position;
        EXPECT_LT(box.box.min.x, p.x);
        EXPECT_GT(box.box.max.y, p.y - 0.1);
    }
    EXPECT_EQ(bodies, (std::set<int>{0, 1, 2}));
    const auto pairs = staged->pairs();
    ASSERT_EQ(pairs.size(), 1u) << "the ball is in the air";
    EXPECT_EQ(pairs[0].a.body, 0);
    EXPECT_EQ(pairs[0].b.body, 1);

    const auto manifolds = staged->manifolds();
    const auto rows = staged->rows();
    ASSERT_EQ(manifolds.size(), 1u);
    EXPECT_NEAR(manifolds[0].normal.y, 1.0, 1e-4) << "from A to B";
    const auto hasRow = [](const auto& point) { return point.row != scenario::kNone; };
    const auto& points = manifolds[0].points;
    // A solver of patches has no rows of single points.
    const bool rowsOfPoints = std::any_of(points.begin(), points.end(), hasRow);
    double pushed = 0.0;
    for (const auto& point : points) {
        EXPECT_NEAR(point.pointA.y, 0.0, 0.01);
        EXPECT_NEAR(point.depth, point.pointA.y - point.pointB.y, 1e-5);
        ASSERT_EQ(hasRow(point), rowsOfPoints);
        if (!rowsOfPoints) continue;
        const auto& row = rows.at(point.row);
        EXPECT_EQ(row.kind, adapter::StagedRow::Kind::Normal);
        EXPECT_EQ(row.bodyA, 0);
        EXPECT_EQ(row.bodyB, 1);
        EXPECT_EQ(row.joint, scenario::kNone);
        pushed += row.impulse;
    }
    // The rows of the last sub-step carry the block during it.
    EXPECT_EQ(pushed > 0.0, rowsOfPoints);
    EXPECT_LT(pushed, 1.5 * 2.0 * 9.81 / 120);
    const auto islands = staged->islands();
    ASSERT_EQ(islands.size(), 2u);
    EXPECT_EQ(islands[0], std::vector<int>{1});
    EXPECT_EQ(islands[1], std::vector<int>{2});

    ASSERT_FALSE(staged->iterations().empty());
    for (const auto& iteration : staged->iterations()) EXPECT_TRUE(std::isfinite(iteration.residual));
    const auto& last = staged->iterations().back().impulses;
    ASSERT_EQ(last.size(), rows.size());
    staged->watchIterations(false);
    stepInStages(*staged);
    EXPECT_TRUE(staged->iterations().empty());
}

TEST_P(Stages, RowsNameTheirJoint) {
    if (!hasJoint("hinge")) GTEST_SKIP() << "no hinges";
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    addBody(s, block({0.5, 0.1, 0.1}), {0.5, 0, 0}, 1.0, boxMoments(1.0, {0.5, 0.1, 0.1}));
    Joint joint;
    joint.name = "pivot";
    joint.type = JointType::Hinge;
    joint.bodyB = 0;
    joint.anchorB = {-0.5, 0, 0};
    s.joints.push_back(joint);
    const auto world = build(s, 1.0 / 120);
    EXPECT_TRUE(world->jointHolds(0));
    if (world->staged() == nullptr) GTEST_SKIP() << "steps can not be looked into";
    stepInStages(*world->staged());
    const auto rows = world->staged()->rows();
    ASSERT_EQ(rows.size(), is2d() ? 2u : 5u);
    for (const auto& row : rows) {
        EXPECT_EQ(row.joint, 0);
        EXPECT_EQ(row.kind, adapter::StagedRow::Kind::Joint);
        EXPECT_EQ(row.bodyA, scenario::kNone);
        EXPECT_EQ(row.bodyB, 0);
    }
}

TEST_P(Stages, SnapshotsBringTheSameFutureBack) {
    if (!canSlide()) GTEST_SKIP() << "no boxes or balls";
    const Scenario s = slide();
    const auto world = build(s, 1.0 / 120), twin = build(s, 1.0 / 120);
    if (world->snapshots() == nullptr) GTEST_SKIP() << "the state can not be taken back";
    run(*world, 20);
    std::vector<unsigned char> bytes;
    world->snapshots()->save(bytes);
    const auto then = bits(*world, s);
    run(*world, 60);
    const auto after = bits(*world, s);
    ASSERT_TRUE(world->snapshots()->restore(bytes));
    EXPECT_EQ(bits(*world, s), then);
    run(*world, 60);
    EXPECT_EQ(bits(*world, s), after);
    ASSERT_TRUE(twin->snapshots()->restore(bytes)) << "into a world built alike";
    run(*twin, 60);
    EXPECT_EQ(bits(*twin, s), after);
}

/// A rod swings on a hinge beside the slide, forces act before and after the snapshot, and a body has been
/// put somewhere else where that is offered: whatever the next step starts from comes back.
TEST_P(Stages, SnapshotsHoldWhatActsOnBodiesAndJoints) {
    if (!canSlide() || !hasJoint("hinge")) GTEST_SKIP() << "no boxes, balls or hinges";
    Scenario s = slide();
    const int rod = addBody(s, block({0.5, 0.1, 0.1}), {-2.5, 3, 0}, 1.0, boxMoments(1.0, {0.5, 0.1, 0.1}));
    Joint joint;
    joint.name = "pivot";
    joint.type = JointType::Hinge;
    joint.bodyB = rod;
    joint.anchorA = {-3, 3, 0};
    joint.anchorB = {-0.5, 0, 0};
    s.joints.push_back(joint);
    const auto world = build(s, 1.0 / 120), twin = build(s, 1.0 / 120);
    if (world->snapshots() == nullptr) GTEST_SKIP() << "the state can not be taken back";
    const auto push = [&](adapter::World& w, int steps) {
        for (int i = 0; i < steps; ++i) {
            w.applyForce(1, {0.5, 0, 0}, {});
            w.applyForce(rod, {}, {0, 0, 0.25});
            w.step();
        }
    };
    push(*world, 20);
    if (auto* setter = dynamic_cast<adapter::StateSetting*>(world.get())) {
        std::vector<BodyState> states(s.bodies.size());
        world->readStates(states);
        states[2].position.x += 0.5;
        setter->setStates(states);
    }
    push(*world, 20);
    world->applyForce(1, {-20, 0, 0}, {});
    std::vector<unsigned char> bytes;
    world->snapshots()->save(bytes);
    push(*world, 40);
    const auto after = bits(*world, s);
    for (adapter::World* w : {world.get(), twin.get()}) {
        ASSERT_TRUE(w->snapshots()->restore(bytes));
        std::vector<unsigned char> again;
        w->snapshots()->save(again);
        push(*w, 40);
        EXPECT_EQ(bits(*w, s), after);
        ASSERT_TRUE(w->snapshots()->restore(again)) << "a snapshot of what was restored";
        push(*w, 40);
        EXPECT_EQ(bits(*w, s), after);
    }
}

}  // namespace
}  // namespace rigor::conformance
