// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs of overlapping boxes: the same with and without a box margin, and changes of them are reported.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "engine/contacts/pair_search.hpp"
#include "engine/core/table.hpp"

namespace rigor::engine::test {
namespace {

/// Dynamic discs that walk at random in a square, and a function that finds their pairs.
struct Crowd {
    BodyArrays<Space2d> bodies;
    ShapeSet<Space2d> shapes;
    PairSearch<Space2d> search;
    std::unique_ptr<BroadPhase<Space2d>> broadPhase =
        findAlgorithm(broadPhaseTable<Space2d>(), "broad_phase", std::string("brute_force")).make();
    std::mt19937 random{3};

    explicit Crowd(std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            bodies.pose.emplace_back();
            bodies.islands.push_back(IslandKind::Usual);
            bodies.constants.emplace_back().type = BodyType::Dynamic;
            ShapeRecord<Space2d> record;
            record.shape = Sphere<Space2d>{0.5};
            record.body = i;
            shapes.add(record);
        }
        move(6);
    }
    void move(double distance) {
        std::uniform_real_distribution<double> step(-distance, distance);
        for (Pose<Space2d>& pose : bodies.pose) pose.p += Space2d::Vec(step(random), step(random));
    }
    void find(double margin) {
        shapes.update(bodies, {}, LookAhead<Space2d>(), Tasks::one());
        search.update(shapes, *broadPhase, margin, Tasks::one());
    }
};

TEST(PairSearch, FatAabbsLeadToTheSamePairs) {
    Crowd exact(60), fat(60);
    std::size_t wider = 0;
    for (int step = 0; step < 50; ++step) {
        exact.find(0);
        fat.find(0.2);
        ASSERT_EQ(exact.search.overlapping(exact.shapes), fat.search.overlapping(fat.shapes)) << step;
        EXPECT_EQ(exact.search.near(), exact.search.overlapping(exact.shapes));
        EXPECT_EQ(fat.search.count(), exact.search.count());
        wider += fat.search.near().size() > fat.search.count();
        exact.move(0.05);
        fat.move(0.05);
    }
    EXPECT_GT(wider, 25u);
}

TEST(PairSearch, ReportsChangesUntilTheyAreTaken) {
    for (const double margin : {0.0, 0.2}) {
        Crowd crowd(20);
        crowd.find(margin);
        EXPECT_TRUE(crowd.search.changed()) << margin;
        crowd.find(margin);
        EXPECT_TRUE(crowd.search.changed()) << "not taken yet";
        crowd.search.take();
        crowd.find(margin);
        EXPECT_FALSE(crowd.search.changed()) << "no body has moved";
        crowd.bodies.pose[3].p = crowd.bodies.pose[11].p;
        crowd.bodies.pose[5].p = crowd.bodies.pose[11].p;
        crowd.find(margin);
        EXPECT_TRUE(crowd.search.changed()) << margin;
        crowd.search.take();
        crowd.search.reset();
        EXPECT_TRUE(crowd.search.changed()) << "shapes may be others";
    }
}

}  // namespace
}  // namespace rigor::engine::test
